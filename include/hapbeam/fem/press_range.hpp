// SPDX-License-Identifier: MIT
// Where a press of a finite-element beam, or a push of a rod, is answered, and at which place the mesh of a beam takes the contact.
//
// From a support that holds its place across a press keeps a distance.  Moderate rotation: |d| up to a tenth of the length and half of the
// distance to such a support.  Finite rotation: where the ends hold the beam along its axis, as far beyond what its length allows; where it can
// slide, 0.3 of the length and of the distance, the deepest that one call reaches from rest.  A push of a rod has no limit of depth.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <hapbeam/beam.hpp>
#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam {

namespace detail {

/// Whether nothing rigid holds the place of an end.
constexpr bool yields(Support support) noexcept { return !fixes_w(support); }
inline bool yields(const RodSupport& support) noexcept {
  return !std::isinf(support.place1) && !std::isinf(support.place2) && !std::isinf(support.along);
}

}  // namespace detail

template <typename Scalar>
class PressRange {
 public:
  /// @param body  Beam | Rod   @param turns  whether its elements are of finite rotation
  template <class Body>
  explicit PressRange(const Body& body, [[maybe_unused]] bool turns = true) noexcept
      : length_(static_cast<Scalar>(body.length())),
        shortest_(detail::shortest_element<Scalar>(length_)),
        yields_{detail::yields(body.left()), detail::yields(body.right())} {
    if constexpr (std::is_same_v<Body, Beam>) {
      const bool held[] = {fixes_u(body.left()), fixes_u(body.right())};
      for (int k = 0; k < 2; ++k) guided_[k] = yields_[k] && held[k];
      depth_ = length_ / 10, slope_ = Scalar(0.5);
      if (turns && held[0] && held[1]) {
        // How high a beam of this length can stand between its ends, over half the length.
        const auto span = (body.length() + body.right_place().u - body.left_place().u) / body.length();
        const Scalar sag = static_cast<Scalar>(std::sqrt((std::max)(0.0, 1 - span * span)));
        depth_ += sag * length_ / 2, slope_ += sag;
      } else if (turns) {
        depth_ = Scalar(0.3) * length_, slope_ = Scalar(0.3);
      }
    }
  }

  /// Whether neither end moves across.
  bool holds_both() const noexcept { return !yields_[0] && !yields_[1]; }
  Scalar length() const noexcept { return length_; }
  /// Whether s is a place on the beam.
  bool on_beam(Scalar s) const noexcept { return std::isfinite(s) && s >= 0 && s <= length_; }

  Range<Scalar> range() const noexcept {
    return {yields_[0] ? Scalar(0) : shortest_,
            yields_[1] ? length_ : length_ - shortest_,
            depth_,
            slope_,
            yields_[0] ? -infinity : Scalar(0),
            yields_[1] ? infinity : length_};
  }

  /// Where the node of a contact at s goes: s, or the end beside which an element would be too short for round-off.
  Scalar node(Scalar s) const noexcept {
    return s < shortest_ && yields_[0] ? Scalar(0) : length_ - s < shortest_ && yields_[1] ? length_ : s;
  }
  /// Whether a node there is an end that slides along a wall.
  bool on_wall(Scalar node) const noexcept {
    return (node == 0 && guided_[0]) || (node == length_ && guided_[1]);
  }

 private:
  static constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  Scalar length_, shortest_, depth_ = infinity, slope_ = infinity;
  bool yields_[2], guided_[2] = {false, false};
};

}  // namespace hapbeam
