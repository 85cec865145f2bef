// What is published about devices that people have, so that nobody has to invent numbers.
//
//   Servo<FemModel<>> servo(model, known_device("omega.3"));
//
// Sources: workspace, force, stiffness, resolution, friction and apparent mass are those of the makers' data sheets (SensAble and
// 3D Systems: Phantom Omni, Desktop, Premium 1.5 and 3.0, Touch, Touch X; Force Dimension: omega.3, .6, .7, sigma.7; Novint:
// Falcon), the Premium's with high force those of the thesis, Table 2.1.  Stiffness is the softest of the three axes, and no more
// than what CHAI3D 3.3.0 allows for the device.  Where a sheet names one force only, half of it is taken to last.
// The figures were not checked against the sheets: compare them with the one that came with the device before a force is sent.
// Not found: friction of the parallel arms (taken for 0, no force relies on it), viscous damping (0: unknown, see
// safe_coupling()), and any figure of the Inverse3 but that it is read and driven in SI: what stands here is low on purpose.
// docs/devices.md has the table.  The rate is a kilohertz: set `period` where a loop runs at another.
// Offline: allocates.
#pragma once

#include <string>
#include <vector>

#include <hapbeam/check.hpp>
#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

inline std::vector<DeviceInfo> known_devices() {
  constexpr double period = 1e-3, unknown = 0;
  const auto device = [&](const char* name, const Eigen::Vector3d& millimetres, double peak,
                          double continuous, double stiffness, double resolution, double friction,
                          double mass, double damping) {
    return DeviceInfo{name,       1e-3 * millimetres, peak,   continuous, stiffness,
                      resolution, friction,           period, damping,    mass};
  };
  return {
      device("Touch", {160, 120, 70}, 3.3, 0.88, 400, 55e-6, 0.26, 0.045, unknown),
      device("Touch X", {160, 120, 120}, 7.9, 1.75, 1000, 23e-6, 0.06, 0.045, unknown),
      device("Phantom Premium 1.5", {381, 267, 191}, 8.5, 1.4, 800, 30e-6, 0.04, 0.075, unknown),
      device("Phantom Premium 1.5/6DOF High Force", {381, 267, 191}, 37.5, 6.2, 3500, 7e-6, 0.2, 0.21, 5),
      device("Phantom Premium 3.0", {838, 584, 406}, 22, 3, 1000, 20e-6, 0.2, 0.159, unknown),
      device("Falcon", {102, 102, 102}, 8.0, 4.0, 3000, 64e-6, unknown, unknown, unknown),
      device("omega.3", {160, 160, 110}, 12, 12, 5000, 10e-6, unknown, unknown, unknown),
      device("omega.6", {160, 160, 110}, 12, 12, 5000, 10e-6, unknown, unknown, unknown),
      device("omega.7", {160, 160, 110}, 12, 12, 5000, 10e-6, unknown, unknown, unknown),
      device("sigma.7", {190, 190, 130}, 12, 12, 4000, 1.5e-6, unknown, unknown, unknown),
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
  throw std::invalid_argument("device '" + name + "': must be one of " + names);
}

}  // namespace hapbeam
