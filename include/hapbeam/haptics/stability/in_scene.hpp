// SPDX-License-Identifier: MIT
// Vectors of a beam and of the scene: a beam that bends in a plane lies in the scene's x and y.
//
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <Eigen/Core>

#include <hapbeam/centreline.hpp>

namespace hapbeam::detail {

template <typename Scalar>
Eigen::Vector3d in_scene(const VectorOf<Scalar, 2>& v) noexcept {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), 0};
}
template <typename Scalar>
Eigen::Vector3d in_scene(const VectorOf<Scalar, 3>& v) noexcept {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// What a beam sees of it: in its plane, or all.
template <typename Scalar, int D>
VectorOf<Scalar, D> of_beam(const Eigen::Vector3d& v) noexcept {
  VectorOf<Scalar, D> seen;
  for (int i = 0; i < D; ++i) seen[i] = static_cast<Scalar>(v[i]);
  return seen;
}

}  // namespace hapbeam::detail
