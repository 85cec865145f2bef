#!/usr/bin/env bash
# Compiles sources of a configured build as far as errors and warnings go, and makes no code: a second compiler's opinion at a
# quarter of the price.  Templates are instantiated, so what they do wrong is seen.
#
#   bash cmake/check_syntax.sh BUILD REGEX [BUT]
#
#   BUILD   build folder, configured by a preset: Ninja, with compile_commands.json
#   REGEX   of the sources' paths   BUT   of those that are left out
#
# The last line counts the sources.  Exit status 0 only if nothing is said of any.
set -u
build=$1 regex=$2 but=${3:-^$}
cd "$build" || exit 1
build=$PWD

commands=$(sed -nE 's/^  "command": "(.*)",$/\1/p' compile_commands.json | sed 's/\\"/"/g; s/\\\\/\\/g' |
  grep -v -- '-c [^ ]*cmake_pch\.hxx\.cxx$' | grep -E -- "-c [^ ]*($regex)" | grep -vE -- "-c [^ ]*($but)")
[[ -n $commands ]] || { echo "check_syntax.sh: no source matches '$regex'" >&2; exit 1; }

# What the build makes first: precompiled headers and generated sources.
mapfile -t made < <(
  { grep -oE -- '[^ ]*cmake_pch\.hxx\.pch' <<<"$commands"
    grep -oE -- '-Winvalid-pch -include [^ ]*' <<<"$commands" | sed 's/.* //; s/$/.gch/'
    grep -oE -- "-c $build/tests/units/[^ ]*" <<<"$commands" | sed 's/^-c //'; } | sort -u | sed "s|^$build/||")
[[ ${#made[@]} == 0 ]] || ninja "${made[@]}" >/dev/null || exit 1

sed -E 's/ -o [^ ]+( -c )/ -fsyntax-only\1/; s/$/ || exit 255/' <<<"$commands" |
  xargs -d '\n' -P "$(nproc)" -I{} bash -c '{}' || exit 1
echo "$(wc -l <<<"$commands") sources"
