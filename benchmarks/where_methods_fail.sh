#!/usr/bin/env bash
# Measures where methods fail, draws the charts of docs/where_methods_fail.md and fills in its tables.  Installs what is
# missing for that (Debian; as root or with sudo).
#
#   bash benchmarks/where_methods_fail.sh [--program FILE] [--check]
#
#   --program FILE   where_methods_fail, built already; default: builds it
#   --check          measures nothing; fails where the page does not say what docs/data/where_methods_fail.csv says
#   --help           this text
#
# Nothing is timed, and but for round-off the numbers are the same on every machine.  Takes half a minute after the build.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"

usage() { sed -n '2,12s/^# \{0,1\}//p' "$0"; }
wrong() { echo "benchmarks/where_methods_fail.sh: $1" >&2; exit 2; }

program= check=
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --program) program=${2-}; shift 2 2>/dev/null || shift ;;
    --check) check=yes; shift ;;
    *) wrong "'$1': only --program FILE, --check and --help are allowed" ;;
  esac
done
kept=$top/docs/data
page=$top/docs/where_methods_fail.md

# The page with its tables as the CSV has them: the second column of those of failures, and all of the others.
filled() {
  awk -F'"' '
    NR == FNR {
      failure = $1; sub(/,$/, "", failure)
      if ($2 == "begins") begins[failure] = $4
      else if (FNR > 1) rows[failure] = rows[failure] "| " $2 " | " $4 " | " $6 " |\n"
      next
    }
    /^<!-- measured: begins -->/ { overview = 1 }
    /^<!-- end -->/ { overview = skip = 0 }
    overview && /^\| / && !/^\| failure / {
      count = split($0, cell, / \| /)
      key = tolower(substr(cell[1], 3)); gsub(/ /, "-", key)
      if (!(key in begins)) { print key ": not measured" >"/dev/stderr"; exit 1 }
      cell[2] = begins[key]
      line = cell[1]
      for (k = 2; k <= count; ++k) line = line " | " cell[k]
      print line
      next
    }
    /^<!-- measured: / && !overview {
      key = $0; sub(/^<!-- measured: /, "", key); sub(/ -->$/, "", key)
      if (!(key in rows)) { print key ": not measured" >"/dev/stderr"; exit 1 }
      print $0 "\n\n| | naive | hapbeam |\n|---|---|---|\n" rows[key]
      skip = 1
      next
    }
    !skip' "$kept/where_methods_fail.csv" "$page"
}
if [[ -n $check ]]; then
  filled | diff - "$page" && exit 0
  echo "$page: must be filled in by benchmarks/where_methods_fail.sh" >&2
  exit 1
fi

need gnuplot-nox || exit 1
if [[ -z $program ]]; then
  build release where_methods_fail || exit 1
  program=$top/build/release/benchmarks/where_methods_fail
fi
data=$(mktemp -d)
trap 'rm -rf "$log" "$data"' EXIT

draw() {
  gnuplot -e "data = '$kept'; charts = '$top/docs/charts'" "$top/benchmarks/where_methods_fail.gp" &&
    sed -i -E 's:<(title|desc)>[^<]*</(title|desc)>::' "$top"/docs/charts/fail_*.svg  # gnuplot's expressions
}
fill_in() { filled >"$data/page" && cp "$data/page" "$page"; }

step measure "$program" "$data" || exit 1
step 'keep docs/data' cp "$data"/*.csv "$kept" || exit 1
step 'draw docs/charts' draw || exit 1
step 'fill in docs/where_methods_fail.md' fill_in
