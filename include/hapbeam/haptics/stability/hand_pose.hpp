// SPDX-License-Identifier: MIT
// A hand that turns, and couplings that take its orientation.
//
//   a coupling C of a hand that turns
//   c.tick(touch, pose, dt)   CoupledWrench   noexcept, no allocation; all else as coupling.hpp says
//
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <hapbeam/haptics/stability/coupling.hpp>

namespace hapbeam {

/// Where a hand is in the scene, and how it is turned.
struct HandPose {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< of the stylus' axes, a rotation
};

/// The result of a tick, with the torque on the hand.
template <typename Scalar>
struct CoupledWrench : CoupledForce<Scalar, 3> {
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< [N·m] about the hand; always finite
};

namespace detail {

template <typename C, typename Touch, typename = void>
struct CouplesPose : std::false_type {};
template <typename C, typename Touch>
struct CouplesPose<C, Touch,
                   std::void_t<decltype(std::declval<C&>().tick(std::declval<Touch&>(),
                                                                std::declval<const HandPose&>(), 0.0))>>
    : std::bool_constant<noexcept(
          std::declval<C&>().tick(std::declval<Touch&>(), std::declval<const HandPose&>(), 0.0))> {};

}  // namespace detail

}  // namespace hapbeam
