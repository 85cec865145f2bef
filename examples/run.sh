#!/usr/bin/env bash
# Builds and runs the example, and installs what is missing for that (Debian; as root or with sudo).
#
#   bash examples/run.sh [OPTION...]     the options are the example's own; --help lists them
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"

build release phantom || exit 1
rm -f "$log"
exec "$top/build/release/examples/phantom" "$@"
