// SPDX-License-Identifier: MIT
// The axes of hosts whose x is not to the right and whose y is not up: a Placement for each.
//
//   host                          x                y           z                 placement of a beam that lies to the right, w up
//   HDAPI, HLAPI, HAPI, H3D       right            up          toward the user   Placement::in_plane(origin, scale)
//   CHAI3D, Force Dimension DHD   toward the user  right       up                x_toward_user(origin, scale)
//   Haply Inverse3                right            away        up                y_away_from_user(origin, scale)
//
// Axes are exchanged or change sign: with scale 1 and the origin at 0 no bit of a position or force changes.
// Real-time: no allocation; may throw as Placement does, so not in the servo.
#pragma once

#include <hapbeam/haptics/servo/placement.hpp>

namespace hapbeam {

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
