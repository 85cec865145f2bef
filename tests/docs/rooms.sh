#!/usr/bin/env bash
# Arrows go one way: fails where a public header includes one that its room may not see, or where folders and rooms disagree.
#
#   bash tests/docs/rooms.sh [--headers FOLDER]
#
#   --headers FOLDER   default: include/hapbeam
#
# The rooms and their order are docs/data/rooms.csv, which docs/architecture.md quotes.  hapbeam.hpp is the door to all of them.
# Needs awk alone.
set -u
export LC_ALL=C
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
headers=$top/include/hapbeam
while [[ $# -gt 0 ]]; do
  case $1 in
    --headers) headers=${2-}; shift 2 2>/dev/null || shift ;;
    *) echo "tests/docs/rooms.sh: '$1': only --headers FOLDER is allowed" >&2; exit 2 ;;
  esac
done
cd "$headers" || exit 2
find . -name '*.hpp' ! -path ./hapbeam.hpp -printf '%P\n' | sort | awk -v rooms="$top/docs/data/rooms.csv" '
  function wrong(what) { print what; ++faults }
  # The room of a header: the one that names it, or the longest folder that holds it.
  function room_of(path,  folder) {
    if (path in file_room) return file_room[path]
    for (folder = path; sub(/\/?[^\/]*\/?$/, "/", folder) && folder != "/"; sub(/\/$/, "", folder))
      if (folder in file_room) return file_room[folder]
    return ""
  }
  BEGIN {
    while ((getline line < rooms) > 0) {
      if (line ~ /^#/ || line ~ /^room,/) continue
      split(line, part, ",")
      room = part[1]
      n = split(part[3], seen, " ")
      for (k = 1; k <= n; ++k) {
        if (!(seen[k] in known)) wrong("rooms.csv: " room " may include " seen[k] ", which does not stand above it")
        may[room, seen[k]] = 1
      }
      n = split(part[2], held, " ")
      for (k = 1; k <= n; ++k) file_room[held[k]] = room
      known[room] = may[room, room] = 1
    }
    if (!length(known)) wrong("no rooms in " rooms)
  }
  {
    from = room_of($0)
    if (from == "") { wrong($0 ": no room of rooms.csv holds it"); next }
    filled[from] = 1
    while ((getline line < $0) > 0) {
      if (line !~ /^[ \t]*#[ \t]*include[ \t]*<hapbeam\//) continue
      sub(/^[^<]*<hapbeam\//, "", line)
      sub(/>.*$/, "", line)
      to = line == "hapbeam.hpp" ? "hapbeam.hpp" : room_of(line)
      ++arrows
      if (!((from, to) in may)) wrong($0 " includes " line ": " from " may not include " to)
    }
    close($0)
  }
  END {
    for (room in known) if (!(room in filled)) wrong("rooms.csv: " room " holds no header")
    if (faults) exit 1
    print arrows " includes, all along the arrows"
  }'
