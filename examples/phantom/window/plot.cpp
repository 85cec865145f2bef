#include "plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "colours.hpp"

namespace phantom {

double rounded_end(double x) {
  const double decade = std::pow(10, std::floor(std::log10(std::max(x, 1e-12))));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 5.0})
    if (step * decade >= x * (1 - 1e-9)) return step * decade;
  return 10 * decade;
}

Plot::Plot(ImDrawList& list, const char* title, const ImVec2& low, const ImVec2& high, const Axis& x,
           const Axis& y, const std::vector<Key>& keys)
    : list_(list), x_(x), y_(y), unit_(ImGui::GetFontSize()) {
  list_.AddRectFilled(low, high, colour::paper, 4);
  list_.AddText({low.x + 0.5f * unit_, low.y + 0.15f * unit_}, colour::ink, title);
  const float above = draw_keys(keys, {low.x + 0.5f * unit_, low.y + 1.3f * unit_}, high.x);
  // The last figure of the upright axis stands half above it.
  low_ = {low.x + 4.3f * unit_, above + 0.65f * unit_};
  high_ = {high.x - 0.9f * unit_, high.y - 1.6f * unit_};
  frame();
  list_.PushClipRect(low_, high_, true);
}

float Plot::pixel_x(double x) const {
  return low_.x + static_cast<float>((x - x_.from) / (x_.to - x_.from)) * (high_.x - low_.x);
}
float Plot::pixel_y(double y) const {
  return high_.y - static_cast<float>((y - y_.from) / (y_.to - y_.from)) * (high_.y - low_.y);
}

void Plot::frame() {
  list_.AddRectFilled(low_, high_, IM_COL32_WHITE);
  const auto figure = [](double value, const std::string& unit) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4g%s%s", std::abs(value) < 1e-12 ? 0 : value, unit.empty() ? "" : " ",
                  unit.c_str());
    return std::string(text);
  };
  const auto power = [](double exponent) {
    char text[40];
    const double us = std::pow(10, exponent);
    std::snprintf(text, sizeof text, "%.3g %s", us < 999 ? us : us / 1e3, us < 999 ? "µs" : "ms");
    return std::string(text);
  };
  constexpr int parts = 2;
  for (int i = 0; i <= parts; ++i) {
    const double x = x_.from + (x_.to - x_.from) * i / parts, y = y_.from + (y_.to - y_.from) * i / parts;
    const float px = pixel_x(x), py = pixel_y(y);
    list_.AddLine({px, low_.y}, {px, high_.y}, colour::grid);
    list_.AddLine({low_.x, py}, {high_.x, py}, colour::grid);
    const std::string fx = x_.times ? power(x) : figure(x * x_.factor, i == parts ? x_.unit : "");
    const std::string fy = figure(y * y_.factor, i == parts ? y_.unit : "");
    const ImVec2 sx = ImGui::CalcTextSize(fx.c_str()), sy = ImGui::CalcTextSize(fy.c_str());
    // The first one does not begin below the last of the upright axis.
    const float left = std::clamp(px - sx.x / 2, low_.x - 0.2f * unit_, high_.x + 0.7f * unit_ - sx.x);
    const bool crowded = high_.x - low_.x < 9 * unit_ && i > 0 && i < parts;
    if (!crowded) list_.AddText({left, high_.y + 0.15f * unit_}, colour::faint, fx.c_str());
    list_.AddText({low_.x - sy.x - 0.3f * unit_, py - sy.y / 2}, colour::faint, fy.c_str());
  }
  list_.AddRect(low_, high_, colour::faint);
}

void Plot::line(std::size_t count, const std::function<double(std::size_t)>& x,
                const std::function<double(std::size_t)>& y, ImU32 colour, float width) {
  std::vector<ImVec2> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ImVec2 point{pixel_x(x(i)), std::clamp(pixel_y(y(i)), low_.y - 1e4f, high_.y + 1e4f)};
    if (points.empty() || std::hypot(point.x - points.back().x, point.y - points.back().y) > 0.7f)
      points.push_back(point);
  }
  // Piece by piece: a polyline has no width where it turns back.
  for (std::size_t i = 1; i < points.size(); ++i)
    list_.AddLine(points[i - 1], points[i], colour, width * unit_ / 14);
}

void Plot::bar(double from, double to, double height, ImU32 colour) {
  list_.AddRectFilled({pixel_x(from), pixel_y(height)}, {pixel_x(to), high_.y}, colour);
}

void Plot::point(double x, double y, ImU32 colour) {
  list_.AddCircleFilled({pixel_x(x), pixel_y(y)}, 0.25f * unit_, colour);
}

void Plot::upright(double x, ImU32 colour, const char* text) {
  const float at = pixel_x(x);
  list_.AddLine({at, low_.y}, {at, high_.y}, colour, unit_ / 7);
  const ImVec2 size = ImGui::CalcTextSize(text);
  list_.AddText({at - size.x - 0.3f * unit_, low_.y + 0.2f * unit_}, colour, text);
}

float Plot::draw_keys(const std::vector<Key>& keys, const ImVec2& low, float right) {
  const float dash = unit_, line = 1.15f * unit_;
  ImVec2 at = low;
  for (const Key& key : keys) {
    const float width = 1.3f * dash + ImGui::CalcTextSize(key.text).x;
    if (at.x > low.x && at.x + width > right) at = {low.x, at.y + line};
    list_.AddLine({at.x, at.y + 0.55f * unit_}, {at.x + dash, at.y + 0.55f * unit_}, key.colour, unit_ / 7);
    list_.AddText({at.x + 1.3f * dash, at.y}, colour::ink, key.text);
    at.x += width + 0.7f * unit_;
  }
  return keys.empty() ? low.y : at.y + line;
}

}  // namespace phantom
