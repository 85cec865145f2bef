// Contact as it is first written: judged by where the hand is now, with the place held on the beam.
#pragma once

#include <algorithm>

#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::testing {

/// Presses across the beam at the hand's own x, or at the end that it has passed.   @return force on the hand, up [N]
template <class Model>
double clamped_press(Model& model, const Vector2<double>& hand, double reach) {
  const double s = std::clamp(hand.x(), 0.0, model.shape().length());
  return std::max(0.0, -model.press({s, std::min(hand.y() - reach, 0.0)}).force);
}

/// What a hand that comes down onto a resting beam finds first, without a memory of the tick before.
enum class Found { upper_side, lower_side, nothing };

/// @param speed [m] in a tick   @param begin [m] above the beam
template <class Model>
Found fall_onto(const Model& model, double s, double begin, double speed, double radius) {
  BoundingVolumes<double> volumes(model.shape().segments());
  volumes.refit(model.shape());
  for (double y = begin; y > -begin; y -= speed) {
    ContactMemory<double> none;
    const Contact<double> contact =
        find_contact(Avatar<double>{{s, y}, radius}, model.shape(), volumes, model.thickness(), none);
    if (contact.touching) return contact.side > 0 ? Found::upper_side : Found::lower_side;
  }
  return Found::nothing;
}

}  // namespace hapbeam::testing
