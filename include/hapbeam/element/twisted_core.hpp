// Transforms energy derivatives of an element that twists from the axes of its first node to the unknowns of both
// nodes. The element's own twist is condensed, and the axes turn with that node.
//
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <hapbeam/element/carried_frame.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

/// Gradient and Hessian in (Δ, |r1'|, r2', φ1, φ2 + m, ψ), node 1's axes.
template <typename S>
struct TwistedCore {
  S g[10];
  S H[10][10];  // lower triangle
};

/// From the core to the unknowns of both nodes, ψ condensed away.
template <typename S, class Inner, class Residual, class Tangent>
void expand(const CarriedFrame<S>& f, TwistedCore<S>& core, Inner& inner, Residual& r, Tangent& K) noexcept {
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
  // Then the turn, to Δ 0-2, r1' 3-5, r2' 6-8, φ1 9, φ2 10: r1' turns the axes, by ω = ẑ × r1'/λ.
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
  // To the axes of space.
  Eigen::Matrix<S, 3, 3> F;
  F.col(0) = f.e1, F.col(1) = f.e2, F.col(2) = f.u;
  const auto vector = [&F](const S* x) -> V3<S> { return F * V3<S>(x[0], x[1], x[2]); };
  const auto block = [&](int i, int j) -> Eigen::Matrix<S, 3, 3> {
    Eigen::Matrix<S, 3, 3> m;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) m(a, b) = B[i + a][j + b];
    return F * m * F.transpose();
  };
  const V3<S> rD = vector(G), r1 = vector(G + 3), r2 = vector(G + 6);
  r.template segment<3>(0) = -rD, r.template segment<3>(3) = r1, r[6] = G[9];
  r.template segment<3>(7) = rD, r.template segment<3>(10) = r2, r[13] = G[10];
  const Eigen::Matrix<S, 3, 3> DD = block(0, 0), D1 = block(0, 3), D2 = block(0, 6), b11 = block(3, 3),
                               b12 = block(3, 6), b22 = block(6, 6);
  const V3<S> Dp = vector(B[9]), Dq = vector(B[10]), p1v = vector(B[9] + 3), q1v = vector(B[10] + 3),
              p2v = vector(B[9] + 6), q2v = vector(B[10] + 6);
  const auto set = [&K](int i, int j, const Eigen::Matrix<S, 3, 3>& m) {
    K.template block<3, 3>(i, j) = m;
    if (i != j) K.template block<3, 3>(j, i) = m.transpose();
  };
  set(0, 0, DD), set(0, 7, -DD), set(7, 7, DD);
  set(0, 3, -D1), set(7, 3, D1), set(0, 10, -D2), set(7, 10, D2);
  set(3, 3, b11), set(3, 10, b12), set(10, 10, b22);
  const auto beside = [&K](int i, int j, const V3<S>& x) {
    K.template block<3, 1>(i, j) = x;
    K.template block<1, 3>(j, i) = x.transpose();
  };
  beside(0, 6, -Dp), beside(7, 6, Dp), beside(0, 13, -Dq), beside(7, 13, Dq);
  beside(3, 6, p1v), beside(3, 13, q1v), beside(10, 6, p2v), beside(10, 13, q2v);
  K(6, 6) = B[9][9], K(6, 13) = K(13, 6) = B[10][9], K(13, 13) = B[10][10];
  const V3<S> iD = vector(row), i1v = vector(row + 3), i2v = vector(row + 6);
  inner.row.template segment<3>(0) = -iD, inner.row.template segment<3>(3) = i1v, inner.row[6] = row[9];
  inner.row.template segment<3>(7) = iD, inner.row.template segment<3>(10) = i2v, inner.row[13] = row[10];
}

}  // namespace hapbeam::detail
