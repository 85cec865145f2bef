#!/usr/bin/env bash
# press_with_mouse.sh PHANTOM RECORDING SCENE: a mouse presses a beam in the window, in simulated time.  On a display of its own
# (xvfb-run).  After each of its motions the mouse waits for pictures: the recording grows by 50 ticks from one to the next.
#   strip   pressed and drawn along with the mouse; then arrow keys press it, and space lifts the hand
#   needle  in space: pressed from above; then from the front, where the wheel takes the hand; then seen from another side
set -eu
recording=$2
rm -f "$recording"
# On its way to a series of screenshots, which it does not come to, it draws all pictures, in simulated time.
"$1" --scene "$3" --screenshot never.png --frames 2 --at 3600 --record "$recording" &
phantom=$!
trap 'kill "$phantom" 2>/dev/null || true' EXIT
window=$(xdotool search --sync --onlyvisible --name '^hapbeam$' | head -n 1)

wait_more() { kill -0 "$phantom"; sleep 0.01; }
ticks() { wc -l <"$recording"; }
# pictures N: that many more have been drawn; the first one may have begun before what it is to show.
pictures() {
  local enough=$(($(ticks) + 50 * ($1 + 1)))
  while [[ $(ticks) -lt $enough ]]; do wait_more; done
}
mouse() { xdotool "$@"; pictures 3; }
# down X Y...: the hand is led along x through the heights y
down() {
  local x=$1 y
  shift
  for y in "$@"; do mouse mousemove "$x" "$y"; done
}

strip() {
  mouse mousemove 500 100
  mouse mousedown 1
  down 500 150 200 240 260 280
  down 550 280
  mouse mouseup 1
  xdotool windowfocus --sync "$window" keydown Down
  pictures 9
  xdotool keyup Down
  mouse key space
  pictures 6
}

needle() {
  mouse mousemove 625 170
  mouse mousedown 1
  down 625 190 210 230 250
  mouse mouseup 1
  xdotool windowfocus --sync "$window"
  mouse key space
  pictures 6
  # Toward the observer, down to the needle's height, and into it.
  mouse click --repeat 14 --delay 10 5
  pictures 6
  mouse mousemove 625 200
  mouse mousedown 1
  down 625 240 280 300
  mouse mouseup 1
  mouse click --repeat 9 --delay 10 4
  pictures 6
  mouse mousemove 700 300
  mouse mousedown 3
  mouse mousemove 640 320
  mouse mouseup 3
}

until [[ -e $recording ]]; do wait_more; done
pictures 1
"$3"
kill -TERM "$phantom"
wait "$phantom"
