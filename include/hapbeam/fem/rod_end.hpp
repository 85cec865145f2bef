// One end of a rod: what its support holds, in the axes of the support, and where, on the way to where it belongs.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <hapbeam/rod.hpp>

namespace hapbeam::detail {

template <typename Scalar>
class RodEnd {
  using Vector3 = VectorOf<Scalar, 3>;
  using Node = RodNode<Scalar>;

 public:
  /// Where the rod's natural shape has the end.
  RodEnd(RodSupport support, const Node& natural) noexcept
      : place_(support != RodSupport::free),
        direction_(support == RodSupport::clamped),
        twist_(holds_twist(support)),
        goal_(natural) {
    begin(natural);
    set_target(1);
  }
  void place(const RodPose& pose) noexcept {
    goal_.r = pose.at.template cast<Scalar>();
    goal_.tangent = pose.along.template cast<Scalar>();
    goal_.director = pose.director.template cast<Scalar>();
  }

  /// A path to the goal begins where the end is.
  void begin(const Node& node) noexcept {
    using std::sqrt;
    start_ = node;
    start_.tangent = unit(node.tangent);
    // The rotation from start to goal: its sine and axis are in the antisymmetric part.
    const Vector3 *a[3], *b[3], s2 = cross3(start_.tangent, start_.director),
                                g2 = cross3(goal_.tangent, goal_.director);
    a[0] = &start_.tangent, a[1] = &start_.director, a[2] = &s2;
    b[0] = &goal_.tangent, b[1] = &goal_.director, b[2] = &g2;
    Vector3 twice = Vector3::Zero();
    Scalar trace = 0;
    for (int k = 0; k < 3; ++k) twice += cross3(*a[k], *b[k]), trace += a[k]->dot(*b[k]);
    const Scalar sine = sqrt(twice.squaredNorm()) / 2;
    using std::atan2;
    const Scalar angle = atan2(sine, (trace - 1) / 2);
    rotation_ = sine > 0 ? Vector3(twice * (angle / (2 * sine))) : Vector3::Zero();
  }
  void set_target(Scalar t) noexcept {
    target_ = goal_;
    if (!(t < 1)) return;
    target_.r = start_.r + t * (goal_.r - start_.r);
    const Vector3 turn = t * rotation_;
    target_.tangent = rotate(turn, start_.tangent);
    target_.director = rotate(turn, start_.director);
  }
  /// d1, d2 and tangent of the target.
  Eigen::Matrix<Scalar, 3, 3> axes() const noexcept {
    Eigen::Matrix<Scalar, 3, 3> axes;
    axes.col(0) = target_.director;
    axes.col(1) = cross3(target_.tangent, target_.director);
    axes.col(2) = target_.tangent;
    return axes;
  }
  /// Calls visit(component, increment) for what is held: r 0-2 and r' 3-4 in axes(), φ 6.
  template <class Visitor>
  void visit(const Node& node, Visitor&& visitor) const noexcept {
    const auto axes = this->axes();
    if (place_)
      for (int k = 0; k < 3; ++k) visitor(k, axes.col(k).dot(target_.r - node.r));
    if (direction_)
      for (int k = 0; k < 2; ++k) visitor(3 + k, -axes.col(k).dot(node.tangent));
    if (!twist_) return;
    const Vector3 u = unit(node.tangent);
    visitor(6, angle_about(u, node.director, across(carry(target_.director, target_.tangent, u), u)));
  }
  bool is_clamped() const noexcept { return direction_; }
  bool holds_place() const noexcept { return place_; }
  /// How far the node is from where it is held; nothing where it is not.
  Vector3 miss(const Node& node) const noexcept {
    return place_ ? Vector3(target_.r - node.r) : Vector3(Vector3::Zero());
  }
  /// A joint that holds the twist alone: what the director turns by when the tangent moves, -∂φ/∂r' at held twist, in space.
  bool is_joint() const noexcept { return twist_ && !direction_; }
  Vector3 arm(const Node& node) const noexcept {
    using std::sqrt;
    const Scalar i = 1 / sqrt(node.tangent.squaredNorm());
    const Vector3 u = i * node.tangent;
    return cross3(target_.tangent, u) * (i / (1 + target_.tangent.dot(u)));
  }
  /// ∂²φ/∂r'², by the same.
  Eigen::Matrix<Scalar, 3, 3> bow(const Node& node) const noexcept {
    using std::sqrt;
    const Scalar i = 1 / sqrt(node.tangent.squaredNorm());
    const Vector3 u = i * node.tangent, k = arm(node),
                  q = i * ((target_.tangent + u) / (1 + target_.tangent.dot(u)) + u);
    return (k * q.transpose() + q * k.transpose()) / 2;
  }
  /// Puts the node exactly where it belongs.
  void correct(Node& node) const noexcept {
    if (place_) node.r = target_.r;
    if (is_joint()) {
      const Vector3 u = unit(node.tangent);
      node.director = across(carry(target_.director, target_.tangent, u), u);
    }
    if (!direction_) return;
    node.tangent = target_.tangent.dot(node.tangent) * target_.tangent;
    node.director = target_.director;
  }

 private:
  /// Rodrigues.
  static Vector3 rotate(const Vector3& by, const Vector3& v) noexcept {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const Scalar angle = sqrt(by.squaredNorm());
    if (angle == 0) return v;
    const Vector3 axis = by / angle, w = cross3(axis, v);
    return v + sin(angle) * w + (1 - cos(angle)) * cross3(axis, w);
  }

  bool place_, direction_, twist_;
  Node goal_, start_, target_;
  Vector3 rotation_ = Vector3::Zero();
};

}  // namespace hapbeam::detail
