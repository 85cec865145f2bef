#include "running.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../rest.hpp"
#include "plot.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>

namespace phantom {

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
  const double side = r.force.y() < 0 ? -1 : 1, reach = next.radius + next.beam.touched() / 2;
  const hapbeam::Placement& placement = session_.body().placement();
  if (next.beam.in_space() && (!(r.force.norm() > 0) || holds_end(next.avatar))) return r.position;
  if (next.beam.in_space())
    return placement.device_position(r.avatar +
                                     (session_.body().depth(r) + 0.1 * reach) * r.force.normalized());
  const double clear = height_at(std::get<hapbeam::Centreline<double>>(session_.body().rest()), r.hand.x()) +
                       side * 1.1 * reach;
  const double y = side > 0 ? std::max(clear, r.hand.y()) : std::min(clear, r.hand.y());
  return placement.device_position({r.hand.x(), y, 0});
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
  drawing_ = make_drawing(session_.body(), session_.device().info());
  curve_place_ = -1;
  deepest_ = first_depth();
  refresh_curves();
}

void Running::play() {
  hand_.follow(make_path(asked_));
  pulled_ = false;
}

Eigen::Vector3d Running::pull(Eigen::Vector3d place) {
  const Eigen::Vector3d reach = session_.device().info().workspace / 2;
  for (int i = 0; i < 3; ++i) place[i] = std::clamp(place[i], -reach[i], reach[i]);
  hand_.pull(place);
  pulled_ = true;
  return place;
}

void Running::lift() {
  const hapbeam::ServoRecord& r = session_.picture().record;
  const double force = r.force.norm();
  if (!options().beam.in_space()) pull({target_.x(), height_above, 0});
  else if (force > 0) pull(r.position + height_above * r.force / force);
  else pull(target_);
}

void Running::remember(const Tick& tick) {
  const hapbeam::ServoRecord& r = tick.record;
  // Through an array the hand goes on, from one beam to the next.
  const double down = std::max(0.0, session_.body().placement().origin().y() - r.avatar.y());
  history_.add(tick, options().beams > 1 ? down : session_.body().depth(r),
               options().beam.in_space() ? r.force.norm() : r.force.y());
}

/// Half of what the hand presses a beam that stays as stiff as it is at first; a stiff one gives way by less than the hand
/// goes on.
double Running::first_depth() {
  constexpr double press = 1e-6;  // [m]
  const Options& o = options();
  // What is in the hand gives way, too.
  if (o.avatar != Avatar::ball) return 1e-4;
  const auto curves =
      force_curves(session_.body().slender(), {o.elements, place_of_curves(), curve_along_, press});
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
  const hapbeam::ServoRecord& r = session_.picture().record;
  const double force = r.force.norm();
  // A rod is pressed from any side; eight degrees are another.
  const bool turned = options().beam.in_space() && force > 0.02 && -r.force.dot(curve_along_) < 0.99 * force;
  if (place == curve_place_ && depth == curve_depth_ && !turned) return;
  if (turned) curve_along_ = -r.force / force;
  curve_depth_ = depth;
  curve_place_ = place;
  if (options().beams > 1 || holds_end(options().avatar)) curves_.clear();
  else curves_ = force_curves(session_.body().slender(), {options().elements, place, curve_along_, depth});
}

}  // namespace phantom
