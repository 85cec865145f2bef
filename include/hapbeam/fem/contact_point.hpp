// The point at which a hand holds the beam: one prescribed displacement, n · (u, w) = d, of a node or of a tip beyond it.
//
// In the equations of that node the unknowns u, w, θ become p, d, θ: the displacement along the surface, the prescribed
// one, and the rotation,
//
//   u = n_w p + n_x q,   w = n_w q - n_x p,   q = d + arm θ
//
// where the arm is that of a contact at a distance, the lever, on a straight tip beyond the node.
// Where a circle is touched, n and the lever are those of the present shape, -d is the distance of its centre, and the force
// along n adds F ∂²d to the tangent, so that Newton's method finds place and direction of the contact with the equilibrium.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/circle_on_curve.hpp>
#include <hapbeam/fem/solver/ldlt.hpp>

namespace hapbeam::detail {

/// @tparam AnyRotation  whether a tip turns by its angle or, as moderate rotation has it, by its slope
template <typename Scalar, bool AnyRotation>
class ContactPoint {
  using Node = CentrelineNode<Scalar>;

 public:
  ContactPoint() = default;
  /// @param node   @param lever [m] from the node to the contact along the beam   @param normal n, unit
  ContactPoint(int node, Scalar lever, const Vector2<Scalar>& normal) noexcept
      : node_(node), lever_(lever), normal_(normal) {}
  ContactPoint(int node, const CircleOnCurve<Scalar>& circle) noexcept
      : node_(node), round_(true), circle_(circle) {}

  int node() const noexcept { return node_; }  ///< -1: there is no contact
  bool holds(int node) const noexcept { return node == node_; }
  const Vector2<Scalar>& normal() const noexcept { return normal_; }

  bool round() const noexcept { return round_; }
  /// How a circle lies to a node.
  typename CircleOnCurve<Scalar>::View view(const Node& node) const noexcept { return circle_.at(node); }

  /// To be called where the node has moved, before all below.  @param force  along n [N]
  void look(const Node& node, Scalar force) noexcept {
    if (!round_) {
      now_ = plane_displacement(node);
      return;
    }
    const auto view = circle_.at(node);
    now_ = -view.distance;
    normal_ = view.normal;
    lever_ = view.lever;
    const Scalar turning = -force * (1 + view.bend * view.height);
    along_ = -force * view.bend, along_theta_ = turning, theta_ = turning * view.height;
  }
  /// d that the node has [m].
  Scalar displacement() const noexcept { return now_; }

  /// Moves a node along n until d is what it should be.
  void correct(Node& node, Scalar d) const noexcept {
    const auto move = [&node](const Vector2<Scalar>& normal, Scalar miss) {
      node.u += normal.x() * miss;
      node.w += normal.y() * miss;
    };
    if (!round_) return move(normal_, d - plane_displacement(node));
    const auto view = circle_.at(node);
    move(view.normal, d + view.distance);
  }

  /// To the contact's unknowns in an element: its residual and tangent.  @param first whether it is the element's first node
  /// @param only  whether no other element holds the node, or none before has been asked
  void transform(const Node& node, bool first, bool only, Vector6<Scalar>& r,
                 Matrix6<Scalar>& K) const noexcept {
    const int u = first ? 0 : 3, w = u + 1, theta = u + 2;
    if (AnyRotation && normal_.y() != 1) {
      const Scalar c = normal_.y(), s = normal_.x();
      const auto turn = [c, s](auto&& along, auto&& across) {
        const auto before = along.eval();
        along = c * before - s * across;
        across = s * before + c * across;
      };
      const Scalar ru = r[u];
      r[u] = c * ru - s * r[w];
      r[w] = s * ru + c * r[w];
      turn(K.col(u), K.col(w));
      turn(K.row(u), K.row(w));
    }
    if (lever_ != 0) {
      const Scalar a = arm(node);
      r[theta] += a * r[w];
      K.col(theta) += a * K.col(w);
      K.row(theta) += a * K.row(w);
    }
    if (round_ && only) {
      K(u, u) += along_;
      K(u, theta) += along_theta_, K(theta, u) += along_theta_;
      K(theta, theta) += theta_;
    }
  }
  /// A force on the node, the same way.
  Vector3<Scalar> transform(const Node& node, const Vector3<Scalar>& f) const noexcept {
    const Scalar across = normal_.x() * f[0] + normal_.y() * f[1];
    return {normal_.y() * f[0] - normal_.x() * f[1], across, f[2] + arm(node) * across};
  }
  /// An increment (p, q, θ) as (u, w, θ).
  Vector3<Scalar> back(const Vector3<Scalar>& x) const noexcept {
    return {normal_.y() * x[0] + normal_.x() * x[1], normal_.y() * x[1] - normal_.x() * x[0], x[2]};
  }

 private:
  Scalar plane_displacement(const Node& node) const noexcept {
    const Scalar at_node = normal_.x() * node.u + normal_.y() * node.w;
    if (lever_ == 0) return at_node;
    if constexpr (AnyRotation) {
      const Vector2<Scalar> along = direction(-node.theta);
      return at_node + lever_ * (normal_.x() * (along.x() - 1) + normal_.y() * along.y());
    }
    return at_node - lever_ * node.theta;
  }
  /// -∂d/∂θ [m]
  Scalar arm(const Node& node) const noexcept {
    if (lever_ == 0 || round_) return lever_;
    if constexpr (AnyRotation) {
      const Vector2<Scalar> along = direction(-node.theta);
      return lever_ * (normal_.y() * along.x() - normal_.x() * along.y());
    }
    return lever_;
  }

  int node_ = -1;
  Scalar lever_ = 0;
  Vector2<Scalar> normal_{0, 1};
  bool round_ = false;  // whether a circle is touched
  CircleOnCurve<Scalar> circle_;
  Scalar now_ = 0;                                  // d [m]
  Scalar along_ = 0, along_theta_ = 0, theta_ = 0;  // F ∂²d by p, p and θ, θ
};

}  // namespace hapbeam::detail
