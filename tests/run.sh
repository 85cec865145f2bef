#!/usr/bin/env bash
# Builds and runs all tests, and installs what is missing for that (Debian; as root or with sudo).
#
#   bash tests/run.sh [--preset NAME] [--folders 'NAME...']
#
#   --preset NAME       one of clang (default: its compiler takes half of the time of g++), release, debug, asan-ubsan, tsan, strict-gcc,
#                       strict-clang, and mingw and aarch64, for other systems, whose programs are emulated; see CMakePresets.json
#   --folders 'NAME...' the tests of these folders of tests/ alone
#   --help              this text
#
# The last line is 'N passed, N failed', with ', N skipped' if there are any.  Exit status 0 only if nothing failed.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"

usage() { sed -n '2,11s/^# \{0,1\}//p' "$0"; }
wrong() { echo "tests/run.sh: $1" >&2; exit 2; }

preset=clang folders=
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --preset) preset=${2-}; shift 2 2>/dev/null || shift ;;
    --preset=*) preset=${1#*=}; shift ;;
    --folders) folders=${2-}; shift 2 2>/dev/null || shift ;;
    *) wrong "'$1': only --preset NAME, --folders 'NAME...' and --help are allowed" ;;
  esac
done
case $preset in
  clang | release | debug | asan-ubsan | tsan | strict-gcc | strict-clang | mingw | aarch64) ;;
  *) wrong "--preset '$preset': must be clang, release, debug, asan-ubsan, tsan, strict-gcc, strict-clang, mingw or aarch64" ;;
esac

targets=(hapbeam_tests) select=()
if [[ -n $folders ]]; then
  read -ra names <<<"$folders"
  targets=("${names[@]/#/test_}") select=(-L "^($(IFS='|'; echo "${names[*]}"))$")
fi

# One test more than there are processors: those in real time wait for most of theirs.
run_tests() {
  (cd "$top" && ctest --preset "$preset" --parallel $(($(nproc) + 1)) "${select[@]}") | grep -vE '^ +Start +[0-9]+:| +Passed +[0-9.]+ sec$'
  return "${PIPESTATUS[0]}"
}

# A display for the window of the example, drawn by software, and a mouse in it; without, those tests are left out.  What counts instructions.
also_needed=(xvfb xauth libgl1-mesa-dri xdotool valgrind)

build "$preset" "${targets[@]}" || { echo '0 passed, 1 failed'; exit 1; }
step "test" run_tests
status=$?

read -r failed total < <(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+)$/\1 \2/p' "$log")
skipped=$(grep -cE '^\s+[0-9]+ - .* \(Skipped\)$' "$log")
if [[ -z ${total:-} ]]; then
  echo '0 passed, 1 failed'
  exit 1
fi
echo "$((total - failed - skipped)) passed, $failed failed$([[ $skipped == 0 ]] || echo ", $skipped skipped")"
exit "$status"
