// SPDX-License-Identifier: MIT
// The last stage before the device: limits force and torque, whatever the servo has computed.
//
// In this order, each tick:
//   failure      a force that is not finite, or a tick that the caller calls unsafe: zero at once, and engage anew
//   peak         |F| <= peak
//   heat         of the motors, which goes with F²:  q' = (F²/Fc² - q)/τ.  The force that is allowed falls from peak to
//                the continuous Fc as q goes from warm to 1, so q <= 1 always: Fc for ever, more for a moment
//   engage       after start, failure or a pause what is allowed comes in linearly over engage_time, by a period a tick at most
//   slew         the force grows by at most slew_rate · dt; toward zero it may fall at once
//
// dt is the time since the tick before, by the device's clock; two periods at most.  If the clock stands, runs backwards or is NaN,
// nothing grows, and the motors are heated for a period.  After longest_pause, or where the clock has been set back by more, the hand
// may be anywhere: the force engages anew.
// A torque is treated likewise, with limits and motors of its own.  Failure and engagement apply to both.
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include <hapbeam/check.hpp>
#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/device/device_info.hpp>

namespace hapbeam {

struct ForceGuardOptions {
  double peak_force;         ///< [N] positive
  double continuous_force;   ///< Fc [N] positive, at most the peak
  double period;             ///< [s] of the loop, 1e-6 to 1e3
  double slew_rate = 1e4;    ///< [N/s] positive; 10 N a millisecond is faster than any hand
  double thermal_time = 10;  ///< τ [s] positive; of small motors' windings, of housings minutes
  double engage_time = 0.2;  ///< [s] not negative
  double longest_pause = default_longest_pause;  ///< [s] not negative; two periods are no pause
  double peak_torque = 0;                        ///< [N·m] not negative; 0: no torque is sent
  double continuous_torque = 0;                  ///< [N·m] positive, at most the peak, where there is one
  double torque_slew_rate = 100;  ///< [N·m/s] positive; at a lever of 0.1 m a tenth of the force's
};

struct GuardedForce : Wrench {
  bool limited;   ///< cut by peak, heat or slew
  bool engaging;  ///< reduced because the loop has just started or restarted
};

namespace detail {

/// Motors of one kind, of a force or a torque: how warm they are, and what was sent last.
class GuardedMotors {
 public:
  struct Limits {
    double peak, lasting, slew_rate, period, thermal_time;
  };

  explicit GuardedMotors(const Limits& limits) noexcept : o_(limits) {}

  double heat() const noexcept { return heat_; }
  const Eigen::Vector3d& sent() const noexcept { return sent_; }
  void stop() noexcept { sent_.setZero(); }

  /// Heats the motors by what was sent in the period that has ended.   @param dt [s] its length; 0 where the clock is wrong
  void warm_up(double dt) noexcept {
    const double ratio = sent_.norm() / o_.lasting;
    heat_ += -std::expm1(-(dt > 0 ? dt : o_.period) / o_.thermal_time) * (ratio * ratio - heat_);
  }
  /// @param asked  finite   @param share  of what is allowed   @param dt [s] 0 where nothing may grow
  /// @return whether it was cut; sent() is what is left
  bool limit(const Eigen::Vector3d& asked, double share, double dt) noexcept {
    Eigen::Vector3d force = asked;
    bool limited = limit_force(force, allowed()) != ForceCut::none;
    force *= share;
    limited |= limit_growth(force, o_.slew_rate * (std::min)(dt, 2 * o_.period));
    sent_ = force;
    return limited;
  }

 private:
  static constexpr double warm = 0.5;  // heat from which on the peak is not allowed

  /// At most what heats the motors to 1 in a period, however short τ is.
  double allowed() const noexcept {
    const double peak = o_.peak * o_.peak, lasting = o_.lasting * o_.lasting;
    const double cool = std::clamp((1 - heat_) / (1 - warm), 0.0, 1.0);
    const double gain = -std::expm1(-o_.period / o_.thermal_time);
    const double at_once = lasting * (std::max)(1.0, heat_ + (1 - heat_) / gain);
    return std::sqrt((std::min)(lasting + (peak - lasting) * cool, at_once));
  }
  /// To within `most` of the nearest point between what was sent last and zero.   @return true where it was farther
  bool limit_growth(Eigen::Vector3d& force, double most) const noexcept {
    const double size = sent_.squaredNorm();
    const double along = size > 0 ? std::clamp(force.dot(sent_) / size, 0.0, 1.0) : 0;
    const Eigen::Vector3d from = along * sent_;
    const Eigen::Vector3d growth = force - from;
    const double length = growth.norm();
    if (!(length > most)) return false;
    return force = from + growth * (most / length), true;
  }

  Limits o_;
  Eigen::Vector3d sent_{0, 0, 0};
  double heat_ = 0;
};

}  // namespace detail

class ForceGuard {
 public:
  /// @throws std::invalid_argument naming the field of its options
  explicit ForceGuard(const ForceGuardOptions& options)
      : o_(checked(options)),
        clock_(o_.period, o_.longest_pause),
        force_({o_.peak_force, o_.continuous_force, o_.slew_rate, o_.period, o_.thermal_time}),
        torque_({o_.peak_torque, o_.peak_torque > 0 ? o_.continuous_torque : 1, o_.torque_slew_rate,
                 o_.period, o_.thermal_time}) {}

  /// The device's own limits, the rest by default.   @throws std::invalid_argument as DeviceInfo::check()
  static ForceGuardOptions for_device(const DeviceInfo& device) {
    device.check();
    ForceGuardOptions options{device.peak_force, (std::min)(device.continuous_force, device.peak_force),
                              device.period};
    options.peak_torque = device.gimbal.peak_torque;
    options.continuous_torque = (std::min)(device.gimbal.continuous_torque, device.gimbal.peak_torque);
    return options;
  }

  /// q, 0 cold to 1: the continuous force, or torque, is all there is.  Of those motors that are warmer.
  double heat() const noexcept { return (std::max)(force_.heat(), torque_.heat()); }
  const Eigen::Vector3d& force() const noexcept { return force_.sent(); }    ///< [N] sent last
  const Eigen::Vector3d& torque() const noexcept { return torque_.sent(); }  ///< [N·m] sent last

  /// Share of the force that came in in the last tick, 0 to 1.
  double came_in() const noexcept { return came_in_; }

  /// Zero, and engage anew.  The motors stay as warm as they are.
  void reset() noexcept {
    force_.stop(), torque_.stop();
    engaged_ = 0;
  }

  /// @param wanted  force and torque   @param time [s] of the device's clock   @param safe  false: zero, whatever is wanted
  GuardedForce limit(const Wrench& wanted, double time, bool safe) noexcept {
    const LoopClock::Passed passed = clock_.passed(time);
    const bool turns = o_.peak_torque > 0;
    force_.warm_up(passed.dt);
    if (turns) torque_.warm_up(passed.dt);
    if (!engage(passed, safe && wanted.force.allFinite() && wanted.torque.allFinite()))
      return {{force(), torque()}, false, true};
    bool limited = force_.limit(wanted.force, engaged_, passed.dt);
    if (turns) limited |= torque_.limit(wanted.torque, engaged_, passed.dt);
    return {{force(), torque()}, limited, engaged_ < 1};
  }
  /// A force alone [N].
  GuardedForce limit(const Eigen::Vector3d& wanted, double time, bool safe) noexcept {
    return limit(Wrench{wanted}, time, safe);
  }

 private:
  /// @return whether anything may be sent
  bool engage(const LoopClock::Passed& passed, bool good) noexcept {
    if (passed.pause || !good) reset();
    const double before = engaged_, most = (std::min)(passed.dt, o_.period);
    if (good) engaged_ = most < o_.engage_time ? (std::min)(1.0, engaged_ + most / o_.engage_time) : 1;
    came_in_ = engaged_ - before;
    return good;
  }

  static ForceGuardOptions checked(const ForceGuardOptions& o) {
    detail::positive("peak_force", o.peak_force, "N");
    detail::positive("continuous_force", o.continuous_force, "N");
    if (!(o.continuous_force <= o.peak_force))
      detail::reject("continuous_force", o.continuous_force, "N", "at most the peak force");
    detail::loop_period("period", o.period);
    detail::positive("slew_rate", o.slew_rate, "N/s");
    detail::positive("thermal_time", o.thermal_time, "s");
    detail::not_negative("engage_time", o.engage_time, "s");
    detail::not_negative("longest_pause", o.longest_pause, "s");
    detail::not_negative("peak_torque", o.peak_torque, "N·m");
    if (o.peak_torque > 0 && !(o.continuous_torque > 0 && o.continuous_torque <= o.peak_torque))
      detail::reject("continuous_torque", o.continuous_torque, "N·m", "positive, at most the peak torque");
    detail::positive("torque_slew_rate", o.torque_slew_rate, "N·m/s");
    return o;
  }

  ForceGuardOptions o_;
  LoopClock clock_;
  detail::GuardedMotors force_, torque_;
  double engaged_ = 0, came_in_ = 0;  // shares of the force
};

}  // namespace hapbeam
