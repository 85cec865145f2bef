// SPDX-License-Identifier: MIT
// What a section of a beam carries, from its elements: equilibrium of a piece that is cut out.
//
// The forces of an element on its nodes, less its dead loads, are those of the neighbours.  From its left node the moment goes on
// as  M(s) = M1 + F_w Δx - F_u Δw,  F the force, and (Δx, Δw) along the bent centreline; what that misses of the right node's is
// shared out.  At nodes this is as accurate as the force of a press, where second derivatives of the shape are of second order.
//
// A distributed load is nodal forces of the uniform mesh (loads.hpp).  Between two of those it has, at ξ of their distance h,
//
//   F(ξ) = F - q h (ξ - ½),     M(ξ) = M - q h² (1/12 - ½ ξ (1 - ξ))
//
// with F, M the cuts of those nodal forces: their arms are in M, and bend it by what the last term takes off.
// Real-time: noexcept, no allocation, O(loads on the element).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/loads.hpp>
#include <hapbeam/internal_forces.hpp>

namespace hapbeam::detail {

/// A cut on its way along the beam.
template <class Element, typename Scalar>
struct BeamCut {
  static constexpr bool turns = any_rotation<Element>,
                        feels_slope = turns || MembraneFeelsSlope<Element>::value;

  Vector2<Scalar> force;
  Scalar moment;
  Scalar s;
  Displacement<Scalar> at;

  void go(Scalar to, const Displacement<Scalar>& place) noexcept {
    moment += (to - s + (turns ? place.u - at.u : Scalar(0))) * force.y();
    if (feels_slope) moment -= (place.w - at.w) * force.x();
    s = to;
    at = place;
  }
  /// Past a load that stands where the cut is.
  void pass(const PointForce<Scalar>& load, Scalar lambda) noexcept {
    using std::cos;
    using std::sin;
    Scalar couple = load.moment;
    if (turns) couple -= load.axial_arm * sin(at.theta) + load.transverse_arm * cos(at.theta);
    else couple -= (feels_slope ? load.axial_arm * at.theta : Scalar(0)) + load.transverse_arm;
    force -= lambda * Vector2<Scalar>(load.axial, load.transverse);
    moment -= lambda * couple;
  }
  /// What the even loads do that the nodal forces of a cell, of length h, do not.   @param x  ξ   @param q  along u and w [N/m]
  void spread(const Vector2<Scalar>& q, Scalar x, Scalar h) noexcept {
    const Vector2<Scalar> tangent = turns         ? direction(-at.theta)
                                    : feels_slope ? Vector2<Scalar>(1, -at.theta)
                                                  : Vector2<Scalar>(1, 0);
    force -= h * (x - Scalar(0.5)) * q;
    moment -= h * h * (S(1. / 12) - x * (1 - x) / 2) * (tangent.x() * q.y() - tangent.y() * q.x());
  }
  /// @param EA [N]   @param EI [N·m²]   @param thickness [m]
  InternalForces<Scalar> in_section(Scalar EA, Scalar EI, Scalar thickness) const noexcept {
    using std::abs;
    const Vector2<Scalar> t = turns ? direction(-at.theta) : Vector2<Scalar>(1, 0);
    const Scalar normal = force.dot(t), slope = !turns && feels_slope ? at.theta * force.x() : Scalar(0),
                 shear = t.x() * force.y() - t.y() * force.x() + slope, strain = normal / EA;
    return {normal, shear, moment, strain, abs(strain) + abs(moment) / EI * thickness / 2};
  }

 private:
  using S = Scalar;
};

/// The cut at s in element e.   @param begin  of what is cut: at a load there, what is on its right [m]
/// @param r  forces of that element on its nodes, less its dead loads   @param loads  λ times them
/// @param place  s -> Displacement in that element   @param contacts  within it, count of them in order of s
template <class Element, typename Scalar, class Place>
BeamCut<Element, Scalar> cut_beam(const Centreline<Scalar>& line, int e, Scalar begin, Scalar at,
                                  const Vector6<Scalar>& r, const DeadLoads<Scalar>* loads, Scalar lambda,
                                  Place&& place, const PointForce<Scalar>* contacts, int count) noexcept {
  const CentrelineNode<Scalar>&a = line[e], &b = line[e + 1];
  const Scalar s = (std::min)((std::max)(at, a.s), b.s);
  BeamCut<Element, Scalar> cut{{-r[0], -r[1]}, -r[2], a.s, {a.u, a.w, a.theta}}, end = cut;
  const auto before_cut = [&](Scalar x) { return x < s || (x == s && s == begin); };
  const auto meet = [&](const PointForce<Scalar>& load, Scalar share) {
    const Displacement<Scalar> there = place(load.s);
    end.go(load.s, there);
    end.pass(load, share);
    if (!before_cut(load.s)) return;
    cut.go(load.s, there);
    cut.pass(load, share);
  };
  const auto meet_contacts = [&](Scalar until) {
    for (; count > 0 && contacts->s < until; ++contacts, --count) meet(*contacts, 1);
  };
  if (loads)
    loads->visit(a.s, b.s, e + 1 == line.segments(), [&](const PointForce<Scalar>& load) {
      meet_contacts(load.s);
      meet(load, lambda);
    });
  meet_contacts(std::numeric_limits<Scalar>::infinity());
  end.go(b.s, {b.u, b.w, b.theta});
  cut.go(s, place(s));
  cut.moment += (s - a.s) / (b.s - a.s) * (r[5] - end.moment);
  if (loads)
    loads->visit_cell(before_cut, [&](const Vector2<Scalar>& q, Scalar start, Scalar length) {
      cut.spread(lambda * q, (s - start) / length, length);
    });
  return cut;
}

}  // namespace hapbeam::detail
