// SPDX-License-Identifier: MIT
// Shape functions of the six degrees of freedom (thesis eq. 3.22, 3.28): linear in u, cubic Hermite in w, θ = -dw/dx.
#pragma once

#include <hapbeam/element/element.hpp>

namespace hapbeam {

/// Values at t = (x - x1)/l of what a nodal displacement moves.  Real-time: noexcept, O(1).
template <typename Scalar>
struct ShapeFunctions {
  Scalar u1, u2;                      ///< u(x) = u1 d[0] + u2 d[3]
  Eigen::Matrix<Scalar, 4, 1> w;      ///< w(x) = w · (w1, θ1, w2, θ2)   [-, m, -, m]
  Eigen::Matrix<Scalar, 4, 1> theta;  ///< θ(x) = theta · (w1, θ1, w2, θ2)   [1/m, -, 1/m, -]

  ShapeFunctions(Scalar t, Scalar length) noexcept : u1(1 - t), u2(t) {
    const Scalar r = 1 - t;
    w = {r * r * (1 + 2 * t), -length * t * r * r, t * t * (3 - 2 * t), length * t * t * r};
    theta = {6 * t * r / length, r * (1 - 3 * t), -6 * t * r / length, t * (3 * t - 2)};
  }

  /// Nodal forces that do the work of a force (axial, transverse) [N] and moment [N·m] at this point.
  Vector6<Scalar> nodal_forces(Scalar axial, Scalar transverse, Scalar moment) const noexcept {
    const Eigen::Matrix<Scalar, 4, 1> bending = transverse * w + moment * theta;
    return {u1 * axial, bending[0], bending[1], u2 * axial, bending[2], bending[3]};
  }
};

}  // namespace hapbeam
