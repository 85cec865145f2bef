// SPDX-License-Identifier: MIT
// A capsule, seen from a rod, in the words of round_contact.hpp, which has a circle in a plane.
//
// Real-time: noexcept, no allocation, O(1) but for the search of a place, which is O(log n).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/fem/contact/round_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::detail {

template <typename Scalar>
struct RodRoundContact {
  using Node = RodNode<Scalar>;
  using Vector = VectorOf<Scalar, 3>;
  const Capsule<Scalar>& capsule;
  const Capsule<Scalar>& request() const noexcept { return capsule; }

  using View = RoundView<Scalar, 3>;
  /// @param end  -1 or +1 where the curve begins or ends at the node, 0 within
  View look(const Node& node, int end) const noexcept {
    using std::sqrt;
    const Scalar length = sqrt(node.tangent.squaredNorm());
    const Vector t = node.tangent / length, to_tip = capsule.axis.tip - node.r, &way = capsule.axis.way;
    // Both nearest points of a line and a line; where they are nearly parallel the node itself is touched.
    const Scalar squared = way.squaredNorm(), leans = t.dot(way), aside = squared - leans * leans;
    Scalar along = t.dot(to_tip);
    if (squared > 0) {
      const Scalar free = aside > parallel * squared ? (leans * t.dot(to_tip) - way.dot(to_tip)) / aside
                                                     : -way.dot(to_tip) / squared;
      along = aside > parallel * squared ? along + leans * std::clamp(free, Scalar(0), Scalar(1)) : Scalar(0);
    }
    const bool past_end = Scalar(end) * along > 0;
    if (past_end) along = 0;
    const Vector at = node.r + along * t, w = capsule.axis.at(capsule.axis.nearest(at)) - at;
    const Scalar distance = sqrt(w.squaredNorm());
    const Vector normal = distance > 0 ? Vector(w / distance) : facing(t);
    return {normal, std::copysign(distance, normal.dot(capsule.normal)), along / length, past_end};
  }
  static Vector place_of(const Node& node) noexcept { return node.r; }
  /// The point of the axis that is nearest.
  Vector centre(const Vector& point) const noexcept { return capsule.axis.at(capsule.axis.nearest(point)); }
  /// Across a tangent, to where the capsule has come from; unit.
  Vector facing(const Vector& tangent) const noexcept {
    const Vector across = capsule.normal - tangent * (tangent.dot(capsule.normal) / tangent.squaredNorm());
    const Scalar size = std::sqrt(across.squaredNorm());
    return size > 0 ? Vector(across / size) : capsule.normal;
  }
  static Vector tangent(const Node& node) noexcept { return node.tangent; }
  /// So far a way leads along the curve, in its arc position [m].
  static Scalar along(const Node& node, const Vector& way) noexcept {
    return node.tangent.dot(way) / node.tangent.squaredNorm();
  }
  /// The place from which the displacement of a contact is counted [m].
  static Vector place_at_rest(Scalar) noexcept { return Vector::Zero(); }
  /// As a contact of the system.
  template <class Contact>
  void set(Contact& contact) const noexcept {
    contact.axis = capsule.axis, contact.side = capsule.normal;
    contact.normal = -capsule.normal;
  }
  /// From a node to the axis [m].
  Scalar clearance(const Node& node) const noexcept {
    return std::sqrt((centre(node.r) - node.r).squaredNorm());
  }
  /// Where they touch, for friction.
  FrictionPlace<Scalar, 3> place(const View& view, const Node& node) const noexcept {
    const Scalar length = std::sqrt(node.tangent.squaredNorm());
    return place(node.s, view.ahead * length, view.normal, node.tangent / length,
                 centre(node.r + view.ahead * node.tangent));
  }
  /// Of a contact of the system.
  template <class Contact>
  FrictionPlace<Scalar, 3> friction_place(const Contact& contact) const noexcept {
    return place(contact.s, 0, -contact.normal, unit(contact.tangent), centre(contact.place));
  }
  /// A node where the mesh has none.
  static Node node_at(const Centreline<Scalar, 3>& line, Scalar s) noexcept {
    const int i = line.segment_at(s);
    const RodPoint<Scalar> at = line.at(i, s);
    return {s, at.r, at.tangent, line[i].director};
  }

 private:
  /// Of the square of a sine.
  static constexpr Scalar parallel = Scalar(1e-3);
  FrictionPlace<Scalar, 3> place(Scalar s, Scalar ahead, const Vector& n, const Vector& along,
                                 const Vector& on_axis) const noexcept {
    const Scalar squared = capsule.axis.way.squaredNorm();
    if (!(squared > 0)) return {s, ahead, n, along, 0, Vector::Zero()};
    const Vector axis = capsule.axis.way / std::sqrt(squared);
    return {s, ahead, n, along, axis.dot(on_axis - capsule.axis.tip), axis};
  }
};

}  // namespace hapbeam::detail
