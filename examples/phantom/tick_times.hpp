// How long ticks took, as a histogram of fixed memory: the servo adds, anybody reads.
//
// 64 buckets an octave: a quantile is at most 1.6 % above the time that it stands for.
// add(): noexcept, no allocation, wait-free, O(1), from one thread.  Reading: from any thread, at any time.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

namespace phantom {

class TickTimes {
 public:
  void add(std::int64_t nanoseconds) noexcept {
    const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(nanoseconds, 0));
    buckets_[bucket(time)].fetch_add(1, std::memory_order_relaxed);
    if (time > longest_.load(std::memory_order_relaxed)) longest_.store(time, std::memory_order_relaxed);
  }

  /// The time that a fraction of all ticks did not exceed [µs]; 0 where there was none.
  double quantile(double fraction) const noexcept {
    std::uint64_t total = 0, below = 0;
    for (const auto& count : buckets_) total += count.load(std::memory_order_relaxed);
    for (std::size_t i = 0; i < buckets_.size() && total > 0; ++i) {
      below += buckets_[i].load(std::memory_order_relaxed);
      if (static_cast<double>(below) >= fraction * static_cast<double>(total))
        return std::min(upper_end(i), longest());
    }
    return longest();
  }
  double longest() const noexcept {  ///< [µs]
    return static_cast<double>(longest_.load(std::memory_order_relaxed)) / 1000;
  }

 private:
  static constexpr std::uint64_t per_octave = 64;
  static constexpr int octaves = 34;  // up to 18 minutes

  /// Times below 64 ns have a bucket each; then 64 for each doubling.
  static std::size_t bucket(std::uint64_t time) noexcept {
    int octave = 0;
    while (time >= 2 * per_octave && octave < octaves - 2) time /= 2, ++octave;
    const std::uint64_t within = std::min(time, 2 * per_octave - 1);
    return static_cast<std::size_t>(static_cast<std::uint64_t>(octave) * per_octave + within);
  }
  static double upper_end(std::size_t bucket) noexcept {
    if (bucket < per_octave) return static_cast<double>(bucket) / 1000;
    const std::size_t octave = bucket / per_octave - 1, within = bucket - octave * per_octave;
    return static_cast<double>(((within + 1) << octave) - 1) / 1000;
  }

  std::array<std::atomic<std::uint64_t>, per_octave * octaves> buckets_{};
  std::atomic<std::uint64_t> longest_{0};
};

}  // namespace phantom
