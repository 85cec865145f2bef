#!/usr/bin/env bash
# Draws docs/images/scene_*.png from the program itself, on a display that nobody sees (Debian; as root or with sudo).
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../../cmake/steps.sh"

need xvfb xauth libgl1-mesa-dri fonts-dejavu-core libglfw3-dev libimgui-dev libgl-dev
build release phantom || exit 1

# picture SCENE SECONDS: when there is most to see.
picture() {
  step "scene_$1.png" env LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1 xvfb-run -a -s '-screen 0 1280x720x24' \
    "$top/build/release/examples/phantom" --scene "$1" --screenshot "$top/docs/images/scene_$1.png" --at "$2"
}
picture thesis 3.5 && picture ruler 1.5 && picture strip 3.5 && picture string 4.5 && picture arch 1.75
