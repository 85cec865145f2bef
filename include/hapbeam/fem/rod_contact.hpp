// The point at which a hand holds a rod: one prescribed displacement, n · r = d, of a node or of a straight tip beyond it.
//
// In the equations of that node the unknowns r and r' become r along two directions across n, d, and r':  n·r = d - arm·r',
// where the arm is that of a contact at a distance from the node.
// Where a capsule is touched, n and the arm are those of the present shape, -d is its distance, and the force along n adds
// F ∂²d to the tangent, so that Newton's method finds place and direction of the contact with the equilibrium.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <hapbeam/fem/capsule_on_curve.hpp>

namespace hapbeam::detail {

template <typename Scalar>
class RodContact {
  using Node = RodNode<Scalar>;
  using Vector3 = VectorOf<Scalar, 3>;
  using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

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
  auto view(const Node& node) const noexcept { return capsule_.at(node); }

  /// To be called where the node has moved, before all below.  @param force  along n [N]
  void look(const Node& node, Scalar force) noexcept {
    if (!round_) {
      now_ = plane_displacement(node);
      return;
    }
    const auto view = capsule_.at(node);
    now_ = -view.distance;
    face(view.normal);
    arm_ = view.arm;
    bends_ = force != 0;
    if (bends_) bend_ = force * capsule_.bend(view);
  }
  /// d that the node has [m].
  Scalar displacement() const noexcept { return now_; }
  /// Moves a node along n until d is what it should be.
  void correct(Node& node, Scalar d) const noexcept {
    if (!round_) {
      node.r += (d - plane_displacement(node)) * axes_.col(2);
      return;
    }
    const auto view = capsule_.at(node);
    node.r += (d + view.distance) * view.normal;
  }

  Vector3 normal() const noexcept { return Vector3(axes_.col(2)); }
  /// Two directions across n, and n.
  const Matrix3& axes() const noexcept { return axes_; }
  /// ∂d/∂r' [m], in space.
  const Vector3& arm() const noexcept { return arm_; }
  bool leans() const noexcept { return !arm_.isZero(0); }
  /// Whether the force makes something of the capsule, and what: to be added to the tangent of the node, by r and r'.
  bool bends() const noexcept { return round_ && bends_; }
  const Matrix6<Scalar>& bend() const noexcept { return bend_; }

 private:
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
  bool bends_ = false;
  Matrix6<Scalar> bend_ = Matrix6<Scalar>::Zero();  // F ∂²D
};

}  // namespace hapbeam::detail
