# From what the programs print to docs/data/*.csv; for `source`, by run.sh.

# heading FILE COMMIT DATE: what stands above each table, machine and compiler from a FILE of Google Benchmark's.
heading() {
  context() { sed -nE 's/^ *"'"$1"'": "?([^"]*[^",])"?,?$/\1/p' "$file" | head -n 1; }
  local file=$1
  echo "# $(context processor), $(context num_cpus) processors"
  echo "# $(context compiler), $(context flags)"
  echo "# commit ${2:-$(context commit)}, ${3:-$(context date)}${HAPBEAM_QUICK:+, quick}"
}

# csv PROGRAM PARTS COUNTER...: a line for each benchmark: the parts of its name, separated by '/', the last one with the rest
# of it, then its counters; nothing where it has none of that name.
csv() {
  local program=$1 parts=$2
  shift 2
  {
    heading "$scratch/$program.json"
    awk -F'"' -v parts="$parts" -v counters="$*" '
      function put(  k, line, part) {
        if (name == "") return
        split(name, part, "/")
        line = part[1]
        for (k = 2; k <= m; ++k) line = line "," part[k]
        for (k = m + 1; k in part; ++k) line = line "/" part[k]
        for (k = 1; k <= n; ++k) line = line "," value[counter[k]]
        print line
      }
      BEGIN {
        n = split(counters, counter, " ")
        m = split(parts, part, "/")
        line = parts
        gsub("/", ",", line)
        for (k = 1; k <= n; ++k) line = line "," counter[k]
        print line
      }
      /"name":/ {
        put()
        name = $4
        sub(/\/iterations:1.*/, "", name)
        split("", value)
      }
      name != "" && $3 ~ /^: -?[0-9]/ { gsub(/[:, ]/, "", $3); value[$2] = sprintf("%.9g", $3) }
      END { put() }' "$scratch/$program.json"
  } >"$kept/$program.csv"
}

csv_speed_accuracy() {
  csv speed_accuracy scene/model/elements/modes/snapshots \
    tick_ns_p50 tick_ns_p99 force_error_max force_error_median outside_error_max bytes
}
csv_costs() { csv costs what/model/n tick_us training_ms force_error shape_error bytes; }
csv_thesis_figures() { csv thesis_figures figure/setting/n/what time_us force_error; }
csv_reduced_press() {
  csv reduced_press path/model/what p50_us p99_us max_us force_error_median force_error_max shape_error_max snapshots_ms pod_ms
}
csv_any_rotation() { csv any_rotation scene/model/elements p50_us p99_us ratio force_error; }
csv_rod_ticks() { csv rod_ticks scene/model/elements p50_us p99_us ratio solves force_error; }
csv_many_beams() {
  csv many_beams model/beams/contacts p50_us p99_us touched per_contact_us force_error bytes_a_beam bytes_a_model
}
csv_swing() { csv swing study/rule/elements/steps share tip_error energy_gained energy_lost; }
csv_fem_press() { csv fem_press path/solver/membrane/elements p50_us p99_us solves solve_ns force_error; }
csv_kinematics() {
  csv kinematics study/ends/section/element slope_1 deflection_1 press_1 slope_5 deflection_5 press_5 slope_10 deflection_10 \
    press_10 deepest error_at_deepest
}

# Programs that are no micro-benchmarks.

# What a servo's tick and its period take in real time.
csv_servo_times() {
  "$programs/servo_times" "$([[ -n ${HAPBEAM_QUICK-} ]] && echo 5 || echo 60)" >"$scratch/servo_times" && {
    heading "$kept/costs.json" "$(git -C "$top" describe --always --dirty --abbrev=12 '--exclude=*')" "$(date -Iseconds)"
    echo what,p50_us,p99_us,p999_us,max_us,ticks
    awk '/^(compute|period)/ { print $1 "," $3 "," $6 "," $9 "," $12 "," $15 }' "$scratch/servo_times"
  } >"$kept/servo_times.csv"
}

# How well models are chosen, a line a scene.
chosen() {
  "$programs/$1" >"$scratch/$1" && {
    heading "$kept/costs.json" "$(git -C "$top" describe --always --dirty --abbrev=12 '--exclude=*')" "$(date -Iseconds)"
    cat "$scratch/$1"
  } >"$kept/$1.csv"
}
csv_chooser() { chosen chooser; }
csv_chooser_rods() { chosen chooser_rods; }

# What the compiler pays for each public header.
csv_compile_cost() {
  bash "$top/benchmarks/compile_cost.sh" >"$scratch/compile_cost" && cp "$scratch/compile_cost" "$kept/compile_cost.csv"
}

# What a compiler's flags do to a tick.
csv_flags() { bash "$top/benchmarks/flags.sh" >"$scratch/flags.csv" && cp "$scratch/flags.csv" "$kept/flags.csv"; }

# csv_stability border|direct|friction|sweep: of the sweep, which has a line for each combination, counts and failures.
csv_stability() {
  "$programs/stability_map" "$1" >"$scratch/$1.csv" || return 1
  if [[ $1 != sweep ]]; then
    cp "$scratch/$1.csv" "$kept/stability_$1.csv"
    return
  fi
  awk -F, 'NR == 1 || $NF != "at_rest"' "$scratch/sweep.csv" >"$kept/stability_failures.csv"
  awk -F, '
    NR == 1 { next }
    { key = $1 "," $2; if (!(key in all)) order[++n] = key; ++all[key]; ++count[key, $NF] }
    END {
      print "scene,push_N,combinations,at_rest,slow,slow_as_the_arm_itself,slides_off,lost,gives_energy"
      for (k = 1; k <= n; ++k) {
        key = order[k]
        print key "," all[key] "," count[key, "at_rest"] + 0 "," count[key, "slow"] + 0 "," \
          count[key, "slow_as_the_arm_itself"] + 0 "," count[key, "slides_off"] + 0 "," count[key, "lost"] + 0 "," \
          count[key, "gives_energy"] + 0
      }
    }' "$scratch/sweep.csv" >"$kept/stability_sweep.csv"
}

# The turning hands of turning_map, which has a line for each: counts, and what fails through the coupling that the device can render.
csv_turning() {
  "$programs/turning_map" >"$scratch/turning.csv" || return 1
  awk -F, 'NR == 1 || $3 == 1 && ($NF == "moves" || $NF == "gives_energy")' "$scratch/turning.csv" >"$kept/turning_failures.csv"
  awk -F, '
    NR == 1 { next }
    { key = $1 "," $2 "," $3 "," $4 "," ($9 > 0 ? "some" : "none"); if (!(key in all)) order[++n] = key; ++all[key]; ++count[key, $NF] }
    END {
      print "rod,touched_by,stiffness_factor,damping_factor,gimbal_friction,combinations,at_rest,slower,slower_as_alone,moves,slips_off," \
        "gives_energy"
      for (k = 1; k <= n; ++k) {
        key = order[k]
        print key "," all[key] "," count[key, "at_rest"] + 0 "," count[key, "slower"] + 0 "," count[key, "slower_as_alone"] + 0 "," \
          count[key, "moves"] + 0 "," count[key, "slips_off"] + 0 "," count[key, "gives_energy"] + 0
      }
    }' "$scratch/turning.csv" >"$kept/turning_sweep.csv"
}

# The hands of hostile_hands, 10⁷ ticks each.
csv_hostile() { "$programs/hostile_hands" 10000000 >"$kept/hostile_hands.csv"; }
