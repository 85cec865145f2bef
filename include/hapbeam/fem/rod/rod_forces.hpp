// SPDX-License-Identifier: MIT
// What a section of a rod carries, from its elements: equilibrium of a piece that is cut out.
//
// The forces of an element on its nodes, less its dead loads, are those of the neighbours:  F and  M = r' × g + φ t,  with g and φ
// those on r' and on the twist.  From the left node the moment goes on as  M(s) = M1 - (r(s) - r1) × F;  what that misses of the
// right node's is shared out.
// A distributed load is nodal forces of the uniform mesh; the cuts of those are turned into its own as beam_forces.hpp says.
// Real-time: noexcept, no allocation, O(1), and O(dead loads and foundations) where there are some.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/internal_forces.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// How far a rod's surface is from its axis, over the radii of gyration √(EI/EA): the same along a taper.
template <typename Scalar>
struct RodSurface {
  Scalar along2 = 0, along1 = 0;  // what curvature about d1 strains, and about d2
  bool corners = false;           // where both add up

  explicit RodSurface(const Rod& rod) noexcept : corners(rod.outline().corners) {
    const RodStiffness& k = rod.stiffness();
    along2 = static_cast<Scalar>(rod.outline().height / 2 / std::sqrt(k.bending1 / k.axial));
    along1 = static_cast<Scalar>(rod.outline().width / 2 / std::sqrt(k.bending2 / k.axial));
  }
  /// Largest strain of bending.
  template <class Stiffness>
  Scalar strain(Scalar moment1, Scalar moment2, const Stiffness& k) const noexcept {
    using std::abs;
    using std::sqrt;
    const Scalar a = along2 * abs(moment1) / sqrt(static_cast<Scalar>(k.bending1 * k.axial)),
                 b = along1 * abs(moment2) / sqrt(static_cast<Scalar>(k.bending2 * k.axial));
    return corners ? a + b : sqrt(a * a + b * b);
  }
};

/// A cut on its way along the rod.
template <typename Scalar>
struct RodCut {
  using Vector3 = VectorOf<Scalar, 3>;
  Vector3 force, moment, r;

  void go(const Vector3& to) noexcept {
    moment -= cross3<Scalar>(to - r, force);
    r = to;
  }
  /// Past a force on the rod before the cut.   @param at  where it stands
  void pass(const Vector3& load, const Vector3& at) noexcept {
    force -= load;
    moment += cross3<Scalar>(r - at, load);
  }
  /// What an even load does that the nodal forces of a cell, of length h, do not.   @param q [N/m]   @param x  ξ
  void spread(const Vector3& q, const Vector3& tangent, Scalar x, Scalar h) noexcept {
    force -= h * (x - Scalar(0.5)) * q;
    moment += h * h * (Scalar(1. / 12) - x * (1 - x) / 2) * cross3<Scalar>(tangent, q);
  }
  template <class Stiffness>
  InternalForces<Scalar, 3> in_section(const Vector3& d1, const Vector3& d3, const Stiffness& k,
                                       const RodSurface<Scalar>& surface) const noexcept {
    using std::abs;
    const Vector3 d2 = cross3<Scalar>(d3, d1);
    const Scalar normal = force.dot(d3), m1 = moment.dot(d1), m2 = moment.dot(d2),
                 strain = normal / static_cast<Scalar>(k.axial);
    return {normal, force.dot(d1),  force.dot(d2), m1,
            m2,     moment.dot(d3), strain,        abs(strain) + surface.strain(m1, m2, k)};
  }
};

}  // namespace hapbeam::detail
