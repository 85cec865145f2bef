// SPDX-License-Identifier: MIT
// The avatar, or haptic interaction point: the body that the hand moves. It is a disc in the plane of a beam, and a
// sphere or a capsule beside a rod in space.
//
// A plain value.  No allocation, noexcept.
#pragma once

#include <algorithm>
#include <type_traits>

#include <hapbeam/centreline.hpp>
#include <hapbeam/check.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

/// Where an avatar is: its centre in a plane, its axis in space.
template <typename Scalar, int D>
using PlaceOf = std::conditional_t<D == 2, Vector2<Scalar>, Shaft<Scalar>>;

/// A disc in the plane (x along the beam, w across).
/// @tparam D  of the space in which the beam bends: 2 | 3
template <typename Scalar, int D = 2>
struct Avatar {
  VectorOf<Scalar, D> position = VectorOf<Scalar, D>::Zero();  ///< [m] centre
  Scalar radius;                                               ///< [m] >= 0

  [[nodiscard]] const Vector2<Scalar>& place() const noexcept { return position; }
  /// The vector from a point to the centre [m].
  [[nodiscard]] Vector2<Scalar> way_from(const Vector2<Scalar>& point) const noexcept {
    return position - point;
  }
};

/// A sphere or, where it has a shaft, a capsule.
template <typename Scalar>
struct Avatar<Scalar, 3> {
  using Vector = VectorOf<Scalar, 3>;
  Vector position = Vector::Zero();  ///< [m] centre of the sphere, tip of the capsule's axis
  Scalar radius;                     ///< [m] >= 0
  Vector shaft = Vector::Zero();     ///< [m] from the tip to the other end of the axis

  [[nodiscard]] Shaft<Scalar> place() const noexcept { return {position, shaft}; }
  /// The vector from a point to the nearest point of the axis [m].
  [[nodiscard]] Vector way_from(const Vector& point) const noexcept {
    return place().at(place().nearest(point)) - point;
  }
};

namespace detail {

/// @param shaft  of a capsule in space
template <typename Scalar, int D>
Avatar<Scalar, D> avatar_at(const VectorOf<Scalar, D>& position, Scalar radius,
                            [[maybe_unused]] const VectorOf<Scalar, D>& shaft) noexcept {
  if constexpr (D == 2) return {position, radius};
  else return {position, radius, shaft};
}

/// How far an avatar has gone, at most [m²].
template <typename Scalar>
Scalar step_squared(const Vector2<Scalar>& from, const Vector2<Scalar>& to) noexcept {
  return (to - from).squaredNorm();
}
template <typename Scalar>
Scalar step_squared(const Shaft<Scalar>& from, const Shaft<Scalar>& to) noexcept {
  const VectorOf<Scalar, 3> tip = to.tip - from.tip, end = tip + to.way - from.way;
  return (std::max)(tip.squaredNorm(), end.squaredNorm());
}

/// Of a radius, in lengths of the beam.  Seen from the beam a larger disc is a plane, and in `float` the depth of a bend is lost in the
/// round-off of its radius.
inline constexpr double most_radius = 1000;

/// @param length  of the beam [m]   @throws std::invalid_argument unless the radius is 0 to most_radius lengths
[[gnu::cold]] inline void check_radius(const char* field, double radius, double length) {
  if (!(radius >= 0 && radius <= most_radius * length))
    reject(field, radius, "m",
           ("0 to " + number(most_radius * length) + " m, a thousand lengths of the beam").c_str());
}

}  // namespace detail

}  // namespace hapbeam
