// What a push by a circle in a plane and one by a capsule in space ask of their geometry, in the same words.
//
// Real-time: noexcept, no allocation, O(1) but for the search of a place, which is O(log n).
#pragma once

#include <cmath>

#include <hapbeam/fem/capsule_on_curve.hpp>
#include <hapbeam/fem/circle_on_curve.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// A circle, seen from a beam.
template <typename Scalar>
struct RoundContact2 {
  using Node = CentrelineNode<Scalar>;
  using Vector = Vector2<Scalar>;
  using Law = CircleOnCurve<Scalar>;
  using View = typename Law::View;
  const Circle<Scalar>& circle;

  /// Beside a node of the present shape.  @param end  as CircleOnCurve
  Law beside(const Centreline<Scalar>& line, int node, int end) const noexcept {
    return {circle.centre, circle.side, line.curvature(node), end};
  }
  /// Beside a node, as if the curve were straight.
  View look(const Node& node, int end) const noexcept {
    return Law(circle.centre, circle.side, 0, end).at(node);
  }
  /// From the curve, negative from its other side [m].
  Scalar distance(const View& view) const noexcept { return view.distance; }
  /// Whether nothing but a plane leads to where the circle is.
  bool is_through(const View&) const noexcept { return false; }
  Vector normal(const View& view) const noexcept { return view.normal; }
  /// n · (u, w) of a plane at s that touches the circle [m].
  Scalar plane(const Vector& n, Scalar s, const Node&) const noexcept {
    return n.x() * (circle.centre.x() - s) + n.y() * circle.centre.y() - circle.reach;
  }
  /// Arc length from the node to the contact [m].
  Scalar ahead(const View& view) const noexcept { return circle.side * view.lever; }
  Vector point(const View& view, const Node&) const noexcept {
    return circle.centre - view.distance * view.normal;
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

/// A capsule, seen from a rod.
template <typename Scalar>
struct RoundContact3 {
  using Node = RodNode<Scalar>;
  using Vector = VectorOf<Scalar, 3>;
  using Law = CapsuleOnCurve<Scalar>;
  using View = typename Law::View;
  const Capsule<Scalar>& capsule;

  Law beside(const Centreline<Scalar, 3>& line, int node, int end) const noexcept {
    return {capsule.axis, line[node], line.curvature(node), end};
  }
  View look(const Node& node, int end) const noexcept {
    return Law(capsule.axis, node, Vector::Zero(), end).at(node);
  }
  Scalar distance(const View& view) const noexcept {
    return std::copysign(view.distance, view.normal.dot(capsule.normal));
  }
  /// The way round the axis is not the way that the capsule has come.
  bool is_through(const View& view) const noexcept { return !(2 * distance(view) > capsule.reach); }
  Vector normal(const View&) const noexcept { return capsule.normal; }
  Scalar plane(const Vector& n, Scalar, const Node& node) const noexcept {
    return n.dot(capsule.axis.at(capsule.axis.nearest(node.r))) - capsule.reach;
  }
  Scalar ahead(const View& view) const noexcept { return view.lever / view.length; }
  Vector point(const View& view, const Node& node) const noexcept { return node.r + view.f; }
  Scalar miss(const Vector& n, const Node& node) const noexcept {
    using std::sqrt;
    const Vector way = capsule.axis.at(capsule.axis.nearest(node.r)) - node.r;
    return sqrt((way - n.dot(way) * n).squaredNorm());
  }
  VectorOf<Scalar, 4> residual(Scalar ahead, const Vector& from, const Vector& to) const noexcept {
    const Vector turned = capsule.reach * (to - from);
    return {ahead, turned.x(), turned.y(), turned.z()};
  }
  static Node node_at(const Centreline<Scalar, 3>& line, Scalar s) noexcept {
    const int i = line.segment_at(s);
    const RodPoint<Scalar> at = line.at(i, s);
    return {s, at.r, at.tangent, line[i].director};
  }
};

template <typename Scalar>
RoundContact2<Scalar> round_contact(const Circle<Scalar>& circle) noexcept {
  return {circle};
}
template <typename Scalar>
RoundContact3<Scalar> round_contact(const Capsule<Scalar>& capsule) noexcept {
  return {capsule};
}

}  // namespace hapbeam::detail
