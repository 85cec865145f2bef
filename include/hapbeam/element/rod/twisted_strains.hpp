// SPDX-License-Identifier: MIT
// Strain energy of an element that twists, with its derivatives by what its strains depend on, in the axes of node 1.
//
// Stretch is interpolated, bending and twist are summed over Gauss points.  twisted_rod.hpp says of what, carried_frame.hpp has the
// curvatures at a point, and twisted_core.hpp brings all to the unknowns of both nodes.
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <cmath>

#include <hapbeam/element/rod/carried_frame.hpp>
#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/element/rod/twisted_core.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// What the first of the points finds is nothing.
template <typename S>
[[gnu::always_inline]] inline S first(int point, const S& sum) noexcept {
  return point == 0 ? S(0) : sum;
}

/// Stretch at both ends and in the middle; of what is taut at the ends (round_tension.hpp).
template <typename S>
[[gnu::always_inline]] inline void add_stretch(const RodProperties<S>& p, const CarriedFrame<S>& f,
                                               TwistedCore<S>& core, S& energy) noexcept {
  using std::sqrt;
  S e[3], N[3];
  const V3<S> a = f.middle();
  const S n = sqrt(a.squaredNorm()), i = 1 / n, EA = p.axial * p.length, middle = p.taut ? S(0) : EA;
  e[0] = f.l1 - 1 - p.natural_strain[0];
  e[1] = p.taut ? S(0) : S(n - 1 - p.natural_strain[1]);
  e[2] = f.l2 - 1 - p.natural_strain[2];
  for (int r = 0; r < 3; ++r) {
    const auto& M = quadratic_mass[r];
    N[r] = (r == 1 ? middle : EA) * (S(M[0]) * e[0] + S(M[1]) * e[1] + S(M[2]) * e[2]);
    energy += N[r] * e[r] / 2;
  }
  const V3<S> v = a * i;
  const S w = S(1.5), w1 = S(-0.25);
  // By (Δ, |r1'|, r2'): ε at the middle and at node 2.
  const S R[7] = {w * v[0], w * v[1], w * v[2], w1 * v[2], w1 * v[0], w1 * v[1], w1 * v[2]};
  const S m0 = EA * S(quadratic_mass[0][0]), m1 = middle * S(quadratic_mass[1][1]),
          c01 = middle * S(quadratic_mass[0][1]), c02 = EA * S(quadratic_mass[0][2]);
  for (int r = 0; r < 7; ++r) core.g[r] = N[1] * R[r];
  core.g[3] += N[0];
  for (int k = 0; k < 3; ++k) core.g[4 + k] += N[2] * f.v[k];
  // The middle's second derivative is N (I - vvᵀ)/n: its last part joins the product of gradients.
  const S bend = N[1] * i, mm = m1 - bend;
  for (int r = 0; r < 7; ++r)
    for (int c = 0; c <= r; ++c) core.H[r][c] = mm * R[r] * R[c];
  for (int k = 0; k < 3; ++k) {
    core.H[k][k] += bend * w * w;
    core.H[4 + k][4 + k] += bend * w1 * w1;
    core.H[4 + k][k] += bend * w * w1;
  }
  core.H[3][2] += bend * w * w1;
  core.H[6][3] += bend * w1 * w1;
  core.H[3][3] += bend * w1 * w1 + m0;
  // Node 1 with the middle and with node 2, node 2 with the middle and itself.
  for (int c = 0; c < 7; ++c) {
    if (c < 3) core.H[3][c] += c01 * R[c];
    if (c == 3) core.H[3][3] += 2 * c01 * R[3];
    if (c > 3) core.H[c][3] += c01 * R[c];
  }
  const S straight = N[2] / f.l2, vv = m0 - straight;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) core.H[4 + r][c] += c01 * f.v[r] * R[c];
    core.H[4 + r][3] += c02 * f.v[r];
    for (int c = 0; c <= r; ++c)
      core.H[4 + r][4 + c] += c01 * (f.v[r] * R[4 + c] + R[4 + r] * f.v[c]) + vv * f.v[r] * f.v[c];
    core.H[4 + r][4 + r] += straight;
  }
}

/// Bending and twist at a Gauss point.
template <int G, typename S>
[[gnu::flatten]] inline void add_point(const RodProperties<S>& p, const CarriedFrame<S>& f, const S& psi,
                                       TwistedCore<S>& core, S& energy) noexcept {
  constexpr double x = two_points.x[G];
  constexpr CubicAt w(x);
  const auto& at = p.points[G];
  const S weight = S(two_points.weight[G]), i1 = p.inverse_length, m = f.mismatch;
  const CarriedPoint<S> q(f, w);
  // θ and θ' l by φ1, φ2 + m, ψ
  constexpr double t[3] = {1 - x, x, 4 * x * (1 - x)}, d[3] = {-1, 1, 4 * (1 - 2 * x)};
  const S theta = S(t[1]) * m + S(t[2]) * psi;
  S co, si;
  cos_and_sin(theta, co, si);
  const S k1 = co * q.K1 + si * q.K2, k2 = co * q.K2 - si * q.K1, tau = m + S(d[2]) * psi - q.c;
  const S e1 = k1 * i1 - at.natural[0], e2 = k2 * i1 - at.natural[1], e3 = tau * i1 - at.natural[2];
  const S EI1 = weight * at.bending1, EI2 = weight * at.bending2, wGJ = weight * at.torsion;
  const S m1 = EI1 * e1, m2 = EI2 * e2, T = wGJ * e3, E1 = EI1 * i1, E2 = EI2 * i1, GJ = wGJ * i1;
  energy += p.length * (m1 * e1 + m2 * e2 + T * e3) / 2;
  const S M1 = co * m1 - si * m2, M2 = si * m1 + co * m2;

  const S X = q.a[0], Y = q.a[1], i = q.i, h = q.h;
  const V3<S>&a = q.a, &b = q.b, &v = q.v;
  const S vb = v.dot(b);
  const V3<S> wa = (b - vb * v) * i;  // ∂w/∂a
  V3<S> Da = a * (2 + v[2]);          // ∂D/∂a
  Da[2] += q.n;
  const V3<S> ha = -h * h * Da;  // ∂h/∂a
  V3<S> vz = v;                  // ∂w/∂b
  vz[2] += 1;
  const S g = q.w * h, ii = i * i;
  const V3<S> ga = h * wa + q.w * ha;  // ∂g/∂a
  V3<S> K1a = b[1] * ii * v + Y * ga, K2a = -b[0] * ii * v - X * ga, ca = q.C * ha;
  K1a[1] += g, K2a[0] -= g, ca[0] += h * b[1], ca[1] -= h * b[0];
  V3<S> K1b = Y * h * vz, K2b = -X * h * vz;
  K1b[1] -= i, K2b[0] += i;
  const V3<S> cb(-h * Y, h * X, 0);

  // In the section's axes, by (Δ, |r1'|, r2').
  S R1[7], R2[7], R3[7];
  const V3<S> k1a = co * K1a + si * K2a, k1b = co * K1b + si * K2b, k2a = co * K2a - si * K1a,
              k2b = co * K2b - si * K1b;
  const auto share = [](double alpha, const S& by_a, double beta, const S& by_b) {
    S sum = S(alpha) * by_a;
    add_share(sum, beta, by_b);
    return sum;
  };
  const auto chain = [&](const V3<S>& by_a, const V3<S>& by_b, S(&R)[7]) {
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k) {
      R[k] = share(w.a, by_a[k], w.b, by_b[k]);
      R[4 + k] = share(w.a2, by_a[k], w.b2, by_b[k]);
    }
    R[3] = share(w.a1, by_a[2], w.b1, by_b[2]);
  };
  chain(k1a, k1b, R1);
  chain(k2a, k2b, R2);
  chain(ca, cb, R3);
  // θ turns both curvatures into each other; what it makes of them and of itself; τ has -R3.
  const S by1 = E1 * k2 - m2, by2 = m1 - E2 * k1, own = k2 * by1 - k1 * by2, moment = m1 * k2 - m2 * k1;
  HAPBEAM_UNROLL
  for (int r = 0; r < 7; ++r) {
    const S s1 = E1 * R1[r], s2 = E2 * R2[r], s3 = GJ * R3[r], turned = by1 * R1[r] + by2 * R2[r];
    core.g[r] = add_product(add_product(add_product(core.g[r], m1, R1[r]), m2, R2[r]), -T, R3[r]);
    HAPBEAM_UNROLL
    for (int c = 0; c <= r; ++c)
      core.H[r][c] = add_product(add_product(add_product(core.H[r][c], s1, R1[c]), s2, R2[c]), s3, R3[c]);
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k) {
      S& H = core.H[7 + k][r];
      H = first(G, H);
      add_share(H, t[k], turned), add_share(H, -d[k], s3);
    }
  }
  HAPBEAM_UNROLL
  for (int k = 0; k < 3; ++k) {
    S& gradient = core.g[7 + k];
    gradient = first(G, gradient);
    add_share(gradient, t[k], moment), add_share(gradient, d[k], T);
    HAPBEAM_UNROLL
    for (int c = 0; c <= k; ++c) {
      S& H = core.H[7 + k][7 + c];
      H = first(G, H);
      add_share(H, t[k] * t[c], own), add_share(H, d[k] * d[c], GJ);
    }
  }
  // M1 K1 + M2 K2 - T c = Q/n + h F with F = P w - T C, by a twice and by a and b.
  const S Q = M2 * b[0] - M1 * b[1], P = M1 * Y - M2 * X, F = P * q.w - T * q.C;
  const V3<S> Pa(-M2, M1, 0);
  V3<S> Fa = q.w * Pa + P * wa;
  Fa[0] -= T * b[1], Fa[1] += T * b[0];
  V3<S> Fb = P * vz;
  Fb[0] += T * Y, Fb[1] -= T * X;
  const S cubed = Q * ii * i, hh = h * h, hw = h * P * ii;
  // ∇²h = 2h³ DaDaᵀ - h² (2I + vẑᵀ + ẑvᵀ + z (I - vvᵀ)/n),  ∇²w = (3 v·b vvᵀ - v·b I - bvᵀ - vbᵀ)/n²
  //   by a twice:  Da qᵀ + v pᵀ + hPa waᵀ, and what they are transposed, and a diagonal;   by a and b:  ha Fbᵀ + v sᵀ + hPa vzᵀ
  const S on_diagonal = -cubed - F * hh * (2 + v[2]) - hw * vb, hP0 = h * Pa[0], hP1 = h * Pa[1],
          hPi = h * P * i, vv = (3 * cubed + F * hh * v[2] + 3 * hw * vb) * S(0.5);
  const V3<S> q_Da = (F * hh * h) * Da - hh * Fa,
              s_v(ii * Pa[0] - hPi * v[0], ii * Pa[1] - hPi * v[1], -hPi * v[2]);
  V3<S> p_v = vv * v - hw * b;
  p_v[2] -= F * hh;
  S Aa[3][3], Ab[3][3];
  HAPBEAM_UNROLL
  for (int r = 0; r < 3; ++r) {
    HAPBEAM_UNROLL
    for (int c = 0; c <= r; ++c) {
      S sum = r == c ? S(on_diagonal + 2 * (Da[r] * q_Da[r] + v[r] * p_v[r]))
                     : S(Da[r] * q_Da[c] + q_Da[r] * Da[c] + v[r] * p_v[c] + p_v[r] * v[c]);
      if (r < 2) sum = add_product(sum, r == 0 ? hP0 : hP1, wa[c]);
      if (c < 2) sum = add_product(sum, c == 0 ? hP0 : hP1, wa[r]);
      Aa[r][c] = Aa[c][r] = sum;
    }
    HAPBEAM_UNROLL
    for (int c = 0; c < 3; ++c) {
      Ab[r][c] = ha[r] * Fb[c] + v[r] * s_v[c];
      if (r < 2) Ab[r][c] = add_product(Ab[r][c], r == 0 ? hP0 : hP1, vz[c]);
    }
    Ab[r][r] += hPi;
  }
  Ab[0][1] -= h * T, Ab[1][0] += h * T;
  HAPBEAM_UNROLL
  for (int r = 0; r < 3; ++r) {
    HAPBEAM_UNROLL
    for (int c = 0; c <= r; ++c) {
      const S both = Ab[r][c] + Ab[c][r];
      add_share(core.H[r][c], w.a * w.a, Aa[r][c]), add_share(core.H[r][c], w.a * w.b, both);
      add_share(core.H[4 + r][4 + c], w.a2 * w.a2, Aa[r][c]);
      add_share(core.H[4 + r][4 + c], w.a2 * w.b2, both);
    }
    HAPBEAM_UNROLL
    for (int c = 0; c < 3; ++c) {
      S& H = core.H[4 + r][c];
      add_share(H, w.a * w.a2, Aa[r][c]), add_share(H, w.b * w.a2, Ab[r][c]);
      add_share(H, w.a * w.b2, Ab[c][r]);
    }
    add_share(core.H[3][r], w.a * w.a1, Aa[2][r]), add_share(core.H[3][r], w.a * w.b1, Ab[r][2]);
    add_share(core.H[3][r], w.b * w.a1, Ab[2][r]);
    S& H = core.H[4 + r][3];
    add_share(H, w.a1 * w.a2, Aa[2][r]), add_share(H, w.a2 * w.b1, Ab[r][2]);
    add_share(H, w.b2 * w.a1, Ab[2][r]);
  }
  add_share(core.H[3][3], w.a1 * w.a1, Aa[2][2]), add_share(core.H[3][3], 2 * w.a1 * w.b1, Ab[2][2]);
}

/// Energy [J] and all derivatives.   @param psi  ψ   @param core  out
template <typename S>
inline S respond(const RodProperties<S>& p, const CarriedFrame<S>& f, S psi, TwistedCore<S>& core) noexcept {
  S energy = 0;
  add_stretch(p, f, core, energy);
  add_point<0>(p, f, psi, core, energy), add_point<1>(p, f, psi, core, energy);
  return energy;
}

}  // namespace hapbeam::detail
