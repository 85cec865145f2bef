#!/usr/bin/env bash
# Makes the Debian package libhapbeam-dev from the last commit, and installs what that takes (Debian; as root or with sudo).
#
#   bash packaging/debian.sh [FOLDER]     the .deb lands in FOLDER, default build/debian
set -eu
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"
folder=$(realpath -m "${1:-$top/build/debian}")
need build-essential debhelper cmake git libeigen3-dev libjansson-dev
version=$(<"$top/packaging/VERSION")
tree=$folder/hapbeam-$version
rm -rf "$tree"
mkdir -p "$tree"
git -C "$top" archive HEAD | tar -x -C "$tree"
mv "$tree/packaging/debian" "$tree/debian"
printf 'hapbeam (%s) unstable; urgency=medium\n\n  * Release %s.\n\n -- hapbeam maintainers <maintainers@users.noreply.github.com>  %s\n' \
  "$version" "$version" "$(git -C "$top" log -1 --format=%cD)" >"$tree/debian/changelog"
package() { cd "$tree" && dpkg-buildpackage --build=binary --no-sign; }
step 'dpkg-buildpackage' package
ls "$folder"/*.deb
