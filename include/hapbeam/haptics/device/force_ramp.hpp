// How much of the force a device sends while something is not as it should be.
//
// Nothing in the tick of a start or of a force error, then a little more each tick, all of it a ramp later.
// With warm motors it goes down at the same rate, to nothing, and back when they have cooled: down above 0.7
// of what they bear, back below 0.5, the vendor's own figures (OpenHaptics programmer's guide).  A device
// that reports warm motors without a temperature is given cooling_time.
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hapbeam {

class ForceRamp {
 public:
  static constexpr double warm_above = 0.7;   ///< temperature over the one that motors bear
  static constexpr double cool_below = 0.5;   ///< the same
  static constexpr double cooling_time = 10;  ///< [s] after the last error of warm motors

  /// @param ramp_time [s] from nothing to all, positive   @param period [s] of the loop, positive
  ForceRamp(double ramp_time, double period) noexcept
      : step_((std::min)(1.0, period / ramp_time)),
        cooling_(static_cast<std::int64_t>(std::ceil(cooling_time / period))) {}

  double gain() const noexcept { return gain_; }            ///< of the force, 0 to 1
  bool warm() const noexcept { return hot_ || wait_ > 0; }  ///< going down, or waiting there
  bool recovering() const noexcept { return recovering_; }  ///< since a force error, until all is sent again

  /// As at the start of a loop: nothing yet; what the motors' state is remains to be told.
  void start() noexcept {
    recovering_ = hot_ = false, wait_ = 0;
    restart();
  }
  /// Nothing in the next tick, and then a little more each tick; motors stay as warm as they are.
  void restart() noexcept { gain_ = 0, fresh_ = true; }

  /// Once a tick, before its force is sent.
  /// @param temperature  of the hottest motor over what it bears; one that is not a number counts as hot
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
