// What training makes of snapshots: the matrix of shapes, its stiffness, and the work of a press from its forces.
#include "once_training.hpp"
#include "support/catch.hpp"
#include "support/closed_form.hpp"
#include "support/error.hpp"
#include "support/solver.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/linear.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = thesis_length;

}  // namespace

// Freed of units: shapes of a linear beam are the same column at every depth.
TEST_CASE("snapshots of a linear beam are one shape", "[train]") {
  const Beam beam = thesis_beam(Support::clamped, Support::pinned);
  const FemModel<Linear> full(beam, 16, tight_solver());
  const Eigen::MatrixXd X = snapshot_matrix(take_snapshots(beam, full, TrainingPlan::at(0.3 * L, 0.03, 5)));
  for (Eigen::Index k = 1; k < X.cols(); ++k)
    CHECK((X.col(k) - X.col(0)).cwiseAbs().maxCoeff() <= 1e-9 * X.col(0).cwiseAbs().maxCoeff());
}

// V = ∫F dd, the closed form's by Simpson's rule.
TEST_CASE("the potential that is trained is the work of the press", "[train]") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  const double s = 0.2 * L;
  const Snapshots snapshots = take_snapshots(beam, full_model(beam, 64), TrainingPlan::at(s, 0.05, 14));
  PositionCoordinate<double> position(snapshots.beam);
  const Lagrange<> y(14, snapshots.y_low, snapshots.y_high);
  std::vector<double> K;
  for (const Snapshot& snapshot : snapshots.grid) K.push_back(position.scale(s) * snapshot.stiffness);
  const std::vector<double> work = detail::potential(y, DepthCoordinate<double>(snapshots.beam, true), K);
  PinnedPress force(L, thesis_EA, thesis_EI);
  for (const std::size_t j : {0u, 6u, 13u}) {
    const double d = snapshots.grid[j].d;
    const int panels = 100;
    double V = 0;
    for (int k = 0; k <= panels; ++k)
      V += force(s, d * k / panels) * d / panels / 3 * (k == 0 || k == panels ? 1 : k % 2 ? 4 : 2);
    CHECK(relative_error(work[j], position.scale(s) * 2 * V / (d * d)) <= 1e-6);
  }
}
