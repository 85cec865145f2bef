// Colours that people with any colour vision can tell apart: viridis for a magnitude, Okabe and Ito's for kinds.
// Sources: S. van der Walt and N. Smith, matplotlib (CC0); M. Okabe and K. Ito, "Color universal design", 2008.
#pragma once

#include <algorithm>
#include <imgui.h>

namespace phantom::colour {

constexpr ImU32 ink = IM_COL32(40, 44, 52, 255);
constexpr ImU32 faint = IM_COL32(120, 128, 140, 255);
constexpr ImU32 grid = IM_COL32(214, 218, 224, 255);
constexpr ImU32 paper = IM_COL32(252, 252, 250, 255);
constexpr ImU32 blue = IM_COL32(0, 114, 178, 255);
constexpr ImU32 sky = IM_COL32(86, 180, 233, 255);
constexpr ImU32 vermilion = IM_COL32(213, 94, 0, 255);
constexpr ImU32 green = IM_COL32(0, 158, 115, 255);
constexpr ImU32 orange = IM_COL32(230, 159, 0, 255);

/// @param x  0 to 1
inline ImU32 viridis(double x) {
  constexpr int knots = 9;
  constexpr int map[knots][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                 {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                 {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
  const double at = std::clamp(x, 0.0, 1.0) * (knots - 1);
  const int i = std::min(static_cast<int>(at), knots - 2);
  const auto mix = [&](int c) {
    return static_cast<int>(map[i][c] + (at - i) * (map[i + 1][c] - map[i][c]) + 0.5);
  };
  return IM_COL32(mix(0), mix(1), mix(2), 255);
}

inline ImU32 with_alpha(ImU32 colour, int alpha) {
  return (colour & ~IM_COL32_A_MASK) | (static_cast<ImU32>(alpha) << IM_COL32_A_SHIFT);
}

}  // namespace phantom::colour
