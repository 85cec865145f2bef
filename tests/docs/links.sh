#!/usr/bin/env bash
# Fails where a page links to a file or a heading that is not there, or where a source names such a page.
#
#   bash tests/docs/links.sh [--pages FOLDER]
#
#   --pages FOLDER   a copy of the repository; default: the repository
#
# Anchors are those that GitHub gives to headings.  Links to other hosts are not followed.  Needs awk alone.
set -u
export LC_ALL=C
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
while [[ $# -gt 0 ]]; do
  case $1 in
    --pages) top=$(cd "${2-}" 2>/dev/null && pwd) || exit 2; shift 2 ;;
    *) echo "tests/docs/links.sh: '$1': only --pages FOLDER is allowed" >&2; exit 2 ;;
  esac
done
cd "$top" || exit 2
# Pages come first: their headings are known before a source names one.
pages() { find . -maxdepth 1 -name '*.md'; find docs .github -name '*.md' 2>/dev/null; }
sources() {
  for folder in .github include examples tests benchmarks bindings packaging cmake docs; do
    [[ ! -d $folder ]] || find "$folder" -type f -regextype posix-extended -regex '.*\.(hpp|cpp|h|sh|awk|yml|cmake|txt|py|inc|js|html|csv)'
  done
}
{ pages | sort; sources | sort; } | awk '
  function slug(text) {
    text = tolower(text)
    gsub(/[^a-z0-9 _-]/, "", text)
    gsub(/ /, "-", text)
    return text
  }
  # The path of TARGET, seen from FILE, without ./ and folder/.. in it.
  function resolved(file, target) {
    sub(/[^\/]*$/, "", file)
    target = file target
    gsub(/\/\.\//, "/", target)
    sub(/^\.\//, "", target)
    while (match(target, /\.?[^\/.][^\/]*\/\.\.\//)) target = substr(target, 1, RSTART - 1) substr(target, RSTART + RLENGTH)
    sub(/\/$/, "", target)
    return target
  }
  function exists(path,  line, found) {
    if (path in there) return there[path]
    found = system("test -e \"" path "\"") == 0
    return there[path] = found
  }
  function check(where, path, anchor) {
    ++links
    if (!exists(path)) { print where ": " path " is not there"; ++faults; return }
    if (anchor != "" && path ~ /\.md$/ && !((path, anchor) in headings)) { print where ": " path " has no heading #" anchor; ++faults }
  }
  function page(file,  path, line, fenced, number, text, target, anchor) {
    path = file
    sub(/^\.\//, "", path)
    while ((getline line < file) > 0) {
      ++number
      if (line ~ /^```/) fenced = !fenced
      if (fenced) continue
      if (line ~ /^#+ /) {
        text = line
        sub(/^#+ /, "", text)
        headings[path, slug(text)] = 1
      }
      while (match(line, /\]\([^) ]+\)/)) {
        target = substr(line, RSTART + 2, RLENGTH - 3)
        line = substr(line, RSTART + RLENGTH)
        if (target ~ /^[a-z]+:/) continue
        anchor = ""
        if (match(target, /#/)) { anchor = substr(target, RSTART + 1); target = substr(target, 1, RSTART - 1) }
        from[++count] = path ":" number
        to[count] = target == "" ? path : resolved(path, target)
        at[count] = anchor
      }
    }
    close(file)
  }
  function source(file,  line, number, target, anchor) {
    while ((getline line < file) > 0) {
      ++number
      while (match(line, /docs\/[A-Za-z0-9_\/]+\.md(#[a-z0-9_-]+)?/)) {
        target = substr(line, RSTART, RLENGTH)
        line = substr(line, RSTART + RLENGTH)
        anchor = ""
        if (match(target, /#/)) { anchor = substr(target, RSTART + 1); target = substr(target, 1, RSTART - 1) }
        from[++count] = file ":" number
        to[count] = target
        at[count] = anchor
      }
    }
    close(file)
  }
  /\.md$/ { page($0); next }
  { source($0) }
  END {
    for (k = 1; k <= count; ++k) check(from[k], to[k], at[k])
    if (faults) exit 1
    print links " links, all of them to something"
  }'
