#include "draw_space.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <string>
#include <variant>

#include "colours.hpp"
#include "draw_scene.hpp"
#include "draw_vessel.hpp"

namespace phantom {

namespace {

constexpr ImU32 shade = IM_COL32(70, 76, 88, 60);

}  // namespace

std::unique_ptr<Drawing> make_drawing(const Body& body, const hapbeam::DeviceInfo& device) {
  if (body.options().beam.in_space()) return std::make_unique<SpaceDrawing>(body, device);
  return std::make_unique<SceneDrawing>(body, device);
}

SpaceDrawing::SpaceDrawing(const Body& body, const hapbeam::DeviceInfo& device)
    : options_(body.options()),
      line_(std::get<hapbeam::Rod>(body.slender())),
      vessel_(vessel(options_)),
      ball_(options_.avatar == Avatar::ball ? options_.radius : 4 * options_.radius),
      placement_(body.placement()),
      workspace_(device.workspace * options_.scale / 2) {
  const Shape rest = body.rest();
  line_.take(std::get<RodLine::Shape>(rest));
  // The rod, and the hand around it.
  const Vector pressed = placement_.origin() - Vector(0, reach_of(options_), 0);
  const double around = hand_away(options_) * options_.scale + options_.radius;
  low_ = pressed - Vector(options_.radius, around, around),
  high_ = pressed + Vector(options_.radius, around, around);
  for (const RodLine::Sample& sample : line_.samples())
    low_ = low_.cwiseMin(sample.ring.middle), high_ = high_.cwiseMax(sample.ring.middle);
  if (options_.avatar == Avatar::needle) {
    needle_.emplace(needle(options_, pressed, hapbeam::RodSupport::clamped));
    low_.z() = std::min(low_.z(), pressed.z() - needle_->rod().length());
    high_.z() += 2 * around;
  }
  for (const hapbeam::RigidBody& tube : vessel_) {
    const Vector end = tube.axis().at(tube.axis().length()).r, around_it = Vector::Constant(tube.radius());
    low_ = low_.cwiseMin(end - around_it), high_ = high_.cwiseMax(end + around_it);
  }
  if (options_.hands == 2)
    low_ = low_.cwiseMin(std::get<RodLine::Shape>(rest).at(second_place(options_)).r - Vector(0, around, 0));
  low_.y() -= line_.rod().forces().empty() ? 0 : 0.15 * line_.rod().length();
  size_ = (high_ - low_).norm();
  // So far below that a shadow is not taken for a part of the rod.
  floor_ = low_.y() - 0.02 * size_;
  for (const RodLine::Sample& sample : line_.samples())
    floor_ = std::min(floor_, sample.ring.middle.y() - 0.22 * size_);
  square_ = rounded_up(size_ / 14);
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
  // At the corner that is left and in front as the view begins: the rod stands behind it.
  const float left_edge = std::max(reach[3].x, list.GetClipRectMin().x);
  label(list, {left_edge + 0.6f * unit, reach[3].y - 1.4f * unit}, colour::blue, "device's reach");
}

void SpaceDrawing::draw_shadow(ImDrawList& list, const RodLine& rod, float unit) const {
  std::vector<ImVec2> line;
  for (const RodLine::Sample& sample : rod.samples()) line.push_back(camera_(on_floor(sample.ring.middle)));
  const Ring& middle = rod.samples()[rod.samples().size() / 2].ring;
  const auto width = static_cast<float>(2 * middle.radius * camera_.pixels(on_floor(middle.middle)));
  list.AddPolyline(line.data(), static_cast<int>(line.size()), shade, ImDrawFlags_None,
                   std::max(0.2f * unit, width));
}

void SpaceDrawing::draw_shadow(ImDrawList& list, const Vector& avatar, float unit) const {
  ImVec2 rim[32];
  for (int k = 0; k < 32; ++k) {
    const double angle = 2 * 3.141592653589793 * k / 32;
    rim[k] = camera_(on_floor(avatar + ball_ * Vector(std::cos(angle), 0, std::sin(angle))));
  }
  list.AddConvexPolyFilled(rim, 32, shade);
  dashed(list, camera_(avatar), camera_(on_floor(avatar)), colour::faint, 0.3f * unit);
  list.AddCircleFilled(camera_(on_floor(avatar)), 0.15f * unit, colour::faint);
}

void SpaceDrawing::draw_rod(Solids& solids, const RodLine& rod) const {
  const auto& samples = rod.samples();
  for (std::size_t i = 0; i + 1 < samples.size(); ++i)
    solids.tube(samples[i].ring, samples[i + 1].ring,
                colour::viridis((samples[i].strain + samples[i + 1].strain) / 2 / largest_strain_));
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
  if (!holds_end(options_.avatar)) hold(line_.rod().left(), line_.samples().front().ring, -1);
  hold(line_.rod().right(), line_.samples().back().ring, 1);
}

void SpaceDrawing::draw_hanging(ImDrawList& list, float unit) const {
  for (const hapbeam::RodForce& force : line_.rod().forces()) {
    if (!(force.force.norm() > 0)) continue;
    const auto i = static_cast<std::size_t>(
        std::round(force.s / line_.rod().length() * static_cast<double>(line_.samples().size() - 1)));
    const Vector tip = line_.samples()[i].ring.middle,
                 end = tip + 0.1 * line_.rod().length() * force.force.normalized();
    const ImVec2 at = camera_(end);
    list.AddLine(camera_(tip), at, colour::ink, unit / 12);
    list.AddTriangleFilled(at, {at.x - 0.4f * unit, at.y + unit}, {at.x + 0.4f * unit, at.y + unit},
                           colour::ink);
    label(list, {at.x + 0.7f * unit, at.y + 0.2f * unit}, colour::ink, text("%g N", force.force.norm()));
  }
}

void SpaceDrawing::draw_hand(ImDrawList& list, const hapbeam::ServoRecord& r, const Vector& target,
                             float unit) const {
  const ImVec2 wanted = camera_(placement_.scene_position(target));
  spring(list, wanted, camera_(r.hand), colour::faint, unit);
  cross(list, wanted, unit);
  draw_arm(list, r, unit);
}

void SpaceDrawing::draw_arm(ImDrawList& list, const hapbeam::ServoRecord& r, float unit) const {
  const ImVec2 avatar = camera_(r.avatar), hand = camera_(r.hand);
  // The arm's tip is where the device is; the avatar is where the coupling lets it press.
  list.AddLine(hand, avatar, colour::blue, unit / 9);
  list.AddCircleFilled(hand, 0.2f * unit, colour::blue);
  const double force = r.force.norm();
  const auto beside = static_cast<float>(ball_ * camera_.pixels(r.avatar));
  if (force > 0.02) {
    const Vector along = r.force / force, from = r.avatar + ball_ * along;
    const double length = static_cast<double>(arrow_length(force, unit)) / camera_.pixels(r.avatar);
    const ImVec2 to = camera_(from + length * along);
    arrow(list, camera_(from), to, colour::vermilion, unit);
    // Beside the avatar where the arrow looks at who looks.
    const bool hidden = std::hypot(to.x - avatar.x, to.y - avatar.y) < beside + unit;
    const std::string words = text("%.2f N", force);
    label(list, clear_of_rod(hidden ? avatar : to, hidden ? beside : 0, words, unit), colour::vermilion,
          words);
  } else if (!r.pressing && !holds_end(options_.avatar)) {
    Vector from = r.avatar;
    RodLine::Nearest rod = line_.nearest(from);
    if (needle_)
      for (const RodLine::Sample& sample : needle_->samples())
        if (const auto next = line_.nearest(sample.ring.middle); next.distance < rod.distance)
          rod = next, from = sample.ring.middle;
    const double gap = rod.distance - options_.radius - line_.rod().thickness() / 2;
    const Vector way = (rod.place - from).normalized();
    dashed(list, camera_(from + options_.radius * way), camera_(rod.place), colour::blue, 0.2f * unit);
    const std::string words = metres(std::round(std::max(0.0, gap) * 1e4) / 1e4) + " to the rod";
    label(list, clear_of_rod(avatar, beside, words, unit), colour::blue, words);
  }
}

ImVec2 SpaceDrawing::clear_of_rod(const ImVec2& at, float beside, const std::string& words,
                                  float unit) const {
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  const auto from_rod = [&](const ImVec2& low) {
    float least = 1e9f;
    const auto look = [&](const RodLine& rod) {
      for (const RodLine::Sample& sample : rod.samples()) {
        const ImVec2 p = camera_(sample.ring.middle);
        least = std::min(least, std::hypot(p.x - std::clamp(p.x, low.x, low.x + size.x),
                                           p.y - std::clamp(p.y, low.y, low.y + size.y)));
      }
    };
    look(line_);
    if (needle_) look(*needle_);
    return least;
  };
  const float gap = beside + 0.6f * unit, right = at.x + gap, left = at.x - gap - size.x,
              middle = at.y - size.y / 2, off = 0.7f * beside + 0.5f * unit;
  const ImVec2 places[] = {{right, middle},       {left, middle},       {right, middle + off},
                           {right, middle - off}, {left, middle + off}, {left, middle - off}};
  // The first that is clear, so that words stay where they are while the rod moves.
  for (const ImVec2& place : places)
    if (from_rod(place) > 1.2f * unit) return place;
  return *std::max_element(std::begin(places), std::end(places),
                           [&](const ImVec2& a, const ImVec2& b) { return from_rod(a) < from_rod(b); });
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
  const auto take = [&](RodLine& rod, const DrawnBeam& drawn) {
    rod.take(std::get<RodLine::Shape>(drawn.shape));
    if (rod.largest_strain() > largest_strain_) largest_strain_ = rounded_up(rod.largest_strain());
    draw_shadow(list, rod, unit);
  };
  take(line_, picture.body.beams[0]);
  if (needle_) take(*needle_, picture.body.beams[1]);
  draw_shadow(list, r.avatar, unit);
  if (picture.second) draw_shadow(list, picture.second->avatar, unit);
  Solids solids(camera_);
  draw_rod(solids, line_);
  draw_ends(solids);
  if (needle_) {
    draw_rod(solids, *needle_);
    solids.cap(needle_->samples().back().ring, 1, colour::viridis(0));
  }
  solids.ball(r.avatar, ball_, colour::with_alpha(colour::orange, 225));
  if (picture.second)
    solids.ball(picture.second->avatar, options_.radius, colour::with_alpha(colour::sky, 225));
  solids.paint(list);
  draw_vessel(list, camera_, vessel_);
  draw_contacts(list, camera_, picture.body.contacts, unit);
  draw_hanging(list, unit);
  if (picture.second) {
    const Vector& second = picture.second->avatar;
    draw_arm(list, *picture.second, unit);
    name_second(list, camera_(second), static_cast<float>(options_.radius * camera_.pixels(second)), unit);
  }
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
  orbits_ = orbits_ && ImGui::IsMouseDown(ImGuiMouseButton_Right);
  if (orbits_)
    camera_.orbit(0.008 * static_cast<double>(io.MouseDelta.x), 0.008 * static_cast<double>(io.MouseDelta.y));
  // From the next picture on: how far the mouse came before it was pressed turns nothing.
  if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) orbits_ = true;
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
