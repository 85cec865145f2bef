// Hands that press a rod by the tip of a stylus, by its shaft, or hold its end, turned to a pose that is led: what
// benchmarks/turning_map.cpp maps and tests/stability/stylus_loop.cpp repeats in part.
#pragma once

#include <array>
#include <cmath>

#include "support/turning_response.hpp"
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/haptics/held/grip.hpp>

namespace hapbeam::testing {

enum class TouchedBy { tip, shaft, grip };

/// A rod of steel.
struct TurningScene {
  const char* name;
  double length, diameter;  // [m]
  double curvature;         // [1/m] by nature
  double s;                 // [m] where it is touched

  Rod rod(const RodSupport& left, const RodSupport& right) const {
    Rod bent(length, RodSection::circle(diameter), RodMaterial{200e9, 77e9}, left, right);
    bent.naturally({{length, 0, curvature, 0}});
    return bent;
  }
};
inline constexpr TurningScene turning_scenes[] = {{"wire", 0.2, 0.001, 0, 0.12},
                                                  {"needle", 0.2, 0.002, 0, 0.15},
                                                  {"bar", 0.2, 0.006, 0, 0.12},
                                                  {"hook", 0.157, 0.002, 20, 0.09}};

/// Who presses: a hand that turns by its figures at the 30 mm where fingers hold a stylus, and a gimbal.
struct TurningSituation {
  double hand_stiffness, hand_damping, grip_mass;             // [N/m], [N·s/m], [kg]
  double gimbal_damping, gimbal_friction, gimbal_resolution;  // [N·m·s/rad], [N·m], [rad]
  double period;                                              // [s]
  int delay;                                                  // [ticks]

  VirtualPhantomOptions options() const {
    VirtualPhantomOptions o;
    constexpr double square = grip_lever * grip_lever;
    o.hand = {hand_stiffness, hand_damping, grip_mass};
    o.arm.period = period, o.arm.delay_ticks = delay;
    o.gimbal.present = true;
    o.gimbal.damping = gimbal_damping, o.gimbal.friction = gimbal_friction;
    o.gimbal.resolution = gimbal_resolution;
    o.gimbal.hand_stiffness = hand_stiffness * square, o.gimbal.hand_damping = hand_damping * square;
    o.gimbal.grip_inertia = grip_mass * square;
    return o;
  }
  DeviceInfo device() const { return VirtualPhantom<Turning>(Turning{}, options()).info(); }
};

/// K_r and B_r of a coupling as multiples of what the device can render.
struct TurningFactors {
  double stiffness = 1, damping = 1;

  CouplingFigures of(const DeviceInfo& device, int delay) const {
    const CouplingFigures safe = safe_turning_coupling(device, delay);
    return {stiffness * safe.stiffness, damping * safe.damping};
  }
};

/// The hand leans 4 mm into the rod, twists about all axes of its gimbal and is led to another pose, from one moment to the next.
inline Turning leaning(const TurningSituation& who) {
  Turning hand;
  hand.push = {0, -who.hand_stiffness * 0.004, 0};
  hand.twist = {0.004, -0.002, 0.004}, hand.led = {0.1, -0.03, 0.1};
  return hand;
}

/// @param duration [s] after the step, of which the first half second settles
inline TurningResponse turning_response(const TurningScene& scene, TouchedBy by, const TurningSituation& who,
                                        const TurningFactors& factors, double duration) {
  constexpr double settling = 0.5;
  const DeviceInfo device = who.device();
  const CouplingFigures place = safe_coupling(device, who.delay), turning = factors.of(device, who.delay);
  Turning hand = leaning(who);
  ServoOptions options;
  options.delay_ticks = who.delay;
  if (by == TouchedBy::grip) {
    const GripCoupling coupling(place, turning, who.period);
    FemModel<TwistedRod> model(scene.rod(coupling.support(), RodSupport::clamped), 8);
    Grip<FemModel<TwistedRod>> grip(model, RodSide::left);
    return turning_response(grip, hand, who.options(), options, coupling, settling, duration);
  }
  FemModel<TwistedRod> model(scene.rod(RodSupport::clamped, RodSupport::free), 8);
  options.avatar_radius = 0.01;
  options.stylus.length = 0.2, options.stylus.ahead = 0.1;
  const auto at = model.shape().at(scene.s);
  const Eigen::Vector3d along = at.tangent.normalized();
  // Across the rod, out of the plane in which a hook is bent.
  Eigen::Vector3d out(0, std::cos(0.7), std::sin(0.7));
  out = (out - along * along.dot(out)).normalized();
  Eigen::Matrix3d axes;
  axes.col(0) = along, axes.col(1) = out, axes.col(2) = detail::cross3<double>(along, out);
  const double tilt = by == TouchedBy::tip ? 0.5 : 0,
               lever = by == TouchedBy::tip ? options.stylus.ahead : 0.06;
  hand.turn = {0, -tilt, 0};
  const Eigen::Vector3d back = axes * Eigen::Vector3d(0, std::sin(tilt), std::cos(tilt));
  // Not in touch when the loop engages, whatever round-off says.
  constexpr double apart = 1e-7;
  options.placement =
      Placement(axes, at.r + (options.avatar_radius + scene.diameter / 2 + apart) * out + lever * back);
  return turning_response(model, hand, who.options(), options, VirtualCoupling(place, turning), settling,
                          duration);
}

/// The same hand with nothing in its reach.
inline TurningResponse turning_response_alone(const TurningSituation& who, double duration) {
  FemModel<TwistedRod> model(turning_scenes[0].rod(RodSupport::clamped, RodSupport::free), 2);
  ServoOptions options;
  options.placement = Placement(Eigen::Matrix3d::Identity(), {0, 1, 0});
  return turning_response(model, leaning(who), who.options(), options, 0.5, duration);
}

}  // namespace hapbeam::testing
