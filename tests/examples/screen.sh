# What a test sees on the display of xvfb-run that keeps its picture in a file (Xvfb -fbdir FOLDER).  To be sourced.
#
# Clicks at fixed times are lost on a busy machine.  A test therefore goes on when the picture has changed.  It ends where the program $phantom
# has ended, and ctest ends one that waits in vain.

screen= first_pixel= bytes_per_line=

# open_screen FOLDER: Xvfb's file, in the format of xwd: big-endian numbers, a map of colours, pixels of 4 bytes.
open_screen() {
  screen=$1/Xvfb_screen0
  local numbers
  read -ra numbers <<<"$(od -An -tu1 -v -N 80 "$screen" | tr -s '\n ' ' ')"
  number() { echo $((((${numbers[$1]} * 256 + ${numbers[$1 + 1]}) * 256 + ${numbers[$1 + 2]}) * 256 + ${numbers[$1 + 3]})); }
  first_pixel=$(($(number 0) + 12 * $(number 76)))
  bytes_per_line=$(number 48)
}

wait_more() { kill -0 "$phantom"; sleep 0.01; }

# left_of X,Y: the colours of a row of 120 pixels there, beside the pointer, which is drawn, too.
left_of() {
  od -An -tx4 -v -j $((first_pixel + ${1#*,} * bytes_per_line + 4 * (${1%,*} - 150))) -N 480 "$screen"
}

# until_drawn X,Y: there is text.
until_drawn() {
  until [[ $(left_of "$1" | tr -s ' ' '\n' | sort -u | wc -l) -gt 4 ]]; do wait_more; done
}

# until_other X,Y PIXELS: it no longer looks like that.
until_other() {
  while [[ $(left_of "$1") == "$2" ]]; do wait_more; done
}

# until_changed X,Y COMMAND...: the command has changed what is there.
until_changed() {
  local place=$1 before
  shift
  before=$(left_of "$place")
  "$@"
  until_other "$place" "$before"
}
