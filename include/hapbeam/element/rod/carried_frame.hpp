// SPDX-License-Identifier: MIT
// The frame of an element of a rod that twists: the director of its first node, carried along the cubic by the smallest rotation.
//
// In the axes of node 1, (d1, d2, tangent), with a = r' = (x, y, z), b = r'' = (p, q, s), n = |a|, D = n (n + z):
//
//   K1 = -q/n + y g,   K2 = p/n - x g,   c = (xq - yp)/D,   g = (s + a·b/n)/D          curvatures; the frame twists by -c
//
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <cmath>

#include <hapbeam/element/rod/rod_properties.hpp>

namespace hapbeam::detail {

template <typename S>
using V3 = VectorOf<S, 3>;

/// The element seen in the axes of node 1.
template <typename S>
struct CarriedFrame {
  V3<S> e1, e2, u;     // the axes
  V3<S> chord, t2, v;  // Δ/l, r2', its direction
  S l1, l2;            // |r1'|, |r2'|
  S mismatch;          // m

  [[gnu::flatten]] CarriedFrame(const RodProperties<S>& p, const RodNode<S>& a,
                                const RodNode<S>& b) noexcept {
    using std::atan2;
    using std::sqrt;
    l1 = sqrt(a.tangent.squaredNorm());
    u = a.tangent / l1;
    e1 = a.director;
    e2 = detail::cross3(u, e1);
    chord = in(V3<S>(p.inverse_length * (b.r - a.r)));
    t2 = in(b.tangent);
    l2 = sqrt(t2.squaredNorm());
    v = t2 / l2;
    const V3<S> d = in(b.director);
    const S share = d[2] / (1 + v[2]);
    mismatch = atan2(d[1] - v[1] * share, d[0] - v[0] * share);
  }
  V3<S> in(const V3<S>& x) const noexcept { return {e1.dot(x), e2.dot(x), u.dot(x)}; }
  V3<S> out(S x, S y, S z) const noexcept { return x * e1 + y * e2 + z * u; }
  /// r' or r''l of these weights.
  [[gnu::always_inline]] V3<S> combine(const S& w, const S& w1, const S& w2) const noexcept {
    V3<S> a = w * chord + w2 * t2;
    a[2] += w1 * l1;
    return a;
  }
  /// r' at ξ, in space.
  V3<S> tangent(S x) const noexcept {
    const detail::CubicWeights<S> w(x, 1);
    const V3<S> a = combine(w.a, w.a1, w.a2);
    return out(a[0], a[1], a[2]);
  }
  /// The director at ξ.   @param first  of node 1   @param twist  ψ, of the element's own
  V3<S> director(const V3<S>& first, S twist, S x) const noexcept {
    const V3<S> d3 = detail::unit(tangent(x));
    return detail::turn(detail::carry(first, u, d3), d3, mismatch * x + 4 * twist * x * (1 - x));
  }
  V3<S> middle() const noexcept { return combine(S(1.5), S(-0.25), S(-0.25)); }
  void stretches(const RodProperties<S>& p, S (&e)[3]) const noexcept {
    using std::sqrt;
    e[0] = l1 - 1 - p.natural_strain[0];
    e[1] = sqrt(middle().squaredNorm()) - 1 - p.natural_strain[1];
    e[2] = l2 - 1 - p.natural_strain[2];
  }
};

/// Curvatures of the carried frame at a point, times l.
template <typename S>
struct CarriedPoint {
  V3<S> a, b, v;    // r', r''l, direction of r'
  S n, i, h, w, C;  // i = 1/n, h = 1/D, w = s + v·b, C = xq - yp
  S K1, K2, c;

  [[gnu::always_inline]] CarriedPoint(const CarriedFrame<S>& f, const CubicAt& at) noexcept
      : a(f.combine(S(at.a), S(at.a1), S(at.a2))), b(f.combine(S(at.b), S(at.b1), S(at.b2))) {
    using std::sqrt;
    n = sqrt(a.squaredNorm());
    i = 1 / n;
    v = a * i;
    h = 1 / (n * (n + a[2]));
    w = b[2] + v.dot(b);
    C = a[0] * b[1] - a[1] * b[0];
    K1 = -b[1] * i + a[1] * w * h;
    K2 = b[0] * i - a[0] * w * h;
    c = C * h;
  }
  /// Curvatures and twist.   @param rate  θ' l
  void strains(S theta, S rate, S inverse_length, S (&k)[3]) const noexcept {
    S co, si;
    cos_and_sin(theta, co, si);
    k[0] = (co * K1 + si * K2) * inverse_length;
    k[1] = (co * K2 - si * K1) * inverse_length;
    k[2] = (rate - c) * inverse_length;
  }
};

}  // namespace hapbeam::detail
