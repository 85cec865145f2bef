#!/usr/bin/env bash
# What an open window costs the servo: time of a tick headless and with the window, in turns (Debian; as root or with sudo).
#
#   bash benchmarks/window.sh [--rounds N] [--seconds S]      4 rounds of 10 s each way by default
#
# Without a display one is drawn by software, on the same processors: the worst case.  The last line has the ratio of the
# medians of all rounds.  Needs a quiet machine.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"

rounds=4 seconds=10
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --rounds) rounds=$2 ;;
    --seconds) seconds=$2 ;;
    *) sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 2 ;;
  esac
  shift 2
done

build release phantom || exit 1
screen=()
if [[ -z ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then
  need xvfb xauth libgl1-mesa-dri
  screen=(env LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1 xvfb-run -a -s '-screen 0 1280x720x24')
fi
reports=$(mktemp -d)
trap 'rm -rf "$log" "$reports"' EXIT

# run WHAT ROUND COMMAND...
run() {
  "${@:3}" --scene thesis --duration "$seconds" --report "$reports/$1.$2" >"$log" || { cat "$log"; exit 1; }
  awk -v what="$1" -F '[:,]' '/"(tick_us_p50|tick_us_p99|tick_us_max|missed_ticks|period_us_p99|picture_ms_p50|picture_ms_p99|picture_ms_max)"/ { gsub(/[" ]/, ""); v[$1] = $2 }
    END { printf "%-8s  p50 %6.2f us  p99 %6.2f us  max %8.1f us  period p99 %7.1f us  missed %d%s\n", what, v["tick_us_p50"],
          v["tick_us_p99"], v["tick_us_max"], v["period_us_p99"], v["missed_ticks"],
          "picture_ms_p50" in v ? sprintf("  pictures p50 %.1f ms  p99 %.1f ms  max %.1f ms", v["picture_ms_p50"], v["picture_ms_p99"],
          v["picture_ms_max"]) : "" }' "$reports/$1.$2"
}
for ((round = 1; round <= rounds; ++round)); do
  run headless "$round" "$top/build/release/examples/phantom" --headless
  run window "$round" ${screen[@]+"${screen[@]}"} "$top/build/release/examples/phantom"
done
# The same with scene, model or coupling changed at each picture.
run changes 1 ${screen[@]+"${screen[@]}"} "$top/build/release/examples/phantom" --tour $((60 * seconds))
# median WHAT FIELD
median() {
  sed -n "s/.*\"$2\": \([0-9.e+-]*\).*/\1/p" "$reports/$1".* | sort -g | awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'
}
awk -v h="$(median headless tick_us_p99)" -v w="$(median window tick_us_p99)" \
  'BEGIN { printf "p99: %.2f us headless, %.2f us with the window, %.2f times\n", h, w, w / h }'
