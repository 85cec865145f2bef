// SPDX-License-Identifier: MIT
// An axis-aligned box in a plane or in space.
//
// A plain value.  No allocation, noexcept, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/centreline.hpp>
#include <hapbeam/shaft.hpp>

namespace hapbeam::detail {

/// Empty until it includes something.
/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
struct Box {
  // Scalars: packets of two would be loaded right after their halves were stored, which stalls.
  Scalar low[D], high[D];

  Box() noexcept {
    for (int k = 0; k < D; ++k)
      low[k] = std::numeric_limits<Scalar>::infinity(), high[k] = -std::numeric_limits<Scalar>::infinity();
  }

  void include(const VectorOf<Scalar, D>& p) noexcept {
    for (int k = 0; k < D; ++k) low[k] = (std::min)(low[k], p[k]), high[k] = (std::max)(high[k], p[k]);
  }
  void include(const CubicSegment<Scalar, D>& b) noexcept {
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < D; ++k)
        low[k] = (std::min)(low[k], b(k, j)), high[k] = (std::max)(high[k], b(k, j));
  }
  void include(const Box& other) noexcept {
    for (int k = 0; k < D; ++k)
      low[k] = (std::min)(low[k], other.low[k]), high[k] = (std::max)(high[k], other.high[k]);
  }
  /// So much larger on all sides [m].
  [[nodiscard]] Box grown(Scalar by) const noexcept {
    Box box;
    for (int k = 0; k < D; ++k) box.low[k] = low[k] - by, box.high[k] = high[k] + by;
    return box;
  }
  [[nodiscard]] Scalar distance_squared(const VectorOf<Scalar, D>& q) const noexcept {
    Scalar sum = 0;
    for (int k = 0; k < D; ++k) {
      const Scalar away = (std::max)((std::max)(low[k] - q[k], q[k] - high[k]), Scalar(0));
      sum += away * away;
    }
    return sum;
  }
  /// In space: a lower bound of that to a shaft, from the box around the shaft and from the ball around this one.
  [[nodiscard]] Scalar distance_squared(const Shaft<Scalar>& shaft) const noexcept {
    if (shaft.way.isZero(0)) return distance_squared(shaft.tip);
    VectorOf<Scalar, D> centre, half;
    Scalar sum = 0;
    for (int k = 0; k < D; ++k) {
      const Scalar end = shaft.tip[k] + shaft.way[k], lowest = (std::min)(shaft.tip[k], end),
                   highest = (std::max)(shaft.tip[k], end),
                   away = (std::max)((std::max)(low[k] - highest, lowest - high[k]), Scalar(0));
      sum += away * away;
      centre[k] = (low[k] + high[k]) / 2, half[k] = (high[k] - low[k]) / 2;
    }
    const Scalar gap =
        std::sqrt((shaft.at(shaft.nearest(centre)) - centre).squaredNorm()) - std::sqrt(half.squaredNorm());
    return gap > 0 ? (std::max)(sum, gap * gap) : sum;
  }
  [[nodiscard]] bool overlaps(const Box& other) const noexcept {
    for (int k = 0; k < D; ++k)
      if (!(low[k] <= other.high[k] && other.low[k] <= high[k])) return false;
    return true;
  }
  /// In a plane: whether the straight way from a to b meets it, no axis of either separates them.
  [[nodiscard]] bool meets(const Vector2<Scalar>& a, const Vector2<Scalar>& b) const noexcept {
    Box way;
    way.include(a);
    way.include(b);
    if (!overlaps(way)) return false;
    const Scalar dx = b.x() - a.x(), dy = b.y() - a.y();
    const Scalar off = dx * (low[1] + high[1] - 2 * a.y()) - dy * (low[0] + high[0] - 2 * a.x());
    // What is too large to be multiplied counts as met.  It is infinite, not NaN, where the compiler fuses product and difference.
    return !(std::isfinite(off) &&
             std::abs(off) > std::abs(dx) * (high[1] - low[1]) + std::abs(dy) * (high[0] - low[0]));
  }
};

}  // namespace hapbeam::detail
