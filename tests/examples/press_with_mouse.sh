#!/usr/bin/env bash
# press_with_mouse.sh PHANTOM RECORDING PACE: a mouse presses the strip in the window and draws along it, in simulated time; then
# arrow keys press it, and space lifts the hand.  On a display of its own (xvfb-run); PACE [s] is for several pictures.
set -eu
rm -f "$2"
"$1" --scene strip --screenshot never.png --at 3600 --record "$2" &
phantom=$!
trap 'kill "$phantom" 2>/dev/null || true' EXIT
window=$(timeout 60 xdotool search --sync --onlyvisible --name '^hapbeam$' | head -n 1)
# In the drawing, above the middle of the strip; down, and along it.
xdotool mousemove 500 100 sleep "$3" mousedown 1
for y in 150 200 240 260 280; do xdotool mousemove 500 "$y" sleep "$3"; done
xdotool mousemove 550 280 sleep "$3" sleep "$3" mouseup 1 sleep "$3" sleep "$3"
xdotool windowfocus "$window" keydown Down sleep "$3" sleep "$3" sleep "$3" keyup Down key space sleep "$3" sleep "$3"
kill -TERM "$phantom"
wait "$phantom"
