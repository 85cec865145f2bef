// The von Kármán (moderate rotation) Euler–Bernoulli element of the thesis: bending as in the linear element,
// and a membrane force that the slope feeds, ε = u' + ½ w'².
//
// Right while the rotations are moderate: at an end slope of 0.067 the mid-span deflection under uniform load on
// sliding ends is off by 0.2 %, at 0.42 by 9 %, at 0.95 by 63 % (against the inextensible elastica).
// Source: thesis eq. 3.13–3.39 (eq. 3.30c has a factor ½ too many: K21 = 2 K12ᵀ).
#pragma once

#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/membrane.hpp>

namespace hapbeam {

/// @tparam Membrane  FullIntegration | ReducedIntegration | AssumedStrain
template <class Membrane = AssumedStrain>
struct VonKarman {
  static constexpr const char* name() noexcept { return Membrane::name(); }

  template <typename S>
  static S energy(const ElementProperties<S>& p, const Vector6<S>& d) noexcept {
    const detail::Deformation<S> e(p, d);
    return Membrane::respond(p, e).energy + bending_energy(p, e);
  }

  template <typename S>
  static void residual(const ElementProperties<S>& p, const Vector6<S>& d, Vector6<S>& r) noexcept {
    const detail::Deformation<S> e(p, d);
    residual(p, e, Membrane::respond(p, e), r);
  }

  template <typename S>
  static S tangent(const ElementProperties<S>& p, const Vector6<S>& d, Vector6<S>& r,
                   Matrix6<S>& K) noexcept {
    const detail::Deformation<S> e(p, d);
    const auto m = Membrane::respond(p, e);
    residual(p, e, m, r);
    const S k = p.bending_per_length3;
    detail::expand(p,
                   {m.k.ss, m.k.sr, m.k.s1, m.k.s2, m.k.rr + 12 * k, m.k.r1 + 6 * k, m.k.r2 + 6 * k,
                    m.k.t11 + 4 * k, m.k.t12 + 2 * k, m.k.t22 + 4 * k},
                   K);
    return m.energy + bending_energy(p, e);
  }

 private:
  template <typename S>
  static S bending_energy(const ElementProperties<S>& p, const detail::Deformation<S>& e) noexcept {
    return 2 * p.bending_per_length3 * (e.a * e.a + e.a * e.b + e.b * e.b);
  }

  template <typename S>
  static void residual(const ElementProperties<S>& p, const detail::Deformation<S>& e,
                       const detail::MembraneResponse<S>& m, Vector6<S>& r) noexcept {
    const S m1 = p.bending_per_length3 * (4 * e.a + 2 * e.b),
            m2 = p.bending_per_length3 * (2 * e.a + 4 * e.b);
    detail::expand(p, m.s, m.r + m1 + m2, m.t1 + m1, m.t2 + m2, r);
  }
};

}  // namespace hapbeam
