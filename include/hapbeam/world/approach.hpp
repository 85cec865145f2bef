// SPDX-License-Identifier: MIT
// Where rods are nearest to each other, to themselves and to rigid bodies, and how far they have moved against those.
//
// Rods that nowhere come within reach on their way from one shape to another, or no two points of which move against each other by more than half of
// the reach there, have not passed each other: a distance that was a reach is still half of one, and its direction tells the side.
// Real-time: noexcept, no allocation; O(n log n) where they are apart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/contact/box.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/world/pair.hpp>
#include <hapbeam/world/rigid_approach.hpp>

namespace hapbeam::detail {

/// A place of least distance.
struct Approach {
  std::array<double, 2> s;   // [m]
  VectorOf<double, 3> from;  // from the second rod to the first [m]
};

/// From about there downhill.   @param step  no farther at once [m]
inline Approach nearest_places(const Centreline<double, 3>& a, const Centreline<double, 3>& b, double s,
                               double t, const std::array<double, 2>& step) noexcept {
  constexpr int most = 20;
  constexpr double parallel = 1e-6, exact = 1e-6;
  const double end_a = a[a.segments()].s, end_b = b[b.segments()].s;
  VectorOf<double, 3> w;
  for (int k = 0;; ++k) {
    const RodPoint<double> p = a.at(s), q = b.at(t);
    w = p.r - q.r;
    if (k == most) break;
    // Of |w|², but for the curvature, which is small beside a reach.
    const double aa = p.tangent.squaredNorm(), bb = q.tangent.squaredNorm(), ab = p.tangent.dot(q.tangent),
                 ga = -w.dot(p.tangent), gb = w.dot(q.tangent),
                 over = 1 / ((1 + parallel) * aa * bb - ab * ab);
    const auto within = [](double x, double by, double most_by, double end) {
      return std::clamp(x + std::clamp(by, -most_by, most_by), 0.0, end);
    };
    double next_s = within(s, (bb * ga + ab * gb) * over, step[0], end_a);
    const double next_t = within(t, (gb + ab * (next_s - s)) / bb, step[1], end_b);
    next_s = within(s, (ga + ab * (next_t - t)) / aa, step[0], end_a);
    const double moved = std::abs(next_s - s) + std::abs(next_t - t);
    s = next_s, t = next_t;
    if (!(moved > exact * (step[0] + step[1]))) {
      w = a.at(s).r - b.at(t).r;
      break;
    }
  }
  return {{s, t}, w};
}

/// How far points of two pieces have moved against each other at most, squared [m²].   @param was, now  control points
inline double relative_travel(const CubicSegment<double, 3>& a_was, const CubicSegment<double, 3>& a_now,
                              const CubicSegment<double, 3>& b_was,
                              const CubicSegment<double, 3>& b_now) noexcept {
  const CubicSegment<double, 3> a = a_now - a_was, b = b_now - b_was;
  double most = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) most = (std::max)(most, (a.col(i) - b.col(j)).squaredNorm());
  return most;
}

/// Calls visit(element of a, element of b), which tells whether to go on, for each two that may have come within reach since save().
/// @param a, b  RodBody, after sweep()   @return whether no visit ended it
template <class Body, class Visit>
bool visit_approaches(const Body& a, const Body& b, double reach, Visit&& visit) noexcept {
  using Bounds = Box<double, 3>;
  bool on = true;
  if (!a.swept().root().grown(reach).overlaps(b.swept().root())) return true;
  const auto line = a.line();
  for (int e = 0; e < a.elements() && on; ++e) {
    Bounds box;
    box.include(line.segment(e));
    if (a.moves) box.include(a.saved_segment(e));
    box = box.grown(reach);
    if (!box.overlaps(b.swept().root())) continue;
    b.swept().visit([&](const Bounds& other) { return other.overlaps(box) ? 0.0 : 1.0; }, [] { return 0.0; },
                    [&](int f) { return on = visit(e, f); });
  }
  return on;
}

/// What comes of a look at all that may meet.
struct Look {
  bool close = true;   ///< whether none has moved too far since save()
  double deepest = 0;  ///< distance less the reach of what does not touch yet, in reaches
  double least = 1;    ///< distance of all, in reaches
  RodPair pair;        ///< that of the deepest

  /// @param found  that is so far away [m]   @param lacks  of lacking()
  void see(const RodPair& found, double distance, double lacks) noexcept {
    least = (std::min)(least, distance / found.reach);
    const double gap = distance / found.reach - 1 + lacks;
    if (gap < deepest) deepest = gap, pair = found;
  }
};

/// What an element lacks of its true curve at a place, of what it lacks at another under a force there, at most: of a clamped piece √(g(x, x)/g(s, s)).
/// @return 0 in two elements
template <class Body>
double lacks_beside(const Body& body, double s, double other) noexcept {
  constexpr double smallest = 1e-4;
  const auto line = body.line();
  const int e = line.segment_at(s);
  const double l = line[e + 1].s - line[e].s, x = (s - line[e].s) / l, y = (other - line[e].s) / l;
  if (!(y >= 0 && y <= 1)) return 0;
  const double ratio = x * (1 - x) / (std::max)(y * (1 - y), smallest);
  return ratio * std::sqrt((std::max)(ratio, 0.0));
}
/// Whether both places of two pairs of the same rods are no farther apart than that.   @param reaches  of rods   @param elements  or so many elements
template <class System>
bool beside_each_other(const System& system, const RodPair& a, const RodPair& b, double reaches,
                       double elements) noexcept {
  if (a.rod != b.rod) return false;
  const bool rigid = system.rigid(a.rod[1]);
  const double most = reaches * (rigid ? 2 * system.body(a.rod[0]).radius() : a.reach);
  for (std::size_t side = 0; side < 2; ++side) {
    if (side == 1 && rigid) break;
    const double off = std::abs(a.s[side] - b.s[side]);
    if (!(off <= (std::max)(most, elements * system.stride(a.rod[side])))) return false;
  }
  return true;
}
/// How far places may lie in each other beside contacts in a row, in reaches.
inline constexpr double row_depth = 0.01;
/// Contacts in a row are no more elements apart.
inline constexpr double row_stride = 1.01;
/// Whether a place of a tube is beside a contact that stays.
template <class System>
bool is_in_row(const System& system, const RodPair& found) noexcept {
  if (!system.along_tube(found)) return false;
  for (int k = 0; k < system.pairs(); ++k)
    if (system.is_pinned(system.pair(k)) && beside_each_other(system, system.pair(k), found, 2, row_stride))
      return true;
  return false;
}
/// What the elements of pairs that touch lack of the true curves at a place.   @return in reaches
template <class System>
double lacking(const System& system, const RodPair& found) noexcept {
  // One contact in half an element is enough, and closer ones are one.
  // What slides lies flat beyond it but for what the mesh leaves.
  constexpr double same = 0.25, flat = 1e-4;
  double most = 0;
  for (int k = 0; k < system.pairs(); ++k) {
    const RodPair& pair = system.pair(k);
    if (pair.rod != found.rod) continue;
    if (pair.rough()) most = (std::max)(most, flat);
    if (beside_each_other(system, pair, found, 2, 0.5))
      most = (std::max)(most, beside_each_other(system, pair, found, 2, 0) ? same : row_depth);
    double beside = 0;
    for (std::size_t side = 0; side < 2; ++side)
      if (!system.rigid(pair.rod[side]))
        beside = (std::max)(beside, lacks_beside(system.body(pair.rod[side]), found.s[side], pair.s[side]));
    most = (std::max)(most, beside * (1 - pair.distance(system.between(pair)) / pair.reach));
  }
  return most;
}
/// Whether a rod goes one way from the first piece to the last: two points of it are then no nearer than this cosine of their distance along it.
template <class Line>
bool goes_one_way(const Line& line, int first, int last) noexcept {
  constexpr double cosine = 0.7;
  const auto& way = line[(first + last + 1) / 2].tangent;
  const double square = cosine * cosine * way.squaredNorm();
  for (int i = first; i <= last + 1; ++i) {
    const double along = way.dot(line[i].tangent);
    if (!(along > 0 && along * along > square * line[i].tangent.squaredNorm())) return false;
  }
  return true;
}

/// At what may meet of rods i and j, or of one rod: a rod that bends by no less than its own radius comes back to itself after half a turn.
template <class System>
void look_at(const System& system, int i, int j, Look& look) noexcept {
  const auto &a = system.body(i), &b = system.body(j);
  const double reach = a.radius() + b.radius(), half_turn = i == j ? std::acos(-1.0) / 2 * reach : 0;
  const auto one_way = [&](int e, int f) {
    return goes_one_way(a.line(), e, f) && goes_one_way(a.saved_line(), e, f);
  };
  if (i == j && one_way(0, a.elements() - 1)) return;
  const auto first = a.line(), second = b.line();
  look.close = visit_approaches(a, b, reach, [&](int e, int f) {
    if (i == j && (f <= e || first[f + 1].s - first[e].s < half_turn || one_way(e, f))) return true;
    if (!(relative_travel(a.saved_segment(e), first.segment(e), b.saved_segment(f), second.segment(f)) <=
          reach * reach / 4))
      return false;
    const Approach found =
        nearest_places(first, second, (first[e].s + first[e + 1].s) / 2, (second[f].s + second[f + 1].s) / 2,
                       {first[e + 1].s - first[e].s, second[f + 1].s - second[f].s});
    if (i == j && found.s[1] - found.s[0] < half_turn) return true;
    RodPair pair;
    pair.rod = {i, j}, pair.s = found.s, pair.reach = reach, pair.bends = reach * RodPair::Bends::Identity();
    const double distance = std::sqrt(found.from.squaredNorm());
    pair.normal = found.from / distance;
    look.see(pair, distance, lacking(system, pair));
    return true;
  });
}
/// At what may meet of a rod and a rigid body.   @param number  of the body in pairs
template <class System>
void look_at_rigid(const System& system, int rod, int number, Look& look) noexcept {
  const auto& body = system.body(rod);
  const PlacedBody& core = *system.rigid(number);
  const double reach = core.reach(body.radius());
  const auto line = body.line();
  body.swept().visit(
      [&](const Box<double, 3>& box) { return may_touch(core, box, reach) ? 0.0 : 1.0; }, [] { return 0.0; },
      [&](int e) {
        const RodPiece now = core.local(line.segment(e));
        const double travel =
            core.is_thick() ? 0
                            : travel_past(core.body(), core.saved_local(body.saved_segment(e)), now, reach);
        const auto [t, from] = nearest_on(now, core.body(), reach + travel);
        if (!(from.distance < reach + travel)) return true;
        if (!(travel <= reach / 2)) return look.close = false;
        const auto see = [&](double at, const SurfaceDistance& is, double least) {
          RodPair pair;
          pair.rod = {rod, number}, pair.s[0] = line[e].s + at * (line[e + 1].s - line[e].s);
          const PlacedBody::Nearest nearest = core.nearest(point_at(now, at), is);
          pair.reach = reach, pair.normal = nearest.normal, pair.on = nearest.on;
          const bool in_row = is_in_row(system, pair);
          look.see(pair, is.distance, (std::max)(in_row ? least : 0, lacking(system, pair)));
          return in_row;
        };
        // A row has its contacts at nodes, and depth between those.
        if (see(t, from, row_depth))
          for (const double end : {0.0, 1.0}) (void)see(end, core.body().from_core(point_at(now, end)), 0);
        return true;
      });
}
/// At all of them.   @param system  PairSystem
template <class System>
Look look_around(System& system) noexcept {
  Look look;
  const int rods = static_cast<int>(system.bodies().size());
  for (auto& body : system.bodies()) body.sweep();
  const int all = rods + static_cast<int>(system.rigid().size());
  for (int i = 0; i < rods && look.close; ++i) {
    const bool moves = system.body(i).moves;
    for (int j = i; j < rods && look.close; ++j)
      if ((moves || system.body(j).moves) && !system.joined(i, j)) look_at(system, i, j, look);
    for (int j = rods; j < all && look.close; ++j)
      if ((moves || system.rigid(j)->moves) && !system.joined(i, j)) look_at_rigid(system, i, j, look);
  }
  return look;
}

}  // namespace hapbeam::detail
