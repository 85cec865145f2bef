#!/usr/bin/env bash
# save_scene.sh PHANTOM X,Y: a mouse presses the button at that place, which saves the scene.  The file that the window has written gives the
# same forces as the scene.  On a display of its own (xvfb-run).
set -eu
phantom=$1 button=$2
rm -rf save_scene && mkdir save_scene && cd save_scene
"$phantom" --scene string >/dev/null & run=$!
trap 'kill "$run" 2>/dev/null || true' EXIT
xdotool search --sync --onlyvisible --name '^hapbeam$' >/dev/null
xdotool mousemove "${button%,*}" "${button#*,}"
until [[ -s string.json ]]; do
  kill -0 "$run"
  xdotool mousedown 1 sleep 0.2 mouseup 1 sleep 0.5
done
kill -TERM "$run"
wait "$run"
for scene in string string.json; do "$phantom" --scene "$scene" --headless --lock-step --duration 2 --record "$scene.csv" >/dev/null; done
cmp string.csv string.json.csv
