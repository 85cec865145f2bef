// What the tests of the adapter share: servos, and a press that comes to rest.
#pragma once

#include <algorithm>
#include <cstdint>

#include "emulated_hd.hpp"

namespace hapbeam::testing {

/// A floor at y = 0, and what it was told last.
struct Floor {
  double stiffness = 1000;  // [N/m]
  DeviceState last{};
  std::uint64_t calls = 0, resets = 0;
  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    last = state;
    ++calls;
    resets += state.reset;
    return {0, std::max(0.0, -stiffness * state.position.y()), 0};
  }
};

/// Always the same force.
struct SteadyPush {
  Eigen::Vector3d force{0, 1, 0};
  DeviceState last{};
  std::uint64_t calls = 0;
  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    last = state;
    ++calls;
    return force;
  }
};

/// Down to 20 mm below the floor, and there it stays; steady within a second.
inline HandPath press_and_hold() { return HandPath({0, 0.01}).press(0.03, 0.3).rest(1000); }

/// The whole force from the second tick on.
inline HdapiOptions at_once() {
  HdapiOptions options;
  options.ramp_time = 1e-3;
  return options;
}

/// A damped hand on a floor, settled.
constexpr int ticks_to_rest = 1500;

}  // namespace hapbeam::testing
