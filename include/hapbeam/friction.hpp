// SPDX-License-Identifier: MIT
// Coulomb friction between avatar and beam, and the state of a touch with friction.
//
// The avatar does not turn.  Slip is how far it has gone along the surface of the beam beyond the point of the beam that it touches; a
// round avatar that rolls on the beam does not slip.  Friction acts at the centreline.
//
// An Obstacle (force_model.hpp) takes it to a push, and brings it back as it is then.  Without an answer friction begins anew.
//
// A plain value.  No allocation, noexcept, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/check.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

/// Coefficients of friction: tangential over normal force.  None by default.
struct Friction {
  double sticking = 0;  ///< the contact begins to slide beyond it
  double sliding = 0;   ///< while it slides, not larger

  constexpr Friction(double both = 0) noexcept : sticking(both), sliding(both) {}
  constexpr Friction(double when_sticking, double when_sliding) noexcept
      : sticking(when_sticking), sliding(when_sliding) {}

  bool none() const noexcept { return !(sticking > 0); }
  /// Beyond it a contact jams in nearly every bend.
  static constexpr double most = 2;
  /// @throws std::invalid_argument unless 0 <= sliding <= sticking <= most
  void check() const {
    if (!(sticking >= 0 && sticking <= most)) detail::reject("friction sticking", sticking, "", "0 to 2");
    if (!(sliding >= 0 && sliding <= sticking))
      detail::reject("friction sliding", sliding, "", "0 to that of sticking");
  }
};

namespace detail {

/// Where a beam and an avatar touch: on the beam, and on what touches it.
template <typename Scalar, int D>
struct FrictionPlace {
  using Vector = VectorOf<Scalar, D>;
  Scalar s = 0;                                            ///< [m] arc position of a node of the beam
  Scalar ahead = 0;                                        ///< [m] from there, along the stretched beam
  Vector normal = Vector::Zero(), along = Vector::Zero();  ///< unit; along the beam
  Scalar place = 0;                                        ///< [m] on the avatar's axis
  Vector axis = Vector::Zero();                            ///< its direction
  Vector off = Vector::Zero();                             ///< [m] o; in the plane of a beam none

  /// What lies across the normal of another place, turned with it to this one.
  Vector carried(const Vector& v, const FrictionPlace& from) const noexcept {
    if constexpr (D == 2) return v.dot(from.along) * along;
    else return carry<Scalar>(v, from.normal, normal);
  }
  /// How far the surfaces slip from another place to this one, across the normal [m]:
  ///
  ///   t Δs + R Δn - a Δλ - Δo      s, λ: lengths along beam, as it is stretched, and avatar's axis, t, a: their directions, n: normal
  ///
  /// R is the reach, from the avatar's axis to the centreline, or from o off that.
  /// @param stretch  |dr/ds| of the beam   @param reach  [m]
  Vector slip(const FrictionPlace& from, Scalar stretch, Scalar reach) const noexcept {
    const Vector &m = from.normal, &n = normal;
    const Scalar moved = stretch * (s - from.s) + ahead - from.ahead, cosine = m.dot(n);
    if (!(cosine > 0)) return Vector::Zero();  // touched from elsewhere
    if constexpr (D == 2) {
      const Scalar turned = std::atan2(m.x() * n.y() - m.y() * n.x(), cosine);
      return moved * along + reach * turned * Vector(-n.y(), n.x());
    } else {
      const Vector turn = n - m, middle = unit<Scalar>(m + n);
      const Scalar half = std::sqrt(turn.squaredNorm()) / 2;
      Vector v = moved / 2 * (from.along + along) - (place - from.place) / 2 * (from.axis + axis) -
                 (off - from.off) +
                 (half > 0 ? reach * std::asin((std::min)(half, Scalar(1))) / half : reach) * turn;
      v -= middle * middle.dot(v);
      return carry<Scalar>(v, middle, n);
    }
  }
};

}  // namespace detail

/// The contact with friction of one touch, and where that was last.
/// @tparam D  of the space in which the beam bends: 2 | 3
template <typename Scalar, int D>
struct FrictionState : detail::FrictionPlace<Scalar, D> {
  using Vector = VectorOf<Scalar, D>;

  // Of the touch.
  Scalar sticking = 0, sliding = 0;                            ///< coefficients
  Scalar stiffness = std::numeric_limits<Scalar>::infinity();  ///< [N/m] of the avatar's skin
  Scalar damping = 0;  ///< [N/m] what its damping adds, N·s/m over the tick

  // Of its last contact.
  bool known = false;             ///< there is one
  bool slides = false;            ///< it slid
  bool settled = true;            ///< its force is Coulomb's, to a tenth of its bound at worst
  Vector skin = Vector::Zero();   ///< [m] how far the skin is sheared
  Scalar slip = 0;                ///< [m] how far it would be sheared if nothing slid
  Vector force = Vector::Zero();  ///< [N] of friction on the beam
  Scalar rise = 0;                ///< [N] of its bound in that tick, while it slid
  Scalar gain = 0;                ///< change of the normal force by a tangential one, as it was
  Scalar dissipated = 0;          ///< [J] since the touch began

  void take(const Friction& coefficients) noexcept {
    sticking = static_cast<Scalar>(coefficients.sticking),
    sliding = static_cast<Scalar>(coefficients.sliding);
    // It is not looked at while it has none.
    if (coefficients.none()) let_go();
  }
  /// As of the touch.   @param stiffness, damping  [N/m]
  void soften(Scalar by_stiffness, Scalar by_damping) noexcept {
    stiffness = by_stiffness, damping = by_damping;
  }
  bool rough() const noexcept { return sticking > 0; }
  /// A contact begins; what the touch has dissipated stays.
  void begin() noexcept {
    let_go();
    gain = 0;
  }
  /// What is felt of it, no more than its share of a normal force [N].   @param felt  in and out, of a TouchResult or a TouchPlace
  template <class Felt>
  void rub(Scalar normal_force, Felt& felt) const noexcept {
    const Scalar most = sticking * normal_force, size = std::sqrt(force.squaredNorm());
    felt.friction = size > most ? Vector(force * (-most / size)) : Vector(-force);
    felt.force += felt.friction;
    felt.sliding = slides;
  }
  /// Nothing is left of its last contact.
  void let_go() noexcept {
    known = slides = false;
    settled = true;
    skin.setZero(), force.setZero();
  }
};

}  // namespace hapbeam
