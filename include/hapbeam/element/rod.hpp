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
// A bent round rod whose ends do not hold its twist has none; so this is exact for what TwistedRod solves with one more
// unknown a node.  Right while a tangent turns by less than half a turn from one end of an element to the other.
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <cmath>

#include <hapbeam/element/rod_properties.hpp>
#include <hapbeam/element/rod_tangent.hpp>
#include <hapbeam/unroll.hpp>

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

  /// No unknown is the element's own.
  template <typename S>
  struct Inner {
    S energy() const noexcept { return 0; }
    void advance(const Vector12<S>&) noexcept {}
  };

  template <typename S>
  static S energy(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2,
                  const Inner<S>&) noexcept {
    const V3<S> chord = n2.r - n1.r;
    S sum = 0, axial = 0;
    for (int g = 0; g < points; ++g) {
      const detail::CubicWeights<S> w(S(rule.x[g]), p.inverse_length);
      const V3<S> a = w.a * chord + w.a1 * n1.tangent + w.a2 * n2.tangent,
                  b = w.b * chord + w.b1 * n1.tangent + w.b2 * n2.tangent;
      const S A = 1 / a.squaredNorm(), C = a.dot(b) * A;
      sum += S(rule.weight[g]) * p.points[g].bending1 * (b.squaredNorm() * A - C * C);
    }
    const detail::EndsAndMiddle<S> at(p, n1, n2);
    const S e[3] = {at.n[0] - 1, at.n[1] - 1, at.n[2] - 1};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) axial += S(detail::quadratic_mass[i][j]) * e[i] * e[j];
    return p.length * (sum + p.axial * axial) / 2;
  }

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
                                                          const RodNode<S>& n2, Inner<S>&,
                                                          RodTangent<S, 3>& to) noexcept {
    return respond(p, n1, n2, detail::EndsAndMiddle<S>(p, n1, n2), to);
  }
  /// The same, of all but φ where an element has it.
  template <typename S, int M>
  [[gnu::always_inline]] static S respond(const RodProperties<S>& p, const RodNode<S>& n1,
                                          const RodNode<S>& n2, const detail::EndsAndMiddle<S>& at,
                                          RodTangent<S, M>& to) noexcept {
    const V3<S>&t1 = n1.tangent, &t2 = n2.tangent, &c = at.middle;
    const V3<S> chord = p.inverse_length * (n2.r - n1.r), sum = t1 + t2;
    const V3<S> e1 = S(half_g) * (t2 - t1), e2 = S(0.45) * sum - S(0.9) * chord;
    const V3<S> low = c - e1 + e2, high = c + e1 + e2;
    const S before = low.squaredNorm(), behind = high.squaredNorm(), both = 1 / (before * behind);
    const Bend<S> bends[points] = {Bend<S>(p, 0, low, V3<S>(e1 - 2 * e2), S(behind * both)),
                                   Bend<S>(p, 1, c, e1, S(at.inverse[1] * at.inverse[1])),
                                   Bend<S>(p, 2, high, V3<S>(e1 + 2 * e2), S(before * both))};
    const Stretch<S> stretch(p, at);
    collect(bends, stretch, p.inverse_length, to);
    return stretch.energy + (bends[0].energy + bends[1].energy + bends[2].energy);
  }

 private:
  static constexpr int points = 3;
  static constexpr const detail::GaussRule& rule = detail::three_points;
  template <typename S>
  using V3 = VectorOf<S, 3>;

  /// √(3/5)/2: Gauss points stand at ξ = ½ ± that, and in the middle.
  static constexpr double half_g = 0.38729833462074168852;

  /// k |a × b|²/|a|⁴ with a = r' and b ~ r'', and its derivatives.
  //   f = B/A - C²/A²,  A = a·a, B = b·b, C = a·b:
  //   ∂²f/∂a² = 2fA I + 4fAA aaᵀ + 2fAC (abᵀ + baᵀ) + fCC bbᵀ,   ∂²f/∂b² = 2fB I + fCC aaᵀ,
  //   ∂²f/∂a∂b = fC I + 4fAB abᵀ + 2fAC aaᵀ + fCC baᵀ
  template <typename S>
  struct Bend {
    S a[3], b[3], by_a[3], by_b[3], energy;
    S fA2, fB2, fC, x[3], y[3], z[3], u[3];

    /// @param i  1/A
    [[gnu::always_inline]] Bend(const RodProperties<S>& p, int g, const V3<S>& r1, const V3<S>& r2,
                                const S& i) noexcept {
      using detail::add_product;
      const S B = r2.squaredNorm() * i, c = r1.dot(r2) * i, cc = c * c;
      // r'' is 2/(2 half_g) times b/l.
      const S k = S(rule.weight[g] / (2 * half_g * half_g)) * p.points[g].bending1 * p.inverse_length;
      energy = k * (B - cc);
      const S ki = k * i, fAA4 = 8 * ki * i * (B - 3 * cc), fAB4 = -4 * ki * i, fAC2 = 8 * ki * i * c,
              fCC = -2 * ki * i;
      fA2 = 2 * ki * (2 * cc - B), fB2 = 2 * ki, fC = -2 * ki * c;
      HAPBEAM_UNROLL
      for (int r = 0; r < 3; ++r) {
        a[r] = r1[r], b[r] = r2[r];
        by_a[r] = add_product(S(fA2 * a[r]), fC, b[r]), by_b[r] = add_product(S(fB2 * b[r]), fC, a[r]);
        x[r] = add_product(S(fAA4 * a[r]), fAC2, b[r]);
        y[r] = add_product(S(fAC2 * a[r]), fCC, b[r]);
        z[r] = fAB4 * a[r];
        u[r] = fCC * a[r];
      }
    }

    [[gnu::always_inline]] S aa(int r, int s) const noexcept { return entry(fA2, x, y, r, s); }
    /// By a_r and b_s.
    [[gnu::always_inline]] S ab(int r, int s) const noexcept { return entry(fC, y, z, r, s); }
    [[gnu::always_inline]] S bb(int r, int s) const noexcept {
      return r == s ? detail::add_product(fB2, u[r], a[s]) : S(u[r] * a[s]);
    }

   private:
    /// What stands on the diagonal, and f aᵀ + g bᵀ.
    [[gnu::always_inline]] S entry(const S& own, const S (&f)[3], const S (&g)[3], int r,
                                   int s) const noexcept {
      using detail::add_product;
      return r == s ? add_product(add_product(own, f[r], a[s]), g[r], b[s])
                    : add_product(S(f[r] * a[s]), g[r], b[s]);
    }
  };

  /// ½ l εᵀ EA M ε: its derivatives by r' in the middle, m, and at both ends, u and v, where it is not their directions that turn.
  template <typename S>
  struct Stretch {
    S energy = 0, N[3];
    V3<S> u, m, v;      // directions
    S turn[3], own[3];  // N/|r'|, and what stretches stiffen
    S beside, across;

    [[gnu::always_inline]] Stretch(const RodProperties<S>& p, const detail::EndsAndMiddle<S>& at) noexcept
        : u(at.v[0]), m(at.v[1]), v(at.v[2]) {
      const auto& M = detail::quadratic_mass;
      const S e[3] = {at.n[0] - 1, at.n[1] - 1, at.n[2] - 1}, EA = p.axial * p.length;
      HAPBEAM_UNROLL
      for (int i = 0; i < 3; ++i) {
        N[i] = EA * (S(M[i][0]) * e[0] + S(M[i][1]) * e[1] + S(M[i][2]) * e[2]);
        energy += N[i] * e[i] / 2;
        turn[i] = N[i] * at.inverse[i];
        own[i] = EA * S(M[i][i]) - turn[i];
      }
      beside = EA * S(M[0][1]), across = EA * S(M[0][2]);
    }
  };

  /// All of them, by Δ and by both tangents.  With q = 3/2 Δ/l, s = r1' + r2' and e = half_g (r2' - r1'),
  //   r' = q - s/4,   r'' ~ e                                    in the middle, and at the outer points
  //   r' = p ± e,     r'' ~ e ± w,    p = 0.4 q + 0.2 s,   w = 0.9 s - 1.2 q
  template <typename S, int M>
  [[gnu::always_inline]] static void collect(const Bend<S> (&at)[points], const Stretch<S>& stretch,
                                             const S& i, RodTangent<S, M>& to) noexcept {
    using detail::add_product;
    // Where the lower triangle has (i, j), i >= j.
    const auto half = [](int row, int col) { return RodTangent<S, M>::template half<M>(row, col); };
    const Bend<S>&low = at[0], &mid = at[1], &high = at[2];
    const V3<S>&u = stretch.u, &m = stretch.m, &v = stretch.v;
    const S by_D = S(1.5) * i, by_DD = by_D * by_D;
    const S in_D = S(1.5) * i * stretch.beside, in_t = S(-0.25) * stretch.beside;
    V3<S> md, mt, ut, vt, vk;
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      md[r] = in_D * m[r], mt[r] = in_t * m[r];
      ut[r] = add_product(mt[r], stretch.own[0], u[r]);
      vt[r] = add_product(mt[r], stretch.own[2], v[r]);
      vk[r] = add_product(mt[r], stretch.across, v[r]);
      const S both = high.by_a[r] + low.by_a[r], odd = high.by_a[r] - low.by_a[r];
      const S in_middle = add_product(mid.by_a[r], stretch.N[1], m[r]), by_w = high.by_b[r] - low.by_b[r];
      const S by_e = odd + (mid.by_b[r] + (high.by_b[r] + low.by_b[r]));
      to.D[r] = by_D * add_product(add_product(in_middle, S(0.4), both), S(-1.2), by_w);
      const S by_s = add_product(add_product(S(S(0.9) * by_w), S(0.2), both), S(-0.25), in_middle);
      to.t1[r] = add_product(add_product(by_s, S(-half_g), by_e), stretch.N[0], u[r]);
      to.t2[r] = add_product(add_product(by_s, S(half_g), by_e), stretch.N[2], v[r]);
    }
    HAPBEAM_UNROLL
    for (int col = 0; col < 3; ++col) {
      HAPBEAM_UNROLL
      for (int row = col; row < 3; ++row) {
        // Even and odd parts of both outer points.
        const bool one = row == col;
        const S a0 = low.aa(row, col), a2 = high.aa(row, col), aa = a2 + a0, da = a2 - a0;
        const S p0 = low.ab(row, col), p2 = high.ab(row, col), ab = p2 + p0, dab = p2 - p0;
        const S q0 = one ? p0 : low.ab(col, row), q2 = one ? p2 : high.ab(col, row), ba = q2 + q0,
                dba = q2 - q0;
        const S b0 = low.bb(row, col), b2 = high.bb(row, col), bb = b2 + b0, db = b2 - b0;
        // By q, s and e; where two differ, (row, col) first and (col, row) behind it.
        const S mixed = dab + dba, of_mid[2] = {mid.ab(row, col), one ? S(0) : mid.ab(col, row)};
        S middle = add_product(mid.aa(row, col), S(stretch.own[1] * m[row]), m[col]);
        if (one) middle += stretch.turn[1];
        const S qq = add_product(add_product(add_product(middle, S(0.16), aa), S(-0.48), mixed), S(1.44), bb);
        const S ss = add_product(add_product(add_product(S(S(0.0625) * middle), S(0.04), aa), S(0.18), mixed),
                                 S(0.81), bb);
        const S ee = (aa + mixed) + (bb + mid.bb(row, col));
        const S both = add_product(add_product(S(S(-0.25) * middle), S(0.08), aa), S(-1.08), bb);
        S qs[2], qe[2], se[2];
        HAPBEAM_UNROLL
        for (int k = 0; k < 2; ++k) {
          const S a_e = da + (k == 0 ? ab : ba), b_e = db + (k == 0 ? ba : ab);
          qs[k] = add_product(add_product(both, S(0.36), k == 0 ? dab : dba), S(-0.24), k == 0 ? dba : dab);
          qe[k] = add_product(add_product(of_mid[k], S(0.4), a_e), S(-1.2), b_e);
          se[k] = add_product(add_product(S(S(-0.25) * of_mid[k]), S(0.2), a_e), S(0.9), b_e);
        }
        const int h = half(row, col), place[2] = {3 * col + row, 3 * row + col};
        to.DD[RodTangent<S, M>::template half<3>(row, col)] = by_DD * qq;
        HAPBEAM_UNROLL
        for (int k = 0; k < 2; ++k) {
          if (one && k == 1) continue;
          const int r = k == 0 ? row : col, c = k == 0 ? col : row;
          to.D1[place[k]] = add_product(S(by_D * add_product(qs[k], S(-half_g), qe[k])), md[r], u[c]);
          to.D2[place[k]] = add_product(S(by_D * add_product(qs[k], S(half_g), qe[k])), md[r], v[c]);
        }
        const S sum = add_product(ss, S(half_g * half_g), ee),
                less = add_product(ss, S(-half_g * half_g), ee);
        const S even = one ? S(2 * se[0]) : S(se[0] + se[1]);
        S K11 = add_product(sum, S(-half_g), even), K22 = add_product(sum, S(half_g), even);
        K11 = add_product(add_product(K11, ut[row], u[col]), u[row], mt[col]);
        K22 = add_product(add_product(K22, vt[row], v[col]), v[row], mt[col]);
        to.K11[h] = one ? S(K11 + stretch.turn[0]) : K11;
        to.K22[h] = one ? S(K22 + stretch.turn[2]) : K22;
        const S odd = se[0] - se[1];
        HAPBEAM_UNROLL
        for (int k = 0; k < 2; ++k) {
          if (one && k == 1) continue;
          const int r = k == 0 ? row : col, s = k == 0 ? col : row;
          const S own = one ? less : add_product(less, S(k == 0 ? half_g : -half_g), odd);
          to.K12[M * s + r] = add_product(add_product(own, mt[r], v[s]), u[r], vk[s]);
        }
      }
    }
  }
};

}  // namespace hapbeam
