// The point at which a hand holds a rod: one prescribed displacement, n · r = d, of a node or of a straight tip beyond it.
//
// In the equations of that node the unknowns r and r' become r along two directions across n, d, and r':  n·r = d - arm·r',
// where the arm is that of a contact at a distance from the node.
// Where a capsule is touched, n and the arm are those of the present shape, -d is its distance, and the force along n adds
// F ∂²d to the tangent, so that Newton's method finds place and direction of the contact with the equilibrium.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>
#include <limits>

#include <hapbeam/fem/capsule_on_curve.hpp>

namespace hapbeam::detail {

template <typename Scalar>
class RodContact {
  using Node = RodNode<Scalar>;
  using Vector3 = VectorOf<Scalar, 3>;
  using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
  using View = typename CapsuleOnCurve<Scalar>::View;

 public:
  RodContact() = default;
  /// @param node   @param lever [m] from the node to the contact along the rod   @param normal n, unit
  RodContact(int node, Scalar lever, const Vector3& normal) noexcept : node_(node), arm_(lever * normal) {
    face(normal);
  }
  RodContact(int node, const CapsuleOnCurve<Scalar>& capsule) noexcept
      : node_(node), round_(true), capsule_(capsule) {}

  int node() const noexcept { return node_; }  ///< -1: there is no contact
  bool holds(int node) const noexcept { return node == node_; }
  bool round() const noexcept { return round_; }
  /// How a capsule lies to a node.
  View view(const Node& node) const noexcept { return sees(node) ? view_ : capsule_.at(node); }

  /// To be called where the node has moved, before all below.  @param force  along n [N]
  void look(const Node& node, Scalar force) noexcept {
    if (!round_) {
      now_ = plane_displacement(node);
      return;
    }
    force_ = force;
    if (sees(node)) return;
    view_ = capsule_.at(node);
    face(view_.normal);
    arm_ = view_.arm;
    seen(node);
  }
  /// d that the node has [m].
  Scalar displacement() const noexcept { return now_; }
  /// Moves a node along n until d is what it should be.
  void correct(Node& node, Scalar d) noexcept {
    if (!round_) {
      node.r += (d - plane_displacement(node)) * axes_.col(2);
      return;
    }
    look(node, force_);
    // Place and direction of the contact stay.
    const Scalar way = d + view_.distance;
    node.r += way * view_.normal;
    view_.w -= way * view_.normal;
    view_.distance -= way;
    seen(node);
  }

  Vector3 normal() const noexcept { return Vector3(axes_.col(2)); }
  /// Two directions across n, and n.
  const Matrix3& axes() const noexcept { return axes_; }
  /// ∂d/∂r' [m], in space.
  const Vector3& arm() const noexcept { return arm_; }
  bool leans() const noexcept { return !arm_.isZero(0); }
  /// Whether the force makes something of the capsule, and what: to be added to the tangent of the node, by r and r'.
  bool bends() const noexcept { return round_ && force_ != 0; }
  Matrix6<Scalar> bend() const noexcept { return force_ * capsule_.bend(view_); }

 private:
  static View nothing() noexcept {
    View view;
    view.normal = view.arm = view.u = view.t = view.k = view.w = view.f = Vector3::Zero();
    view.distance = view.lever = view.length = 0;
    view.past_end = view.follows = view.slides = false;
    return view;
  }
  bool sees(const Node& node) const noexcept { return node.r == seen_r_ && node.tangent == seen_tangent_; }
  void seen(const Node& node) noexcept {
    now_ = -view_.distance;
    seen_r_ = node.r, seen_tangent_ = node.tangent;
  }
  void face(const Vector3& normal) noexcept {
    // The first direction across n is that across its smallest component.
    int least = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(normal[k]) < std::abs(normal[least])) least = k;
    Vector3 e = Vector3::Zero();
    e[least] = 1;
    axes_.col(0) = across(e, normal);
    axes_.col(1) = cross3<Scalar>(normal, axes_.col(0));
    axes_.col(2) = normal;
  }
  Scalar plane_displacement(const Node& node) const noexcept {
    return axes_.col(2).dot(node.r) + arm_.dot(node.tangent);
  }

  int node_ = -1;
  Matrix3 axes_ = Matrix3::Identity();
  Vector3 arm_ = Vector3::Zero();
  bool round_ = false;  // whether a capsule is touched
  CapsuleOnCurve<Scalar> capsule_;
  Scalar now_ = 0;  // d [m]
  // What was seen of it last, and from which node.
  View view_ = nothing();
  Vector3 seen_r_ = Vector3::Constant(std::numeric_limits<Scalar>::quiet_NaN()), seen_tangent_ = seen_r_;
  Scalar force_ = 0;  // along n [N]
};

}  // namespace hapbeam::detail
