// SPDX-License-Identifier: MIT
// Storage of one value a node (or element): inside the object where a maximum is known at compile time, on the
// heap, allocated once at construction, where it is not.
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

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

}  // namespace hapbeam::detail
