// SPDX-License-Identifier: MIT
// A contact of two rods: one force and two places, unknowns of the equations of both.
//
//   L = Σ V - f · w + R |f| - ½ f · C(s₁, s₂) f,   w = r₁(s₁) - r₂(s₂)       f = λ n, n from rod 2 to rod 1; with friction f = λ n + t
//
// Stationary by f where w + C f = R n: the true curves, which C bends off what nodes hold, are R apart.  By a place where the true curve is
// across n.  Where the sections bend alike about all axes this is  Σ V - λ (|w| - R) - ½ λ² c.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/world/pair_friction.hpp>

namespace hapbeam {

/// Where two rods touch.
struct RodContact {
  std::array<int, 2> rod;        ///< 0-based numbers in the World
  std::array<double, 2> s;       ///< [m] arc positions
  VectorOf<double, 3> force;     ///< [N] on rod[0] by rod[1]
  VectorOf<double, 3> friction;  ///< [N] its part across the line that joins both places, which is the rest
  bool sliding;                  ///< whether they slide, where there is friction
  std::array<VectorOf<double, 3>, 2> at;  ///< [m] points of both centrelines
};

namespace detail {

struct RodPair {
  using Vector = VectorOf<double, 3>;

  std::array<int, 2> rod{};
  std::array<double, 2> s{};
  double reach = 0;                 // R, of both radii [m]
  double force = 0;                 // λ [N]
  Vector normal = Vector::UnitZ();  // n
  /// New: its direction and its places stay until it presses.
  bool fresh = true;
  std::array<bool, 2> held{};    // at an end of its rod, where the place stays
  std::array<double, 2> pull{};  // ∂L/∂s of the last equations [N]
  PairFriction friction;

  /// Whether friction acts.
  bool rough() const noexcept { return !fresh && friction.acts(); }

  /// Two directions across the normal.
  void look() noexcept {
    int least = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(normal[k]) < std::abs(normal[least])) least = k;
    axes[0] = normal;
    axes[1] = across<double>(Vector::Unit(least), normal);
    axes[2] = cross3(normal, axes[1]);
  }
  /// Adds an increment of f along the axes.
  void push(double along, double aside1, double aside2) noexcept {
    constexpr double most_turn = 0.3, least_left = 1e-3;
    if (fresh) {
      force += along;
      fresh = !(force > 0);
      return;
    }
    Vector turn = (aside1 * axes[1] + aside2 * axes[2]) / force;
    if (const double angle = std::sqrt(turn.squaredNorm()); angle > most_turn) turn *= most_turn / angle;
    normal = unit(Vector(normal + turn));
    const double next = force + along;
    force = std::abs(next) < least_left * std::abs(force) ? std::copysign(least_left * force, next) : next;
  }
  /// Adds an increment of a place, which may lead to an end.   @param length  of the rod [m]
  void slide(std::size_t side, double by, double length) noexcept {
    const double to = s[side] + by;
    s[side] = std::clamp(to, 0.0, length);
    held[side] = held[side] || to != s[side];
  }
  /// Whether a place at an end would go back.
  bool leaves_end(std::size_t side) const noexcept {
    constexpr double nothing = 1e-9;
    return held[side] && (s[side] > 0 ? -pull[side] : pull[side]) > nothing * force;
  }
  /// Goes on as from another equilibrium, so many times as far.
  void go_on(const RodPair& before, double ratio) noexcept {
    if (fresh || before.fresh) return;
    const Vector next = force * normal + ratio * (force * normal - before.force * before.normal);
    const double size = std::sqrt(next.squaredNorm());
    if (!(next.dot(normal) > size / 2)) return;
    force = size, normal = next / size;
    for (std::size_t k = 0; k < 2; ++k) s[k] += ratio * (s[k] - before.s[k]);
  }

  std::array<Vector, 3> axes;  // of look(): n first
};

}  // namespace detail

}  // namespace hapbeam
