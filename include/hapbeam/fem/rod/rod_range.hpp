// SPDX-License-Identifier: MIT
// Where a push of a finite-element rod is answered.
//
// A support that holds its place is rigid: the shortest element keeps its distance from it.  A push has no limit of depth.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>
#include <limits>

#include <hapbeam/body/shortest_element.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rod.hpp>

namespace hapbeam {

template <typename Scalar>
class RodRange {
 public:
  explicit RodRange(const Rod& rod) noexcept
      : length_(static_cast<Scalar>(rod.length())),
        shortest_(detail::shortest_element<Scalar>(length_)),
        left_yields_(yields(rod.left())),
        right_yields_(yields(rod.right())) {}

  /// Whether neither end moves.
  static bool holds_both(const Rod& rod) noexcept { return !yields(rod.left()) && !yields(rod.right()); }

  Scalar length() const noexcept { return length_; }
  /// Whether s is a place on the rod.
  bool on_beam(Scalar s) const noexcept { return std::isfinite(s) && s >= 0 && s <= length_; }

  Range<Scalar> range() const noexcept {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    return {left_yields_ ? Scalar(0) : shortest_,
            right_yields_ ? length_ : length_ - shortest_,
            infinity,
            infinity,
            left_yields_ ? -infinity : Scalar(0),
            right_yields_ ? infinity : length_};
  }

 private:
  /// Whether nothing holds its place; a spring does not.
  static bool yields(const RodSupport& support) noexcept {
    return !std::isinf(support.place1) && !std::isinf(support.place2) && !std::isinf(support.along);
  }

  Scalar length_, shortest_;
  bool left_yields_, right_yields_;
};

}  // namespace hapbeam
