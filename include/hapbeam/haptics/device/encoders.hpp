// What a device's encoders make of the motion of its tip: positions on a grid, a velocity guessed from them.
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
  /// @param resolution [m]; 0: positions are read as they are   @param cutoff f [Hz]   @param period T [s]
  Encoders(double resolution, double cutoff, double period) noexcept
      : resolution_(resolution),
        period_(period),
        gain_(-std::expm1(-2 * 3.141592653589793 * cutoff * period)) {}

  const Eigen::Vector3d& position() const noexcept { return position_; }  ///< [m]
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }  ///< [m/s]

  /// Begins at a place, at rest.  @param tip [m]
  void reset(const Eigen::Vector3d& tip) noexcept {
    position_ = on_grid(tip);
    velocity_.setZero();
  }
  /// Reads the tip, one period after the last reading.  @param tip [m]
  void read(const Eigen::Vector3d& tip) noexcept {
    const Eigen::Vector3d reading = on_grid(tip);
    velocity_ += gain_ * ((reading - position_) / period_ - velocity_);
    position_ = reading;
  }

 private:
  Eigen::Vector3d on_grid(const Eigen::Vector3d& tip) const noexcept {
    if (resolution_ == 0) return tip;
    return {resolution_ * std::nearbyint(tip.x() / resolution_),
            resolution_ * std::nearbyint(tip.y() / resolution_),
            resolution_ * std::nearbyint(tip.z() / resolution_)};
  }

  double resolution_, period_, gain_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), velocity_ = Eigen::Vector3d::Zero();
};

}  // namespace hapbeam
