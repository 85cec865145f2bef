// SPDX-License-Identifier: MIT
// Storage of one value a node (or element): inside the object where a maximum is known at compile time, on the
// heap, allocated once at construction, where it is not.
//
// The order of elements in which a chain is assembled from both ends at once: the first, the last, the second, the last but one, …
//
// An odd number of elements leaves the left chain without one; its first place is empty.
// The order is real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// So many times a number of elements, which may be Eigen::Dynamic.
constexpr int times(int elements, int factor) noexcept {
  return elements == Eigen::Dynamic ? elements : factor * elements;
}

/// @tparam Elements     number of elements, or Eigen::Dynamic
/// @tparam MaxElements  the largest number of elements, or Eigen::Dynamic
template <typename T, int Elements, int MaxElements>
class PerNode {
  static_assert(Elements == Eigen::Dynamic || Elements == MaxElements, "a fixed size is its own maximum");
  static_assert(MaxElements == Eigen::Dynamic || MaxElements >= 2, "a beam needs two elements or more");
  static constexpr bool is_inline = MaxElements != Eigen::Dynamic;
  using Storage =
      std::conditional_t<is_inline, std::array<T, is_inline ? MaxElements + 1 : 1>, std::vector<T>>;

 public:
  /// @throws std::invalid_argument where the number of elements does not fit the type.
  explicit PerNode(int elements) : size_(elements + 1) {
    if (elements < 2 || (Elements != Eigen::Dynamic && elements != Elements) ||
        (is_inline && elements > MaxElements))
      throw std::invalid_argument("elements = " + std::to_string(elements) + ": must be " + allowed());
    if constexpr (!is_inline) storage_.resize(static_cast<std::size_t>(size_));
  }

  int size() const noexcept { return size_; }
  T* data() noexcept { return storage_.data(); }
  const T* data() const noexcept { return storage_.data(); }
  T& operator[](int i) noexcept { return storage_.data()[i]; }
  const T& operator[](int i) const noexcept { return storage_.data()[i]; }
  /// Becomes what another of the same size is.
  void set(const PerNode& from) noexcept { std::copy(from.begin(), from.end(), begin()); }
  void swap(PerNode& with) noexcept { storage_.swap(with.storage_); }
  T* begin() noexcept { return data(); }
  T* end() noexcept { return data() + size_; }
  const T* begin() const noexcept { return data(); }
  const T* end() const noexcept { return data() + size_; }

 private:
  static std::string allowed() {
    if (Elements != Eigen::Dynamic) return std::to_string(Elements);
    return is_inline ? "2 to " + std::to_string(MaxElements) : std::string("2 or more");
  }

  int size_;
  Storage storage_{};
};

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
