// SPDX-License-Identifier: MIT
// How what is round lies beside a beam or a rod, with its centre within that or behind it, too.
//
// Real-time: noexcept, no allocation, O(log elements).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/centreline.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

/// How a circle or a capsule lies beside a node, as if the curve were straight there.
template <typename Scalar, int D>
struct RoundView {
  VectorOf<Scalar, D> normal;  ///< unit, toward the centre or the axis
  Scalar distance;             ///< of that from the curve, negative: from its other side [m]
  Scalar ahead;                ///< arc length from the node to where they would touch [m]
  bool past_end;               ///< the end point is touched
};

template <typename Scalar, int D>
struct RoundBeside {
  using Vector = VectorOf<Scalar, D>;

  Vector facing;         ///< unit, across the tangent at the foot, to where it comes from
  Scalar height, aside;  ///< of the centre along that [m], and how far it is aside of that, squared [m²]
  Scalar gap;     ///< from the beam to the centre, negative behind it; past an end from its last point [m]
  Vector normal;  ///< unit, along that
  Vector place;   ///< of the beam [m]
  Scalar foot;    ///< [m]
};

/// @tparam RoundContact  RoundContact<Scalar> | RodRoundContact<Scalar>
/// @param foot  in and out: the place that is nearest [m], from where it was
template <class RoundContact, class System, class Round>
auto look_beside(const System& system, const Round& of, typename System::Scalar& foot) noexcept
    -> RoundBeside<typename System::Scalar, System::dimension> {
  using Scalar = typename System::Scalar;
  using Vector = VectorOf<Scalar, System::dimension>;
  constexpr int dimension = System::dimension;
  const auto line = system.centreline();
  const RoundContact round{of};
  auto node = round.node_at(line, foot);
  auto view = round.look(node, 0);
  for (int k = 0; k < 4 && std::abs(view.ahead) > Scalar(1e-7) * of.reach; ++k) {
    foot = std::clamp(foot + view.ahead, Scalar(0), system.length());
    node = round.node_at(line, foot);
    view = round.look(node, 0);
  }
  const Vector place = RoundContact::place_of(node), off = round.centre(place) - place;
  // Where a beam that is bent far leads the search to and fro, no foot is found, and the place is not beside it.
  const bool beyond = (foot <= 0 && view.ahead < 0) || (foot >= system.length() && view.ahead > 0) ||
                      std::abs(view.ahead) > of.reach;
  Vector facing = view.normal;
  Scalar height = view.distance, aside = 0;
  if constexpr (dimension == 3) {
    // Behind the axis of a rod it has the side from which it came.
    facing = round.facing(node.tangent), height = facing.dot(off);
    if (!beyond) aside = (std::max)(off.squaredNorm() - height * height, Scalar(0));
  }
  const Scalar size = std::sqrt(off.squaredNorm());
  if (beyond || (dimension == 3 && height > 0)) return {facing, height, aside, size, off / size, place, foot};
  return {facing, height, aside, height, facing, place, foot};
}

}  // namespace hapbeam::detail
