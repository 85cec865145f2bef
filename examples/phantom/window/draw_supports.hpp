// Supports as engineers draw them: a triangle, rollers under it, a hatched wall, a wall with rollers.
#pragma once

#include <imgui.h>

#include <hapbeam/beam.hpp>

namespace phantom {

/// @param at    [pixel] where the end of the centreline is   @param outward  -1 at the left end, 1 at the right
/// @param half  [pixel] of the beam's thickness   @param unit  [pixel] size of a symbol
void draw_support(ImDrawList& list, hapbeam::Support support, const ImVec2& at, float outward, float half,
                  float unit);

}  // namespace phantom
