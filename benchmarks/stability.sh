#!/usr/bin/env bash
# Maps where the loop is stable: docs/data/stability_*.csv and docs/charts/stability.{svg,png}.  Installs what is missing for
# that (Debian; as root or with sudo).
#
#   bash benchmarks/stability.sh [--program FILE]
#
#   --program FILE   stability_map, built already; default: builds it
#   --help           this text
#
# Simulated time: the same numbers on every machine, in some ten minutes.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"

usage() { sed -n '2,11s/^# \{0,1\}//p' "$0"; }
wrong() { echo "benchmarks/stability.sh: $1" >&2; exit 2; }

program=
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --program) program=${2-}; shift 2 2>/dev/null || shift ;;
    *) wrong "'$1': only --program FILE and --help are allowed" ;;
  esac
done

need gnuplot-nox || exit 1
if [[ -z $program ]]; then
  build release stability_map || exit 1
  program=$top/build/release/benchmarks/stability_map
fi
data=$(mktemp -d)
trap 'rm -rf "$log" "$data"' EXIT
kept=$top/docs/data

run() { "$program" "$1" >"$data/$1.csv"; }
keep() {
  cp "$data/border.csv" "$kept/stability_border.csv" && cp "$data/direct.csv" "$kept/stability_direct.csv" &&
    awk -F, 'NR == 1 || $NF != "at_rest"' "$data/sweep.csv" >"$kept/stability_failures.csv" &&
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
      }' "$data/sweep.csv" >"$kept/stability_sweep.csv"
}
draw() {
  gnuplot -e "data = '$kept'; charts = '$top/docs/charts'" "$top/benchmarks/stability.gp" &&
    sed -i -E 's:<(title|desc)>[^<]*</(title|desc)>::' "$top/docs/charts/stability.svg"  # gnuplot's expressions
}

for what in border direct sweep; do step "$what" run "$what" || exit 1; done
step 'keep docs/data' keep || exit 1
step 'draw docs/charts' draw || exit 1
cat "$kept/stability_sweep.csv"
