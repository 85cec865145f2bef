#!/usr/bin/env bash
# Fills in what README.md and docs quote from docs/data, or says where they disagree.
#
#   bash benchmarks/report/fill.sh [--check] [--data FOLDER]
#
#   --check         changes nothing; shows what would change, and fails where something would
#   --data FOLDER   the CSV files; default: docs/data
#
# Needs awk and diff alone.  The marks are explained in fill.awk.
set -u
export LC_ALL=C
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
check= data=$top/docs/data
while [[ $# -gt 0 ]]; do
  case $1 in
    --check) check=yes; shift ;;
    --data) data=${2-}; shift 2 2>/dev/null || shift ;;
    *) echo "benchmarks/report/fill.sh: '$1': only --check and --data FOLDER are allowed" >&2; exit 2 ;;
  esac
done
filled=$(mktemp)
trap 'rm -f "$filled"' EXIT

status=0
for page in README.md docs/benchmarks.md docs/limits.md docs/many_beams.md docs/choosing.md docs/architecture.md docs/training.md; do
  report=$top/benchmarks/report
  awk -v data="$data" -v report="$report" -f "$report/numbers.awk" -f "$report/fill.awk" "$top/$page" >"$filled" ||
    { echo "$page: cannot be filled in" >&2; exit 1; }
  if [[ -n $check ]]; then
    diff -u --label "$page" --label "$page, from $data" "$top/$page" "$filled" || status=1
  else
    cmp -s "$filled" "$top/$page" || cp "$filled" "$top/$page"
  fi
done
exit $status
