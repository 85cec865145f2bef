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
    using std::sqrt;
    const V3<S> chord = n2.r - n1.r;
    S sum = 0, axial = 0;
    for (int g = 0; g < points; ++g) {
      const detail::CubicWeights<S> w(S(rule.x[g]), p.inverse_length);
      const V3<S> a = w.a * chord + w.a1 * n1.tangent + w.a2 * n2.tangent,
                  b = w.b * chord + w.b1 * n1.tangent + w.b2 * n2.tangent;
      const S A = 1 / a.squaredNorm(), C = a.dot(b) * A;
      sum += S(rule.weight[g]) * p.points[g].bending1 * (b.squaredNorm() * A - C * C);
    }
    const S e[3] = {sqrt(n1.tangent.squaredNorm()) - 1, sqrt(middle(p, chord, n1, n2).squaredNorm()) - 1,
                    sqrt(n2.tangent.squaredNorm()) - 1};
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
  [[gnu::flatten]] static S tangent(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2,
                                    Inner<S>&, RodTangent<S, 3>& core) noexcept {
    // By Δ/l at first.
    const S& i = p.inverse_length;
    const V3<S> chord = i * (n2.r - n1.r);
    S energy = 0;
    stretch(p, chord, n1.tangent, n2.tangent, core, energy);
    for (int g = 0; g < points; ++g) bend(p, g, chord, n1.tangent, n2.tangent, core, energy);
    const S ii = i * i;
    for (S& x : core.D) x *= i;
    for (S& x : core.DD) x *= ii;
    for (S& x : core.D1) x *= i;
    for (S& x : core.D2) x *= i;
    return energy;
  }

 private:
  static constexpr int points = 3;
  static constexpr const detail::GaussRule& rule = detail::three_points;
  template <typename S>
  using V3 = VectorOf<S, 3>;

  /// r' in the middle of the element.   @param chord  Δ
  template <typename S>
  static V3<S> middle(const RodProperties<S>& p, const V3<S>& chord, const RodNode<S>& n1,
                      const RodNode<S>& n2) noexcept {
    return S(1.5) * p.inverse_length * chord - S(0.25) * (n1.tangent + n2.tangent);
  }

  template <typename S>
  using Core = RodTangent<S, 3>;

  /// @param chord  Δ/l
  template <typename S>
  [[gnu::always_inline]] static void bend(const RodProperties<S>& p, int g, const V3<S>& chord,
                                          const V3<S>& t1, const V3<S>& t2, Core<S>& core,
                                          S& energy) noexcept {
    using detail::add_product;
    using T = typename detail::NumberOf<S>::Type;
    static constexpr detail::CubicProducts<T> all[points] = {
        detail::CubicProducts<T>(detail::CubicAt(rule.x[0])),
        detail::CubicProducts<T>(detail::CubicAt(rule.x[1])),
        detail::CubicProducts<T>(detail::CubicAt(rule.x[2]))};
    const auto& w = all[g];
    S a[3], b[3];  // r' and r'' l
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k) {
      a[k] = add_product(add_product(S(S(w.a) * chord[k]), S(w.a1), t1[k]), S(w.a2), t2[k]);
      b[k] = add_product(add_product(S(S(w.b) * chord[k]), S(w.b1), t1[k]), S(w.b2), t2[k]);
    }
    const auto dot = [](const S(&x)[3], const S(&y)[3]) {
      return add_product(add_product(S(x[0] * y[0]), x[1], y[1]), x[2], y[2]);
    };
    const S i = 1 / dot(a, a), B = dot(b, b) * i, c = dot(a, b) * i, cc = c * c;
    const S k = S(rule.weight[g] / 2) * p.points[g].bending1 * p.inverse_length;
    energy += k * (B - cc);
    // f = B/A - C²/A²:  by A, B, C once and twice
    const S ki = k * i, fA2 = 2 * ki * (2 * cc - B), fB2 = 2 * ki, fC = -2 * ki * c,
            fAA4 = 8 * ki * i * (B - 3 * cc), fAB4 = -4 * ki * i, fAC2 = 8 * ki * i * c, fCC = -2 * ki * i;
    // Haa = 2fA I + 4fAA aa' + 2fAC (ab' + ba') + fCC bb',  Hbb = 2fB I + fCC aa',
    // Hab = fC I + 4fAB ab' + 2fAC aa' + fCC ba'
    S x[3], y[3], z[3], u[3];
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      const S by_a = add_product(S(fA2 * a[r]), fC, b[r]), by_b = add_product(S(fB2 * b[r]), fC, a[r]);
      core.D[r] = add_product(add_product(core.D[r], S(w.a), by_a), S(w.b), by_b);
      core.t1[r] = add_product(add_product(core.t1[r], S(w.a1), by_a), S(w.b1), by_b);
      core.t2[r] = add_product(add_product(core.t2[r], S(w.a2), by_a), S(w.b2), by_b);
      x[r] = add_product(S(fAA4 * a[r]), fAC2, b[r]);
      y[r] = add_product(S(fAC2 * a[r]), fCC, b[r]);
      z[r] = fAB4 * a[r];
      u[r] = fCC * a[r];
    }
    // With weights (α, β) and (γ, δ):  αγ Haa + αδ Hab + βγ Hba + βδ Hbb
    HAPBEAM_UNROLL
    for (int col = 0; col < 3; ++col) {
      HAPBEAM_UNROLL
      for (int row = col; row < 3; ++row) {
        const auto entry = [&](const S& own, int r, const S(&by_a)[3], const S(&by_b)[3], int s) {
          return row == col ? add_product(add_product(own, by_a[r], a[s]), by_b[r], b[s])
                            : add_product(S(by_a[r] * a[s]), by_b[r], b[s]);
        };
        const S aa = entry(fA2, row, x, y, col), ab = entry(fC, row, y, z, col),
                ba = row == col ? ab : entry(fC, col, y, z, row),
                bb = row == col ? add_product(fB2, u[row], a[col]) : S(u[row] * a[col]), both = ab + ba;
        const int h = half(row, col), below = 3 * col + row, above = 3 * row + col;
        const auto square = [&](const T(&by)[3], S& H) {
          H = add_product(add_product(add_product(H, S(by[0]), aa), S(by[1]), both), S(by[2]), bb);
        };
        square(w.DD, core.DD[h]), square(w.K11, core.K11[h]), square(w.K22, core.K22[h]);
        const auto product = [&](const T(&by)[4], S(&H)[9]) {
          const auto add = [&](S& to, const S& ad, const S& bg) {
            to = add_product(add_product(to, S(by[0]), aa), S(by[3]), bb);
            to = add_product(add_product(to, S(by[1]), ad), S(by[2]), bg);
          };
          add(H[below], ab, ba);
          if (row != col) add(H[above], ba, ab);
        };
        product(w.D1, core.D1), product(w.D2, core.D2), product(w.K12, core.K12);
      }
    }
  }

  template <typename S>
  [[gnu::always_inline]] static void stretch(const RodProperties<S>& p, const V3<S>& chord, const V3<S>& t1,
                                             const V3<S>& t2, Core<S>& core, S& energy) noexcept {
    using std::sqrt;
    const V3<S> a = S(1.5) * chord - S(0.25) * (t1 + t2);
    const S n[3] = {sqrt(t1.squaredNorm()), sqrt(a.squaredNorm()), sqrt(t2.squaredNorm())};
    const S e[3] = {n[0] - 1, n[1] - 1, n[2] - 1}, EA = p.axial * p.length;
    S N[3], inverse[3];
    const auto& M = detail::quadratic_mass;
    HAPBEAM_UNROLL
    for (int i = 0; i < 3; ++i) {
      N[i] = EA * (S(M[i][0]) * e[0] + S(M[i][1]) * e[1] + S(M[i][2]) * e[2]);
      energy += N[i] * e[i] / 2;
      inverse[i] = 1 / n[i];
    }
    const S w = S(1.5), q = S(-0.25), wN = w * N[1], qN = q * N[1];
    const S own = EA * S(M[0][0]), beside = EA * S(M[0][1]), across = EA * S(M[0][2]);
    const S s0 = N[0] * inverse[0], s1 = N[1] * inverse[1], s2 = N[2] * inverse[2];
    const S stiff = EA * S(M[1][1]) - s1, left = own - s0, right = own - s2;
    S u[3], m[3], v[3];
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k) {
      u[k] = t1[k] * inverse[0], m[k] = a[k] * inverse[1], v[k] = t2[k] * inverse[2];
      core.D[k] = wN * m[k];
      core.t1[k] = qN * m[k] + N[0] * u[k];
      core.t2[k] = qN * m[k] + N[2] * v[k];
    }
    // The middle's own part, s1 I + (M11 EA - s1) mmᵀ, by weights; and what the three strains have in common.
    const S ww = w * w, wq = w * q, qq = q * q, across_w = beside * w, across_q = beside * q;
    HAPBEAM_UNROLL
    for (int c = 0; c < 3; ++c) {
      HAPBEAM_UNROLL
      for (int r = 0; r < 3; ++r) {
        const S part = r == c ? stiff * m[r] * m[c] + s1 : stiff * m[r] * m[c], mu = m[r] * u[c],
                mv = m[r] * v[c];
        const int k = 3 * c + r;
        core.D1[k] = wq * part + across_w * mu;
        core.D2[k] = wq * part + across_w * mv;
        core.K12[k] = qq * part + across_q * (u[r] * m[c] + mv) + across * u[r] * v[c];
        if (r < c) continue;
        const int h = half(r, c);
        core.DD[h] = ww * part;
        core.K11[h] = qq * part + left * u[r] * u[c] + across_q * (u[r] * m[c] + mu);
        core.K22[h] = qq * part + right * v[r] * v[c] + across_q * (v[r] * m[c] + mv);
      }
      core.K11[half(c, c)] += s0;
      core.K22[half(c, c)] += s2;
    }
  }

  /// Where the lower triangle has (i, j), i >= j.
  static constexpr int half(int i, int j) noexcept { return RodTangent<double, 3>::half<3>(i, j); }
};

}  // namespace hapbeam
