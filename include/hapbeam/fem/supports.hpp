// SPDX-License-Identifier: MIT
// The two ends of a beam: which displacements are held, and where, on the way to where they belong.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>

namespace hapbeam::detail {

template <typename Scalar>
struct EndSupport {
  EndSupport(Support support, const EndPlace& place) noexcept
      : held{fixes_u(support), fixes_w(support), fixes_theta(support)},
        goal{static_cast<Scalar>(place.u), static_cast<Scalar>(place.w), static_cast<Scalar>(place.theta)} {}

  /// A path to the goal begins where the end is.
  void begin(const CentrelineNode<Scalar>& node) noexcept {
    start[0] = node.u, start[1] = node.w, start[2] = node.theta;
  }
  void set_target(Scalar t) noexcept {
    for (int k = 0; k < 3; ++k) target[k] = t < 1 ? start[k] + t * (goal[k] - start[k]) : goal[k];
  }
  /// Calls visit(component, displacement, target) for what is held.  @param node const or not
  template <class Node, class Visitor>
  void visit(Node& node, Visitor&& visitor) const noexcept {
    if (held[0]) visitor(0, node.u, target[0]);
    if (held[1]) visitor(1, node.w, target[1]);
    if (held[2]) visitor(2, node.theta, target[2]);
  }

  bool held[3];    ///< u, w, θ
  Scalar goal[3];  ///< [m, m, rad]
  Scalar start[3] = {0, 0, 0}, target[3] = {0, 0, 0};
};

}  // namespace hapbeam::detail
