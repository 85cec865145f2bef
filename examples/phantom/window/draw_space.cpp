#include "draw_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <variant>

#include "../scene.hpp"
#include "colours.hpp"
#include "draw_scene.hpp"
#include "strokes.hpp"

namespace phantom {

namespace {

constexpr int pieces = 240;
constexpr ImU32 shade = IM_COL32(70, 76, 88, 60);

}  // namespace

std::unique_ptr<Drawing> make_drawing(const Body& body, const hapbeam::DeviceInfo& device) {
  if (body.options().beam.in_space()) return std::make_unique<SpaceDrawing>(body, device);
  return std::make_unique<SceneDrawing>(body, device);
}

SpaceDrawing::SpaceDrawing(const Body& body, const hapbeam::DeviceInfo& device)
    : options_(body.options()),
      rod_(std::get<hapbeam::Rod>(body.slender())),
      placement_(body.placement()),
      workspace_(device.workspace * options_.scale / 2),
      samples_(pieces + 1) {
  for (int i = 0; i <= pieces; ++i) samples_[static_cast<std::size_t>(i)].s = rod_.length() * i / pieces;
  const Shape rest = body.rest();
  sample(std::get<Line>(rest));
  // The rod, and the hand around it.
  const double reach = options_.radius + options_.beam.touched() / 2;
  const Vector pressed = placement_.origin() - Vector(0, reach, 0);
  const double around = hand_away(options_) * options_.scale + options_.radius;
  low_ = pressed - Vector(options_.radius, around, around),
  high_ = pressed + Vector(options_.radius, around, around);
  for (const Sample& sample : samples_)
    low_ = low_.cwiseMin(sample.ring.middle), high_ = high_.cwiseMax(sample.ring.middle);
  low_.y() -= rod_.forces().empty() ? 0 : 0.15 * rod_.length();
  size_ = (high_ - low_).norm();
  floor_ = low_.y() - 0.02 * size_;
  square_ = rounded_up(size_ / 14);
}

double SpaceDrawing::radius(double s) const {
  for (const hapbeam::RodPart& part : rod_.parts())
    if (s <= part.end) return part.section(s).thickness / 2;
  return rod_.thickness() / 2;
}

std::vector<double> SpaceDrawing::mean_curvatures(const Line& shape) const {
  // ∫ of a natural curvature up to s.
  const auto natural = [this](double s, double hapbeam::RodArc::*curvature) {
    double sum = 0, from = 0;
    for (const hapbeam::RodArc& arc : rod_.arcs()) {
      sum += arc.*curvature * std::clamp(s - from, 0.0, arc.end - from);
      from = arc.end;
    }
    return sum;
  };
  std::vector<double> means;
  for (int i = 0; i < shape.segments(); ++i) {
    const auto &a = shape[i], &b = shape[i + 1];
    const Vector t = a.tangent.normalized(), to = b.tangent.normalized();
    const double x = to.dot(a.director), y = to.dot(hapbeam::detail::cross3(t, a.director));
    const double sine = std::sqrt(std::max(0.0, 1 - to.dot(t) * to.dot(t))),
                 angle = std::atan2(sine, to.dot(t));
    const double l = b.s - a.s;
    if (rod_.arcs().empty()) {
      means.push_back(angle / l);
      continue;
    }
    const double factor = sine > 0 ? angle / sine : 1;
    means.push_back(std::hypot(factor * x - (natural(b.s, &hapbeam::RodArc::curvature2) -
                                             natural(a.s, &hapbeam::RodArc::curvature2)),
                               factor * y + (natural(b.s, &hapbeam::RodArc::curvature1) -
                                             natural(a.s, &hapbeam::RodArc::curvature1))) /
                    l);
  }
  return means;
}

void SpaceDrawing::sample(const Line& shape) {
  const std::vector<double> means = mean_curvatures(shape);
  const auto middle = [&shape](int i) { return (shape[i].s + shape[i + 1].s) / 2; };
  Vector across(0, 1, 0);
  double largest = 0;
  int e = 0;
  for (Sample& sample : samples_) {
    const auto point = shape.at(std::min(sample.s, shape.length()));
    const Vector tangent = point.tangent.normalized();
    if (std::abs(across.dot(tangent)) > 0.99) across = {0, 0, 1};
    across = (across - tangent.dot(across) * tangent).normalized();
    sample.ring = {point.r, tangent, across, radius(sample.s)};
    // Linear from one element's middle to the next one's.
    while (e + 2 < shape.segments() && middle(e + 1) < sample.s) ++e;
    const auto k = static_cast<std::size_t>(e);
    const double t = (sample.s - middle(e)) / (middle(e + 1) - middle(e));
    sample.strain = sample.ring.radius * std::max(0.0, means[k] + t * (means[k + 1] - means[k]));
    largest = std::max(largest, sample.strain);
  }
  if (largest > largest_strain_) largest_strain_ = rounded_up(largest);
}

SpaceDrawing::Nearest SpaceDrawing::nearest(const Vector& avatar) const {
  Nearest best{samples_[0].ring.middle, 1e9};
  for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
    const Vector &a = samples_[i].ring.middle, way = samples_[i + 1].ring.middle - a;
    const Vector place = a + std::clamp((avatar - a).dot(way) / way.squaredNorm(), 0.0, 1.0) * way;
    const double gap = (avatar - place).norm() - options_.radius - rod_.thickness() / 2;
    if (gap < best.gap) best = {place, gap};
  }
  return best;
}

void SpaceDrawing::aim(const ImVec2& low, const ImVec2& high) {
  const Vector middle = (low_ + high_) / 2;
  // As large as the box fits that is looked at, from where the camera stands at first.
  Camera first;
  first.aim(middle, size_, {0, 0}, {0, 0}, 1);
  ImVec2 least{0, 0}, most{0, 0};
  for (int i = 0; i < 8; ++i) {
    const ImVec2 at =
        first({i & 1 ? low_.x() : high_.x(), i & 2 ? floor_ : high_.y(), i & 4 ? low_.z() : high_.z()});
    least = {std::min(least.x, at.x), std::min(least.y, at.y)};
    most = {std::max(most.x, at.x), std::max(most.y, at.y)};
  }
  const double fits = std::min(static_cast<double>((high.x - low.x) / (most.x - least.x)),
                               static_cast<double>((high.y - low.y) / (most.y - least.y)));
  camera_.aim(middle, size_, low, high, 1.05 * fits);
}

void SpaceDrawing::draw_floor(ImDrawList& list, float unit) const {
  const auto down = [&](double x) { return square_ * std::floor(x / square_ - 0.5); };
  const auto up = [&](double x) { return square_ * std::ceil(x / square_ + 0.5); };
  const double left = down(low_.x()), right = up(high_.x()), back = down(low_.z()), front = up(high_.z());
  const auto at = [&](double x, double z) { return camera_({x, floor_, z}); };
  const ImVec2 corners[] = {at(left, back), at(right, back), at(right, front), at(left, front)};
  list.AddConvexPolyFilled(corners, 4, IM_COL32(242, 243, 241, 255));
  for (double x = left; x < right + square_ / 2; x += square_)
    list.AddLine(at(x, back), at(x, front), colour::grid, 1);
  for (double z = back; z < front + square_ / 2; z += square_)
    list.AddLine(at(left, z), at(right, z), colour::grid, 1);
  const Vector o = placement_.origin(), w = workspace_;
  const ImVec2 reach[] = {at(o.x() - w.x(), o.z() - w.z()), at(o.x() + w.x(), o.z() - w.z()),
                          at(o.x() + w.x(), o.z() + w.z()), at(o.x() - w.x(), o.z() + w.z())};
  for (int i = 0; i < 4; ++i)
    dashed(list, reach[i], reach[(i + 1) % 4], colour::with_alpha(colour::blue, 90), 0.4f * unit);
}

void SpaceDrawing::draw_shadows(ImDrawList& list, const Vector& avatar, float unit) const {
  std::vector<ImVec2> line;
  for (const Sample& sample : samples_) line.push_back(camera_(on_floor(sample.ring.middle)));
  const Ring& middle = samples_[samples_.size() / 2].ring;
  const auto width = static_cast<float>(2 * middle.radius * camera_.pixels(on_floor(middle.middle)));
  list.AddPolyline(line.data(), static_cast<int>(line.size()), shade, ImDrawFlags_None,
                   std::max(0.2f * unit, width));
  ImVec2 rim[32];
  for (int k = 0; k < 32; ++k) {
    const double angle = 2 * 3.141592653589793 * k / 32;
    rim[k] = camera_(on_floor(avatar + options_.radius * Vector(std::cos(angle), 0, std::sin(angle))));
  }
  list.AddConvexPolyFilled(rim, 32, shade);
  dashed(list, camera_(avatar), camera_(on_floor(avatar)), colour::faint, 0.3f * unit);
  list.AddCircleFilled(camera_(on_floor(avatar)), 0.15f * unit, colour::faint);
}

/// A wall behind a clamp, a ball in a hinge.
void SpaceDrawing::draw_ends(Solids& solids) const {
  const auto hold = [&](const hapbeam::RodSupport& support, const Ring& end, double side) {
    if (support == hapbeam::RodSupport::free) return solids.cap(end, side, colour::viridis(0));
    const double half = std::max(0.035 * size_, 2.5 * end.radius);
    if (support == hapbeam::RodSupport::hinged) return solids.ball(end.middle, 2 * end.radius, colour::grid);
    Eigen::Matrix3d block;
    block.col(0) = 0.3 * half * end.tangent;
    block.col(1) = half * end.across;
    block.col(2) = half * hapbeam::detail::cross3<double>(end.tangent, end.across);
    solids.block(end.middle + side * block.col(0), block, IM_COL32(200, 204, 210, 255));
  };
  hold(rod_.left(), samples_.front().ring, -1);
  hold(rod_.right(), samples_.back().ring, 1);
}

void SpaceDrawing::draw_hanging(ImDrawList& list, float unit) const {
  for (const hapbeam::RodForce& force : rod_.forces()) {
    const Vector tip = samples_.back().ring.middle,
                 end = tip + 0.1 * rod_.length() * force.force.normalized();
    const ImVec2 at = camera_(end);
    list.AddLine(camera_(tip), at, colour::ink, unit / 12);
    list.AddTriangleFilled(at, {at.x - 0.4f * unit, at.y + unit}, {at.x + 0.4f * unit, at.y + unit},
                           colour::ink);
    label(list, {at.x + 0.7f * unit, at.y + 0.2f * unit}, colour::ink, text("%g N", force.force.norm()));
  }
}

void SpaceDrawing::draw_hand(ImDrawList& list, const hapbeam::ServoRecord& r, const Vector& target,
                             float unit) const {
  const ImVec2 avatar = camera_(r.avatar), hand = camera_(r.hand),
               wanted = camera_(placement_.scene_position(target));
  spring(list, wanted, hand, colour::faint, unit);
  cross(list, wanted, unit);
  // The arm's tip is where the device is; the avatar is where the coupling lets it press.
  list.AddLine(hand, avatar, colour::blue, unit / 9);
  list.AddCircleFilled(hand, 0.2f * unit, colour::blue);
  const double force = r.force.norm();
  const auto beside = static_cast<float>(options_.radius * camera_.pixels(r.avatar));
  const ImVec2 free{avatar.x + 0.8f * beside + 0.4f * unit, avatar.y + 0.7f * beside};
  if (force > 0.02) {
    const Vector along = r.force / force, from = r.avatar + options_.radius * along;
    const double length = static_cast<double>(arrow_length(force, unit)) / camera_.pixels(r.avatar);
    const ImVec2 to = camera_(from + length * along);
    arrow(list, camera_(from), to, colour::vermilion, unit);
    // Beside the avatar where the arrow looks at who looks.
    const bool hidden = std::hypot(to.x - avatar.x, to.y - avatar.y) < beside + unit;
    label(list, hidden ? free : ImVec2{to.x + 0.6f * unit, to.y - 0.3f * unit}, colour::vermilion,
          text("%.2f N", force));
  } else if (!r.pressing) {
    const Nearest rod = nearest(r.avatar);
    const Vector way = (rod.place - r.avatar).normalized();
    dashed(list, camera_(r.avatar + options_.radius * way), camera_(rod.place), colour::blue, 0.2f * unit);
    label(list, free, colour::blue, metres(std::round(std::max(0.0, rod.gap) * 1e4) / 1e4) + " to the rod");
  }
}

void SpaceDrawing::draw_legend(ImDrawList& list, const ImVec2& low, const ImVec2& high, float unit) const {
  const float line = 1.25f * unit, left = low.x + unit, bottom = high.y - unit;
  label(list, {left, bottom - 0.6f * unit}, colour::ink, "squares on the floor: " + metres(square_));
  label(list, {left, bottom - 0.6f * unit - line}, colour::ink, "displacements true to scale");
  strain_bar(list, high.x - unit, bottom, largest_strain_, unit);
  // The scene's axes, which are the device's.
  const ImVec2 at{high.x - 3.2f * unit, low.y + 3.2f * unit};
  const char* const names[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const Vector axis = Vector::Unit(i);
    const float x = static_cast<float>(camera_.right().dot(axis)) * 1.7f * unit,
                y = static_cast<float>(-camera_.up().dot(axis)) * 1.7f * unit;
    list.AddLine(at, {at.x + x, at.y + y}, colour::faint, unit / 10);
    list.AddText({at.x + 1.35f * x - 0.25f * unit, at.y + 1.35f * y - 0.5f * unit}, colour::faint, names[i]);
  }
}

void SpaceDrawing::draw(ImDrawList& list, const Session::Picture& picture, const Vector& target,
                        const ImVec2& low, const ImVec2& high, float unit) {
  aim({low.x, low.y + 1.5f * unit}, {high.x, high.y - 2.5f * unit});  // not behind words
  const hapbeam::ServoRecord& r = picture.record;
  list.PushClipRect(low, high, true);
  list.AddRectFilled(low, high, colour::paper);
  draw_floor(list, unit);
  sample(std::get<Line>(picture.beams.front().shape));
  draw_shadows(list, r.avatar, unit);
  Solids solids(camera_);
  for (std::size_t i = 0; i + 1 < samples_.size(); ++i)
    solids.tube(samples_[i].ring, samples_[i + 1].ring,
                colour::viridis((samples_[i].strain + samples_[i + 1].strain) / 2 / largest_strain_));
  draw_ends(solids);
  solids.ball(r.avatar, options_.radius, colour::with_alpha(colour::orange, 225));
  solids.paint(list);
  draw_hanging(list, unit);
  draw_hand(list, r, target, unit);
  draw_legend(list, low, high, unit);
  list.PopClipRect();
}

Eigen::Vector3d SpaceDrawing::device_position(const ImVec2& cursor, const Vector& target) const {
  return placement_.device_position(camera_.inverse(cursor, placement_.scene_position(target)));
}

Eigen::Vector3d SpaceDrawing::device_way(const Vector& way) const {
  return way.x() * camera_.right() + way.y() * camera_.hand_up() + way.z() * camera_.hand_toward();
}

void SpaceDrawing::look(bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) orbits_ = true;
  orbits_ = orbits_ && ImGui::IsMouseDown(ImGuiMouseButton_Right);
  if (orbits_)
    camera_.orbit(0.008 * static_cast<double>(io.MouseDelta.x), 0.008 * static_cast<double>(io.MouseDelta.y));
  if (hovered && io.KeyCtrl) camera_.zoom(std::pow(1.12, static_cast<double>(io.MouseWheel)));
  if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) camera_.reset();
}

void SpaceDrawing::choose() {
  if (!begin_choice("view", "##view", "drag it with the right button")) return;
  if (ImGui::Selectable("as it was at first")) camera_.reset();
  if (ImGui::Selectable("from the front")) camera_.face(0, 0.03);
  if (ImGui::Selectable("from the end")) camera_.face(1.5708, 0.03);
  if (ImGui::Selectable("from above")) camera_.face(0, 1.54);
  ImGui::EndCombo();
}

const char* SpaceDrawing::help() const {
  return "Left button: pull the hand; wheel: nearer or farther. Arrow and page keys move it, space takes it "
         "off. Right "
         "button: turn the view; Ctrl + wheel: zoom; middle button: reset.";
}
const char* SpaceDrawing::hint() const {
  return "left button: pull the hand, wheel: its depth · right button: turn the view, Ctrl + wheel: zoom, "
         "middle: reset";
}

}  // namespace phantom
