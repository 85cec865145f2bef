// Bending and twist at a Gauss point of an element that twists, where its section is round and the rod straight by nature.
//
// Bending costs the same about all axes there and does not depend on θ; only twist does, through its rate:
//
//   V = ½ w/l (EI |a × b|²/|a|⁴ + GJ (θ' l - c)²),   c = C h,  C = xq - yp,  h = 1/(n (n + z))        a = (x, y, z) = r', b = (p, q, s) = r''l
//
// as twisted_rod.hpp has them, in the axes of node 1.  That is what add_point() computes of such a section, with fewer than two thirds of its operations.
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <cmath>

#include <hapbeam/element/carried_frame.hpp>
#include <hapbeam/element/rod_properties.hpp>
#include <hapbeam/element/twisted_core.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

/// As add_point() of three points.
template <int G, typename S>
[[gnu::flatten]] inline void add_round_point(const RodProperties<S>& p, const CarriedFrame<S>& f,
                                             const S& psi, TwistedCore<S>& core, S& energy) noexcept {
  using std::sqrt;
  constexpr CubicAt w(three_points.x[G]);
  constexpr double rate = 4 * (1 - 2 * three_points.x[G]), d[3] = {-1, 1, rate};  // θ' l by φ1, φ2 + m, ψ
  const S weight = S(three_points.weight[G]) * p.inverse_length;
  const V3<S> a = f.combine(S(w.a), S(w.a1), S(w.a2)), b = f.combine(S(w.b), S(w.b1), S(w.b2));
  const S A = a.squaredNorm(), n = sqrt(A), i = 1 / n, ii = i * i, z = a[2] * i, h = ii / (1 + z);
  const S C = a[0] * b[1] - a[1] * b[0];

  // Twist: its gradient, with the sign turned, by (Δ/l, |r1'|, r2').
  V3<S> Da = a * (2 + z);  // ∂(1/h)/∂a
  Da[2] += n;
  const S hh = h * h;
  const V3<S> ha = -hh * Da;
  V3<S> ca = C * ha;
  ca[0] += h * b[1], ca[1] -= h * b[0];
  const S cb[2] = {-h * a[1], h * a[0]};
  S R[7];
  HAPBEAM_UNROLL
  for (int k = 0; k < 3; ++k) {
    R[k] = S(w.a) * ca[k], R[4 + k] = S(w.a2) * ca[k];
    if (k < 2) add_share(R[k], w.b, cb[k]), add_share(R[4 + k], w.b2, cb[k]);
  }
  R[3] = S(w.a1) * ca[2];
  const S GJ = weight * p.points[G].torsion, tau = f.mismatch + S(rate) * psi - C * h, T = GJ * tau;

  // Bending, as RoundRod has it.
  const S B = b.squaredNorm() * ii, c = a.dot(b) * ii, cc = c * c;
  const S half = S(0.5) * weight * p.points[G].bending1, ki = half * ii, fCC = -2 * ki * ii, fC = -2 * ki * c;
  const S fA2 = 2 * ki * (2 * cc - B), fB2 = 2 * ki, fAB4 = 2 * fCC, fAC2 = -4 * fCC * c,
          fAA2 = 4 * ki * ii * (B - 3 * cc);
  energy += add_product(S(half * (B - cc)), S(S(0.5) * T), tau);

  // ∇²h = 2h³ DaDaᵀ - h² (2I + vẑᵀ + ẑvᵀ + z (I - vvᵀ)/n²).  By a twice:  a yᵀ + y aᵀ + fCC b bᵀ, a diagonal, and what ẑ has besides.
  const S F = -T * C * hh, twice = F * h, turn = T * hh;
  const S beta[2] = {turn * b[1], -turn * b[0]};  // -h² ∂F/∂a
  V3<S> y = S(fAA2 + F * (z * ii * S(0.5)) + twice * ((2 + z) * (2 + z))) * a + fAC2 * b;
  HAPBEAM_UNROLL
  for (int k = 0; k < 2; ++k) y[k] = add_product(y[k], S(2 + z), beta[k]);
  y[2] += 2 * twice * n * (2 + z) - F * i;
  const S on_diagonal = fA2 - F * (2 + z);
  const V3<S> x = fAC2 * a + fCC * b;
  const S Fb[2] = {T * a[1], -T * a[0]};
  S Aa[3][3], Ab[3][3], Bb[3][3];
  HAPBEAM_UNROLL
  for (int r = 0; r < 3; ++r) {
    const S u = fCC * a[r], v = fCC * b[r], by_b = fAB4 * a[r];
    HAPBEAM_UNROLL
    for (int k = 0; k <= r; ++k) {
      Aa[r][k] = add_product(add_product(S(a[r] * y[k]), y[r], a[k]), v, b[k]);
      Bb[r][k] = u * a[k];
    }
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k) {
      Ab[r][k] = add_product(S(x[r] * a[k]), by_b, b[k]);
      if (k < 2) Ab[r][k] = add_product(Ab[r][k], ha[r], Fb[k]);
    }
    Aa[r][r] += on_diagonal, Ab[r][r] += fC, Bb[r][r] += fB2;
  }
  Aa[2][0] = add_product(Aa[2][0], n, beta[0]), Aa[2][1] = add_product(Aa[2][1], n, beta[1]);
  Aa[2][2] = add_product(Aa[2][2], S(2 * twice), A);
  Ab[0][1] -= h * T, Ab[1][0] += h * T;

  // By what a and b are made of.
  const V3<S> by_a = fA2 * a + fC * b, by_b = fB2 * b + fC * a;
  HAPBEAM_UNROLL
  for (int r = 0; r < 7; ++r) {
    const int k = r < 3 ? r : r == 3 ? 2 : r - 4;
    const double of_a = r < 3 ? w.a : r == 3 ? w.a1 : w.a2, of_b = r < 3 ? w.b : r == 3 ? w.b1 : w.b2;
    S& gradient = core.g[r];
    gradient = add_product(gradient, -T, R[r]);
    add_share(gradient, of_a, by_a[k]), add_share(gradient, of_b, by_b[k]);
    const S s = GJ * R[r];
    HAPBEAM_UNROLL
    for (int col = 0; col <= r; ++col) {
      const int j = col < 3 ? col : col == 3 ? 2 : col - 4;
      const double in_a = col < 3    ? w.a
                          : col == 3 ? w.a1
                                     : w.a2,
                   in_b = col < 3    ? w.b
                          : col == 3 ? w.b1
                                     : w.b2;
      S& H = core.H[r][col];
      H = add_product(H, s, R[col]);
      add_share(H, of_a * in_a, k < j ? Aa[j][k] : Aa[k][j]),
          add_share(H, of_b * in_b, k < j ? Bb[j][k] : Bb[k][j]);
      if (of_a * in_b == of_b * in_a) {
        add_share(H, of_a * in_b, S(Ab[k][j] + Ab[j][k]));
      } else {
        add_share(H, of_a * in_b, Ab[k][j]), add_share(H, of_b * in_a, Ab[j][k]);
      }
    }
    HAPBEAM_UNROLL
    for (int m = 0; m < 3; ++m) {
      S& H = core.H[7 + m][r];
      if (G == 0) H = 0;
      add_share(H, -d[m], s);
    }
  }
  HAPBEAM_UNROLL
  for (int m = 0; m < 3; ++m) {
    S& gradient = core.g[7 + m];
    if (G == 0) gradient = 0;
    add_share(gradient, d[m], T);
    HAPBEAM_UNROLL
    for (int k = 0; k <= m; ++k) {
      S& H = core.H[7 + m][7 + k];
      if (G == 0) H = 0;
      add_share(H, d[m] * d[k], GJ);
    }
  }
}

}  // namespace hapbeam::detail
