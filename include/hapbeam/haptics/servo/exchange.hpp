// SPDX-License-Identifier: MIT
// Values from one thread to another without waiting: the newest one alone (Exchange), or all in order (Ring).  One writer, one reader.
//
//   Exchange<Shape> shapes(empty);                      // allocates what copying `empty` allocates, thrice
//   shapes.draft() = …;  shapes.publish();              // servo, each tick
//   if (shapes.update()) draw(shapes.value());          // graphics, each picture
//
//   Ring<float> samples(96000);                         // allocates
//   samples.add(sample);                                // servo
//   samples.take(visit);                                // sound card
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <hapbeam/check.hpp>

namespace hapbeam {

/// Three copies: the writer fills one, the reader holds one, the third lies between them and is swapped, with the flag "newer", in one
/// atomic exchange.  Values that nobody read are overwritten.  What is read is one whole value as it was published, never older than one
/// read before.  A value may own memory where assigning to it does not allocate.  The writer's draft() and publish(), and the reader's
/// update() and value(), are wait-free.
/// Source: the triple buffer; its ancestor is H. Simpson's "Four-slot fully asynchronous communication mechanism", 1990.
template <typename T>
class Exchange {
  static_assert(std::is_copy_constructible_v<T>,
                "an exchanged value is copied into three places at the beginning");

 public:
  /// Offline: copies the value three times, with what that allocates or throws.
  explicit Exchange(const T& initial = T()) : slots_{{initial}, {initial}, {initial}} {}
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  /// The writer's own copy, to be filled before publish(); it holds some earlier value.
  T& draft() noexcept { return slots_[draft_].value; }

  /// Makes the draft the newest value, and gives the writer another one to fill.
  void publish() noexcept {
    draft_ = between_.exchange(static_cast<std::uint8_t>(draft_ | newer), std::memory_order_acq_rel) & index;
  }

  /// Both at once; wait-free where T's assignment is.
  template <typename U>
  void publish(U&& value) noexcept(std::is_nothrow_assignable_v<T&, U&&>) {
    draft() = std::forward<U>(value);
    publish();
  }

  /// Takes the newest value, where there is one that has not been taken.   @return whether value() is another one now
  bool update() noexcept {
    if (!(between_.load(std::memory_order_relaxed) & newer)) return false;
    taken_ = between_.exchange(taken_, std::memory_order_acq_rel) & index;
    return true;
  }

  /// The value last taken, `initial` before the first.  It stays as it is until the next update().
  const T& value() const noexcept { return slots_[taken_].value; }

 private:
  static constexpr std::uint8_t index = 3, newer = 4;
  // What two threads write lies on different cache lines; 64 bytes is what x86-64 and most ARM have.
  static constexpr std::size_t line = 64;

  struct alignas(line) Slot {
    T value;
  };

  Slot slots_[3];
  alignas(line) std::uint8_t draft_ = 0;                // writer's
  alignas(line) std::uint8_t taken_ = 1;                // reader's
  alignas(line) std::atomic<std::uint8_t> between_{2};  // nobody's: index, and whether it is newer
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free, "an exchange must not lock");
};

/// Of fixed room.  A full ring loses what is added, and counts it.
/// Source: L. Lamport, "Specifying concurrent program modules", ACM TOPLAS 5, 1983.
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

  /// Reader: calls visit(value) for each that waits, oldest first; wait-free where visit is.   @param most  that are taken
  /// @return how many were
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
