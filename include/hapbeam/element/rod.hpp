// SPDX-License-Identifier: MIT
// The element of a naturally straight round rod whose ends do not hold its twist: no rotation, no frame.
//
//   V = ½ l εᵀ EA M ε + ½ l Σ w EI |r′ × r″|²/|r′|⁴        sum over three Gauss points
//
// Centreline: the cubic of rod_properties.hpp.  ε = |r′| - 1 at ξ = 0, ½, 1, interpolated (M): integrated fully it locks, and its
// mean leaves a mechanism.  The curvature is a function of three numbers, A = r′·r′, B = r″·r″, C = r′·r″:
//
//   κ² = B/A - C²/A²
//
// Unknowns are places and tangents, which are added: no large rotation, and the tangent matrix is symmetric everywhere.
// A bent round rod that is elastic and whose ends do not hold its twist has none; so this is exact for what TwistedRod solves with one more
// unknown a node.  Right while a tangent turns by less than half a turn from one end of an element to the other.
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <cmath>

#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/element/rod/rod_tangent.hpp>
#include <hapbeam/element/rod/round_tension.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam {

struct RoundRod {
  static constexpr int dimension = 3;
  static constexpr bool any_rotation = true;
  static constexpr int unknowns = 6;  ///< of a node: r, r'
  static constexpr const char* name() noexcept { return "round-rod"; }

  template <typename S>
  using Vector12 = Eigen::Matrix<S, 12, 1>;
  template <typename S>
  using Matrix12 = Eigen::Matrix<S, 12, 12>;

  /// N, of one that is taut.
  template <typename S>
  using Inner = detail::RodInners<S, unknowns>;

  /// Residual and tangent.
  /// @param r  out [N, N·m of r']   @param K  out, symmetric, both triangles   @return V [J]
  template <typename S>
  static S tangent(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2, Inner<S>& inner,
                   Vector12<S>& r, Matrix12<S>& K) noexcept {
    RodTangent<S, 3> core;
    const S energy = tangent(p, n1, n2, inner, core);
    core.expand(r, K);
    return energy;
  }
  /// The same, each derivative once.
  template <typename S>
  HAPBEAM_ALIGNED_STACK [[gnu::flatten]] static S tangent(const RodProperties<S>& p, const RodNode<S>& n1,
                                                          const RodNode<S>& n2, Inner<S>& inner,
                                                          RodTangent<S, 3>& to) noexcept {
    return respond(p, n1, n2, detail::EndsAndMiddle<S>(p, n1, n2), inner.tension, to);
  }
  /// The same, of all but φ where an element has it.
  template <typename S, int M>
  [[gnu::always_inline]] static S respond(const RodProperties<S>& p, const RodNode<S>& n1,
                                          const RodNode<S>& n2, const detail::EndsAndMiddle<S>& at,
                                          detail::RodInner<S, 3 + M>& tension_of,
                                          RodTangent<S, M>& to) noexcept {
    const V3<S>&t1 = n1.tangent, &t2 = n2.tangent, &m = at.middle;
    V3<S> e, low, high, to_low, to_high;
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      e[r] = S(half_g) * (t2[r] - t1[r]);
      const S mean = detail::add_product(S(S(0.4) * m[r]), S(0.3), S(t1[r] + t2[r])), half = S(0.5) * e[r],
              w = mean - m[r];
      low[r] = mean - e[r], high[r] = mean + e[r], to_low[r] = half - w, to_high[r] = half + w;
    }
    const S before = low.squaredNorm(), behind = high.squaredNorm(), both = 1 / (before * behind);
    const detail::RoundBend<S> bends[points] = {
        detail::RoundBend<S>(p, 0, 4, low, to_low, S(behind * both)),
        detail::RoundBend<S>(p, 1, 1, m, e, S(at.inverse[1] * at.inverse[1])),
        detail::RoundBend<S>(p, 2, 4, high, to_high, S(before * both))};
    const detail::RoundStretch<S> stretch(p, at);
    collect(bends, stretch, p.inverse_length, to);
    const S energy = stretch.energy + (bends[0].energy + bends[1].energy + bends[2].energy);
    if (!p.taut) return energy;
    const detail::RoundTension<S> tension(p, at, tension_of.value);
    tension.add(p.inverse_length, tension_of, to);
    return energy + tension.energy();
  }

 private:
  static constexpr int points = 3;
  template <typename S>
  using V3 = VectorOf<S, 3>;

  static constexpr double half_g = detail::half_g;

  /// All derivatives, by Δ and by both tangents.  With m, r' in the middle, s = r1' + r2' and e = half_g (r2' - r1'),
  //   r' = m,       r'' ~ e               in the middle, and at the outer points
  //   r' = p ± e,   r'' ~ e ± 2 (p - m),   p = 0.6 Δ/l + 0.2 s,   m = 1.5 Δ/l - 0.25 s
  // Even and odd parts of both outer points give the derivatives by p, m and e.
  template <typename S, int M>
  [[gnu::always_inline]] static void collect(const detail::RoundBend<S> (&at)[points],
                                             const detail::RoundStretch<S>& stretch, const S& i,
                                             RodTangent<S, M>& to) noexcept {
    using detail::add_product;
    // Where the lower triangle has (i, j), i >= j.
    const auto half = [](int row, int col) { return RodTangent<S, M>::template half<M>(row, col); };
    const detail::RoundBend<S>&low = at[0], &mid = at[1], &high = at[2];
    const V3<S>&u = stretch.u, &m = stretch.m, &v = stretch.v;
    const S ii = i * i, in_D = S(1.5) * i * stretch.beside, in_t = S(-0.25) * stretch.beside;
    V3<S> md, mt, ut, vt, vk, own;
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      md[r] = in_D * m[r], mt[r] = in_t * m[r], own[r] = stretch.own[1] * m[r];
      ut[r] = add_product(mt[r], stretch.own[0], u[r]);
      vt[r] = add_product(mt[r], stretch.own[2], v[r]);
      vk[r] = add_product(mt[r], stretch.across, v[r]);
      const S by_w = high.by_b[r] - low.by_b[r], by_p = (high.by_a[r] + low.by_a[r]) + by_w;
      const S by_m = add_product(S(mid.by_a[r] - by_w), stretch.N[1], m[r]);
      const S by_e = S(half_g) * add_product(S((high.by_a[r] - low.by_a[r]) + mid.by_b[r]), S(0.5),
                                             S(high.by_b[r] + low.by_b[r]));
      to.D[r] = i * add_product(S(S(0.6) * by_p), S(1.5), by_m);
      const S by_s = add_product(S(S(0.2) * by_p), S(-0.25), by_m);
      to.t1[r] = add_product(S(by_s - by_e), stretch.N[0], u[r]);
      to.t2[r] = add_product(S(by_s + by_e), stretch.N[2], v[r]);
    }
    HAPBEAM_UNROLL
    for (int col = 0; col < 3; ++col) {
      HAPBEAM_UNROLL
      for (int row = col; row < 3; ++row) {
        const bool one = row == col;
        const S a0 = low.aa(row, col), a2 = high.aa(row, col), aa = a2 + a0, da = a2 - a0;
        const S b0 = low.bb(row, col), b2 = high.bb(row, col), bb = b2 + b0, db = b2 - b0;
        // Where two differ, (row, col) first and (col, row) behind it.
        S ab[2], dab[2], of_mid[2];
        HAPBEAM_UNROLL
        for (int k = 0; k < 2; ++k) {
          if (one && k == 1) {
            ab[k] = ab[0], dab[k] = dab[0], of_mid[k] = of_mid[0];
            continue;
          }
          const int r = k == 0 ? row : col, s = k == 0 ? col : row;
          const S first = low.ab(r, s), last = high.ab(r, s);
          ab[k] = last + first, dab[k] = last - first, of_mid[k] = mid.ab(r, s);
        }
        const S mixed = dab[0] + dab[1], pp = (aa + bb) + mixed;
        S middle = add_product(mid.aa(row, col), own[row], m[col]) + bb;
        if (one) middle += stretch.turn[1];
        // By p and m, with the sign turned, and by e.
        S pm[2], by_e[2], s_e[2], q_s[2];
        const S both = add_product(S(S(0.12) * pp), S(-0.375), middle);
        HAPBEAM_UNROLL
        for (int k = 0; k < 2; ++k) pm[k] = dab[k] + bb;
        HAPBEAM_UNROLL
        for (int k = 0; k < 2; ++k) {
          if (one && k == 1) {
            by_e[k] = by_e[0], s_e[k] = s_e[0], q_s[k] = q_s[0];
            continue;
          }
          const S pe = add_product(S(da + ab[1 - k]), S(0.5), S(ab[k] + db)),
                  me = add_product(S(of_mid[k] - ab[1 - k]), S(-0.5), db);
          by_e[k] = add_product(S(S(0.6 * half_g) * pe), S(1.5 * half_g), me);
          s_e[k] = add_product(S(S(0.2 * half_g) * pe), S(-0.25 * half_g), me);
          q_s[k] = one ? add_product(both, S(-0.15), pm[k])
                       : add_product(add_product(both, S(0.15), pm[k]), S(-0.3), pm[1 - k]);
        }
        const S crossed = pm[0] + pm[1];
        to.DD[RodTangent<S, M>::template half<3>(row, col)] =
            ii * add_product(add_product(S(S(0.36) * pp), S(-0.9), crossed), S(2.25), middle);
        const int h = half(row, col), place[2] = {3 * col + row, 3 * row + col};
        HAPBEAM_UNROLL
        for (int k = 0; k < 2; ++k) {
          if (one && k == 1) continue;
          const int r = k == 0 ? row : col, c = k == 0 ? col : row;
          to.D1[place[k]] = add_product(S(i * (q_s[k] - by_e[k])), md[r], u[c]);
          to.D2[place[k]] = add_product(S(i * (q_s[k] + by_e[k])), md[r], v[c]);
        }
        const S ss = add_product(add_product(S(S(0.04) * pp), S(0.05), crossed), S(0.0625), middle);
        const S ee = S(half_g * half_g) *
                     add_product(add_product(S(aa + mid.bb(row, col)), S(0.5), mixed), S(0.25), bb);
        const S sum = ss + ee, less = ss - ee, even = s_e[0] + s_e[1];
        S K11 = sum - even, K22 = sum + even;
        K11 = add_product(add_product(K11, ut[row], u[col]), u[row], mt[col]);
        K22 = add_product(add_product(K22, vt[row], v[col]), v[row], mt[col]);
        to.K11[h] = one ? S(K11 + stretch.turn[0]) : K11;
        to.K22[h] = one ? S(K22 + stretch.turn[2]) : K22;
        const S odd = s_e[0] - s_e[1];
        HAPBEAM_UNROLL
        for (int k = 0; k < 2; ++k) {
          if (one && k == 1) continue;
          const int r = k == 0 ? row : col, s = k == 0 ? col : row;
          const S alone = one ? less : k == 0 ? S(less + odd) : S(less - odd);
          to.K12[M * s + r] = add_product(add_product(alone, mt[r], v[s]), u[r], vk[s]);
        }
      }
    }
  }
};

}  // namespace hapbeam
