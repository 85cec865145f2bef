// The time that has passed since the tick before, as coupling and energy monitor may take it.
//
// A host's loop comes early, late or in bursts, and its clock may stand or be no number.  What is returned is the time between
// two ticks, but no less than half a period, for a damper is divided by it, and no more than longest, after which the force
// engages anew; a period where the clock says nothing.
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

class LoopClock {
 public:
  /// @param period  [s] of the loop, 1e-6 to 1e3   @throws std::invalid_argument
  explicit LoopClock(double period)
      : period_(detail::loop_period("device period", period)), longest_((std::max)(0.1, 2 * period)) {}

  /// @param time [s] now, by a monotonic clock   @return [s]
  double passed(double time) noexcept {
    const double dt = time - time_;
    if (!std::isfinite(time)) return period_;
    time_ = time;
    return dt > 0 && std::isfinite(dt) ? std::clamp(dt, period_ / 2, longest_) : period_;
  }

 private:
  double period_, longest_;
  double time_ = 0;
};

}  // namespace hapbeam
