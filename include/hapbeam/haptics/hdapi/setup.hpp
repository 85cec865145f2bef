// SPDX-License-Identifier: MIT
// How a device of HDAPI is set up: what is asked of it, its calibration, and how its force comes in afterwards.
//
//   style            who calibrates, and when
//   automatic        the device itself while its servo loop runs, from the motion of the arm; again at any time
//   inkwell          the same, once the stylus stands in the inkwell
//   encoder reset    a person puts the arm into its reset position before the loop starts
//
// Of several styles the first in this list is used. In the loop the status is read within a frame, and the calibration updated outside
// of one when the device is ready: elsewhere the first two styles never calibrate.
// Source: OpenHaptics Toolkit, programmer's guide (calibration) and the order of the calls in its example of that name.
// In a tick: no allocation, noexcept, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include <hapbeam/check.hpp>
#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

/// Which device, and how it is to be used.
struct HdapiOptions {
  std::string device;    ///< its name in the vendor's setup program; empty: the default device
  unsigned rate = 1000;  ///< [Hz] of the servo loop, one that the device supports; the same for all devices
  /// [N] positive; the device's own peak applies too
  double force_limit = std::numeric_limits<double>::infinity();
  double ramp_time = 0.5;  ///< [s] from gain 0 to 1, after a start and after an error; positive

  // Not available from HDAPI; 0 where unknown.
  double position_resolution = 0;  ///< [m]
  double friction = 0;             ///< [N] to drive the arm back by hand
  double damping = 0;              ///< [N·s/m] viscous, of the arm
  double apparent_mass = 0;        ///< [kg] at the tip

  // Of a device of six axes.
  /// [N·m] not negative, 0: no torque; the device's own peak applies too
  double torque_limit = std::numeric_limits<double>::infinity();
  double gimbal_resolution = 0;  ///< [rad]
  double gimbal_friction = 0;    ///< [N·m] to turn the stylus by hand
  double gimbal_damping = 0;     ///< [N·m·s/rad] viscous, of the gimbal
  double gimbal_inertia = 0;     ///< [kg·m²] of gimbal and stylus

  /// @throws std::invalid_argument naming field, value, unit and what is allowed
  const HdapiOptions& check() const {
    if (rate < 100 || rate > 10000)
      detail::reject("rate", rate, "Hz", "one that the device knows, 100 to 10000");
    if (!(force_limit > 0)) detail::reject("force_limit", force_limit, "N", "positive");
    detail::positive("ramp_time", ramp_time, "s");
    detail::not_negative("position_resolution", position_resolution, "m");
    detail::not_negative("friction", friction, "N");
    detail::not_negative("damping", damping, "N·s/m");
    detail::not_negative("apparent_mass", apparent_mass, "kg");
    if (!(torque_limit >= 0)) detail::reject("torque_limit", torque_limit, "N·m", "not negative");
    detail::not_negative("gimbal_resolution", gimbal_resolution, "rad");
    detail::not_negative("gimbal_friction", gimbal_friction, "N·m");
    detail::not_negative("gimbal_damping", gimbal_damping, "N·m·s/rad");
    detail::not_negative("gimbal_inertia", gimbal_inertia, "kg·m²");
    return *this;
  }
};

/// A device that cannot be used; why() is the reason, as in its status().
class DeviceError : public std::runtime_error {
 public:
  DeviceError(DeviceStatus why, const std::string& text) : std::runtime_error(text), why_(why) {}
  DeviceStatus why() const noexcept { return why_; }

 private:
  DeviceStatus why_;
};

namespace detail {

template <typename Api>
class HdCalibration {
 public:
  static constexpr double interval = 0.1;  ///< [s] between two readings of the status

  /// @param styles  bits of the styles that the device has   @param rate [Hz] of the loop
  HdCalibration(unsigned styles, unsigned rate) noexcept
      : style_(best(styles)), ticks_((std::max)(1, static_cast<int>(std::lround(interval * rate)))) {}

  /// The device calibrates itself in the loop; else a person does, before it.
  bool automatic() const noexcept { return style_ != 0 && style_ != encoder_reset; }

  /// Before a loop: the first tick reads the status.
  void start() noexcept { wait_ = 0; }

  /// Once a tick, within a frame of the device.   @return whether it was calibrated at the last reading
  bool ask() noexcept {
    fresh_ = wait_ == 0;
    if (fresh_) answer_ = Api::check_calibration();
    wait_ = fresh_ ? ticks_ - 1 : wait_ - 1;
    return answer_ == Api::calibration_ok;
  }
  /// After that frame: updates the calibration when the device is ready for it.
  void update() noexcept {
    if (fresh_ && automatic() && answer_ == Api::calibration_needs_update) Api::update_calibration(style_);
  }

  /// Outside of the loop, for a device that a person calibrates: takes the arm's place for its reset position if the
  /// device asks for that. The device is current.   @return whether it is calibrated
  bool check(bool at_reset_position) const noexcept {
    if (at_reset_position && style_ == encoder_reset) Api::update_calibration(style_);
    return Api::check_calibration() == Api::calibration_ok;
  }

 private:
  static constexpr unsigned encoder_reset = Api::calibration_encoder_reset;

  static unsigned best(unsigned styles) noexcept {
    for (const unsigned style : {static_cast<unsigned>(Api::calibration_auto),
                                 static_cast<unsigned>(Api::calibration_inkwell), encoder_reset})
      if (styles & style) return style;
    return 0;
  }

  unsigned style_, answer_ = 0;
  int ticks_, wait_ = 0;
  bool fresh_ = false;  // asked in this tick
};

}  // namespace detail

/// Gain of the force after a start, after a force error and with warm motors.  It is zero in the tick of a start or of a force error, and
/// then rises linearly to 1 within the ramp time.  With warm motors it falls at the same rate to zero, and rises again when they have
/// cooled.  A device that reports warm motors without a temperature waits for cooling_time.
class ForceRamp {
 public:
  // Of the temperature over its limit; the vendor's figures (OpenHaptics programmer's guide).
  static constexpr double warm_above = 0.7, cool_below = 0.5;
  static constexpr double cooling_time = 10;  ///< [s] after the last error of warm motors

  /// @param ramp_time [s] from gain 0 to 1, positive   @param period [s] of the loop, positive
  ForceRamp(double ramp_time, double period) noexcept
      : step_((std::min)(1.0, period / ramp_time)),
        cooling_(static_cast<std::int64_t>(std::ceil(cooling_time / period))) {}

  double gain() const noexcept { return gain_; }            ///< of the force, 0 to 1
  bool warm() const noexcept { return hot_ || wait_ > 0; }  ///< falling, or waiting at zero
  bool recovering() const noexcept { return recovering_; }  ///< since a force error, until the gain is 1

  /// As at the start of a loop: gain 0, state of the motors unknown.
  void start() noexcept {
    recovering_ = hot_ = false, wait_ = 0;
    restart();
  }
  /// Gain 0 in the next tick, then rising.  The state of the motors stays.
  void restart() noexcept { gain_ = 0, fresh_ = true; }

  /// Once a tick, before its force is sent.
  /// @param temperature  of the hottest motor over its limit; NaN counts as hot
  /// @param warm_error, force_error  reported since the last tick
  void advance(double temperature, bool warm_error, bool force_error) noexcept {
    if (!(temperature <= warm_above)) hot_ = true;
    else if (temperature < cool_below) hot_ = false;
    if (warm_error) wait_ = cooling_;
    else if (wait_ > 0) --wait_;
    if (force_error || fresh_) {
      gain_ = 0, recovering_ |= force_error, fresh_ = false;
      return;
    }
    gain_ = std::clamp(gain_ + (warm() ? -step_ : step_), 0.0, 1.0);
    if (gain_ == 1) recovering_ = false;
  }

 private:
  double step_;
  std::int64_t cooling_;
  double gain_ = 0;
  std::int64_t wait_ = 0;
  bool hot_ = false, recovering_ = false, fresh_ = true;
};

}  // namespace hapbeam
