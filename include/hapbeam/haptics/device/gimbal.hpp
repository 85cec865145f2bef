// SPDX-License-Identifier: MIT
// The gimbal that turns a simulated stylus, in a simulated hand.
//
// Three axes, one within the other: yaw a about the device's y, pitch b about x, roll c about the stylus' own z,
//
//   R = Ry(a) Rx(b) Rz(c)        the columns are the axes of the stylus; at zero they are those of the device
//
// Each axis is an ArmAxis with radians for metres: inertia, viscous damping, Coulomb friction, a hand that pulls toward
// its target, and encoders. A torque τ acts on an axis e by e·τ, which the motor holds over the period. Roll has any
// number of turns. At a pitch of a quarter turn yaw and roll coincide. Gyroscopic moments are neglected.
// Real-time: no allocation, noexcept, wait-free, bounded as ArmAxis.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include <hapbeam/haptics/device/arm_axis.hpp>
#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/device/hand_path.hpp>

namespace hapbeam {

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

  ArmAxis axis() const noexcept {
    return ArmAxis({inertia + grip_inertia, damping + hand_damping, hand_stiffness, friction});
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
    if (period > 500 * axis().longest_piece())
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
      : axes_{options.axis(), options.axis(), options.axis()},
        hand_damping_(options.hand_damping),
        encoders_(options.resolution, velocity_cutoff) {}

  /// As DeviceInfo has it.
  static GimbalInfo describe(const GimbalOptions& o) noexcept {
    if (!o.present) return {};
    return {true, o.peak_torque, o.continuous_torque, 0, o.resolution, o.friction, o.damping, o.inertia};
  }

  /// As they are [rad].
  Eigen::Vector3d angles() const noexcept {
    return {axes_[0].position(), axes_[1].position(), axes_[2].position()};
  }
  /// [rad/s]
  Eigen::Vector3d rates() const noexcept {
    return {axes_[0].velocity(), axes_[1].velocity(), axes_[2].velocity()};
  }
  /// As the encoders read it.
  Eigen::Matrix3d orientation() const noexcept { return gimbal_orientation(encoders_.position()); }

  void reset(const HandTarget& target) noexcept {
    for (int i = 0; i < 3; ++i) axes_[i].place(target.turn[i]);
    encoders_.reset(angles());
  }
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
    for (int i = 0; i < 3; ++i)
      axes_[i].advance(axes_[i].drive(motors[i] + from.twist[i], from.turn[i], from.spin[i], to.turn[i],
                                      to.spin[i], hand_damping_, period),
                       period);
    encoders_.read(angles(), period);
  }

 private:
  ArmAxis axes_[3];
  double hand_damping_;
  Encoders encoders_;
};

}  // namespace hapbeam
