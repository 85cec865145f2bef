// SPDX-License-Identifier: MIT
// Beams and rods that are curved or prestressed: through given points, an arch, a string, a buckled strip.
//
// Each is a Beam or Rod with a natural shape of arcs, or with ends that are placed.
// Offline: allocates, throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

/// A beam that is naturally bent through given points, without force between its ends. Its first arc passes through the
/// first three points. The others continue it without a kink, so the points should lie on a smooth curve.
/// @param points  two or more, [m], (x, w); the first is the left end, and the beam's own x axis begins there
inline Beam beam_through(const std::vector<Vector2<double>>& points, const Section& section,
                         const Material& material, Support left, Support right) {
  if (points.size() < 2) detail::reject("points", static_cast<double>(points.size()), "", "two or more");
  // Up is positive here; θ turns the other way.
  const auto angle = [](const Vector2<double>& v) { return std::atan2(v.y(), v.x()); };
  const auto between = [](double a) { return std::remainder(a, 2 * 3.141592653589793238462643); };
  double direction = angle(points[1] - points[0]);
  if (points.size() > 2) {
    // The tangent of the circle through the first three points: inscribed angles.
    direction -= between(angle(points[2] - points[1]) - angle(points[2] - points[0]));
  }
  const double first = direction;
  std::vector<Arc> arcs;
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vector2<double> chord = points[i + 1] - points[i];
    const double c = detail::positive("distance of two points", chord.norm(), "m"),
                 half = between(angle(chord) - direction);
    if (!(std::abs(half) < 1.5)) detail::reject("turn from point to point", 2 * half, "rad", "less than 3");
    const double arc = half == 0 ? c : c * half / std::sin(half);
    arcs.push_back({length += arc, -2 * half / arc});
    direction += 2 * half;
  }
  const Vector2<double> end = points.back() - points.front();
  Beam beam(length, section, material, left, right);
  return beam.naturally(std::move(arcs)).place({0, 0, -first}, {end.x() - length, end.y(), -direction});
}

/// A circular arch between two ends at the same height.
/// @param span [m] from end to end   @param rise [m] of the middle, up; less than half the span
inline Beam arch(double span, double rise, const Section& section, const Material& material, Support ends) {
  detail::positive("span", span, "m");
  detail::positive("rise", rise, "m");
  if (!(rise < span / 2)) detail::reject("rise", rise, "m", "less than half the span");
  const double half = 2 * std::atan(2 * rise / span), length = span * half / std::sin(half);
  Beam beam(length, section, material, ends, ends);
  return beam.naturally({{length, 2 * half / length}}).place({0, 0, -half}, {span - length, 0, half});
}

/// The same beam with its ends moved apart by `by` [m]; negative: together.  A string, or a strip that buckles.
inline Beam stretched(Beam beam, double by) {
  EndPlace right = beam.right_place();
  right.u += by;
  return beam.place(beam.left_place(), right);
}

/// The same beam under a normal force [N]: N L / EA apart.
inline Beam tensioned(const Beam& beam, double force) {
  return stretched(beam, force * beam.length() / beam.axial_stiffness());
}

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

/// Points of a loose overhand knot about the x axis, through which a rod of a World may begin: straight ends, and a loop above a braid of three half turns.
/// @param length, thickness  of the rod [m]   @param radius  of the loop, nine thicknesses or more [m]
/// @return [m] the first and the last are where its ends are, along x
[[gnu::cold]] inline std::vector<VectorOf<double, 3>> overhand_knot(double length, double thickness,
                                                                    double radius) {
  constexpr double half_turn = 3.141592653589793238462643;
  constexpr int pieces = 40;
  detail::positive("thickness", thickness, "m");
  if (!(radius >= 9 * thickness)) detail::reject("radius", radius, "m", "nine thicknesses or more");
  // Of the braid half its length, and its radius.
  const double half = 2.5 * std::sqrt(thickness * radius), beside = 0.75 * thickness;
  std::vector<VectorOf<double, 3>> points(1);
  const auto braid = [&](double from) {
    for (int i = 0; i <= pieces; ++i) {
      const double u = double(i) / pieces, angle = from + 3 * half_turn * u * u * (3 - 2 * u);
      points.push_back({half * (2 * u - 1), beside * std::sin(angle), beside * std::cos(angle)});
    }
  };
  braid(-half_turn / 2);
  for (int i = 1; i < pieces; ++i) {
    const double u = 2.0 * i / pieces, angle = u * half_turn;
    points.push_back({half * (1 - u) + radius * std::sin(angle), beside + radius * (1 - std::cos(angle)), 0});
  }
  braid(half_turn / 2);
  double tied = 0;
  for (std::size_t i = 2; i < points.size(); ++i)
    tied += std::sqrt((points[i] - points[i - 1]).squaredNorm());
  if (!(length > 1.5 * tied)) detail::reject("length", length, "m", "half as long again as what is tied");
  const double end = half + (length - tied) / 2;
  points.front() = {-end, -beside, 0};
  points.push_back({end, -beside, 0});
  return points;
}

}  // namespace hapbeam
