// SPDX-License-Identifier: MIT
// The membrane policy that makes a straight element exact: what its tension does to its stretch and to its bending.
//
//   Π(d, N) = N e - N² l/2EA + EI/4l³ ((B - 6)(a + b)² + (A - 2)(a - b)²),     e = u2 - u1 + rise²/2l - e0,     q = N l²/EI
//
// stationary in N, the element's own unknown.  A(q), B(q): tension_stiffness.hpp; 2 and 6: the bending without
// tension, which VonKarman adds; e0: the e of the natural shape without tension.  Without a load on it, or as a part of a polygon of
// constant tension, the element solves EI w'''' = N w'' exactly.  AssumedStrain is its first order, A = 2 + q/6 and B = 6 + q/10.
//
//   ∂Π/∂N = 0:    N l/EA = e + (B'(a + b)² + A'(a - b)²)/4l
//
// Along a chord, which turns, N bends what is 1 + N/EA times as long: q = N (1 + N/EA) l²/EI.
//
// Condensed, the nodes see
//
//   r = ∂Π/∂d + ΔN ∂²Π/∂d∂N,   K = ∂²Π/∂d² + k ∂²Π/∂d∂N (∂²Π/∂d∂N)ᵀ,   ΔN = k ∂Π/∂N,   1/k = -∂²Π/∂N² > 0
//
// and V = Π + ½ k (∂Π/∂N)², to third order of what is missing.  In equilibrium ΔN = 0.
//
// By the nodes alone, N is found from N = EA e/l on, or from the first step of N = 0: ∂Π/∂N falls with N and is convex, so that
// Newton's method rises to its one root.
// Real-time: no allocation, noexcept, O(1).
// Source: derived here; docs/theory.md, The element.
#pragma once

#include <hapbeam/element/element.hpp>
#include <hapbeam/element/tension_stiffness.hpp>

namespace hapbeam {

struct StabilityFunctions {
  using ExactUnderTension = StabilityFunctions;
  using Abreast = StabilityFunctions;
  static constexpr const char* name() noexcept { return "stability-functions"; }

  /// By the nodes alone.
  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& d) noexcept {
    using detail::all_less;
    using detail::larger;
    const S unit = p.bending_per_length3 * p.length, eps = S(Eigen::NumTraits<S>::epsilon());
    OwnTension<S> tension;
    (void)respond(p, d, tension);
    tension.normal = larger(tension.missing, S(p.axial_per_length * elongation(p, d)));
    CoreResponse<S> core = respond(p, d, tension);
    for (int i = 0; i < most; ++i) {
      const S step = tension.missing, size = unit * unit + tension.normal * tension.normal;
      if (all_less(S(step * step), S(eps * eps * size))) break;
      tension.normal += step;
      core = respond(p, d, tension);
    }
    return core;
  }
  /// With N an unknown.
  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& d,
                                                        OwnTension<S>& tension) noexcept {
    using detail::larger;
    const S i = p.inverse_length, half = p.bending_per_length3 / 2, quarter = i / 4;
    const S unit = p.bending_per_length3 * p.length, stiff = p.axial_per_length, normal = tension.normal;
    const S across = d.a + d.b, about = d.a - d.b, across2 = across * across, about2 = about * about;
    const S yields = d.chord * i / stiff, strain = yields * normal, by_normal = 1 + 2 * strain;
    detail::TensionStiffness<S> k = detail::tension_stiffness(S((normal + normal * strain) / unit));
    // From here on by N EI/l² instead of q.
    const S curved = 2 * yields * unit;
    k.a2 = k.a2 * by_normal * by_normal + k.a1 * curved, k.a1 *= by_normal;
    k.b2 = k.b2 * by_normal * by_normal + k.b1 * curved, k.b1 *= by_normal;
    const S e = elongation(p, d), lack = e + quarter * (k.b1 * across2 + k.a1 * about2) - normal / stiff;
    const S follow = stiff * unit / (unit - stiff * quarter * (k.b2 * across2 + k.a2 * about2));
    const S missing = follow * lack;
    // ∂²Π/∂N∂(rise, lθ1, lθ2)
    const S b1 = k.b1 * across * i / 2, a1 = k.a1 * about * i / 2, n1 = b1 + a1, n2 = b1 - a1,
            nr = d.rise * i + n1 + n2;
    const S bx = half * k.b * across, ax = half * k.a * about, m1 = bx + ax, m2 = bx - ax;
    const S turns = larger(normal, S(normal + tension.turning * missing)) * i, k11 = half * (k.b + k.a),
            k12 = half * (k.b - k.a), sum = 2 * half * k.b;
    const S s1 = follow * n1, s2 = follow * n2, sr = follow * nr;
    tension.missing = missing, tension.lack = lack;
    tension.s = follow, tension.r = sr, tension.t1 = s1, tension.t2 = s2;
    return {normal * (e - normal / stiff / 2) + (bx * across + ax * about + missing * lack) / 2,
            normal + missing,
            normal * i * d.rise + m1 + m2 + missing * nr,
            m1 + missing * n1,
            m2 + missing * n2,
            {follow, sr, s1, s2, turns + 2 * sum + sr * nr, sum + sr * n1, sum + sr * n2, k11 + s1 * n1,
             k12 + s1 * n2, k11 + s2 * n2}};
  }

 private:
  static constexpr int most = 16;

  /// e
  template <typename S>
  [[gnu::always_inline]] static S elongation(const ElementProperties<S>& p,
                                             const Deformation<S>& d) noexcept {
    return d.stretch + (d.rise * d.rise - detail::natural_mean_square(p)) * p.inverse_length / 2;
  }
};

}  // namespace hapbeam
