// SPDX-License-Identifier: MIT
// The order of elements in which a chain is assembled from both ends at once: the first, the last, the second, the last but one, …
//
// An odd number of elements leaves the left chain without one; its first place is empty.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// Bits stand for division by two: a compiler does not see that no place is negative, and would need three instructions more for each.
struct PairOrder {
  int elements;

  int odd() const noexcept { return elements & 1; }
  int pairs() const noexcept { return (elements + 1) >> 1; }
  /// -1: the empty place
  int element(int place) const noexcept {
    return (place & 1) == 0 ? (place >> 1) - odd() : elements - 1 - (place >> 1);
  }
  /// Those from an even place on.  Beyond the last one that one stands again, and in the empty place the first one.
  template <int Size>
  [[gnu::always_inline]] void elements_from(int first, int (&of)[Size]) const noexcept {
    if (is_whole(first, Size, 2 * pairs())) return from_both_ends(first, elements - 1, of);
    for (int k = 0; k < Size; ++k) of[k] = (std::max)(element((std::min)(first + k, 2 * pairs() - 1)), 0);
  }
  int place(int element) const noexcept {
    const int from_left = element + odd();
    return from_left < pairs() ? 2 * from_left : 2 * (elements - 1 - element) + 1;
  }

  // The nodes: element 2k lies between nodes 2k and 2k + 2 of theirs, and 2k + 1 between 2k + 3 and 2k + 1.  The middle node stands twice, and
  // in the empty place the last one.
  int last_node() const noexcept { return 2 * pairs() + 1; }
  int node(int place) const noexcept {
    const bool left = (place & 1) == 0 && (place >> 1) >= odd();
    return left ? (place >> 1) - odd() : elements - (place >> 1);
  }
  template <int Size>
  [[gnu::always_inline]] void nodes_from(int first, int (&of)[Size]) const noexcept {
    if (is_whole(first, Size, last_node() + 1)) return from_both_ends(first, elements, of);
    for (int k = 0; k < Size; ++k) of[k] = node((std::min)(first + k, last_node()));
  }
  int node_place(int node) const noexcept {
    const int from_left = node + odd();
    return from_left <= pairs() ? 2 * from_left : 2 * (elements - node) + 1;
  }

 private:
  /// Whether none of so many places is empty or beyond the end.
  bool is_whole(int first, int size, int end) const noexcept {
    return (first >> 1) >= odd() && first + size <= end;
  }
  template <int Size>
  [[gnu::always_inline]] void from_both_ends(int first, int last, int (&of)[Size]) const noexcept {
    const int left = (first >> 1) - odd(), right = last - (first >> 1);
    HAPBEAM_UNROLL
    for (int k = 0; k < Size; ++k) of[k] = k % 2 == 0 ? left + k / 2 : right - k / 2;
  }
};

}  // namespace hapbeam::detail
