#!/usr/bin/env bash
# Measures how well choose() chooses, writes docs/data/chooser.csv and fills in docs/choosing.md.  Installs what is missing
# for that (Debian; as root or with sudo).  Takes a minute after the build.
#
#   bash benchmarks/chooser.sh [--programs FOLDER]
#
#   --programs FOLDER   where the program chooser is, built already; default: builds it
#   --help              this text
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"

programs=
case ${1-} in
  --help) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 0 ;;
  --programs) programs=${2-} ;;
  ?*) echo "benchmarks/chooser.sh: '$1': only --programs FOLDER and --help are allowed" >&2; exit 2 ;;
esac
if [[ -z $programs ]]; then
  build release chooser || exit 1
  programs=$top/build/release/benchmarks
fi
page=$top/docs/choosing.md csv=$top/docs/data/chooser.csv

measure() { "$programs/chooser" 400 1 >"$csv.part" && mv "$csv.part" "$csv"; }

# The table of the page, from the data.
table() {
  awk '
    # Quoted fields hold commas.
    function fields(line, f,   n, i, c, quoted) {
      n = 1; f[1] = ""
      for (i = 1; i <= length(line); ++i) {
        c = substr(line, i, 1)
        if (c == "\"") quoted = !quoted
        else if (c == "," && !quoted) f[++n] = ""
        else f[n] = f[n] c
      }
    }
    function family(text) { sub(/,.*/, "", text); sub(/ of .*/, "", text); return text }
    NR == 1 { next }
    {
      fields($0, f); ++scenes; tolerance = f[10] + 0; ms = f[13] + 0
      if (ms > slowest) slowest = ms
      if (f[14] == "none") { ++none; if (f[17] != "none") ++overlooked; next }
      ++chosen; ++count[family(f[14])]
      error = f[15] / tolerance; if (error > worst) worst = error
      if (error > 1) ++missed
      if (f[17] == "none") next
      ratio = f[16] / f[19]; if (ratio > 2) ++dear; if (ratio > dearest) dearest = ratio
    }
    END {
      print "| of " scenes " scenes | |"
      print "|---|---|"
      printf "| a model was chosen | %d: ", chosen
      split("POD Galerkin Linear VonKarman Corotational", names, " ")
      for (i = 1; i <= 5; ++i) if (names[i] in count) { printf "%s%s %d", separator, names[i], count[names[i]]; separator = ", " }
      print " |"
      printf "| none was, though one would have done | %d of %d |\n", overlooked, none
      printf "| error beyond the tolerated one, on 60 presses that were held out | %d; at worst %.2f of it |\n", missed, worst
      printf "| costs more than twice the cheapest that is right | %d; at most %.1f times |\n", dear, dearest
      printf "| longest choice | %.0f ms |\n", slowest
    }' "$csv"
}

fill_in() {
  local data
  data=$(mktemp -d)
  table >"$data/table" && [[ $(wc -l <"$data/table") -eq 7 ]] &&
    awk -v table="$data/table" '
      /^<!-- measured/ { print; print ""; while ((getline line < table) > 0) print line; print ""; skip = 1 }
      /^<!-- end/ { skip = 0 }
      !skip' "$page" >"$data/page" && cp "$data/page" "$page"
  local status=$?
  rm -rf "$data"
  return $status
}

step 'choose for 400 scenes' measure && step 'fill in docs/choosing.md' fill_in
