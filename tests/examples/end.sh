#!/usr/bin/env bash
# end.sh PHANTOM END OPTION...: phantom runs in real time and is ended in one of the ways that it can see. The loop has been stopped then,
# and recording, report and summary are whole.
#   INT TERM HUP QUIT        this signal
#   reader full              nobody reads its output; the disk of its output is full
#   server window destroyed  in the window: the X server is gone; the window is taken from it, or destroyed
set -eu
phantom=$1 end=$2
shift 2
name=end_$end$(printf '%s' "$@" | tr -cd 'a-z')
rm -rf "$name" && mkdir "$name" && cd "$name"
fail() { echo "$end: $1" && cat out err && exit 1; }
# It runs, and the first ticks have been written.
until_it_runs() {
  until [[ $(wc -l 2>/dev/null <record.csv) -gt 1 ]]; do
    kill -0 "$run" || fail "it does not run"
    sleep 0.05
  done
}
options=(--duration 3600 --record record.csv --report report.json "$@")
touch out err
status=0 expected=0 summary=1
case $end in
  INT | TERM | HUP | QUIT)
    "$phantom" --headless "${options[@]}" >out 2>err & run=$!
    until_it_runs
    kill -"$end" "$run"
    wait "$run" || status=$? ;;
  reader)
    expected=1 summary=0
    { "$phantom" --headless "${options[@]}" 2>err || echo $? >status; } | head -n 3 >out
    status=$(cat status) ;;
  full)
    expected=1 summary=0
    "$phantom" --headless "${options[@]}" >/dev/full 2>err || status=$? ;;
  server | window | destroyed)
    expected=1
    trap 'kill "$server" 2>/dev/null || true' EXIT
    Xvfb -displayfd 3 -screen 0 1280x720x24 -nolisten tcp 3>display 2>/dev/null & server=$!
    until [[ -s display ]]; do kill -0 "$server" || fail "no X server"; sleep 0.05; done
    export DISPLAY=:$(cat display)
    "$phantom" "${options[@]}" >out 2>err & run=$!
    window=$(timeout 60 xdotool search --sync --onlyvisible --name '^hapbeam$' | head -n 1)
    until_it_runs
    case $end in
      server) kill -KILL "$server" ;;
      window) xdotool windowkill "$window" ;;
      destroyed) xdotool windowclose "$window" ;;
    esac
    wait "$run" || status=$? ;;
esac
[[ $status == "$expected" ]] || fail "exit status $status, not $expected"
grep -qE '"ticks": *[1-9]' report.json && [[ $(tail -c 2 report.json) == "}" ]] || fail "the report is not whole"
[[ $summary == 0 ]] || grep -qE '^interrupted after [1-9][0-9]* ticks' out || fail "there is no summary"
grep -qE '"interrupted": *true' report.json || fail "the report does not say that it was interrupted"
[[ $(tail -c 1 record.csv | wc -l) == 1 ]] || fail "the recording is cut off"
[[ $summary == 1 ]] || grep -q "^phantom: the output cannot be written$" err || fail "it does not say what could not be written"
! grep -q "motors are on" err || fail "the motors are on"
