#!/usr/bin/env bash
# What the compiler pays: seconds of processor time for a file that includes one public header and nothing else, for each
# header, and for each program of README.md, beside a file that includes <Eigen/Core> and nothing else.  Writes CSV.
# Asserts nothing.
#
#   benchmarks/compile_cost.sh [rounds = 3] [compiler = $CXX or g++] [folder of Eigen = /usr/include/eigen3]
#
# A time is the least of the rounds.  In each round <Eigen/Core> is compiled again before every tenth file, and a ratio is to
# the Eigen of the same ten: what else the machine does is then in both.
set -eu
export LC_ALL=C
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
rounds=${1:-3} compiler=${2:-${CXX:-g++}} eigen=${3:-/usr/include/eigen3}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

echo '#include <Eigen/Core>' >"$folder/eigen.cpp"
names=()
# add NAME: the file to be compiled comes from standard input.
add() {
  names+=("$1")
  cat >"$folder/${#names[@]}.cpp"
}
while read -r header; do
  # Without the library or the kit that it needs it cannot be compiled.
  case $header in
    hapbeam/rom/file/model_file.hpp | hapbeam/rom/file/json*) "$compiler" -E -include jansson.h -x c++ /dev/null >"$folder/out" 2>&1 || continue ;;
    hapbeam/haptics/hdapi/openhaptics.hpp | hapbeam/hosts/chai3d.hpp | hapbeam/hosts/hapi.hpp | hapbeam/hosts/sofa.hpp) continue ;;
  esac
  add "$header" <<<"#include <$header>"
done < <(cd "$top/include" && find hapbeam -name '*.hpp' | sort)
programs=$(awk -v folder="$folder" '
  /^```cpp$/ { text = ""; inside = 1; next }
  /^```$/ && inside {
    inside = 0
    if (text ~ /int main/) printf "%s", text >(folder "/program" ++n)
  }
  inside { text = text $0 "\n" }
  END { print n }' "$top/README.md")
for ((k = 1; k <= programs; ++k)); do add "README program $k" <"$folder/program$k"; done

seconds() {
  local TIMEFORMAT='%U %S'
  { time "$compiler" -std=c++17 -O2 -I "$top/include" -isystem "$eigen" -c "$folder/$1.cpp" -o "$folder/out.o"; } 2>&1 |
    awk '{ print $1 + $2 }'
}

for ((round = 0; round < rounds; ++round)); do
  for ((k = 1; k <= ${#names[@]}; ++k)); do
    [[ $((k % 10)) != 1 ]] || core=$(seconds eigen)
    echo "$k,$(seconds "$k"),$core" >>"$folder/times"
  done
done

printf '# %s\n' "$("$compiler" --version | head -n 1), -std=c++17 -O2, $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)"
echo file,seconds,of_eigen
for ((k = 1; k <= ${#names[@]}; ++k)); do
  awk -F, -v k="$k" -v name="${names[k - 1]}" '
    $1 == k { if (!least || $2 < least) least = $2; ratio = $2 / $3; if (!best || ratio < best) best = ratio }
    END { printf "%s,%.2f,%.2f\n", name, least, best }' "$folder/times"
done
