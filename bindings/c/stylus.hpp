// SPDX-License-Identifier: MIT
// A stylus on a rod, whatever the elements of the rod are; each of them is compiled in a file of its own.
#pragma once

#include <algorithm>
#include <memory>

#include "hapbeam.h"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/hosts/placed_touch.hpp>

struct hapbeam_stylus {
  virtual ~hapbeam_stylus() = default;
  virtual hapbeam_wrench tick(const hapbeam::HandPose& hand) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual int shape(double* x_y_z, int count) noexcept = 0;
};

namespace hapbeam::border {

/// What a stylus is made of, as C described it.
struct StylusRequest {
  const Rod& rod;
  int elements;
  double radius;  // [m]
  StylusOptions options;
  const Placement& placement;
};

template <class Element>
class StylusOn final : public hapbeam_stylus {
 public:
  explicit StylusOn(const StylusRequest& r)
      : model_(r.rod, r.elements), touch_(model_, r.radius, r.placement, r.options) {}

  hapbeam_wrench tick(const HandPose& hand) noexcept override {
    const Wrench on_hand = touch_.tick(hand);
    const auto& felt = touch_.felt();
    return {{on_hand.force[0], on_hand.force[1], on_hand.force[2]},
            {on_hand.torque[0], on_hand.torque[1], on_hand.torque[2]},
            felt.press.s,
            felt.pressing,
            static_cast<int>(felt.status)};
  }
  void reset() noexcept override { touch_.reset(); }
  int shape(double* x_y_z, int count) noexcept override {
    const auto line = model_.shape();
    for (int i = 0; i < count; ++i) {
      const double s = (std::min)(line.length() * i / (count - 1), line.length());
      const Eigen::Vector3d at = touch_.placement().device_position(detail::in_scene(line.position(s)));
      std::copy(at.data(), at.data() + 3, x_y_z + 3 * i);
    }
    return count;
  }

 private:
  FemModel<Element> model_;
  PlacedTouch<FemModel<Element>> touch_;
};

std::unique_ptr<hapbeam_stylus> on_round_rod(const StylusRequest& request);
std::unique_ptr<hapbeam_stylus> on_twisted_rod(const StylusRequest& request);

}  // namespace hapbeam::border
