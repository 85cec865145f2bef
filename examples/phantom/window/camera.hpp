// A camera in space: it looks at a point, from a distance, in perspective.
//
// Axes of the scene: x to the right, y up, z toward who looks where both angles are zero.
#pragma once

#include <algorithm>
#include <cmath>
#include <imgui.h>

#include <Eigen/Core>

namespace phantom {

class Camera {
 public:
  static constexpr double first_azimuth = 0.5, first_elevation = 0.38;  ///< [rad]

  Camera() { turn(); }

  /// How it was at first, but for what is looked at.
  void reset() { face(first_azimuth, first_elevation); }
  /// @param azimuth, elevation  [rad] from where it looks, not zoomed
  void face(double azimuth, double elevation) {
    azimuth_ = azimuth, elevation_ = elevation, magnified_ = 1;
    turn();
  }
  /// @param right, up  [rad] what is seen turns to the right, and its upper side toward who looks
  void orbit(double right, double up) {
    azimuth_ -= right;
    // Never from below the floor, nor over the top.
    elevation_ = std::clamp(elevation_ + up, 0.03, 1.54);
    turn();
  }
  void zoom(double factor) { magnified_ = std::clamp(magnified_ * factor, 0.3, 20.0); }

  /// @param middle, size  [m] of what is looked at   @param pixels  for a metre in the middle, before zooming
  void aim(const Eigen::Vector3d& middle, double size, const ImVec2& low, const ImVec2& high, double pixels) {
    middle_ = middle, distance_ = 3 * size, pixels_ = pixels * magnified_;
    centre_ = {(low.x + high.x) / 2, (low.y + high.y) / 2};
  }

  const Eigen::Vector3d& right() const { return right_; }
  const Eigen::Vector3d& up() const { return up_; }
  const Eigen::Vector3d& toward() const { return toward_; }  ///< who looks

  /// [m] nearer to who looks than the middle.
  double nearness(const Eigen::Vector3d& p) const { return toward_.dot(p - middle_); }
  /// [pixel] for a metre at a place.
  double pixels(const Eigen::Vector3d& p) const {
    return pixels_ * distance_ / std::max(distance_ - nearness(p), 0.05 * distance_);
  }
  ImVec2 operator()(const Eigen::Vector3d& p) const {
    const double scale = pixels(p);
    const Eigen::Vector3d way = p - middle_;
    return {centre_.x + static_cast<float>(scale * right_.dot(way)),
            centre_.y - static_cast<float>(scale * up_.dot(way))};
  }
  // The plane in which a cursor leads the hand: that of the picture, but upright unless it is seen from above.  So what goes
  // up in the picture goes up in the scene, and a hand that is led down presses down.
  bool upright() const { return toward_.y() < 0.7; }
  Eigen::Vector3d hand_up() const { return upright() ? Eigen::Vector3d(0, 1, 0) : up_; }
  Eigen::Vector3d hand_toward() const {
    return upright() ? Eigen::Vector3d(-right_.z(), 0, right_.x()) : toward_;
  }
  /// What is seen there in that plane through a place.
  Eigen::Vector3d inverse(const ImVec2& at, const Eigen::Vector3d& through) const {
    const Eigen::Vector3d eye = middle_ + distance_ * toward_, normal = hand_toward();
    const Eigen::Vector3d ray = static_cast<double>(at.x - centre_.x) / pixels_ * right_ -
                                static_cast<double>(at.y - centre_.y) / pixels_ * up_ - distance_ * toward_;
    return eye + normal.dot(through - eye) / normal.dot(ray) * ray;
  }
  /// From a place to who looks, unit.
  Eigen::Vector3d sight(const Eigen::Vector3d& p) const {
    return (middle_ + distance_ * toward_ - p).normalized();
  }

 private:
  void turn() {
    const double c = std::cos(elevation_), s = std::sin(elevation_), x = std::sin(azimuth_),
                 z = std::cos(azimuth_);
    toward_ = {c * x, s, c * z};
    right_ = {z, 0, -x};
    up_ = {-s * x, c, -s * z};
  }

  double azimuth_ = first_azimuth, elevation_ = first_elevation, magnified_ = 1;
  double distance_ = 1, pixels_ = 1;
  ImVec2 centre_{0, 0};
  Eigen::Vector3d middle_{0, 0, 0}, right_{1, 0, 0}, up_{0, 1, 0}, toward_{0, 0, 1};
};

}  // namespace phantom
