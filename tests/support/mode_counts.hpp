// How many modes it takes to hold every snapshot of a training.  Includes an SVD.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/rom/training/train.hpp>

namespace hapbeam::testing {

/// Snapshots as they come, u and w in so many of a unit to the metre and θ in radians, a column each.
inline Eigen::MatrixXd raw_snapshots(const Snapshots& snapshots, double per_metre) {
  Eigen::MatrixXd X(3 * (snapshots.plan.segments + 1), static_cast<Eigen::Index>(snapshots.grid.size()));
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    Eigen::Index row = 0;
    for (const auto& node : snapshots.grid[static_cast<std::size_t>(k)].nodes) {
      X.col(k).segment<3>(row) << per_metre * node.u, per_metre * node.w, node.theta;
      row += 3;
    }
  }
  return X;
}

/// What so many modes leave of the snapshots, of the largest entry of each column: the worst column, for u, w and θ.
class LeftOver {
 public:
  explicit LeftOver(const Eigen::MatrixXd& X)
      : X_(X), pod_(X, Truncation::count(static_cast<int>(X.rows()))) {}

  int modes() const { return pod_.modes(); }
  std::array<double, 3> operator()(int modes) const {
    const auto basis = pod_.basis().leftCols(modes);
    const Eigen::MatrixXd left = X_ - basis * (basis.transpose() * X_);
    const auto largest = [](const Eigen::MatrixXd& A, Eigen::Index kind, Eigen::Index column) {
      return A.col(column)(Eigen::seq(kind, Eigen::last, 3)).cwiseAbs().maxCoeff();
    };
    std::array<double, 3> worst{};
    for (Eigen::Index kind = 0; kind < 3; ++kind)
      for (Eigen::Index k = 0; k < X_.cols(); ++k) {
        double& at = worst[static_cast<std::size_t>(kind)];
        at = std::max(at, largest(left, kind, k) / largest(X_, kind, k));
      }
    return worst;
  }

 private:
  Eigen::MatrixXd X_;
  Pod<> pod_;
};

/// The fewest modes that leave less than `tolerance`, for u, w and θ.
inline std::array<int, 3> modes_needed(const Eigen::MatrixXd& X, double tolerance) {
  const LeftOver left(X);
  std::array<int, 3> needed{};
  for (int modes = 1; modes <= left.modes(); ++modes) {
    const std::array<double, 3> worst = left(modes);
    for (std::size_t kind = 0; kind < 3; ++kind)
      if (needed[kind] == 0 && worst[kind] < tolerance) needed[kind] = modes;
  }
  return needed;
}

}  // namespace hapbeam::testing
