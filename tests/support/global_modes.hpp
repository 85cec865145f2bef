// The pinned beam in the space of its first modes, sin(nπx/L), which do not move with the contact.
#pragma once

#include <cmath>

#include "support/pi.hpp"
#include "support/thesis_beam.hpp"

namespace hapbeam::testing {

/// Force of a press of the thesis' beam.  Each mode has its own buckling load, and the tension is found by bisection.
inline double force_in_global_modes(int modes, double s, double d) {
  const double L = thesis_length;
  const auto compliance = [&](double N) {
    double sum = 0;
    for (int n = 1; n <= modes; ++n) {
      const double a = std::pow(n * pi / L, 2);
      sum += 2 / L * std::pow(std::sin(n * pi * s / L), 2) / (a * (thesis_EI * a + N));
    }
    return sum;
  };
  const auto excess = [&](double N) {  // ½ d² k'(N) - N L/EA
    const double h = 1e-4 * (N + 1);
    return d * d / 2 * (1 / compliance(N + h) - 1 / compliance(N - h)) / (2 * h) - N * L / thesis_EA;
  };
  double low = 0, high = 1e8;
  for (int k = 0; k < 200; ++k) (excess((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
  return d / compliance(low);
}

}  // namespace hapbeam::testing
