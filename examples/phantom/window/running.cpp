#include "running.hpp"

#include <algorithm>
#include <cmath>

#include "../scene.hpp"

namespace phantom {

Running::Running(const Options& options, const Trained* trained)
    : trained_(trained),
      hand_(std::make_unique<Hand>(make_path(options), true)),
      session_(make_session(options, trained, *hand_, tape_)),
      beam_(trained ? trained->make_beam() : options.beam.make()) {
  drawing_.emplace(session_->options(), session_->device(), session_->picture().shape);
  refresh_curves();
}

void Running::pull(Point place) {
  const Eigen::Vector3d reach = session_->device().workspace / 2;
  for (int i = 0; i < 2; ++i) place[i] = std::clamp(place[i], -reach[i], reach[i]);
  hand_->pull(place);
  pulled_ = true;
}

double Running::depth_to_show() const {
  const Options& o = options();
  double deepest = std::max(0.3 * o.depth * o.scale, o.beam.rise);
  if (o.scene == "thesis") deepest = 0.003;
  for (std::size_t i = 0; i < history_.size(); ++i)
    deepest = std::max(deepest, static_cast<double>(history_[i].depth));
  const double decade = std::pow(10, std::floor(std::log10(deepest)));
  return std::ceil(deepest / decade * 2) / 2 * decade;
}

/// Three times 48 presses, a millisecond: only where the hand has gone to another place, or deeper.
void Running::refresh_curves() {
  const hapbeam::ServoRecord& r = session_->picture().record;
  const double length = options().beam.length, step = length / 50;
  const double wanted = r.pressing ? r.press.s : curve_place_ < 0 ? options().place : curve_place_;
  const double place = std::clamp(std::round(wanted / step) * step, step, length - step);
  const double depth = depth_to_show();
  if (place == curve_place_ && depth == curve_depth_) return;
  curve_depth_ = depth;
  curve_place_ = place;
  curves_ = force_curves(*beam_, options().elements, place, depth);
}

}  // namespace phantom
