// SPDX-License-Identifier: MIT
// Transforms energy derivatives of an element that twists from the axes of its first node to the unknowns of both
// nodes. The element's own twist is condensed, and the axes turn with that node.
//
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <hapbeam/element/rod/carried_frame.hpp>
#include <hapbeam/element/rod/rod_tangent.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// Gradient and Hessian in (Δ/l, |r1'|, r2', φ1, φ2 + m, ψ), node 1's axes.
template <typename S>
struct TwistedCore {
  S g[10];
  S H[10][10];  // lower triangle
};

/// From the core to the unknowns of both nodes, ψ condensed away.  Row by row, in an order in which little waits for the rest.
template <typename S, class Inner>
HAPBEAM_ALIGNED_STACK [[gnu::flatten]] void expand(const CarriedFrame<S>& f, TwistedCore<S>& core,
                                                   const S& inverse_length, Inner& inner,
                                                   RodTangent<S, 4>& all) noexcept {
  using K = RodTangent<S, 4>;
  // ψ first: H - hhᵀ/k.
  const S* const g = core.g;
  const S* const h = core.H[9];
  inner.residual = g[9];
  inner.stiffness = h[9];
  const S share = 1 / h[9];
  // Then the turn, to Δ/l 0-2, r1' 3-5, r2' 6-8, φ1 9, φ2 10: r1' turns the axes, by ω = ẑ × r1'/λ.
  const S i1 = 1 / f.l1, i2 = 1 / f.l2, sigma = 1 + f.v[2], is = 1 / sigma;
  const V3<S>&D = f.chord, &t = f.t2, &v = f.v;
  const S kx = -v[1] * is, ky = v[0] * is, kx2 = i2 * kx, ky2 = i2 * ky;
  const auto by_turn = [&](const S* x, S* y) {
    y[0] = x[0], y[1] = x[1], y[2] = x[2];
    y[3] = i1 * (D[0] * x[2] - D[2] * x[0] + t[0] * x[6] - t[2] * x[4] + kx * x[8]);
    y[4] = i1 * (D[1] * x[2] - D[2] * x[1] + t[1] * x[6] - t[2] * x[5] + ky * x[8]);
    y[5] = x[3];
    y[6] = x[4] + kx2 * x[8], y[7] = x[5] + ky2 * x[8], y[8] = x[6];
    y[9] = x[7], y[10] = x[8];
  };
  const auto row = [&](int i, S(&y)[11]) {
    const S part = h[i] * share;
    S x[9];
    HAPBEAM_UNROLL
    for (int j = 0; j < 9; ++j) x[j] = (j < i ? core.H[i][j] : core.H[j][i]) - part * h[j];
    by_turn(x, y);
  };
  // And to the axes of space,  F x,  F B Fᵀ.
  const V3<S>&F0 = f.e1, &F1 = f.e2, &F2 = f.u;
  const auto out = [&](const S* x, auto&& put) {
    HAPBEAM_UNROLL
    for (int a = 0; a < 3; ++a) put(a, S(F0[a] * x[0] + F1[a] * x[1] + F2[a] * x[2]));
  };
  /// @param x, y, z  rows of a block   @param half  whether it is symmetric
  const auto block = [&](const S* x, const S* y, const S* z, bool half, auto&& put) {
    S once[3][3];  // B Fᵀ
    const S* const rows[3] = {x, y, z};
    HAPBEAM_UNROLL
    for (int a = 0; a < 3; ++a) out(rows[a], [&](int b, const S& value) { once[b][a] = value; });
    HAPBEAM_UNROLL
    for (int b = 0; b < 3; ++b) {
      HAPBEAM_UNROLL
      for (int a = half ? b : 0; a < 3; ++a)
        put(a, b, S(F0[a] * once[b][0] + F1[a] * once[b][1] + F2[a] * once[b][2]));
    }
  };
  const S &l = inverse_length, ll = l * l;
  const V3<S> gD(g[0], g[1], g[2]), g2(g[4], g[5], g[6]);

  S by_psi[11], G[11], condensed[9];
  by_turn(h, by_psi);
  out(by_psi, [&](int a, const S& x) { inner.row[7 + a] = l * x, inner.row[a] = -inner.row[7 + a]; });
  out(by_psi + 3, [&](int a, const S& x) { inner.row[3 + a] = x; });
  out(by_psi + 6, [&](int a, const S& x) { inner.row[10 + a] = x; });
  inner.row[6] = by_psi[9], inner.row[13] = by_psi[10];
  HAPBEAM_UNROLL
  for (int i = 0; i < 9; ++i) condensed[i] = g[i] - h[i] * share * g[9];
  by_turn(condensed, G);
  out(G, [&](int a, const S& x) { all.D[a] = l * x; });
  out(G + 3, [&](int a, const S& x) { all.t1[a] = x; });
  out(G + 6, [&](int a, const S& x) { all.t2[a] = x; });
  all.t1[3] = G[9], all.t2[3] = G[10];

  // φ1 and φ2.
  S A8[11];
  row(8, A8);
  out(A8, [&](int a, const S& x) { all.D2[9 + a] = l * x; });
  out(A8 + 3, [&](int a, const S& x) { all.K12[12 + a] = x; });
  out(A8 + 6, [&](int a, const S& x) { all.K22[K::template half<4>(3, a)] = x; });
  all.K12[15] = A8[9], all.K22[9] = A8[10];
  S A7[11];
  row(7, A7);
  out(A7, [&](int a, const S& x) { all.D1[9 + a] = l * x; });
  out(A7 + 3, [&](int a, const S& x) { all.K11[K::template half<4>(3, a)] = x; });
  out(A7 + 6, [&](int a, const S& x) { all.K12[4 * a + 3] = x; });
  all.K11[9] = A7[9];
  // The turn from the left, of what it makes of r1' from the right.
  S B33 = kx * A8[3], B43 = ky * A8[3], B44 = ky * A8[4];

  // Δ, and the second derivatives of the turn.
  S A0[11], A1[11], A2[11];
  row(0, A0), row(1, A1), row(2, A2);
  B33 += D[0] * A2[3] - D[2] * A0[3];
  B43 += D[1] * A2[3] - D[2] * A1[3];
  B44 += D[1] * A2[4] - D[2] * A1[4];
  A0[3] += i1 * gD[2], A1[4] += i1 * gD[2], A2[3] -= i1 * gD[0], A2[4] -= i1 * gD[1];
  block(A0, A1, A2, true, [&](int a, int b, const S& x) { all.DD[K::template half<3>(a, b)] = ll * x; });
  block(A0 + 3, A1 + 3, A2 + 3, false, [&](int a, int b, const S& x) { all.D1[3 * b + a] = l * x; });
  block(A0 + 6, A1 + 6, A2 + 6, false, [&](int a, int b, const S& x) { all.D2[3 * b + a] = l * x; });

  // Second derivatives of m: by r1' twice, by r2' twice, and by both.  With x, y, z of v, σ = 1 + z and k = (-y, x, 0)/σ they are the
  // symmetric parts of  -k (x/σ, y/σ, 2)ᵀ/|r1'|²,  -k (x/σ + x, y/σ + y, σ)ᵀ/|r2'|²,  and ½ ((u + v) × - k (x, y, σ) - (x, y, 0) kᵀ)/(σ|r1'||r2'|).
  const S gp = g[8], x = v[0], y = v[1], xy = x * y * is, squares = (x * x - y * y) * (is * S(0.5));
  // r2'
  S A4[11], A5[11], A6[11];
  row(4, A4), row(5, A5), row(6, A6);
  B33 += t[0] * A6[3] - t[2] * A4[3];
  B43 += t[1] * A6[3] - t[2] * A5[3];
  B44 += t[1] * A6[4] - t[2] * A5[4];
  HAPBEAM_UNROLL
  for (int j = 3; j < 9; ++j) A4[j] += kx2 * A8[j], A5[j] += ky2 * A8[j];
  const S cross = gp * is * i1 * i2;
  A4[3] += i1 * g2[2] + cross * xy, A5[4] += i1 * g2[2] - cross * xy;
  A5[3] -= cross * (squares + S(0.5) * sigma), A4[4] += cross * (S(0.5) * sigma - squares);
  A6[3] += cross * y - i1 * g2[0], A6[4] -= cross * x + i1 * g2[1];
  block(A4 + 3, A5 + 3, A6 + 3, false, [&](int a, int b, const S& z) { all.K12[4 * a + b] = z; });
  const S p2 = gp * i2 * i2, q2 = p2 * (1 + is);
  A4[6] += q2 * xy, A5[7] -= q2 * xy, A5[6] -= q2 * squares;
  A6[6] += S(0.5) * p2 * y, A6[7] -= S(0.5) * p2 * x;
  A4[7] = A5[6], A4[8] = A6[6], A5[8] = A6[7];
  block(A4 + 6, A5 + 6, A6 + 6, true,
        [&](int a, int b, const S& z) { all.K22[K::template half<4>(a, b)] = z; });

  // r1'
  S A3[11];
  row(3, A3);
  const S ii = i1 * i1, p1 = gp * ii * is;
  const S along = i1 * g[3] - ii * (D.dot(gD) + t.dot(g2));
  const S last[3] = {A3[3] + p1 * y + ii * (D[2] * gD[0] - D[0] * gD[2] + t[2] * g2[0] - t[0] * g2[2]),
                     A3[4] - p1 * x + ii * (D[2] * gD[1] - D[1] * gD[2] + t[2] * g2[1] - t[1] * g2[2]),
                     A3[5]};
  B33 = i1 * B33 + ii * (D[1] * gD[1] + t[1] * g2[1]) + along + p1 * xy;
  B44 = i1 * B44 + ii * (D[0] * gD[0] + t[0] * g2[0]) + along - p1 * xy;
  B43 = i1 * B43 - ii * S(0.5) * (D[1] * gD[0] + D[0] * gD[1] + t[1] * g2[0] + t[0] * g2[1]) - p1 * squares;
  const S first[3] = {B33, B43, last[0]}, second[3] = {B43, B44, last[1]};
  block(first, second, last, true, [&](int a, int b, const S& z) { all.K11[K::template half<4>(a, b)] = z; });
}

}  // namespace hapbeam::detail
