// SPDX-License-Identifier: MIT
// What a section of a beam or rod carries, from its elements: equilibrium of a piece that is cut out.
//
// The forces of an element on its nodes, less its dead loads, are those of the neighbours.  From its left node the moment is
// M(s) = M1 - (r(s) - r1) × F  along the bent centreline, F the force; what that misses of the right node's is shared out.  In the plane × is
// counted clockwise, as θ is; in space the moment of a node is r' × g + φ t, with g and φ those on r' and on the twist.
// At nodes this is as accurate as the force of a press; second derivatives of the shape are of second order.
//
// A distributed load is nodal forces of the mesh (loads.hpp).  Between two of those it has, at ξ of their distance h,
//
//   F(ξ) = F - q h (ξ - ½),     M(ξ) = M + h² (1/12 - ½ ξ (1 - ξ)) t × q
//
// with F, M the cuts of those nodal forces: their arms are in M, and bend it by what the last term takes off.
// Real-time: noexcept, no allocation, O(loads on the element).
#pragma once

#include <cmath>
#include <type_traits>

#include <hapbeam/angle.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/loads.hpp>
#include <hapbeam/internal_forces.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// r × f
template <typename Scalar>
Scalar moment_of(const Vector2<Scalar>& r, const Vector2<Scalar>& f) noexcept {
  return r.y() * f.x() - r.x() * f.y();
}
template <typename Scalar>
VectorOf<Scalar, 3> moment_of(const VectorOf<Scalar, 3>& r, const VectorOf<Scalar, 3>& f) noexcept {
  return cross3<Scalar>(r, f);
}

/// A place along the centreline, as its kinematics sees it.
template <typename Scalar, int D>
struct CutPlace {
  VectorOf<Scalar, D> r, tangent;
};
/// Of a node of a beam in the plane: unless slopes are felt, the straight one's.
template <class Element, typename Scalar>
CutPlace<Scalar, 2> cut_place(const CentrelineNode<Scalar>& at) noexcept {
  if constexpr (any_rotation<Element>) return {at.position(), direction(-at.theta)};
  else if constexpr (membrane_feels_slope<Element>) return {{at.s, at.w}, {1, -at.theta}};
  else return {{at.s, 0}, {1, 0}};
}

/// A cut that moves along an element.
template <typename Scalar, int D>
struct SectionCut {
  using Vector = VectorOf<Scalar, D>;
  using Moment = std::conditional_t<D == 2, Scalar, VectorOf<Scalar, 3>>;
  Vector force;
  Moment moment;
  Vector r;

  void go(const Vector& to) noexcept {
    moment -= moment_of<Scalar>(Vector(to - r), force);
    r = to;
  }
  /// Past a force on the beam before the cut.   @param at  where it stands
  void pass(const Vector& load, const Vector& at) noexcept {
    force -= load;
    moment += moment_of<Scalar>(Vector(r - at), load);
  }
  void pass(const PointForce<Scalar, D>& load, Scalar lambda, const CutPlace<Scalar, D>& at) noexcept {
    pass(lambda * load.force, at.r);
    moment -= moment_of<Scalar>(at.tangent, Vector(lambda * load.arm));
    if constexpr (D == 2) moment -= lambda * load.moment;
  }
  /// What an even load q does that the nodal forces of a cell, of length h, do not.   @param x  ξ
  void spread(const Vector& q, const Vector& tangent, Scalar x, Scalar h) noexcept {
    force -= h * (x - Scalar(0.5)) * q;
    moment += h * h * (Scalar(1. / 12) - x * (1 - x) / 2) * moment_of<Scalar>(tangent, q);
  }
};

/// Where an element is cut.
template <typename Scalar>
struct CutAt {
  Scalar from, to, s;  ///< the element, and the place in it [m]
  bool last;           ///< element of the beam
  bool begins;         ///< what stands at s is on its left

  bool passed(Scalar x) const noexcept { return x < s || (x == s && begins); }
};

/// The cut at s.   @param cut  at the left node   @param right  moment at the right node   @param place  (s) -> CutPlace in the element
/// @param others  (cut, whole) takes a cut past what else acts on the element: on all of it, or as far as s
template <typename Scalar, int D, class Place, class Others>
SectionCut<Scalar, D> cut_element(SectionCut<Scalar, D> cut,
                                  const typename SectionCut<Scalar, D>::Moment& right,
                                  const CutAt<Scalar>& at, Scalar lambda, const DeadLoads<Scalar, D>& loads,
                                  Place&& place, Others&& others) noexcept {
  const CutPlace<Scalar, D> here = place(at.s);
  SectionCut<Scalar, D> end = cut;
  cut.go(here.r);
  end.go(place(at.to).r);
  if (lambda != 0)
    loads.visit(at.from, at.to, at.last, [&](const PointForce<Scalar, D>& load) {
      const CutPlace<Scalar, D> there = place(load.s);
      end.pass(load, lambda, there);
      if (at.passed(load.s)) cut.pass(load, lambda, there);
    });
  others(end, true);
  others(cut, false);
  cut.moment += (at.s - at.from) / (at.to - at.from) * (right - end.moment);
  loads.visit_cell([&](Scalar x) { return at.passed(x); },
                   [&](const VectorOf<Scalar, D>& q, Scalar start, Scalar length) {
                     cut.spread(lambda * q, here.tangent, (at.s - start) / length, length);
                   });
  return cut;
}

/// @param at  of the section   @param theta  its rotation   @param thickness [m]
template <class Element, class Stiffness, typename Scalar>
InternalForces<Scalar> in_section(const SectionCut<Scalar, 2>& cut, Scalar theta, const Stiffness& stiffness,
                                  Scalar thickness) noexcept {
  constexpr bool turns = any_rotation<Element>;
  const Vector2<Scalar> t = turns ? direction(-theta) : Vector2<Scalar>(1, 0);
  Scalar shear = t.x() * cut.force.y() - t.y() * cut.force.x();
  if (!turns && membrane_feels_slope<Element>) shear += theta * cut.force.x();
  const Scalar normal = cut.force.dot(t), strain = normal / stiffness.axial;
  return {normal, shear, cut.moment, strain,
          std::abs(strain) + std::abs(cut.moment) / stiffness.bending * thickness / 2};
}

/// How far a rod's surface is from its axis, over the radii of gyration √(EI/EA): the same along a taper.
template <typename Scalar>
struct RodSurface {
  Scalar along2 = 0, along1 = 0;  // what curvature about d1 strains, and about d2
  bool corners = false;           // where both add up

  template <class Rod>
  explicit RodSurface(const Rod& rod) noexcept : corners(rod.outline().corners) {
    const auto& k = rod.stiffness();
    along2 = static_cast<Scalar>(rod.outline().height / 2 / std::sqrt(k.bending1 / k.axial));
    along1 = static_cast<Scalar>(rod.outline().width / 2 / std::sqrt(k.bending2 / k.axial));
  }
  template <class Stiffness>
  InternalForces<Scalar, 3> in_section(const SectionCut<Scalar, 3>& cut, const VectorOf<Scalar, 3>& d1,
                                       const VectorOf<Scalar, 3>& d3, const Stiffness& k) const noexcept {
    const VectorOf<Scalar, 3> d2 = cross3<Scalar>(d3, d1);
    const Scalar normal = cut.force.dot(d3), m1 = cut.moment.dot(d1), m2 = cut.moment.dot(d2),
                 strain = normal / static_cast<Scalar>(k.axial);
    // Largest strain of bending.
    const Scalar a = along2 * std::abs(m1) / std::sqrt(static_cast<Scalar>(k.bending1 * k.axial)),
                 b = along1 * std::abs(m2) / std::sqrt(static_cast<Scalar>(k.bending2 * k.axial));
    return {normal,
            cut.force.dot(d1),
            cut.force.dot(d2),
            m1,
            m2,
            cut.moment.dot(d3),
            strain,
            std::abs(strain) + (corners ? a + b : std::sqrt(a * a + b * b))};
  }
};

}  // namespace hapbeam::detail
