// The diagrams below the scene: force and depth over time, force against depth beside other models, tick times, energy.
#pragma once

#include <imgui.h>
#include <vector>

#include "curves.hpp"
#include "history.hpp"

namespace phantom {

struct PanelData {
  const History& history;
  const std::vector<Curve>& curves;  ///< at the place that is pressed
  double place;                      ///< [m] of the curves
  double near;                       ///< [m] beside that place, where they still hold
  double depth;                      ///< [m] of the curves
  int hands;
};

void draw_panels(ImDrawList& list, const PanelData& data, const ImVec2& low, const ImVec2& high);

}  // namespace phantom
