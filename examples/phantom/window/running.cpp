#include "running.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../scene.hpp"
#include "plot.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>

namespace phantom {

namespace {

/// The same beam in the same place.
bool same_scene(const Options& a, const Options& b) {
  return a.scene == b.scene && a.beam.name == b.beam.name && a.model == b.model;
}

}  // namespace

Running::Running(const Options& options, std::shared_ptr<const Trained> trained)
    : hand_(make_path(options), true),
      session_(options, trained, hand_, tape_),
      asked_(options),
      asked_trained_(std::move(trained)) {
  show_body();
}

void Running::change(const Options& options, std::shared_ptr<const Trained> trained) {
  session_.change(options, trained, beside(options));
  if (!same_scene(options, asked_)) hand_.follow(make_path(options)), pulled_ = false;
  asked_ = options;
  asked_trained_ = std::move(trained);
}

/// Above or below, as the hand has the beam now; where the next script begins, if it is another beam.
Eigen::Vector3d Running::beside(const Options& next) {
  const hapbeam::ServoRecord& r = session_.picture().record;
  if (!session_.device().simulated() || (same_scene(next, options()) && !r.pressing)) return r.position;
  if (!same_scene(next, options())) return {0, height_above, 0};
  const double side = r.force.y() < 0 ? -1 : 1, reach = next.radius + next.beam.height / 2;
  const double clear = next.beam.rest(std::clamp(r.hand.x(), 0.0, next.beam.length)) + side * 1.1 * reach;
  const double y = side > 0 ? std::max(clear, r.hand.y()) : std::min(clear, r.hand.y());
  return placement(next).device_position({r.hand.x(), y, 0});
}

void Running::show_newest() {
  if (session_.changes() == shown_) return;
  shown_ = session_.changes();
  curve_depth_ = 0;
  if (same_scene(options(), drawn_)) return;
  history_.clear();
  scene_since_ = shown_;
  show_body();
}

void Running::show_body() {
  drawn_ = options();
  drawing_.emplace(drawn_, session_.device().info(), session_.body().rest());
  curve_place_ = -1;
  deepest_ = first_depth();
  refresh_curves();
}

void Running::play() {
  hand_.follow(make_path(asked_));
  pulled_ = false;
}

void Running::pull(Point place) {
  const Eigen::Vector3d reach = session_.device().info().workspace / 2;
  for (int i = 0; i < 2; ++i) place[i] = std::clamp(place[i], -reach[i], reach[i]);
  hand_.pull(place);
  pulled_ = true;
}

/// Half of what the hand presses a beam that stays as stiff as it is at first; a stiff one gives way by less than the hand
/// goes on.
double Running::first_depth() {
  constexpr double press = 1e-6;  // [m]
  const Options& o = options();
  const auto curves = force_curves(session_.body().beam(), o.elements, place_of_curves(), press);
  const double k = curves.empty() ? 0 : std::abs(static_cast<double>(curves[0].force.back())) / press;
  const double hand = hapbeam::HandOptions{}.stiffness;
  return std::max({0.5 * hand * o.depth / (k + hand / o.scale), o.beam.rise, 1e-4});
}

double Running::place_of_curves() {
  const hapbeam::ServoRecord& r = session_.picture().record;
  const double length = options().beam.length, step = curve_step();
  const double wanted = r.pressing ? r.press.s : curve_place_ < 0 ? options().place : curve_place_;
  return std::clamp(std::round(wanted / step) * step, step, length - step);
}

/// Three times 48 presses, a millisecond: only where the hand has gone to another place, or deeper.
void Running::refresh_curves() {
  for (std::size_t i = 0; i < history_.size(); ++i)
    deepest_ = std::max(deepest_, static_cast<double>(history_[i].depth));
  const double place = place_of_curves(), depth = rounded_end(deepest_);
  if (place == curve_place_ && depth == curve_depth_) return;
  curve_depth_ = depth;
  curve_place_ = place;
  curves_ = force_curves(session_.body().beam(), options().elements, place, depth);
}

}  // namespace phantom
