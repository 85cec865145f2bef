// SPDX-License-Identifier: MIT
// A circle, seen from a beam, and a capsule, seen from a rod in space, in the same words; and the friction of their contact.
//
// Real-time: noexcept, no allocation, O(1) but for the search of a place, which is O(log n).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/angle.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/contact/friction_law.hpp>
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

 private:
  FrictionPlace<Scalar, 2> place(Scalar s, Scalar ahead, const Vector& n) const noexcept {
    return {s, ahead, n, Vector(circle.side * n.y(), -circle.side * n.x()), 0, Vector::Zero()};
  }
};

/// The same of a capsule and a rod in space.
template <typename Scalar>
struct RodRoundContact {
  using Node = RodNode<Scalar>;
  using Vector = VectorOf<Scalar, 3>;
  const Capsule<Scalar>& capsule;
  const Capsule<Scalar>& request() const noexcept { return capsule; }

  using View = RoundView<Scalar, 3>;
  /// @param end  -1 or +1 where the curve begins or ends at the node, 0 within
  View look(const Node& node, int end) const noexcept {
    const Scalar length = std::sqrt(node.tangent.squaredNorm());
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
    const Scalar distance = std::sqrt(w.squaredNorm());
    const Vector normal = distance > 0 ? Vector(w / distance) : facing(t);
    return {normal, std::copysign(distance, normal.dot(capsule.normal)), along / length, past_end};
  }
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

/// Coulomb friction of one contact, as a system knows it: the law, and where the two bodies touch.
/// @tparam RoundContact  RoundContact<Scalar> | RodRoundContact<Scalar>
template <typename Scalar, int D, template <typename> class RoundContact>
class ContactFriction : public FrictionLaw<Scalar, D> {
 public:
  /// @param state  what the touch remembers   @param round  the avatar   @param system  that is pushed, as it lies before
  /// @param normal_force  of the tick before [N]   @param alone  whether it is the only contact
  template <class System>
  ContactFriction(const FrictionState<Scalar, D>& state, const RoundContact<Scalar>& round,
                  const System& system, Scalar normal_force, bool alone) noexcept
      : round_(round) {
    const auto line = system.drawn();
    const auto node = line.node_at(round.request().s);
    const Scalar per_length = system.unit() / system.length();
    const int beside = line.node_near(round.request().s);
    // The mean of both pieces has an error of first order.  A contact that is alone keeps it, and with it the last bit of its forces: it costs up
    // to 4e-6 of what is dissipated on a bar between hinges that is bent by four times its thickness.
    this->begin(state, alone, round.place(round.look(node, 0), node),
                alone ? line.stretch(beside) : line.extrapolated_stretch(beside), round.request().reach,
                per_length * per_length / std::sqrt(std::numeric_limits<Scalar>::epsilon()),
                system.length() / 1000, normal_force);
  }

  /// Where this is a copy of that of another place of the avatar.   @param node  where they touch
  template <class Node>
  void begin_beside(const Node& node) noexcept {
    FrictionLaw<Scalar, D>::begin_beside(round_.place(round_.look(node, 0), node));
  }
  /// To be called where the beam has moved.  @param contact  an InnerContact
  template <class Contact>
  void look(const Contact& contact) noexcept {
    FrictionLaw<Scalar, D>::look(round_.friction_place(contact));
  }
  /// Its force on the contact, after that.
  template <class Contact>
  void give(Contact& contact) const noexcept {
    contact.friction = this->force();
    if constexpr (D == 2) contact.friction_stiffness = this->stiffness();
    else contact.friction_tangent = this->tangent();
  }

 private:
  RoundContact<Scalar> round_;
};

}  // namespace hapbeam::detail
