// SPDX-License-Identifier: MIT
// A beam as a ForceFeedback component of SOFA, asked by a haptic device driver of the same node (Geomagic, Haply, …).
//
//   node->addObject(sofa::core::objectmodel::New<SofaBeam<FemModel<>>>(model, 0.005, placement));
//
// SOFA's unit of length is the scene's. The scale of the Placement is metres for one unit, 1e-3 for a scene in mm; its
// rotation and origin place the beam in the scene. The force is in N, along the scene's axes; drivers scale it
// (forceScale). It is that of Touch (placed_touch.hpp), without a coupling, and the torque is zero. Both functions run
// on the driver's haptic thread. One other thread may call touch().picture().
//
// For SOFA 22.06 and later.  HAPBEAM_SOFA_HEADER is what is included, <sofa/component/haptics/ForceFeedback.h> unless defined before.
#pragma once

#ifndef HAPBEAM_SOFA_HEADER
#define HAPBEAM_SOFA_HEADER <sofa/component/haptics/ForceFeedback.h>
#endif
#include HAPBEAM_SOFA_HEADER

#include <hapbeam/hosts/placed_touch.hpp>

namespace hapbeam {

namespace detail {

/// The classes of a rigid transform and of a force with a torque, which have moved between SOFA's versions.
template <typename F>
struct SofaWrench;
template <typename C, typename T, typename V>
struct SofaWrench<void (C::*)(const T&, const V&, V&)> {
  using Transform = T;
  using Vector = V;
};

}  // namespace detail

template <typename Model>
class SofaBeam : public sofa::component::haptics::ForceFeedback {
  using Wrench = detail::SofaWrench<decltype(&sofa::component::haptics::ForceFeedback::computeWrench)>;

 public:
  SOFA_CLASS(SOFA_TEMPLATE(SofaBeam, Model), sofa::component::haptics::ForceFeedback);

  /// As PlacedTouch.   @throws std::invalid_argument
  SofaBeam(Model& model, double avatar_radius, const Placement& placement)
      : touch_(model, avatar_radius, placement) {}

  /// @param x, y, z  of the tool; its orientation is not used   @param fx, fy, fz  out [N]
  void computeForce(SReal x, SReal y, SReal z, SReal, SReal, SReal, SReal, SReal& fx, SReal& fy,
                    SReal& fz) override {
    const Eigen::Vector3d force =
        touch_.tick({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
    fx = static_cast<SReal>(force[0]), fy = static_cast<SReal>(force[1]), fz = static_cast<SReal>(force[2]);
  }

  void computeWrench(const typename Wrench::Transform& tool, const typename Wrench::Vector&,
                     typename Wrench::Vector& wrench) override {
    auto force = tool.getOrigin(), torque = tool.getOrigin();
    computeForce(force[0], force[1], force[2], 0, 0, 0, 1, force[0], force[1], force[2]);
    torque[0] = torque[1] = torque[2] = 0;
    wrench.setForce(force);
    wrench.setTorque(torque);
  }

  PlacedTouch<Model>& touch() noexcept { return touch_; }

 private:
  PlacedTouch<Model> touch_;
};

}  // namespace hapbeam
