// SPDX-License-Identifier: MIT
// Rods of a natural shape through points in space.
//
// Offline: allocates, throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include <hapbeam/rod.hpp>

namespace hapbeam {

/// A rod that is naturally bent through given points, by circular arcs without a kink and without twist.  Its first arc is that of
/// the first three points; the others go on from there, so the points should lie on a smooth curve.
/// @param points  two or more [m]; the first is the left end, the last the right one
/// @param director  d1 at the left end, across the first tangent or made so
[[gnu::cold]] inline Rod rod_through(const std::vector<VectorOf<double, 3>>& points,
                                     const RodSection& section, const RodMaterial& material,
                                     const RodSupport& left, const RodSupport& right,
                                     const VectorOf<double, 3>& director = {0, 1, 0}) {
  using Point = VectorOf<double, 3>;
  if (points.size() < 2) detail::reject("points", static_cast<double>(points.size()), "", "two or more");
  const auto chord = [&points](std::size_t a, std::size_t b) {
    const Point way = points[b] - points[a];
    return Point(way / detail::positive("distance of two points", std::sqrt(way.squaredNorm()), "m"));
  };
  Point along = chord(0, 1);
  if (points.size() > 2) {
    // The tangent of the circle through three points: inscribed angles.  From the second chord to the third side is as far.
    const Point second = chord(1, 2), third = chord(0, 2), turn = detail::cross3(second, third);
    const double sine = std::sqrt(turn.squaredNorm());
    if (sine > 1e-12) {
      const Point axis = turn / sine;
      const double angle = std::atan2(sine, second.dot(third));
      along = std::cos(angle) * along + std::sin(angle) * detail::cross3(axis, along);
    }
  }
  RodPose pose{points.front(), along, director};
  if (!pose.make_valid())
    detail::reject("director", std::sqrt(director.squaredNorm()), "", "across the first tangent");
  std::vector<RodArc> arcs;
  double length = 0;
  Point d1 = pose.director;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point c = chord(i, i + 1), way = points[i + 1] - points[i], turn = detail::cross3(along, c);
    const double sine = std::sqrt(turn.squaredNorm()), half = std::atan2(sine, along.dot(c));
    if (!(half < 1.5)) detail::reject("turn from point to point", 2 * half, "rad", "less than 3");
    const double arc = std::sqrt(way.squaredNorm()) * (sine > 0 ? half / sine : 1);
    const Point omega = sine > 0 ? Point(2 * half / (arc * sine) * turn) : Point(0, 0, 0);
    arcs.push_back({length += arc, omega.dot(d1), omega.dot(detail::cross3(along, d1)), 0});
    const Point next = 2 * along.dot(c) * c - along;
    d1 = detail::across<double>(detail::carry(d1, along, next), next);
    along = next;
  }
  Rod rod(length, section, material, left, right);
  return rod.naturally(std::move(arcs)).place_left(pose);
}

}  // namespace hapbeam
