// SPDX-License-Identifier: MIT
// Where the device's workspace lies in the scene: from the hand to the beam and, for forces, back.
//
//   p_scene = origin + scale R p_device      v_scene = scale R v_device      F_device = Rᵀ F_scene      τ_device = Rᵀ τ_scene / scale
//   [m]                                      [m/s]                           [N] on the hand            [N·m] on the hand
//
// R turns the device's axes into the scene's, whose x and y are the plane of the beam, x along it and y = w across it.  Forces are not
// scaled: with a scale of 2 the hand moves half as far for the same force, so what a device can render in the scene is its own limit
// divided by the scale.
//
//   const Placement placement = Placement::in_plane({1.27, 0.02});    // the device's origin, above mid-span
//   const Vector2<double> hand = placement.beam_position(state.position);
//   const Eigen::Vector3d force = placement.device_force_of_beam(touch.tick(hand).force);
//
//   device or host                x                y           z                 a beam that lies to the right, w up
//   HDAPI, HLAPI, HAPI, H3D       right            up          toward the user   Placement::in_plane(origin, scale)
//   CHAI3D, Force Dimension DHD   toward the user  right       up                x_toward_user(origin, scale)
//   Haply Inverse3                right            away        up                y_away_from_user(origin, scale)
//
// Real-time: no allocation, noexcept, wait-free, O(1), but for what makes a Placement.
#pragma once

#include <Eigen/Core>

#include <hapbeam/centreline.hpp>
#include <hapbeam/check.hpp>
#include <hapbeam/haptics/device/device.hpp>

namespace hapbeam {

class Placement {
 public:
  /// The device's axes are the scene's.
  Placement() noexcept = default;

  /// @param rotation  3×3, the device's axes in the scene's, orthonormal and right-handed to 1e-9
  /// @param origin    [m] where the device's origin lies in the scene
  /// @param scale     [m/m] of the scene for the device, 1e-6 to 1e6
  /// @throws std::invalid_argument
  Placement(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& origin, double scale = 1)
      : turn_(rotation), origin_(origin), scale_(scale) {
    if (!(scale >= 1e-6 && scale <= 1e6))
      detail::reject("placement scale", scale, "m/m", "1e-6 to 1e6: a hand's centimetres are 10 nm to 10 km");
    const double skew = detail::skew_of(rotation);
    if (!(skew <= 1e-9))
      detail::reject("placement rotation, |R R^T - 1|", skew, "", "an orthonormal matrix, at most 1e-9");
    if (!detail::is_rotation(rotation))
      detail::reject("placement rotation determinant", -1, "", "1: a rotation keeps axes right-handed");
    detail::all_finite("placement origin", origin, "m");
  }

  /// The beam lies along the device's x, its w along the device's y.
  /// @param origin  [m] x along the beam and w where the device's origin lies   @param scale  [m/m] 1e-6 to 1e6
  static Placement in_plane(const Vector2<double>& origin, double scale = 1) {
    return Placement(Eigen::Matrix3d::Identity(), {origin.x(), origin.y(), 0}, scale);
  }

  const Eigen::Matrix3d& rotation() const noexcept { return turn_; }
  const Eigen::Vector3d& origin() const noexcept { return origin_; }  ///< [m] scene
  double scale() const noexcept { return scale_; }                    ///< [m/m]

  Eigen::Vector3d scene_position(const Eigen::Vector3d& device) const noexcept {
    return origin_ + scene_velocity(device);
  }
  Eigen::Vector3d scene_velocity(const Eigen::Vector3d& device) const noexcept {
    return scale_ * Eigen::Vector3d(turned(0, device), turned(1, device), turned(2, device));
  }
  /// Where the hand has to be to be there in the scene.  @param scene [m]   @return [m]
  Eigen::Vector3d device_position(const Eigen::Vector3d& scene) const noexcept {
    return device_force((scene - origin_) / scale_);
  }
  Eigen::Vector3d device_force(const Eigen::Vector3d& scene) const noexcept {
    return {turned_back(0, scene), turned_back(1, scene), turned_back(2, scene)};
  }

  /// @param device  a rotation, of the stylus' axes in the device's   @return the same in the scene's
  Eigen::Matrix3d scene_orientation(const Eigen::Matrix3d& device) const noexcept {
    Eigen::Matrix3d scene;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) scene(i, k) = turned(i, device.col(k));
    return scene;
  }
  Eigen::Vector3d device_torque(const Eigen::Vector3d& scene) const noexcept {
    return device_force(scene) / scale_;
  }

  /// In the plane of the beam: what the hand does across that plane is not seen.
  /// @param device [m]   @return [m] x, w
  Vector2<double> beam_position(const Eigen::Vector3d& device) const noexcept {
    const Eigen::Vector3d scene = scene_position(device);
    return {scene[0], scene[1]};
  }
  /// Of a rod in space, whose axes are the scene's, all is seen.
  /// @tparam D  of the space in which the beam bends: 2 | 3   @param device [m]   @return [m]
  template <int D>
  VectorOf<double, D> position_of(const Eigen::Vector3d& device) const noexcept {
    if constexpr (D == 2) return beam_position(device);
    else return scene_position(device);
  }
  /// @param beam [N] on the hand, along x and w; nothing across the plane   @return [N] on the hand
  Eigen::Vector3d device_force_of_beam(const Vector2<double>& beam) const noexcept {
    return device_force({beam.x(), beam.y(), 0});
  }

 private:
  // Rows of R v and Rᵀ v, by hand: as products of Eigen's they cost each file that includes this more than the rest of it.
  double turned(int row, const Eigen::Vector3d& v) const noexcept {
    return turn_(row, 0) * v[0] + turn_(row, 1) * v[1] + turn_(row, 2) * v[2];
  }
  double turned_back(int row, const Eigen::Vector3d& v) const noexcept {
    return turn_(0, row) * v[0] + turn_(1, row) * v[1] + turn_(2, row) * v[2];
  }

  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin_{0, 0, 0};
  double scale_ = 1;
};

/// The beam lies along the host's y, its w along the host's z.
/// @param origin  [m] x along the beam and w where the host's origin lies   @param scale  [m/m] of the beam's for the host's
inline Placement x_toward_user(const Vector2<double>& origin, double scale = 1) {
  Eigen::Matrix3d turn;
  turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return Placement(turn, {origin.x(), origin.y(), 0}, scale);
}

/// The beam lies along the host's x, its w along the host's z.   @param origin, scale  as above
inline Placement y_away_from_user(const Vector2<double>& origin, double scale = 1) {
  Eigen::Matrix3d turn;
  turn << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return Placement(turn, {origin.x(), origin.y(), 0}, scale);
}

}  // namespace hapbeam
