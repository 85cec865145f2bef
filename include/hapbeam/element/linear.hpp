// The linear Euler–Bernoulli element: bending and stretching without their coupling.
//
//   V = EA/(2l) (u2-u1)² + EI/(2l³) (4a² + 4ab + 4b²),   a = lθ1 + w2 - w1,  b = lθ2 + w2 - w1
//
// The bending energy is that of the cubic Hermite interpolation, integrated in closed form, and written in
// end slopes against the chord: what a large rigid motion would cancel is subtracted first.
// Source: thesis eq. 3.16–3.31 without the product of slopes.
#pragma once

#include <hapbeam/element/element.hpp>

namespace hapbeam {

struct Linear {
  static constexpr const char* name() noexcept { return "linear"; }

  template <typename S>
  static S energy(const ElementProperties<S>& p, const Vector6<S>& d) noexcept {
    const detail::Deformation<S> e(p, d);
    return p.axial_per_length * e.stretch * e.stretch / 2 +
           2 * p.bending_per_length3 * (e.a * e.a + e.a * e.b + e.b * e.b);
  }

  template <typename S>
  static void residual(const ElementProperties<S>& p, const Vector6<S>& d, Vector6<S>& r) noexcept {
    const detail::Deformation<S> e(p, d);
    const S m1 = p.bending_per_length3 * (4 * e.a + 2 * e.b),
            m2 = p.bending_per_length3 * (2 * e.a + 4 * e.b);
    detail::expand(p, p.axial_per_length * e.stretch, m1 + m2, m1, m2, r);
  }

  template <typename S>
  static S tangent(const ElementProperties<S>& p, const Vector6<S>& d, Vector6<S>& r,
                   Matrix6<S>& K) noexcept {
    residual(p, d, r);
    const S k = p.bending_per_length3;
    detail::expand(p, {p.axial_per_length, 0, 0, 0, 12 * k, 6 * k, 6 * k, 4 * k, 2 * k, 4 * k}, K);
    return energy(p, d);
  }
};

}  // namespace hapbeam
