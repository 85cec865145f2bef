// SPDX-License-Identifier: MIT
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
#include <limits>
#include <string>

#include <hapbeam/check.hpp>
#include <hapbeam/haptics/device/device_info.hpp>

namespace hapbeam {

/// A spring and a damper between hand and beam, in the device's metres.
struct CouplingFigures {
  double stiffness;  ///< K [N/m] positive
  double damping;    ///< B [N·s/m] not negative

  CouplingFigures operator*(double factor) const noexcept { return {stiffness * factor, damping * factor}; }
};

/// K at which a spring alone takes all of the arm's damping: b / (T (1/2 + n)) [N/m], by (1).
/// @param damping b [N·s/m]   @param period T [s]   @param delay_ticks n
inline double passive_stiffness(double damping, double period, int delay_ticks) noexcept {
  return damping / (period * (0.5 + delay_ticks));
}

/// [N·s/m]  Assumed for an arm of unknown damping. A hand on a stylus has 0.8 to 1.8 (published fits; docs/haptics.md),
/// so arm and hand together have more even if the arm has none.
inline constexpr double least_damping = 0.5;

namespace detail {

/// @param what  they are of, for the message   @param k, b  units   @throws std::invalid_argument
inline CouplingFigures checked(const CouplingFigures& figures, const char* what, const char* k,
                               const char* b) {
  positive((std::string(what) + " stiffness").c_str(), figures.stiffness, k);
  not_negative((std::string(what) + " damping").c_str(), figures.damping, b);
  return figures;
}

/// An arm, or a gimbal with radians for metres.
struct ArmFigures {
  double damping;     // b [N·s/m] positive
  double friction;    // f [N] not negative
  double resolution;  // Δ [m] not negative
  double hardest;     // [N/m] positive
};

/// @throws std::invalid_argument for a delay that is not 0 to 16
inline CouplingFigures renderable(const ArmFigures& arm, double T, int delay_ticks) {
  constexpr double spring_share = 0.4, both_share = 0.75, friction_share = 0.5;
  const double bound = passive_stiffness(arm.damping, T, DelayLine::checked(delay_ticks));
  double stiffness = (std::min)(arm.hardest, spring_share * bound);
  double damping = arm.damping;
  // An arm without friction holds no step of the grid; (1) is all there is.
  if (arm.friction > 0 && arm.resolution > 0) {
    const double steady = friction_share * arm.friction / arm.resolution;
    stiffness = (std::min)(stiffness, 2 * steady);
    damping = steady * T;
  }
  return {stiffness, (std::min)(damping, (both_share - stiffness / bound) * arm.damping)};
}

}  // namespace detail

/// The coupling that a device can render with a margin of a quarter of (1). The spring takes two fifths of the arm's damping, or the
/// maker's largest stiffness if that is less. The damper takes the rest up to three quarters. Of (2) and (3), half. With half of the
/// damping for the spring four times as many heavy hands would still move half a second after a step.
/// For an arm of unknown damping (0) least_damping is assumed.
/// @param delay_ticks  whole periods between the servo's answer and the motors, besides the one that holds it; 0 to 16
/// @throws std::invalid_argument as DeviceInfo::check(), and for another delay
inline CouplingFigures safe_coupling(const DeviceInfo& device, int delay_ticks = 0) {
  device.check();
  return detail::renderable({device.damping > 0 ? device.damping : least_damping, device.friction,
                             device.position_resolution, device.max_stiffness},
                            device.period, delay_ticks);
}

/// [m]  Distance of the fingers on a stylus from its centre of rotation. A hand's rotational stiffness, damping and
/// inertia are the translational ones times its square.
inline constexpr double grip_lever = 0.03;

/// The same for the rotation: K [N·m/rad] and B [N·m·s/rad], by the same inequalities. For a gimbal of unknown damping
/// (0) least_damping at grip_lever is assumed: 4.5e-4 N·m·s/rad.
/// @throws as safe_coupling()
inline CouplingFigures safe_turning_coupling(const DeviceInfo& device, int delay_ticks = 0) {
  device.check();
  const GimbalInfo& gimbal = device.gimbal;
  return detail::renderable(
      {gimbal.damping > 0 ? gimbal.damping : least_damping * grip_lever * grip_lever, gimbal.friction,
       gimbal.resolution,
       gimbal.max_stiffness > 0 ? gimbal.max_stiffness : (std::numeric_limits<double>::max)()},
      device.period, delay_ticks);
}

}  // namespace hapbeam
