// SPDX-License-Identifier: MIT
// Where a piece of a rod is nearest to the core of a rigid body, how far both have moved against each other, and how the body bends what touches it.
//
// All as seen from the body.  Distances differ by no more than places do, which tells what is too far away.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/contact/closest_point.hpp>
#include <hapbeam/world/pair.hpp>
#include <hapbeam/world/placed_body.hpp>

namespace hapbeam::detail {

using RodPiece = CubicSegment<double, 3>;

/// A function of a symmetric matrix, by that of its eigenvalues.
template <class F>
RodPair::Bends spectral(const RodPair::Bends& A, F&& f) noexcept {
  const double mean = (A(0, 0) + A(1, 1)) / 2, off = (A(0, 0) - A(1, 1)) / 2, cross = (A(0, 1) + A(1, 0)) / 2,
               radius = std::sqrt(off * off + cross * cross), more = f(mean + radius),
               less = f(mean - radius), over = radius > 0 ? (more - less) / (2 * radius) : 0.0;
  RodPair::Bends of;
  of << (more + less) / 2 + over * off, over * cross, over * cross, (more + less) / 2 - over * off;
  return of;
}

/// Whether something within a box may be within reach, or has been since save().
inline bool may_touch(const PlacedBody& core, const Box<double, 3>& box, double reach) noexcept {
  VectorOf<double, 3> centre, half;
  for (int k = 0; k < 3; ++k)
    centre[k] = (box.low[k] + box.high[k]) / 2, half[k] = (box.high[k] - box.low[k]) / 2;
  const SurfaceDistance found = core.body().from_core(core.local(centre));
  // A plane is as far from all of it as its normal tells.
  if (core.is_thick()) return found.distance - core.turned(found.normal).cwiseAbs().dot(half) < reach;
  return found.distance - std::sqrt(half.squaredNorm()) < reach + core.travel();
}

/// How far points of a piece have moved against the body at most [m].  Along a tube between its ends nothing passes.
inline double travel_past(const RigidBody& body, const RodPiece& was, const RodPiece& now,
                          double reach) noexcept {
  double most = 0, aside = 0;
  for (int k = 0; k < 4; ++k) most = (std::max)(most, (now.col(k) - was.col(k)).squaredNorm());
  if (body.kind() != RigidBody::Kind::tube || most <= reach * reach / 4) return std::sqrt(most);
  const double rim = body.radius() + reach;
  for (int k = 0; k < 4; ++k) {
    for (const RodPiece* piece : {&was, &now}) {
      if (body.axis().nearest(piece->col(k)).beyond != 0) return std::sqrt(most);
      for (const double end : {0.0, body.axis().length()})
        if ((piece->col(k) - body.axis().at(end).r).squaredNorm() < rim * rim) return std::sqrt(most);
    }
    const VectorOf<double, 3> by = now.col(k) - was.col(k);
    aside = (std::max)(aside, cross3<double>(by, body.axis().nearest(now.col(k)).tangent).squaredNorm());
  }
  return std::sqrt(aside);
}

/// A place of a piece, 0 to 1, and what it has from the core.
struct PlaceOnPiece {
  double t;
  SurfaceDistance from;
};
/// @param most  a piece that is farther need not be known better [m]
inline PlaceOnPiece nearest_on(const RodPiece& piece, const RigidBody& body, double most) noexcept {
  constexpr std::size_t parts = 4;
  constexpr int rounds = 32;
  constexpr double exact = 1e-6;
  double speed = 0;
  for (int k = 0; k < 3; ++k)
    speed = (std::max)(speed, 3 * std::sqrt((piece.col(k + 1) - piece.col(k)).squaredNorm()));
  const auto look = [&](double t) { return PlaceOnPiece{t, body.from_core(point_at(piece, t))}; };
  const auto slope = [&](const PlaceOnPiece& at) { return at.from.normal.dot(tangent(piece, at.t)); };
  std::array<PlaceOnPiece, parts + 1> seen;
  seen[parts / 2] = look(0.5);
  if (seen[parts / 2].from.distance - speed / 2 > most) return seen[parts / 2];
  std::size_t best = parts / 2;
  for (std::size_t k = 0; k <= parts; ++k) {
    if (k != parts / 2) seen[k] = look(double(k) / double(parts));
    if (seen[k].from.distance < seen[best].from.distance) best = k;
  }
  // To where the distance has no slope, between two places from which it falls: by the secant, and every other time halfway.
  const PlaceOnPiece middle = seen[best];
  const double rise = slope(middle);
  if (middle.from.distance - speed / double(2 * parts) > most || best == (rise > 0 ? 0 : parts))
    return middle;
  PlaceOnPiece a = rise > 0 ? seen[best - 1] : middle, b = rise > 0 ? middle : seen[best + 1], c = middle;
  double slope_a = slope(a), slope_b = slope(b);
  const auto may_be_nearer = [&] {
    return a.from.distance + b.from.distance - speed * (b.t - a.t) < 2 * most;
  };
  for (int k = 0; k < rounds && slope_a < 0 && slope_b > 0 && may_be_nearer(); ++k) {
    c = look(k % 2 == 0 ? (a.t * slope_b - b.t * slope_a) / (slope_b - slope_a) : (a.t + b.t) / 2);
    const double slope_c = slope(c);
    if (std::abs(slope_c) <= exact * speed) break;
    if (slope_c > 0) b = c, slope_b = slope_c;
    else a = c, slope_a = slope_c;
  }
  return c.from.distance < middle.from.distance ? c : middle;
}

/// Puts in what a body decides of a pair.   @param p  of the rod
inline void lead(const PlacedBody& core, const VectorOf<double, 3>& p, RodPair& pair) noexcept {
  using Vector = VectorOf<double, 3>;
  const auto look = [&](const Vector& beside) {
    return core.nearest(core.at(0) + pair.on + pair.reach * pair.normal + beside);
  };
  const auto put = [&](const PlacedBody::Nearest& found) { pair.normal = found.normal, pair.on = found.on; };
  put(look(Vector::Zero()));
  pair.look();
  // By how much n turns beside it.
  constexpr double step = 1e-4, flat = 1e9, curved = 1e-6, follows = 1e3;
  const double beside = step * pair.reach;
  const Vector &a = pair.axes[1], &b = pair.axes[2], by_a = look(beside * a).normal - pair.normal,
               by_b = look(beside * b).normal - pair.normal;
  RodPair::Bends turns;
  turns << a.dot(by_a), a.dot(by_b), b.dot(by_a), b.dot(by_b);
  turns /= step;  // times the reach
  pair.bends = spectral(turns, [&](double k) { return pair.reach * (std::abs(k) > curved ? 1 / k : flat); });
  if (!pair.friction.is_free()) return;
  // Where it is flat, the rod goes over it freely.
  const Vector off = p - core.at(0) - pair.on;
  const RodPair::Bends free = spectral(
      turns, [](double k) { return std::abs(k) > curved ? 1 / (1 + follows * k * follows * k) : 1.0; });
  const VectorOf<double, 2> by = free * VectorOf<double, 2>(off.dot(a), off.dot(b));
  put(look(by[0] * a + by[1] * b));
  pair.look();
}

}  // namespace hapbeam::detail
