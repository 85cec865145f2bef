// SPDX-License-Identifier: MIT
// How long the ticks of a servo loop take and how regularly they come, in fixed memory: the servo adds, anybody reads.
//
//   TickTimes times(1e-3);                                     // offline
//   times.begin();  …  times.end();                            // in each tick, first and last
//   const TimeSummary period = times.period().summary();       // from any thread, at any time
//
// A histogram of log-linear bins, 64 for each doubling: a quantile is at most 1/64 above the time that it stands for, and never below.
// Source: the layout of HdrHistogram, G. Tene.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

/// What is read off a histogram at one moment.
struct TimeSummary {
  std::uint64_t count = 0;                     ///< times added
  double p50 = 0, p99 = 0, p999 = 0, max = 0;  ///< [s] which 50, 99, 99.9 and 100 % of them do not exceed
};

class TimeHistogram {
 public:
  /// @param nanoseconds  [ns]; negative counts as zero
  /// One thread adds.  Real-time: no allocation, noexcept, wait-free, O(1).
  void add(std::int64_t nanoseconds) noexcept {
    const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(nanoseconds, 0));
    std::atomic<std::uint64_t>& count = bins_[bin(time)];
    // Whoever sees a time counted sees that the longest is no shorter.
    if (time > longest_.load(relaxed)) longest_.store(time, relaxed);
    count.store(count.load(relaxed) + 1, std::memory_order_release);
  }

  /// The time that a fraction of all do not exceed.
  /// @param fraction  0 to 1   @return [s], 0 where nothing has been added
  /// From any thread: noexcept, wait-free, O(bins).
  double quantile(double fraction) const noexcept { return Moment(*this).quantile(fraction); }
  double longest() const noexcept { return static_cast<double>(longest_.load(relaxed)) * 1e-9; }  ///< [s]
  std::uint64_t count() const noexcept { return Moment(*this).total; }
  TimeSummary summary() const noexcept {
    const Moment now(*this);
    return {now.total, now.quantile(0.5), now.quantile(0.99), now.quantile(0.999), now.longest};
  }

 private:
  static constexpr auto relaxed = std::memory_order_relaxed;
  static constexpr std::uint64_t per_octave = 64;
  static constexpr int octaves = 34;

  static std::size_t bin(std::uint64_t time) noexcept {
    std::uint64_t octave = 0;
    while (time >= 2 * per_octave && octave < octaves - 2) time /= 2, ++octave;
    return static_cast<std::size_t>(octave * per_octave + (std::min)(time, 2 * per_octave - 1));
  }
  /// The longest time in a bin [s].
  static double upper_end(std::size_t bin) noexcept {
    if (bin < per_octave) return static_cast<double>(bin) * 1e-9;
    const std::size_t octave = bin / per_octave - 1, within = bin - octave * per_octave;
    return static_cast<double>(((within + 1) << octave) - 1) * 1e-9;
  }
  static constexpr std::size_t bins = per_octave * octaves;

  /// The counts at the time of reading; the servo continues to add.
  struct Moment {
    std::array<std::uint64_t, bins> counts;
    std::uint64_t total = 0;
    double longest;  // [s]

    explicit Moment(const TimeHistogram& histogram) noexcept {
      for (std::size_t i = 0; i < bins; ++i)
        total += counts[i] = histogram.bins_[i].load(std::memory_order_acquire);
      longest = histogram.longest();
    }
    double quantile(double fraction) const noexcept {
      std::uint64_t below = 0;
      for (std::size_t i = 0; i + 1 < bins && total > 0; ++i) {
        below += counts[i];
        if (below > 0 && static_cast<double>(below) >= fraction * static_cast<double>(total))
          return (std::min)(upper_end(i), longest);
      }
      return total > 0 ? longest : 0;
    }
  };

  std::array<std::atomic<std::uint64_t>, bins> bins_{};
  std::atomic<std::uint64_t> longest_{0};
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "counting in a tick must not lock");
};

template <typename Clock = std::chrono::steady_clock>
class BasicTickTimes {
  static_assert(Clock::is_steady&& noexcept(Clock::now()),
                "ticks are timed by a steady clock that does not throw");

 public:
  /// @param period  [s] that a tick should come after the one before, 1e-6 to 1e3
  /// @throws std::invalid_argument
  explicit BasicTickTimes(double period)
      : period_ns_(static_cast<std::int64_t>(std::llround(detail::loop_period("period", period) * 1e9))) {}

  /// First in a tick.  One thread.  Real-time: no allocation, noexcept, wait-free; reads the clock.
  void begin() noexcept {
    const auto now = Clock::now();
    if (begin_) {
      const std::int64_t gap = nanoseconds(now - *begin_);
      period_.add(gap);
      // As a device counts them: deadlines that passed by a whole period before a tick began.
      if (const std::int64_t missed = gap / period_ns_ - 1; missed > 0)
        missed_.store(missed_.load(relaxed) + static_cast<std::uint64_t>(missed), relaxed);
    }
    begin_ = now;
  }
  /// Last in a tick.  The same.
  void end() noexcept {
    if (begin_) compute_.add(nanoseconds(Clock::now() - *begin_));
  }
  /// Where the loop was stopped: the time until the next begin() is no period.  While no tick runs.
  void pause() noexcept { begin_.reset(); }

  const TimeHistogram& compute() const noexcept { return compute_; }  ///< from begin() to end()
  const TimeHistogram& period() const noexcept { return period_; }    ///< from one begin() to the next
  /// Deadlines missed by a whole period or more.  From any thread: noexcept, wait-free.
  std::uint64_t missed() const noexcept { return missed_.load(relaxed); }

 private:
  static constexpr auto relaxed = std::memory_order_relaxed;
  static std::int64_t nanoseconds(typename Clock::duration time) noexcept {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
  }

  std::int64_t period_ns_;
  std::optional<typename Clock::time_point> begin_;  // none: after a pause
  TimeHistogram compute_, period_;
  std::atomic<std::uint64_t> missed_{0};
};

using TickTimes = BasicTickTimes<>;

}  // namespace hapbeam
