// The press of a von Kármán beam between immovable hinges, as a series that is exact for every tension.
//
// Under a tension N the compliance at s, with a_n = (nπ/L)², is
//   G(s, N) = (2/L) Σ sin²(nπs/L)/(a_n (EI a_n + N)) = s²(L - s)²/(3EI L) - (2N/L) Σ sin²/(EI a_n² (EI a_n + N))
// whose second form has no cancellation at small N and converges as n⁻⁶.  F = d/G, and N solves N L/EA = ½ d² ∂(1/G)/∂N.
// It shares no code with the library.
#pragma once

#include <cmath>
#include <vector>

#include "support/pi.hpp"

namespace hapbeam::testing {

class PinnedPress {
 public:
  PinnedPress(double length, double EA, double EI) : L_(length), EA_(EA), EI_(EI) {}

  /// Force [N] of a press by d [m] at s [m]; its tension is left in tension().
  double operator()(double s, double d) {
    constexpr int terms = 3000;
    std::vector<double> square(terms);
    for (int n = 1; n <= terms; ++n)
      square[static_cast<std::size_t>(n - 1)] = std::pow(std::sin(n * pi * s / L_), 2);
    const double G0 = s * s * (L_ - s) * (L_ - s) / (3 * EI_ * L_);
    double G = G0;
    N_ = 0;
    // h(N) = N L/EA - ½ d² k'(N) is increasing and concave: Newton rises to its root from N = 0.
    for (int iteration = 0; iteration < 100; ++iteration) {
      double less = 0, first = 0, second = 0;  // of G: the second form's sum, -G', G''/2
      for (int n = terms; n >= 1; --n) {
        const double a = std::pow(n * pi / L_, 2), p = 1 / (EI_ * a + N_);
        const double part = 2 / L_ * square[static_cast<std::size_t>(n - 1)];
        less += part * p / (EI_ * a * a);
        first += part * p * p / a;
        second += part * p * p * p / a;
      }
      G = G0 - N_ * less;
      const double k1 = first / (G * G), k2 = 2 * (first * first / G - second) / (G * G);
      const double step = (d * d * k1 / 2 - N_ * L_ / EA_) / (L_ / EA_ - d * d * k2 / 2);
      N_ += step;
      if (std::abs(step) <= 1e-14 * N_) break;
    }
    return d / G;
  }
  double tension() const { return N_; }

 private:
  double L_, EA_, EI_, N_ = 0;
};

}  // namespace hapbeam::testing
