// SPDX-License-Identifier: MIT
// A contact of a rod with another, with itself or with a rigid body: one force and two places, unknowns of the equations of both.  Or a ball joint of
// two places that stay.
//
//   L = Σ V - f · w + h(f) - ½ f · C(s₁, s₂) f,   w = r₁(s₁) - r₂(s₂)       f = λ n, n to rod 1; with friction f = λ n + t
//   h(f) = R |f| + b |f across the axis of a tube|,  b = ±its radius, from outside and from inside;  of a plane f · (R n + o), o on it;  of a joint f · o,
//   o what is left of w
//
// Stationary by f where w + C f = ∂h/∂f, which is R n but in a tube: the true curves, which C bends off what nodes hold, are R apart.  By a place where the
// true curve is across n.  Where the sections bend alike about all axes this is  Σ V - λ (|w| - R) - ½ λ² c.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/world/pair_friction.hpp>

namespace hapbeam {

/// Where a rod touches another, itself or a body.
struct RodContact {
  std::array<int, 2> rod;        ///< 0-based numbers in the World: rods, and rods() + that of a body
  std::array<double, 2> s;       ///< [m] arc positions; along the axis of a body
  VectorOf<double, 3> force;     ///< [N] on rod[0]
  VectorOf<double, 3> friction;  ///< [N] its part across the line that joins both places, which is the rest
  bool sliding;                  ///< whether they slide, where there is friction
  std::array<VectorOf<double, 3>, 2> at;  ///< [m] points of the centrelines; of the surface of a body
};

namespace detail {

struct RodPair {
  using Vector = VectorOf<double, 3>;
  enum class Kind { contact, joint };

  Kind kind = Kind::contact;
  std::array<int, 2> rod{};
  std::array<double, 2> s{};
  double reach = 0;                 // R, of both radii [m]
  double ring = 0;                  // b [m]
  double curve = 1;                 // radius of what r₁ goes round, in reaches; of a plane large
  Vector axis = Vector::Zero();     // of a tube
  Vector on = Vector::Zero();       // o, of a plane across n [m]
  double force = 0;                 // λ [N]
  Vector normal = Vector::UnitZ();  // n
  /// New: its direction and its places stay until it presses.
  bool fresh = true;
  std::array<bool, 2> held{};    // at an end of its rod, where the place stays
  std::array<double, 2> pull{};  // ∂L/∂s of the last equations [N]
  std::array<double, 2> met{};   // s where the step began
  std::array<bool, 2> met_held{};
  int pulls = 0;  // how often it would have pulled in it
  PairFriction friction;

  /// From the core of a tube, which is around its axis, or else from r₂, along n [m].
  double distance(const Vector& w) const noexcept {
    return normal.dot(w) - (ring != 0 ? ring * around().length : 0);
  }
  /// How ∂h/∂f goes as n turns, along the two axes across n [m].
  Eigen::Matrix<double, 2, 2> bends() const noexcept {
    Eigen::Matrix<double, 2, 2> bends = curve * reach * Eigen::Matrix<double, 2, 2>::Identity();
    if (ring == 0) return bends;
    const Around now = around();
    const Vector turns = cross3(axis, now.way);
    for (std::size_t c = 1; c < 3; ++c)
      for (std::size_t d = 1; d < 3; ++d)
        bends(int(c) - 1, int(d) - 1) += ring / now.length * axes[c].dot(turns) * axes[d].dot(turns);
    return bends;
  }
  /// ∂h/∂f along an axis [m].
  double offset(std::size_t c) const noexcept {
    return (c == 0 ? reach : 0) + (ring != 0 ? ring * axes[c].dot(around().way) : axes[c].dot(on));
  }
  /// ∂h/∂f less R n [m].
  Vector off() const noexcept { return ring != 0 ? Vector(ring * around().way) : on; }
  /// Eigenvalues of its own that are negative in a stable equilibrium: of λ and of two places of least distance, and from inside of a turn of n; of a joint
  /// all.
  int negative() const noexcept {
    return kind == Kind::joint ? 5 : rough() ? 3 + friction.negative() : ring < 0 ? 4 : 3;
  }
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
  /// Adds an increment of f along the axes.  One that would pull is as new, back where it began, and the next time its first place stays: where a rod lies
  /// along what it touches, all places are alike for a force of nothing.
  void push(double along, double aside1, double aside2) noexcept {
    constexpr double most_turn = 0.3, least_left = 1e-3;
    const double next = force + along;
    if (fresh || !(next > least_left * force)) {
      if (!fresh) s = met, held = met_held, held[0] = held[0] || pulls++ > 3;
      force = next, fresh = !(next > 0);
      return;
    }
    Vector aside = aside1 * axes[1] + aside2 * axes[2];
    if (const double angle = std::sqrt(aside.squaredNorm()) / next; angle > most_turn)
      aside *= most_turn / angle;
    const Vector f = next * normal + aside;
    force = std::sqrt(f.squaredNorm()), normal = f / force;
  }
  /// The same with friction, which may pull on the way to an equilibrium.   @param by  δλ, and δn across n
  void rub(const std::array<double, 3>& by) noexcept {
    constexpr double most_turn = 0.3, least_left = 1e-3;
    Vector turn = by[1] * axes[1] + by[2] * axes[2];
    if (curve > 1) on += curve * reach * turn, turn.setZero();
    if (const double angle = std::sqrt(turn.squaredNorm()); angle > most_turn) turn *= most_turn / angle;
    normal = unit(Vector(normal + turn));
    const double next = force + by[0];
    force = std::abs(next) < least_left * std::abs(force) ? std::copysign(least_left * force, next) : next;
  }
  /// Of a joint, whose force may be any.
  void pull_by(const Vector& by) noexcept {
    const Vector f = force * normal + by;
    force = std::sqrt(f.squaredNorm());
    if (force > 0) normal = f / force;
  }
  /// A body has turned.   @param turn  (vector &)
  template <class Turn>
  void carry(Turn&& turn) noexcept {
    turn(on), friction.carry(turn);
  }
  /// A step begins here.
  void mark() noexcept { met = s, met_held = held, pulls = 0; }
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
    force = size, normal = next / size, on += ratio * friction.gone();
    for (std::size_t k = 0; k < 2; ++k) s[k] += ratio * (s[k] - before.s[k]);
  }

  std::array<Vector, 3> axes{Vector::Zero(), Vector::Zero(), Vector::Zero()};  // of look(): n first

 private:
  /// What n has across the axis of a tube.
  struct Around {
    double length;
    Vector way;
  };
  Around around() const noexcept {
    constexpr double least = 1e-9;
    const Vector part = normal - axis.dot(normal) * axis;
    const double length = (std::max)(std::sqrt(part.squaredNorm()), least);
    return {length, part / length};
  }
};

}  // namespace detail

}  // namespace hapbeam
