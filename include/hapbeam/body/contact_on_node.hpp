// SPDX-License-Identifier: MIT
// A contact that acts on a node of a beam, or so far from it along an arc with the curvature that the beam has there.
//
// D of a circle is that of the foot of its centre: with D(s) along the curve, D' = n · r', D'' = |t|²/D + n · r'',
//
//   D* = D - D'²/2D'',     ∂D* = ∂D - D' ∂D'/D'',     ∂²D* = ∂²D - ∂D' ∂D'ᵀ/D''         ∂: by u, w, θ of the node
//
// so that the place s needs no unknown: it goes to that foot, by -(D' + ∂D' Δ)/D''.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/angle.hpp>
#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/centreline.hpp>

namespace hapbeam::detail {

/// How the gap of a contact changes with u, w, θ of its node.
template <typename S>
struct GapChange {
  VectorOf<S, 3> by;
  Eigen::Matrix<S, 3, 3> twice;
  VectorOf<S, 3> slides;  ///< of its place along the surface
};

template <bool Turns, typename S>
struct ContactOnNode {
  using Vector = Vector2<S>;
  using Contact = InnerContact<S>;

  int node = 0;
  S arm = 0;                                   ///< from it [m]
  S slope = 0, bend = 1;                       ///< D' [-], D'' [1/m]
  VectorOf<S, 3> by = VectorOf<S, 3>::Zero();  ///< ∂D'

  /// Where a contact is.   @param curvature  of the arc, to its left [1/m]   @param most  which its place goes [m]
  GapChange<S> look(Contact& contact, const CentrelineNode<S>& at, S curvature, S most) noexcept {
    const S bow = curvature * arm * arm / 2, theta = at.theta - curvature * arm;
    const Vector along = tangent_of(at.theta), left = left_of(along);
    contact.was = at.s + arm;
    contact.moved = Vector(at.u, at.w) + arm * (along - Vector(1, 0)) + bow * left;
    contact.theta = theta;
    contact.place = Vector(contact.was, 0) + contact.moved;
    contact.tangent = tangent_of(theta);

    const Vector turns = Turns ? Vector(bow * along - arm * left) : Vector(0, -arm),
                 turns_twice = Turns ? Vector(-bow * left - arm * along) : Vector(0, 0);
    Eigen::Matrix<S, 2, 3> J;
    J << 1, 0, turns.x(), 0, 1, turns.y();
    GapChange<S> gap;
    const bool round = contact.kind == Contact::Kind::round;
    bool is_plane = false;
    const S distance =
        round ? contact.look_at_circle(contact.was, is_plane) : contact.normal.dot(contact.moved);
    contact.gap = distance - contact.reach;
    const Vector n = contact.normal, t(-n.y(), n.x());
    gap.by = J.transpose() * n, gap.slides = J.transpose() * t;
    gap.twice.setZero();
    gap.twice(2, 2) = n.dot(turns_twice);
    if (!round) return gap;
    if (is_plane) {
      slope = contact.tangent.dot(contact.place - contact.centre) / contact.tangent.squaredNorm();
      by.setZero(), bend = 1;
      return gap;
    }
    gap.twice += gap.slides * gap.slides.transpose() / distance;
    if (!contact.moves) return gap;
    const S across = t.dot(contact.tangent), turn = n.dot(left_of(contact.tangent));
    slope = n.dot(contact.tangent), by = across / distance * gap.slides;
    by[2] -= turn;
    // Where the curve is as sharp as the circle, the distance has no minimum.
    bend = across * across / distance + curvature * turn;
    if (!(bend * distance > blunt)) bend = blunt / distance;
    const S way = goes(VectorOf<S, 3>::Zero(), most);
    contact.gap += way * (slope + way * bend / 2);
    gap.by += way * by, gap.twice -= by * by.transpose() / bend;
    return gap;
  }
  /// How far its place goes where the node is moved [m].
  S goes(const VectorOf<S, 3>& moved, S most) const noexcept {
    return std::clamp(S(-(slope + by.dot(moved)) / bend), -most, most);
  }

 private:
  static constexpr S blunt = S(0.05);  // least D'', of that of a straight curve

  static Vector tangent_of(S theta) noexcept { return Turns ? direction(S(-theta)) : Vector(1, -theta); }
  static Vector left_of(const Vector& tangent) noexcept {
    return Turns ? Vector(-tangent.y(), tangent.x()) : Vector(0, 1);
  }
};

}  // namespace hapbeam::detail
