#!/usr/bin/env bash
# Measures, draws the charts of docs/benchmarks.md and fills in its tables.  Installs what is missing for that (Debian; as
# root or with sudo).
#
#   bash benchmarks/charts.sh [--runs N] [--programs FOLDER]
#
#   --runs N            how often each program runs (default 5); what is shown is the median, and the range
#   --programs FOLDER   where reduced_press and thesis_figures are, built already; default: builds them
#   --help              this text
#
# Nothing else should run meanwhile.  Takes a minute or two after the build.
set -u
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/steps.sh"

usage() { sed -n '2,11s/^# \{0,1\}//p' "$0"; }
wrong() { echo "benchmarks/charts.sh: $1" >&2; exit 2; }

runs=5 programs=
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --runs) runs=${2-}; shift 2 2>/dev/null || shift ;;
    --programs) programs=${2-}; shift 2 2>/dev/null || shift ;;
    *) wrong "'$1': only --runs N, --programs FOLDER and --help are allowed" ;;
  esac
done
[[ $runs =~ ^[1-9][0-9]*$ ]] || wrong "--runs '$runs': must be 1 or more"

need gnuplot-nox || exit 1
if [[ -z $programs ]]; then
  build release reduced_press thesis_figures || exit 1
  programs=$top/build/release/benchmarks
fi
data=$(mktemp -d)
trap 'rm -rf "$log" "$data"' EXIT

measure() {
  local run program
  for ((run = 1; run <= runs; ++run)); do
    for program in reduced_press thesis_figures; do
      "$programs/$program" --benchmark_out="$data/$program.$run.json" --benchmark_out_format=json || return 1
    done
  done
  ! grep -h error_message "$data"/*.json
}

# Of all runs: lines 'benchmark counter median lowest highest'.
collect() {
  awk -F'"' '
    /"context":/ { name = "" }
    /"name":/ { name = $4; sub(/\/iterations:1.*/, "", name) }
    name != "" && $3 ~ /^: -?[0-9]/ { value = $3; gsub(/[:, ]/, "", value); print name, $2, value }
  ' "$data"/*.json | sort -k1,1 -k2,2 -k3,3g | awk '
    function put(  middle) {
      middle = int((n + 1) / 2)
      if (n) print key, n % 2 ? value[middle] : (value[middle] + value[middle + 1]) / 2, value[1], value[n]
    }
    $1 " " $2 != key { put(); key = $1 " " $2; n = 0 }
    { value[++n] = $3 }
    END { put() }' >"$data/all"
}

# series FILE BEFORE AFTER TIME ERROR...: by number of elements or snapshots, of the benchmarks BEFORE/number/AFTER, lines
# 'number time lowest highest error...'.
series() {
  local file=$1 before=$2 after=$3
  shift 3
  awk -v before="$before" -v after="$after" -v counters="$*" '
    index($1, before) == 1 && substr($1, length(before) + 1) ~ ("^[0-9]+" after "$") {
      number = substr($1, length(before) + 1) + 0
      numbers[number]
      median[number, $2] = $3
      range[number, $2] = $4 " " $5
    }
    END {
      count = split(counters, counter, " ")
      for (number in numbers) {
        line = number " " median[number, counter[1]] " " range[number, counter[1]]
        for (k = 2; k <= count; ++k) line = line " " median[number, counter[k]]
        print line
      }
    }' "$data/all" | sort -g >"$data/$file"
}

# point FILE BENCHMARK: its line 'time median_error max_error'.
point() {
  awk -v name="$2" '$1 == name { value[$2] = $3 }
    END { print value["p50_us"], value["force_error_median"], value["force_error_max"] }' "$data/all" >"$data/$1"
}

draw() {
  local model path
  series 3_8 figure_3_8/pinned/ '' time_us force_error
  series 3_9 figure_3_9/pinned/ '' time_us force_error
  series 3_10_force figure_3_10/pinned/ /force time_us force_error
  series 3_10_shape figure_3_10/pinned/ /shape time_us force_error
  series 3_11_force figure_3_11/pinned/ /force time_us force_error
  series 3_11_shape figure_3_11/pinned/ /shape time_us force_error
  for path in press slide; do
    series "${path}_fem" "$path/fem/" '' p50_us force_error_median force_error_max
    for model in pod_1 pod_2 galerkin_1 galerkin_2; do
      point "${path}_${model}_force" "$path/$model/force"
      point "${path}_${model}_shape" "$path/$model/shape"
    done
  done
  gnuplot -e "data = '$data'; images = '$top/docs/images'" "$top/benchmarks/charts.gp" || return 1
  # Gnuplot's titles are its own expressions, and browsers show them under the pointer.
  sed -i -E 's:<(title|desc)>[^<]*</(title|desc)>::' "$top"/docs/images/{figure_3_8,figure_3_9,figure_3_10,figure_3_11,models}.svg
}

# The tables of docs/benchmarks.md, in Markdown.
tables() {
  local first=$data/reduced_press.1.json
  context() { sed -nE 's/^ *"'"$1"'": "?([^"]*[^",])"?,?$/\1/p' "$first" | head -n 1; }
  echo "$(context processor), $(context num_cpus) processors; $(context compiler), \`$(context flags)\`; commit $(context commit)."
  echo "Median of $runs runs, in brackets the lowest and the highest."
  awk '
    { median[$1, $2] = $3; low[$1, $2] = $4; high[$1, $2] = $5 }
    function digits(x) { return x < 1 ? "%.3f" : x < 10 ? "%.2f" : "%.1f" }
    function number(x) { return sprintf(digits(x), x) }
    function ranged(name, counter) {
      return number(median[name, counter]) " (" number(low[name, counter]) "–" number(high[name, counter]) ")"
    }
    function error(name, counter) { return sprintf("%.0e", median[name, counter]) }
    function row(path, model, what,  name, faster, training) {
      name = path model
      faster = ("summary", name) in median ? ranged("summary", name) : model == "fem/8" ? "1" : ""
      training = (name, "pod_ms") in median ? number(median[name, "snapshots_ms"] + median[name, "pod_ms"]) : ""
      print "| " what " | " ranged(name, "p50_us") " | " number(median[name, "p99_us"]) " | " faster " | " \
        error(name, "force_error_median") " | " error(name, "force_error_max") " | " training " |"
    }
    function table(path, where, trained, count,  k, model) {
      print "\n| " where " | tick, µs | p99, µs | times 8 elements | force error, median | largest | training, ms |"
      print "|---|---|---|---|---|---|---|"
      for (k = 1; k <= count; ++k) {
        row(path, trained[k] "/force", title[trained[k]] ", force")
        row(path, trained[k] "/shape", title[trained[k]] ", force and shape")
      }
      row(path, "fem/8", "FemModel, 8 elements")
      row(path, "fem/64", "FemModel, 64 elements")
      row(path, "fem/1024", "FemModel, 1024 elements")
    }
    function hand_over(elements, kind, what,  name) {
      name = "hand_over/" kind
      print "| " what " | " elements " | " ranged(name, "p50_us") " | " ranged(name, "p99_us") " | " ranged(name, "max_us") " |"
    }
    END {
      title["pod_1"] = "PodModel, 14"; title["galerkin_1"] = "GalerkinModel, 14"
      title["pod_2"] = "PodModel, 16 × 12"; title["galerkin_2"] = "GalerkinModel, 16 × 12"
      split("pod_1 galerkin_1 pod_2 galerkin_2", all, " "); split("pod_2 galerkin_2", wide, " ")
      table("press/", "pressed at mid-span, 0 to 50 mm", all, 4)
      table("slide/", "sliding from 0.3 L to 0.7 L at 20 mm", wide, 2)
      print "\n| hand-over of a Guarded model | elements | p50, µs | p99, µs | longest, µs |\n|---|---|---|---|---|"
      for (k = 1; k <= 2; ++k) {
        n = k == 1 ? 8 : 64
        hand_over(n, "near/" n "/alone", "any tick of FemModel alone, the same path")
        hand_over(n, "near/" n "/first", "the tick that hands over, 20 ticks after the full model rested")
        hand_over(n, "rest/" n "/first", "the tick that hands over, from rest")
      }
    }' "$data/all"
}

fill_in() {
  local page=$top/docs/benchmarks.md
  tables >"$data/tables" &&
    awk -v tables="$data/tables" '
      /^<!-- measured/ { print; print ""; while ((getline line < tables) > 0) print line; print ""; skip = 1 }
      /^<!-- end/ { skip = 0 }
      !skip' "$page" >"$data/page" && cp "$data/page" "$page"
}

step "measure, $runs times" measure || exit 1
collect
step 'draw docs/images' draw || exit 1
step 'fill in docs/benchmarks.md' fill_in
