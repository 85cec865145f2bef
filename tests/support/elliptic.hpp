// Complete elliptic integrals by the arithmetic-geometric mean, and the buckled elastica in closed form with them.
// Source: Abramowitz and Stegun, 17.6; Timoshenko and Gere, Theory of Elastic Stability, 2.7.
#pragma once

#include <cmath>

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
