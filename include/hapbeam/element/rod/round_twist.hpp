// SPDX-License-Identifier: MIT
// Twist of an element whose section is round and that is straight by nature, with all derivatives.
//
// Bending costs the same about all axes there, so nothing but the ends turns a section: torque is the same all along an element, and
//
//   V = ½ GJ/l (m - Θ)²,   Θ = 2 û · (ĉ × v̂)/(2 + û·v̂)        û, ĉ, v̂: directions of r' at node 1, in the middle, at node 2
//
// m is the angle from the director of node 1, carried to node 2 by the smallest rotation, to that of node 2.  A director that is carried
// along the curve arrives aside of that one by Θ, the area on the unit sphere between r' and the great circle through its ends.  On a helix
// of curvature κ and torsion τ the formula is right but for (κ² + τ²)l²/50 of Θ.  So V is of fourth order, and no twist is the element's own.
// GJ is of the mean compliance.
//
//   ∂m = k·(∂û + ∂v̂),   k = û × v̂/(1 + û·v̂)
//
// Directors are carried along while tangents move, which is not integrable: second derivatives of m are the symmetric part.
// Real-time: no allocation, noexcept, O(1).
// Source: a director carried along a curve, Fuller, The writhing number of a space curve, PNAS 68 (1971); the formula is ours.
#pragma once

#include <hapbeam/element/rod/carried_frame.hpp>
#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/element/rod/rod_tangent.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

template <typename S>
class RoundTwist {
 public:
  /// @param at  of these nodes
  [[gnu::always_inline]] RoundTwist(const RodProperties<S>& p, const RodNode<S>& a, const RodNode<S>& b,
                                    const EndsAndMiddle<S>& at) noexcept
      : at_(at), w_(at.v[0].dot(at.v[2])) {
    const V3<S>&u = at.v[0], &v = at.v[2];
    const S one = 1 + w_, two = 2 + w_, both = 1 / (one * two);
    is_ = two * both, iR_ = 2 * one * both;
    beside_ = cross3(at.v[1], v);
    carried_ = iR_ * u.dot(beside_);
    const S back = is_ * v.dot(a.director);
    V3<S> e;
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) e[r] = a.director[r] - back * (u[r] + v[r]);
    mismatch_ = angle(S(v.dot(cross3(e, b.director))), S(e.dot(b.director)), S(1));
    stiffness_ = p.torsion * p.inverse_length;
  }
  /// Θ
  const S& carried() const noexcept { return carried_; }
  S energy() const noexcept {
    const S twist = mismatch_ - carried_;
    return S(0.5) * stiffness_ * twist * twist;
  }

  /// Adds its derivatives to those of bending and stretch, of which it sets all by φ.   @param i  1/l
  [[gnu::always_inline]] void add(const S& i, RodTangent<S, 4>& to) const noexcept {
    using To = RodTangent<S, 4>;
    const V3<S>&u = at_.v[0], &c = at_.v[1], &v = at_.v[2];
    const S &i1 = at_.inverse[0], &ic = at_.inverse[1], &i2 = at_.inverse[2];
    const S &F = carried_, &iR = iR_, h = S(0.5) * is_, half_iR = S(0.5) * iR;
    const S T = stiffness_ * (mismatch_ - F);
    const V3<S> s = cross3(u, v), uc = cross3(u, c);
    const S by_D = S(1.5) * i, own_k = h * (2 + w_), half = half_iR * F;
    const S cc = T * ic * ic, c1 = T * ic * i1, c2 = T * ic * i2, t11 = T * i1 * i1, t12 = T * i1 * i2,
            t22 = T * i2 * i2;
    // Component by component: of longer expressions of vectors a compiler makes functions, where a program has several models.
    V3<S> y, k, F1, D, g1, g2, kD, k1, k2;                                     // first derivatives
    V3<S> z, c1F, c1r, c2F, c2r, v1, u2, A1, B1, A2, B2, Au, Av, AF, Ak, x12;  // of second ones, by T
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      // Of Θ by the directions, and of m - Θ by the unknowns: D, r1', r2'.
      const S r1 = iR * u[r] + half_iR * v[r], r2 = iR * v[r] + half_iR * u[r];
      y[r] = -iR * s[r], k[r] = is_ * s[r];
      F1[r] = iR * beside_[r] - F * r1;
      const S F2 = iR * uc[r] - F * r2, Fc = y[r] - F * c[r], gc = -ic * Fc;
      D[r] = by_D * gc, g1[r] = i1 * (k[r] - F1[r]) - S(0.25) * gc, g2[r] = i2 * (k[r] - F2) - S(0.25) * gc;
      kD[r] = stiffness_ * D[r], k1[r] = stiffness_ * g1[r], k2[r] = stiffness_ * g2[r];
      // Outer products, and x × .
      const S hk = h * k[r], sum = u[r] + v[r];
      z[r] = cc * (Fc - S(0.5) * F * c[r]);
      c1F[r] = c1 * F1[r], c1r[r] = c1 * r1, c2F[r] = c2 * F2, c2r[r] = c2 * r2;
      v1[r] = c1 * iR * v[r], u2[r] = c2 * iR * u[r];
      A1[r] = t11 * (iR * F1[r] - own_k * k[r] - half * u[r]), B1[r] = t11 * (half_iR * F1[r] - hk);
      A2[r] = t22 * (iR * F2 - own_k * k[r] - half * v[r]), B2[r] = t22 * (half_iR * F2 - hk);
      Au[r] = t12 * (iR * (F2 + F * v[r]) - hk), Av[r] = t12 * (half_iR * F2 - hk), AF[r] = t12 * r2;
      Ak[r] = -t12 * h * sum, x12[r] = t12 * (h * sum - iR * c[r]);
    }
    const S on11 = t11 * iR * F, on22 = t22 * iR * F, on12 = t12 * half_iR * F, oncc = cc * F;
    // Entry of x × .
    const auto turn = [](const V3<S>& x, int r, int col) {
      const int other = 3 - r - col;
      return (col - r + 3) % 3 == 1 ? S(-x[other]) : x[other];
    };
    // Of the middle alone; then what couples it with r1', and with r2'.  Both carry an eighth of the middle's own to r1' and r2'.
    S own[3][3];
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      to.D[r] = add_product(to.D[r], T, D[r]);
      to.t1[r] = add_product(to.t1[r], T, g1[r]), to.t2[r] = add_product(to.t2[r], T, g2[r]);
      HAPBEAM_UNROLL
      for (int col = 0; col <= r; ++col) {
        S middle = add_product(S(z[r] * c[col]), c[r], z[col]);
        if (r == col) middle += oncc;
        S& DD = to.DD[To::template half<3>(r, col)];
        DD = add_product(add_product(DD, S(by_D * by_D), middle), kD[r], D[col]);
        own[r][col] = own[col][r] = S(-0.125) * middle;
      }
    }
    S of1[3][3];
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      HAPBEAM_UNROLL
      for (int col = 0; col < 3; ++col) {
        S& of = of1[r][col];
        of = add_product(add_product(own[r][col], c[r], c1F[col]), y[r], c1r[col]);
        if (r != col) of -= turn(v1, r, col);
        S& D1 = to.D1[3 * col + r];
        D1 = add_product(add_product(D1, by_D, S(of + own[r][col])), kD[r], g1[col]);
        if (col > r) continue;
        S& K11 = to.K11[To::template half<4>(r, col)];
        K11 = add_product(add_product(K11, S(-0.25), S(of + of1[col][r])), k1[r], g1[col]);
        K11 = add_product(add_product(K11, u[r], A1[col]), A1[r], u[col]);
        K11 = add_product(add_product(K11, v[r], B1[col]), B1[r], v[col]);
        if (r == col) K11 += on11;
      }
    }
    S of2[3][3];
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      HAPBEAM_UNROLL
      for (int col = 0; col < 3; ++col) {
        S& of = of2[r][col];
        of = add_product(add_product(own[r][col], c[r], c2F[col]), y[r], c2r[col]);
        if (r != col) of += turn(u2, r, col);
        S &D2 = to.D2[3 * col + r], &K12 = to.K12[4 * col + r];
        D2 = add_product(add_product(D2, by_D, S(of + own[r][col])), kD[r], g2[col]);
        K12 = add_product(add_product(K12, S(-0.25), S(of1[col][r] + of)), k1[r], g2[col]);
        K12 = add_product(add_product(K12, u[r], Au[col]), v[r], Av[col]);
        K12 = add_product(add_product(K12, F1[r], AF[col]), k[r], Ak[col]);
        K12 += r == col ? on12 : turn(x12, r, col);
        if (col > r) continue;
        S& K22 = to.K22[To::template half<4>(r, col)];
        K22 = add_product(add_product(K22, S(-0.25), S(of + of2[col][r])), k2[r], g2[col]);
        K22 = add_product(add_product(K22, v[r], A2[col]), A2[r], v[col]);
        K22 = add_product(add_product(K22, u[r], B2[col]), B2[r], u[col]);
        if (r == col) K22 += on22;
      }
      to.D1[9 + r] = -kD[r], to.D2[9 + r] = kD[r];
      to.K11[To::template half<4>(r, 3)] = -k1[r], to.K12[12 + r] = k1[r];
      to.K12[4 * r + 3] = -k2[r], to.K22[To::template half<4>(r, 3)] = k2[r];
    }
    to.t1[3] = -T, to.t2[3] = T;
    to.K11[9] = to.K22[9] = stiffness_, to.K12[15] = -stiffness_;
  }

 private:
  const EndsAndMiddle<S>& at_;
  V3<S> beside_;   // ĉ × v̂
  S w_, is_, iR_;  // û·v̂, 1/(1 + û·v̂), 2/(2 + û·v̂)
  S mismatch_, carried_, stiffness_;
};

}  // namespace hapbeam::detail
