// What may reach a hand after a start, a reset, a failure or a pause, and a host that has all of them at random.
//
//   n ticks after it, force and torque are at most n T / 0.2 s of what the device's motors may have:  3/200 after 3 ms at 1 kHz
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "support/random.hpp"
#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam::testing {

/// How many ticks: `usual`, or what HAPBEAM_PAUSE_TICKS says.
inline long pause_ticks(long usual) {
  const char* text = std::getenv("HAPBEAM_PAUSE_TICKS");
  return text ? std::atol(text) : usual;
}

class Engagement {
 public:
  /// @param force  [N] the most that is wanted, or that the motors have
  explicit Engagement(const DeviceInfo& device, double force = std::numeric_limits<double>::infinity())
      : device_(device), force_(std::min(device.peak_force, force)) {}

  void begins() noexcept { ticks_ = 0; }
  /// In the next tick.   @return whether no more was sent than may be
  bool allows(const Wrench& sent) noexcept {
    const double share = std::min(1.0, ++ticks_ * device_.period / 0.2) * (1 + 1e-12);
    return sent.force.norm() <= share * force_ && sent.torque.norm() <= share * device_.gimbal.peak_torque;
  }

 private:
  const DeviceInfo& device_;
  double force_;
  int ticks_ = 0;
};

/// Asks a servo with all that it takes.
template <class Servo>
Wrench ask(Servo& servo, const OrientedState& state) noexcept {
  if constexpr (takes_orientation<Servo>) return servo(state);
  else return {servo(static_cast<const DeviceState&>(state)), Eigen::Vector3d::Zero()};
}

/// Ticks of a hand that presses, by a clock that begins at its time.
/// @param force  as Engagement's   @return ticks in which more was sent than may be
template <class Servo>
long surprises(Servo& servo, const DeviceInfo& device, OrientedState hand, long ticks, Random& random,
               double force = std::numeric_limits<double>::infinity()) {
  const double T = device.period, nan = std::numeric_limits<double>::quiet_NaN();
  Engagement engagement(device, force);
  long wrong = 0;
  for (long tick = 0; tick < ticks; ++tick) {
    OrientedState state = hand;
    bool lost = false, timed = true;
    hand.time += random(0.7, 1.3) * T;
    switch (random.integer(0, 600)) {
      case 0: hand.time += random(0, 90 * T); break;  // late, and no pause
      case 1: hand.time += random(101 * T, 0.3), engagement.begins(); break;
      case 2: hand.time += std::pow(10, random(-0.5, 5)), engagement.begins(); break;
      case 3: hand.time -= random(0.11, 1e4), engagement.begins(); break;  // its clock is set back
      case 4: hand.time -= random(0, T); break;
      case 5: state.reset = true, engagement.begins(); break;
      case 6: servo.reset(), engagement.begins(); break;
      case 7: state.position[random.integer(0, 1)] = random.integer(0, 1) ? nan : 1e300, lost = true; break;
      case 8: timed = false; break;
      default: break;
    }
    state.time = timed ? hand.time : nan;
    const Wrench sent = ask(servo, state);
    wrong += !engagement.allows(sent) || (lost && !(sent.force.isZero(0) && sent.torque.isZero(0)));
    if (lost) engagement.begins();
  }
  return wrong;
}

/// The same by a host that hands over its time steps.
template <class Servo>
long surprises_of_host(Servo& servo, const DeviceInfo& device, const Eigen::Vector3d& hand, long ticks,
                       Random& random, double force = std::numeric_limits<double>::infinity()) {
  const double T = device.period;
  Engagement engagement(device, force);
  long wrong = 0;
  for (long tick = 0; tick < ticks; ++tick) {
    double dt = tick ? random(0.5, 1.5) * T : 0.25;
    switch (random.integer(0, 300)) {
      case 0: dt = random(101 * T, 0.3), engagement.begins(); break;
      case 1: dt = std::pow(10, random(-0.5, 300)), engagement.begins(); break;
      case 2: servo.reset(), dt = random(0, 1), engagement.begins(); break;
      case 3: dt = random(0, 90 * T); break;
      case 4: dt = -1; break;
      default: break;
    }
    wrong += !engagement.allows({servo.tick(hand, Eigen::Vector3d(0, 0, 0), dt), Eigen::Vector3d::Zero()});
  }
  return wrong;
}

}  // namespace hapbeam::testing
