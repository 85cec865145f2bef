// How far apart two numbers are.
#pragma once

#include <cmath>

namespace hapbeam::testing {

/// |value - reference| / |reference|
inline double relative_error(double value, double reference) {
  return std::abs(value - reference) / std::abs(reference);
}

/// Order p of an error c hᵖ from its values at h and h/2.
inline double observed_order(double at_h, double at_half_h) { return std::log2(at_h / at_half_h); }

}  // namespace hapbeam::testing
