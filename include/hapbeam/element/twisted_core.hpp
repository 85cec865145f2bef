// Transforms energy derivatives of an element that twists from the axes of its first node to the unknowns of both
// nodes. The element's own twist is condensed, and the axes turn with that node.
//
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <hapbeam/element/carried_frame.hpp>
#include <hapbeam/element/rod_tangent.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

/// Gradient and Hessian in (Δ/l, |r1'|, r2', φ1, φ2 + m, ψ), node 1's axes.
template <typename S>
struct TwistedCore {
  S g[10];
  S H[10][10];  // lower triangle
};

/// From the core to the unknowns of both nodes, ψ condensed away.
template <typename S, class Inner>
[[gnu::flatten]] void expand(const CarriedFrame<S>& f, TwistedCore<S>& core, const S& inverse_length,
                             Inner& inner, RodTangent<S, 4>& all) noexcept {
  // ψ first: H - hhᵀ/k, full.
  const S* const g = core.g;
  const S k_psi = core.H[9][9], share = 1 / k_psi;
  S H[9][9], condensed[9];
  HAPBEAM_UNROLL
  for (int i = 0; i < 9; ++i) {
    const S part = core.H[9][i] * share;
    condensed[i] = g[i] - part * g[9];
    HAPBEAM_UNROLL
    for (int j = 0; j <= i; ++j) H[i][j] = H[j][i] = core.H[i][j] - part * core.H[9][j];
  }
  inner.residual = g[9];
  inner.stiffness = k_psi;
  // Then the turn, to Δ/l 0-2, r1' 3-5, r2' 6-8, φ1 9, φ2 10: r1' turns the axes, by ω = ẑ × r1'/λ.
  const S i1 = 1 / f.l1, i2 = 1 / f.l2, sigma = 1 + f.v[2], is = 1 / sigma;
  const V3<S>&D = f.chord, &t = f.t2, &v = f.v;
  const S kx = -v[1] * is, ky = v[0] * is;
  const auto by_turn = [&](const S* x, S* y) {
    y[0] = x[0], y[1] = x[1], y[2] = x[2];
    y[3] = i1 * (D[0] * x[2] - D[2] * x[0] + t[0] * x[6] - t[2] * x[4] + kx * x[8]);
    y[4] = i1 * (D[1] * x[2] - D[2] * x[1] + t[1] * x[6] - t[2] * x[5] + ky * x[8]);
    y[5] = x[3];
    y[6] = x[4] + i2 * kx * x[8], y[7] = x[5] + i2 * ky * x[8], y[8] = x[6];
    y[9] = x[7], y[10] = x[8];
  };
  S A[9][11], At[11][9], B[11][11], G[11], row[11];
  by_turn(condensed, G);
  by_turn(core.H[9], row);
  HAPBEAM_UNROLL
  for (int i = 0; i < 9; ++i) by_turn(H[i], A[i]);
  HAPBEAM_UNROLL
  for (int i = 0; i < 9; ++i) {
    HAPBEAM_UNROLL
    for (int j = 0; j < 11; ++j) At[j][i] = A[i][j];
  }
  HAPBEAM_UNROLL
  for (int j = 0; j < 11; ++j) by_turn(At[j], B[j]);
  const V3<S> gD(g[0], g[1], g[2]), g2(g[4], g[5], g[6]);
  const S gl = g[3], gp = g[8];
  // Second derivatives of the turn.
  const auto add = [&B](int i, int j, S value) {
    B[i][j] += value;
    if (i != j) B[j][i] += value;
  };
  for (int k = 0; k < 2; ++k) {
    add(k, 3 + k, i1 * gD[2]), add(2, 3 + k, -i1 * gD[k]);
    add(6 + k, 3 + k, i1 * g2[2]), add(8, 3 + k, -i1 * g2[k]);
  }
  const S ii = i1 * i1, work = D.dot(gD) + t.dot(g2);
  const V3<S> N = detail::cross3(D, gD) + detail::cross3(t, g2);
  add(3, 3, ii * (D[1] * gD[1] + t[1] * g2[1] - work) + i1 * gl);
  add(4, 4, ii * (D[0] * gD[0] + t[0] * g2[0] - work) + i1 * gl);
  add(4, 3, -ii * (D[1] * gD[0] + D[0] * gD[1] + t[1] * g2[0] + t[0] * g2[1]) / 2);
  add(5, 3, ii * N[1]), add(5, 4, -ii * N[0]);
  // Those of m.
  const S k[3] = {kx, ky, 0}, q1[3] = {v[0] * is, v[1] * is, 2},
          q2[3] = {v[0] * is + v[0], v[1] * is + v[1], 1 + v[2]};
  const S half1 = -gp * ii / 2, half2 = -gp * i2 * i2 / 2, cross = gp * is * i1 * i2 / 2;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b <= a; ++b) {
      add(3 + a, 3 + b, half1 * (k[a] * q1[b] + k[b] * q1[a]));
      add(6 + a, 6 + b, half2 * (k[a] * q2[b] + k[b] * q2[a]));
    }
  const S z = v[2], p1[3] = {v[0], v[1], 0}, p2[3] = {-z * v[0], -z * v[1], 1 - z * z};
  const S turn[3][3] = {{0, -(1 + z), v[1]}, {1 + z, 0, -v[0]}, {-v[1], v[0], 0}};  // (u + v) ×
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      S value = turn[a][b] - sigma * k[a] * v[b] - k[a] * p2[b] - p1[a] * k[b];
      if (a == 2) value -= sigma * k[b];
      add(3 + a, 6 + b, cross * value);
    }
  // To the axes of space,  F x,  F B Fᵀ,  and to Δ.
  const V3<S>* const F[3] = {&f.e1, &f.e2, &f.u};
  const auto vector = [F](const S* x, auto&& put) {
    HAPBEAM_UNROLL
    for (int a = 0; a < 3; ++a) put(a, S((*F[0])[a] * x[0] + (*F[1])[a] * x[1] + (*F[2])[a] * x[2]));
  };
  const auto block = [&](int i, int j, bool symmetric, auto&& put) {
    S half[3][3];  // B Fᵀ
    HAPBEAM_UNROLL
    for (int a = 0; a < 3; ++a) vector(B[i + a] + j, [&](int b, const S& value) { half[b][a] = value; });
    HAPBEAM_UNROLL
    for (int b = 0; b < 3; ++b) {
      HAPBEAM_UNROLL
      for (int a = 0; a < 3; ++a)
        if (a >= b || !symmetric)
          put(a, b, S((*F[0])[a] * half[b][0] + (*F[1])[a] * half[b][1] + (*F[2])[a] * half[b][2]));
    }
  };
  using K = RodTangent<S, 4>;
  const S& l = inverse_length;
  const S ll = l * l;
  vector(G, [&](int a, const S& x) { all.D[a] = l * x; });
  vector(G + 3, [&](int a, const S& x) { all.t1[a] = x; });
  vector(G + 6, [&](int a, const S& x) { all.t2[a] = x; });
  all.t1[3] = G[9], all.t2[3] = G[10];
  block(0, 0, true, [&](int a, int b, const S& x) { all.DD[K::template half<3>(a, b)] = ll * x; });
  block(3, 3, true, [&](int a, int b, const S& x) { all.K11[K::template half<4>(a, b)] = x; });
  block(6, 6, true, [&](int a, int b, const S& x) { all.K22[K::template half<4>(a, b)] = x; });
  block(0, 3, false, [&](int a, int b, const S& x) { all.D1[3 * b + a] = l * x; });
  block(0, 6, false, [&](int a, int b, const S& x) { all.D2[3 * b + a] = l * x; });
  block(3, 6, false, [&](int a, int b, const S& x) { all.K12[4 * b + a] = x; });
  vector(B[9], [&](int a, const S& x) { all.D1[9 + a] = l * x; });
  vector(B[10], [&](int a, const S& x) { all.D2[9 + a] = l * x; });
  vector(B[9] + 3, [&](int a, const S& x) { all.K11[K::template half<4>(3, a)] = x; });
  vector(B[10] + 3, [&](int a, const S& x) { all.K12[12 + a] = x; });
  vector(B[9] + 6, [&](int a, const S& x) { all.K12[4 * a + 3] = x; });
  vector(B[10] + 6, [&](int a, const S& x) { all.K22[K::template half<4>(3, a)] = x; });
  all.K11[9] = B[9][9], all.K22[9] = B[10][10], all.K12[15] = B[10][9];
  vector(row, [&](int a, const S& x) { inner.row[7 + a] = l * x, inner.row[a] = -inner.row[7 + a]; });
  vector(row + 3, [&](int a, const S& x) { inner.row[3 + a] = x; });
  vector(row + 6, [&](int a, const S& x) { inner.row[10 + a] = x; });
  inner.row[6] = row[9], inner.row[13] = row[10];
}

}  // namespace hapbeam::detail
