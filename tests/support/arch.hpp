// Arches: one arc of a circle between ends that stand on a level.
#pragma once

#include <cmath>

#include <hapbeam/beam.hpp>

namespace hapbeam::testing {

/// @param length  along the arc   @param angle  of all of it; it stands up where that is positive
inline Beam level_arch(double length, double angle, double EA, double EI, double thickness, Support left,
                       Support right) {
  const double chord = 2 * length / angle * std::sin(angle / 2);
  Beam beam(length, EA, EI, thickness, left, right);
  return beam.naturally({{length, angle / length}}).place({0, 0, -angle / 2}, {chord - length, 0, angle / 2});
}

inline double level_arch_rise(double length, double angle) {
  return 2 * length / angle * std::pow(std::sin(angle / 4), 2);
}

}  // namespace hapbeam::testing
