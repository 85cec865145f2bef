#include "panels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "colours.hpp"
#include "plot.hpp"

namespace phantom {

namespace {

using Member = float History::Moment::*;
constexpr double shown = 6;  // [s]

double largest(const History& history, Member member) {
  double most = 0;
  for (std::size_t i = 0; i < history.size(); ++i)
    most = std::max(most, std::abs(static_cast<double>(history[i].*member)));
  return most;
}

void over_time(ImDrawList& list, const char* title, const ImVec2& low, const ImVec2& high,
               const History& history, Member member, double least, const char* unit, double factor,
               ImU32 colour) {
  double bottom = 0;
  for (std::size_t i = 0; i < history.size(); ++i)
    bottom = std::min(bottom, static_cast<double>(history[i].*member));
  const double end = rounded_end(std::max(largest(history, member), least));
  Plot plot(list, title, low, high, {-shown, 0, "s"}, {bottom < -0.02 * end ? -end : 0, end, unit, factor});
  if (history.size() == 0) return;
  const double now = static_cast<double>(history[history.size() - 1].time);
  plot.line(
      history.size(), [&](std::size_t i) { return static_cast<double>(history[i].time) - now; },
      [&](std::size_t i) { return static_cast<double>(history[i].*member); }, colour, 2);
}

void force_against_depth(ImDrawList& list, const ImVec2& low, const ImVec2& high, const PanelData& data) {
  char title[80];
  std::snprintf(title, sizeof title, "force against depth, at %.4g mm", data.place * 1e3);
  const History& history = data.history;
  // Less than a second and a half: a trace, and not what was pressed elsewhere.
  const std::size_t from = history.size() > 1500 ? history.size() - 1500 : 0;
  double most = 0.05, least = 0;
  for (std::size_t i = from; i < history.size(); ++i) {
    most = std::max(most, static_cast<double>(history[i].force_up));
    least = std::min(least, static_cast<double>(history[i].force_up));
  }
  // A curve that grows much faster than the others leaves the diagram.
  std::vector<double> peaks;
  for (const Curve& curve : data.curves)
    peaks.push_back(static_cast<double>(*std::max_element(curve.force.begin(), curve.force.end())));
  std::sort(peaks.begin(), peaks.end());
  if (!peaks.empty()) most = std::max(most, std::min(peaks[peaks.size() / 2], 40.0));
  const double end = rounded_end(1.1 * most);
  Plot plot(list, title, low, high, {0, data.depth, "mm", 1e3}, {least < -0.05 * end ? -end : 0, end, "N"});
  constexpr ImU32 colours[] = {colour::sky, colour::blue, colour::green};
  for (std::size_t c = 0; c < data.curves.size(); ++c) {
    const Curve& curve = data.curves[c];
    plot.line(
        curve.depth.size(), [&](std::size_t i) { return static_cast<double>(curve.depth[i]); },
        [&](std::size_t i) { return static_cast<double>(curve.force[i]); }, colours[c % 3],
        4 - static_cast<float>(c));
    plot.key(curve.name, colours[c % 3]);
  }
  for (std::size_t i = from; i < history.size();) {
    std::size_t end_of_touch = i;
    while (end_of_touch < history.size() && history[end_of_touch].pressing) ++end_of_touch;
    if (end_of_touch > i)
      plot.line(
          end_of_touch - i, [&](std::size_t k) { return static_cast<double>(history[i + k].depth); },
          [&](std::size_t k) { return static_cast<double>(history[i + k].force_up); }, colour::vermilion, 2);
    i = end_of_touch + 1;
  }
  if (history.size() > 0) {
    const History::Moment& now = history[history.size() - 1];
    plot.point(static_cast<double>(now.depth), static_cast<double>(now.force_up), colour::vermilion);
  }
  plot.key("running", colour::vermilion);
}

void tick_times(ImDrawList& list, const ImVec2& low, const ImVec2& high, const History& history) {
  double all = 0, most = 0;
  for (const std::uint64_t count : history.counts()) {
    all += static_cast<double>(count);
    most = std::max(most, static_cast<double>(count));
  }
  const double end = all > 0 ? rounded_end(most / all) : 1;
  Plot plot(list, "time of a tick", low, high, {-1, 5, "", 1, true}, {0, end, "%", 100});
  for (std::size_t i = 0; i < History::bins && all > 0; ++i)
    if (const auto count = static_cast<double>(history.counts()[i]); count > 0)
      plot.bar(-1 + 0.1 * static_cast<double>(i), -1 + 0.1 * static_cast<double>(i + 1),
               std::max(count / all, 0.012 * end), colour::blue);
  plot.upright(3, colour::vermilion, "1 ms");
}

}  // namespace

void draw_panels(ImDrawList& list, const PanelData& data, const ImVec2& low, const ImVec2& high) {
  constexpr float shares[] = {0.18f, 0.18f, 0.27f, 0.19f, 0.18f};
  const float gap = 0.4f * ImGui::GetFontSize();
  float left = low.x;
  ImVec2 from[5], to[5];
  for (int i = 0; i < 5; ++i) {
    from[i] = {left, low.y};
    left += shares[i] * (high.x - low.x);
    to[i] = {i == 4 ? high.x : left - gap, high.y};
  }
  over_time(list, "force on the hand", from[0], to[0], data.history, &History::Moment::force, 1, "N", 1,
            colour::vermilion);
  over_time(list, "depth of the press", from[1], to[1], data.history, &History::Moment::depth, 1e-4, "mm",
            1e3, colour::blue);
  force_against_depth(list, from[2], to[2], data);
  tick_times(list, from[3], to[3], data.history);
  over_time(list, "energy generated", from[4], to[4], data.history, &History::Moment::energy, 1e-3, "mJ", 1e3,
            colour::purple);
}

}  // namespace phantom
