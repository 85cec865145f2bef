// The condition of a stiffness, which says how many digits a solution can lose.
#pragma once

#include "support/eigenvalues.hpp"
#include <hapbeam/element/linear.hpp>

namespace hapbeam::testing {

/// Of the bending of a beam between two hinges, n elements; rotations in units of w over the length of the beam.
inline double bending_condition(int n) {
  Vector6<double> r;
  Matrix6<double> k;
  Linear::tangent(ElementProperties<double>(1.0 / n, 1, 1), Vector6<double>::Zero().eval(), r, k);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * (n + 1), 2 * (n + 1));
  const int bending[] = {1, 2, 4, 5};
  for (int e = 0; e < n; ++e)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) K(2 * e + i, 2 * e + j) += k(bending[i], bending[j]);
  for (const int held : {0, 2 * n}) {
    K.row(held).setZero();
    K.col(held).setZero();
    K(held, held) = K(2, 2);
  }
  return Spectrum(K).condition();
}

}  // namespace hapbeam::testing
