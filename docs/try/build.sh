#!/usr/bin/env bash
# Builds the page to try, and installs what is missing for that (Debian; as root or with sudo).
#
#   bash docs/try/build.sh        then open docs/try/index.html, or put docs/try on any static host
#
# Writes docs/try/built.js: the library's headers under the page's beams, as WebAssembly.  It is not kept in the repository, for
# it would be older than the headers.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../../cmake/steps.sh"

page=$top/docs/try
folder=$top/build/try
beams() {
  em++ -std=c++17 -O3 -DNDEBUG -I "$top/include" -isystem /usr/include/eigen3 "$page/exports.cpp" \
    -o "$folder/beams.wasm" --no-entry -sALLOW_MEMORY_GROWTH=1
}
# Where a host builds it, the page links the project there.
project=${GITHUB_REPOSITORY:+$GITHUB_SERVER_URL/$GITHUB_REPOSITORY}
pack() { printf 'const hapbeamWasm = "%s", hapbeamProject = "%s";\n' "$(base64 -w 0 "$folder/beams.wasm")" "$project" >"$page/built.js"; }

mkdir -p "$folder"
need emscripten libeigen3-dev &&
  step 'compile the beams to WebAssembly' beams &&
  pack &&
  printf 'docs/try/built.js: %d kB, %d kB compressed\n' $(($(wc -c <"$page/built.js") / 1000)) $(($(gzip -9c "$folder/beams.wasm" | wc -c) / 1000))
