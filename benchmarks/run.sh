#!/usr/bin/env bash
# Builds and runs the benchmarks, writes docs/data, draws docs/charts, and fills in what README.md and docs quote.
# Installs what is missing for that (Debian; as root or with sudo).
#
#   bash benchmarks/run.sh [--quick] [--only PROGRAM] [--stability] [--programs FOLDER]
#
#   --quick             fewer sizes, stops and rounds, no choosers: under 3 minutes; the numbers are rougher and fewer
#   --only PROGRAM      measures with that one alone; `none` measures nothing and draws what docs/data has
#   --stability         also maps where the servo loop is stable, and what hands do that nobody would: the same numbers on every machine, 30 min
#   --programs FOLDER   where the benchmarks are, built already; default: builds them
#   --help              this text
#
# Nothing else should run meanwhile.  Takes half an hour after the build.
set -u
export LC_ALL=C
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"
source "$top/benchmarks/report/csv.sh"

usage() { sed -n '2,14s/^# \{0,1\}//p' "$0"; }
wrong() { echo "benchmarks/run.sh: $1" >&2; exit 2; }

quick=(speed_accuracy costs thesis_figures reduced_press any_rotation rod_ticks fem_press many_beams kinematics swing where_methods_fail servo_times)
all=("${quick[@]}" chooser chooser_rods compile_cost flags)
what=("${all[@]}") stability= programs=
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --quick) export HAPBEAM_QUICK=1; what=("${quick[@]}"); shift ;;
    --only) what=("${2-}"); shift 2 2>/dev/null || shift ;;
    --stability) stability='stability_map turning_map hostile_hands'; shift ;;
    --programs) programs=${2-}; shift 2 2>/dev/null || shift ;;
    *) wrong "'$1': see --help" ;;
  esac
done
[[ ${what[*]} != none ]] || what=()
for program in "${what[@]}"; do
  [[ " ${all[*]} " == *" $program "* ]] || wrong "--only '$program': must be none or one of ${all[*]}"
done

need gnuplot-nox fonts-dejavu-core || exit 1
if [[ -z $programs ]]; then
  targets=()
  for program in "${what[@]}" $stability; do
    [[ $program == compile_cost || $program == flags ]] || targets+=("$program")
  done
  [[ ${#targets[@]} == 0 ]] || build release "${targets[@]}" || exit 1
  programs=$top/build/release/benchmarks
fi
kept=$top/docs/data charts=$top/docs/charts scratch=$(mktemp -d)
trap 'rm -rf "$log" "$scratch"' EXIT

measure() {
  case $1 in
    servo_times | chooser | chooser_rods | compile_cost | flags) "csv_$1" ;;
    where_methods_fail) bash "$top/benchmarks/$1.sh" --program "$programs/$1" ;;
    *)
      "$programs/$1" --benchmark_out="$scratch/$1.json" --benchmark_out_format=json &&
        ! grep error_message "$scratch/$1.json" && "csv_$1" && sed "s|\"$top/|\"|" "$scratch/$1.json" >"$kept/$1.json"
      ;;
  esac
}

draw() {
  local chart
  for chart in "$top"/benchmarks/report/*.gp; do
    [[ $chart != */style.gp ]] || continue
    gnuplot -e "data = '$kept'; charts = '$charts'; folder = '$top/benchmarks/report'" "$chart" ||
      return 1
  done
  # Gnuplot's titles are its own expressions, and browsers show them under the pointer.
  sed -i -E 's:<(title|desc)>[^<]*</(title|desc)>::' "$charts"/*.svg
}

for program in "${what[@]}"; do step "$program" measure "$program" || exit 1; done
if [[ -n $stability ]]; then
  for map in border direct friction sweep; do step "stability_map $map" csv_stability "$map" || exit 1; done
  step turning_map csv_turning || exit 1
  step hostile_hands csv_hostile || exit 1
fi
step 'docs/charts' draw || exit 1
step 'README.md, docs' bash "$top/benchmarks/report/fill.sh"
