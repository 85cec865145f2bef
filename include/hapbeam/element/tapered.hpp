// SPDX-License-Identifier: MIT
// A local element whose section changes along it, smoothly or by steps, or that shears.
//
//   V = V_Local + ½ (a, b) T (a, b)ᵀ,   a = lθ1 + w2 - w1 - a0,  b = lθ2 + w2 - w1 - b0
//
// The membrane is that of Local. T is what the stiffness against end slopes has beyond that of one section. It comes from the
// flexibility of the element under moments at its ends (body/beam_pieces.hpp), which includes steps wherever they are, and shear.
// Where it shears θ is the rotation of the section, and the drawn curve has that slope at nodes.
// Source: Spacone, Ciampi and Filippou, Mixed formulation of nonlinear beam finite element, Computers & Structures 58, 1996.
#pragma once

#include <hapbeam/element/von_karman.hpp>

namespace hapbeam {

/// As FemModel<Tapered<>>, and FemModel<Corotational<Tapered<>>> for finite rotation.
/// @tparam Local  Linear | VonKarman<Membrane>
template <class Local = VonKarman<AssumedStrain>>
struct Tapered : ElementFromCore<Tapered<Local>> {
  static_assert(
      responds_to_deformation<Local, double>,
      "Tapered<Local>: Local must respond to a Deformation, as VonKarman<> does; finite rotation is "
      "Corotational<Tapered<Local>>");
  static constexpr bool tapers = true;
  static constexpr bool membrane_feels_slope = !std::is_same_v<Local, Linear>;
  static constexpr const char* name() noexcept { return "tapered"; }

  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& e) noexcept {
    CoreResponse<S> core = Local::respond(p, e);
    const S k11 = p.taper11, k12 = p.taper12, k22 = p.taper22;
    const S a = e.a - p.natural_a, b = e.b - p.natural_b, m1 = k11 * a + k12 * b, m2 = k12 * a + k22 * b;
    core.energy += (a * m1 + b * m2) / 2;
    core.r += m1 + m2;
    core.t1 += m1;
    core.t2 += m2;
    core.k.rr += k11 + 2 * k12 + k22;
    core.k.r1 += k11 + k12;
    core.k.r2 += k12 + k22;
    core.k.t11 += k11;
    core.k.t12 += k12;
    core.k.t22 += k22;
    return core;
  }
};

}  // namespace hapbeam
