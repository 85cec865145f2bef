# From what the programs print to docs/data/*.csv; for `source`, by run.sh.

# context KEY PROGRAM: of Google Benchmark's header.
context() { sed -nE 's/^ *"'"$1"'": "?([^"]*[^",])"?,?$/\1/p' "$scratch/$2.json" | head -n 1; }

# csv PROGRAM PARTS COUNTER...: a line for each benchmark: the parts of its name, separated by '/', then its counters;
# nothing where it has none of that name.
csv() {
  local program=$1 parts=$2
  shift 2
  {
    echo "# $(context processor "$program"), $(context num_cpus "$program") processors"
    echo "# $(context compiler "$program"), $(context flags "$program")"
    echo "# commit $(context commit "$program"), $(context date "$program")${HAPBEAM_QUICK:+, quick}"
    awk -F'"' -v parts="$parts" -v counters="$*" '
      function put(  k, line) {
        if (name == "") return
        line = name
        for (k = 1; k <= n; ++k) line = line "," value[counter[k]]
        print line
      }
      BEGIN {
        n = split(counters, counter, " ")
        line = parts
        gsub("/", ",", line)
        for (k = 1; k <= n; ++k) line = line "," counter[k]
        print line
      }
      /"name":/ {
        put()
        name = $4
        sub(/\/iterations:1.*/, "", name)
        if (index(parts, "/")) gsub("/", ",", name)
        split("", value)
      }
      name != "" && $3 ~ /^: -?[0-9]/ { gsub(/[:, ]/, "", $3); value[$2] = sprintf("%.6g", $3) }
      END { put() }' "$scratch/$program.json"
  } >"$kept/$program.csv"
}

csv_speed_accuracy() {
  csv speed_accuracy scene/model/elements/modes/snapshots \
    tick_ns_p50 tick_ns_p99 force_error_max force_error_median outside_error_max bytes
}
