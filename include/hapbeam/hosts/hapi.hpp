// SPDX-License-Identifier: MIT
// A beam as a force effect of HAPI, and so of H3D.
//
//   device->addEffect(new HapiBeam<FemModel<>>(model, 0.005, Placement::in_plane({0.15, 0.02})));
//
// Units are m and N, axes x right, y up, z toward the user: those of Placement. The force is that of Touch
// (placed_touch.hpp), without a coupling: HAPI adds up its effects and sends the sum. HAPI deletes the effect with the
// last reference; the model must outlive it. calculateForces() runs on HAPI's haptic thread. One other thread may call touch().picture().
//
// For HAPI 1.x (HAPIForceEffect).  HAPBEAM_HAPI_HEADER is what is included, <HAPI/HAPIHapticsDevice.h> unless defined before.
#pragma once

#ifndef HAPBEAM_HAPI_HEADER
#define HAPBEAM_HAPI_HEADER <HAPI/HAPIHapticsDevice.h>
#endif
#include HAPBEAM_HAPI_HEADER

#include <hapbeam/hosts/placed_touch.hpp>

namespace hapbeam {

template <typename Model>
class HapiBeam : public HAPI::HAPIForceEffect {
 public:
  /// As PlacedTouch.   @throws std::invalid_argument
  HapiBeam(Model& model, double avatar_radius, const Placement& placement)
      : touch_(model, avatar_radius, placement) {}

  EffectOutput calculateForces(const EffectInput& input) override {
    const HAPI::Vec3 position = input.hd->getPosition();
    const Eigen::Vector3d force = touch_.tick({position.x, position.y, position.z});
    return EffectOutput(HAPI::Vec3(force[0], force[1], force[2]));
  }

  PlacedTouch<Model>& touch() noexcept { return touch_; }

 private:
  PlacedTouch<Model> touch_;
};

}  // namespace hapbeam
