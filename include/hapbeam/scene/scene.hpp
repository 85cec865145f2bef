// SPDX-License-Identifier: MIT
// The requirements of a scene: a beam, where and how deep it is pressed, and the tolerated error and time.
//
// Offline: throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <cmath>

#include <hapbeam/beam.hpp>

namespace hapbeam {

namespace detail {

/// What a Scene and a RodScene have alike.   @param low, high [m] where it may be pressed
template <class S>
[[gnu::cold]] void check_scene(const S& scene, double low, double high, const char* body) {
  finite("s_min", scene.s_min, "m");
  finite("s_max", scene.s_max, "m");
  const char* const away = "a thousandth away from an end that is held";
  if (!(scene.s_min >= low && scene.s_min <= scene.s_max))
    refuse("s_min = %g m: must be on the %s, at most s_max, %s", scene.s_min, body, away);
  if (!(scene.s_max <= high)) refuse("s_max = %g m: must be on the %s, %s", scene.s_max, body, away);
  positive("depth", scene.depth, "m");
  positive("force_error", scene.force_error, "");
  not_negative("force_floor", scene.force_floor, "N");
  positive("tick", scene.tick, "s");
}

}  // namespace detail

struct Scene {
  Beam beam;
  double s_min, s_max;  ///< [m] where it is pressed; equal: at one place
  /// [m] How deep, from the untouched beam, to either side.  Beside a support no deeper than press() of Corotational<> answers, a third
  /// of the distance or so.  A beam that rests aside by more than a tenth of that limit needs a depth that is answered there from rest.
  double depth;
  double force_error = 0.05;  ///< largest relative error of the force; a hand tells forces apart from 7 % on
  double force_floor = 0;  ///< [N] smaller forces count as this one, where they change sign or cannot be felt
  double tick = 50e-6;     ///< [s] largest time of a press
  bool shape = true;  ///< contact and drawing want the shape in each tick; a hand at a known place may not

  /// Anywhere from 5 to 95 % of the length, or up to an end that yields.
  static Scene anywhere(const Beam& beam, double depth) {
    const double L = beam.length();
    return {beam, fixes_w(beam.left()) ? 0.05 * L : 0, fixes_w(beam.right()) ? 0.95 * L : L, depth};
  }
  /// At one place.
  static Scene at(const Beam& beam, double s, double depth) { return {beam, s, s, depth}; }

  bool one_place() const noexcept { return s_min == s_max; }

  /// Whether half of the beam is enough: pressed in the middle, alike on both sides.
  bool mirrored() const noexcept {
    const EndPlace &a = beam.left_place(), &b = beam.right_place();
    return one_place() && std::abs(2 * s_min - beam.length()) < 1e-9 * beam.length() &&
           beam.left() == beam.right() && beam.parts().empty() && beam.arcs().empty() && a.u == 0 &&
           a.w == 0 && a.theta == 0 && b.w == 0 && b.theta == 0 && beam.point_loads().empty() &&
           !beam.transverse() && !beam.axial();
  }

  /// @throws std::invalid_argument
  const Scene& check() const {
    const double margin = 0.999999 * beam.length() / 1000;
    detail::check_scene(*this, fixes_w(beam.left()) ? margin : 0,
                        beam.length() - (fixes_w(beam.right()) ? margin : 0), "beam");
    if (!beam.parts().empty())
      detail::reject("scene beam sections", static_cast<double>(beam.parts().size()), "",
                     "none, one section for all of it: take FemModel<Tapered<>>, or "
                     "FemModel<Corotational<Tapered<>>> for finite rotation");
    return *this;
  }
};

}  // namespace hapbeam
