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

  // The nodes: element 2k lies between nodes 2k and 2k + 2 of theirs, and 2k + 1 between 2k + 3 and 2k + 1.  The middle node stands twice, and
  // in the empty place the last one.
  int last_node() const noexcept { return 2 * pairs() + 1; }
  int node(int place) const noexcept {
    const bool left = place % 2 == 0 && place / 2 >= odd();
    return left ? place / 2 - odd() : elements - place / 2;
  }
  int node_place(int node) const noexcept {
    const int from_left = node + odd();
    return from_left <= pairs() ? 2 * from_left : 2 * (elements - node) + 1;
  }
};

}  // namespace hapbeam::detail
