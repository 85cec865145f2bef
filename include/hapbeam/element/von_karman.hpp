// SPDX-License-Identifier: MIT
// The von Kármán (moderate rotation) Euler–Bernoulli element. Bending is that of the linear element, and the membrane
// policy adds what the strain ε = u' + ½ w'² makes of it: the default the whole of it, the thesis' a part.
//
// Valid while rotations are moderate. Error of the mid-span deflection under uniform load on sliding ends, against the
// inextensible elastica: 0.2 % at an end slope of 0.067, 9 % at 0.42 and 63 % at 0.95.
// Source: thesis eq. 3.13–3.39 (eq. 3.30c has a factor ½ too many: K21 = 2 K12ᵀ).
#pragma once

#include <type_traits>

#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/membrane.hpp>
#include <hapbeam/element/stability_functions.hpp>

namespace hapbeam {

/// @tparam Membrane  StabilityFunctions | AssumedStrain | ReducedIntegration | FullIntegration, or one of your own: membrane.hpp
template <class Membrane = StabilityFunctions>
struct VonKarman : ElementFromCore<VonKarman<Membrane>> {
  static_assert(responds_to_deformation<Membrane, double>,
                "a Membrane policy needs static noexcept respond(const ElementProperties<S>&, const "
                "Deformation<S>&) -> "
                "CoreResponse<S> and name() -> const char*: see hapbeam/element/membrane.hpp");
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
