// How the membrane strain of a von Kármán element is averaged: three policies, one element.
//
//   ε(x) = (u2 - u1)/l + ½ w'(x)²                      thesis eq. 3.13
//
// u' is constant over the element and w'² is not.  FullIntegration takes that difference for strain energy and
// locks; ReducedIntegration looks at the middle alone; AssumedStrain takes the mean of ε over the element,
// which is the constant membrane force that equilibrium asks for.  Each answers with
// energy, first and second derivatives in the coordinates (stretch, rise, lθ1, lθ2).  Real-time: no allocation, noexcept, O(1).
#pragma once

#include <array>

#include <hapbeam/element/element.hpp>

namespace hapbeam {

namespace detail {

/// Energy, first and second derivatives of the membrane part in (stretch, rise, lθ1, lθ2).
template <typename S>
struct MembraneResponse {
  S energy;          ///< [J]
  S s, r, t1, t2;    ///< [N]
  CoreTangent<S> k;  ///< [N/m]
};

/// Sum over Gauss points of ½ EA l ω ε², each with its own strain.
template <typename S, std::size_t Points>
inline MembraneResponse<S> integrate_membrane(const ElementProperties<S>& p, const Deformation<S>& e,
                                              const std::array<double, Points>& points,
                                              const std::array<double, Points>& weights) noexcept {
  MembraneResponse<S> m{};
  for (std::size_t i = 0; i < Points; ++i) {
    const S t = static_cast<S>(points[i]), weight = static_cast<S>(weights[i]), o = 1 - t;
    // l w' = rise + a g1 + b g2: the Hermite cubic about its chord.  f, g1, g2: its derivatives by rise, lθ1, lθ2.
    const S g1 = -o * (1 - 3 * t), g2 = t * (2 - 3 * t);
    const S slope = (e.rise + e.a * g1 + e.b * g2) * p.inverse_length;
    const S f = 1 + g1 + g2;
    const S strain = e.stretch * p.inverse_length + slope * slope / 2;
    const S normal = p.axial_stiffness * strain;
    const S c = weight * normal * slope;
    const S stretch_k = weight * p.axial_per_length;
    const S slope_k = stretch_k * slope;
    const S k = stretch_k * strain + slope_k * slope;
    m.energy += weight * p.length * normal * strain / 2;
    m.s += weight * normal;
    m.r += c * f;
    m.t1 += c * g1;
    m.t2 += c * g2;
    m.k.ss += stretch_k;
    m.k.sr += slope_k * f;
    m.k.s1 += slope_k * g1;
    m.k.s2 += slope_k * g2;
    m.k.rr += k * f * f;
    m.k.r1 += k * f * g1;
    m.k.r2 += k * f * g2;
    m.k.t11 += k * g1 * g1;
    m.k.t12 += k * g1 * g2;
    m.k.t22 += k * g2 * g2;
  }
  return m;
}

}  // namespace detail

/// Two Gauss points, the rule that integrates every linear term exactly (the textbooks' "full").  It locks, as
/// exact integration does: a third point changes the answer by less than 1 %.
struct FullIntegration {
  static constexpr const char* name() noexcept { return "full"; }
  template <typename S>
  static detail::MembraneResponse<S> respond(const ElementProperties<S>& p,
                                             const detail::Deformation<S>& e) noexcept {
    return detail::integrate_membrane<S, 2>(p, e, {0.21132486540518711775, 0.78867513459481288225},
                                            {0.5, 0.5});
  }
};

/// One Gauss point in the middle of the element (Reddy; the thesis).
struct ReducedIntegration {
  static constexpr const char* name() noexcept { return "reduced"; }
  template <typename S>
  static detail::MembraneResponse<S> respond(const ElementProperties<S>& p,
                                             const detail::Deformation<S>& e) noexcept {
    return detail::integrate_membrane<S, 1>(p, e, {0.5}, {1.0});
  }
};

/// The element's mean strain, in closed form:  l² ∫w'² dx/l = rise² + (2a² - ab + 2b²)/15.
struct AssumedStrain {
  static constexpr const char* name() noexcept { return "assumed-strain"; }
  template <typename S>
  static detail::MembraneResponse<S> respond(const ElementProperties<S>& p,
                                             const detail::Deformation<S>& e) noexcept {
    const S i = p.inverse_length;
    // g = ½ ∂(l² mean w'²)/∂(rise, lθ1, lθ2)
    const S g1 = (4 * e.a - e.b) * S(1. / 30), g2 = (4 * e.b - e.a) * S(1. / 30), gr = e.rise + g1 + g2;
    const S mean_square = e.rise * e.rise + e.a * g1 + e.b * g2;
    const S strain = (e.stretch + mean_square * i / 2) * i;
    const S normal = p.axial_stiffness * strain, n = normal * i;
    const S ks = p.axial_per_length, kg = ks * i, kgg = kg * i;
    return {
        p.length * normal * strain / 2,
        normal,
        n * gr,
        n * g1,
        n * g2,
        {ks, kg * gr, kg * g1, kg * g2,                                                        //
         n * S(6. / 5) + kgg * gr * gr, n * S(.1) + kgg * gr * g1, n * S(.1) + kgg * gr * g2,  //
         n * S(2. / 15) + kgg * g1 * g1, n * S(-1. / 30) + kgg * g1 * g2, n * S(2. / 15) + kgg * g2 * g2}};
  }
};

}  // namespace hapbeam
