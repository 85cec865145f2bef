// SPDX-License-Identifier: MIT
// A circle, seen from a beam, in the words of rod_round_contact.hpp, which has a capsule in space.
//
// Real-time: noexcept, no allocation, O(1) but for the search of a place, which is O(log n).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/angle.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>
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

template <typename Scalar>
struct RoundContact {
  using Node = CentrelineNode<Scalar>;
  using Vector = Vector2<Scalar>;
  const Circle<Scalar>& circle;
  const Circle<Scalar>& request() const noexcept { return circle; }

  using View = RoundView<Scalar, 2>;
  /// @param end  -1 or +1 where the curve begins or ends at the node, 0 within
  View look(const Node& node, int end) const noexcept {
    // Places have fewer digits than displacements: the difference of two places comes first.
    const Vector e((circle.centre.x() - node.s) - node.u, circle.centre.y() - node.w);
    const Vector t = direction(-node.theta), n(-circle.side * t.y(), circle.side * t.x());
    const Scalar along = t.dot(e), above = n.dot(e);
    if (Scalar(end) * along > 0 && above > 0) {
      const Scalar distance = std::sqrt(e.squaredNorm());
      return {e / distance, distance, 0, true};
    }
    return {n, above, along, false};
  }
  static Vector place_of(const Node& node) noexcept { return {node.s + node.u, node.w}; }
  Vector centre(const Vector&) const noexcept { return circle.centre; }
  /// Across a tangent, to the side on which the circle is; unit where that is.
  Vector facing(const Vector& tangent) const noexcept {
    return circle.side * Vector(-tangent.y(), tangent.x());
  }
  static Vector tangent(const Node& node) noexcept { return direction(-node.theta); }
  /// So far a way leads along the curve, in its arc position [m].
  static Scalar along(const Node& node, const Vector& way) noexcept { return tangent(node).dot(way); }
  /// The place from which the displacement of a contact is counted [m].
  static Vector place_at_rest(Scalar s) noexcept { return {s, 0}; }
  /// As a contact of the system.
  template <class Contact>
  void set(Contact& contact) const noexcept {
    contact.centre = circle.centre, contact.side = circle.side;
    contact.normal = Vector(0, -circle.side);
  }
  /// From a node to the centre [m].
  Scalar clearance(const Node& node) const noexcept {
    const Scalar x = (circle.centre.x() - node.s) - node.u, y = circle.centre.y() - node.w;
    return std::sqrt(x * x + y * y);
  }
  /// Where they touch, for friction.
  FrictionPlace<Scalar, 2> place(const View& view, const Node& node) const noexcept {
    return place(node.s, view.ahead, view.normal);
  }
  /// Of a contact of the system.
  template <class Contact>
  FrictionPlace<Scalar, 2> friction_place(const Contact& contact) const noexcept {
    return place(contact.s, 0, -contact.normal);
  }
  /// A node where the mesh has none.
  static Node node_at(const Centreline<Scalar>& line, Scalar s) noexcept {
    const Displacement<Scalar> moved = line.at(s);
    return Node{s, moved.u, moved.w, moved.theta};
  }

 private:
  FrictionPlace<Scalar, 2> place(Scalar s, Scalar ahead, const Vector& n) const noexcept {
    return {s, ahead, n, Vector(circle.side * n.y(), -circle.side * n.x()), 0, Vector::Zero()};
  }
};

}  // namespace hapbeam::detail
