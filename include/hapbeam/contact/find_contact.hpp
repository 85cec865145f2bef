// SPDX-License-Identifier: MIT
// The avatar, and its contact with the deformed beam: place, depth and side.
//
// The avatar, or haptic interaction point, is the body that the hand moves: a disc in the plane of a beam, and a sphere or a capsule beside a rod
// in space.
// The beam is the set of points within half its thickness of the centreline, so its ends are round. Left of the
// centreline's direction (above, where it runs along x) is side +1, right of it -1. A beam is thin and a hand is fast.
// The side of the touch is therefore stored, and a step that crossed the centreline is contact, however long it was.
// No allocation, noexcept, bounded work.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <hapbeam/centreline.hpp>
#include <hapbeam/check.hpp>
#include <hapbeam/contact/bounding_volumes.hpp>
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

/// The contact of avatar and beam, or, without contact, the nearest point.
/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
struct Contact {
  bool touching = false;
  bool past_end = false;  ///< the avatar's centre lies beyond an end of the centreline
  int side = 1;           ///< +1 or -1: where the beam is touched from; a rod has one side, +1
  int segment = -1;       ///< piece of the centreline; -1: no answer, all else is zero
  Scalar s = 0;           ///< [m] arc position of the foot point
  Scalar depth = 0;       ///< [m] penetration; negative: the gap
  VectorOf<Scalar, D> foot = VectorOf<Scalar, D>::Zero();   ///< [m] nearest point of the centreline
  VectorOf<Scalar, D> point = VectorOf<Scalar, D>::Zero();  ///< [m] on the surface, foot + normal thickness/2
  VectorOf<Scalar, D> normal = VectorOf<Scalar, D>::Zero();  ///< unit, out of the beam on the touched side
};

/// State from tick to tick.  Starts empty.
/// @tparam D  2 | 3
template <typename Scalar, int D = 2>
struct ContactMemory {
  PlaceOf<Scalar, D> place = Avatar<Scalar, D>{}.place();  ///< [m] where the avatar was
  bool known = false;                                      ///< place is valid
  bool touching = false;                                   ///< the avatar touched the beam
  bool through = false;  ///< touching, in a plane: its centre beyond the centreline
  int side = 1;          ///< touching, in a plane: from this side
  Scalar s = 0;          ///< [m] touching, in space: there
  VectorOf<Scalar, D> normal = VectorOf<Scalar, D>::Zero();  ///< touching, in space: along this one
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

/// The contact's place on the beam.   @param nearest  its index within the line   @param first  index of the line's first piece in the whole
/// @param begins, ends  whether the line holds the beam's ends   @return unit tangent of the centreline there
template <typename Scalar, int D>
VectorOf<Scalar, D> place_contact(Contact<Scalar, D>& contact, const NearestPoint<Scalar, D>& nearest,
                                  const Centreline<Scalar, D>& line, int first, bool begins,
                                  bool ends) noexcept {
  const int i = nearest.segment;
  const Scalar t = nearest.at.t;
  const auto &a = line[i], &b = line[i + 1];
  const VectorOf<Scalar, D> along = tangent(nearest.piece, t).normalized();
  const Scalar ahead = along.dot(nearest.at.offset);
  contact.segment = first + i;
  contact.s = t < 1 ? (std::min)(a.s + t * (b.s - a.s), b.s) : b.s;
  contact.past_end =
      (begins && i == 0 && t == 0 && ahead < 0) || (ends && i == line.segments() - 1 && t == 1 && ahead > 0);
  return along;
}

/// The contact at the nearest point.
/// @param nearest  its index within the part   @param crossings  of the avatar's step, called where it may have crossed the beam
template <typename Scalar, class Crossed>
Contact<Scalar> contact_at(const NearestPoint<Scalar>& nearest, const CentrelinePart<Scalar>& part,
                           const Avatar<Scalar>& avatar, Scalar thickness, ContactMemory<Scalar>& memory,
                           Crossed&& crossings) noexcept {
  const Vector2<Scalar>& q = avatar.position;
  Contact<Scalar> contact;
  const Vector2<Scalar>& offset = nearest.at.offset;
  const Vector2<Scalar> along =
      place_contact(contact, nearest, part.line, part.first, part.begins(), part.ends());
  contact.foot = q - offset;

  // A step that ends on the centreline itself has crossed it, so the sign of zero does not matter below.
  const int present_side = cross(along, offset) < 0 ? -1 : 1;

  constexpr Scalar eps = std::numeric_limits<Scalar>::epsilon(), round_off = 64 * eps * eps;
  contact.side = present_side;
  if (memory.touching) {
    const bool goes_round_end = contact.past_end && !memory.through;
    if (!goes_round_end) contact.side = memory.side;
  } else if (memory.known) {
    // Only a step longer than the present distance can have crossed anything.
    if ((q - memory.place).squaredNorm() >= nearest.at.distance_squared) {
      const Crossings crossed = crossings();
      if (crossed.count % 2 != 0) contact.side = crossed.net > 0 ? 1 : -1;
      // Round-off says on which side of the centreline the avatar is, and not that it has crossed.
      else if (nearest.at.distance_squared <= round_off * q.squaredNorm()) contact.side = memory.side;
    }
  }

  const Scalar distance = std::sqrt(nearest.at.distance_squared), reach = avatar.radius + thickness / 2;
  const bool through = contact.side != present_side;
  const Scalar gap = through && !contact.past_end ? -distance : distance;
  contact.depth = reach - gap;
  contact.touching = contact.depth > 0;
  if (!contact.touching) contact.side = present_side;

  // At a node the way to the centre is the normal, unless it is too short to have a direction.
  if ((nearest.at.t == 0 || nearest.at.t == 1) &&
      distance > std::sqrt(std::numeric_limits<Scalar>::epsilon()) * reach) {
    contact.normal = offset / gap;
  } else {
    const Scalar side = static_cast<Scalar>(contact.side);
    contact.normal = {-side * along.y(), side * along.x()};
  }
  contact.point = contact.foot + contact.normal * (thickness / 2);
  memory = {q, true, contact.touching, contact.touching && through, contact.side, 0, {0, 0}};
  return contact;
}

}  // namespace detail

/// The avatar against the deformed beam.  Inside the beam's length
///   depth = radius + thickness/2 - side * signed distance of the centre,
/// hence more than radius + thickness/2 when the centre has passed through the centreline.  Past an end the
/// distance has no sign.  While there is no contact the side follows the avatar; while there is, it stays,
/// unless the avatar goes round an end.  Contact ends when depth <= 0.
/// A position that is not finite, or too large to square, is answered with segment -1 and changes no memory.
/// @param volumes    refitted to this centreline   @param thickness  [m] >= 0
/// @param memory     of the same avatar and beam, in and out
/// Real-time: noexcept, no allocation, bounded; mostly O(log n).
template <typename Scalar>
[[nodiscard]] Contact<Scalar> find_contact(const Avatar<Scalar>& avatar, const Centreline<Scalar>& centreline,
                                           const BoundingVolumes<Scalar>& volumes, Scalar thickness,
                                           ContactMemory<Scalar>& memory) noexcept {
  const NearestPoint<Scalar> nearest = volumes.nearest(centreline, avatar.position);
  if (nearest.segment < 0) return {};
  return detail::contact_at(nearest, {centreline, 0, centreline.segments()}, avatar, thickness, memory,
                            [&] { return volumes.crossings(centreline, memory.place, avatar.position); });
}

/// True if find_contact() would find no contact, because the avatar is farther from the box around the beam than its
/// own size and its last step. It then replaces find_contact(), at the cost of a box. If false, nothing is decided and
/// nothing changes.
/// Real-time: noexcept, no allocation, O(1).
template <typename Scalar, int D>
[[nodiscard]] bool out_of_reach(const Avatar<Scalar, D>& avatar, const BoundingVolumes<Scalar, D>& volumes,
                                Scalar thickness, ContactMemory<Scalar, D>& memory) noexcept {
  if (memory.touching) return false;
  const Scalar distance_squared = volumes.distance_squared(avatar.place());
  const Scalar reach = avatar.radius + thickness / 2;
  const Scalar step_squared = memory.known ? detail::step_squared(memory.place, avatar.place()) : Scalar(0);
  // In a plane a step counts where it crosses the beam, in space where it comes near.
  const Scalar swept = D == 2 ? Scalar(0) : reach + std::sqrt(step_squared);
  if (!(distance_squared > reach * reach && distance_squared > step_squared &&
        distance_squared > swept * swept && std::isfinite(distance_squared)))
    return false;
  memory.place = avatar.place();
  memory.known = true;
  return true;
}

}  // namespace hapbeam
