#!/usr/bin/env bash
# press_with_mouse.sh PHANTOM RECORDING PACE SCENE: a mouse presses a beam in the window, in simulated time.  On a display of its own
# (xvfb-run); PACE [s] is for several pictures.
#   strip   pressed and drawn along with the mouse; then arrow keys press it, and space lifts the hand
#   needle  in space: pressed from above; then from the front, where the wheel takes the hand; then seen from another side
set -eu
pace=$3
rm -f "$2"
# On its way to a series of screenshots, which it does not come to, it draws all pictures, in simulated time.
"$1" --scene "$4" --screenshot never.png --frames 2 --at 3600 --record "$2" &
phantom=$!
trap 'kill "$phantom" 2>/dev/null || true' EXIT
window=$(timeout 60 xdotool search --sync --onlyvisible --name '^hapbeam$' | head -n 1)
# down X Y...: the hand is led along x through the heights y
down() {
  local x=$1 y
  shift
  for y in "$@"; do xdotool mousemove "$x" "$y" sleep "$pace"; done
}
pause() { xdotool sleep "$pace" sleep "$pace"; }

strip() {
  xdotool mousemove 500 100 sleep "$pace" mousedown 1
  down 500 150 200 240 260 280
  down 550 280
  xdotool sleep "$pace" mouseup 1
  pause
  xdotool windowfocus "$window" keydown Down sleep "$pace" sleep "$pace" sleep "$pace" keyup Down key space
  pause
}

needle() {
  xdotool mousemove 625 170 sleep "$pace" mousedown 1 sleep "$pace"
  down 625 190 210 230 250
  xdotool sleep "$pace" mouseup 1 sleep "$pace" windowfocus "$window" key space sleep "$pace"
  pause
  # Toward the observer, down to the needle's height, and into it.
  xdotool click --repeat 14 --delay 10 5
  pause
  xdotool mousemove 625 200 mousedown 1 sleep "$pace"
  down 625 240 280 300
  xdotool mouseup 1 sleep "$pace" click --repeat 9 --delay 10 4
  pause
  xdotool mousemove 700 300 mousedown 3 mousemove 640 320 sleep "$pace" mouseup 3
}

"$4"
kill -TERM "$phantom"
wait "$phantom"
