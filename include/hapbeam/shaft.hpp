// SPDX-License-Identifier: MIT
// The axis of an avatar in space: a straight piece, or a point.
//
// A plain value.  No allocation, noexcept, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/centreline.hpp>

namespace hapbeam {

/// From its tip to its other end; a point where `way` is zero.
template <typename Scalar>
struct Shaft {
  VectorOf<Scalar, 3> tip = VectorOf<Scalar, 3>::Zero();  ///< [m]
  VectorOf<Scalar, 3> way = VectorOf<Scalar, 3>::Zero();  ///< [m] from the tip to the other end

  /// Where along the way, 0 to 1, it is nearest to a point.
  [[nodiscard]] Scalar nearest(const VectorOf<Scalar, 3>& point) const noexcept {
    const Scalar squared = way.squaredNorm();
    if (!(squared > 0)) return 0;
    return std::clamp(way.dot(point - tip) / squared, Scalar(0), Scalar(1));
  }
  [[nodiscard]] bool is_point() const noexcept { return !(way.squaredNorm() > 0); }
  [[nodiscard]] VectorOf<Scalar, 3> at(Scalar t) const noexcept { return tip + t * way; }
};

}  // namespace hapbeam
