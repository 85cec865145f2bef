// SPDX-License-Identifier: MIT
// The linear Euler–Bernoulli element: bending and stretching without their coupling.
//
//   V = EA/(2l) (u2-u1)² + EI/(2l³) (4a² + 4ab + 4b²),   a = lθ1 + w2 - w1 - a0,  b = lθ2 + w2 - w1 - b0
//
// The bending energy is that of the cubic Hermite interpolation, integrated in closed form. It is written in end slopes
// against the chord, so a large rigid motion is subtracted before it can cancel. a0 and b0 are those of the element's
// natural shape, zero for a straight beam.
// Source: thesis eq. 3.16–3.31 without the product of slopes.
#pragma once

#include <hapbeam/element/element.hpp>

namespace hapbeam {

namespace detail {

/// Adds bending to what an element's membrane answers.
template <typename S>
[[gnu::always_inline]] inline void add_bending(const ElementProperties<S>& p, const Deformation<S>& e,
                                               CoreResponse<S>& core) noexcept {
  const S k = p.bending_per_length3, a = e.a - p.natural_a, b = e.b - p.natural_b;
  const S m1 = k * (4 * a + 2 * b), m2 = k * (2 * a + 4 * b);
  core.energy += 2 * k * (a * a + a * b + b * b);
  core.r += m1 + m2;
  core.t1 += m1;
  core.t2 += m2;
  core.k.rr += 12 * k;
  core.k.r1 += 6 * k;
  core.k.r2 += 6 * k;
  core.k.t11 += 4 * k;
  core.k.t12 += 2 * k;
  core.k.t22 += 4 * k;
}

}  // namespace detail

struct Linear : ElementFromCore<Linear> {
  static constexpr const char* name() noexcept { return "linear"; }

  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Deformation<S>& e) noexcept {
    const S normal = p.axial_per_length * e.stretch;
    CoreResponse<S> core{
        normal * e.stretch / 2, normal, 0, 0, 0, {p.axial_per_length, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
    detail::add_bending(p, e, core);
    return core;
  }
};

}  // namespace hapbeam
