// SPDX-License-Identifier: MIT
// A contact of a rod with another, with itself or with a rigid body: one force and two places, unknowns of the equations of both.  Or a joint of
// two places that stay, or of two directions there, whose force is a moment (joint.hpp).
//
//   L = Σ V - f · w + h(f) - ½ f · C(s₁, s₂) f,   w = r₁(s₁) - r₂(s₂)       f = λ n, n to rod 1; with friction f = λ n + t
//   h(f) = R |f| of rods;  on a body f · (R n + o) where it touches, o on its core, and ∂²h/∂f² = H/λ, H its radii of curvature with R;  of a joint f · o, o what is left of w
//
// Stationary by f where w + C f = ∂h/∂f: the true curves, which C bends off what nodes hold, are R apart.  A body tells n, o and H for where the rod is.  By a place where the
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
  std::array<double, 2> s;       ///< [m] arc positions; on a body 0
  VectorOf<double, 3> force;     ///< [N] on rod[0]
  VectorOf<double, 3> friction;  ///< [N] its part across the line that joins both places, which is the rest
  bool sliding;                  ///< whether they slide, where there is friction
  /// [m] a point of the first centreline, and from there along the normal where the second one is, or the surface of a body
  std::array<VectorOf<double, 3>, 2> at;
};

namespace detail {

struct RodPair {
  using Vector = VectorOf<double, 3>;
  using Bends = Eigen::Matrix<double, 2, 2>;
  enum class Kind { contact, place, rotation };

  Kind kind = Kind::contact;
  std::array<int, 2> rod{};
  std::array<double, 2> s{};
  double reach = 0;                 // R, of both radii [m]
  Vector on = Vector::Zero();       // o [m]; of rotations [rad]
  Bends bends = Bends::Zero();      // H, along the two axes across n [m]
  double force = 0;                 // λ [N]
  Vector normal = Vector::UnitZ();  // n
  Vector axis = Vector::Zero();     // of a hinge, about which there is no moment
  double lent = 0;                  // κ of a joint [N/m], [N·m]
  int forces = 3;                   // along the axes; of a hinge 2
  /// New: its direction and its places stay until it presses.
  bool fresh = true;
  std::array<bool, 2> held{};    // at an end of its rod, where the place stays
  std::array<double, 2> pull{};  // ∂L/∂s of the last equations [N]
  std::array<double, 2> met{};   // s where the step began
  std::array<bool, 2> met_held{};
  int pulls = 0;   // how often it would have pulled in it
  int stages = 0;  // of steps of time that it has lasted
  PairFriction friction;

  /// From the core of a body, or else from r₂, along n [m].
  double distance(const Vector& w) const noexcept { return normal.dot(w - on); }
  /// ∂h/∂f along an axis [m].
  double offset(std::size_t c) const noexcept { return (c == 0 ? reach : 0) + axes[c].dot(on); }
  /// Eigenvalues of its own that are negative in a stable equilibrium: of λ, of two places of least distance, and of what is hollow; of a joint all.
  int negative() const noexcept {
    return kind != Kind::contact ? 5
                                 : 3 + (rough() ? friction.negative()
                                        : fresh ? 0
                                                : PairFriction::negative_of(bends));
  }
  /// Whether friction acts.
  bool rough() const noexcept { return !fresh && friction.acts(); }

  /// Whether a rod yields here to the other, too, where both touch one element.  In a row along a tube each is as if alone.
  bool yields_to(const RodPair& other) const noexcept {
    return &other != this && kind == Kind::contact && other.kind == Kind::contact &&
           !(held[0] && other.held[0]);
  }

  /// Two directions across the normal.
  void look() noexcept { axes[0] = normal, axes[1] = beside(normal), axes[2] = cross3(normal, axes[1]); }
  /// Of a hinge: two across its axis, along which there is nothing.
  void look_along(const Vector& e) noexcept {
    forces = 2, axis = axes[2] = e, axes[0] = beside(e), axes[1] = cross3(e, axes[0]);
    pull_by(-force * normal.dot(e) * e);
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
    turn(aside / next);
    force = std::sqrt(next * next + aside.squaredNorm());
  }
  /// The same with friction, which may pull on the way to an equilibrium.   @param by  δλ, and δn across n
  void rub(const std::array<double, 3>& by) noexcept {
    constexpr double most_turn = 0.3, least_left = 1e-3;
    Vector turn = by[1] * axes[1] + by[2] * axes[2];
    if (const double angle = std::sqrt(turn.squaredNorm()); angle > most_turn) turn *= most_turn / angle;
    this->turn(turn);
    const double next = force + by[0];
    force = std::abs(next) < least_left * std::abs(force) ? std::copysign(least_left * force, next) : next;
  }
  /// Turns n by so much across it, and o along with what it touches.
  void turn(const Vector& by) noexcept {
    const Bends moves = bends - reach * Bends::Identity();
    const double by1 = by.dot(axes[1]), by2 = by.dot(axes[2]);
    on +=
        (moves(0, 0) * by1 + moves(0, 1) * by2) * axes[1] + (moves(1, 0) * by1 + moves(1, 1) * by2) * axes[2];
    normal = unit(Vector(normal + by));
  }
  /// A body has turned.   @param turn  (vector &)
  template <class Turn>
  void carry(Turn&& turn) noexcept {
    turn(on), friction.carry(turn);
  }
  /// Of a joint, whose force may be any.
  void pull_by(const Vector& by) noexcept {
    const Vector f = force * normal + by;
    force = std::sqrt(f.squaredNorm());
    if (force > 0) normal = f / force;
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
};

}  // namespace detail

}  // namespace hapbeam
