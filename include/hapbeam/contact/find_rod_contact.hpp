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
#include <hapbeam/contact/find_contact_near.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

/// What must be known of the tick before.  Starts empty.
template <typename Scalar>
struct ContactMemory<Scalar, 3> {
  /// [m] where the avatar was
  Shaft<Scalar> axis{VectorOf<Scalar, 3>::Zero(), VectorOf<Scalar, 3>::Zero()};
  bool known = false;                                        ///< axis is valid
  bool touching = false;                                     ///< the avatar touched the rod
  Scalar s = 0;                                              ///< [m] touching, there
  VectorOf<Scalar, 3> normal = VectorOf<Scalar, 3>::Zero();  ///< touching, along this one
};

namespace detail {

/// So often the way of a tick is looked at.
inline constexpr int most_looks = 16;

/// How far any point of a shaft has gone, at most [m].
template <typename Scalar>
Scalar step(const Shaft<Scalar>& from, const Shaft<Scalar>& to) noexcept {
  const VectorOf<Scalar, 3> tip = to.tip - from.tip, end = tip + to.way - from.way;
  return std::sqrt((std::max)(tip.squaredNorm(), end.squaredNorm()));
}

template <typename Scalar>
Contact<Scalar, 3> rod_contact_at(const NearestPoint<Scalar, 3>& nearest, const Shaft<Scalar>& axis,
                                  const Centreline<Scalar, 3>& line, const VectorOf<Scalar, 3>& before,
                                  Scalar reach, Scalar thickness) noexcept {
  using Vector = VectorOf<Scalar, 3>;
  Contact<Scalar, 3> contact;
  const int i = nearest.segment;
  const Scalar t = nearest.at.t;
  const CubicSegment<Scalar, 3> piece = line.segment(i);
  const Vector &offset = nearest.at.offset, along = unit(tangent(piece, t));
  const Scalar distance = std::sqrt(nearest.at.distance_squared), ahead = along.dot(offset);
  contact.segment = i;
  contact.foot = point_at(piece, t);
  contact.past_end = (i == 0 && t == 0 && ahead < 0) || (i == line.segments() - 1 && t == 1 && ahead > 0);
  contact.s = t < 1 ? (std::min)(line[i].s + t * (line[i + 1].s - line[i].s), line[i + 1].s) : line[i + 1].s;
  contact.depth = reach - distance;
  contact.touching = contact.depth > 0;
  // On the axis itself every way across the rod is the nearest one.
  if (distance > std::sqrt(std::numeric_limits<Scalar>::epsilon()) * reach)
    contact.normal = offset / distance;
  else if (const Vector side = before - along * along.dot(before); side.squaredNorm() > Scalar(0.01))
    contact.normal = unit(side);
  else contact.normal = across(line[i].director, along);
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
  memory = {axis, true, contact.touching, contact.s, contact.normal};
  return contact;
}

/// Whether the avatar may have gone through a rod since the last tick: only a step longer than the present distance can have.
template <typename Scalar>
bool may_have_passed(Scalar step, Scalar reach, const NearestPoint<Scalar, 3>& nearest) noexcept {
  return step > reach / 2 && step * step >= nearest.at.distance_squared;
}

/// As find_contact() of a rod that the avatar touches, sought near the last contact.
/// @param contact  out, where the answer is true   @return false where it may be elsewhere
template <class Model>
[[nodiscard]] bool find_contact_near(const Model& model, const Avatar<typename Model::Scalar, 3>& avatar,
                                     ContactMemory<typename Model::Scalar, 3>& memory,
                                     Contact<typename Model::Scalar, 3>& contact) noexcept {
  using Scalar = typename Model::Scalar;
  const Shaft<Scalar> axis = avatar.axis();
  const Scalar reach = avatar.radius + model.thickness() / 2;
  const Centreline<Scalar, 3> line = model.shape();
  const NearestPoint<Scalar, 3> nearest = nearest_of_touch(line, memory.s, axis, reach);
  if (!std::isfinite(nearest.at.distance_squared)) return false;
  if (may_have_passed(memory.known ? step(memory.axis, axis) : Scalar(0), reach, nearest)) return false;
  contact = remembered(rod_contact_at(nearest, axis, line, memory.normal, reach, model.thickness()), axis,
                       reach, memory);
  return true;
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
  const Shaft<Scalar> axis = avatar.axis();
  const Scalar reach = avatar.radius + thickness / 2;
  const NearestPoint<Scalar, 3> nearest = volumes.nearest(centreline, axis);
  if (nearest.segment < 0) return {};
  const auto contact_at = [&](const NearestPoint<Scalar, 3>& at, const Shaft<Scalar>& where) {
    return detail::rod_contact_at(at, where, centreline, memory.normal, reach, thickness);
  };
  Contact<Scalar, 3> contact = contact_at(nearest, axis);
  const Scalar step = memory.known ? detail::step(memory.axis, axis) : Scalar(0);
  if (detail::may_have_passed(step, reach, nearest)) {
    const int looks = static_cast<int>((std::min)(std::ceil(2 * step / reach), Scalar(detail::most_looks)));
    for (int k = 1; k < looks; ++k) {
      const Scalar t = Scalar(k) / Scalar(looks);
      const Shaft<Scalar> on_way{memory.axis.tip + t * (axis.tip - memory.axis.tip),
                                 memory.axis.way + t * (axis.way - memory.axis.way)};
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

/// True where find_contact() would find none, because the avatar is farther from the box around the rod than
/// its own size and its last step; then this takes its place, for the price of a box.  False says nothing and
/// changes nothing.
/// Real-time: noexcept, no allocation, O(1).
template <typename Scalar>
[[nodiscard]] bool out_of_reach(const Avatar<Scalar, 3>& avatar, const BoundingVolumes<Scalar, 3>& volumes,
                                Scalar thickness, ContactMemory<Scalar, 3>& memory) noexcept {
  if (memory.touching) return false;
  const Shaft<Scalar> axis = avatar.axis();
  const Scalar distance_squared = volumes.distance_squared(axis);
  const Scalar clear =
      avatar.radius + thickness / 2 + (memory.known ? detail::step(memory.axis, axis) : Scalar(0));
  if (!(distance_squared > clear * clear && std::isfinite(distance_squared))) return false;
  memory.axis = axis;
  memory.known = true;
  return true;
}

}  // namespace hapbeam
