#include "draw_supports.hpp"

#include <algorithm>

#include "colours.hpp"

namespace phantom {

namespace {

/// Ground: a line with strokes behind it.  Along x below a point, or along y beside one.
void hatch(ImDrawList& list, const ImVec2& from, const ImVec2& to, const ImVec2& behind, float width) {
  list.AddLine(from, to, colour::ink, width * 1.5f);
  constexpr int strokes = 6;
  for (int i = 0; i < strokes; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / strokes;
    const ImVec2 p{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
    list.AddLine(p, {p.x + behind.x, p.y + behind.y}, colour::faint, width);
  }
}

void triangle(ImDrawList& list, const ImVec2& tip, float unit, float width) {
  const ImVec2 left{tip.x - 0.6f * unit, tip.y + unit}, right{tip.x + 0.6f * unit, tip.y + unit};
  list.AddTriangleFilled(tip, left, right, colour::paper);
  list.AddTriangle(tip, left, right, colour::ink, width);
  list.AddCircleFilled(tip, 0.17f * unit, colour::paper);
  list.AddCircle(tip, 0.17f * unit, colour::ink, 0, width);
}

void wall(ImDrawList& list, const ImVec2& at, float outward, float reach, float unit, float width) {
  hatch(list, {at.x, at.y - reach}, {at.x, at.y + reach}, {outward * 0.4f * unit, -0.4f * unit}, width);
}

}  // namespace

void draw_support(ImDrawList& list, hapbeam::Support support, const ImVec2& at, float outward, float half,
                  float unit) {
  using hapbeam::Support;
  const float width = std::max(1.0f, unit / 14), reach = std::max(1.2f * unit, half + 0.5f * unit);
  const float foot = at.y + unit, r = 0.17f * unit;
  switch (support) {
    case Support::free: return;
    case Support::clamped: return wall(list, at, outward, reach, unit, width);
    case Support::pinned:
      triangle(list, at, unit, width);
      return hatch(list, {at.x - unit, foot}, {at.x + unit, foot}, {-0.35f * unit, 0.4f * unit}, width);
    case Support::roller:
      triangle(list, at, unit, width);
      for (const float x : {-0.35f, 0.35f})
        list.AddCircle({at.x + x * unit, foot + r}, r, colour::ink, 0, width);
      return hatch(list, {at.x - unit, foot + 2 * r}, {at.x + unit, foot + 2 * r},
                   {-0.35f * unit, 0.4f * unit}, width);
    case Support::guided:
      for (const float y : {-0.5f, 0.5f})
        list.AddCircle({at.x + outward * r, at.y + y * unit}, r, colour::ink, 0, width);
      return wall(list, {at.x + outward * 2 * r, at.y}, outward, reach, unit, width);
  }
}

}  // namespace phantom
