// SPDX-License-Identifier: MIT
// A contact at any place of a beam whose mesh does not move, as a body sees it: a row of its equations, and a node within the element.
//
//   round    a circle, in space a capsule, of that reach lies on the centreline:  D = reach,  D from its centre or axis to the curve;  the place s
//            is an unknown
//   along    the place s is held so far along a direction:  n · (u, w) = d,  in space  n · r = d
//
// Unknown of both is the force λ, which pushes the beam away from the centre, or along n.  The curve of a rod is that of the element's cubic and, beside
// a contact, of what that bends of it alone: its bubble (touched_rod.hpp).
#pragma once

#include <cmath>
#include <limits>

#include <hapbeam/centreline.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// Shortest element of a beam that round-off allows [m]: it costs 12 eps (L/l)² of the force beside a support that holds w and
/// up to 4 eps (L/l)³ beside a free end, here 1e-9 and 1e-6 in double, 1e-3 and 1e-2 in float.
template <typename S>
S shortest_element(S length) noexcept {
  const S by_round_off = 100 * std::sqrt(std::numeric_limits<S>::epsilon());
  return length * (by_round_off > S(1e-3) ? by_round_off : S(1e-3));
}

/// The piece of a beam between an inner node, its tip, and the next node on one side, its root.  Its deformations are those of a unit of length, so that
/// it may be as short as it likes.
template <typename S>
struct RootedPiece {
  enum class Root { none, left, right };

  Root root = Root::none;  ///< none: not yet laid
  int element = 0;         ///< in which it is
  int next = -1;           ///< the contact that is its root, -1: a node of the mesh
  S stretch = 0;           ///< ε
  S at_root = 0;           ///< rotation of the root against the chord, over the length [1/m]
  S at_tip = 0;            ///< the same of the tip [1/m]
  S tension = 0;           ///< N [N]
};

/// What stays of a contact from one push to the next.
template <typename S, int D = 2>
struct InnerState {
  S s = 0;             ///< [m]
  S force = 0;         ///< λ [N]
  bool moves = true;   ///< whether s is sought; else it stays
  bool sharp = false;  ///< whether the curve is bent more sharply there than the circle
  RootedPiece<S> piece;
  S was = 0;               ///< the place where u, w and θ were these [m]
  Vector2<S> moved{0, 0};  ///< u, w [m]
  S theta = 0;             ///< [rad]

  int element() const noexcept { return piece.element; }
  /// It is in an element, with what was known of it there.
  void enter(int element) noexcept {
    if (piece.element != element) piece.root = RootedPiece<S>::Root::none;
    piece.element = element;
  }
  /// Another contact has its number now.
  void forget_order() noexcept {
    if (piece.next >= 0) piece.next = -2;
  }
  /// What was found of the curve there is not known any more.
  void forget() noexcept { piece = {}; }
  /// Goes on as from one state to another.
  void go_on(const InnerState& to, const InnerState& from, S ratio) noexcept {
    const auto on = [ratio](auto& value, const auto& end, const auto& start) {
      value += ratio * (end - start);
    };
    on(s, to.s, from.s), on(force, to.force, from.force);
    on(was, to.was, from.was), on(moved, to.moved, from.moved), on(theta, to.theta, from.theta);
    const auto same = [this](const InnerState& other) {
      return other.piece.root == piece.root && other.piece.element == piece.element;
    };
    if (!same(to) || !same(from)) return;
    on(piece.stretch, to.piece.stretch, from.piece.stretch),
        on(piece.tension, to.piece.tension, from.piece.tension);
    on(piece.at_root, to.piece.at_root, from.piece.at_root),
        on(piece.at_tip, to.piece.at_tip, from.piece.at_tip);
  }
  /// Another's curve, but not its place and force.
  void take_curve(const InnerState& other) noexcept {
    piece = other.piece, was = other.was, moved = other.moved, theta = other.theta;
  }
};

enum class InnerKind { round, along };

/// What contacts in the plane and in space have.
template <typename S, int D>
struct InnerRow : InnerState<S, D> {
  using Kind = InnerKind;
  using Vector = VectorOf<S, D>;

  Kind kind = Kind::round;
  Vector normal = vector_of<S, D>([](int k) {
    return S(k == D - 1);
  });                     ///< n, unit; of what is round from its centre or axis to the curve, found
  S reach = 0;            ///< [m], or d
  S curvature = 0;        ///< of what is round, for which a place is held [1/m]
  S compliance = 0;       ///< of what holds that [m/N]:  D = reach + ahead - λ compliance
  S ahead = 0;            ///< of where that has no force [m]
  S least = 0, most = 0;  ///< s stays between them [m]

  bool waits = false;                ///< s stays in the next solve
  bool rests = false;                ///< s stays, between two elements
  bool rough = false;                ///< there is friction
  Vector friction = Vector::Zero();  ///< on the beam [N]

  // Found where an element is condensed.
  /// How far its curvature makes up for that of what is round along it, 1: the distance has no minimum.
  S wraps = std::numeric_limits<S>::infinity();

  // Found where an element looks at it, or foreseen where it is brought forward.
  bool seen = false;              ///< as the curve lies now
  S gap = 0;                      ///< D - reach, or n · (u, w) - d, in space n · r - d [m]
  Vector place = Vector::Zero();  ///< of the curve [m]
  Vector tangent = vector_of<S, D>([](int k) { return S(k == 0); });  ///< of it
};

template <typename S, int D = 2>
struct InnerContact : InnerRow<S, D> {
  Vector2<S> centre{0, 0};   ///< [m]
  S side = 1;                ///< of the beam on which the circle is
  S friction_stiffness = 0;  ///< along the surface [N/m]

  /// What is led along a path [m].
  Vector2<S>& centre_or_tip() noexcept { return centre; }
  /// From there to where the circle would touch the curve as it lies.
  Vector2<S> way_to_curve() const noexcept {
    const Vector2<S> across = side * Vector2<S>(this->tangent.y(), -this->tangent.x());
    return this->place - this->reach / across.norm() * across - centre;
  }
  /// Finds the normal where place, displacement and tangent of the curve are known.   @param at  of the displacement [m]
  /// @param is_plane  out: nearer to the centre than half of the reach a plane stands for the circle, for there the direction to the centre says nothing
  /// @return D
  S look_at_circle(S at, bool& is_plane) noexcept {
    const Vector2<S>& t = this->tangent;
    const Vector2<S> off(this->moved.x() - (centre.x() - at), this->moved.y() - centre.y());
    const S distance = std::sqrt(off.squaredNorm());
    // The centre may have passed the curve.
    const bool passed = (t.x() * off.y() - t.y() * off.x()) * side > 0;
    is_plane = passed || distance < this->reach / 2;
    this->normal = is_plane ? Vector2<S>(side / std::sqrt(t.squaredNorm()) * Vector2<S>(t.y(), -t.x()))
                            : Vector2<S>(off / distance);
    return is_plane ? this->normal.dot(off) : distance;
  }
  /// How far the place has moved from where it is at rest [m].
  Vector2<S> displacement() const noexcept { return this->place - Vector2<S>(this->s, 0); }
};

/// The same of a rod.
template <typename S>
struct InnerState<S, 3> {
  using Vector = VectorOf<S, 3>;

  S s = 0;                         ///< [m]
  S force = 0;                     ///< λ [N]
  bool moves = true;               ///< whether s is sought; else it stays
  bool sharp = false;              ///< whether the curve is bent more sharply there than the capsule
  int in = 0;                      ///< element
  Vector bubble = Vector::Zero();  ///< from the cubic to the curve [m]

  int element() const noexcept { return in; }
  /// It is in an element, with what was known of it there.
  void enter(int element) noexcept { in = element; }
  /// Another contact has its number now.
  void forget_order() noexcept {}
  /// What was found of the curve there is not known any more.
  void forget() noexcept { bubble.setZero(); }
  /// Goes on as from one state to another.
  void go_on(const InnerState& to, const InnerState& from, S ratio) noexcept {
    s += ratio * (to.s - from.s), force += ratio * (to.force - from.force);
    bubble += ratio * (to.bubble - from.bubble);
  }
  /// Another's curve, but not its place and force.
  void take_curve(const InnerState& other) noexcept { bubble = other.bubble; }
};

template <typename S>
struct InnerContact<S, 3> : InnerRow<S, 3> {
  using typename InnerRow<S, 3>::Vector;
  using Matrix = Eigen::Matrix<S, 3, 3>;

  Shaft<S> axis;                 ///< of the capsule
  Vector side = Vector::Zero();  ///< about from the curve to the axis, unit: from where the capsule has come
  bool seeks = true;             ///< where the curve is tangent, first; not beside another place of its body
  bool stays = false;            ///< s stays until an equilibrium is found,
  S off = 0;                     ///< and is so far from where the curve is tangent then [m]
  Matrix friction_tangent = Matrix::Zero();  ///< across the normal [N/m]

  /// What is led along a path [m].
  Vector& centre_or_tip() noexcept { return axis.tip; }
  /// From there to where the capsule would touch the curve as it lies.
  Vector way_to_curve() const noexcept {
    return this->place - this->reach * this->normal - axis.at(axis.nearest(this->place));
  }
  /// Where the place is [m].
  Vector displacement() const noexcept { return this->place; }
};

}  // namespace hapbeam::detail
