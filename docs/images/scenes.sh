#!/usr/bin/env bash
# Draws docs/images/scene_*.png and the animated pictures from the program itself, on a display that nobody sees, and the small pictures
# that tests compare the window with (Debian; as root or with sudo).  Look at them before they are kept.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../../cmake/steps.sh"

need xvfb xauth libgl1-mesa-dri fonts-dejavu-core libglfw3-dev libimgui-dev libgl-dev imagemagick
build release compare_pictures && DISPLAY=:0 build examples phantom || exit 1
images=$top/docs/images

# draw SCENE FILE OPTION...
draw() {
  LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1 xvfb-run -a -s '-screen 0 1280x720x24' \
    "$top/build/examples/examples/phantom" --scene "$1" --screenshot "$2" "${@:3}"
}
# picture SCENE SECONDS [FILE OPTION...]: when there is most to see; tests/examples/window.cmake names the same times.
picture() {
  local file=${3:-scene_$1}
  step "$file.png" draw "$1" "$images/$file.png" --at "$2" "${@:4}" &&
    "$top/build/release/tests/examples/compare_pictures" reduce "$images/$file.png" "$top/tests/examples/pictures/${file#scene_}.png"
}
# The arch snaps through: 1.9 s at their own pace, then the last picture for one and a half.
animation() {
  local frames
  frames=$(mktemp -d)
  draw arch "$frames/frame.png" --at 0.7 --frames 38 &&
    convert -loop 0 -delay 5 "$frames"/frame_0[0-2]*.png "$frames"/frame_03[0-6].png -delay 150 "$frames/frame_037.png" \
      -resize 768x -dither None -colors 96 -layers Optimize "$images/arch.gif"
  local status=$?
  rm -r "$frames"
  return "$status"
}

# A scene in motion: every second picture, at its own pace; the drawing alone.
#   moving SCENE DURATION FRAMES
moving() {
  local frames
  frames=$(mktemp -d)
  draw "$1" "$frames/frame.png" --duration "$2" --at 0.1 --frames "$3" &&
    convert -loop 0 -delay 10 "$frames"/frame_*[02468].png -crop 990x466+5+5 +repage -resize 640x -dither None -colors 64 \
      -layers Optimize "$images/$1.gif"
  local status=$?
  rm -r "$frames"
  return "$status"
}

# The hand leans on the ruler without friction and with it, side by side: 1.9 s at their own pace, the drawing alone.
rubbed() {
  local frames k mu
  frames=$(mktemp -d)
  for mu in 0 0.6; do
    draw ruler "$frames/$mu.png" --friction "$mu" --at 0.8 --frames 38 &&
      mogrify -crop 480x420+290+40 +repage -font DejaVu-Sans -pointsize 18 -fill gray30 -annotate +330+40 "μ = $mu" "$frames/$mu"_*.png || return 1
  done
  for k in "$frames"/0_*.png; do convert "$k" "${k/0_/0.6_}" +append +repage "$frames/both_${k##*_}" || return 1; done
  convert -loop 0 -delay 5 "$frames"/both_*.png -resize 768x -dither None -colors 64 -layers Optimize "$images/friction.gif"
  local status=$?
  rm -r "$frames"
  return "$status"
}

mkdir -p "$top/tests/examples/pictures"
picture thesis 3.5 && picture ruler 1.6 && picture strip 3.5 && picture string 4.5 && picture arch 1.75 && picture comb 2 &&
  picture needle 1.2 && picture hook 4.1 && picture fishing-rod 7.2 && picture probe 2.4 && picture catheter 4.5 && picture knot 4 &&
  picture arch 1.4 two_hands --hands 2 && picture ruler 3.2 twang --element with-mass && step arch.gif animation && step needle.gif moving needle 7 120 &&
  step knot.gif moving knot 5 88 && step friction.gif rubbed
