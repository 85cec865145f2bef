// SPDX-License-Identifier: MIT
// The contact of an avatar with the deformed rod: place, depth and normal; and that of a lasting touch with a beam or a rod, sought near the last one,
// with a proof that no other piece is nearer, or lies deeper.
//
// A rod is the set of points within half its thickness of the centreline. It has no sides: the normal points from the
// nearest point of the centreline to the avatar's axis. A rod is thin and a hand is fast, so the motion since the last
// tick is sampled in steps of half the reach. A rod that the motion meets is touched from the side of the first
// meeting, with the depth along that normal, until the avatar has moved around it.
//
// Of a lasting touch: in its range a beam of moderate rotation runs along x without turning back. Let d be the distance of the avatar's
// centre q from the nearest point of a few pieces. Any nearer point lies between q.x - d and q.x + d. If the pieces
// cover that interval, or reach the beam's end, no other piece is searched or computed.
//
// A beam of finite rotation may approach from any side. A touch goes on where it was, downhill. A piece is nowhere farther from the middle of its
// chord than 0.82 chords, so that most others are excluded without an angle; the rest are searched.
// Real-time: noexcept, no allocation, bounded. A lasting touch costs three or four pieces, with finite rotation one or two, and a distance for each
// further piece.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/contact/closest_point.hpp>
#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/vectors.hpp>

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

/// The nearest point of a part that runs along x, to q.
template <typename Scalar>
NearestPoint<Scalar> nearest_along_x(const Centreline<Scalar>& line, const Vector2<Scalar>& q) noexcept {
  NearestPoint<Scalar> best;
  const auto x = [&](int i) { return line[i].s + line[i].u; };
  const auto look = [&](int i) HAPBEAM_INLINED {
    const Scalar away = (std::max)((std::max)(x(i) - q.x(), q.x() - x(i + 1)), Scalar(0));
    if (away * away > best.at.distance_squared * more_than_round_off<Scalar>) return;
    best.look(i, line.segment(i), q);
  };
  int beneath = 0;
  while (beneath + 1 < line.segments() && x(beneath + 1) <= q.x()) ++beneath;
  look(beneath);
  for (int i = beneath - 1; i >= 0; --i) look(i);
  for (int i = beneath + 1; i < line.segments(); ++i) look(i);
  return best;
}

/// The nearest point that is reached downhill from a piece, without a way over what is farther.
template <typename Scalar, int D, class Query>
NearestPoint<Scalar, D> nearest_downhill(const Centreline<Scalar, D>& line, int piece,
                                         const Query& q) noexcept {
  // A contact is a node, and one of the two pieces that meet there leads to q.
  if (piece > 0 && line.ahead(piece, q) < 0) --piece;
  const CubicSegment<Scalar, D> its = line.segment(piece);
  NearestPoint<Scalar, D> best{piece, closest_point(its, q), its};
  const int way = best.at.t <= 0 ? -1 : best.at.t >= 1 ? 1 : 0;
  for (int next = piece + way; way != 0 && next >= 0 && next < line.segments(); next += way) {
    if (!best.look(next, line.segment(next), q)) break;
    if (way < 0 ? best.at.t > 0 : best.at.t < 1) break;
  }
  return best;
}

/// The nearest point of a centreline of finite rotation, for a touch.  Where it winds it may touch the avatar at several places.  A touch keeps
/// its own until another one lies deeper by half a reach: the nearest would be another in each tick, as soon as the beam has yielded there.
/// @param s  [m] where it was   @param reach  [m]
template <typename Scalar, int D, class Query>
NearestPoint<Scalar, D> nearest_of_touch(const Centreline<Scalar, D>& line, Scalar s, const Query& q,
                                         Scalar reach) noexcept {
  NearestPoint<Scalar, D> best = nearest_downhill(line, line.segment_at(s), q);
  Scalar d = (std::max)(std::sqrt(best.at.distance_squared) - reach / 2, Scalar(0));
  const int own = best.segment;
  const bool plain = line.straight(own);
  for (int step = -1; step <= 1; step += 2) {
    int i = own + step;
    // Where both it and the one beside it are as long as their chords, no other place of them is nearer than half as near.
    if (plain && i >= 0 && i < line.segments() && line.straight(i)) i += step;
    for (; i >= 0 && i < line.segments(); i += step) {
      if (line.excludes(i, q, d)) continue;
      const CubicSegment<Scalar, D> piece = line.segment(i);
      const ClosestPoint<Scalar, D> other = closest_point(piece, q);
      const Scalar its = std::sqrt(other.distance_squared);
      if (its < d) best.segment = i, best.at = other, best.piece = piece, d = its;
    }
  }
  return best;
}

/// As find_contact_near(), of a beam that runs along x.   @param part  of the model's shape, at s
template <class Model, typename Scalar>
[[nodiscard]] bool find_contact_along_x(const Model& model, CentrelinePart<Scalar> part, Scalar s,
                                        const Avatar<Scalar>& avatar, ContactMemory<Scalar>& memory,
                                        Contact<Scalar>& contact) noexcept {
  const Vector2<Scalar>& q = avatar.position;
  const auto x = [](const CentrelineNode<Scalar>& node) { return node.s + node.u; };
  Scalar low = s, high = s;
  for (bool wider = false;; wider = true) {
    const Centreline<Scalar>& line = part.line;
    const NearestPoint<Scalar> nearest = nearest_along_x(line, q);
    if (nearest.segment < 0) return false;
    const Scalar d = std::sqrt(nearest.at.distance_squared) * more_than_round_off<Scalar>;
    const CentrelineNode<Scalar>&first = line[0], &last = line[line.segments()];
    const bool left = part.begins() || x(first) < q.x() - d, right = part.ends() || x(last) > q.x() + d;
    if (left && right) {
      contact = contact_at(nearest, part, avatar, model.thickness(), memory, [] { return Crossings{}; });
      return true;
    }
    if (wider) return false;
    if (!left) low = (std::min)(low, q.x() - d - first.u);
    if (!right) high = (std::max)(high, q.x() + d - last.u);
    part = part_of(model, low, high);
  }
}

/// As find_contact() on the whole of the model's shape, for an avatar that touches it.
/// @param s  [m] where the last contact was   @param memory  touching   @param contact  out, where the answer is true
/// @return false where the contact may be elsewhere
template <class Model, typename Scalar = typename Model::Scalar, int D = dimension_of<Model>>
[[nodiscard]] bool find_contact_near(const Model& model, Scalar s, const Avatar<Scalar, D>& avatar,
                                     ContactMemory<Scalar, D>& memory, Contact<Scalar, D>& contact) noexcept {
  if constexpr (D == 2 && !takes_push<Model>)  // what can be pushed may turn
    if (const CentrelinePart<Scalar> part = part_of(model, s, s); !part.line.any_rotation())
      return find_contact_along_x(model, part, s, avatar, memory, contact);
  const Centreline<Scalar, D> line = model.shape();
  const Scalar reach = avatar.radius + model.thickness() / 2;
  const NearestPoint<Scalar, D> nearest = nearest_of_touch(line, s, avatar.place(), reach);
  if (!std::isfinite(nearest.at.distance_squared)) return false;
  if constexpr (D == 2) {
    contact = contact_at(nearest, {line, 0, line.segments()}, avatar, model.thickness(), memory,
                         [] { return Crossings{}; });
  } else {
    if (step_past(memory, avatar.place(), reach, nearest) > 0) return false;
    contact = contact_at(nearest, line, avatar, model.thickness(), memory);
  }
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
      const VectorOf<Scalar, 3> way = axis.at(on_way.nearest(first.foot)) - first.foot;
      first.depth = reach - first.normal.dot(way);
      // What still lies on that side is found there.
      if (first.depth > 0 && !(contact.touching && contact.normal.dot(first.normal) > 0)) contact = first;
      break;
    }
  }
  return detail::remembered(contact, axis, reach, memory);
}

}  // namespace hapbeam
