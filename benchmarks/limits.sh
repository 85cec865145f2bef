#!/usr/bin/env bash
# Measures how far each kinematics is right and fills in the table of docs/limits.md.  Installs what is missing for that
# (Debian; as root or with sudo).  Takes a few seconds after the build.
#
#   bash benchmarks/limits.sh [--programs FOLDER]
#
#   --programs FOLDER   where the program kinematics is, built already; default: builds it
#   --help              this text
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"

programs=
case ${1-} in
  --help) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 0 ;;
  --programs) programs=${2-} ;;
  ?*) echo "benchmarks/limits.sh: '$1': only --programs FOLDER and --help are allowed" >&2; exit 2 ;;
esac
if [[ -z $programs ]]; then
  build release kinematics || exit 1
  programs=$top/build/release/benchmarks
fi
data=$(mktemp -d)
trap 'rm -rf "$log" "$data"' EXIT

table() {
  "$programs/kinematics" --benchmark_format=json 2>/dev/null | awk -F'"' '
    /"name":/ { name = $4; sub(/\/iterations:1.*/, "", name) }
    name != "" && $3 ~ /^: -?[0-9]/ { value = $3; gsub(/[:, ]/, "", value); v[name, $2] = value }
    function at(key, percent) {
      if (!((key, "slope_" percent) in v)) return "–"
      return sprintf("%.3g°, %.2g L, " (v[key, "press_" percent] + 0 < 99.5 ? "%.2g" : "%.0f") " h", v[key, "slope_" percent],
        v[key, "deflection_" percent], v[key, "press_" percent])
    }
    END {
      split("pinned-pinned clamped-clamped pinned-roller clamped-free", ends, " ")
      split("thick thin", sections, " "); split("linear von_karman corotational", elements, " ")
      title["linear"] = "`Linear`"; title["von_karman"] = "`VonKarman`"; title["corotational"] = "`Corotational`"
      print "| ends | h/L | element | 1 % | 5 % | 10 % | at the deepest |"
      print "|---|---|---|---|---|---|---|"
      for (i = 1; i <= 4; ++i) for (j = 1; j <= 2; ++j) for (k = 1; k <= 3; ++k) {
        key = "kinematics/" ends[i] "/" sections[j] "/" elements[k]
        printf "| %s | 1/%d | %s | %s | %s | %s | %.1g at %g L |\n", ends[i], j == 1 ? 100 : 1000, title[elements[k]],
          at(key, 1), at(key, 5), at(key, 10), v[key, "error_at_deepest"], v[key, "deepest"]
      }
    }'
}

fill_in() {
  local page=$top/docs/limits.md
  table >"$data/table" && [[ $(wc -l <"$data/table") -eq 26 ]] &&
    awk -v table="$data/table" '
      /^<!-- measured/ { print; print ""; while ((getline line < table) > 0) print line; print ""; skip = 1 }
      /^<!-- end/ { skip = 0 }
      !skip' "$page" >"$data/page" && cp "$data/page" "$page"
}

step 'fill in docs/limits.md' fill_in
