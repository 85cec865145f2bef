#!/usr/bin/env bash
# choose.sh PACE X,Y X,Y PHANTOM OPTION...: a mouse opens a list in the window and chooses from it, and the window is closed once
# a model may have been trained.  On a display of its own (xvfb-run); PACE [s] is for several pictures.
set -eu
pace=$1 list=$2 entry=$3
shift 3
"$@" &
phantom=$!
trap 'kill "$phantom" 2>/dev/null || true' EXIT
timeout 60 xdotool search --sync --onlyvisible --name '^hapbeam$' >/dev/null
for place in "$list" "$entry"; do
  xdotool mousemove "${place%,*}" "${place#*,}" sleep "$pace" mousedown 1 sleep "$pace" mouseup 1 sleep "$pace"
done
for _ in {1..30}; do sleep "$pace"; done
kill -TERM "$phantom"
wait "$phantom"
