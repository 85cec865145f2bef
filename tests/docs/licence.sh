#!/usr/bin/env bash
# Fails where a header, which may be copied by itself, does not begin with its licence.
#
#   bash tests/docs/licence.sh [--headers FOLDER]
#
#   --headers FOLDER   default: include/hapbeam
set -u
headers=$(dirname "${BASH_SOURCE[0]}")/../../include/hapbeam
while [[ $# -gt 0 ]]; do
  case $1 in
    --headers) headers=${2-}; shift 2 2>/dev/null || shift ;;
    *) echo "tests/docs/licence.sh: '$1': only --headers FOLDER is allowed" >&2; exit 2 ;;
  esac
done
cd "$headers" || exit 2
find . -name '*.hpp' -printf '%P\n' | sort | {
  count=0 faults=0
  while read -r header; do
    count=$((count + 1))
    read -r first <"$header"
    [[ $first == '// SPDX-License-Identifier: MIT' ]] || { echo "$header: does not begin with its licence"; faults=$((faults + 1)); }
  done
  echo "$count headers"
  [[ $faults == 0 && $count -gt 0 ]]
}
