// The diagrams below the scene: force and depth over time, force against depth beside other models, tick times.
#pragma once

#include <imgui.h>
#include <vector>

#include "curves.hpp"
#include "history.hpp"

namespace phantom {

/// A beam, whose depth is that of the press; an array or a vessel, through which the hand goes: its way is told; or a beam with mass: how it decays.
enum class Pressed { beam, way, with_mass };

struct PanelData {
  const History& history;
  const std::vector<Curve>& curves;  ///< at the place that is pressed
  double place;                      ///< [m] of the curves
  double beside;                     ///< [m] of that place, where they still hold
  double depth;                      ///< [m] of the curves
  Pressed pressed;
};

void draw_panels(ImDrawList& list, const PanelData& data, const ImVec2& low, const ImVec2& high);

}  // namespace phantom
