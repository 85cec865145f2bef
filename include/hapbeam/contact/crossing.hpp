// SPDX-License-Identifier: MIT
// Where a straight path crosses a plane cubic, for an avatar that moves farther in a tick than it is thick.
//
// The signed distance of the cubic from the path's line is a cubic in t with the same Bernstein weights. Each of its
// roots between the path's ends is a crossing.
// No allocation, noexcept, bounded work.
#pragma once

#include <hapbeam/centreline.hpp>
#include <hapbeam/contact/bernstein.hpp>

namespace hapbeam {

/// How often a path crosses a curve, and which way in sum.
struct Crossings {
  int count = 0;
  int net = 0;  ///< crossings that leave the +1 side less those that enter it

  Crossings& operator+=(const Crossings& other) noexcept {
    count += other.count;
    net += other.net;
    return *this;
  }
};

/// Twice the signed area of (a, b): positive where b points to the left of a, the +1 side of a curve along a.
template <typename Scalar>
Scalar cross(const Vector2<Scalar>& a, const Vector2<Scalar>& b) noexcept {
  return a.x() * b.y() - a.y() * b.x();
}

/// Crossings of the path p0 -> p1 with one piece, p1 included and p0 not: what a step ends on it has crossed, and the next has left behind.  Over
/// neighbouring pieces they add up: a crossing at their common node counts once.
/// @param b  [m] control points   @param p0, p1  [m]
/// Real-time: noexcept, no allocation, bounded.
template <typename Scalar>
Crossings crossings(const CubicSegment<Scalar>& b, const Vector2<Scalar>& p0,
                    const Vector2<Scalar>& p1) noexcept {
  using Vector = Vector2<Scalar>;
  const Vector path = p1 - p0;
  detail::Bernstein<Scalar, 3> side, along;
  for (int k = 0; k < 4; ++k) {
    const Vector p = b.col(k) - p0;
    side[static_cast<std::size_t>(k)] = cross(path, p);
    along[static_cast<std::size_t>(k)] = path.dot(p);
  }
  const Scalar length_squared = path.squaredNorm();
  Crossings result;
  detail::for_each_sign_change(side, [&](const detail::SignChange<Scalar>& change) {
    const auto evaluate = [](const detail::Bernstein<Scalar, 3>& c, Scalar t) -> detail::ValueSlope<Scalar> {
      const Scalar a1 = 3 * (c[1] - c[0]), a2 = 3 * (c[2] - 2 * c[1] + c[0]),
                   a3 = c[3] - c[0] + 3 * (c[1] - c[2]);
      return {c[0] + t * (a1 + t * (a2 + t * a3)), a1 + t * (2 * a2 + 3 * t * a3)};
    };
    const Scalar t = detail::polish_root(change, [&](Scalar at) { return evaluate(side, at); });
    const Scalar reached = evaluate(along, t).value;
    if (!(reached > 0 && reached <= length_squared)) return;
    ++result.count;
    result.net += change.rising ? 1 : -1;
  });
  return result;
}

}  // namespace hapbeam
