// SPDX-License-Identifier: MIT
// Where a piece of a rod is nearest to a rigid body, and how far both have moved against each other.
//
// The core of a body is what its surface is its radius from: a plane, a point or an axis; of a tube it is the wall itself.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/contact/box.hpp>
#include <hapbeam/contact/closest_point.hpp>
#include <hapbeam/world/rigid_body.hpp>

namespace hapbeam::detail {

/// A point as a body sees it.
struct FromBody {
  using Vector = VectorOf<double, 3>;

  FromBody(const PlacedBody& body, const Vector& point) noexcept {
    const Vector off = point - body.at(0);
    s = body.axis().dot(off);
    if (body.kind() == RigidBody::Kind::half_space) {
      distance = s, s = 0, normal = body.axis();
      return;
    }
    const double inside = std::clamp(s, 0.0, body.length()), beyond = s - inside;
    const Vector across = off - s * body.axis();
    s = inside, aside = std::sqrt(across.squaredNorm());
    const bool tube = body.kind() == RigidBody::Kind::tube;
    const double over = aside - (tube ? body.radius() : 0);
    distance = std::sqrt(over * over + beyond * beyond);
    const Vector out = aside > 0 ? Vector(across / aside) : Vector::Zero();
    if (distance > 0) normal = over / distance * out + beyond / distance * body.axis();
    else normal = tube ? out : Vector::UnitZ();
    if (tube) ring = over < 0 ? -body.radius() : body.radius();
  }

  double distance;   // from the core [m]; below a plane negative
  double s;          // on the axis [m]
  double aside = 0;  // from the axis [m]
  double ring = 0;   // of a tube: its radius, less than 0 from inside [m]
  Vector normal;     // from the core to the point
};

/// From the core of a body to where it presses a rod [m].
inline double reach_of(const PlacedBody& body, double radius) noexcept {
  return radius + (body.kind() == RigidBody::Kind::round ? body.radius() : 0);
}

/// Whether something within a box may be within reach.
inline bool may_touch(const PlacedBody& body, const Box<double, 3>& box, double reach) noexcept {
  if (body.kind() == RigidBody::Kind::half_space) {
    double least = 0;
    for (int k = 0; k < 3; ++k) {
      const double n = body.axis()[k];
      least += n * ((n > 0 ? box.low[k] : box.high[k]) - body.at(0)[k]);
    }
    return least < reach;
  }
  const double moved = std::sqrt(body.travel_squared());
  if (body.kind() != RigidBody::Kind::tube)
    return box.distance_squared(body.shaft()) <= (reach + moved) * (reach + moved);
  // Within the tube, or outside of it.
  VectorOf<double, 3> centre;
  double across = 0;
  for (int k = 0; k < 3; ++k) {
    const double u = body.axis()[k];
    centre[k] = (box.low[k] + box.high[k]) / 2;
    across += (box.high[k] - box.low[k]) / 2 * std::sqrt((std::max)(1 - u * u, 0.0));
  }
  const double out = body.radius() + reach + 2 * moved;
  return FromBody(body, centre).aside + across > body.radius() - reach - 2 * moved &&
         box.distance_squared(body.shaft()) <= out * out;
}
/// Whether a piece may, as its control points show.  @param was, now  of it
inline bool may_touch(const PlacedBody& body, const CubicSegment<double, 3>& was,
                      const CubicSegment<double, 3>& now, double reach) noexcept {
  const bool wall = body.kind() == RigidBody::Kind::half_space;
  if (body.kind() == RigidBody::Kind::tube) {
    // Inside of it all along.
    const double most = body.radius() - reach - 2 * std::sqrt(body.travel_squared());
    bool within = true;
    for (int k = 0; k < 4 && within; ++k)
      within = FromBody(body, was.col(k)).aside < most && FromBody(body, now.col(k)).aside < most;
    if (within) return false;
  }
  bool below = !wall;
  for (int k = 0; k < 4 && !below; ++k) below = FromBody(body, now.col(k)).distance < reach;
  return below;
}

/// Whether a piece may have passed the core since save(), but for a plane, which remains below.
inline bool may_have_passed(const PlacedBody& body, const CubicSegment<double, 3>& was,
                            const CubicSegment<double, 3>& now, double reach) noexcept {
  if (body.kind() == RigidBody::Kind::half_space) return false;
  // Along a tube between its ends nothing passes.
  bool between = body.kind() == RigidBody::Kind::tube;
  for (int k = 0; k < 4 && between; ++k)
    for (const auto& piece : {was, now}) {
      const double s = body.axis().dot(piece.col(k) - body.at(0));
      between = between && s > reach && s < body.length() - reach;
    }
  const Shaft<double> here = body.shaft(), then = body.saved_shaft();
  const VectorOf<double, 3> tip = here.tip - then.tip, end = tip + here.way - then.way;
  double most = 0;
  for (int k = 0; k < 4; ++k)
    for (const auto& moved : {tip, end}) {
      const VectorOf<double, 3> by = now.col(k) - was.col(k) - moved;
      const double along = between ? by.dot(body.axis()) : 0;
      most = (std::max)(most, by.squaredNorm() - along * along);
    }
  return !(most <= reach * reach / 4);
}

/// Where a piece is nearest, 0 to 1.
inline double nearest_on(const CubicSegment<double, 3>& piece, const PlacedBody& body) noexcept {
  if (body.kind() == RigidBody::Kind::round) return closest_point(piece, body.shaft()).t;
  const auto distance = [&](double t) { return FromBody(body, point_at(piece, t)).distance; };
  constexpr int parts = 4, rounds = 7;
  double best = 0, least = std::numeric_limits<double>::infinity();
  const auto visit = [&](double t) {
    const double d = distance(t);
    if (d < least) best = t, least = d;
    return d;
  };
  for (int k = 0; k <= parts; ++k) (void)visit(double(k) / parts);
  // To the vertex of the parabola through three, ever closer to each other, or to the least of those.
  double step = 1.0 / parts;
  for (int k = 0; k < rounds; ++k, step /= 4) {
    const double from = best, middle = least, low = visit((std::max)(from - step, 0.0)),
                 high = visit((std::min)(from + step, 1.0)), bend = low + high - 2 * middle;
    if (bend > 0)
      (void)visit(std::clamp(from + step * std::clamp((low - high) / (2 * bend), -1.0, 1.0), 0.0, 1.0));
  }
  return best;
}

}  // namespace hapbeam::detail
