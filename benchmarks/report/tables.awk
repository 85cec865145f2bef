# The tables of README.md and docs: awk -F, -v table=NAME -f numbers.awk -f tables.awk FILE.csv

/^#/ { head = head (head == "" ? "" : "; ") substr($0, 3); next }
columns == 0 { columns = NF; for (k = 1; k <= NF; ++k) title[k] = $k; next }
{
  ++rows
  for (k = 1; k <= columns; ++k) cell[rows, title[k]] = $k
}

function line(a, b, c, d, e, f, g, h) {
  print "| " a " | " b (c == "" ? "" : " | " c) (d == "" ? "" : " | " d) (e == "" ? "" : " | " e) (f == "" ? "" : " | " f) \
    (g == "" ? "" : " | " g) (h == "" ? "" : " | " h) " |"
}
function rule(n,  k, text) {
  for (k = 1; k <= n; ++k) text = text "|---"
  print text "|"
}

# The first row of a scene, model and size, in speed_accuracy.csv.
function point(scene, model, elements, snapshots,  k) {
  for (k = 1; k <= rows; ++k)
    if (cell[k, "scene"] == scene && cell[k, "model"] == model && cell[k, "elements"] == elements && \
        cell[k, "snapshots"] == snapshots)
      return k
  print "no " model " of " elements " elements and " snapshots " snapshots in " scene >"/dev/stderr"
  exit 1
}

# Which model for which scene.
function choice(text, name, scene, model, elements, snapshots,  k) {
  k = point(scene, model, elements, snapshots)
  line(text, name, time(cell[k, "tick_ns_p50"]), percent(cell[k, "force_error_max"]), \
    percent(cell[k, "outside_error_max"]), size(cell[k, "bytes"]))
}
function scenes() {
  line("scene", "model", "a tick", "largest error", "1.6 × deeper", "memory")
  rule(6)
  choice("a bar that is pressed, ends held", "`FemModel<>`, 8 elements", "bar_50mm", "VonKarman<StabilityFunctions>", 8, 0)
  choice("the same, trained first", "`PodModel<>`, 16 × 12", "bar_50mm", "PodModel<ChebyshevNodes>", 0, 192)
  choice("the same, pressed deeper than trained", "`GalerkinModel<>`, 16 × 12", "bar_50mm", "GalerkinModel", 0, 192)
  choice("a thin strip that stretches", "`FemModel<>`, 8 elements", "strip", "VonKarman<StabilityFunctions>", 8, 0)
  choice("a ruler that bends far", "`FemModel<Corotational<>>`, 8 elements", "ruler", "Corotational<VonKarman<StabilityFunctions>>", 8, 0)
  choice("an arch, past the peak of its force", "`FemModel<Corotational<>>`, 8 elements", "arch", "Corotational<VonKarman<StabilityFunctions>>", 8, 0)
}

# Whether a model, of those that match, is at least as fast and as accurate as row k: whether it dominates row k.
function passed(k, models,  j) {
  for (j = 1; j <= rows; ++j)
    if (j != k && !truncated(j) && cell[j, "scene"] == cell[k, "scene"] && cell[j, "model"] ~ models && \
        cell[j, "tick_ns_p50"] + 0 <= cell[k, "tick_ns_p50"] + 0 && \
        cell[j, "force_error_max"] + 0 <= cell[k, "force_error_max"] + 0)
      return 1
  return 0
}
# Whether a trained model has fewer modes than another one that has as many snapshots.
function truncated(k,  j) {
  if (k in memo) return memo[k]
  memo[k] = 0
  for (j = 1; j <= rows; ++j)
    if (cell[j, "scene"] == cell[k, "scene"] && cell[j, "model"] == cell[k, "model"] && \
        cell[j, "snapshots"] == cell[k, "snapshots"] && cell[j, "modes"] + 0 > cell[k, "modes"] + 0)
      memo[k] = 1
  return memo[k]
}
function fronts(  n, m, k, model, own, sizes, on, ours, form, even, others) {
  m = split("VonKarman<StabilityFunctions> PodModel<ChebyshevNodes> GalerkinModel Corotational<VonKarman<StabilityFunctions>> RoundRod TwistedRod", model, " ")
  own = "^VonKarman<StabilityFunctions>|^Corotational<VonKarman|^PodModel<Chebyshev|^GalerkinModel|^RoundRod|^TwistedRod"
  line("default", "sizes", "on the front", "dominated by other defaults", "by the closed form", "by equispaced nodes", "by anything else")
  rule(7)
  for (n = 1; n <= m; ++n) {
    sizes = on = ours = form = even = others = 0
    for (k = 1; k <= rows; ++k) {
      if (!default_in(model[n], cell[k, "scene"]) || cell[k, "model"] != model[n] || truncated(k)) continue
      ++sizes
      on += !passed(k, ".")
      ours += passed(k, own)
      form += passed(k, "^closed form")
      even += passed(k, "Equispaced")
      others += passed(k, "^Linear|Integration|^VonKarman<AssumedStrain>|^Corotational<Linear>|^Newton|^mass-spring|^MuJoCo|^CrisfieldRod")
    }
    if (sizes) line("`" model[n] "`", sizes, on, ours, form, even, others)
  }
}
# Whether a model is one that a scene is for.
function default_in(model, scene) {
  if (scene ~ /^(bar_5mm|bar_50mm|strip)$/) return model ~ /^(VonKarman<StabilityFunctions>|PodModel<ChebyshevNodes>|GalerkinModel)$/
  if (scene ~ /^(ruler|arch)$/) return model ~ /^Corotational/
  return model == "TwistedRod" || (scene == "wire" && model == "RoundRod")
}

# Of reduced_press.csv.
function trained_row(model, what, shown, deeper,  k) {
  for (k = 1; k <= rows; ++k)
    if (cell[k, "path"] == "slide" && cell[k, "model"] == model && cell[k, "what"] == what)
      line(shown, digits(cell[k, "p50_us"]) " µs", percent(cell[k, "force_error_median"]), percent(cell[k, "force_error_max"]), deeper)
}
function trained() {
  line("model, pressed up to 50 mm", "press and shape", "force error, median", "largest", "deeper than trained")
  rule(5)
  trained_row("fem", "8", "`FemModel<>`, 8 elements", "solves, to a tenth of the length")
  trained_row("fem", "64", "`FemModel<>`, 64 elements", "the same")
  trained_row("pod_2", "shape", "`PodModel<>`: interpolated work, POD shapes", "continues with constant stiffness and status `out_of_range`")
  trained_row("galerkin_2", "shape", "`GalerkinModel<>`: one unknown, the tension", "solves on")
}

# Of fem_press.csv: a Newton iteration, by solver and number of elements.
function solvers(  k, n, s, e, solver, text) {
  n = split("one_tension block_tridiagonal simplicial_ldlt_natural simplicial_ldlt_amd sparse_lu_from_triplets", solver, " ")
  line("a Newton iteration, µs", "16 elements", "64", "256", "1024")
  rule(5)
  split("hapbeam, one tension and the shape;hapbeam, block-tridiagonal;Eigen SimplicialLDLT, natural order;Eigen SimplicialLDLT, AMD;Eigen SparseLU from triplets", text, ";")
  for (s = 1; s <= n; ++s) {
    for (k = 1; k <= rows; ++k)
      if (cell[k, "path"] == "press" && cell[k, "solver"] == solver[s] && (s == 1 || cell[k, "membrane"] == "reduced"))
        found[s, cell[k, "elements"]] = digits(cell[k, "solve_ns"] / 1e3)
    if ((s, 64) in found) line(text[s], found[s, 16], found[s, 64], found[s, 256], found[s, 1024])
  }
}

# Of rod_ticks.csv, where both rods have the same error.
function rod_ticks(  k, found) {
  line("elements", "error of rods", "planar `Corotational`", "`RoundRod`", "`TwistedRod`")
  rule(5)
  for (k = 1; k <= rows; ++k) {
    found[cell[k, "model"]] = k
    if (cell[k, "model"] == "twisted_rod")
      line(cell[k, "elements"], percent(cell[k, "force_error"]), digits(cell[found["planar"], "p50_us"]) " µs", \
        digits(cell[found["round_rod"], "p50_us"]) " µs", digits(cell[k, "p50_us"]) " µs")
  }
}

# Of kinematics.csv.
function at(k, part) {
  if (cell[k, "slope_" part] == "") return "–"
  return sprintf("%.3g°, %.2g L, " (cell[k, "press_" part] + 0 < 99.5 ? "%.2g" : "%.0f") " h", cell[k, "slope_" part], \
    cell[k, "deflection_" part], cell[k, "press_" part])
}
function limits(  i, k, ends, at_1, at_10, linear, best) {
  split("pinned-pinned clamped-clamped pinned-roller clamped-free", ends, " ")
  line("ends", "`Linear`, 1 %", "`VonKarman`, 1 %", "10 %", "`Corotational`, at the deepest")
  rule(5)
  for (i = 1; i <= 4; ++i) {
    for (k = 1; k <= rows; ++k) {
      if (cell[k, "ends"] != ends[i] || cell[k, "section"] != "thick") continue
      if (cell[k, "element"] == "linear") linear = at(k, 1)
      if (cell[k, "element"] == "von_karman") { at_1 = at(k, 1); at_10 = at(k, 10) }
      if (cell[k, "element"] == "corotational") best = sprintf("%.1g at %g L", cell[k, "error_at_deepest"], cell[k, "deepest"])
    }
    line(ends[i], linear, at_1, at_10, best)
  }
}

function most_beams(  k, most) {
  for (k = 1; k <= rows; ++k) if (cell[k, "model"] == "pod" && cell[k, "beams"] + 0 > most + 0) most = cell[k, "beams"]
  return most
}
# Of many_beams.csv: the median tick of arrays, of trained models for the largest alone, and the 99th percentile where most beams are touched.
function many(  k, key, n, order, title) {
  title["fem"] = "`FemModel<>`"; title["pod"] = "`PodModel<>`"
  for (k = 1; k <= rows; ++k) {
    if (!(cell[k, "model"] in title) || (cell[k, "model"] == "pod" && cell[k, "beams"] != most_beams())) continue
    key = title[cell[k, "model"]] ", " cell[k, "beams"]
    if (!(key in tick)) { order[++n] = key; tick[key] = 1 }
    tick[key, cell[k, "contacts"]] = digits(cell[k, "p50_us"]) " µs"
    tick[key, "p99"] = digits(cell[k, "p99_us"]) " µs"
  }
  line("beams", "none touched", "about 10", "about 100", "p99 of the most touched")
  rule(5)
  for (k = 1; k <= n; ++k) print "| " order[k] " | " tick[order[k], 0] " | " tick[order[k], 10] " | " tick[order[k], 100] " | " tick[order[k], "p99"] " |"
}

# Of chooser.csv.
function chosen(  k, n, kind, kinds, part, count, none, overlooked, error, worst, missed, unanswered, ratio, dear, dearest, slowest, text) {
  n = split("POD Galerkin Linear VonKarman Corotational", kinds, " ")
  for (k = 1; k <= rows; ++k) {
    if (cell[k, "choose_ms"] + 0 > slowest) slowest = cell[k, "choose_ms"] + 0
    if (cell[k, "chosen"] == "none") {
      ++none
      if (cell[k, "cheapest"] != "none") ++overlooked
      continue
    }
    split(cell[k, "chosen"], part, /[; ]/)
    ++count[part[1]]
    # To some kinds of awk "inf" is a number, to others 0.
    if (cell[k, "error"] == "inf") { ++missed; unanswered = "; not answered: some"; continue }
    error = cell[k, "error"] / cell[k, "tolerance"]
    if (error > worst) worst = error
    if (error > 1) ++missed
    if (cell[k, "cheapest"] == "none") continue
    ratio = cell[k, "tick_us"] / cell[k, "cheapest_tick_us"]
    if (ratio > dearest) dearest = ratio
    if (ratio > 2) ++dear
  }
  for (k = 1; k <= n; ++k)
    if (kinds[k] in count) text = text (text == "" ? "" : ", ") kinds[k] " " count[kinds[k]]
  line("of " rows " scenes", "")
  rule(2)
  line("a model was chosen", rows - none ": " text)
  line("none was chosen, though one would have done", overlooked + 0 " of " none + 0)
  line("error above the tolerance, on 60 presses outside the pilot", sprintf("%d; at worst %.2f of it%s", missed, worst, unanswered))
  line("costs more than twice the cheapest accurate model", sprintf("%d; at most %s times", dear, digits(dearest)))
  line("longest choice", sprintf("%.0f ms", slowest))
}

# Of chooser_rods.csv.
function chosen_rods(  k, n, kind, part, count, number, sum, none, overlooked, error, worst, missed, unanswered, more, most, slowest, mean, text, own, best) {
  n = split("straight loaded bent curled", kind, " ")
  for (k = 1; k <= rows; ++k) {
    ++number[cell[k, "shape"]]
    mean += cell[k, "choose_ms"] / rows
    if (cell[k, "choose_ms"] + 0 > slowest) slowest = cell[k, "choose_ms"] + 0
    if (cell[k, "chosen"] == "none") {
      ++none
      if (cell[k, "cheapest"] != "none") ++overlooked
      continue
    }
    split(cell[k, "chosen"], own, /[; ]+/)
    ++count[own[1]]
    # To some kinds of awk "inf" is a number, to others 0.
    if (cell[k, "error"] == "inf") { ++missed; unanswered = "; not answered: some"; continue }
    error = cell[k, "error"] / cell[k, "tolerance"]
    if (error > worst) worst = error
    if (error > 1) ++missed
    split(cell[k, "cheapest"], best, /[; ]+/)
    if (own[1] != best[1] || own[2] !~ /^[0-9]+$/) continue
    if (own[2] > 2 * best[2]) ++more
    if (own[2] / best[2] > most) most = own[2] / best[2]
  }
  for (k = 1; k <= n; ++k) text = text (k == 1 ? "" : ", ") number[kind[k]] + 0 " " kind[k]
  line("of " rows " scenes", text)
  rule(2)
  line("a model was chosen", sprintf("%d: RoundRod %d, TwistedRod %d", rows - none, count["RoundRod"], count["TwistedRod"]))
  line("none was chosen, though a rod would have done on those pushes", overlooked + 0 " of " none + 0)
  line("error above the tolerance, on 60 pushes outside the pilot", sprintf("%d; at worst %.2f of it%s", missed, worst, unanswered))
  line("more than twice the fewest elements that keep the tolerance there", sprintf("%d; at most %s times", more, digits(most)))
  line("a choice, time of the processor", sprintf("%.1f s in the mean, %.0f s at most", mean / 1e3, slowest / 1e3))
}

# A tick with each combination of flags of g++, but for -DNDEBUG, beside other models: a row for each, a column for each model.
function flags(  k, c, f, title, text) {
  for (k = 1; k <= rows; ++k) {
    if (cell[k, "compiler"] != "g++" || cell[k, "flags"] ~ /NDEBUG/ || cell[k, "model"] !~ / beside others$/) continue
    title = "`" cell[k, "model"] "`"
    sub(/ beside others`/, "`", title)
    if (!(title in seen)) { seen[title] = 1; column[++c] = title }
    if (!(cell[k, "flags"] in known)) { known[cell[k, "flags"]] = 1; row[++f] = cell[k, "flags"] }
    over[title, cell[k, "flags"]] = sprintf("%.2f", cell[k, "over_best"])
  }
  text = "| flags |"
  for (k = 1; k <= c; ++k) text = text " " column[k] " |"
  print text
  rule(c + 1)
  for (f = 1; f in row; ++f) {
    text = "| `" row[f] "` |"
    for (k = 1; k <= c; ++k) text = text " " over[column[k], row[f]] " |"
    print text
  }
}

# What a file costs the compiler, dearest first: the README's programs or the headers that programs name most.
function compile_times(programs,  k, j, n, order, t, shown) {
  shown = "^hapbeam/(hapbeam|fem/fem_model|fem/rod_system|contact/touch|haptics/servo/servo_loop|rom/trained/pod_model|" \
    "rom/file/model_file|rom/training/train|scene/choose)\\.hpp$"
  for (k = 1; k <= rows; ++k)
    if (cell[k, "file"] ~ (programs ? "^README" : shown)) order[++n] = k
  for (k = 2; k <= n; ++k)
    for (j = k; j > 1 && cell[order[j], "of_eigen"] + 0 > cell[order[j - 1], "of_eigen"] + 0; --j) {
      t = order[j]; order[j] = order[j - 1]; order[j - 1] = t
    }
  line(programs ? "program" : "header", "seconds", "of `<Eigen/Core>`")
  rule(3)
  for (k = 1; k <= n; ++k) {
    t = cell[order[k], "file"]
    sub(/^hapbeam\//, "", t)
    line(programs ? t : "`" t "`", cell[order[k], "seconds"], cell[order[k], "of_eigen"])
  }
}

# The rooms of include/hapbeam, from the ground up.
function rooms_of_headers(  k, where, holds) {
  line("room", "headers", "holds")
  rule(3)
  for (k = 1; k <= rows; ++k) {
    where = cell[k, "headers"]
    gsub(/ /, "`, `", where)
    holds = cell[k, "holds"]
    gsub(/;/, ",", holds)
    line(cell[k, "room"], "`" where "`", holds)
  }
}

END {
  if (table == "machine") print head "."
  else if (table == "scenes") scenes()
  else if (table == "fronts") fronts()
  else if (table == "trained") trained()
  else if (table == "solvers") solvers()
  else if (table == "rod_ticks") rod_ticks()
  else if (table == "limits") limits()
  else if (table == "many") many()
  else if (table == "chosen") chosen()
  else if (table == "chosen_rods") chosen_rods()
  else if (table == "flags") flags()
  else if (table == "rooms") rooms_of_headers()
  else if (table == "compiled_headers") compile_times(0)
  else if (table == "compiled_programs") compile_times(1)
  else {
    print "no table " table >"/dev/stderr"
    exit 1
  }
}
