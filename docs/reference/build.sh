#!/usr/bin/env bash
# Builds the reference of the public headers, with the pages, and installs Doxygen for that (Debian; as root or with sudo).
#
#   bash docs/reference/build.sh        writes build/reference/html/index.html
#
# A warning is an error.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../../cmake/steps.sh"

folder=$top/build/reference
reference() {
  cd "$top" && rm -rf "$folder" && mkdir -p "$folder" || return
  # Pages of the same name as the main page are there too: it is named by its whole path.
  { cat docs/reference/Doxyfile && printf 'USE_MDFILE_AS_MAINPAGE = %s/README.md\n' "$top"; } | doxygen - || return
  cat "$folder/warnings.txt"
  [[ ! -s $folder/warnings.txt ]]
}

need doxygen && step 'build/reference/html/index.html' reference
