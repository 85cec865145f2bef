// What a push by a circle asks of its geometry, in the words of rod_round_contact.hpp, which has a capsule in space.
//
// Real-time: noexcept, no allocation, O(1) but for the search of a place, which is O(log n).
#pragma once

#include <cmath>

#include <hapbeam/fem/circle_on_curve.hpp>
#include <hapbeam/fem/friction_law.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// A circle, seen from a beam.
template <typename Scalar>
struct RoundContact {
  using Node = CentrelineNode<Scalar>;
  using Vector = Vector2<Scalar>;
  using Law = CircleOnCurve<Scalar>;
  using View = typename Law::View;
  const Circle<Scalar>& circle;
  const Circle<Scalar>& request() const noexcept { return circle; }

  /// Beside a node of the present shape.  @param end  as CircleOnCurve
  using Curvature = Scalar;
  Law beside(const Node&, Scalar curvature, int end) const noexcept {
    return {circle.centre, circle.side, curvature, end};
  }
  Law beside(const Centreline<Scalar>& line, int node, int end) const noexcept {
    return beside(line[node], line.curvature(node), end);
  }
  /// Whether the curve is too sharp for that law.
  bool sharp(const Node& node, Scalar curvature) const noexcept {
    return beside(node, curvature, 0).sharp(circle.reach);
  }
  /// Beside a node, as if the curve were straight.
  View look(const Node& node, int end) const noexcept {
    return Law(circle.centre, circle.side, 0, end).at(node);
  }
  /// From the curve, negative from its other side [m].
  Scalar distance(const View& view) const noexcept { return view.distance; }
  Vector normal(const View& view) const noexcept { return view.normal; }
  static Vector place_of(const Node& node) noexcept { return {node.s + node.u, node.w}; }
  /// From a node to the centre [m].
  Scalar clearance(const Node& node) const noexcept {
    const Scalar x = (circle.centre.x() - node.s) - node.u, y = circle.centre.y() - node.w;
    return std::sqrt(x * x + y * y);
  }
  /// n · (u, w) of a plane at s that touches the circle [m].
  Scalar plane(const Vector& n, Scalar s, const Node&) const noexcept {
    return n.x() * (circle.centre.x() - s) + n.y() * circle.centre.y() - circle.reach;
  }
  /// Arc length from the node to the contact [m].
  Scalar ahead(const View& view) const noexcept { return circle.side * view.lever; }
  Vector point(const View& view, const Node&) const noexcept {
    return circle.centre - view.distance * view.normal;
  }
  /// The same for friction, beside a node on whose normal, or that of a plane, the circle lies.
  FrictionPlace<Scalar, 2> place(const Vector& n, const Node& node) const noexcept {
    const Vector along(circle.side * n.y(), -circle.side * n.x());
    const Scalar x = (circle.centre.x() - node.s) - node.u, y = circle.centre.y() - node.w;
    return {node.s, along.x() * x + along.y() * y, n, along, 0, Vector::Zero()};
  }
  FrictionPlace<Scalar, 2> place(const View& view, const Node& node) const noexcept {
    return place(view.normal, node);
  }
  /// How far the centre is from a normal on the node [m].
  Scalar miss(const Vector& n, const Node& node) const noexcept {
    const Scalar x = (circle.centre.x() - node.s) - node.u, y = circle.centre.y() - node.w;
    return std::abs(n.x() * y - n.y() * x);
  }
  /// What ContactSearch takes for the difference of two normals.
  Vector2<Scalar> residual(Scalar ahead, const Vector& from, const Vector& to) const noexcept {
    return {ahead, circle.reach * (from.x() * to.y() - from.y() * to.x())};
  }
  /// A node where the mesh has none.
  static Node node_at(const Centreline<Scalar>& line, Scalar s) noexcept {
    const Displacement<Scalar> moved = line.at(s);
    return Node{s, moved.u, moved.w, moved.theta};
  }
};

}  // namespace hapbeam::detail
