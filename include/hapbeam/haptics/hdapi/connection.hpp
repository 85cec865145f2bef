// SPDX-License-Identifier: MIT
// One device of HDAPI: connection, figures, calibration, reading, disconnection.
//
// mm become m, N/mm N/m and mN·m N·m here and nowhere else. The origin becomes the middle of the workspace. Forces are
// in N on both sides, and the axes are the same. The stylus' axes are the first three columns of the vendor's
// transform, made a rotation; its z points from the tip to the hand.
// Offline but for read(): throws and allocates.  A message names the device, what was asked of it and the vendor's error.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/hdapi/contract.hpp>
#include <hapbeam/haptics/hdapi/setup.hpp>

namespace hapbeam::detail {

template <typename Api>
class HdConnection {
 public:
  using Scheduler = HdScheduler<Api>;

  /// @throws as HdapiOptions::check()
  explicit HdConnection(const HdapiOptions& options) : options_(options.check()) {}

  const HdapiOptions& options() const noexcept { return options_; }
  const DeviceInfo& info() const noexcept { return info_; }
  bool connected() const noexcept { return connected_; }

  /// Initialises the device and reads its figures.  With the scheduler's mutex.
  /// @throws std::logic_error while any loop of this Api runs, DeviceError
  void connect() {
    if (Scheduler::runs())
      throw std::logic_error("Hdapi: a device is connected while no loop runs; stop the other devices first");
    Scheduler::drain();
    client.handle = Api::init_device(options_.device.empty() ? nullptr : options_.device.c_str());
    const HdErrors errors = Scheduler::drain();
    connected_ = client.handle != Api::invalid_handle;
    try {
      if (!connected_ || errors.worst >= HdErrorClass::fault) fail("cannot be initialised", errors);
      describe();
    } catch (...) {
      disconnect();
      throw;
    }
  }

  /// With the scheduler's mutex.
  void disconnect() noexcept {
    if (!std::exchange(connected_, false)) return;
    // While the scheduler runs the device stays open, and may have been lost with its motors on.
    if (Scheduler::runs()) Scheduler::insist([this]() noexcept { switch_off(); });
    Scheduler::disable(client.handle);
  }

  /// Makes the device current: what is meant for it must not reach another one.   @return whether it is
  /// On the servo thread, or with the mutex where there is none.  Real-time: no allocation, noexcept, O(1).
  bool select() const noexcept {
    Api::make_current_device(client.handle);
    return Api::get_current_device() == client.handle;
  }

  /// Switches the motors off.  Outside of a frame, else as select().   @return whether it was done without an error
  bool switch_off() noexcept {
    Scheduler::drain();
    client.errors = {};
    if (!select()) return false;
    Api::disable(Api::force_output);
    const HdErrorClass rest = Scheduler::drain().worst;
    return rest == HdErrorClass::none && client.errors.worst == HdErrorClass::none;
  }

  /// Of a device that a person calibrates; one that calibrates itself does so in the loop.
  /// @param at_reset_position  the arm stands there now   With the scheduler's mutex.   @throws DeviceError
  void calibrate(bool at_reset_position) {
    if (calibration.automatic()) return;
    bool calibrated = false;
    HdErrors errors;
    const bool asked = Scheduler::call([&]() noexcept {
      Scheduler::drain();
      calibrated = select() && calibration.check(at_reset_position);
      errors = Scheduler::drain();
    });
    if (!asked || errors.worst >= HdErrorClass::fault) fail("does not tell its calibration", errors);
    if (!calibrated)
      throw DeviceError(DeviceStatus::calibration_needed,
                        title() +
                            "is not calibrated: put the arm into its reset position, call "
                            "calibrate() there, and start again");
  }

  /// @throws DeviceError
  [[noreturn]] void fail(const char* what, const HdErrors& errors) const {
    const char* said = errors.code == Api::success ? nullptr : Api::get_error_string(errors.code);
    char code[24];
    std::snprintf(code, sizeof code, " (0x%03x)", errors.code);
    const bool lost = errors.worst == HdErrorClass::communication;
    throw DeviceError(lost ? DeviceStatus::communication_lost : DeviceStatus::device_fault,
                      title() + what + ": " + (said ? said : "no reason is given") + code);
  }

  /// Readings of the current device, in SI.
  struct Reading {
    Eigen::Vector3d position;  ///< [m]
    Eigen::Vector3d velocity;  ///< [m/s]
    double temperature;        ///< of the hottest motor over its limit; 0: not measured
    bool finite() const noexcept { return position.allFinite() && velocity.allFinite(); }
  };
  /// In a frame; not finite where the vendor's functions give nothing.
  /// Real-time: no allocation, noexcept, O(1).
  Reading read() const noexcept {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Eigen::Vector3d position(none, none, none), velocity(none, none, none);  // mm, mm/s
    double heat[most_motors] = {}, hottest = 0;
    Api::get_doublev(Api::current_position, position.data());
    Api::get_doublev(Api::current_velocity, velocity.data());
    if (has_temperature_) Api::get_doublev(Api::motor_temperature, heat);
    for (const double motor : heat) hottest = (std::max)(hottest, std::isfinite(motor) ? motor : 1.0);
    return {(position - middle_) * 1e-3, velocity * 1e-3, hottest};
  }

  /// Orientation of the stylus.  In a frame, as read().
  /// @param orientation  out   @return false where the vendor's functions give no rotation
  bool read(Eigen::Matrix3d& orientation) const noexcept {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Eigen::Matrix4d transform = Eigen::Matrix4d::Constant(none);  // column by column
    Api::get_doublev(Api::current_transform, transform.data());
    orientation = transform.topLeftCorner<3, 3>();
    return make_rotation(orientation);
  }

  /// Whether the device renders torque; if so it must be sent in each tick, zero included.
  bool has_torque() const noexcept { return has_torque_; }
  /// @param torque [N·m]   In a frame.
  static void send_torque(const Eigen::Vector3d& torque) noexcept {
    const Eigen::Vector3d sent = torque * 1e3;
    Api::set_doublev(Api::current_torque, sent.data());
  }

  HdClient client;                       ///< its handle, and the errors that are its own
  HdCalibration<Api> calibration{0, 1};  ///< of the connected device

 private:
  /// Makes a matrix a rotation that is one but for its last digits.   @return false where it is none
  static bool make_rotation(Eigen::Matrix3d& R) noexcept {
    if (!is_rotation(R)) return false;
    const Eigen::Vector3d z = R.col(2) / R.col(2).norm();
    Eigen::Vector3d x = R.col(0) - z * z.dot(R.col(0));
    x /= x.norm();
    const Eigen::Vector3d y(z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]);
    R.col(0) = x, R.col(1) = y, R.col(2) = z;
    return true;
  }

  std::string title() const {
    return "Hdapi: " + (options_.device.empty() ? "the default device" : "device '" + options_.device + "'") +
           " ";
  }

  void describe() {
    if (!select()) fail("cannot be made current", Scheduler::drain());
    double box[6] = {}, peak = 0, continuous = 0, stiffness = 0;  // mm, N, N, N/mm
    Api::get_doublev(Api::usable_workspace, box);
    Api::get_doublev(Api::nominal_max_force, &peak);
    Api::get_doublev(Api::nominal_max_continuous_force, &continuous);
    Api::get_doublev(Api::nominal_max_stiffness, &stiffness);
    int styles = 0;
    Api::get_integerv(Api::calibration_style, &styles);
    const char* model = Api::get_string(Api::device_model_type);
    const HdErrors errors = Scheduler::drain();
    if (errors.worst >= HdErrorClass::fault) fail("does not say what it is", errors);
    const Eigen::Vector3d low(box[0], box[1], box[2]), high(box[3], box[4], box[5]);
    if (!(low.allFinite() && high.allFinite() && (high - low).minCoeff() > 0)) fail("names no workspace", {});
    if (!(std::isfinite(peak) && peak > 0)) fail("names no maximal force", {});
    calibration = HdCalibration<Api>(static_cast<unsigned>(styles), options_.rate);
    middle_ = (low + high) / 2;
    info_.name = model ? model : "unnamed device", info_.workspace = (high - low) * 1e-3;
    info_.peak_force = (std::min)(peak, options_.force_limit);
    info_.continuous_force = (std::min)(continuous, options_.force_limit);
    info_.max_stiffness = stiffness * 1e3, info_.period = 1.0 / options_.rate;
    info_.position_resolution = options_.position_resolution, info_.friction = options_.friction;
    info_.damping = options_.damping, info_.apparent_mass = options_.apparent_mass;
    info_.gimbal = describe_gimbal();
    // Not every device measures it; what is an error here must not be one in each tick.
    double temperatures[most_motors] = {};
    Api::get_doublev(Api::motor_temperature, temperatures);
    has_temperature_ = Scheduler::drain().worst == HdErrorClass::none;
  }

  /// A device without a stated number of axes has three.
  GimbalInfo describe_gimbal() {
    const auto ask = [](const auto get, unsigned name, auto answer) {
      get(name, &answer);
      return Scheduler::drain().worst == HdErrorClass::none && std::isfinite(answer) ? answer : 0;
    };
    GimbalInfo gimbal;
    has_torque_ = false;
    if (ask(Api::get_integerv, Api::input_dof, 0) < 6) return gimbal;
    gimbal.reads = true;
    gimbal.resolution = options_.gimbal_resolution, gimbal.friction = options_.gimbal_friction;
    gimbal.damping = options_.gimbal_damping, gimbal.inertia = options_.gimbal_inertia;
    if (ask(Api::get_integerv, Api::output_dof, 0) < 6) return gimbal;
    has_torque_ = true;
    const double peak = ask(Api::get_doublev, Api::nominal_max_torque, 0.0),          // mN·m
        continuous = ask(Api::get_doublev, Api::nominal_max_continuous_torque, 0.0),  // mN·m
        stiffness = ask(Api::get_doublev, Api::nominal_max_torque_stiffness, 0.0);    // mN·m/rad
    // Without a stated limit no torque is sent.
    if (!(peak > 0 && continuous > 0)) return gimbal;
    gimbal.peak_torque = (std::min)(peak * 1e-3, options_.torque_limit);
    gimbal.continuous_torque = (std::min)(continuous * 1e-3, gimbal.peak_torque);
    gimbal.max_stiffness = (std::max)(stiffness * 1e-3, 0.0);
    return gimbal;
  }

  static constexpr int most_motors = 16;

  HdapiOptions options_;
  DeviceInfo info_;
  Eigen::Vector3d middle_{0, 0, 0};  // [mm] of the workspace, in the vendor's axes
  bool has_temperature_ = false, has_torque_ = false, connected_ = false;
};

}  // namespace hapbeam::detail
