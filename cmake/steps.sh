# What tests/run.sh, examples/run.sh, benchmarks/run.sh and .ci/run share; for `source`.

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# step WHAT COMMAND...: one line with the seconds taken; the output only if the command fails.
step() {
  local what=$1 begin=$SECONDS
  shift
  printf '%s ... ' "$what"
  if "$@" >"$log" 2>&1 </dev/null; then
    printf '%d s\n' $((SECONDS - begin))
  else
    printf 'failed after %d s\n' $((SECONDS - begin))
    # Ninja's progress says nothing here.  The first error explains the others; the end has the summary.
    sed -i -E '/^\[[0-9]+\/[0-9]+\] /d' "$log"
    if [[ $(wc -l <"$log") -le 300 ]]; then cat "$log"; else head -n 200 "$log" && echo '[...]' && tail -n 100 "$log"; fi
    return 1
  fi
}

# need PACKAGE...: installs those that are missing.  Without apt, configuring says what is not there.
need() {
  command -v apt-get >/dev/null || return 0
  local package missing=()
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [[ ${#missing[@]} == 0 ]] || step "install ${missing[*]}" install_packages "${missing[@]}"
}

install_packages() {
  local root=()
  [[ $EUID == 0 ]] || root=(sudo)
  "${root[@]}" apt-get update -qq &&
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends \
      -o DPkg::Lock::Timeout=120 "$@"
}

# build PRESET TARGET...: installs what the build needs, and the packages of also_needed, at once; configures and builds.
# What tests, benchmarks and the example's window need comes along: one build folder serves all.
also_needed=()
build() {
  local preset=$1 compiler=(g++)
  shift
  [[ $preset != *clang* ]] || compiler=(clang)
  # With its sanitizers, and what finds names for their reports.
  [[ $preset != asan-ubsan && $preset != tsan ]] || compiler=(clang libclang-rt-dev llvm)
  [[ $preset != mingw ]] || compiler=(g++ g++-mingw-w64-x86-64-posix wine64)
  [[ $preset != aarch64 ]] || compiler=(g++ g++-aarch64-linux-gnu qemu-user)
  need "${compiler[@]}" cmake ninja-build libeigen3-dev libjansson-dev catch2 libbenchmark-dev \
    libglfw3-dev libimgui-dev libgl-dev fonts-dejavu-core "${also_needed[@]}" &&
    step "configure ($preset)" cmake -S "$top" --preset "$preset" &&
    step "build $*" cmake --build "$top/build/$preset" --parallel "$(nproc)" --target "$@"
}
