// SPDX-License-Identifier: MIT
// What TouchSeveral says of a tick: where each body touches the beam, and the force on it.
//
// Plain values.  No allocation, noexcept.
#pragma once

#include <algorithm>
#include <array>

#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// What becomes of one possible contact in a tick.
template <typename Scalar, int D = 2>
struct TouchPlace {
  int body = 0;           ///< avatars in their order, then props in theirs
  bool touching = false;  ///< all else is zero where they do not touch
  Status status = Status::ok;
  Scalar s = 0;      ///< [m] arc position
  Scalar depth = 0;  ///< [m] of the body in the beam as it lay before this tick; negative: the gap
  VectorOf<Scalar, D> point = VectorOf<Scalar, D>::Zero();     ///< [m] of the centreline
  VectorOf<Scalar, D> normal = VectorOf<Scalar, D>::Zero();    ///< unit, out of the beam to the body
  VectorOf<Scalar, D> force = VectorOf<Scalar, D>::Zero();     ///< [N] on the body; always finite
  VectorOf<Scalar, D> friction = VectorOf<Scalar, D>::Zero();  ///< [N] what of the force is tangential
  bool sliding = false;   ///< with friction: the contact slides, else it sticks
  Scalar dissipated = 0;  ///< [J] by friction, since this contact began; anew where the touch is
};

/// What one tick says.
/// @tparam Contacts  most of them
template <typename Scalar, int D, int Contacts>
struct TouchSeveralResult {
  /// Of the equilibrium.  Negative: all places are those of the last answer; invalid_request, for a position that is not
  /// finite: they are zero.
  Status status = Status::ok;
  int size = 0;  ///< possible contacts
  std::array<TouchPlace<Scalar, D>, Contacts> places;

  const TouchPlace<Scalar, D>* begin() const noexcept { return places.data(); }
  const TouchPlace<Scalar, D>* end() const noexcept { return places.data() + size; }
  /// On an avatar or a prop [N].
  VectorOf<Scalar, D> force(int body) const noexcept {
    VectorOf<Scalar, D> sum = VectorOf<Scalar, D>::Zero();
    for (const auto& place : *this)
      if (place.body == body) sum += place.force;
    return sum;
  }
  /// What of it is tangential [N].
  VectorOf<Scalar, D> friction(int body) const noexcept {
    VectorOf<Scalar, D> sum = VectorOf<Scalar, D>::Zero();
    for (const auto& place : *this)
      if (place.body == body) sum += place.friction;
    return sum;
  }
  bool touching(int body) const noexcept {
    return std::any_of(begin(), end(),
                       [body](const auto& place) { return place.body == body && place.touching; });
  }
};

}  // namespace hapbeam
