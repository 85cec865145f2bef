#!/usr/bin/env bash
# press_in_space.sh PHANTOM RECORDING PACE: a mouse presses the needle from above, takes the hand to the front of it, and presses
# there with the wheel, in simulated time.  On a display of its own (xvfb-run); PACE [s] is for several pictures.
set -eu
rm -f "$2"
"$1" --scene needle --screenshot never.png --at 3600 --record "$2" &
phantom=$!
trap 'kill "$phantom" 2>/dev/null || true' EXIT
window=$(timeout 60 xdotool search --sync --onlyvisible --name '^hapbeam$' | head -n 1)
# The hand is led above the needle and down; space takes it off.
xdotool mousemove 625 170 sleep "$3" mousedown 1 sleep "$3"
for y in 190 210 230 250; do xdotool mousemove 625 "$y" sleep "$3"; done
xdotool sleep "$3" mouseup 1 sleep "$3" windowfocus "$window" key space sleep "$3" sleep "$3" sleep "$3"
# Toward who looks, down to the needle's height, and into it.
xdotool click --repeat 14 --delay 10 5 sleep "$3" sleep "$3" mousemove 625 200 mousedown 1 sleep "$3"
for y in 240 280 300; do xdotool mousemove 625 "$y" sleep "$3"; done
xdotool mouseup 1 sleep "$3"
xdotool click --repeat 9 --delay 10 4 sleep "$3" sleep "$3" mousemove 700 300 mousedown 3 mousemove 640 320 sleep "$3" mouseup 3
kill -TERM "$phantom"
wait "$phantom"
