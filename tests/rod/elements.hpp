// Random elements of rods in space, and the motions of their nodes.
#pragma once

#include <cmath>

#include "support/random.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>

namespace hapbeam::testing {

using Long = long double;
using Axis = VectorOf<Long, 3>;

inline Axis random_vector(Random& random) {
  const double x = random(1.0), y = random(1.0);
  return {x, y, random(1.0)};
}

/// A node after an increment of its unknowns: r, r', φ.
template <typename S>
RodNode<S> moved(RodNode<S> node, const S* x, bool twist) {
  const VectorOf<S, 3> u = detail::unit(node.tangent);
  node.r += VectorOf<S, 3>(x[0], x[1], x[2]);
  node.tangent += VectorOf<S, 3>(x[3], x[4], x[5]);
  const VectorOf<S, 3> v = detail::unit(node.tangent);
  node.director = detail::across<S>(detail::carry(node.director, u, v), v);
  if (twist) node.director = detail::turn(node.director, v, x[6]);
  return node;
}

/// A node after a rotation about a unit axis through the origin, and a translation.
template <typename S>
RodNode<S> rotated(RodNode<S> node, const VectorOf<S, 3>& axis, S angle, const VectorOf<S, 3>& by) {
  const auto turn = [&](const VectorOf<S, 3>& x) -> VectorOf<S, 3> {
    const VectorOf<S, 3> along = axis.dot(x) * axis;
    return along + std::cos(angle) * (x - along) + std::sin(angle) * detail::cross3(axis, x);
  };
  return {node.s, turn(node.r) + by, turn(node.tangent), turn(node.director)};
}

/// An element bent by up to about a radian, twisted as much and stretched by a tenth.
struct RandomElement {
  RodNode<Long> a, b;
  RodProperties<Long> p;
  Long twist;

  explicit RandomElement(Random& random) {
    p.length = 0.7L, p.inverse_length = 1 / p.length, p.axial = 13, p.torsion = 1.2L;
    for (auto& point : p.points) {
      point.bending1 = 1 + random(0.5), point.bending2 = 1 + random(0.5), point.torsion = 1 + random(0.5);
      for (Long& k : point.natural) k = random(1.0);
    }
    p.soft[0] = p.soft[1] = 1 / (1 + random(0.5));
    for (Long& e : p.natural_strain) e = 0.1L * random(1.0);
    a.s = 0, b.s = p.length;
    a.r = random_vector(random);
    a.tangent = 1.1L * detail::unit(random_vector(random));
    a.director = detail::across<Long>(random_vector(random), detail::unit(a.tangent));
    b = a;
    Long x[7];
    const Axis step = p.length * (a.tangent + 0.3L * random_vector(random)),
               bend = 0.5L * random_vector(random);
    for (int k = 0; k < 3; ++k) x[k] = step[k], x[3 + k] = bend[k];
    x[6] = random(1.0);
    b = moved(b, x, true);
    twist = 0.3L * random(1.0);
  }
};

/// V of an element [J].   @param inner  what is its own
template <class E, typename S>
S energy_of(const RodProperties<S>& p, const RodNode<S>& a, const RodNode<S>& b,
            typename E::template Inner<S> inner = {}) {
  RodTangent<S, E::unknowns - 3> unused;
  return E::tangent(p, a, b, inner, unused);
}

}  // namespace hapbeam::testing
