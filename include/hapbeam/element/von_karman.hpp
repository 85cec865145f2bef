// SPDX-License-Identifier: MIT
// The von Kármán (moderate rotation) Euler–Bernoulli element. Bending is that of the linear element, and the membrane
// policy adds what the strain ε = u' + ½ w'² makes of it: the default the whole of it, the thesis' a part.
//
// Valid while rotations are moderate. Error of the mid-span deflection under uniform load on sliding ends, against the
// inextensible elastica: 0.2 % at an end slope of 0.067, 9 % at 0.42 and 63 % at 0.95.
// Source: thesis eq. 3.13–3.39 (eq. 3.30c has a factor ½ too many: K21 = 2 K12ᵀ).
//
// How the membrane strain of a von Kármán element is averaged: three policies, one element.
//
//   ε(x) = (u2 - u1)/l + ½ w'(x)²                      thesis eq. 3.13
//
// less the ε of the natural shape, which is free of force.
// u' is constant over the element and w'² is not. FullIntegration counts that difference as strain energy and locks.
// ReducedIntegration evaluates the middle alone. AssumedStrain takes the mean of ε over the element, which is the
// constant membrane force of equilibrium. A policy returns energy, first and second derivatives in the coordinates
// (stretch, rise, lθ1, lθ2):
//
//   expression             type                promise
//   --------------------   -----------------   -----------------------------------------------------------------
//   M::respond(p, e)       CoreResponse<S>     of an ElementProperties<S> and a Deformation<S>; static, noexcept
//   M::name()              const char*
//   M::ExactUnderTension   type, optional, M itself: element.hpp
//   M::Abreast             type, optional, M itself: element.hpp
//
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <type_traits>

#include <hapbeam/element/element.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/stability_functions.hpp>

namespace hapbeam {

namespace detail {

/// Sum of two Gauss points.
template <typename S>
[[gnu::always_inline]] inline CoreResponse<S> sum(const CoreResponse<S>& a,
                                                  const CoreResponse<S>& b) noexcept {
  return {a.energy + b.energy,
          a.s + b.s,
          a.r + b.r,
          a.t1 + b.t1,
          a.t2 + b.t2,
          {a.k.ss + b.k.ss, a.k.sr + b.k.sr, a.k.s1 + b.k.s1, a.k.s2 + b.k.s2, a.k.rr + b.k.rr,
           a.k.r1 + b.k.r1, a.k.r2 + b.k.r2, a.k.t11 + b.k.t11, a.k.t12 + b.k.t12, a.k.t22 + b.k.t22}};
}

/// One Gauss point's part of ½ EA l ω ε².  @param t in [0, 1]   @param weight ω, all sum to 1
template <typename S>
[[gnu::always_inline]] inline CoreResponse<S> at_gauss_point(const ElementProperties<S>& p,
                                                             const Deformation<S>& e, S t,
                                                             S weight) noexcept {
  // l w' = rise + a g1 + b g2: the Hermite cubic about its chord.  f, g1, g2: its derivatives by rise, lθ1, lθ2.
  const S g1 = (t - 1) * (1 - 3 * t), g2 = t * (2 - 3 * t), f = 1 + g1 + g2;
  const S slope = (e.rise + e.a * g1 + e.b * g2) * p.inverse_length;
  const S natural = (p.natural_a * g1 + p.natural_b * g2) * p.inverse_length;
  const S strain = e.stretch * p.inverse_length + (slope * slope - natural * natural) / 2;
  const S normal = weight * p.axial_stiffness * strain, c = normal * slope;
  const S ks = weight * p.axial_per_length, kg = ks * slope, k = ks * strain + kg * slope;
  const S kf = k * f, k1 = k * g1;
  return {p.length * normal * strain / 2,
          normal,
          c * f,
          c * g1,
          c * g2,
          {ks, kg * f, kg * g1, kg * g2, kf * f, kf * g1, kf * g2, k1 * g1, k1 * g2, k * g2 * g2}};
}

}  // namespace detail

/// Two Gauss points, the rule that integrates every linear term exactly (the textbooks' "full").  It locks, as
/// exact integration does: a third point changes the answer by less than 1 %.
struct FullIntegration {
  static constexpr const char* name() noexcept { return "full"; }
  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& e) noexcept {
    return detail::sum(detail::at_gauss_point(p, e, S(0.21132486540518711775), S(0.5)),
                       detail::at_gauss_point(p, e, S(0.78867513459481288225), S(0.5)));
  }
};

/// One Gauss point in the middle of the element (Reddy; the thesis). Where N l² > 16 EI the element has no bending stiffness at a
/// given tension.
struct ReducedIntegration {
  static constexpr const char* name() noexcept { return "reduced"; }
  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& e) noexcept {
    return detail::at_gauss_point(p, e, S(0.5), S(1));
  }
};

/// The element's mean strain, in closed form:  l² ∫w'² dx/l = rise² + (2a² - ab + 2b²)/15.
/// Along a chord it is that of the curve as it is drawn:  ε (1 + q), q = ½ ∫w'² dx/l, to second order of the slopes.
struct AssumedStrain {
  static constexpr const char* name() noexcept { return "assumed-strain"; }
  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& e) noexcept {
    const S i = p.inverse_length;
    // g = ½ ∂(l² mean w'²)/∂(rise, lθ1, lθ2)
    const S g1 = (4 * e.a - e.b) * S(1. / 30), g2 = (4 * e.b - e.a) * S(1. / 30), gr = e.rise + g1 + g2;
    const S mean_square = e.rise * e.rise + e.a * g1 + e.b * g2;
    const S mean = (e.stretch + (mean_square - detail::natural_mean_square(p)) * i / 2) * i;
    const S along = e.chord * i * i, longer = 1 + along * mean_square / 2, turning = longer + e.chord * mean;
    const S strain = mean * longer, normal = p.axial_stiffness * strain, n = normal * i * turning;
    const S k = p.axial_per_length * i * turning, kg = k * longer + along * normal,
            kgg = (k * turning + 2 * along * normal) * i;
    return {
        p.length * normal * strain / 2,
        normal * longer,
        n * gr,
        n * g1,
        n * g2,
        {p.axial_per_length * longer * longer, kg * gr, kg * g1, kg * g2,                      //
         n * S(6. / 5) + kgg * gr * gr, n * S(.1) + kgg * gr * g1, n * S(.1) + kgg * gr * g2,  //
         n * S(2. / 15) + kgg * g1 * g1, n * S(-1. / 30) + kgg * g1 * g2, n * S(2. / 15) + kgg * g2 * g2}};
  }
};

/// @tparam Membrane  StabilityFunctions | AssumedStrain | ReducedIntegration | FullIntegration, or one of your own
template <class Membrane = StabilityFunctions>
struct VonKarman : ElementFromCore<VonKarman<Membrane>> {
  static_assert(responds_to_deformation<Membrane, double>,
                "a Membrane policy needs static noexcept respond(const ElementProperties<S>&, const "
                "Deformation<S>&) -> "
                "CoreResponse<S> and name() -> const char*: see hapbeam/element/von_karman.hpp");
  static constexpr bool membrane_feels_slope = true;
  using ExactUnderTension = std::conditional_t<exact_under_tension<Membrane>, VonKarman, void>;
  using Abreast = std::conditional_t<goes_abreast<Membrane>, VonKarman, void>;
  static constexpr const char* name() noexcept { return Membrane::name(); }

  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& e) noexcept {
    CoreResponse<S> core = Membrane::respond(p, e);
    detail::add_bending(p, e, core);
    return core;
  }
  template <typename S, class M = Membrane, std::enable_if_t<has_own_tension<M>, int> = 0>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& e,
                                                        OwnTension<S>& tension) noexcept {
    CoreResponse<S> core = M::respond(p, e, tension);
    detail::add_bending(p, e, core);
    return core;
  }
};

}  // namespace hapbeam
