#include "strokes.hpp"

#include <algorithm>
#include <cmath>

#include "colours.hpp"

namespace phantom {

void label(ImDrawList& list, ImVec2 at, ImU32 colour, const std::string& line) {
  const ImVec2 size = ImGui::CalcTextSize(line.c_str());
  list.AddRectFilled({at.x - 3, at.y - 1}, {at.x + size.x + 3, at.y + size.y + 1},
                     colour::with_alpha(colour::paper, 245), 3);
  list.AddText(at, colour, line.c_str());
}

void dashed(ImDrawList& list, const ImVec2& a, const ImVec2& b, ImU32 colour, float dash) {
  const float length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length > 0)) return;
  const ImVec2 way{(b.x - a.x) / length, (b.y - a.y) / length};
  for (float at = 0; at < length; at += 2 * dash) {
    const float end = std::min(at + dash, length);
    list.AddLine({a.x + at * way.x, a.y + at * way.y}, {a.x + end * way.x, a.y + end * way.y}, colour, 1.2f);
  }
}

void spring(ImDrawList& list, const ImVec2& a, const ImVec2& b, ImU32 colour, float unit) {
  const float length = std::hypot(b.x - a.x, b.y - a.y);
  if (length < 1) return;
  const ImVec2 across{-(b.y - a.y) / length * unit * 0.25f, (b.x - a.x) / length * unit * 0.25f};
  constexpr int turns = 12;
  ImVec2 points[turns + 1];
  for (int i = 0; i <= turns; ++i) {
    const float t = static_cast<float>(i) / turns;
    const float side = i < 2 || i > turns - 2 ? 0.0f : i % 2 == 0 ? 1.0f : -1.0f;
    points[i] = {a.x + t * (b.x - a.x) + side * across.x, a.y + t * (b.y - a.y) + side * across.y};
  }
  list.AddPolyline(points, turns + 1, colour, ImDrawFlags_None, std::max(1.0f, unit / 12));
}

}  // namespace phantom
