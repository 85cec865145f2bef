# What tests/run.sh, examples/run.sh, benchmarks/run.sh and .ci/run share; for `source`.

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# step WHAT COMMAND...: one line with the seconds taken; the output only if the command fails.
step() {
  local what=$1 begin=$SECONDS watcher status
  shift
  : >"$log"
  begin_line "$what"
  watch "$what" &
  watcher=$!
  "$@" >"$log" 2>&1 </dev/null
  status=$?
  { kill "$watcher"; wait "$watcher"; } 2>/dev/null
  [[ ! -t 1 ]] || printf '\r\e[K%s ... ' "$what"
  if [[ $status == 0 ]]; then
    printf '%d s\n' $((SECONDS - begin))
  else
    printf 'failed after %d s\n' $((SECONDS - begin))
    # Ninja's progress says nothing here.  The first error explains the others; the end has the summary.
    sed -i -E '/^\[[0-9]+\/[0-9]+\] /d' "$log"
    if [[ $(wc -l <"$log") -le 300 ]]; then cat "$log"; else head -n 200 "$log" && echo '[...]' && tail -n 100 "$log"; fi
    return 1
  fi
}

# begin_line WHAT: a terminal's line begins anew, and is short enough to stay one.
begin_line() { if [[ -t 1 ]]; then printf '\r\e[K%.50s ... ' "$1"; else printf '%s ... ' "$1"; fi; }

# watch WHAT: says how far the command of a step is, by the count of Ninja or make: on a terminal each second, elsewhere by a line each half
# minute.
watch() {
  local begin=$SECONDS every=30 next passed count
  [[ ! -t 1 ]] || every=1
  next=$every
  # Ctrl-C does not reach it.  Its last sleep outlasts it, and must not hold a pipe open.
  while sleep 1 >/dev/null 2>&1 && kill -0 $$; do
    passed=$((SECONDS - begin))
    [[ $passed -ge $next ]] || continue
    next=$((passed + every))
    count=$(grep -oE '^\[ *[0-9]+(/[0-9]+|%)\]' "$log" | tail -n 1)
    if [[ -t 1 ]]; then
      begin_line "$1"
      printf '%s%d s' "${count:+$count }" "$passed"
    else
      printf '%safter %d s\n' "${count:+$count }" "$passed"
      begin_line "$1"
    fi
  done
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
# What tests, benchmarks and the example's window need comes along: one build folder serves them.  Examples have their own, and a window where
# there is a display.
also_needed=()
build() {
  local preset=$1 needed=(g++) no_window=OFF
  shift
  [[ $preset != *clang* ]] || needed=(clang)
  # With its sanitizers, and what finds names for their reports.
  [[ $preset != asan-ubsan && $preset != tsan ]] || needed=(clang libclang-rt-dev llvm)
  # With what the package for Python is built and tested by.
  [[ $preset != strict-gcc ]] || needed=(g++ pybind11-dev python3-dev python3-numpy python3-pytest)
  [[ $preset != mingw ]] || needed=(g++ g++-mingw-w64-x86-64-posix wine64)
  [[ $preset != aarch64 ]] || needed=(g++ g++-aarch64-linux-gnu qemu-user)
  if [[ $preset == examples ]]; then
    [[ $1 == phantom && -n ${DISPLAY-}${WAYLAND_DISPLAY-} ]] || no_window=ON
  else
    needed+=(catch2 libbenchmark-dev)
  fi
  [[ $no_window == ON ]] || needed+=(libglfw3-dev libimgui-dev libgl-dev fonts-dejavu-core)
  need "${needed[@]}" cmake ninja-build libeigen3-dev libjansson-dev "${also_needed[@]}" &&
    step "configure ($preset)" cmake -S "$top" --preset "$preset" -DCMAKE_DISABLE_FIND_PACKAGE_glfw3="$no_window" &&
    step "build $*" cmake --build "$top/build/$preset" --parallel "$(nproc)" --target "$@"
}
