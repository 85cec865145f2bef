#!/usr/bin/env bash
# replay_parts.sh PHANTOM: recordings that are cut off anywhere, or spoiled, are errors that name the line; a gap of a day is held, and
# takes no memory.
set -eu
phantom=$1
rm -rf replay_parts && mkdir replay_parts && cd replay_parts
"$phantom" --headless --lock-step --duration 1 --record whole.csv >/dev/null
head -n 4 whole.csv >start.csv
row=$(sed -n 3p start.csv)
wrong=0
# expect LINE FILE: it is rejected, and the message names the line; 0: it is replayed.
expect() {
  local status=0 message
  message=$("$phantom" --headless --replay "$2" 2>&1 >/dev/null) || status=$?
  if [[ $1 == 0 ]]; then [[ $status == 0 ]] && return
  else [[ $status == 1 && $message == "phantom: $2, line $1: "* ]] && return; fi
  echo "$2, which ends with '$(tail -n 1 "$2")': status $status: $message"
  wrong=$((wrong + 1))
}
expect 0 whole.csv
expect 0 start.csv
# Cut in the last row, at each of its characters.
for ((n = 1; n <= ${#row}; ++n)); do
  { head -n 2 start.csv; printf '%s' "${row:0:n}"; } >cut.csv
  expect 3 cut.csv
done
# The same with a newline behind it: what is left of a row in the middle of a file. Without its last letters only the name of a status is another.
for ((n = 0; n < ${#row}; ++n)); do
  [[ $(tr -cd , <<<"${row:0:n}") == $(tr -cd , <<<"$row") ]] && break
  { head -n 2 start.csv; printf '%s\n' "${row:0:n}"; } >cut.csv
  expect 3 cut.csv
done
# One column of the hand is no number, or none that a hand can have.
for column in 1 2 3 4 5 6 7; do
  for value in '' nan inf -inf 1e400 1e9 -1e9 0.1x ' ' '0.1 0.1'; do
    awk -F, -v OFS=, -v c="$column" -v v="$value" 'NR == 3 { $c = v } 1' start.csv >spoiled.csv
    expect 3 spoiled.csv
  done
done
# Times that go back or stand still.
for time in -1 -0.001 0 86400; do
  awk -F, -v OFS=, -v t="$time" 'NR == 3 { $1 = t } 1' start.csv >spoiled.csv
  expect 3 spoiled.csv
done
# A gap: the hand stays. Half a second of it is replayed to its end; a day takes as little memory.
awk -F, -v OFS=, 'NR == 4 { $1 = "0.5" } 1' start.csv >gap.csv
expect 0 gap.csv
awk -F, -v OFS=, 'NR == 4 { $1 = "86399.999" } 1' start.csv >day.csv
"$phantom" --headless --replay day.csv >out 2>err & run=$!
until grep -q '^ *1[.]00 ' out; do kill -0 "$run" || { cat out err; exit 1; }; sleep 0.05; done
memory=$(awk '/^VmHWM/ { print $2 }' "/proc/$run/status")
kill -INT "$run"
wait "$run"
[[ $memory -lt 1000000 ]] || { echo "a gap of a day takes $memory kB"; wrong=$((wrong + 1)); }
[[ $wrong == 0 ]]
