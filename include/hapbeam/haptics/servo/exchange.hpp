// SPDX-License-Identifier: MIT
// The newest value from one thread to another, without waiting and without torn reads: from the servo to the
// graphics (a shape, a state), or back (settings).
//
// Three copies: the writer fills one, the reader holds one, the third lies between them and is swapped, with
// the flag "newer", in one atomic exchange.  Neither side ever waits for the other or repeats anything,
// values that nobody read are overwritten, and what is read is always one whole value as it was published,
// never older than one read before.  One writer, one reader: a value that several threads want takes one
// Exchange each.
//
//   Exchange<Shape> shapes(empty);                      // allocates what copying `empty` allocates, thrice
//   shapes.draft() = …;  shapes.publish();              // servo, each tick
//   if (shapes.update()) draw(shapes.value());          // graphics, each picture
//
// A value that owns memory may be used where assigning to it does not allocate, for example one whose size is
// fixed by `initial` and that is filled in place.
// Source: the triple buffer; H. Simpson's "Four-slot fully asynchronous communication mechanism" (1990) is
// its ancestor.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace hapbeam {

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
  /// Writer: wait-free.
  T& draft() noexcept { return slots_[draft_].value; }

  /// Makes the draft the newest value, and gives the writer another one to fill.
  /// Writer: wait-free, one atomic exchange.
  void publish() noexcept {
    draft_ = between_.exchange(static_cast<std::uint8_t>(draft_ | newer), std::memory_order_acq_rel) & index;
  }

  /// Both at once.
  /// Writer: wait-free where T's assignment is.
  template <typename U>
  void publish(U&& value) noexcept(std::is_nothrow_assignable_v<T&, U&&>) {
    draft() = std::forward<U>(value);
    publish();
  }

  /// Takes the newest value, where there is one that has not been taken.
  /// Reader: wait-free, one atomic exchange at most.
  /// @return whether value() is another one now
  bool update() noexcept {
    if (!(between_.load(std::memory_order_relaxed) & newer)) return false;
    taken_ = between_.exchange(taken_, std::memory_order_acq_rel) & index;
    return true;
  }

  /// The value last taken, `initial` before the first.  It stays as it is until the next update().
  /// Reader: wait-free.
  const T& value() const noexcept { return slots_[taken_].value; }

 private:
  static constexpr std::uint8_t index = 3, newer = 4;
  // What two threads write lies on different cache lines; 64 bytes is what x86-64 and most ARM have.
  static constexpr std::size_t line = 64;

  struct alignas(line) Slot {
    T value;
  };

  Slot slots_[3];
  alignas(line) std::uint8_t draft_ = 0;  // writer's
  alignas(line) std::uint8_t taken_ = 1;  // reader's
  alignas(line) std::atomic<std::uint8_t> between_{
      2};  // nobody's: index, and whether it is newer than taken_
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free, "an exchange must not lock");
};

}  // namespace hapbeam
