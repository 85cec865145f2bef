// Where trainings fail as they are first written: more snapshots that make it worse, depths beyond them, snapshots in metres
// and radians, tables without a potential.  tests/rom has more: noise and the thesis' recipe (thesis_pod.cpp), eigenvalues
// of XXᵀ (pod.cpp), too few modes (galerkin_model.cpp), too few depths (pod_model.cpp).
#include <cmath>

#include "once_training.hpp"
#include "support/catch.hpp"
#include "support/closed_form.hpp"
#include "support/closed_path.hpp"
#include "support/error.hpp"
#include "support/force_table.hpp"
#include "support/mode_counts.hpp"
#include "support/noisy_force.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/guarded.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = thesis_length;

/// What an error of the values can grow by: the largest Σ|l_k|.
template <class Nodes>
double growth(int nodes) {
  const Lagrange<Nodes> axis(nodes, -1.0, 1.0);
  std::vector<double> l(static_cast<std::size_t>(nodes));
  double worst = 0;
  for (int k = 0; k < 1000; ++k) {
    axis.weights(-1 + (2 * k + 1) / 1000.0, l.data());
    double sum = 0;
    for (const double value : l) sum += std::abs(value);
    worst = std::max(worst, sum);
  }
  return worst;
}

}  // namespace

// Beyond some 20 snapshots the polynomial itself is exact to the noise, and what is left is the noise times growth.
TEST_CASE("every further equidistant snapshot makes a training worse; Chebyshev's never do", "[training]") {
  constexpr double noise = 1e-10;
  double before = 0;
  for (const int nodes : {20, 28, 40, 50, 64}) {
    const double equidistant = worst_error<EquispacedNodes>(nodes, noise, 100);
    CAPTURE(nodes, equidistant, growth<EquispacedNodes>(nodes));
    CHECK(equidistant > 10 * before);
    CHECK(worst_error<ChebyshevNodes>(nodes, noise, 100) <= (1 + growth<ChebyshevNodes>(nodes)) * noise);
    before = equidistant;
  }
  CHECK(before > 1e3);
}

// At twice the trained depth.  The truth is the closed form; force over depth grows, so that the tangent at the end of the
// range stays below it.
TEST_CASE("beyond the snapshots a polynomial is anything; the library says so, and stays on the safe side",
          "[training]") {
  const double d = 2 * deepest, truth = force_at_mid_span(d);
  CHECK(relative_error(
            NoisyForce<EquispacedNodes>(50, shallowest, deepest, 0, force_at_mid_span)(1.02 * deepest),
            force_at_mid_span(1.02 * deepest)) > 0.1);
  CHECK(relative_error(NoisyForce<ChebyshevNodes>(14, shallowest, deepest, 0, force_at_mid_span)(d), truth) >
        1);
  const TrainingPlan plan = TrainingPlan::at(L / 2, deepest, 14);
  const auto full = full_model(pinned(), 64);
  PodModel<> pod(train_pod(take_snapshots(pinned(), full, plan)));
  GalerkinModel<> galerkin(train_galerkin(take_snapshots_at_tensions(pinned(), full, plan)));
  const Response<double> tangent = pod.press({L / 2, d}), solved = galerkin.press({L / 2, d});
  CHECK(tangent.status == Status::out_of_range);
  CHECK(tangent.force > pod.press({L / 2, deepest}).force);
  CHECK(tangent.force < truth);
  CHECK(solved.status == Status::out_of_range);
  CHECK(relative_error(solved.force, truth) <= 1e-2);  // as tests/rom/trained/galerkin_model.cpp anywhere
  Guarded<PodModel<>, FemModel<>> guarded(pod, FemModel<>(pinned(), 32));
  const Response<double> handed_over = guarded.press({L / 2, d});
  CHECK(handed_over.status == Status::ok);
  CHECK(relative_error(handed_over.force, truth) <=
        1e-4);  // of 32 elements at 50 mm, tests/verification/press_pinned.cpp
}

// One beam, once in metres and once in millimetres.  What a plain inner product keeps of it depends on that, unless the
// snapshots have been freed of units.
TEST_CASE("in metres and radians the SVD's modes depend on the unit of length; freed of units they do not",
          "[training][units]") {
  const double k = 1000;
  const Beam in_mm(k * L, thesis_EA, k * k * thesis_EI, k * inch, Support::pinned, Support::pinned);
  const Snapshots metres =
      take_snapshots(pinned(), full_model(pinned(), 64), TrainingPlan::anywhere(pinned(), deepest));
  const Snapshots millimetres =
      take_snapshots(in_mm, full_model(in_mm, 64), TrainingPlan::anywhere(in_mm, k * deepest));
  const auto in_metres = modes_needed(raw_snapshots(metres, 1), 0.01),
             in_millimetres = modes_needed(raw_snapshots(millimetres, 1), 0.01),
             freed = modes_needed(snapshot_matrix(metres), 0.01);
  CAPTURE(in_metres, in_millimetres, freed);
  CHECK(in_millimetres[2] >= 2 * in_metres[2]);                      // the rotations of w in mm are small
  CHECK(std::min(in_metres[0], in_millimetres[0]) >= 2 * freed[0]);  // and axial displacements of m in either
  CHECK(modes_needed(snapshot_matrix(millimetres), 0.01) == freed);
  const Pod<> a(snapshot_matrix(metres), Truncation::error(1e-4)),
      b(snapshot_matrix(millimetres), Truncation::error(1e-4));
  CHECK(a.modes() == b.modes());
  // The solver's tolerance, 1e-13, and round-off of 64 elements.
  const double off = (a.singular_values() - b.singular_values()).cwiseAbs().maxCoeff();
  CHECK(off <= 1e-9 * a.singular_values()[0]);
}

// The same full model, as dense a table, force and rotation each on its own.  tests/rom/trained/energy.cpp has the library's.
TEST_CASE("a table of forces without a potential gives energy for going round; a trained model none",
          "[training][energy]") {
  FemModel<> full(pinned(), 64);
  const ForceTable table(full, 0.05 * L, 0.95 * L, 16, deepest, 12);
  const PodModel<> trained(train_pod(
      take_snapshots(pinned(), full_model(pinned(), 64), TrainingPlan::anywhere(pinned(), deepest, 16, 12))));
  double least = 1, most = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    PodModel<> model(trained);
    least = std::min(least, gain(table, seed));
    most = std::max(most, gain(feel_of(model), seed));
  }
  CAPTURE(least, most);
  CHECK(least >= 1e-4);
  CHECK(most <= 1e-7);
}
