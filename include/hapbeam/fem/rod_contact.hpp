// The point at which a hand holds a rod: one prescribed displacement, n · r = d, of a node or of a straight tip beyond it.
//
// In the equations of that node d takes the place of that component of r along which n points most:  n·r = d - arm·r',
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
  using View = typename CapsuleOnCurve<Scalar>::View;

 public:
  RodContact() = default;
  /// @param node   @param lever [m] from the node to the contact along the rod   @param normal n, unit
  RodContact(int node, Scalar lever, const Vector3& normal) noexcept
      : node_(node), normal_(normal), arm_(lever * normal) {}
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
    normal_ = view_.normal, arm_ = view_.arm;
    seen(node);
  }
  /// d that the node has [m].
  Scalar displacement() const noexcept { return now_; }
  /// Moves a node along n until d is what it should be.
  void correct(Node& node, Scalar d) noexcept {
    if (!round_) {
      node.r += (d - plane_displacement(node)) * normal_;
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

  const Vector3& normal() const noexcept { return normal_; }
  /// ∂d/∂r' [m], in space.
  const Vector3& arm() const noexcept { return arm_; }
  /// The component of r along which n points most.
  int leading() const noexcept {
    int k = std::abs(normal_[1]) > std::abs(normal_[0]) ? 1 : 0;
    return std::abs(normal_[2]) > std::abs(normal_[k]) ? 2 : k;
  }
  /// d in units of that component, or the force along n from one on it.
  Scalar along(Scalar x) const noexcept { return x / normal_[leading()]; }
  /// What r but for that component, and r', are of d, in its units.  @param T  the axes along which r' is counted, null: those of space
  VectorOf<Scalar, 6> share(const Eigen::Matrix<Scalar, 3, 3>* T = nullptr) const noexcept {
    const Scalar unit = along(1);
    VectorOf<Scalar, 6> part;
    part.template head<3>() = unit * normal_;
    part.template tail<3>() = unit * (T ? Vector3(T->transpose() * arm_) : arm_);
    part[leading()] = 0;
    return part;
  }
  /// A way along n, in what the node's unknowns of place are then.
  Vector3 way(Scalar moves) const noexcept {
    Vector3 by = moves * normal_;
    by[leading()] = along(moves);
    return by;
  }
  /// The increment of r and r' from that of those unknowns, while d grows by so much.
  template <class Increment>
  void complete(Increment& x, Scalar moves, const Eigen::Matrix<Scalar, 3, 3>* T = nullptr) const noexcept {
    x.template head<3>() += way(moves);
    x[leading()] -= share(T).dot(x.template head<6>());
  }
  /// Whether the force makes something of the capsule, and what: to be added to the tangent of the node, by r and r'.
  bool bends() const noexcept { return round_ && force_ != 0; }
  Matrix6<Scalar> bend() const noexcept { return force_ * capsule_.bend(view_); }

 private:
  static View nothing() noexcept {
    View view;
    view.normal = view.arm = view.u = view.b = view.t = view.k = view.w = view.f = Vector3::Zero();
    view.distance = view.lever = view.length = 0;
    view.past_end = view.follows = view.slides = false;
    return view;
  }
  bool sees(const Node& node) const noexcept { return node.r == seen_r_ && node.tangent == seen_tangent_; }
  void seen(const Node& node) noexcept {
    now_ = -view_.distance;
    seen_r_ = node.r, seen_tangent_ = node.tangent;
  }
  Scalar plane_displacement(const Node& node) const noexcept {
    return normal_.dot(node.r) + arm_.dot(node.tangent);
  }

  int node_ = -1;
  Vector3 normal_ = Vector3::UnitZ(), arm_ = Vector3::Zero();
  bool round_ = false;  // whether a capsule is touched
  CapsuleOnCurve<Scalar> capsule_;
  Scalar now_ = 0;  // d [m]
  // What was seen of it last, and from which node.
  View view_ = nothing();
  Vector3 seen_r_ = Vector3::Constant(std::numeric_limits<Scalar>::quiet_NaN()), seen_tangent_ = seen_r_;
  Scalar force_ = 0;  // along n [N]
};

}  // namespace hapbeam::detail
