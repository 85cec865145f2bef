#!/usr/bin/env bash
# What a compiler's flags do to a tick: ticks.cpp compiled with each combination of -O2 and -O3, -march=native and -DNDEBUG, and run
# in turn, five times.  Prints CSV: the median, and how many times the compiler's best it takes.  Asserts nothing.
#
#   benchmarks/flags.sh [compiler... = g++ clang++, where installed]
set -eu
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
compilers=("$@")
[[ ${#compilers[@]} -gt 0 ]] || for compiler in g++ clang++; do
  ! command -v $compiler >/dev/null || compilers+=($compiler)
done

cat >"$folder/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.16)
project(eigen NONE)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
get_target_property(folder Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
file(WRITE $folder/eigen "\${folder}")
CMAKE
cmake -S "$folder" -B "$folder/build" >"$folder/log" || { cat "$folder/log" >&2; exit 1; }
eigen=$(<"$folder/eigen")

variants() {
  local compiler level native debug several
  for compiler in "${compilers[@]}"; do
    for several in '' -DHAPBEAM_SEVERAL; do
      for level in -O2 -O3; do
        for native in '' -march=native; do
          for debug in '' -DNDEBUG; do echo "$compiler,$level${native:+ $native}${debug:+ $debug},$several"; done
        done
      done
    done
  done
}

k=0
while IFS=, read -r compiler flags several; do
  # shellcheck disable=SC2086
  "$compiler" -std=c++17 $flags $several -I "$top/include" -isystem "$eigen" -pthread "$top/benchmarks/flags/ticks.cpp" \
    -o "$folder/ticks_$k" &
  k=$((k + 1))
  [[ $(jobs -r | wc -l) -lt $(nproc) ]] || wait -n
done < <(variants)
wait
for _ in 1 2 3 4 5; do
  k=0
  while IFS=, read -r compiler flags several; do
    "$folder/ticks_$k" | while read -r model us _; do
      [[ $model == VonKarman || $model == Corotational || $model == *Rod ]] &&
        echo "$compiler,$model${several:+ beside others},$flags,$us"
    done >>"$folder/us" || true
    k=$((k + 1))
  done < <(variants)
done

echo "# $(for compiler in "${compilers[@]}"; do "$compiler" --version | head -n 1; done | paste -sd ';' | sed 's/;/; /g'), $(
  sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)"
echo 'compiler,model,flags,tick_us,over_best'
# The median of five of each, in the order of the first.
awk -F, '
  { key = $1 "," $2 "," $3; if (!(key in count)) order[++n] = key; value[key, ++count[key]] = $4 }
  function median(key,  i, j, t) {
    for (i = 2; i <= count[key]; ++i)
      for (j = i; j > 1 && value[key, j - 1] + 0 > value[key, j] + 0; --j) {
        t = value[key, j]; value[key, j] = value[key, j - 1]; value[key, j - 1] = t
      }
    return value[key, int((count[key] + 1) / 2)]
  }
  END {
    for (i = 1; i <= n; ++i) {
      us[i] = median(order[i])
      split(order[i], part, ",")
      group[i] = part[1] "," part[2]
      if (!(group[i] in best) || us[i] < best[group[i]]) best[group[i]] = us[i]
    }
    for (i = 1; i <= n; ++i) printf "%s,%.3f,%.2f\n", order[i], us[i], us[i] / best[group[i]]
  }' "$folder/us"
