// The rods of tests/data/rods_in_space.csv, and what it takes to press them.
#pragma once

#include <cmath>
#include <string>

#include "support/pi.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

namespace hapbeam::testing {

using Point = VectorOf<double, 3>;

inline constexpr RodMaterial spring_steel{200e9, 77e9};

/// A pose turned about a unit axis [rad].
inline RodPose turned(RodPose pose, const Point& axis, double angle) {
  const auto turn = [&](const Point& x) -> Point {
    const Point along = axis.dot(x) * axis;
    return along + std::cos(angle) * (x - along) + std::sin(angle) * detail::cross3(axis, x);
  };
  return {pose.at, turn(pose.along), turn(pose.director)};
}

/// A rod that is pressed along a direction at one place, and how many elements a turn of it has.
struct PressedRod {
  Rod rod;
  double s;
  Point normal;
  int turns;
};

inline PressedRod pressed_rod(const std::string& name) {
  if (name == "wire_under_load") {
    Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
    return {wire.load(Point(0, -1.2, 0)), 0.14, {0, 0, 1}, 1};
  }
  if (name == "bar_two_ways") {
    Rod bar(1, RodSection::circle(0.006), spring_steel, RodSupport::cardan, RodSupport::hinged);
    return {bar.load(Point(0, -20, 0)), 0.3, {0, 0, 1}, 1};
  }
  if (name == "strip_askew") {
    const Rod strip(0.2, RodSection::rectangle(0.010, 0.0005), spring_steel, RodSupport::clamped,
                    RodSupport::free);
    return {strip, 0.16, {0, std::sqrt(0.5), std::sqrt(0.5)}, 1};
  }
  if (name == "hook") {
    const double length = pi * 0.05;
    Rod hook(length, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
    return {hook.naturally({{length, 0, 20, 0}}), length, {0, 0, 1}, 1};
  }
  const double radius = 0.01, rise = 0.006 / (2 * pi), square = radius * radius + rise * rise,
               length = 6 * pi * std::sqrt(square);
  Rod spring(length, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
  spring.naturally({{length, 0, radius / square, rise / square}})
      .place_left({{radius, 0, 0}, {0, radius, rise}, {-1, 0, 0}});
  return {spring, length, {0, 0, -1}, 3};
}

}  // namespace hapbeam::testing
