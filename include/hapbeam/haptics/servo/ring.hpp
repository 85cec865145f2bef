// SPDX-License-Identifier: MIT
// All values from one thread to another, in order, without waiting: samples of a sound, ticks of a recording.
//
// A ring of fixed room.  One writer, one reader.  A full ring loses what is added, and counts it.  Of the newest value alone: exchange.hpp.
// Source: L. Lamport, "Specifying concurrent program modules", ACM TOPLAS 5, 1983.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hapbeam/check.hpp>

namespace hapbeam {

template <typename T>
class Ring {
 public:
  /// Allocates.   @param room  values that can wait   @throws std::invalid_argument where there is none
  explicit Ring(std::size_t room) : values_(room) {
    if (room == 0) detail::reject("room", 0, "", "1 or more values");
  }

  /// Writer: wait-free where T's assignment is.
  void add(const T& value) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == values_.size()) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    values_[end % values_.size()] = value;
    end_.store(end + 1, std::memory_order_release);
  }

  /// Calls visit(value) for each that waits, oldest first.   @param most  that are taken   @return how many were
  /// Reader: wait-free where visit is.
  template <typename Visitor>
  std::size_t take(Visitor&& visit, std::size_t most = static_cast<std::size_t>(-1)) {
    const std::size_t begin = begin_.load(std::memory_order_relaxed), count = (std::min)(waiting(), most);
    for (std::size_t i = begin; i != begin + count; ++i) {
      visit(values_[i % values_.size()]);
      begin_.store(i + 1, std::memory_order_release);
    }
    return count;
  }

  /// Values that can be taken.  From the reader's thread.
  std::size_t waiting() const noexcept {
    return end_.load(std::memory_order_acquire) - begin_.load(std::memory_order_relaxed);
  }
  /// Values that were added to a full ring.
  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  std::vector<T> values_;
  // What two threads write lies on different cache lines.
  alignas(64) std::atomic<std::size_t> begin_{0};
  alignas(64) std::atomic<std::size_t> end_{0};
  std::atomic<std::uint64_t> lost_{0};
  static_assert(std::atomic<std::size_t>::is_always_lock_free &&
                    std::atomic<std::uint64_t>::is_always_lock_free,
                "a ring must not lock");
};

}  // namespace hapbeam
