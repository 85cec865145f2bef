#!/usr/bin/env bash
# Builds and runs an example, and installs what is missing for that (Debian; as root or with sudo).
#
#   bash examples/run.sh [OPTION...]           a simulated Phantom presses a beam
#   bash examples/run.sh train [OPTION...]     makes a model of a beam, for --model of the other
#   bash examples/run.sh 1_press_a_beam        and 2_… to 11_…: the files of examples/numbered
#
# The options are the program's own; --help lists them.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"

program=phantom
case ${1-} in
  phantom | train | [1-9]_* | 1[0-9]_*) program=$1; shift ;;
esac

build examples "$program" || exit 1
for option in "$@"; do
  [[ $option != --plot ]] || command -v gnuplot >/dev/null || need gnuplot-nox
done
rm -f "$log"
exec "$top/build/examples/examples/$program" "$@"
