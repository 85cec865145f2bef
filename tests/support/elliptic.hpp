// Elliptic integrals by the arithmetic-geometric mean, and with them the buckled elastica and that under a tip load.
// Source: Abramowitz and Stegun, 17.6; Timoshenko and Gere, Theory of Elastic Stability, 2.7; Bisshopp and Drucker, Large
// deflection of cantilever beams, Quart. Appl. Math. 3 (1945).
#pragma once

#include <cmath>

#include "support/pi.hpp"

namespace hapbeam::testing {

struct CompleteElliptic {
  double K, E;  ///< ∫(1 - k² sin² t)^∓½ dt over a quarter

  explicit CompleteElliptic(double k) {
    double a = 1, b = std::sqrt((1 - k) * (1 + k)), c = k, sum = c * c / 2, weight = 1;
    while (std::abs(c) > 1e-16) {
      const double mean = (a + b) / 2;
      c = (a - b) / 2;
      b = std::sqrt(a * b);
      a = mean;
      sum += weight * c * c;
      weight *= 2;
    }
    K = std::acos(-1.0) / (2 * a);
    E = K * (1 - sum);
  }
};

/// ∫(1 - k² sin² t)^-½ dt from 0 to phi, which is at most a quarter.
inline double incomplete_elliptic(double k, double phi) {
  double a = 1, b = std::sqrt((1 - k) * (1 + k)), c = k, weight = 1;
  while (std::abs(c) > 1e-16) {
    phi += std::atan(b / a * std::tan(phi)) + pi * std::floor(phi / pi + 0.5);
    const double mean = (a + b) / 2;
    c = (a - b) / 2;
    b = std::sqrt(a * b);
    a = mean;
    weight *= 2;
  }
  return phi / (weight * a);
}

/// Slope angle of the tip of an inextensible cantilever under a dead load P across its end, on the branch that begins where
/// P is zero: √α = K(k) - F(k, φ), k² = (1 + sin θ)/2, k sin φ = √½.  @param alpha  PL²/EI
inline double cantilever_tip_slope(double alpha) {
  double low = 0, high = std::acos(-1.0) / 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2, k = std::sqrt((1 + std::sin(middle)) / 2);
    const double root = CompleteElliptic(k).K - incomplete_elliptic(k, std::asin(std::sqrt(0.5) / k));
    (root * root < alpha ? low : high) = middle;
  }
  return low;
}

/// The inextensible beam whose ends, both hinged or both clamped, have been moved together by `shortening` lengths.
struct BuckledElastica {
  double middle;  ///< deflection of the middle, in lengths: k/K
  double load;    ///< of its ends, in Euler's loads: (2K/π)²

  explicit BuckledElastica(double shortening) {
    double low = 0, high = 0.9;  // 2 - 2E/K rises with k
    for (int i = 0; i < 60; ++i) {
      const double k = (low + high) / 2;
      const CompleteElliptic at(k);
      (2 - 2 * at.E / at.K < shortening ? low : high) = k;
    }
    const CompleteElliptic at(low);
    middle = low / at.K;
    load = std::pow(2 * at.K / std::acos(-1.0), 2);
  }
};

}  // namespace hapbeam::testing
