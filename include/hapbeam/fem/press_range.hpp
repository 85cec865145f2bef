// SPDX-License-Identifier: MIT
// Where a press of a finite-element beam is answered, and at which place its mesh takes the contact.
//
// A support that holds w is rigid: the shortest element keeps its distance from it.
// Moderate rotation: |d| up to a tenth of the length and half of the distance to such a support, where it has ended,
// though the solver has not.  Finite rotation: where the ends hold the beam along its axis, as far beyond what its length
// allows; where it can slide, 0.3 of the length and of the distance, the deepest that one call reaches from rest.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/beam.hpp>
#include <hapbeam/body/shortest_element.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

template <class Element, typename Scalar>
class PressRange {
 public:
  explicit PressRange(const Beam& beam) noexcept
      : length_(static_cast<Scalar>(beam.length())),
        shortest_(detail::shortest_element<Scalar>(length_)),
        depth_(length_ / 10),
        left_yields_(!fixes_w(beam.left())),
        right_yields_(!fixes_w(beam.right())),
        left_guided_(left_yields_ && fixes_u(beam.left())),
        right_guided_(right_yields_ && fixes_u(beam.right())) {
    if constexpr (any_rotation<Element>) {
      if (fixes_u(beam.left()) && fixes_u(beam.right())) {
        // How high a beam of this length can stand between its ends, over half the length.
        const auto span = (beam.length() + beam.right_place().u - beam.left_place().u) / beam.length();
        const Scalar sag = static_cast<Scalar>(std::sqrt((std::max)(0.0, 1 - span * span)));
        depth_ += sag * length_ / 2;
        slope_ += sag;
      } else {
        depth_ = Scalar(0.3) * length_;
        slope_ = Scalar(0.3);
      }
    }
  }

  /// Whether neither end moves across.
  static bool holds_both(const Beam& beam) noexcept { return fixes_w(beam.left()) && fixes_w(beam.right()); }

  Scalar length() const noexcept { return length_; }
  /// Whether s is a place on the beam.
  bool on_beam(Scalar s) const noexcept { return std::isfinite(s) && s >= 0 && s <= length_; }

  Range<Scalar> range() const noexcept {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const Scalar length = length_;
    return {left_yields_ ? Scalar(0) : shortest_,
            right_yields_ ? length : length - shortest_,
            depth_,
            slope_,
            left_yields_ ? -infinity : Scalar(0),
            right_yields_ ? infinity : length};
  }

  /// Where the node of a contact at s goes: s, or the end beside which an element would be too short for round-off.
  Scalar node(Scalar s) const noexcept {
    const Scalar length = length_;
    return s < shortest_ && left_yields_ ? Scalar(0) : length - s < shortest_ && right_yields_ ? length : s;
  }
  /// Whether a node there is an end that slides along a wall.
  bool on_wall(Scalar node) const noexcept {
    return (node == 0 && left_guided_) || (node == length_ && right_guided_);
  }

 private:
  Scalar length_, shortest_, depth_, slope_ = Scalar(0.5);
  bool left_yields_, right_yields_, left_guided_, right_guided_;
};

}  // namespace hapbeam
