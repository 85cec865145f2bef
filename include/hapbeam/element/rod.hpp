// The element of a round rod that is straight by nature and whose twist nobody holds: no rotation, no frame.
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
  static S tangent(const RodProperties<S>& p, const RodNode<S>& n1, const RodNode<S>& n2, Inner<S>&,
                   Vector12<S>& r, Matrix12<S>& K) noexcept {
    Core<S> core{};
    const V3<S> chord = n2.r - n1.r;
    S energy = 0;
    for (int g = 0; g < points; ++g) bend(p, g, chord, n1.tangent, n2.tangent, core, energy);
    stretch(p, middle(p, chord, n1, n2), n1.tangent, n2.tangent, core, energy);
    expand(core, r, K);
    return energy;
  }

 private:
  static constexpr int points = 3;
  static constexpr const detail::GaussRule& rule = detail::three_points;
  template <typename S>
  using V3 = VectorOf<S, 3>;
  template <typename S>
  using M3 = Eigen::Matrix<S, 3, 3>;

  /// r' in the middle of the element.
  template <typename S>
  static V3<S> middle(const RodProperties<S>& p, const V3<S>& chord, const RodNode<S>& n1,
                      const RodNode<S>& n2) noexcept {
    return S(1.5) * p.inverse_length * chord - S(0.25) * (n1.tangent + n2.tangent);
  }

  /// Gradient and Hessian by Δ, r1', r2'.
  template <typename S>
  struct Core {
    V3<S> D = V3<S>::Zero(), t1 = V3<S>::Zero(), t2 = V3<S>::Zero();
    M3<S> DD = M3<S>::Zero(), D1 = M3<S>::Zero(), D2 = M3<S>::Zero(), K11 = M3<S>::Zero(),
          K12 = M3<S>::Zero(), K22 = M3<S>::Zero();
  };

  template <typename S>
  [[gnu::always_inline]] static void bend(const RodProperties<S>& p, int g, const V3<S>& chord,
                                          const V3<S>& t1, const V3<S>& t2, Core<S>& core,
                                          S& energy) noexcept {
    const detail::CubicWeights<S> w(S(rule.x[g]), p.inverse_length);
    const V3<S> a = w.a * chord + w.a1 * t1 + w.a2 * t2, b = w.b * chord + w.b1 * t1 + w.b2 * t2;
    const S i = 1 / a.squaredNorm(), B = b.squaredNorm() * i, c = a.dot(b) * i, cc = c * c;
    const S k = S(rule.weight[g]) * p.points[g].bending1 * p.length / 2;
    energy += k * (B - cc);
    // f = B/A - C²/A²:  by A, B, C once and twice
    const S ki = k * i, fA = ki * (2 * cc - B), fB = ki, fC = -2 * ki * c, fAA = ki * i * (2 * B - 6 * cc),
            fAB = -ki * i, fAC = 4 * ki * i * c, fCC = -2 * ki * i;
    const V3<S> by_a = 2 * fA * a + fC * b, by_b = 2 * fB * b + fC * a;
    core.D += w.a * by_a + w.b * by_b;
    core.t1 += w.a1 * by_a + w.b1 * by_b;
    core.t2 += w.a2 * by_a + w.b2 * by_b;
    // Haa = 2fA I + 4fAA aa' + 2fAC (ab' + ba') + fCC bb',  Hbb = 2fB I + fCC aa',
    // Hab = fC I + 4fAB ab' + 2fAC aa' + fCC ba';  with weights (α, β) and (γ, δ) the sum of
    // αγ Haa + αδ Hab + βγ Hba + βδ Hbb is  x I + a (y a + z b)' + b (z' a + u b)'
    const auto add = [&](S alpha, S beta, S gamma, S delta, M3<S>& H) {
      const S ag = alpha * gamma, ad = alpha * delta, bg = beta * gamma, bd = beta * delta;
      const S aa = 4 * fAA * ag + 2 * fAC * (ad + bg) + fCC * bd, ab = 2 * fAC * ag + 4 * fAB * ad + fCC * bg,
              ba = 2 * fAC * ag + fCC * ad + 4 * fAB * bg, bb = fCC * ag;
      const V3<S> x = aa * a + ba * b, y = ab * a + bb * b;
      const S diagonal = 2 * fA * ag + fC * (ad + bg) + 2 * fB * bd;
      HAPBEAM_UNROLL
      for (int col = 0; col < 3; ++col) {
        HAPBEAM_UNROLL
        for (int row = 0; row < 3; ++row) H(row, col) += x[row] * a[col] + y[row] * b[col];
        H(col, col) += diagonal;
      }
    };
    add(w.a, w.b, w.a, w.b, core.DD);
    add(w.a, w.b, w.a1, w.b1, core.D1);
    add(w.a, w.b, w.a2, w.b2, core.D2);
    add(w.a1, w.b1, w.a1, w.b1, core.K11);
    add(w.a1, w.b1, w.a2, w.b2, core.K12);
    add(w.a2, w.b2, w.a2, w.b2, core.K22);
  }

  template <typename S>
  [[gnu::always_inline]] static void stretch(const RodProperties<S>& p, const V3<S>& a, const V3<S>& t1,
                                             const V3<S>& t2, Core<S>& core, S& energy) noexcept {
    using std::sqrt;
    const S n[3] = {sqrt(t1.squaredNorm()), sqrt(a.squaredNorm()), sqrt(t2.squaredNorm())};
    const S e[3] = {n[0] - 1, n[1] - 1, n[2] - 1}, EA = p.axial * p.length;
    S N[3];
    for (int i = 0; i < 3; ++i) {
      const auto& M = detail::quadratic_mass[i];
      N[i] = EA * (S(M[0]) * e[0] + S(M[1]) * e[1] + S(M[2]) * e[2]);
      energy += N[i] * e[i] / 2;
    }
    const V3<S> u = t1 / n[0], m = a / n[1], v = t2 / n[2];
    const S w = S(1.5) * p.inverse_length, q = S(-0.25);
    core.D += w * N[1] * m;
    core.t1 += q * N[1] * m + N[0] * u;
    core.t2 += q * N[1] * m + N[2] * v;
    const auto& M = detail::quadratic_mass;
    const S own = EA * S(M[0][0]), beside = EA * S(M[0][1]), across = EA * S(M[0][2]);
    const S s0 = N[0] / n[0], s1 = N[1] / n[1], s2 = N[2] / n[2];
    const V3<S> mm = (EA * S(M[1][1]) - s1) * m, um = beside * u, vm = beside * v;
    // The middle's own part, s1 I + mm mᵀ, by weights; and what the three strains have in common.
    const V3<S> Du = w * um, Dv = w * vm, left = (own - s0) * u, right = (own - s2) * v;
    HAPBEAM_UNROLL
    for (int c = 0; c < 3; ++c) {
      HAPBEAM_UNROLL
      for (int r = 0; r < 3; ++r) {
        const S middle = mm[r] * m[c];
        core.DD(r, c) += w * w * middle;
        core.D1(r, c) += w * q * middle + m[r] * Du[c];
        core.D2(r, c) += w * q * middle + m[r] * Dv[c];
        core.K11(r, c) += q * q * middle + left[r] * u[c] + q * (um[r] * m[c] + m[r] * um[c]);
        core.K12(r, c) += q * q * middle + q * (um[r] * m[c] + m[r] * vm[c]) + across * u[r] * v[c];
        core.K22(r, c) += q * q * middle + right[r] * v[c] + q * (vm[r] * m[c] + m[r] * vm[c]);
      }
      core.DD(c, c) += w * w * s1;
      core.D1(c, c) += w * q * s1;
      core.D2(c, c) += w * q * s1;
      core.K11(c, c) += q * q * s1 + s0;
      core.K12(c, c) += q * q * s1;
      core.K22(c, c) += q * q * s1 + s2;
    }
  }

  template <typename S>
  [[gnu::always_inline]] static void expand(const Core<S>& core, Vector12<S>& r, Matrix12<S>& K) noexcept {
    r.template segment<3>(0) = -core.D;
    r.template segment<3>(3) = core.t1;
    r.template segment<3>(6) = core.D;
    r.template segment<3>(9) = core.t2;
    const auto set = [&K](int i, int j, const M3<S>& m, S sign) {
      HAPBEAM_UNROLL
      for (int c = 0; c < 3; ++c) HAPBEAM_UNROLL
      for (int row = 0; row < 3; ++row) K(i + row, j + c) = K(j + c, i + row) = sign * m(row, c);
    };
    set(0, 0, core.DD, 1), set(0, 6, core.DD, -1), set(6, 6, core.DD, 1);
    set(0, 3, core.D1, -1), set(6, 3, core.D1, 1), set(0, 9, core.D2, -1), set(6, 9, core.D2, 1);
    set(3, 3, core.K11, 1), set(3, 9, core.K12, 1), set(9, 9, core.K22, 1);
  }
};

}  // namespace hapbeam
