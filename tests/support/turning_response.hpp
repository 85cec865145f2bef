// A hand that turns, and leans and twists from one moment to the next, in lock step with simulated time: does the loop come to rest?
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>

namespace hapbeam::testing {

/// The hand holds still, turned somehow, and leans and twists from a moment on.
struct Turning {
  Eigen::Vector3d push = Eigen::Vector3d::Zero();   // [N]
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();  // [N·m] by axes of the gimbal
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();   // [rad] the same
  Eigen::Vector3d led =
      Eigen::Vector3d::Zero();  // [rad] the same, by which its target turns from that moment on
  static constexpr double at = 0.3, leads = 0.1;  // [s]

  HandTarget operator()(double time) const noexcept {
    HandTarget target{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    target.turn = turn;
    if (time < at) return target;
    target.push = push, target.twist = twist;
    target.turn += led * (std::min)(1.0, (time - at) / leads);
    if (time < at + leads) target.spin = led / leads;
    return target;
  }
};

struct TurningResponse {
  double speed = 0;                      ///< [m/s] RMS, the largest over any 0.1 s from `settling` on
  double rate = 0;                       ///< [rad/s] the same
  double last_speed = 0, last_rate = 0;  ///< [m/s], [rad/s] RMS in the last 0.1 s
  double least_energy = 0;  ///< [J] of what hand, arm and gimbal have put into the loop; negative: it gave
  double generated = 0;     ///< [J] as the loop's monitor says
  double max_force = 0, max_torque = 0;  ///< [N], [N·m] sent
  Wrench sent;                           ///< last
  ServoRecord record;
};

/// @param body  a model, or a Grip   @param settling [s] after the step   @param duration [s] as well; a run ends early
/// once it has hardly moved for a second
template <typename Body, typename Coupling = typename CouplingOf<Body>::Type>
TurningResponse turning_response(Body& body, const Turning& hand, const VirtualPhantomOptions& who,
                                 const ServoOptions& options, const Coupling& coupling, double settling,
                                 double duration) {
  VirtualPhantom<Turning> device(hand, who);
  Servo<Body, Coupling> servo(body, device.info(), options, coupling);
  struct Watched {
    Servo<Body, Coupling>& servo;
    Wrench sent{};
    Eigen::Vector3d motors{0, 0, 0};
    const VirtualPhantom<Turning>& device;
    Eigen::Vector3d operator()(const DeviceState& state) noexcept { return sent.force = servo(state); }
    Wrench operator()(const OrientedState& state) noexcept {
      sent = servo(state);
      motors = device.gimbal().by_axes(sent.torque);
      return sent;
    }
  } watched{servo, {}, {0, 0, 0}, device};
  TurningResponse r;
  const double period = who.arm.period;
  const long end = std::lround((Turning::at + duration) / period),
             first = std::lround((Turning::at + settling) / period), window = std::lround(0.1 / period);
  std::array<Wrench, 17> held{};  // of the motors, newest first
  double energy = 0, speeds = 0, rates = 0;
  long in_window = 0, still = 0;
  for (long tick = 0; tick < end; ++tick) {
    const Eigen::Vector3d place = device.tip().position, angles = device.gimbal().angles();
    device.step(watched);
    std::move_backward(held.begin(), held.end() - 1, held.end());
    held[0] = {watched.sent.force, watched.motors};
    const Eigen::Vector3d moved = device.tip().position - place, turned = device.gimbal().angles() - angles;
    const Wrench& late = held[static_cast<std::size_t>(who.arm.delay_ticks)];
    energy += -late.force.dot(moved) - late.torque.dot(turned) +
              who.arm.damping * moved.squaredNorm() / period + who.arm.friction * moved.cwiseAbs().sum() +
              who.gimbal.damping * turned.squaredNorm() / period +
              who.gimbal.friction * turned.cwiseAbs().sum();
    r.least_energy = std::min(r.least_energy, energy);
    r.max_force = std::max(r.max_force, watched.sent.force.norm());
    r.max_torque = std::max(r.max_torque, watched.sent.torque.norm());
    if (tick < first) continue;
    speeds += device.tip().velocity.squaredNorm(), rates += device.gimbal().rates().squaredNorm();
    if (++in_window < window) continue;
    r.last_speed = std::sqrt(speeds / static_cast<double>(window));
    r.last_rate = std::sqrt(rates / static_cast<double>(window));
    r.speed = std::max(r.speed, r.last_speed), r.rate = std::max(r.rate, r.last_rate);
    speeds = rates = 0, in_window = 0;
    still = r.last_speed < 1e-6 && r.last_rate < 1e-5 ? still + 1 : 0;
    if (still == 10) break;
  }
  r.generated = servo.record().energy_generated;
  r.sent = watched.sent;
  r.record = servo.record();
  return r;
}
/// Through the coupling that the device can render.
template <typename Body>
TurningResponse turning_response(Body& body, const Turning& hand, const VirtualPhantomOptions& who,
                                 const ServoOptions& options, double settling, double duration) {
  const DeviceInfo info = VirtualPhantom<Turning>(hand, who).info();
  return turning_response(body, hand, who, options,
                          CouplingOf<Body>::Type::for_device(info, options.delay_ticks), settling, duration);
}

}  // namespace hapbeam::testing
