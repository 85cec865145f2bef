// SPDX-License-Identifier: MIT
// Gain of the force after a start, after a force error and with warm motors.
//
// The gain is zero in the tick of a start or of a force error, and then rises linearly to 1 within the ramp time. With
// warm motors it falls at the same rate to zero, and rises again when they have cooled. Motors are warm above 0.7 of
// their temperature limit and cool below 0.5, the vendor's figures (OpenHaptics programmer's guide). A device that
// reports warm motors without a temperature waits for cooling_time.
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hapbeam {

class ForceRamp {
 public:
  static constexpr double warm_above = 0.7;   ///< temperature over its limit
  static constexpr double cool_below = 0.5;   ///< the same
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
      gain_ = 0;
      recovering_ |= force_error;
      fresh_ = false;
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
