// The order of elements in which a chain is assembled from both ends at once: the first, the last, the second, the last but one, …
//
// An odd number of elements leaves the left chain without one; its first place is empty.
// Real-time: noexcept, no allocation, O(1).
#pragma once

namespace hapbeam::detail {

struct PairOrder {
  int elements;

  int odd() const noexcept { return elements % 2; }
  int pairs() const noexcept { return (elements + odd()) / 2; }
  /// -1: the empty place
  int element(int place) const noexcept {
    return place % 2 == 0 ? place / 2 - odd() : elements - 1 - place / 2;
  }
  int place(int element) const noexcept {
    const int from_left = element + odd();
    return from_left < pairs() ? 2 * from_left : 2 * (elements - 1 - element) + 1;
  }
};

}  // namespace hapbeam::detail
