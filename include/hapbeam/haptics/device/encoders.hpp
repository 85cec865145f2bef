// SPDX-License-Identifier: MIT
// Encoders of a simulated device: positions on a grid, and a velocity estimated from them.
//
// Position: the nearest point of a grid of the resolution, axis by axis.
// Velocity: the difference of successive readings over the period, q', through a low pass of first order,
//
//   v += (1 - exp(-2 pi f T)) (q' - v)
//
// because one step of the grid in one period alone would read as 7 mm/s.  It lags by about 1 / (2 pi f).
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <cmath>

#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

class Encoders {
 public:
  /// @param resolution [m]; 0: positions are read as they are   @param cutoff f [Hz]
  Encoders(double resolution, double cutoff) noexcept
      : resolution_(resolution), cutoff_(2 * 3.141592653589793 * cutoff) {}

  const Eigen::Vector3d& position() const noexcept { return position_; }  ///< [m]
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }  ///< [m/s]

  /// Begins at a place, without motion.  @param tip [m]
  void reset(const Eigen::Vector3d& tip) noexcept {
    position_ = on_grid(tip);
    velocity_.setZero();
  }
  /// Reads the tip.  @param tip [m]   @param period [s] since the last reading
  void read(const Eigen::Vector3d& tip, double period) noexcept {
    const Eigen::Vector3d reading = on_grid(tip);
    velocity_ += -std::expm1(-cutoff_ * period) * ((reading - position_) / period - velocity_);
    position_ = reading;
  }

 private:
  Eigen::Vector3d on_grid(const Eigen::Vector3d& tip) const noexcept {
    if (resolution_ == 0) return tip;
    return {resolution_ * std::nearbyint(tip.x() / resolution_),
            resolution_ * std::nearbyint(tip.y() / resolution_),
            resolution_ * std::nearbyint(tip.z() / resolution_)};
  }

  double resolution_, cutoff_;  // [m], [rad/s]
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), velocity_ = Eigen::Vector3d::Zero();
};

}  // namespace hapbeam
