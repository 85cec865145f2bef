#!/usr/bin/env bash
# interrupt.sh [--window] PROGRAM OPTION...: Ctrl-C, once the program listens to it (Linux: /proc), and has opened its window if it has one.
set -eu
window=
if [[ $1 == --window ]]; then window=1; shift; fi
"$@" &
program=$!
trap 'kill "$program" 2>/dev/null || true' EXIT
# Signal 2 is the second bit of the mask of those that are caught.
caught() { sed -n 's/^SigCgt:\t/0x/p' "/proc/$program/status"; }
until (($(caught) & 2)); do kill -0 "$program"; sleep 0.01; done
[[ -z $window ]] || xdotool search --sync --onlyvisible --name '^hapbeam$' >/dev/null
kill -INT "$program"
wait "$program"
