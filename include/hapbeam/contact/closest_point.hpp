// SPDX-License-Identifier: MIT
// The point of a cubic that is nearest to a given point, in a plane or in space, or to a shaft in space: the global
// minimum over t in [0, 1].
//
// With p(t) = C(t) - q the distance is stationary where g(t) = p . p' = 0, a polynomial of degree five. Its Bernstein
// coefficients are short sums of dot products of control points. Their signs isolate the minima: nearly always one or
// none, in which case an end is nearest. The cubic is arbitrary, loops included.
//
// And where a straight path crosses a plane cubic, for an avatar that moves farther in a tick than it is thick. The signed
// distance of the cubic from the path's line is a cubic in t with the same Bernstein weights. Each of its roots between
// the path's ends is a crossing.
// No allocation, noexcept, bounded work.
#pragma once

#include <algorithm>
#include <limits>

#include <hapbeam/centreline.hpp>
#include <hapbeam/contact/bernstein.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

/// A point of one piece, seen from a query point.
template <typename Scalar, int D = 2>
struct ClosestPoint {
  Scalar t;  ///< parameter in [0, 1]; exactly 0 or 1 at an end
  VectorOf<Scalar, D>
      offset;               ///< [m] from the point of the curve to the query point, or to that of the shaft
  Scalar distance_squared;  ///< [m²] offset . offset
};

/// A point of a piece [m].
template <typename Scalar, int D>
VectorOf<Scalar, D> point_at(const CubicSegment<Scalar, D>& b, Scalar t) noexcept {
  const Scalar r = 1 - t;
  return r * r * (r * control_point(b, 0) + 3 * t * control_point(b, 1)) +
         t * t * (3 * r * control_point(b, 2) + t * control_point(b, 3));
}

/// Derivative dC/dt of a piece [m], for its direction: where it vanishes, the chord's.
template <typename Scalar, int D>
[[gnu::always_inline]] inline VectorOf<Scalar, D> tangent(const CubicSegment<Scalar, D>& b,
                                                          Scalar t) noexcept {
  const Scalar r = 1 - t;
  VectorOf<Scalar, D> velocity = 3 * (r * r * (control_point(b, 1) - control_point(b, 0)) +
                                      2 * r * t * (control_point(b, 2) - control_point(b, 1)) +
                                      t * t * (control_point(b, 3) - control_point(b, 2)));
  if (velocity.squaredNorm() > 0) return velocity;
  return control_point(b, 3) - control_point(b, 0);
}

namespace detail {

/// Calls visit(t, p(t)) for each t within (0, 1) at which a cubic p comes nearest to the origin, of all beside it.
/// @param p0, p1, p2, p3  [m] its control points
template <typename Scalar, int D, class Visit>
[[gnu::always_inline]] inline void for_each_foot(const VectorOf<Scalar, D>& p0, const VectorOf<Scalar, D>& p1,
                                                 const VectorOf<Scalar, D>& p2, const VectorOf<Scalar, D>& p3,
                                                 Visit&& visit) noexcept {
  using Vector = VectorOf<Scalar, D>;
  const Vector e0 = p1 - p0, e1 = p2 - p1, e2 = p3 - p2;  // p' / 3 in Bernstein form
  const Bernstein<Scalar, 5> g = {p0.dot(e0),
                                  (2 * p0.dot(e1) + 3 * p1.dot(e0)) / 5,
                                  (p0.dot(e2) + 6 * p1.dot(e1) + 3 * p2.dot(e0)) / 10,
                                  (3 * p1.dot(e2) + 6 * p2.dot(e1) + p3.dot(e0)) / 10,
                                  (3 * p2.dot(e2) + 2 * p3.dot(e1)) / 5,
                                  p3.dot(e2)};
  for_each_sign_change(g, [&](const SignChange<Scalar>& change) {
    if (!change.rising) return;  // a maximum
    const Vector a1 = 3 * e0, a2 = 3 * (e1 - e0), a3 = e2 - 2 * e1 + e0;
    const auto position = [&](Scalar t) -> Vector { return p0 + t * (a1 + t * (a2 + t * a3)); };
    const Scalar t = polish_root(change, [&](Scalar at) -> ValueSlope<Scalar> {
      const Vector p = position(at), v = a1 + at * (2 * a2 + 3 * at * a3), a = 2 * a2 + 6 * at * a3;
      return {p.dot(v), v.dot(v) + p.dot(a)};
    });
    visit(t, position(t));
  });
}

}  // namespace detail

/// Nearest point of the piece to q, of all t in [0, 1]; among equals an end, and the start before the end.
/// @param b  [m] control points   @param q  [m]
/// Real-time: noexcept, no allocation, bounded.
template <typename Scalar, int D>
[[gnu::always_inline]] inline ClosestPoint<Scalar, D> closest_point(const CubicSegment<Scalar, D>& b,
                                                                    const VectorOf<Scalar, D>& q) noexcept {
  using Vector = VectorOf<Scalar, D>;
  const Vector p0 = control_point(b, 0) - q, p1 = control_point(b, 1) - q, p2 = control_point(b, 2) - q,
               p3 = control_point(b, 3) - q;
  ClosestPoint<Scalar, D> best{0, -p0, p0.squaredNorm()};
  const Scalar end = p3.squaredNorm();
  if (end < best.distance_squared) best = {1, -p3, end};
  detail::for_each_foot(p0, p1, p2, p3, [&](Scalar t, const Vector& p) {
    const Scalar d = p.squaredNorm();
    if (d < best.distance_squared) best = {t, -p, d};
  });
  return best;
}

/// The same to a shaft.  Nearest are the points nearest to its ends, and between them those of the curve as seen along it.
template <typename Scalar>
ClosestPoint<Scalar, 3> closest_point(const CubicSegment<Scalar, 3>& b, const Shaft<Scalar>& shaft) noexcept {
  using Vector = VectorOf<Scalar, 3>;
  const Scalar squared = shaft.way.squaredNorm();
  if (!(squared > 0)) return closest_point(b, shaft.tip);
  Vector p[4];
  for (int k = 0; k < 4; ++k) {
    p[k] = control_point(b, k) - shaft.tip;
    p[k] -= shaft.way.dot(p[k]) / squared * shaft.way;
  }
  ClosestPoint<Scalar, 3> best{0, Vector::Zero(), std::numeric_limits<Scalar>::infinity()};
  Scalar on_axis = best.distance_squared;  // the nearest point's of all of the axis
  const auto see = [&](Scalar t, const Vector& point, Scalar from_axis) {
    on_axis = (std::min)(on_axis, from_axis);
    const Vector offset = shaft.at(shaft.nearest(point)) - point;
    const Scalar d = offset.squaredNorm();
    if (d < best.distance_squared) best = {t, offset, d};
  };
  see(0, control_point(b, 0), p[0].squaredNorm());
  see(1, control_point(b, 3), p[3].squaredNorm());
  detail::for_each_foot(p[0], p[1], p[2], p[3], [&](Scalar t, const Vector& from_axis) {
    see(t, point_at(b, t), from_axis.squaredNorm());
  });
  // What is nearest to all of its axis and beside the shaft is nearest to the shaft.
  constexpr Scalar round_off = 1 + 64 * std::numeric_limits<Scalar>::epsilon();
  if (best.distance_squared <= on_axis * round_off) return best;
  for (const Vector& end : {shaft.tip, Vector(shaft.tip + shaft.way)}) {
    const ClosestPoint<Scalar, 3> other = closest_point(b, end);
    if (other.distance_squared < best.distance_squared) best = other;
  }
  return best;
}

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
    const Vector p = control_point(b, k) - p0;
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
