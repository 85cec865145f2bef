#include "strokes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "colours.hpp"

namespace phantom {

void label(ImDrawList& list, ImVec2 at, ImU32 colour, const std::string& line) {
  // A rim of paper, which cuts less of what is behind than a box does.
  const float rim = ImGui::GetFontSize() / 9;
  for (int k = 0; k < 8; ++k) {
    const float angle = 0.7853982f * static_cast<float>(k);
    list.AddText({at.x + rim * std::cos(angle), at.y + rim * std::sin(angle)},
                 colour::with_alpha(colour::paper, 200), line.c_str());
  }
  list.AddText(at, colour, line.c_str());
}

void name_second(ImDrawList& list, const ImVec2& avatar, float radius, float unit) {
  const char* const name = "second hand";
  const float width = ImGui::CalcTextSize(name).x;
  label(list, {avatar.x - radius - 0.6f * unit - width, avatar.y + 1.8f * unit}, colour::blue, name);
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

float arrow_length(double force, float unit) {
  return static_cast<float>((1.5 + 4.5 * std::min(force / 20, 1.5)) * static_cast<double>(unit));
}

void arrow(ImDrawList& list, const ImVec2& from, const ImVec2& to, ImU32 colour, float unit) {
  const float length = std::hypot(to.x - from.x, to.y - from.y), head = std::min(0.55f * unit, length);
  if (!(length > 0)) return;
  const float ax = (to.x - from.x) / length, ay = (to.y - from.y) / length;
  const ImVec2 neck{to.x - ax * head, to.y - ay * head};
  list.AddLine(from, neck, colour, std::max(2.0f, unit / 6));
  list.AddTriangleFilled(to, {neck.x - ay * head * 0.5f, neck.y + ax * head * 0.5f},
                         {neck.x + ay * head * 0.5f, neck.y - ax * head * 0.5f}, colour);
}

void cross(ImDrawList& list, const ImVec2& at, float unit) {
  list.AddLine({at.x - 0.5f * unit, at.y}, {at.x + 0.5f * unit, at.y}, colour::ink, unit / 9);
  list.AddLine({at.x, at.y - 0.5f * unit}, {at.x, at.y + 0.5f * unit}, colour::ink, unit / 9);
}

void strain_bar(ImDrawList& list, float right, float bottom, double largest, float unit) {
  if (!(largest > least_strain)) return;
  const float line = 1.25f * unit, width = 13.5f * unit, top = bottom - 0.7f * unit;
  constexpr int steps = 64;
  for (int i = 0; i < steps; ++i) {
    const float a = right - width + width * static_cast<float>(i) / steps;
    list.AddRectFilled({a, top}, {a + width / steps + 1, bottom + 0.1f * unit},
                       colour::viridis((i + 0.5) / steps));
  }
  list.AddRect({right - width, top}, {right + 1, bottom + 0.1f * unit}, colour::ink);
  label(list, {right - width, top - line}, colour::ink, "0");
  const std::string most = text("%g", largest * 1e6) + " µm/m";
  label(list, {right - ImGui::CalcTextSize(most.c_str()).x, top - line}, colour::ink, most);
  label(list, {right - width, top - 2 * line}, colour::ink, "bending strain at the surface");
}

bool begin_choice(const char* title, const char* id, const char* chosen) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(title);
  ImGui::SameLine(4.6f * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1);
  return ImGui::BeginCombo(id, chosen);
}

double rounded_up(double x) {
  const double decade = std::pow(10, std::floor(std::log10(x)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= x * (1 - 1e-9)) return step * decade;
  return 10 * decade;
}

std::string text(const char* format, double value) {
  char line[80];
  std::snprintf(line, sizeof line, format, value);
  return line;
}

std::string metres(double length) {
  return length < 1 ? text("%g mm", std::round(length * 1e6) / 1e3) : text("%g m", length);
}

}  // namespace phantom
