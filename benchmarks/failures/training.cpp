// Trainings: nodes, noise, depths beyond them, modes, units, squares, and forces without a potential.
#include <cmath>

#include "report.hpp"
#include "support/closed_form.hpp"
#include "support/closed_path.hpp"
#include "support/error.hpp"
#include "support/force_table.hpp"
#include "support/global_modes.hpp"
#include "support/mode_counts.hpp"
#include "support/noisy_force.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/guarded.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

namespace hapbeam::benchmarks {

namespace {

using namespace hapbeam::testing;

constexpr double L = thesis_length;

void interpolation(Report& report) {
  Series by_nodes = report.series("interpolation", "snapshots,equispaced,equispaced_noisy,chebyshev_noisy");
  int best = 0;
  double least = 1;
  for (int n = 4; n <= 64; n += 2) {
    const double error = worst_error<EquispacedNodes>(n, 0, 200);
    if (error < least) least = error, best = n;
    by_nodes.add(n, error, worst_error<EquispacedNodes>(n, 1e-10, 200),
                 worst_error<ChebyshevNodes>(n, 1e-10, 200));
  }
  report.failure("equidistant-snapshots", "above " + std::to_string(best) + " snapshots the error grows");
  for (const int n : {14, 50, 64})
    report.row("largest error of the force, " + std::to_string(n) + " exact snapshots",
               number(worst_error<EquispacedNodes>(n, 0, 200)),
               number(worst_error<ChebyshevNodes>(n, 0, 200)));

  Series by_noise = report.series("noise", "noise,equispaced_50,chebyshev_50,chebyshev_14");
  for (int power = -15; power <= -2; ++power) {
    const double noise = std::pow(10, power);
    by_noise.add(noise, worst_error<EquispacedNodes>(50, noise, 200),
                 worst_error<ChebyshevNodes>(50, noise, 200), worst_error<ChebyshevNodes>(14, noise, 200));
  }
  report.failure("noise", "error 1 % from a relative noise of " +
                              number(first_beyond(
                                  [](double noise) { return worst_error<EquispacedNodes>(50, noise, 200); },
                                  0.01, 1e-16, 1)));
  for (const double noise : {1e-13, 1e-10, 1e-6})
    report.row("largest error of the force, 50 snapshots with a noise of " + number(noise),
               number(worst_error<EquispacedNodes>(50, noise, 200)),
               number(worst_error<ChebyshevNodes>(50, noise, 200)));
}

void extrapolation(Report& report) {
  const TrainingPlan plan = TrainingPlan::at(L / 2, deepest, 14);
  const auto full = full_model(pinned());
  PodModel<> pod(train_pod(take_snapshots(pinned(), full, plan)));
  GalerkinModel<> galerkin(train_galerkin(take_snapshots_at_tensions(pinned(), full, plan)));
  Guarded<PodModel<>, FemModel<>> guarded(pod, FemModel<>(pinned(), 32));
  NoisyForce<EquispacedNodes> thesis(50, shallowest, deepest, 0, force_at_mid_span);
  NoisyForce<ChebyshevNodes> polynomial(14, shallowest, deepest, 0, force_at_mid_span);
  const auto error = [](double force, double d) { return relative_error(force, force_at_mid_span(d)); };
  const auto pressed = [&](auto& model, double d) { return error(model.press({L / 2, d}).force, d); };
  Series series = report.series("extrapolation", "depth,equispaced_50,chebyshev_14,pod,galerkin,guarded");
  for (double ratio = 0.8; ratio <= 3; ratio += 0.02) {
    const double d = ratio * deepest;
    series.add(ratio, error(thesis(d), d), error(polynomial(d), d), pressed(pod, d), pressed(galerkin, d),
               pressed(guarded, d));
  }
  const auto beyond = [&](auto& model) {
    const auto error_beyond = [&](double by) {
      const double d = deepest * (1 + by);
      return error(model(d), d);
    };
    return percent(first_beyond(error_beyond, 0.01, 1e-9, 2));
  };
  report.failure("beyond-the-snapshots", "error 1 % at " + beyond(thesis) +
                                             " beyond the depth of 50 equidistant snapshots, at " +
                                             beyond(polynomial) + " beyond that of 14 Chebyshev snapshots");
  for (const double ratio : {1.6, 2.0, 3.0}) {
    const double d = ratio * deepest;
    report.row("error of the force at " + number(ratio) +
                   " times the trained depth (`PodModel`, `GalerkinModel`, `Guarded`)",
               percent(error(polynomial(d), d)),
               percent(pressed(pod, d)) + ", " + percent(pressed(galerkin, d)) + ", " +
                   percent(pressed(guarded, d)));
  }
}

void modes(Report& report) {
  GalerkinModel<> model(train_galerkin(
      take_snapshots_at_tensions(pinned(), full_model(pinned()), TrainingPlan::anywhere(pinned(), deepest))));
  PinnedPress exact(L, thesis_EA, thesis_EI);
  constexpr double places[] = {0.06, 0.1, 0.3}, d = 40e-3;
  double moving = 0;
  for (const double at : places)
    moving = std::max(moving, relative_error(model.press({at * L, d}).force, exact(at * L, d)));
  const auto global = [&](int n) {
    double worst = 0;
    for (const double at : places)
      worst = std::max(worst, relative_error(force_in_global_modes(n, at * L, d), exact(at * L, d)));
    return worst;
  };
  Series series = report.series("modes", "modes,global,moving");
  int enough = 0;
  for (int n = 1; n <= 100; ++n) {
    const double error = global(n);
    if (error > 0.01) enough = n + 1;
    series.add(n, error, moving);
  }
  report.failure("too-few-modes", "error 1 % requires " + std::to_string(enough) + " global modes");
  for (const int n : {3, 8})
    report.row("error of the force at 6 to 30 % of the span: " + std::to_string(n) +
                   " global modes; one mode that moves with the contact",
               percent(global(n)), percent(moving));
}

void decomposition(Report& report) {
  const Snapshots snapshots =
      take_snapshots(pinned(), full_model(pinned(), 64), TrainingPlan::anywhere(pinned(), deepest));
  const LeftOver metres(raw_snapshots(snapshots, 1)), millimetres(raw_snapshots(snapshots, 1000)),
      freed(snapshot_matrix(snapshots));
  const auto worst = [](const LeftOver& left, int n) {
    const auto kinds = left(n);
    return *std::max_element(kinds.begin(), kinds.end());
  };
  Series units = report.series("units", "modes,metres,millimetres,freed");
  for (int n = 1; n <= 80; ++n) units.add(n, worst(metres, n), worst(millimetres, n), worst(freed, n));
  const auto in_m = modes_needed(raw_snapshots(snapshots, 1), 0.01),
             in_mm = modes_needed(raw_snapshots(snapshots, 1000), 0.01),
             free_of = modes_needed(snapshot_matrix(snapshots), 0.01);
  report.failure("metres-and-radians", "with any unit of length");
  const char* kinds[] = {"axial displacements", "deflections", "rotations"};
  for (std::size_t k = 0; k < 3; ++k)
    report.row(std::string("modes for an error of 1 % of all ") + kinds[k] + ": in m, in mm; dimensionless",
               std::to_string(in_m[k]) + ", " + std::to_string(in_mm[k]), std::to_string(free_of[k]));

  const Eigen::MatrixXd X = snapshot_matrix(snapshots);
  const Truncation all = Truncation::count(static_cast<int>(X.rows()));
  const Pod<Svd> svd(X, all);
  const Pod<MethodOfSnapshots> squared(X, all);
  const auto sigma = [&](const auto& pod, Eigen::Index i) {
    return pod.singular_values()[i] / svd.singular_values()[0];
  };
  Series spectrum = report.series("spectrum", "mode,svd,squared");
  double first = 0, last = 0;
  for (Eigen::Index i = 0; i < svd.singular_values().size(); ++i) {
    spectrum.add(static_cast<double>(i + 1), sigma(svd, i), sigma(squared, i));
    if (relative_error(sigma(squared, i), sigma(svd, i)) <= 0.01) first = sigma(svd, i);
    if (sigma(svd, i) > 1e-14) last = sigma(svd, i);
  }
  report.failure("squares", "error 1 % in singular values below " + number(first) + " of the first");
  report.row("smallest accurate singular value, over the first", number(first), number(last));
}

void potential(Report& report) {
  FemModel<> full(pinned(), 64);
  const ForceTable table(full, 0.05 * L, 0.95 * L, 16, deepest, 12);
  PodModel<> trained(train_pod(
      take_snapshots(pinned(), full_model(pinned(), 64), TrainingPlan::anywhere(pinned(), deepest, 16, 12))));
  std::uint64_t worst = 0;
  double least = 1, most = 0, library = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const double here = gain(table, seed);
    if (here > most) most = here, worst = seed;
    least = std::min(least, here);
    library = std::max(library, gain(feel_of(trained), seed));
  }
  // Round after round, over what one round stores.
  std::vector<double> by_table, by_model;
  const ClosedPath path(worst);
  path.go_round(table, [&](double work) { by_table.push_back(work); });
  path.go_round(feel_of(trained), [&](double work) { by_model.push_back(work); });
  const auto range = std::minmax_element(by_model.begin(), by_model.end());
  const double stored = *range.second - *range.first;
  Series series = report.series("potential", "rounds,table,trained");
  for (int round = 0; round < 5; ++round)
    for (std::size_t k = 0; k < by_table.size(); k += 40)
      series.add(round + static_cast<double>(k) / ClosedPath::steps,
                 (round * by_table.back() + by_table[k]) / stored,
                 (round * by_model.back() + by_model[k]) / stored);
  report.failure("no-potential", "with any table: " + percent(least) + " to " + percent(most) +
                                     " of the stored energy in each round");
  report.row("largest energy gained or lost in a round of ten closed paths, over the stored energy",
             number(most), number(library));
}

}  // namespace

void training(Report& report) {
  interpolation(report);
  extrapolation(report);
  modes(report);
  decomposition(report);
  potential(report);
}

}  // namespace hapbeam::benchmarks
