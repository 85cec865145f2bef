// SPDX-License-Identifier: MIT
// The contact of a sphere or a capsule with the deformed rod: place, depth and normal.
//
// A rod is the set of points within half its thickness of the centreline. It has no sides: the normal points from the
// nearest point of the centreline to the avatar's axis. A rod is thin and a hand is fast, so the motion since the last
// tick is sampled in steps of half the reach. A rod that the motion meets is touched from the side of the first
// meeting, with the depth along that normal, until the avatar has moved around it.
// No allocation, noexcept, bounded work.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

namespace detail {

/// So often the way of a tick is looked at.
inline constexpr int most_looks = 16;

template <typename Scalar>
Contact<Scalar, 3> rod_contact_at(const NearestPoint<Scalar, 3>& nearest, const Shaft<Scalar>& axis,
                                  const Centreline<Scalar, 3>& line, const VectorOf<Scalar, 3>& before,
                                  Scalar reach, Scalar thickness) noexcept {
  using Vector = VectorOf<Scalar, 3>;
  Contact<Scalar, 3> contact;
  const Vector& offset = nearest.at.offset;
  const Vector along = place_contact(contact, nearest, line, 0, true, true);
  const Scalar distance = std::sqrt(nearest.at.distance_squared);
  contact.foot = point_at(nearest.piece, nearest.at.t);
  contact.depth = reach - distance;
  contact.touching = contact.depth > 0;
  // On the axis itself every way across the rod is the nearest one.
  if (distance > std::sqrt(std::numeric_limits<Scalar>::epsilon()) * reach)
    contact.normal = offset / distance;
  else if (const Vector side = before - along * along.dot(before); side.squaredNorm() > Scalar(0.01))
    contact.normal = unit(side);
  else contact.normal = across(line[nearest.segment].director, along);
  // And it has to be across the axis.
  if (axis.way.squaredNorm() > 0 && !(distance > 0))
    if (const Vector side = cross3<Scalar>(along, axis.way); side.squaredNorm() > 0)
      contact.normal = side.dot(contact.normal) < 0 ? Vector(-unit(side)) : unit(side);
  contact.point = contact.foot + contact.normal * (thickness / 2);
  return contact;
}

/// A rod that is held is not passed: what has come to lie on the other side of the axis is still touched from the side of before.
template <typename Scalar>
Contact<Scalar, 3> remembered(Contact<Scalar, 3> contact, const Shaft<Scalar>& axis, Scalar reach,
                              ContactMemory<Scalar, 3>& memory) noexcept {
  if (memory.touching && contact.depth > 0 && contact.depth < reach && !contact.past_end &&
      contact.normal.dot(memory.normal) < 0 && std::abs(contact.s - memory.s) < 2 * reach) {
    contact.normal = -contact.normal;
    contact.depth = 2 * reach - contact.depth;
  }
  contact.touching = contact.depth > 0;
  memory = {axis, true, contact.touching, false, 1, contact.s, contact.normal};
  return contact;
}

/// The step of the avatar since the last tick where it may have gone through a rod, else zero [m]: only one that is longer than the
/// present distance can have.
template <typename Scalar>
Scalar step_past(const ContactMemory<Scalar, 3>& memory, const Shaft<Scalar>& axis, Scalar reach,
                 const NearestPoint<Scalar, 3>& nearest) noexcept {
  const Scalar squared = memory.known ? step_squared(memory.place, axis) : Scalar(0);
  return squared > reach * reach / 4 && squared >= nearest.at.distance_squared ? std::sqrt(squared)
                                                                               : Scalar(0);
}

/// The contact at the nearest point.
template <typename Scalar>
Contact<Scalar, 3> contact_at(const NearestPoint<Scalar, 3>& nearest, const Centreline<Scalar, 3>& line,
                              const Avatar<Scalar, 3>& avatar, Scalar thickness,
                              ContactMemory<Scalar, 3>& memory) noexcept {
  const Scalar reach = avatar.radius + thickness / 2;
  return remembered(rod_contact_at(nearest, avatar.place(), line, memory.normal, reach, thickness),
                    avatar.place(), reach, memory);
}

}  // namespace detail

/// The avatar against the deformed rod: depth = radius + thickness/2 - distance of the avatar's axis from the centreline, and more
/// where the avatar has gone through the centreline since the last tick: then all of the way along the normal before.  No step up
/// to most_looks/4 diameters of rod and avatar passes through unseen.  Contact ends when depth <= 0.
/// A position that is not finite, or too large to square, is answered with segment -1 and changes no memory.
/// @param volumes    refitted to this centreline   @param thickness  [m] >= 0
/// @param memory     of the same avatar and rod, in and out
/// Real-time: noexcept, no allocation, bounded; mostly O(log n).
template <typename Scalar>
[[nodiscard]] Contact<Scalar, 3> find_contact(const Avatar<Scalar, 3>& avatar,
                                              const Centreline<Scalar, 3>& centreline,
                                              const BoundingVolumes<Scalar, 3>& volumes, Scalar thickness,
                                              ContactMemory<Scalar, 3>& memory) noexcept {
  using Vector = VectorOf<Scalar, 3>;
  const Shaft<Scalar> axis = avatar.place();
  const Scalar reach = avatar.radius + thickness / 2;
  const NearestPoint<Scalar, 3> nearest = volumes.nearest(centreline, axis);
  if (nearest.segment < 0) return {};
  const auto contact_at = [&](const NearestPoint<Scalar, 3>& at, const Shaft<Scalar>& where) {
    return detail::rod_contact_at(at, where, centreline, memory.normal, reach, thickness);
  };
  Contact<Scalar, 3> contact = contact_at(nearest, axis);
  if (const Scalar step = detail::step_past(memory, axis, reach, nearest); step > 0) {
    const int looks = static_cast<int>((std::min)(std::ceil(2 * step / reach), Scalar(detail::most_looks)));
    for (int k = 1; k < looks; ++k) {
      const Scalar t = Scalar(k) / Scalar(looks);
      const Shaft<Scalar> on_way{memory.place.tip + t * (axis.tip - memory.place.tip),
                                 memory.place.way + t * (axis.way - memory.place.way)};
      const NearestPoint<Scalar, 3> there = volumes.nearest(centreline, on_way);
      if (there.segment < 0 || !(there.at.distance_squared < reach * reach)) continue;
      Contact<Scalar, 3> first = contact_at(there, on_way);
      const Vector way = axis.at(on_way.nearest(first.foot)) - first.foot;
      first.depth = reach - first.normal.dot(way);
      // What still lies on that side is found there.
      if (first.depth > 0 && !(contact.touching && contact.normal.dot(first.normal) > 0)) contact = first;
      break;
    }
  }
  return detail::remembered(contact, axis, reach, memory);
}

}  // namespace hapbeam
