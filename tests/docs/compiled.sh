#!/usr/bin/env bash
# Fails where docs/data/compile_cost.csv, which docs/benchmarks.md quotes, has a header that is gone, or lacks one.
#
#   bash tests/docs/compiled.sh [--headers FOLDER]
#
#   --headers FOLDER   default: include/hapbeam
#
# The headers of other programs and of the vendor's kit cannot be compiled without them.
set -u
export LC_ALL=C
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
headers=$top/include/hapbeam
[[ ${1-} != --headers ]] || headers=$2
measured() { sed -nE 's/^hapbeam\/(.*\.hpp),.*/\1/p' "$top/docs/data/compile_cost.csv" | sort; }
present() {
  find "$headers" -name '*.hpp' -printf '%P\n' | grep -vE '^(hosts/(chai3d|hapi|sofa)|haptics/hdapi/openhaptics)\.hpp$' | sort
}
gone=$(comm -23 <(measured) <(present)) new=$(comm -13 <(measured) <(present))
[[ -z $gone ]] || printf 'measured, but not there: %s\n' $gone
[[ -z $new ]] || printf 'not measured: %s\n' $new
[[ -z $gone$new ]] || { echo 'bash benchmarks/run.sh --only compile_cost measures them'; exit 1; }
echo "$(measured | wc -l) headers"
