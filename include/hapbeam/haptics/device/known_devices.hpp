// SPDX-License-Identifier: MIT
// Published figures of devices that people have, for those who cannot measure their own.
//
//   Servo<FemModel<>> servo(model, known_device("omega.3"));
//
// docs/haptics.md has the table and its sources.  The figures were not checked: compare them with the sheet that came with the device
// before a force is sent.  Torque and its stiffness are CHAI3D's.  If a source gives one maximum alone, the continuous value is half of it;
// Force Dimension's forces are continuous.  What is unknown is 0.  The rate is 1 kHz: set `period` for a loop at another rate.
// Offline: allocates.
#pragma once

#include <string>
#include <vector>

#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

inline std::vector<DeviceInfo> known_devices() {
  constexpr double period = 1e-3, unknown = 0;
  const auto device = [&](const char* name, const Eigen::Vector3d& millimetres, double peak,
                          double continuous, double stiffness, double resolution, double friction,
                          double mass, double damping, const GimbalInfo& gimbal = {}) {
    return DeviceInfo{name,       1e-3 * millimetres, peak,   continuous, stiffness,
                      resolution, friction,           period, damping,    mass,
                      gimbal};
  };
  const GimbalInfo reads{true};
  const auto turns = [](double torque, double hardest) {
    return GimbalInfo{true, torque, torque / 2, hardest};  // [N·m], [N·m/rad]
  };
  return {
      device("Touch", {160, 120, 70}, 3.3, 0.88, 400, 55e-6, 0.26, 0.045, unknown, reads),
      device("Touch X", {160, 120, 120}, 7.9, 1.75, 1000, 23e-6, 0.06, 0.045, unknown, reads),
      device("Phantom Premium 1.5", {381, 267, 191}, 8.5, 1.4, 800, 30e-6, 0.04, 0.075, unknown),
      device("Phantom Premium 1.5/6DOF High Force", {381, 267, 191}, 37.5, 6.2, 3500, 7e-6, 0.2, 0.21, 5,
             turns(0.188, 0.3)),
      device("Phantom Premium 3.0", {838, 584, 406}, 22, 3, 1000, 20e-6, 0.2, 0.159, unknown),
      device("Falcon", {102, 102, 102}, 8.0, 4.0, 3000, 64e-6, unknown, unknown, unknown),
      device("omega.3", {160, 160, 110}, 12, 12, 5000, 10e-6, unknown, unknown, unknown),
      device("omega.6", {160, 160, 110}, 12, 12, 5000, 10e-6, unknown, unknown, unknown, reads),
      device("omega.7", {160, 160, 110}, 12, 12, 5000, 10e-6, unknown, unknown, unknown, reads),
      device("sigma.7", {190, 190, 130}, 12, 12, 4000, 1.5e-6, unknown, unknown, unknown, turns(0.2, 1.0)),
      device("Inverse3", {100, 100, 100}, 4, 2, 1000, 100e-6, unknown, unknown, unknown),
  };
}

/// @throws std::invalid_argument with the names that there are
inline DeviceInfo known_device(const std::string& name) {
  std::string names;
  for (DeviceInfo& device : known_devices()) {
    if (device.name == name) return device;
    names += (names.empty() ? "" : ", ") + device.name;
  }
  detail::refuse("device '%.60s': must be one of %s", name.c_str(), names.c_str());
}

}  // namespace hapbeam
