// SPDX-License-Identifier: MIT
// A circle, seen from a beam, in the words of rod_round_contact.hpp, which has a capsule in space.
//
// Real-time: noexcept, no allocation, O(1) but for the search of a place, which is O(log n).
#pragma once

#include <cmath>

#include <hapbeam/angle.hpp>
#include <hapbeam/fem/contact/round_beside.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::detail {

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
