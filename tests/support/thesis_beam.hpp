// The beam of the thesis' examples, 100 in × 1 in × 1 in of steel, in SI.
#pragma once

#include <hapbeam/beam.hpp>

namespace hapbeam::testing {

inline constexpr double inch = 0.0254;              // [m]
inline constexpr double lbf = 4.4482216152605;      // [N]
inline constexpr double psi = lbf / (inch * inch);  // [Pa]

inline constexpr double thesis_length = 100 * inch;
inline constexpr double thesis_young = 30e6 * psi;  // 206.8427 GPa; the thesis prints 206
inline constexpr double thesis_EA = thesis_young * inch * inch;
inline constexpr double thesis_EI = thesis_young * inch * inch * inch * inch / 12;

inline Beam thesis_beam(Support left, Support right, double length = thesis_length) {
  return Beam(length, Section::rectangle(inch, inch), Material{thesis_young}, left, right);
}

inline Beam pinned() { return thesis_beam(Support::pinned, Support::pinned); }

/// Left half of a beam whose ends are alike: symmetric at mid-span.
inline Beam thesis_half(Support end) { return thesis_beam(end, Support::guided, thesis_length / 2); }

}  // namespace hapbeam::testing
