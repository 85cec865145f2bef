#!/usr/bin/env bash
# choose.sh FOLDER X,Y X,Y PHANTOM OPTION...: a mouse opens a list in the window and chooses from it, and the window is closed once
# the list shows another choice: a model has been trained, or a device is connected.  On a display of its own, whose picture is in FOLDER (screen.sh).
set -eu
source "$(dirname "${BASH_SOURCE[0]}")/screen.sh"
list=$2 entry=$3
open_screen "$1"
shift 3
"$@" &
phantom=$!
trap 'kill "$phantom" 2>/dev/null || true' EXIT
move() { xdotool mousemove "${1%,*}" "${1#*,}"; }

xdotool search --sync --onlyvisible --name '^hapbeam$' >/dev/null
move 1,1
until_drawn "$list"
chosen=$(left_of "$list")
until_changed "$list" move "$list"
until_changed "$entry" xdotool click 1
until_changed "$entry" move "$entry"
until_changed "$entry" xdotool click 1
move 1,1
until_other "$list" "$chosen"
kill -TERM "$phantom"
wait "$phantom"
