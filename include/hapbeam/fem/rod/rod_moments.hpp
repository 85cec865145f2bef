// SPDX-License-Identifier: MIT
// Moments at nodes of a rod that have a potential, however the rod turns.
//
//   W = M θ + T φ
//
// Where it acts on the natural shape, with the tangent t°, a moment is M a + T t°, a across t°.  M turns the tangent about a, which stays: θ is the angle of
// what r' has across a.  T twists: φ is that against the natural director, which the smallest rotation carries along.  With u the direction of r' they are
//
//   M (a - (a·u) u)/(1 - (a·u)²)      as through a fork that turns on a fixed axis and lets the rod twist: M in a plane
//   T (t° + u)/(1 + t°·u)             as through a joint of constant velocity to a shaft along t°: T along what stays straight
//
// A moment that stays as it is in space, or turns with the rod, has no potential (docs/decisions/moments_of_rods.md).
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(moments).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <hapbeam/fem/loads.hpp>
#include <hapbeam/fem/rod/end_path.hpp>

namespace hapbeam::detail {

template <typename Scalar>
class RodMoments {
  using Vector3 = VectorOf<Scalar, 3>;
  using Node = RodNode<Scalar>;

 public:
  RodMoments() = default;
  /// @param unknowns  of a node   @throws std::invalid_argument where one is too large, or not at a node, or twists a rod that does not
  template <class Nodes>
  RodMoments(const Rod& rod, int unknowns, const NaturalRod<Scalar>& natural, const Nodes& nodes) {
    const LargestLoad<Scalar> largest((std::min)(rod.stiffness().bending1, rod.stiffness().bending2),
                                      rod.length());
    for (const RodForce& load : rod.forces()) {
      const VectorOf<double, 3>& all = load.moment;
      if (all.isZero(0)) continue;
      for (int c = 0; c < 3; ++c) (void)largest.moment("moment", all[c]);
      int node = 0;
      while (node + 1 < nodes.size() && static_cast<double>(nodes[node].s) < load.s - 1e-6 * rod.length())
        ++node;
      if (std::abs(nodes[node].s - load.s) > 1e-6 * rod.length())
        reject("elements", nodes.size() - 1, "", "enough for a node at each moment");
      Moment moment{node, natural.at(nodes[node].s)};
      const Vector3& t = moment.natural.tangent;
      const double along = all.dot(t.template cast<double>()), whole = all.norm();
      // What round-off leaves of a part is none.
      if (std::abs(along) > nothing * whole) moment.twists = static_cast<Scalar>(along);
      if (moment.twists != 0 && unknowns != 7)
        reject("moment along the rod", along, "N·m",
               "0 of a RoundRod, which does not twist; take TwistedRod");
      const Vector3 across = cross3<Scalar>(all.template cast<Scalar>(), t);
      const Scalar size = across.norm();
      if (size > Scalar(nothing * whole)) moment.bends = size, moment.way = across / size;
      moments_.push_back(moment);
    }
  }

  bool empty() const noexcept { return moments_.empty(); }

  /// Counts angles on to where nodes are now, each by less than half a turn.
  template <class Nodes>
  void turn(const Nodes& nodes) noexcept {
    for (Moment& moment : moments_) moment.turn(nodes[moment.node]);
  }
  /// Calls visit(node, tangent, residual) with those of -λW.   @tparam Unknowns  of a node   @return λW [J]
  template <int Unknowns, class Nodes, class Visit>
  Scalar visit(Scalar lambda, const Nodes& nodes, Visit&& visit) const noexcept {
    Scalar work = 0;
    for (Moment moment : moments_) {
      VectorOf<Scalar, Unknowns> r = VectorOf<Scalar, Unknowns>::Zero();
      Eigen::Matrix<Scalar, Unknowns, Unknowns> K = Eigen::Matrix<Scalar, Unknowns, Unknowns>::Zero();
      moment.turn(nodes[moment.node]);
      work += lambda * moment.add(lambda, nodes[moment.node].tangent, r, K);
      visit(moment.node, K, r);
    }
    return work;
  }

 private:
  static constexpr double nothing = 1e-9;  // of the whole moment

  struct Moment {
    int node;
    Node natural;
    Scalar bends = 0, twists = 0;   // M, T [N·m]
    Vector3 way = Vector3::Zero();  // a × t°, along which M turns the tangent
    Scalar theta = 0, phi = 0;

    void turn(const Node& at) noexcept {
      const auto count = [](Scalar angle, Scalar& from) {
        from += std::remainder(angle - from, Scalar(2 * 3.14159265358979323846));
      };
      count(std::atan2(way.dot(at.tangent), natural.tangent.dot(at.tangent)), theta);
      if (twists == 0) return;
      const Vector3 u = unit(at.tangent),
                    carried = across<Scalar>(carry(natural.director, natural.tangent, u), u);
      count(angle_about(u, carried, at.director), phi);
    }
    template <class Residual, class Block>
    Scalar add(Scalar lambda, const Vector3& tangent, Residual& r, Block& K) const noexcept {
      if (bends != 0) {
        const Scalar x = natural.tangent.dot(tangent), y = way.dot(tangent), i = 1 / (x * x + y * y);
        const Vector3 by = i * (x * way - y * natural.tangent), out = i * (x * natural.tangent + y * way);
        r.template segment<3>(3) -= lambda * bends * by;
        K.template block<3, 3>(3, 3) += lambda * bends * (out * by.transpose() + by * out.transpose());
      }
      if constexpr (Residual::RowsAtCompileTime == 7)
        if (twists != 0) {
          r.template segment<3>(3) -= lambda * twists * holonomy(natural.tangent, tangent);
          r[6] -= lambda * twists;
          K.template block<3, 3>(3, 3) += lambda * twists * holonomy_change(natural.tangent, tangent);
        }
      return bends * theta + twists * phi;
    }
  };
  std::vector<Moment> moments_;
};

}  // namespace hapbeam::detail
