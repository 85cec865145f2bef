#!/usr/bin/env bash
# Compiles a program against what is installed, with the flags that pkg-config names.
#
#   bash tests/consumer/pkg_config.sh COMPILER PREFIX MODEL_FILES VERSION
set -eu
compiler=$1 prefix=$2 model_files=$3 version=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export PKG_CONFIG_PATH=$prefix/share/pkgconfig
[[ $(pkg-config --modversion hapbeam) == "$version" ]]
read -ra flags < <(pkg-config --cflags hapbeam)
program=$(mktemp)
trap 'rm -f "$program"' EXIT
"$compiler" -std=c++17 "${flags[@]}" "$here/main.cpp" -o "$program"
"$program"
if [[ $model_files == ON ]]; then
  pkg-config --libs hapbeam-model-file | grep -q -- -ljansson
else
  ! pkg-config --exists hapbeam-model-file
fi
