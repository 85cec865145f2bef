// The exact force of a press on a von Kármán beam between two hinges: what the errors in the benchmarks are errors from.
//
// The tension N is the same in all of the beam, and under a given N the beam is linear:  F = k d, k = 1/G(s, N),
//
//   G(s, N) = [s (L - s)/L - sinh(κs) sinh(κ(L - s)) / (κ sinh κL)] / N,     κ = √(N/EI)
//   N L/EA  = ½ d² dk/dN                                                     (the stretch is what the shape takes up)
//
// The brackets cancel as (κL)² and, in dk/dN, as (κL)⁴: in long double they leave 12 digits for |d| from 0.5 mm up.
// Agrees with tests/data/von_karman_press_pinned.csv in all of its digits.
#pragma once

#include <cmath>

#include <hapbeam/force_model.hpp>

namespace hapbeam::benchmarks {

class PinnedClosedForm {
  using Real = long double;

 public:
  /// @param axial_stiffness EA [N]   @param bending_stiffness EI [N·m²]
  PinnedClosedForm(double length, double axial_stiffness, double bending_stiffness) noexcept
      : L_(length), EA_(axial_stiffness), EI_(bending_stiffness) {}

  /// @param press  0 < s < L, |d| of 0.5 mm or more on the thesis' beam   @return [N]
  double force(const Press<double>& press) const noexcept {
    const Real s = press.s, d = press.d;
    // k is concave in N: what is sought is the one root of a falling function.
    Real low = 0, high = EA_;
    Stiffness at{};
    for (int k = 0; k < 120 && high - low > 1e-17L * high; ++k) {
      const Real N = (low + high) / 2;
      at = stiffness(s, N);
      (d * d / 2 * at.by_tension > N * L_ / EA_ ? low : high) = N;
    }
    return static_cast<double>(at.k * d);
  }

 private:
  struct Stiffness {
    Real k, by_tension;  // [N/m], [1/m]
  };

  Stiffness stiffness(Real s, Real N) const noexcept {
    const Real r = L_ - s, kappa = std::sqrt(N / EI_);
    // sinh a sinh b / sinh(a + b), and coth, without overflow.
    const auto fall = [](Real x) { return -std::expm1(-2 * x); };
    const auto coth = [](Real x) { return 1 / std::tanh(x); };
    const Real product = fall(kappa * s) * fall(kappa * r) / (2 * fall(kappa * L_));
    const Real boundary = product / kappa;
    const Real log_slope = s * coth(kappa * s) + r * coth(kappa * r) - L_ * coth(kappa * L_);
    const Real by_kappa = boundary * (log_slope - 1 / kappa);
    const Real G = (s * r / L_ - boundary) / N;
    const Real G_by_N = -(by_kappa * kappa / (2 * N) + G) / N;
    return {1 / G, -G_by_N / (G * G)};
  }

  Real L_, EA_, EI_;
};

}  // namespace hapbeam::benchmarks
