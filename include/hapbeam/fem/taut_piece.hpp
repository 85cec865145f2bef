// SPDX-License-Identifier: MIT
// The part of a straight, unloaded beam between one of its ends and the contact, under a tension, in closed form.
//
// ξ is 0 at its end and 1 at the contact; on the right rotations are mirrored.  A hinge is the middle of an antisymmetric piece of twice the
// length, an end that is guided that of a symmetric one; an end that is free stays straight.
// Lengths are in units of the beam's L, forces of EI/L², so that tension is ν = N L²/EI.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <limits>

#include <hapbeam/element/tension_stiffness.hpp>
#include <hapbeam/element/tensioned_curve.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam::detail {

/// Symmetric stiffness at the contact in w and θ there, or a derivative of it.
template <typename S>
struct ContactStiffness {
  S ww, wt, tt;
};

template <typename S>
class TautPiece {
 public:
  explicit TautPiece(Support support) noexcept
      : end_(fixes_w(support)       ? fixes_theta(support) ? End::clamped : End::hinged
             : fixes_theta(support) ? End::guided
                                    : End::free) {}

  /// @param length  [L], 0 beside an end that yields
  void set(S length) noexcept {
    length_ = (std::max)(length, std::numeric_limits<S>::epsilon());
    inverse_ = 1 / length_;
  }
  S length() const noexcept { return length_; }

  /// The stiffness, its determinant, and its first two derivatives by the tension.  All that is added is positive.
  struct Stiffness {
    ContactStiffness<S> k;
    S determinant;
    ContactStiffness<S> k1, k2;
  };
  Stiffness stiffness(S tension) const noexcept {
    const S l = length_, i = inverse_, q = tension * l * l;
    if (end_ == End::free) return {{0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}};
    const TensionStiffness<S> f = tension_stiffness(end_ == End::clamped ? q : 4 * q);
    if (end_ == End::guided)
      return {{0, 0, f.A() / 2 * i}, 0, {0, 0, 2 * f.a1 * l}, {0, 0, 8 * f.a2 * l * l * l}};
    // In (w, lθ): [2 B + q, B; B, (A + B)/2], and [C + q, C; C, C] with C = B(4q)/2 where it is hinged.
    S rise = f.B() / 2, turn = rise, det = q * rise, rise1 = 2 * f.b1, turn1 = rise1, rise2 = 8 * f.b2,
      turn2 = rise2, more = rise, more1 = rise1, more2 = rise2;
    if (end_ == End::clamped) {
      const S A = f.A(), B = f.B();
      rise = B, rise1 = f.b1, rise2 = f.b2, more = 2 * B, more1 = 2 * f.b1, more2 = 2 * f.b2;
      turn = (A + B) / 2, turn1 = (f.a1 + f.b1) / 2, turn2 = (f.a2 + f.b2) / 2;
      det = A * B + q * turn;
    }
    const S ii = i * i, ll = l * l;
    return {{(more + q) * ii * i, rise * ii, turn * i},
            det * ii * ii,
            {(more1 + 1) * i, rise1, turn1 * l},
            {more2 * l, rise2 * ll, turn2 * ll * l}};
  }

  /// The curve with w and θ at the contact, θ turned about on the right.
  void bend(S tension, S w, S theta) noexcept {
    const S q = tension * length_ * length_, turn = length_ * theta;
    mirrored_ = end_ == End::hinged || end_ == End::guided;
    switch (end_) {
      case End::clamped: curve_ = {q, w, -turn / 2, w + turn / 2}; break;
      case End::hinged: curve_ = {4 * q, 2 * w, 0, 2 * (w + turn)}; break;
      case End::guided: curve_ = {4 * q, 0, -2 * turn, 0}; break;
      case End::free: curve_ = {0, -turn, 0, 0}; break;
    }
    contact_ = w;
    start_ = mirrored_ ? curve_.middle().square : S(0);
    top_ = curve_.end().rise;
  }
  /// A place of the curve, all [L].
  struct At {
    S w, slope;     ///< away from the end
    S shortening;   ///< ½ ∫w'² from the end on
    S bend, shear;  ///< w'' [1/L], w''' [1/L²], away from the end
  };
  /// @param distance  [L] from the end
  At at(S distance) const noexcept {
    const S x = distance * inverse_;
    return scaled(curve_.at(mirrored_ ? (1 + x) / 2 : x));
  }
  S shortening() const noexcept { return scaled(curve_.end()).shortening; }
  /// Calls visit(j, At) at so many places, the first at the end.  @param spacing  [L]   @param power  as of TensionedCurve
  template <class Power, class Visit>
  [[gnu::always_inline]] void visit(int count, S spacing, Power&& power, Visit&& visit) const noexcept {
    curve_.visit(count, mirrored_, spacing * inverse_ * (mirrored_ ? S(0.5) : S(1)), power,
                 [&](int j, const typename TensionedCurve<S>::At& c) { visit(j, scaled(c)); });
  }

 private:
  enum class End { clamped, hinged, guided, free };

  At scaled(const typename TensionedCurve<S>::At& c) const noexcept {
    const S i = mirrored_ ? inverse_ / 2 : inverse_, ii = i * i;
    return {contact_ + (c.rise - top_), c.slope * i, (c.square - start_) * i / 2, c.bend * ii,
            c.shear * ii * i};
  }

  End end_;
  bool mirrored_ = false;
  S length_ = 1, inverse_ = 1;
  TensionedCurve<S> curve_{0, 0, 0, 0};
  S contact_ = 0, start_ = 0, top_ = 0;
};

}  // namespace hapbeam::detail
