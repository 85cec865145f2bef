// An axis-aligned box in the plane.
//
// A plain value.  No allocation, noexcept, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/centreline.hpp>

namespace hapbeam::detail {

/// Empty until it includes something.
template <typename Scalar>
struct Box {
  // Scalars: packets of two would be loaded right after their halves were stored, which stalls.
  Scalar x_low = std::numeric_limits<Scalar>::infinity(), x_high = -x_low, y_low = x_low, y_high = -x_low;

  void include(Scalar x, Scalar y) noexcept {
    x_low = std::min(x_low, x), x_high = std::max(x_high, x);
    y_low = std::min(y_low, y), y_high = std::max(y_high, y);
  }
  void include(const CubicSegment<Scalar>& b) noexcept {
    for (int k = 0; k < 4; ++k) include(b(0, k), b(1, k));
  }
  void include(const Box& other) noexcept {
    x_low = std::min(x_low, other.x_low), x_high = std::max(x_high, other.x_high);
    y_low = std::min(y_low, other.y_low), y_high = std::max(y_high, other.y_high);
  }
  /// So much larger on all sides [m].
  [[nodiscard]] Box grown(Scalar by) const noexcept {
    return {x_low - by, x_high + by, y_low - by, y_high + by};
  }
  [[nodiscard]] Scalar distance_squared(const Vector2<Scalar>& q) const noexcept {
    const Scalar x = std::max(std::max(x_low - q.x(), q.x() - x_high), Scalar(0));
    const Scalar y = std::max(std::max(y_low - q.y(), q.y() - y_high), Scalar(0));
    return x * x + y * y;
  }
  [[nodiscard]] bool overlaps(const Box& other) const noexcept {
    return x_low <= other.x_high && other.x_low <= x_high && y_low <= other.y_high && other.y_low <= y_high;
  }
  /// Whether the straight way from a to b meets it: no axis of either separates them.
  [[nodiscard]] bool meets(const Vector2<Scalar>& a, const Vector2<Scalar>& b) const noexcept {
    Box way;
    way.include(a.x(), a.y());
    way.include(b.x(), b.y());
    if (!overlaps(way)) return false;
    const Scalar dx = b.x() - a.x(), dy = b.y() - a.y();
    const Scalar off = dx * (y_low + y_high - 2 * a.y()) - dy * (x_low + x_high - 2 * a.x());
    // What is too large to be multiplied counts as met.  It is infinite, not NaN, where the compiler fuses product and difference.
    return !(std::isfinite(off) &&
             std::abs(off) > std::abs(dx) * (y_high - y_low) + std::abs(dy) * (x_high - x_low));
  }
};

}  // namespace hapbeam::detail
