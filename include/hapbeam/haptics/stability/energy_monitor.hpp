// SPDX-License-Identifier: MIT
// A passivity observer, which measures the energy that the loop generates, and a controller that dissipates it.
//
//   W += F·Δx - b |Δx|²/T - f |Δx|      over each period of a contact
//
// F is the force that the motors held over the period, Δx the motion of the hand, b and f the arm's own damping and friction, whose path
// is shortened by one step of the encoders.  A device with rotations adds τ·Δθ - b_r |Δθ|²/T - f_r |Δθ|.
// A beam returns the work of the press: at the end of a contact W > 0 is energy that the loop has generated.  While the force engages
// (ForceGuard), a share e of the beam's energy U that rises by de lends the hand U de, which is subtracted.
// A beam that moves on gives back in one touch what it took in another: an account begins with what the beam has, as owed.
// The controller adds -α v, α = W / (T v²), while W > 0, with at most the damping of the arm.  Its force passes the guard like any other.
// Real-time: no allocation, noexcept, wait-free, O(1).
// Source: Hannaford and Ryu, IEEE Trans. Robotics and Automation 18(1), 2002; the exact work of a held force:
// Stramigioli et al., IEEE Trans. Robotics 21(4), 2005.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Core>

#include <hapbeam/check.hpp>
#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

class EnergyMonitor {
 public:
  /// @param delay_ticks  whole periods between a force and the motors, 0 to 16
  /// @throws std::invalid_argument as DeviceInfo::check()
  explicit EnergyMonitor(const DeviceInfo& device, int delay_ticks = 0)
      : arm_(device.check()), gimbal_(device.gimbal), delay_(detail::DelayLine::checked(delay_ticks)) {}

  /// [J] generated so far, in contacts that have ended and in this one.
  double generated() const noexcept { return ended_ + (std::max)(0.0, net_); }
  /// W [J] of this contact: positive where the loop gave out more than it took.
  double net() const noexcept { return net_; }

  void start() noexcept { reset(), ended_ = 0; }
  /// Ends the account of a contact without counting it, as after a reset.
  void reset() noexcept {
    net_ = kept_ = 0;
    position_.reset(), orientation_.reset();
    sent_.clear(), sent_torque_.clear();
  }

  /// A period has ended.   @param position [m], orientation  now   @param sent  by the loop in the tick before
  /// @param dt [s] since, positive
  void observe(const Eigen::Vector3d& position, const Eigen::Matrix3d& orientation, const Wrench& sent,
               double dt) noexcept {
    const Eigen::Vector3d held = hold(sent_, sent.force, arm_.peak_force);
    Eigen::Vector3d torque = zero();
    double work = of_way(position, held, dt);
    if (gimbal_.peak_torque > 0 || gimbal_.damping > 0 || gimbal_.friction > 0) {
      torque = hold(sent_torque_, sent.torque, gimbal_.peak_torque);
      work += of_turn(orientation, torque, dt);
    }
    if (held.isZero(0) && torque.isZero(0)) end_contact();
    else add(work);
  }
  /// Of a device that does not turn.   @param sent [N]
  void observe(const Eigen::Vector3d& position, const Eigen::Vector3d& sent, double dt) noexcept {
    observe(position, Eigen::Matrix3d::Identity(), {sent, Eigen::Vector3d::Zero()}, dt);
  }

  /// A share of the beam's energy that has come in [J]; what has gone out again is lost.
  void lend(double energy) noexcept { add(-(std::max)(0.0, energy)); }

  /// What the beam has while it is not touched [J].
  void keep(double energy) noexcept { kept_ = std::isfinite(energy) ? (std::max)(0.0, energy) : 0; }

  /// What the controller adds [N].  @param velocity [m/s] as the device says
  Eigen::Vector3d dissipation(const Eigen::Vector3d& velocity) const noexcept {
    const double speed = velocity.squaredNorm();
    if (!(net_ > 0 && speed > 0 && std::isfinite(speed))) return zero();
    return -(std::min)(arm_.damping, net_ / (arm_.period * speed)) * velocity;
  }

 private:
  /// What the motors held is late by the delay, and no more than they can.
  Eigen::Vector3d hold(detail::DelayLine& line, Eigen::Vector3d sent, double peak) const noexcept {
    if (sent.allFinite()) (void)limit_force(sent, peak);
    return line.pass(sent, delay_);
  }
  /// [J]  Work of a held force since the reading before, less what the arm took.
  double of_way(const Eigen::Vector3d& position, const Eigen::Vector3d& held, double dt) noexcept {
    const bool finite = position.allFinite();
    Eigen::Vector3d moved = position_ && finite ? position - *position_ : zero();
    if (!(moved.norm() <= longest_step)) moved.setZero();
    if (finite) position_ = position;
    const double step = arm_.position_resolution;
    const Eigen::Array3d way(least(moved[0], step), least(moved[1], step), least(moved[2], step));
    return held.dot(moved) - arm_.damping * way.square().sum() / dt - arm_.friction * way.sum();
  }
  /// [J]  The same of a torque, by the rotation vector.
  double of_turn(const Eigen::Matrix3d& orientation, const Eigen::Vector3d& held, double dt) noexcept {
    // Of the rotation R Sᵀ from the last orientation S to R.
    const Eigen::Matrix3d& last = orientation_ ? *orientation_ : orientation;
    const auto by = [&](int i, int j) {
      double sum = 0;
      for (int k = 0; k < 3; ++k) sum += orientation(i, k) * last(j, k);
      return sum;
    };
    const bool finite = orientation.allFinite();
    const Eigen::Vector3d turned = orientation_ && finite ? detail::rotation_vector(by) : zero();
    if (finite) orientation_ = orientation;
    const double way = least(turned.norm(), gimbal_.resolution);
    return held.dot(turned) - gimbal_.damping * way * way / dt - gimbal_.friction * way;
  }

  /// The least that was moved where it was read to have moved so far, in steps of the encoders.
  static double least(double moved, double step) noexcept { return (std::max)(std::abs(moved) - step, 0.0); }
  static Eigen::Vector3d zero() noexcept { return Eigen::Vector3d::Zero(); }

  static constexpr double longest_step = 10;  // [m] between two readings: longer is a fault, and no way

  /// To the account, unless the sum is no number.
  void add(double energy) noexcept {
    if (std::isfinite(net_ + energy)) net_ += energy;
  }
  void end_contact() noexcept {
    if (std::isfinite(generated())) ended_ = generated();
    net_ = -kept_;
  }

  DeviceInfo arm_;
  GimbalInfo gimbal_;
  int delay_;
  double ended_ = 0, net_ = 0;
  double kept_ = 0;                             // by the beam [J]
  std::optional<Eigen::Vector3d> position_;     // as it was read last
  std::optional<Eigen::Matrix3d> orientation_;  // the same
  detail::DelayLine sent_, sent_torque_;
};

}  // namespace hapbeam
