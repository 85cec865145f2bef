#!/usr/bin/env bash
# Makes the wheel of the package hapbeam for Debian's Python 3, and installs what that takes (Debian; as root or with sudo).
#
#   bash packaging/wheel.sh [FOLDER]     the .whl lands in FOLDER, default build/wheel
#
# jansson comes along in the wheel, under its own licence: where the wheel is installed it needs numpy alone.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"
folder=$(realpath -m "${1:-$top/build/wheel}")
package=$folder/build/bindings/python/hapbeam
need g++ cmake ninja-build libeigen3-dev libjansson-dev pybind11-dev python3-dev || exit 1
configure() {
  cmake -S "$top" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHAPBEAM_BUILD_PYTHON=ON -DHAPBEAM_WITH_JANSSON=ON \
    -DHAPBEAM_BUILD_TESTS=OFF -DHAPBEAM_BUILD_BENCHMARKS=OFF -DHAPBEAM_BUILD_EXAMPLES=OFF -DPython3_EXECUTABLE=/usr/bin/python3 \
    -DCMAKE_MODULE_LINKER_FLAGS=-s -DCMAKE_BUILD_RPATH="\$ORIGIN"
}
jansson() {
  cp -L "$(g++ -print-file-name=libjansson.so.4)" "$package/libjansson.so.4" &&
    cp /usr/share/doc/libjansson4/copyright "$package/LICENSE.jansson"
}
step 'configure' configure &&
  step 'build' cmake --build "$folder/build" --parallel "$(nproc)" --target hapbeam_python &&
  step 'jansson' jansson &&
  /usr/bin/python3 "$top/packaging/wheel.py" "$package" "$(<"$top/packaging/VERSION")" "$folder"
