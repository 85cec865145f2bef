// How stiff and how damped a coupling may be in the hands of a device.
//
// A spring K with a damper B is sampled at T. Its force is held over the period and late by n more periods. Held and
// late forces return energy, and the arm's damping must absorb it:
//
//   b > K T (1/2 + n) + |B|        b: viscous damping of the arm      passive, whatever the hand     (1)
//   K <= 2 f / Δ                   f: the arm's friction, Δ: resolution of its encoders              (2)
//   B <= f T / Δ                   one step of the encoders within one period                        (3)
//
// (1) for n = 0 is Colgate and Schenkel (J. Robotic Systems 14(1), 1997), (2) with K <= 2b/T Abbott and Okamura (IEEE
// Trans. Robotics 21(5), 2005), (3) the same argument for the damper: friction holds what a step of the grid
// changes in the force.
// Offline: throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/check.hpp>
#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

/// A spring and a damper between hand and beam, in the device's metres.
struct CouplingFigures {
  double stiffness;  ///< K [N/m] positive
  double damping;    ///< B [N·s/m] not negative
};

/// K at which a spring alone takes all of the arm's damping: b / (T (1/2 + n)) [N/m], by (1).
/// @param damping b [N·s/m]   @param period T [s]   @param delay_ticks n
inline double passive_stiffness(double damping, double period, int delay_ticks) noexcept {
  return damping / (period * (0.5 + delay_ticks));
}

/// [N·s/m]  Assumed for an arm of unknown damping. A hand on a stylus has 0.8 to 1.8 (published fits; docs/haptics.md),
/// so arm and hand together have more even if the arm has none.
inline constexpr double least_damping = 0.5;

/// The coupling that a device can render with a margin of a quarter of (1). The spring takes two fifths of the arm's
/// damping, or the maker's largest stiffness if that is less. The damper takes the rest up to three quarters. Of (2)
/// and (3), half. With half of the damping the spring would be a quarter stiffer, but four times as many heavy hands
/// would still move half a second after a step.
/// For an arm of unknown damping (0) least_damping is assumed.
/// @param delay_ticks  whole periods between the servo's answer and the motors, besides the one that holds it; 0 to 16
/// @throws std::invalid_argument where the device's damping, friction, resolution, stiffness or period cannot be
inline CouplingFigures safe_coupling(const DeviceInfo& device, int delay_ticks = 0) {
  constexpr double spring_share = 0.4, both_share = 0.75, friction_share = 0.5;
  if (!(std::isfinite(device.damping) && device.damping >= 0))
    detail::reject("device damping", device.damping, "N·s/m",
                   "finite and not negative; 0 where it is unknown");
  const double b = device.damping > 0 ? device.damping : least_damping;
  const double T = detail::loop_period("device period", device.period);
  const double hardest = detail::positive("device max_stiffness", device.max_stiffness, "N/m");
  if (!(device.friction >= 0)) detail::reject("device friction", device.friction, "N", "not negative");
  if (!(device.position_resolution >= 0))
    detail::reject("device position_resolution", device.position_resolution, "m", "not negative");
  if (!(delay_ticks >= 0 && delay_ticks <= 16)) detail::reject("delay_ticks", delay_ticks, "", "0 to 16");
  const double bound = passive_stiffness(b, T, delay_ticks);
  double stiffness = (std::min)(hardest, spring_share * bound);
  double damping = b;
  // An arm without friction holds no step of the grid; (1) is all there is.
  if (device.friction > 0 && device.position_resolution > 0) {
    const double held = friction_share * device.friction / device.position_resolution;
    stiffness = (std::min)(stiffness, 2 * held);
    damping = held * T;
  }
  return {stiffness, (std::min)(damping, (both_share - stiffness / bound) * b)};
}

/// [m]  Distance of the fingers on a stylus from its centre of rotation. A hand's rotational stiffness, damping and
/// inertia are the translational ones times its square.
inline constexpr double grip_lever = 0.03;

/// The same for the rotation: K [N·m/rad] and B [N·m·s/rad], by the same inequalities. For a gimbal of unknown damping
/// (0) least_damping at grip_lever is assumed: 4.5e-4 N·m·s/rad.
/// @throws as safe_coupling(), for the figures of the device's gimbal
inline CouplingFigures safe_turning_coupling(const DeviceInfo& device, int delay_ticks = 0) {
  const GimbalInfo& gimbal = device.gimbal;
  const auto not_negative = [](const char* field, double value, const char* unit) {
    if (!(std::isfinite(value) && value >= 0))
      detail::reject(field, value, unit, "finite and not negative; 0 where it is unknown");
    return value;
  };
  DeviceInfo turning = device;  // with radians for metres
  turning.damping = not_negative("gimbal damping", gimbal.damping, "N·m·s/rad");
  if (turning.damping == 0) turning.damping = least_damping * grip_lever * grip_lever;
  turning.friction = not_negative("gimbal friction", gimbal.friction, "N·m");
  turning.position_resolution = not_negative("gimbal resolution", gimbal.resolution, "rad");
  turning.max_stiffness = not_negative("gimbal max_stiffness", gimbal.max_stiffness, "N·m/rad");
  if (turning.max_stiffness == 0) turning.max_stiffness = (std::numeric_limits<double>::max)();
  return safe_coupling(turning, delay_ticks);
}

}  // namespace hapbeam
