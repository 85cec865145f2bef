// SPDX-License-Identifier: MIT
// What the tension of an element does to its bending: it makes an element exact that is drawn taut.  EI is that of the softest axis.
//
//   Π(d, N) = V(d) + EI/4l ((B - 6 - q/4) |û + v̂|²/m + (A - 2 - q/6) |û - v̂|²) + l N (ε - ē/5) - 2 l N²/5EA,     q = N (1 + N/EA) l²/EI
//
// stationary in N, the element's own unknown.  ε = (ε1 + 4 εm + ε2)/6 is the stretch of the cubic, ē that of its ends.  V has no stretch of the middle: all of it is
//
//   l (N ε - N²/2EA) + EA l ((ε2 - ε1)²/24 + (ē - N/EA)²/10)
//
// What is under one tension is stretched alike all along, where |r'| of a cubic between two kinks is not.  A(q), B(q): tension_stiffness.hpp;
// 2 and 6 are the bending of the cubic, q/6 and q/4 what its stretch has of q already.  û, v̂: directions of r' at both nodes, across that in the middle, m̂,
// of which the antisymmetric bend takes half as much to the other side:  |û + v̂|²/m = 4/9 (2 + 2 û·v̂ - (X + Y)²),  X = û·m̂,  Y = v̂·m̂.
// A string of a thousand Euler loads has its boundary layers in one element.
// Real-time: no allocation, noexcept, O(1).
// Source: derived here; docs/theory.md, The element in space.
#pragma once

#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/element/rod/rod_tangent.hpp>
#include <hapbeam/element/tension_stiffness.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

template <typename S>
class RoundTension {
  using V3 = VectorOf<S, 3>;

 public:
  /// ∂²Π/∂N∂ε, over l.
  static constexpr double by_end = 1. / 15, by_middle = 2. / 3;

  /// @param at  of these nodes   @param N  [N]
  [[gnu::always_inline]] RoundTension(const RodProperties<S>& p, const EndsAndMiddle<S>& at,
                                      const S& N) noexcept
      : at_(at) {
    const S l = p.length, by_q = l * l * p.softest(), quarter = S(0.25) / (l * p.softest());
    const S yields = 1 / p.axial, strain = N * yields, by = 1 + 2 * strain, q = N * (1 + strain) * by_q;
    const TensionStiffness<S> k = p.swings ? tension_stiffness_of_cubic(q) : tension_stiffness(q);
    const V3 &u = at.v[0], &m = at.v[1], &v = at.v[2];
    W_ = u.dot(v), X_ = u.dot(m), Y_ = v.dot(m);
    const S sum = X_ + Y_, less = X_ - Y_, across = S(4. / 9) * (2 + 2 * W_ - sum * sum),
            about = 2 - 2 * W_ - less * less, share = S(4. / 9) * quarter;
    const S b = k.b - S(0.25) * q, a = k.a - S(1. / 6) * q, by_b = S(0.25) * l * (k.b1 - S(0.25)),
            by_a = S(0.25) * l * (k.a1 - S(1. / 6)), b1 = by * by_b, a1 = by * by_a,
            second = S(0.25) * l * by_q * by * by, b2 = second * k.b2 + 2 * yields * by_b,
            a2 = second * k.a2 + 2 * yields * by_a;
    const S soft = S(0.8) * l * yields;
    own_ = terms(S(share * b), S(quarter * a));
    by_N_ = terms(S(S(4. / 9) * b1), a1);
    by_end_ = S(by_end) * l, by_middle_ = S(by_middle) * l, N_ = N;
    const S drawn = by_end_ * (at.n[0] + at.n[2] - 2) + by_middle_ * (at.n[1] - 1);
    energy_ = quarter * (b * across + a * about) + N * (drawn - S(0.5) * soft * N);
    residual_ = b1 * across + a1 * about + drawn - soft * N;
    stiffness_ = b2 * across + a2 * about - soft;
  }
  /// What N adds to Π [J].
  const S& energy() const noexcept { return energy_; }
  /// ∂Π/∂N [m]
  const S& residual() const noexcept { return residual_; }
  /// ∂²Π/∂N², negative [m/N]
  const S& stiffness() const noexcept { return stiffness_; }

  /// Adds its derivatives, with N condensed.   @param i  1/l   @param inner  its derivatives are set
  template <int M>
  [[gnu::always_inline]] void add(const S& i, RodInner<S, 3 + M>& inner,
                                  RodTangent<S, M>& to) const noexcept {
    using To = RodTangent<S, M>;
    const V3 &u = at_.v[0], &c = at_.v[1], &v = at_.v[2];
    const S &i0 = at_.inverse[0], &i1 = at_.inverse[1], &i2 = at_.inverse[2];
    const S over = -1 / stiffness_, on = residual_ * over;
    inner.residual = residual_, inner.stiffness = stiffness_;
    // By r' at node 1, in the middle and at node 2: first derivatives, those by N, and the second ones as sums of outer products.
    const S hh = own_.same, hx = own_.other, h02 = i0 * i2 * own_.W, h01 = i0 * i1, h21 = i2 * i1,
            x0 = h01 * own_.X, x2 = h21 * own_.Y, by_D = S(1.5) * i;
    // Of directions that turn: -(û·g) I, and N.  Where N lags behind the shape, that of the shape keeps it stiff.
    const S turns = larger(N_, S(N_ + on)), at_end = by_end_ * N_, at_middle = by_middle_ * N_,
            s0 = i0 * (by_end_ * turns - i0 * (own_.W * W_ + own_.X * X_)),
            s1 = i1 * (by_middle_ * turns - i1 * (own_.X * X_ + own_.Y * Y_)),
            s2 = i2 * (by_end_ * turns - i2 * (own_.W * W_ + own_.Y * Y_)), half0 = S(-0.5) * s0,
            half1 = S(-0.5) * s1, half2 = S(-0.5) * s2;
    V3 M0, M2, A, B, yD, y1, y2, z0, z1, z2, m00, m22, b0, b2, m02, u02, v02, C0, C2, u01, c01, v21, c21, m01,
        m21;
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      const S V0 = v[r] - W_ * u[r], U2 = u[r] - W_ * v[r];
      M0[r] = c[r] - X_ * u[r], M2[r] = c[r] - Y_ * v[r];
      A[r] = u[r] - X_ * c[r], B[r] = v[r] - Y_ * c[r];
      const S g0 = i0 * (own_.W * V0 + own_.X * M0[r]), g2 = i2 * (own_.W * U2 + own_.Y * M2[r]),
              g1 = i1 * (own_.X * A[r] + own_.Y * B[r]);
      const S n0 = i0 * (by_N_.W * V0 + by_N_.X * M0[r]) + by_end_ * u[r],
              n2 = i2 * (by_N_.W * U2 + by_N_.Y * M2[r]) + by_end_ * v[r],
              n1 = i1 * (by_N_.X * A[r] + by_N_.Y * B[r]) + by_middle_ * c[r];
      yD[r] = by_D * n1, y1[r] = n0 - S(0.25) * n1, y2[r] = n2 - S(0.25) * n1;
      const S p = g1 + at_middle * c[r];
      to.D[r] += by_D * p + on * yD[r];
      to.t1[r] += g0 + at_end * u[r] - S(0.25) * p + on * y1[r];
      to.t2[r] += g2 + at_end * v[r] - S(0.25) * p + on * y2[r];
      inner.row[r] = -yD[r], inner.row[3 + r] = y1[r];
      inner.row[3 + M + r] = yD[r], inner.row[6 + M + r] = y2[r];
      z0[r] = half0 * u[r] - i0 * g0, z1[r] = half1 * c[r] - i1 * g1, z2[r] = half2 * v[r] - i2 * g2;
      m00[r] = i0 * i0 * hh * M0[r], m22[r] = i2 * i2 * hh * M2[r];
      const S of_u = hh * A[r] + hx * B[r], of_v = hh * B[r] + hx * A[r];
      b0[r] = i1 * i1 * of_u, b2[r] = i1 * i1 * of_v;
      C0[r] = h01 * of_u, C2[r] = h21 * of_v;
      u02[r] = -h02 * U2, v02[r] = -h02 * v[r], m02[r] = i0 * i2 * hx * M0[r];
      u01[r] = -x0 * A[r], c01[r] = -x0 * c[r];
      v21[r] = -x2 * B[r], c21[r] = -x2 * c[r];
    }
    S of0[3][3], of2[3][3], of1[3][3];
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      HAPBEAM_UNROLL
      for (int s = 0; s < 3; ++s) {
        of0[r][s] = add_product(add_product(S(u[r] * u01[s]), c01[r], c[s]), M0[r], C0[s]);
        of2[r][s] = add_product(add_product(S(v[r] * v21[s]), c21[r], c[s]), M2[r], C2[s]);
        if (r == s) of0[r][s] += x0, of2[r][s] += x2;
        if (s > r) continue;
        S& of = of1[r][s];
        of = add_product(add_product(S(A[r] * b0[s]), B[r], b2[s]), c[r], z1[s]);
        of = add_product(of, z1[r], c[s]);
        if (r == s) of += s1;
        of1[s][r] = of;
      }
    }
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      const S kD = over * yD[r], k1 = over * y1[r], k2 = over * y2[r];
      HAPBEAM_UNROLL
      for (int s = 0; s < 3; ++s) {
        const S middle = S(-0.25) * of1[r][s];
        S &D1 = to.D1[3 * s + r], &D2 = to.D2[3 * s + r], &K12 = to.K12[M * s + r];
        D1 = add_product(add_product(D1, by_D, S(of0[s][r] + middle)), kD, y1[s]);
        D2 = add_product(add_product(D2, by_D, S(of2[s][r] + middle)), kD, y2[s]);
        K12 = add_product(add_product(K12, S(-0.25), S(of0[r][s] + of2[s][r] + middle)), k1, y2[s]);
        K12 = add_product(add_product(add_product(K12, u[r], u02[s]), v02[r], v[s]), m02[r], M2[s]);
        if (r == s) K12 += h02;
        if (s > r) continue;
        S &DD = to.DD[To::template half<3>(r, s)], &K11 = to.K11[To::template half<M>(r, s)],
          &K22 = to.K22[To::template half<M>(r, s)];
        DD = add_product(add_product(DD, S(-4 * by_D * by_D), middle), kD, yD[s]);
        K11 = add_product(add_product(K11, S(-0.25), S(of0[r][s] + of0[s][r] + middle)), k1, y1[s]);
        K11 = add_product(add_product(add_product(K11, m00[r], M0[s]), u[r], z0[s]), z0[r], u[s]);
        K22 = add_product(add_product(K22, S(-0.25), S(of2[r][s] + of2[s][r] + middle)), k2, y2[s]);
        K22 = add_product(add_product(add_product(K22, m22[r], M2[s]), v[r], z2[s]), z2[r], v[s]);
        if (r == s) K11 += s0, K22 += s2;
      }
    }
  }

 private:
  /// Derivatives by W, X and Y of β (2 + 2W - (X + Y)²) + α (2 - 2W - (X - Y)²); second ones by X and X or Y and Y, and by both.
  struct Terms {
    S W, X, Y, same, other;
  };
  [[gnu::always_inline]] Terms terms(const S& beta, const S& alpha) const noexcept {
    const S sum = -2 * beta * (X_ + Y_), less = -2 * alpha * (X_ - Y_);
    return {S(2 * (beta - alpha)), S(sum + less), S(sum - less), S(-2 * (beta + alpha)),
            S(-2 * (beta - alpha))};
  }

  const EndsAndMiddle<S>& at_;
  S W_, X_, Y_;               // û·v̂, û·m̂, v̂·m̂
  Terms own_, by_N_;          // of Π, and of ∂Π/∂N
  S by_end_, by_middle_, N_;  // ∂²Π/∂N∂ε of an end, and of the middle [m]
  S energy_, residual_, stiffness_;
};

}  // namespace hapbeam::detail
