// Finite states that no device has, and whether a record of them is finite in all of its fields.
#pragma once

#include <cmath>
#include <limits>

#include "support/random.hpp"
#include <hapbeam/haptics/servo/servo_record.hpp>

namespace hapbeam::testing {

/// Of any size that a double has.
inline double hostile_number(Random& random) {
  using Limits = std::numeric_limits<double>;
  switch (random.integer(0, 6)) {
    case 0: return Limits::max();
    case 1: return -Limits::max();
    case 2: return Limits::denorm_min();
    case 3: return random(1);
    default: return (random.integer(0, 1) ? 1 : -1) * std::pow(10, random(-300, 308));
  }
}

/// A field of `usual` or several, or all, are any finite numbers.
inline OrientedState hostile_state(const OrientedState& usual, Random& random) {
  OrientedState state = usual;
  const auto spoil = [&](auto& matrix) {
    if (random.integer(0, 5)) return;
    const bool all = random.integer(0, 1);
    for (int i = 0; i < matrix.size(); ++i)
      if (all || !random.integer(0, 2)) matrix.data()[i] = hostile_number(random);
  };
  spoil(state.position), spoil(state.velocity), spoil(state.sent), spoil(state.sent_torque);
  spoil(state.orientation);
  if (!random.integer(0, 5)) state.time = hostile_number(random);
  state.cut = static_cast<ForceCut>(random.integer(0, 3));
  state.reset = !random.integer(0, 20);
  return state;
}

/// @return the name of a field that is not finite, else null
inline const char* not_finite(const ServoRecord& r) {
  const auto bad = [](const Eigen::Vector3d& v) { return !v.allFinite(); };
  const auto none = [](double v) { return !std::isfinite(v); };
  return none(r.time)                              ? "time"
         : bad(r.position)                         ? "position"
         : bad(r.hand)                             ? "hand"
         : bad(r.avatar)                           ? "avatar"
         : bad(r.force)                            ? "force"
         : bad(r.torque)                           ? "torque"
         : bad(r.shaft)                            ? "shaft"
         : none(r.press.s) || none(r.press.d)      ? "press"
         : bad(r.friction)                         ? "friction"
         : none(r.dissipated)                      ? "dissipated"
         : none(r.heat)                            ? "heat"
         : none(r.max_press)                       ? "max_press"
         : none(r.max_force) || none(r.max_torque) ? "max_force"
         : none(r.energy_generated)                ? "energy_generated"
                                                   : nullptr;
}

}  // namespace hapbeam::testing
