// What each tick was, from the servo's thread to whoever writes or draws it: a queue that neither side waits for.
//
// One writer, one reader.  add(): no allocation, noexcept, wait-free; a full tape loses the tick and counts it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hapbeam/haptics/device/hand_path.hpp>
#include <hapbeam/haptics/servo/servo_record.hpp>

namespace phantom {

struct Tick {
  hapbeam::ServoRecord record;
  hapbeam::HandTarget hand;  ///< where the hand wanted to be
  double duration;           ///< [s] that the servo took
  int changes;               ///< of the body, before it
};

class Tape {
 public:
  Tape() : ticks_(room) {}

  void add(const Tick& tick) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == room) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    ticks_[end % room] = tick;
    end_.store(end + 1, std::memory_order_release);
  }

  /// Calls visit(tick) for each that was added since the last call, oldest first.
  template <typename Visitor>
  void take(Visitor&& visit) {
    const std::size_t end = end_.load(std::memory_order_acquire);
    for (std::size_t i = begin_.load(std::memory_order_relaxed); i != end; ++i) {
      visit(ticks_[i % room]);
      begin_.store(i + 1, std::memory_order_release);
    }
  }

  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t room = 8192;  // eight seconds

  std::vector<Tick> ticks_;
  alignas(64) std::atomic<std::size_t> begin_{0};
  alignas(64) std::atomic<std::size_t> end_{0};
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace phantom
