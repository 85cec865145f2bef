// A steel ruler of 300 × 25 × 1 mm, held at its left end: what turns far and lets a hand slip off.
#pragma once

#include <hapbeam/beam.hpp>

namespace hapbeam::testing {

inline constexpr double ruler_length = 0.3, ruler_thickness = 0.001;  // [m]

inline Beam steel_ruler(Support left = Support::clamped, Support right = Support::free) {
  return {ruler_length, Section::rectangle(0.025, ruler_thickness), Material{206.84e9}, left, right};
}

}  // namespace hapbeam::testing
