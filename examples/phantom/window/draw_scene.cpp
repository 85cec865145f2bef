#include "draw_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <variant>

#include "colours.hpp"
#include "draw_supports.hpp"
#include "strokes.hpp"

namespace phantom {

SceneDrawing::SceneDrawing(const Body& body, const hapbeam::DeviceInfo& device)
    : exaggeration_(body.options().exaggeration),
      options_(body.options()),
      placement_(body.placement()),
      workspace_(device.workspace.head<2>() * options_.scale / 2),
      largest_strain_(least_strain) {
  constexpr int pieces = 240;
  const Shape shape = body.rest();
  const auto& rest = std::get<hapbeam::Centreline<double>>(shape);
  for (int i = 0; i <= pieces; ++i) {
    const double s = rest.length() * i / pieces;
    const auto d = rest.at(s);
    samples_.push_back({s, s + d.u, d.w, d.theta, s + d.u, d.w});
    rest_theta_.push_back(d.theta);
  }
}

void SceneDrawing::fit(const ImVec2& low, const ImVec2& high) {
  const Options& o = options_;
  double left = samples_[0].rest_x, right = left, top = 0, bottom = 0;
  for (const Sample& sample : samples_) {
    left = std::min(left, sample.rest_x), right = std::max(right, sample.rest_x);
    top = std::max(top, sample.rest_w), bottom = std::min(bottom, sample.rest_w);
  }
  const double span = right - left, above = 0.023 * o.scale * exaggeration_;
  // As far as the hand goes, or all of an array.
  const double below =
      std::max(o.pitch * (o.beams - 1), std::min(1.05 * o.depth * o.scale * exaggeration_, 1.1 * span));
  top += above + o.radius, bottom -= std::max(below, bottom < top ? 0.8 * (top - bottom) : 0);
  const double width = static_cast<double>(high.x - low.x), height = static_cast<double>(high.y - low.y);
  view_ = {low,
           high,
           std::min(width / (1.2 * span), height / (1.12 * (top - bottom))),
           {(left + right) / 2, (top + bottom) / 2},
           exaggeration_};
}

double SceneDrawing::rest_height(double x) const {
  const auto right = std::find_if(samples_.begin() + 1, samples_.end() - 1,
                                  [x](const Sample& sample) { return sample.rest_x >= x; });
  const Sample &a = *(right - 1), &b = *right;
  return a.rest_w + std::clamp((x - a.rest_x) / (b.rest_x - a.rest_x), 0.0, 1.0) * (b.rest_w - a.rest_w);
}

void SceneDrawing::sample(const DrawnBeam& beam) {
  const auto& shape = std::get<hapbeam::Centreline<double>>(beam.shape);
  above_ = beam.above;
  for (Sample& sample : samples_) {
    const auto d = shape.at(std::min(sample.s, shape.length()));
    sample.x = sample.s + d.u, sample.w = d.w, sample.theta = d.theta;
  }
}

void SceneDrawing::draw_axis(ImDrawList& list, double above, float unit) const {
  const auto at = [&](const Sample& p) { return view_({p.rest_x, p.rest_w + above}); };
  for (std::size_t i = 0; i + 4 < samples_.size(); i += 6)
    dashed(list, at(samples_[i]), at(samples_[i + 4]), colour::faint, 2 * unit);
}

void SceneDrawing::draw_workspace(ImDrawList& list, float unit) const {
  const Point middle = placement_.origin().head<2>();
  const ImVec2 a = view_(across_.drawn(middle + Point(-workspace_.x(), workspace_.y()))),
               b = view_(across_.drawn(middle + Point(workspace_.x(), -workspace_.y())));
  const ImVec2 corners[] = {a, {b.x, a.y}, b, {a.x, b.y}};
  for (int i = 0; i < 4; ++i) {
    const ImVec2 &from = corners[i], &to = corners[(i + 1) % 4];
    // Only what is seen, the outline may be a hundred times larger than the canvas; not through the words above and below.
    const ImVec2 low{view_.low.x - 50, view_.low.y + 2 * unit},
        high{view_.high.x + 50, view_.high.y - 4.5f * unit};
    const auto hidden = [&](const ImVec2& p) { return p.y < low.y || p.y > high.y; };
    if (hidden(from) && hidden(to) && from.y == to.y) continue;
    const auto clip = [&](const ImVec2& p) {
      return ImVec2{std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y)};
    };
    dashed(list, clip(from), clip(to), colour::with_alpha(colour::blue, 150), 0.4f * unit);
  }
  const float x = std::max(a.x, view_.low.x) + 0.4f * unit, y = std::max(a.y, view_.low.y + 2 * unit);
  if (a.x > view_.low.x) label(list, {x, y + 0.3f * unit}, colour::blue, "device's reach");
}

double SceneDrawing::drawn_half(float unit) const {
  return std::max(options_.beam.height / 2, 0.17 * static_cast<double>(unit) / view_.pixels);
}

Point SceneDrawing::seen(const Sample& p) const {
  return {p.rest_x + view_.exaggeration * (p.x - p.rest_x),
          above_ + p.rest_w + view_.exaggeration * (p.w - p.rest_w)};
}

void SceneDrawing::draw_strobe(ImDrawList& list, float unit) {
  int age = static_cast<int>(strobe_.size());
  for (const std::vector<Point>& shape : strobe_) {
    std::vector<ImVec2> points;
    for (const Point& p : shape) points.push_back(view_(p));
    list.AddPolyline(points.data(), static_cast<int>(points.size()),
                     colour::with_alpha(colour::blue, 200 - 190 * age-- / strobed), ImDrawFlags_None,
                     unit / 8);
  }
  strobe_.emplace_back();
  for (const Sample& sample : samples_) strobe_.back().push_back(seen(sample));
  if (strobe_.size() > strobed) strobe_.pop_front();
}

void SceneDrawing::draw_beam(ImDrawList& list, float unit) {
  const double half = drawn_half(unit);
  const float thin = unit / 12;
  std::vector<ImVec2> upper, lower;
  for (const Sample& p : samples_) {
    const Point at = seen(p);
    const double turn = p.theta;
    // The normal of the exaggerated curve is that of a displacement so much larger.
    const double slope = std::atan(view_.exaggeration * std::tan(std::clamp(turn, -1.5, 1.5)));
    const double angle = view_.exaggeration == 1 ? turn : slope;
    const Point normal(std::sin(angle), std::cos(angle));
    upper.push_back(view_(at + half * normal));
    lower.push_back(view_(at - half * normal));
  }
  const std::size_t n = samples_.size();
  std::vector<double> strain(n - 1);
  double largest = 0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double turned = (samples_[i + 1].theta - rest_theta_[i + 1]) - (samples_[i].theta - rest_theta_[i]);
    strain[i] = std::abs(turned / (samples_[i + 1].s - samples_[i].s)) * options_.beam.height / 2;
    largest = std::max(largest, strain[i]);
  }
  if (largest > largest_strain_) largest_strain_ = rounded_up(largest);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const ImVec2 quad[] = {upper[i], upper[i + 1], lower[i + 1], lower[i]};
    // Without anti-aliasing, whose seams would show; the outline smooths the edge.
    const ImDrawListFlags flags = list.Flags;
    list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    list.AddConvexPolyFilled(quad, 4, colour::viridis(strain[i] / largest_strain_));
    list.Flags = flags;
  }
  list.AddPolyline(upper.data(), static_cast<int>(n), colour::ink, ImDrawFlags_None, thin);
  list.AddPolyline(lower.data(), static_cast<int>(n), colour::ink, ImDrawFlags_None, thin);
  list.AddLine(upper[0], lower[0], colour::ink, thin);
  list.AddLine(upper[n - 1], lower[n - 1], colour::ink, thin);
  const auto middle = [](const ImVec2& a, const ImVec2& b) {
    return ImVec2{(a.x + b.x) / 2, (a.y + b.y) / 2};
  };
  const float size = 1.3f * unit, drawn = static_cast<float>(half * view_.pixels);
  draw_support(list, options_.beam.left, middle(upper[0], lower[0]), -1, drawn, size);
  draw_support(list, options_.beam.right, middle(upper[n - 1], lower[n - 1]), 1, drawn, size);
}

void SceneDrawing::draw_hand(ImDrawList& list, const hapbeam::ServoRecord& r, const Eigen::Vector3d& target,
                             float unit) const {
  const ImVec2 wanted = view_(across_.drawn(placement_.beam_position(target)));
  spring(list, wanted, view_(across_.drawn(r.hand.head<2>())), colour::faint, unit);
  cross(list, wanted, unit);
  draw_avatar(list, r, across_, colour::orange, unit);
}

void SceneDrawing::draw_second(ImDrawList& list, const hapbeam::ServoRecord& r, float unit) const {
  const Across across = this->across(r);
  draw_avatar(list, r, across, colour::sky, unit);
  name_second(list, view_(across.drawn(r.hand.head<2>())), static_cast<float>(options_.radius * view_.pixels),
              unit);
}

void SceneDrawing::draw_avatar(ImDrawList& list, const hapbeam::ServoRecord& r, const Across& across,
                               ImU32 colour, float unit) const {
  const ImVec2 avatar = view_(across.drawn(r.avatar.head<2>())), hand = view_(across.drawn(r.hand.head<2>()));
  const float radius = std::max(static_cast<float>(options_.radius * view_.pixels), 0.25f * unit);
  // The arm's tip is where the device is; the avatar is where the coupling lets it press.
  list.AddLine(hand, avatar, colour::blue, unit / 9);
  list.AddCircleFilled(hand, 0.2f * unit, colour::blue);
  list.AddCircleFilled(avatar, radius, colour::with_alpha(colour, 200));
  list.AddCircle(avatar, radius, colour::ink, 0, unit / 9);

  const double force = r.force.norm();
  if (!(force > 0.02)) return;
  const Point along = r.force.head<2>() / force;
  const float length = arrow_length(force, unit);
  const auto ax = static_cast<float>(along.x()), ay = static_cast<float>(-along.y());
  const ImVec2 from{avatar.x + ax * radius, avatar.y + ay * radius};
  const ImVec2 to{from.x + ax * length, from.y + ay * length};
  arrow(list, from, to, colour::vermilion, unit);
  label(list, {to.x + 0.6f * unit, to.y - 0.3f * unit}, colour::vermilion, text("%.2f N", force));
}

void SceneDrawing::draw_legend(ImDrawList& list, float unit) const {
  const float line = 1.25f * unit, left = view_.low.x + unit, bottom = view_.high.y - unit;
  // Scale bar: a twelfth of the canvas or more, rounded.
  const double bar = rounded_up(static_cast<double>(view_.high.x - view_.low.x) / view_.pixels / 12);
  const auto pixels = static_cast<float>(bar * view_.pixels);
  list.AddLine({left, bottom}, {left + pixels, bottom}, colour::ink, unit / 7);
  for (const float x : {left, left + pixels})
    list.AddLine({x, bottom - 0.3f * unit}, {x, bottom + 0.3f * unit}, colour::ink, unit / 7);
  label(list, {left + pixels + 0.6f * unit, bottom - 0.6f * unit}, colour::ink, metres(bar));
  // One under the other, so that a narrow window has room for the strain beside them.
  float above = bottom - 0.8f * unit - line;
  if (drawn_half(unit) > options_.beam.height / 2)
    label(list, {left, above}, colour::ink, "thickness not to scale"), above -= line;
  label(list, {left, above}, colour::ink,
        view_.exaggeration == 1 ? "displacements true to scale"
                                : text("displacements exaggerated %g times", view_.exaggeration));

  strain_bar(list, view_.high.x - unit, bottom, largest_strain_, unit);
}

Across SceneDrawing::across(const hapbeam::ServoRecord& r) const {
  const double rest = rest_height(r.avatar.x()), reach = options_.radius + options_.beam.height / 2;
  const bool below = r.pressing ? r.force.y() < 0 : r.avatar.y() < rest;
  return {below ? rest - reach : rest + reach, view_.exaggeration};
}

void SceneDrawing::draw(ImDrawList& list, const Session::Picture& picture, const Eigen::Vector3d& target,
                        const ImVec2& low, const ImVec2& high, float unit) {
  fit(low, high);
  const hapbeam::ServoRecord& r = picture.record;
  across_ = across(r);

  list.PushClipRect(low, high, true);
  list.AddRectFilled(low, high, colour::paper);
  draw_workspace(list, unit);
  if (!picture.swings) strobe_.clear();
  for (const DrawnBeam& beam : picture.body.beams) draw_axis(list, beam.above, unit);
  for (const DrawnBeam& beam : picture.body.beams) {
    sample(beam);
    if (picture.swings) draw_strobe(list, unit);
    draw_beam(list, unit);
  }
  if (picture.second) draw_second(list, *picture.second, unit);
  draw_hand(list, r, target, unit);
  draw_legend(list, unit);
  list.PopClipRect();
}

Eigen::Vector3d SceneDrawing::device_position(const ImVec2& cursor, const Eigen::Vector3d&) const {
  const Point scene = across_.real(view_.inverse(cursor));
  return placement_.device_position({scene.x(), scene.y(), 0});
}

void SceneDrawing::choose() {
  char now[40];
  std::snprintf(now, sizeof now, exaggeration_ == 1 ? "true to scale" : "%g times", exaggeration_);
  if (!begin_choice("drawn", "##exaggeration", now)) return;
  for (const double x : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    std::snprintf(now, sizeof now, x == 1 ? "true to scale" : "displacements %g times", x);
    if (ImGui::Selectable(now, exaggeration_ == x)) exaggeration_ = x;
  }
  ImGui::EndCombo();
}

}  // namespace phantom
