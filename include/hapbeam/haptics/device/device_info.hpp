// SPDX-License-Identifier: MIT
// What a device can do, the one check of it, and the clock of its loop and what is late in it.
//
// Coupling, energy monitor and force guard take their figures from here, and each calls check().
// Offline: throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <Eigen/Core>

#include <hapbeam/check.hpp>

namespace hapbeam {

namespace detail {

/// Checks the period of a loop: nanoseconds are counted in 64 bits, and a damper is divided by it.
[[gnu::cold]] inline double loop_period(const char* field, double seconds) {
  if (!(seconds >= 1e-6 && seconds <= 1e3)) reject(field, positive(field, seconds, "s"), "s", "1e-6 to 1e3");
  return seconds;
}

/// What is late by whole ticks.
class DelayLine {
 public:
  static constexpr int longest = 16;

  DelayLine() noexcept { clear(); }
  static int checked(int ticks) {
    if (!(ticks >= 0 && ticks <= longest)) reject("delay_ticks", ticks, "", "0 to 16");
    return ticks;
  }
  /// @param newest  of this tick   @param ticks  0 to longest   @return of so many ticks ago; zero where there was none
  const Eigen::Vector3d& pass(const Eigen::Vector3d& newest, int ticks) noexcept {
    std::move_backward(all_.begin(), all_.end() - 1, all_.end());
    all_[0] = newest;
    return all_[static_cast<std::size_t>(ticks)];
  }
  void clear() noexcept { all_.fill(Eigen::Vector3d::Zero()); }

 private:
  std::array<Eigen::Vector3d, longest + 1> all_;
};

}  // namespace detail

/// Figures of a gimbal, the three rotations of a device; by default there is none.
struct GimbalInfo {
  bool reads = false;            ///< reads the orientation of the stylus
  double peak_torque = 0;        ///< [N·m] magnitude, short-term; 0: it renders no torque
  double continuous_torque = 0;  ///< [N·m] without limit of time
  double max_stiffness = 0;      ///< [N·m/rad] the largest that the maker states; 0 where unknown
  double resolution = 0;         ///< [rad]
  double friction = 0;           ///< [N·m] to turn the stylus by hand
  double damping = 0;            ///< [N·m·s/rad] viscous, of the gimbal itself; 0 where unknown
  double inertia = 0;            ///< [kg·m²] of gimbal and stylus; 0 where unknown

  /// @throws std::invalid_argument where a figure is negative or not finite, or a torque has no lasting share
  void check() const {
    detail::not_negative("gimbal peak_torque", peak_torque, "N·m");
    if (peak_torque > 0) detail::positive("gimbal continuous_torque", continuous_torque, "N·m");
    else detail::not_negative("gimbal continuous_torque", continuous_torque, "N·m");
    detail::not_negative("gimbal max_stiffness", max_stiffness, "N·m/rad");
    detail::not_negative("gimbal resolution", resolution, "rad");
    detail::not_negative("gimbal friction", friction, "N·m");
    detail::not_negative("gimbal damping", damping, "N·m·s/rad");
    detail::not_negative("gimbal inertia", inertia, "kg·m²");
  }
};

struct DeviceInfo {
  std::string name;
  Eigen::Vector3d workspace;   ///< [m] width, height, depth, the origin in its middle
  double peak_force;           ///< [N] short-term
  double continuous_force;     ///< [N] without limit of time
  double max_stiffness;        ///< [N/m] the largest that the maker states for a wall
  double position_resolution;  ///< [m]
  double friction;             ///< [N] to drive the arm back by hand
  double period;               ///< [s] of the servo loop
  double damping;              ///< [N·s/m] viscous, of the arm itself; 0 where unknown
  double apparent_mass;        ///< [kg] of the arm at its tip; 0 where unknown
  GimbalInfo gimbal = {};      ///< of a device with rotations

  /// @throws std::invalid_argument unless forces and stiffness are positive, the period is 1e-6 to 1e3 s, the others are not
  /// negative, and all are finite.  Name and workspace are for programs: no loop uses them.
  /// @return the same figures
  const DeviceInfo& check() const {
    detail::positive("device peak_force", peak_force, "N");
    detail::positive("device continuous_force", continuous_force, "N");
    detail::positive("device max_stiffness", max_stiffness, "N/m");
    detail::not_negative("device position_resolution", position_resolution, "m");
    detail::not_negative("device friction", friction, "N");
    detail::loop_period("device period", period);
    detail::not_negative("device damping", damping, "N·s/m");
    detail::not_negative("device apparent_mass", apparent_mass, "kg");
    gimbal.check();
    return *this;
  }
};

/// [s]  A longer time between two ticks is a pause, unless two periods are longer.
inline constexpr double default_longest_pause = 0.1;

/// The time that has passed since the tick before, by the clock of the loop.  A host's loop comes early, late or in bursts.  Its clock may
/// begin anywhere, stand, be set back or be no number.  Nothing may be divided by such a time, and nothing may grow by it.  After a
/// pause the hand may be anywhere: what reaches it begins anew.
/// Real-time: no allocation, noexcept, wait-free, O(1).
class LoopClock {
 public:
  struct Passed {
    double dt;    ///< [s] since the tick before; 0 where the clock stands, runs backwards or is no number
    double step;  ///< [s] to divide by: dt, at least half a period; a period where dt is 0, and after a pause
    bool pause;   ///< the clock has gone on by more than the longest pause, or was set back by more
  };

  /// @param period  [s] of the loop, 1e-6 to 1e3   @param longest_pause [s] not negative   @throws std::invalid_argument
  explicit LoopClock(double period, double longest_pause = default_longest_pause)
      : period_(detail::loop_period("device period", period)),
        longest_((std::max)(longest_pause, 2 * period)) {
    detail::not_negative("longest_pause", longest_pause, "s");
  }

  /// @param time [s] now, by a monotonic clock
  Passed passed(double time) noexcept {
    if (!std::isfinite(time)) return {0, period_, false};
    const double dt = time - std::exchange(time_, time);
    if (std::abs(dt) > longest_) return {dt > 0 ? dt : 0, period_, true};
    return dt > 0 ? Passed{dt, (std::max)(dt, period_ / 2), false} : Passed{0, period_, false};
  }

 private:
  double period_, longest_;
  double time_ = 0;
};

}  // namespace hapbeam
