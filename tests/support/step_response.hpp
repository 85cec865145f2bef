// A hand that leans on a beam from one moment to the next, in lock step with simulated time: does the loop come to rest?
//
// The arm rests where the avatar touches the beam; once the guard has let the force in, the hand pushes down
// with a steady force.  That is the step that also a hand without stiffness can make; to one of stiffness k it is a
// step of push/k of its target.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "random.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>

namespace hapbeam::testing {

/// Who presses, through what.
struct Situation {
  double hand_stiffness = 500, hand_damping = 1.3, grip_mass = 0.2;  ///< [N/m], [N·s/m], [kg]
  double period = 1e-3;                                              ///< [s]
  int delay = 0;                                                     ///< [ticks]
  double resolution = 7e-6;                                          ///< [m]
  double damping = 5, friction = 0.2, apparent_mass = 0.21;          ///< of the arm [N·s/m], [N], [kg]
  double push = 3;                                                   ///< [N]
  bool dissipate = false;                                            ///< as ServoOptions
  double rough = 0;                                                  ///< coefficient of friction on the beam
  int missed = 0,
      of = 1;         ///< so many ticks of as many are missed in a row: the force stays, the arm moves on
  double jitter = 0;  ///< as ArmOptions
  Eigen::Vector3d from =
      Eigen::Vector3d::UnitY();  ///< out of a rod in space, unit, across x: the side it is pressed from

  VirtualPhantomOptions options() const {
    VirtualPhantomOptions o;
    o.arm.damping = damping, o.arm.friction = friction, o.arm.resolution = resolution;
    o.arm.apparent_mass = apparent_mass;
    o.arm.period = period, o.arm.delay_ticks = delay, o.arm.jitter = jitter;
    o.hand = {hand_stiffness, hand_damping, grip_mass};
    return o;
  }
};

/// Of all but the arm.
inline Situation random_hand(Random& random) {
  Situation who;
  who.hand_stiffness = random(300, 1000);
  who.hand_damping = random(0, 1) < 0.2 ? 0 : random(0, 2);
  who.grip_mass = random(0.05, 0.4);
  who.period = random(0.5e-3, 2e-3);
  who.delay = random.integer(0, 3);
  who.push = random(0.5, 3);
  return who;
}

/// The hand holds still, and leans down from a moment on.
struct Leaning {
  double push;                       // [N]
  static constexpr double at = 0.3;  // [s]

  HandTarget operator()(double time) const noexcept {
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    return {zero, zero, time < at ? zero : Eigen::Vector3d(0, -push, 0)};
  }
};

struct StepResponse {
  double speed = 0;  ///< [m/s] RMS, the largest over any 0.1 s that begins `settling` after the step or later
  double amplitude = 0;  ///< [m] half the way between the extremes from then on
  double frequency = 0;  ///< [Hz] of the velocity's changes of sign from then on
  double least_energy =
      0;                 ///< [J] of what hand and arm have put into the loop, arm included: negative: it gave
  double generated = 0;  ///< [J] as the loop's own monitor says
  double force = 0;      ///< [N] sent last
  double position = 0;   ///< [m] of the tip at the end, along y
};

/// The device's origin where the avatar touches the beam at s, and its y out of the beam.
template <typename Model>
Placement above(const Model& model, double s, const Eigen::Vector3d& from, double radius) {
  const auto place = model.shape().at(static_cast<typename Model::Scalar>(s));
  const double reach = static_cast<double>(model.thickness()) / 2 + radius;
  if constexpr (dimension_of<Model> == 2) {
    return Placement::in_plane({s, static_cast<double>(place.w) + reach});
  } else {
    Eigen::Matrix3d axes;
    axes.col(0) = Eigen::Vector3d::UnitX(), axes.col(1) = from,
    axes.col(2) = Eigen::Vector3d(0, -from.z(), from.y());
    return Placement(axes, place.r.template cast<double>() + reach * from);
  }
}

/// @param s [m] where the beam is pressed, from above   @param duration [s] after the step   @param settling [s] as well
/// A run ends early once the arm has stood still, to the bit, for two seconds: nothing moves it any more.
/// Energy: -F·Δx of the force that the motors held, exactly, and b Δx²/T + f |Δx| of the arm, at least.
/// @param watch  called each period: (time [s], position of the tip along y [m])
template <typename Model, typename Coupling, typename Watch>
StepResponse step_response(Model& model, double s, const Coupling& coupling, const Situation& who,
                           double duration, double settling, Watch&& watch) {
  model.reset();
  VirtualPhantom<Leaning> device(Leaning{who.push}, who.options());
  ServoOptions options;
  options.placement = above(model, s, who.from, options.avatar_radius);
  options.delay_ticks = who.delay;
  options.dissipate = who.dissipate;
  options.friction = who.rough;
  ServoLoop<VirtualPhantom<Leaning>, Model, Coupling> loop(device, model, options, coupling);

  StepResponse response;
  std::array<double, 17> held{};  // newest first
  Eigen::Vector3d sent = Eigen::Vector3d::Zero();
  double energy = 0, y = 0, squares = 0, low = 1e9, high = -1e9, last_speed = 0;
  long in_window = 0, changes = 0, still = 0;
  const long window = std::lround(0.1 / who.period);
  const long first = std::lround((Leaning::at + settling) / who.period);
  const long end = std::lround((Leaning::at + duration) / who.period);
  for (long tick = 0; tick < end; ++tick) {
    struct Servo {
      decltype(loop)& loop_;
      Eigen::Vector3d& sent_;
      bool missed_;
      Eigen::Vector3d operator()(const DeviceState& state) noexcept {
        if (!missed_) sent_ = loop_.servo().tick(state);
        return sent_;
      }
    } servo{loop, sent, tick % who.of >= who.of - who.missed};
    device.step(servo);
    std::move_backward(held.begin(), held.end() - 1, held.end());
    held[0] = sent.y();
    const Tip tip = device.tip();
    const double moved = tip.position.y() - y, speed = tip.velocity.y();
    y = tip.position.y();
    watch(static_cast<double>(tick + 1) * who.period, y);
    energy += -held[static_cast<std::size_t>(who.delay)] * moved +
              who.damping * moved * moved / (who.period * (1 + who.jitter)) + who.friction * std::abs(moved);
    response.least_energy = std::min(response.least_energy, energy);
    still = moved == 0 && speed == 0 ? still + 1 : 0;
    if (tick < first) continue;
    if (still >= 20 * window) break;
    low = std::min(low, y), high = std::max(high, y);
    changes += speed * last_speed < 0;
    last_speed = speed;
    squares += speed * speed;
    if (++in_window < window) continue;
    response.speed = std::max(response.speed, std::sqrt(squares / static_cast<double>(window)));
    squares = 0, in_window = 0;
  }
  response.amplitude = std::max(0.0, (high - low) / 2);
  response.frequency = static_cast<double>(changes) / 2 / (duration - settling);
  response.generated = loop.picture().record.energy_generated;
  response.force = loop.picture().record.force.y();
  response.position = y;
  return response;
}
template <typename Model, typename Coupling>
StepResponse step_response(Model& model, double s, const Coupling& coupling, const Situation& who,
                           double duration, double settling = 0.5) {
  return step_response(model, s, coupling, who, duration, settling, [](double, double) {});
}

}  // namespace hapbeam::testing
