// SPDX-License-Identifier: MIT
// A simulated arm of three axes in a hand, which encoders read; and the gimbal that turns its stylus.
//
// The gimbal has three axes, one within the other: yaw a about the device's y, pitch b about x, roll c about the stylus' own z,
//
//   R = Ry(a) Rx(b) Rz(c)        the columns are the axes of the stylus; at zero they are those of the device
//
// Each axis is an ArmAxis with radians for metres: inertia, viscous damping, Coulomb friction, a hand that pulls toward
// its target, and encoders. A torque τ acts on an axis e by e·τ, which the motor holds over the period. Roll has any
// number of turns. At a pitch of a quarter turn yaw and roll coincide. Gyroscopic moments are neglected.
// Real-time: no allocation, noexcept, wait-free, bounded as ArmAxis.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include <hapbeam/haptics/device/arm_axis.hpp>
#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/device/hand_path.hpp>

namespace hapbeam {

/// Encoders: positions on a grid, and a velocity estimated from them: the difference of successive readings over the period, q',
/// through a low pass of first order, because one step of the grid in one period alone would read as 7 mm/s.
///
///   v += (1 - exp(-2 pi f T)) (q' - v)        it lags by about 1 / (2 pi f)
class Encoders {
 public:
  /// @param resolution [m]; 0: positions are read as they are   @param cutoff f [Hz]
  Encoders(double resolution, double cutoff) noexcept
      : resolution_(resolution), cutoff_(2 * 3.141592653589793 * cutoff) {}

  const Eigen::Vector3d& position() const noexcept { return position_; }  ///< [m]
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }  ///< [m/s]

  /// Begins at a place, without motion.  @param tip [m]
  void reset(const Eigen::Vector3d& tip) noexcept { position_ = on_grid(tip), velocity_.setZero(); }
  /// Reads the tip.  @param tip [m]   @param period [s] since the last reading
  void read(const Eigen::Vector3d& tip, double period) noexcept {
    const Eigen::Vector3d reading = on_grid(tip);
    velocity_ += -std::expm1(-cutoff_ * period) * ((reading - position_) / period - velocity_);
    position_ = reading;
  }

 private:
  Eigen::Vector3d on_grid(const Eigen::Vector3d& tip) const noexcept {
    if (resolution_ == 0) return tip;
    const auto nearest = [this](double x) { return resolution_ * std::nearbyint(x / resolution_); };
    return {nearest(tip.x()), nearest(tip.y()), nearest(tip.z())};
  }

  double resolution_, cutoff_;  // [m], [rad/s]
  Eigen::Vector3d position_{0, 0, 0}, velocity_{0, 0, 0};
};

/// Three axes of one kind in one hand, and their encoders: an arm, or a gimbal with radians for metres.
class Arm {
 public:
  /// @param each  of the axes   @param hand_damping c [N·s/m]   @param resolution, cutoff  of the encoders
  Arm(const ArmAxisParameters& each, double hand_damping, double resolution, double cutoff) noexcept
      : axes_{ArmAxis(each), ArmAxis(each), ArmAxis(each)},
        hand_damping_(hand_damping),
        encoders_(resolution, cutoff) {}

  /// True ones; encoders() has what is read.
  Eigen::Vector3d position() const noexcept {
    return {axes_[0].position(), axes_[1].position(), axes_[2].position()};
  }
  Eigen::Vector3d velocity() const noexcept {
    return {axes_[0].velocity(), axes_[1].velocity(), axes_[2].velocity()};
  }
  const Encoders& encoders() const noexcept { return encoders_; }

  /// At rest.
  void place(const Eigen::Vector3d& position) noexcept {
    for (int i = 0; i < 3; ++i) axes_[i].place(position[i]);
    encoders_.reset(position);
  }
  /// One period under a force, while the hand's target goes on cubics from p0, v0 to p1, v1.
  void advance(const Eigen::Vector3d& force, const Eigen::Vector3d& p0, const Eigen::Vector3d& v0,
               const Eigen::Vector3d& p1, const Eigen::Vector3d& v1, double period) noexcept {
    for (int i = 0; i < 3; ++i)
      axes_[i].advance(axes_[i].drive(force[i], p0[i], v0[i], p1[i], v1[i], hand_damping_, period), period);
    encoders_.read(position(), period);
  }

 private:
  ArmAxis axes_[3];
  double hand_damping_;
  Encoders encoders_;
};

/// The hand that holds the arm, a spring and a damper between path and grip; within the published fits.
struct HandOptions {
  double stiffness = 500;  ///< [N/m]; 0: the hand does not follow the path
  double damping = 1.3;    ///< [N·s/m]
  double grip_mass = 0.2;  ///< [kg] that moves with the arm
};

/// The arm.  Defaults are the thesis' Table 2.1 where no other source is named.
struct ArmOptions {
  double apparent_mass = 0.21;   ///< [kg] at the tip, positive
  double damping = 5;            ///< [N·s/m] viscous; not in the table, a figure seen for such a unit
  double friction = 0.2;         ///< [N] Coulomb, on each axis
  double resolution = 7e-6;      ///< [m] of the encoders; 0: exact
  double velocity_cutoff = 100;  ///< [Hz] of the velocity's low pass, positive; not in the table
  double peak_force = 37.5;      ///< [N] positive
  double period = 1e-3;          ///< [s] of the servo loop, 1e-5 to 1
  int delay_ticks = 0;           ///< whole periods between a force and the motors, 0 to 16
  double jitter = 0;  ///< share of a period by which the time between two ticks differs from it, 0 to 0.9

  ArmAxisParameters axis(const HandOptions& hand) const noexcept {
    return {apparent_mass + hand.grip_mass, damping + hand.damping, hand.stiffness, friction};
  }
  /// @throws std::invalid_argument naming field, value, unit and what is allowed
  void check(const HandOptions& hand) const {
    detail::positive("apparent_mass", apparent_mass, "kg");
    detail::not_negative("arm damping", damping, "N·s/m");
    detail::not_negative("friction", friction, "N");
    detail::not_negative("resolution", resolution, "m");
    detail::positive("velocity_cutoff", velocity_cutoff, "Hz");
    detail::positive("peak_force", peak_force, "N");
    if (!(period >= 1e-5 && period <= 1)) detail::reject("period", period, "s", "1e-5 to 1");
    detail::DelayLine::checked(delay_ticks);
    if (!(jitter >= 0 && jitter <= 0.9)) detail::reject("jitter", jitter, "", "0 to 0.9");
    detail::not_negative("hand stiffness", hand.stiffness, "N/m");
    detail::not_negative("hand damping", hand.damping, "N·s/m");
    detail::not_negative("grip_mass", hand.grip_mass, "kg");
    // Bounded work: an arm that settles a thousand times within a period is a mistake in a unit.
    if (period > 500 * ArmAxis(axis(hand)).longest_piece())
      detail::reject("apparent_mass", apparent_mass, "kg",
                     "large enough that the arm does not settle in 1/1000 period");
  }
};

/// No published figures were found: these are assumed, and the torque is low for such a device.
struct GimbalOptions {
  bool present = false;             ///< false: a device of three axes
  double inertia = 1e-4;            ///< [kg·m²] positive; of a pen of 50 g and 150 mm
  double damping = 1e-3;            ///< [N·m·s/rad]
  double friction = 2e-3;           ///< [N·m] Coulomb, on each axis
  double resolution = 1e-4;         ///< [rad] of the encoders; 0: exact
  double peak_torque = 0.15;        ///< [N·m] 0: it renders none, and reads the orientation alone
  double continuous_torque = 0.05;  ///< [N·m] positive
  double hand_stiffness = 0.45;     ///< [N·m/rad] of the hand, 500 N/m at the 30 mm where fingers hold a pen
  double hand_damping = 1.2e-3;     ///< [N·m·s/rad] the same of 1.3 N·s/m
  double grip_inertia = 1.8e-4;     ///< [kg·m²] the same of 0.2 kg

  ArmAxisParameters axis() const noexcept {
    return {inertia + grip_inertia, damping + hand_damping, hand_stiffness, friction};
  }
  /// @param period [s] of the loop   @throws std::invalid_argument
  void check(double period) const {
    detail::positive("gimbal inertia", inertia, "kg·m²");
    detail::not_negative("gimbal damping", damping, "N·m·s/rad");
    detail::not_negative("gimbal friction", friction, "N·m");
    detail::not_negative("gimbal resolution", resolution, "rad");
    detail::not_negative("gimbal peak_torque", peak_torque, "N·m");
    detail::positive("gimbal continuous_torque", continuous_torque, "N·m");
    detail::not_negative("gimbal hand_stiffness", hand_stiffness, "N·m/rad");
    detail::not_negative("gimbal hand_damping", hand_damping, "N·m·s/rad");
    detail::not_negative("gimbal grip_inertia", grip_inertia, "kg·m²");
    if (period > 500 * ArmAxis(axis()).longest_piece())
      detail::reject("gimbal inertia", inertia, "kg·m²",
                     "large enough that the gimbal does not settle in 1/1000 period");
  }
};

/// How a stylus is turned by its gimbal.   @param angles [rad] yaw, pitch, roll
inline Eigen::Matrix3d gimbal_orientation(const Eigen::Vector3d& angles) noexcept {
  const double sa = std::sin(angles[0]), ca = std::cos(angles[0]), sb = std::sin(angles[1]),
               cb = std::cos(angles[1]), sc = std::sin(angles[2]), cc = std::cos(angles[2]);
  Eigen::Matrix3d R;
  R << ca * cc + sa * sb * sc, sa * sb * cc - ca * sc, sa * cb,  //
      cb * sc, cb * cc, -sb,                                     //
      ca * sb * sc - sa * cc, sa * sc + ca * sb * cc, ca * cb;
  return R;
}

class Gimbal {
 public:
  Gimbal(const GimbalOptions& options, double velocity_cutoff) noexcept
      : axes_(options.axis(), options.hand_damping, options.resolution, velocity_cutoff) {}

  /// As DeviceInfo has it.
  static GimbalInfo describe(const GimbalOptions& o) noexcept {
    if (!o.present) return {};
    return {true, o.peak_torque, o.continuous_torque, 0, o.resolution, o.friction, o.damping, o.inertia};
  }

  Eigen::Vector3d angles() const noexcept { return axes_.position(); }  ///< [rad] as they are
  Eigen::Vector3d rates() const noexcept { return axes_.velocity(); }   ///< [rad/s]
  /// As the encoders read it.
  Eigen::Matrix3d orientation() const noexcept { return gimbal_orientation(axes_.encoders().position()); }

  void reset(const HandTarget& target) noexcept { axes_.place(target.turn); }
  /// A torque of the device [N·m], in its axes, by axes of the gimbal as they are.
  Eigen::Vector3d by_axes(const Eigen::Vector3d& torque) const noexcept {
    const Eigen::Vector3d q = angles();
    const double sa = std::sin(q[0]), ca = std::cos(q[0]), sb = std::sin(q[1]), cb = std::cos(q[1]);
    return {torque[1], ca * torque[0] - sa * torque[2],
            sa * cb * torque[0] - sb * torque[1] + ca * cb * torque[2]};
  }
  /// One period.   @param motors [N·m] by axes
  void advance(const Eigen::Vector3d& motors, const HandTarget& from, const HandTarget& to,
               double period) noexcept {
    axes_.advance(motors + from.twist, from.turn, from.spin, to.turn, to.spin, period);
  }

 private:
  Arm axes_;
};

}  // namespace hapbeam
