// SPDX-License-Identifier: MIT
// The time that has passed since the tick before, by the clock of the loop.
//
// A host's loop comes early, late or in bursts. Its clock may begin anywhere, stand, be set back or be no number. Nothing may be
// divided by such a time, and nothing may grow by it. After a pause the hand may be anywhere: what reaches it begins anew.
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <hapbeam/haptics/device/device_info.hpp>

namespace hapbeam {

/// [s]  A longer time between two ticks is a pause, unless two periods are longer.
inline constexpr double default_longest_pause = 0.1;

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
        longest_((std::max)(longest_pause, 2 * period)) {}

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
