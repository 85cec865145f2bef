#!/usr/bin/env bash
# choose_pod.sh PACE PHANTOM OPTION...: a mouse chooses POD in the list of models, and the window is closed once that may have
# been trained.  On a display of its own (xvfb-run); PACE [s] is for several pictures.
set -eu
pace=$1
shift
"$@" &
phantom=$!
trap 'kill "$phantom" 2>/dev/null || true' EXIT
timeout 60 xdotool search --sync --onlyvisible --name '^hapbeam$' >/dev/null
click() { xdotool mousemove "$1" "$2" sleep "$pace" mousedown 1 sleep "$pace" mouseup 1 sleep "$pace"; }
click 1170 170
click 1170 290
for _ in {1..30}; do sleep "$pace"; done
kill -TERM "$phantom"
wait "$phantom"
