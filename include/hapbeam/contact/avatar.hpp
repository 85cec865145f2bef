// SPDX-License-Identifier: MIT
// The avatar, or haptic interaction point: the body that the hand moves. It is a disc in the plane of a beam, and a
// sphere or a capsule beside a rod in space.
//
// A plain value.  No allocation, noexcept.
#pragma once

#include <hapbeam/centreline.hpp>
#include <hapbeam/shaft.hpp>

namespace hapbeam {

/// A disc in the plane (x along the beam, w across).
/// @tparam D  of the space in which the beam bends: 2 | 3
template <typename Scalar, int D = 2>
struct Avatar {
  VectorOf<Scalar, D> position = VectorOf<Scalar, D>::Zero();  ///< [m] centre
  Scalar radius;                                               ///< [m] >= 0
};

/// A sphere or, where it has a shaft, a capsule.
template <typename Scalar>
struct Avatar<Scalar, 3> {
  VectorOf<Scalar, 3> position =
      VectorOf<Scalar, 3>::Zero();  ///< [m] centre of the sphere, tip of the capsule's axis
  Scalar radius;                    ///< [m] >= 0
  VectorOf<Scalar, 3> shaft = VectorOf<Scalar, 3>::Zero();  ///< [m] from the tip to the other end of the axis

  [[nodiscard]] Shaft<Scalar> axis() const noexcept { return {position, shaft}; }
};

namespace detail {

/// The vector from a point to the avatar's centre, or to the nearest point of its axis [m].
template <typename Scalar>
Vector2<Scalar> way_to(const Avatar<Scalar>& avatar, const Vector2<Scalar>& point) noexcept {
  return avatar.position - point;
}
template <typename Scalar>
VectorOf<Scalar, 3> way_to(const Avatar<Scalar, 3>& avatar, const VectorOf<Scalar, 3>& point) noexcept {
  const Shaft<Scalar> axis = avatar.axis();
  return axis.at(axis.nearest(point)) - point;
}

}  // namespace detail

}  // namespace hapbeam
