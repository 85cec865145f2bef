// What a push by a capsule in space asks of its geometry, in the words of round_contact.hpp, which has a circle in a plane.
//
// Real-time: noexcept, no allocation, O(1) but for the search of a place, which is O(log n).
#pragma once

#include <cmath>

#include <hapbeam/fem/capsule_on_curve.hpp>
#include <hapbeam/fem/friction_law.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// A capsule, seen from a rod.
template <typename Scalar>
struct RodRoundContact {
  using Node = RodNode<Scalar>;
  using Vector = VectorOf<Scalar, 3>;
  using Law = CapsuleOnCurve<Scalar>;
  using View = typename Law::View;
  const Capsule<Scalar>& capsule;
  const Capsule<Scalar>& request() const noexcept { return capsule; }

  using Curvature = Vector;
  Law beside(const Node& node, const Vector& curvature, int end) const noexcept {
    return {capsule.axis, node, curvature, end};
  }
  Law beside(const Centreline<Scalar, 3>& line, int node, int end) const noexcept {
    return beside(line[node], line.curvature(node), end);
  }
  /// Whether the curve is too sharp for that law.
  bool sharp(const Node& node, const Vector& curvature) const noexcept {
    return Law::sharp(capsule.axis, node.r, curvature, capsule.reach);
  }
  View look(const Node& node, int end) const noexcept {
    return Law(capsule.axis, node, Vector::Zero(), end).at(node);
  }
  Scalar distance(const View& view) const noexcept {
    return std::copysign(view.distance, view.normal.dot(capsule.normal));
  }
  /// The way round the axis is not the way that the capsule has come.
  bool is_through(const View& view) const noexcept { return !(2 * distance(view) > capsule.reach); }
  /// The same beside a node.  A sphere lies across the tangent there.
  bool is_through(const Node& node, int end) const noexcept {
    if (end != 0 || !capsule.axis.way.isZero(0)) return is_through(look(node, end));
    const Vector way = capsule.axis.tip - node.r, &t = node.tangent,
                 across = way - t * (t.dot(way) / t.squaredNorm());
    return !(across.dot(capsule.normal) > 0 && 4 * across.squaredNorm() > capsule.reach * capsule.reach);
  }
  static Vector place_of(const Node& node) noexcept { return node.r; }
  Scalar clearance(const Node& node) const noexcept {
    return std::sqrt((capsule.axis.at(capsule.axis.nearest(node.r)) - node.r).squaredNorm());
  }
  Vector normal(const View&) const noexcept { return capsule.normal; }
  Scalar plane(const Vector& n, Scalar, const Node& node) const noexcept {
    return n.dot(capsule.axis.at(capsule.axis.nearest(node.r))) - capsule.reach;
  }
  Scalar ahead(const View& view) const noexcept { return view.lever / view.length; }
  Vector point(const View& view, const Node& node) const noexcept { return node.r + view.f; }
  /// For friction, beside a node.
  FrictionPlace<Scalar, 3> place(const View& view, const Node& node) const noexcept {
    return place(node.s, view.lever, view.normal, unit(view.t), node.r + view.f + view.w);
  }
  FrictionPlace<Scalar, 3> place(const Vector& n, const Node& node) const noexcept {
    const Vector on_axis = capsule.axis.at(capsule.axis.nearest(node.r));
    const Vector along = unit<Scalar>(node.tangent - n * n.dot(node.tangent));
    return place(node.s, along.dot(on_axis - node.r), n, along, on_axis);
  }
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

 private:
  FrictionPlace<Scalar, 3> place(Scalar s, Scalar ahead, const Vector& n, const Vector& along,
                                 const Vector& on_axis) const noexcept {
    const Scalar squared = capsule.axis.way.squaredNorm();
    if (!(squared > 0)) return {s, ahead, n, along, 0, Vector::Zero()};
    const Vector axis = capsule.axis.way / std::sqrt(squared);
    return {s, ahead, n, along, axis.dot(on_axis - capsule.axis.tip), axis};
  }
};

}  // namespace hapbeam::detail
