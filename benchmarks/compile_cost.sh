#!/usr/bin/env bash
# What the compiler pays for a trained model: seconds of user time for a file that loads one and presses it, beside a file
# that includes Eigen/Core and nothing else.  Median of 5, taken in turn.  Asserts nothing.
#
#   benchmarks/compile_cost.sh [compiler = $CXX or g++] [folder of Eigen = /usr/include/eigen3]
set -eu
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
compiler=${1:-${CXX:-g++}} eigen=${2:-/usr/include/eigen3}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

echo '#include <Eigen/Core>' >"$folder/eigen.cpp"
cat >"$folder/model.cpp" <<'CPP'
#include <hapbeam/rom/model_file.hpp>

int main(int, char** arguments) {
  auto model = hapbeam::load_model<hapbeam::PodModel<>>(arguments[1]);
  return model.press({1.0, 0.01}).force > 0;
}
CPP

seconds() {
  local TIMEFORMAT=%U
  { time "$compiler" -std=c++17 -O2 -I "$top/include" -isystem "$eigen" -c "$folder/$1.cpp" -o "$folder/$1.o"; } 2>&1
}

for _ in 1 2 3 4 5; do
  for file in eigen model; do seconds "$file" >>"$folder/$file"; done
done
median() { sort -n "$folder/$1" | sed -n 3p; }

printf '%s\n' "$("$compiler" --version | head -n 1), -std=c++17 -O2, $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)"
printf '%-44s %6.2f s\n' 'Eigen/Core' "$(median eigen)" 'load a PodModel and press it' "$(median model)"
awk -v a="$(median model)" -v b="$(median eigen)" 'BEGIN { printf "%-44s %6.2f\n", "ratio", a / b }'
