#!/usr/bin/env bash
# Tests the page to try in headless Chromium, and installs what is missing for that (Debian; as root or with sudo).
#
#   bash docs/try/test.sh
#
# Builds the page and a native program of the same source, presses the page by script with mouse and finger, and compares the forces of both.
# build/try has screenshots of the widths of a desktop and a phone: look at them.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../../cmake/steps.sh"

folder=$top/build/try
native() {
  g++ -std=c++17 -O2 -DNDEBUG -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I "$top/include" -isystem /usr/include/eigen3 -pthread \
    "$top/docs/try/native.cpp" -o "$folder/native" && "$folder/native" >"$folder/native.json"
}

need g++ nodejs chromium libeigen3-dev &&
  bash "$top/docs/try/build.sh" &&
  step 'the same natively' native &&
  exec node "$top/docs/try/test.js" "$folder/native.json" "$folder"
