// The point at which a hand holds the beam: one prescribed displacement, n · (u, w) = d, of a node or of a tip beyond it.
//
// In the equations of that node the unknowns u, w, θ become p, d, θ: the displacement along the surface, the prescribed
// one, and the rotation,
//
//   u = n_w p + n_x q,   w = n_w q - n_x p,   q = d + arm θ
//
// where the arm is that of a contact at a distance, the lever, on a straight tip beyond the node.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>
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

  int node() const noexcept { return node_; }  ///< -1: there is no contact
  bool holds(int node) const noexcept { return node == node_; }
  const Vector2<Scalar>& normal() const noexcept { return normal_; }

  /// d that the node has now [m].
  Scalar displacement(const Node& node) const noexcept {
    const Scalar at_node = normal_.x() * node.u + normal_.y() * node.w;
    if (lever_ == 0) return at_node;
    if constexpr (AnyRotation) {
      using std::cos;
      using std::sin;
      return at_node + lever_ * (normal_.x() * (cos(node.theta) - 1) - normal_.y() * sin(node.theta));
    }
    return at_node - lever_ * node.theta;
  }

  /// Moves the node along n until d is what it should be.
  void correct(Node& node, Scalar d) const noexcept {
    const Scalar miss = d - displacement(node);
    node.u += normal_.x() * miss;
    node.w += normal_.y() * miss;
  }

  /// To the contact's unknowns in an element: its residual and tangent.  @param first whether it is the element's first node
  void transform(const Node& node, bool first, Vector6<Scalar>& r, Matrix6<Scalar>& K) const noexcept {
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
  /// -∂d/∂θ [m]
  Scalar arm(const Node& node) const noexcept {
    if (lever_ == 0) return 0;
    if constexpr (AnyRotation) {
      using std::cos;
      using std::sin;
      return lever_ * (normal_.x() * sin(node.theta) + normal_.y() * cos(node.theta));
    }
    return lever_;
  }

  int node_ = -1;
  Scalar lever_ = 0;
  Vector2<Scalar> normal_{0, 1};
};

}  // namespace hapbeam::detail
