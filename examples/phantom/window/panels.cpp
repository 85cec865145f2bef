#include "panels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
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

enum class Felt { here, elsewhere, cut };
constexpr ImU32 felt_colours[] = {colour::vermilion, IM_COL32(240, 190, 155, 255), colour::ink};

/// The last touch, in which the hand may have gone on along the beam, and the device may have cut the force.
struct Trace {
  Trace(const PanelData& data)
      : history(data.history),
        place(data.place),
        beside(data.pressed == Pressed::way ? std::numeric_limits<double>::infinity() : data.beside) {
    end = history.size();
    while (end > 0 && !history[end - 1].pressing) --end;
    begin = data.pressed == Pressed::way ? 0 : end;
    while (begin > 0 && history[begin - 1].pressing) --begin;
    for (std::size_t i = begin; i < end; ++i) {
      const auto force = static_cast<double>(history[i].force_against),
                 depth = static_cast<double>(history[i].depth);
      most = std::max(most, force), least = std::min(least, force), above = std::min(above, depth);
      seen[static_cast<int>(felt(i))] = true;
    }
  }
  Felt felt(std::size_t i) const {
    if (history[i].cut) return Felt::cut;
    return std::abs(static_cast<double>(history[i].place) - place) <= beside ? Felt::here : Felt::elsewhere;
  }
  void draw(Plot& plot) const {
    for (std::size_t i = begin; i < end;) {
      std::size_t next = i + 1;
      while (next < end && felt(next) == felt(i)) ++next;
      // To the next stretch's first, so that there is no gap.
      plot.line(
          std::min(next + 1, end) - i,
          [&](std::size_t k) { return static_cast<double>(history[i + k].depth); },
          [&](std::size_t k) { return static_cast<double>(history[i + k].force_against); },
          felt_colours[static_cast<int>(felt(i))], 2);
      i = next;
    }
    if (end > begin && end == history.size())
      plot.point(static_cast<double>(history[end - 1].depth),
                 static_cast<double>(history[end - 1].force_against),
                 felt_colours[static_cast<int>(felt(end - 1))]);
  }

  const History& history;
  double place, beside;                   // [m] along the beam
  std::size_t begin, end;                 // moments
  double most = 0, least = 0, above = 0;  // [N] felt; [m] pressed from below
  bool seen[3] = {false, false, false};
};

void force_against_depth(ImDrawList& list, const ImVec2& low, const ImVec2& high, const PanelData& data) {
  char title[80];
  if (data.pressed == Pressed::way) std::snprintf(title, sizeof title, "force against the way of the hand");
  else std::snprintf(title, sizeof title, "force against depth, at %.4g mm", data.place * 1e3);
  const Trace trace(data);
  // A curve that grows much faster than the others leaves the diagram.
  std::vector<double> peaks;
  for (const Curve& curve : data.curves)
    peaks.push_back(static_cast<double>(*std::max_element(curve.force.begin(), curve.force.end())));
  std::sort(peaks.begin(), peaks.end());
  double most = std::max(trace.most, 0.05);
  if (!peaks.empty()) most = std::max(most, std::min(peaks[peaks.size() / 2], 40.0));
  const double end = rounded_end(std::max(1.1 * most, -trace.least));
  constexpr ImU32 colours[] = {colour::sky, colour::blue, colour::green};
  std::vector<Plot::Key> keys;
  for (std::size_t c = 0; c < data.curves.size(); ++c) keys.push_back({data.curves[c].name, colours[c % 3]});
  constexpr const char* felt[] = {"felt", "elsewhere", "cut by device"};
  for (int i = 0; i < 3; ++i)
    if (i == 0 || trace.seen[i]) keys.push_back({felt[i], felt_colours[i]});
  const double left = trace.above < -0.05 * data.depth ? -data.depth : 0;
  Plot plot(list, title, low, high, {left, data.depth, "mm", 1e3},
            {trace.least < -0.05 * end ? -end : 0, end, "N"}, keys);
  for (std::size_t c = 0; c < data.curves.size(); ++c) {
    const Curve& curve = data.curves[c];
    plot.line(
        curve.depth.size(), [&](std::size_t i) { return static_cast<double>(curve.depth[i]); },
        [&](std::size_t i) { return static_cast<double>(curve.force[i]); }, colours[c % 3],
        4 - static_cast<float>(c));
  }
  trace.draw(plot);
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
  constexpr float shares[] = {0.22f, 0.22f, 0.34f, 0.22f};
  const float gap = 0.4f * ImGui::GetFontSize();
  float left = low.x;
  ImVec2 from[4], to[4];
  for (int i = 0; i < 4; ++i) {
    from[i] = {left, low.y};
    left += shares[i] * (high.x - low.x);
    to[i] = {i == 3 ? high.x : left - gap, high.y};
  }
  over_time(list, "force on the hand", from[0], to[0], data.history, &History::Moment::force, 1, "N", 1,
            colour::vermilion);
  constexpr const char* titles[] = {"depth of the press", "way of the hand", "deflection"};
  over_time(list, titles[static_cast<int>(data.pressed)], from[1], to[1], data.history,
            data.pressed == Pressed::with_mass ? &History::Moment::moved : &History::Moment::depth, 1e-4,
            "mm", 1e3, colour::blue);
  force_against_depth(list, from[2], to[2], data);
  tick_times(list, from[3], to[3], data.history);
}

}  // namespace phantom
