// SPDX-License-Identifier: MIT
// A contact at any place of a rod whose mesh does not move, in the words of inner_contact.hpp, which has one of a beam in the plane.
//
//   round    a capsule of that reach lies on the centreline:  D = reach,  D from its axis to the curve;  the place s is an unknown
//   along    the place s is held so far along a direction:  n · r = d
//
// The curve is that of the element's cubic and, beside a contact, of what that bends of it alone: its bubble (touched_rod.hpp).
#pragma once

#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// What stays of a contact from one push to the next.
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
