// The exact force of a press on a von Kármán beam between two hinges: what the errors in the benchmarks are errors from.
//
// The tension N is the same in all of the beam, and under a given N the beam is linear:  F = k d, k = 1/G(s, N),
//
//   G(s, N) = [s (L - s)/L - sinh(κs) sinh(κ(L - s)) / (κ sinh κL)] / N,     κ = √(N/EI)
//   N L/EA  = ½ d² dk/dN                                                     (the stretch is what the shape takes up)
//   w'(x)   = F/N [(L - s)/L - B cosh κx],  x <= s,     B = sinh(κ(L - s)) / sinh κL
//
// The brackets cancel as (κL)² and, in dk/dN, as (κL)⁴: in long double they leave 12 digits for |d| from 0.5 mm up.
// Agrees with tests/data/von_karman_press_pinned.csv in all of its digits.
#pragma once

#include <cmath>

#include <hapbeam/beam.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::benchmarks {

class PinnedClosedForm {
  using Real = long double;

 public:
  /// What a press takes, and the centreline where it is pressed.
  struct Contact {
    double force;             ///< [N]
    Vector2<double> point;    ///< [m]
    Vector2<double> tangent;  ///< d/ds of the point
  };

  /// @param axial_stiffness EA [N]   @param bending_stiffness EI [N·m²]
  PinnedClosedForm(double length, double axial_stiffness, double bending_stiffness) noexcept
      : L_(length), EA_(axial_stiffness), EI_(bending_stiffness) {}
  explicit PinnedClosedForm(const Beam& beam) noexcept
      : PinnedClosedForm(beam.length(), beam.axial_stiffness(), beam.bending_stiffness()) {}

  /// @param press  0 < s < L, |d| of 0.5 mm or more on the thesis' beam   @return [N]
  double force(const Press<double>& press) const noexcept {
    return static_cast<double>(balance(press).at.k * press.d);
  }

  /// @param press  as above
  Contact contact(const Press<double>& press) const noexcept {
    const auto [N, at] = balance(press);
    const Real s = press.s, r = L_ - s, kappa = std::sqrt(N / EI_), F = at.k * press.d;
    const Real B = std::sinh(kappa * r) / std::sinh(kappa * L_), chord = r / L_;
    const Real slope = F / N * (chord - B * std::cosh(kappa * s));
    // ∫₀ˢ w'² dx over (F/N)²
    const Real squares = chord * chord * s - 2 * chord * B * std::sinh(kappa * s) / kappa +
                         B * B * (s / 2 + std::sinh(2 * kappa * s) / (4 * kappa));
    const Real u = N * s / EA_ - F * F / (N * N) * squares / 2, stretch = N / EA_ - slope * slope / 2;
    const auto plain = [](Real x) { return static_cast<double>(x); };
    return {plain(F), {plain(s + u), press.d}, {plain(1 + stretch), plain(slope)}};
  }

 private:
  struct Stiffness {
    Real k, by_tension;  // [N/m], [1/m]
  };
  struct Balance {
    Real N;  // [N]
    Stiffness at;
  };

  Balance balance(const Press<double>& press) const noexcept {
    const Real s = press.s, d = press.d;
    // k is concave in N: what is sought is the one root of a falling function.
    Balance balance{EA_ / 2, {}};
    for (Real low = 0, high = EA_; high - low > 1e-17L * high; balance.N = (low + high) / 2) {
      balance.at = stiffness(s, balance.N);
      const bool rises = d * d / 2 * balance.at.by_tension > balance.N * L_ / EA_;
      if (balance.N == (rises ? low : high)) break;
      (rises ? low : high) = balance.N;
    }
    return balance;
  }

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
