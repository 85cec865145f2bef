// SPDX-License-Identifier: MIT
// What a scene in space asks of a model: a rod, where and how deep it is pushed, and what error and time are allowed.
//
// Offline: throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/press_range.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/scene/scene.hpp>
#include <hapbeam/turning_plane.hpp>

namespace hapbeam {

struct RodScene {
  Rod rod;
  double s_min, s_max;  ///< [m] where it is pushed; equal: at one place
  double
      depth;  ///< [m] how far it is pushed from where it rests, to any side; beside a support a fifth of the distance
  double force_error = 0.05;  ///< largest relative error of the force; a hand tells forces apart from 7 % on
  double force_floor = 0;  ///< [N] smaller forces count as this one, where they change sign or cannot be felt
  double tick = 50e-6;     ///< [s] largest time of a push
  bool shape = true;       ///< contact and drawing want the shape in each tick

  /// Anywhere from 5 to 95 % of the length, or up to an end that yields.
  static RodScene anywhere(const Rod& rod, double depth) {
    const double L = rod.length();
    const Range<double> range = PressRange<double>(rod).range();
    return {rod, range.s_min > 0 ? 0.05 * L : 0, range.s_max < L ? 0.95 * L : L, depth};
  }
  /// At one place.
  static RodScene at(const Rod& rod, double s, double depth) { return {rod, s, s, depth}; }

  bool one_place() const noexcept { return s_min == s_max; }

  /// How deep it is pushed at s along cos d1 + sin d2 [m].  A flat rod that is pushed askew gives way across the push: its depth is
  /// less by that, as a straight one's of even stiffness is.
  double depth_at(double s, double cosine, double sine) const noexcept {
    const Range<double> range = PressRange<double>(rod).range();
    double deep = depth;
    if (range.s_min > 0) deep = (std::min)(deep, s / 5);
    if (range.s_max < rod.length()) deep = (std::min)(deep, (rod.length() - s) / 5);
    const double x = cosine / rod.stiffness().bending2, y = sine / rod.stiffness().bending1;
    return deep * (cosine * x + sine * y) / std::hypot(x, y);
  }

  /// The same in a plane, where that is exact: turning_plane.hpp.
  std::optional<Scene> in_any_plane() const {
    try {
      const Beam beam = beam_in_any_plane(rod);
      (void)TurningPlane<FemModel<Corotational<>>>(rod, {beam, 16});  // it rests straight
      // Turned, a push by all of the depth is a press by that and its round-off.
      return Scene{beam, s_min, s_max, depth * (1 + 1e-12), force_error, force_floor, tick, shape};
    } catch (const std::invalid_argument&) {
      return {};
    }
  }

  /// @throws std::invalid_argument
  const RodScene& check() const {
    const Range<double> range = PressRange<double>(rod).range();
    detail::finite("s_min", s_min, "m");
    detail::finite("s_max", s_max, "m");
    if (!(s_min >= 0.999999 * range.s_min && s_min <= s_max))
      detail::reject("s_min", s_min, "m",
                     "on the rod, at most s_max, a thousandth away from an end that is held");
    if (!(s_max <= range.s_max + 1e-6 * range.s_min))
      detail::reject("s_max", s_max, "m", "on the rod, a thousandth away from an end that is held");
    detail::positive("depth", depth, "m");
    detail::positive("force_error", force_error, "");
    detail::not_negative("force_floor", force_floor, "N");
    detail::positive("tick", tick, "s");
    return *this;
  }
};

}  // namespace hapbeam
