// How many modes it takes to hold every snapshot of a training.  Includes an SVD.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/rom/train.hpp>

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

/// The fewest modes that leave less than `tolerance` of the largest entry of each column, by kind: u, w, θ.
inline std::array<int, 3> modes_needed(const Eigen::MatrixXd& X, double tolerance) {
  const Pod<> pod(X, Truncation::count(static_cast<int>(X.rows())));
  std::array<int, 3> needed{};
  for (int modes = 1; modes <= pod.modes(); ++modes) {
    const auto basis = pod.basis().leftCols(modes);
    const Eigen::MatrixXd left = X - basis * (basis.transpose() * X);
    for (Eigen::Index kind = 0; kind < 3; ++kind) {
      int& found = needed[static_cast<std::size_t>(kind)];
      const auto largest = [kind](const Eigen::MatrixXd& A, Eigen::Index column) {
        return A.col(column)(Eigen::seq(kind, Eigen::last, 3)).cwiseAbs().maxCoeff();
      };
      double worst = 0;
      for (Eigen::Index k = 0; k < X.cols(); ++k) worst = std::max(worst, largest(left, k) / largest(X, k));
      if (found == 0 && worst < tolerance) found = modes;
    }
  }
  return needed;
}

}  // namespace hapbeam::testing
