#!/usr/bin/env bash
# Fails where a file names another version than include/hapbeam/version.hpp.
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 2
part() { sed -nE "s/^#define HAPBEAM_VERSION_$1 //p" include/hapbeam/version.hpp; }
version=$(part MAJOR).$(part MINOR).$(part PATCH)
wrong=0
names() { grep -qF -- "$2" "$1" || { echo "$1: does not say $2"; wrong=1; }; }
[[ $(<packaging/VERSION) == "$version" ]] || { echo "packaging/VERSION: is not $version"; wrong=1; }
names CITATION.cff "version: $version"
names packaging/vcpkg/hapbeam/vcpkg.json "\"version\": \"$version\""
names docs/packages.md "libhapbeam-dev_${version}_all.deb"
names docs/packages.md "find_package(hapbeam $(part MAJOR).$(part MINOR) "
names docs/packages.md "hapbeam-${version}-cp311"
names docs/python.md "hapbeam-${version}-cp311"
names docs/haptics.md "find_package(hapbeam $(part MAJOR).$(part MINOR) "
names CHANGELOG.md "$version"
exit $wrong
