// SPDX-License-Identifier: MIT
// One end of a rod: what its support holds, in the axes of the support, and where, on the way to where it belongs; and its
// springs.
//
// With displacement x, unit tangent u, axes d1, d2, d3 and twist φ against the carried director of the support
//
//   V = ½ Σ k (d·x)² + Σ k (d·u)²/(1 + d3·u) + ½ k φ²        for a turn by α in one plane, 2 k sin² α/2, of moment k sin α
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <hapbeam/fem/rod/end_path.hpp>

namespace hapbeam::detail {

template <typename Scalar>
class RodEnd {
  using Vector3 = VectorOf<Scalar, 3>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  using Node = RodNode<Scalar>;

 public:
  /// Where the rod's natural shape has the end.
  RodEnd(const RodSupport& support, const Node& natural) noexcept
      : held_{std::isinf(support.place1), std::isinf(support.place2), std::isinf(support.along)},
        direction_(std::isinf(support.turn1)),
        twist_(std::isinf(support.twist)) {
    const auto spring = [](double k) { return std::isinf(k) ? Scalar(0) : static_cast<Scalar>(k); };
    // A turn about d1 moves the tangent along d2.
    across_[0] = spring(support.turn2), across_[1] = spring(support.turn1);
    place_[0] = spring(support.place1), place_[1] = spring(support.place2), place_[2] = spring(support.along);
    torsion_ = spring(support.twist);
    springs_ = !place_.isZero(0) || across_[0] > 0 || across_[1] > 0 || torsion_ > 0;
    goal_ = target_ = home_ = natural;
    begin(natural);
    set_target(1);
  }
  /// Its goal, also when the rod is at rest.
  void place_home(const RodPose& pose) noexcept {
    place(pose);
    home_ = goal_;
  }
  void place(const RodPose& pose) noexcept {
    goal_.r = pose.at.template cast<Scalar>();
    goal_.tangent = pose.along.template cast<Scalar>();
    goal_.director = pose.director.template cast<Scalar>();
    at_goal_ = false;
  }
  /// Puts it at a goal at once.   @param places, turns  how stiff its springs are, in units of those of its support
  void place(const Node& goal, Scalar places, Scalar turns) noexcept {
    goal_ = goal, stiffer_[0] = places, stiffer_[1] = turns, damper_.places = damper_.turns = 0;
    at_goal_ = false;
    set_target(1);
  }
  const Node& goal() const noexcept { return goal_; }
  const Node& target() const noexcept { return target_; }

  /// Its goal is where it belongs at rest.
  void place_home() noexcept {
    place({home_.r.template cast<double>(), home_.tangent.template cast<double>(),
           home_.director.template cast<double>()});
  }
  /// The rod is at rest.
  void go_home() noexcept { target_ = home_, at_goal_ = false; }
  /// A path to the goal begins where the end is, or where its springs were.
  void begin(const Node& node) noexcept { start_ = on_springs() ? target_ : node; }
  void set_target(Scalar t) noexcept {
    if (t == 1 && at_goal_) return;
    target_ = goal_;
    at_goal_ = t == 1;
    if (t < 1) {
      start_.tangent = unit(start_.tangent);
      target_ = gone<Scalar>(start_, t * (goal_.r - start_.r), t * rotation_between(start_, goal_));
    }
    axes_ = axes_of(target_);
  }
  /// d1, d2 and tangent of the target where the unknowns of place are those along them, else null: along those of space.
  const Matrix* place_axes() const noexcept { return holds_place() || !holds_any_place() ? nullptr : &axes_; }
  /// The same for those of r'.
  const Matrix* tangent_axes() const noexcept { return direction_ ? &axes_ : nullptr; }
  /// Whether the node is turned so little against the target that increments lead there: by less than a quarter of a turn where
  /// its direction is held, and by less than half a turn where springs or its twist are counted from there.
  bool follows(const Node& node) const noexcept {
    const bool turned_back = across_[0] > 0 || across_[1] > 0 || torsion_ > 0;
    if (!direction_ && !turned_back && !twist_) return true;
    if (direction_) return target_.tangent.dot(node.tangent) > 0;
    return target_.tangent.dot(unit(node.tangent)) > Scalar(-0.9999);
  }
  /// Whether all is held but how long r' is.   @tparam has_twist  whether there is φ
  template <bool has_twist>
  bool is_clamped() const noexcept {
    return direction_ && holds_place() && (!has_twist || twist_);
  }
  /// Whether nothing is held.
  bool is_free() const noexcept { return !holds_any_place() && !direction_ && !twist_; }
  /// Where a clamped end belongs, as an increment of the node's unknowns: r, r' and φ.
  template <class Increment>
  Increment way(const Node& node) const noexcept {
    Increment by;
    by.template segment<3>(0) = target_.r - node.r;
    by.template segment<3>(3) = target_.tangent.dot(node.tangent) * target_.tangent - node.tangent;
    if constexpr (Increment::RowsAtCompileTime == 7) by[6] = twist(node);
    return by;
  }
  /// Direction of a clamped end.
  const Vector3& direction() const noexcept { return target_.tangent; }
  /// Calls visit(component, increment) for what is held: r 0-2 in place_axes(), r' 3-4 in tangent_axes(), φ 6 where there is one.
  template <bool has_twist, class Visitor>
  void visit(const Node& node, Visitor&& visitor) const noexcept {
    const Vector3 way = target_.r - node.r;
    const bool all = holds_place();
    for (int k = 0; k < 3; ++k)
      if (held_[k]) visitor(k, all ? way[k] : axes_.col(k).dot(way));
    if (direction_)
      for (int k = 0; k < 2; ++k) visitor(3 + k, -axes_.col(k).dot(node.tangent));
    if (has_twist && twist_) visitor(6, twist(node));
  }
  /// Whether a pose places it fully: clamped, or on springs against each of its motions but twist.
  bool takes_pose() const noexcept {
    return (direction_ && holds_place()) || (on_springs() && across_[0] > 0 && across_[1] > 0 &&
                                             place_[0] > 0 && place_[1] > 0 && place_[2] > 0);
  }
  /// Whether its place is one.
  bool holds_place() const noexcept { return held_[0] && held_[1] && held_[2]; }
  /// Whether something keeps its place, springs too.
  bool is_anchored() const noexcept { return holds_any_place() || !place_.isZero(0); }
  /// From the node to where it is held; 0 where it is not.
  Vector3 miss(const Node& node) const noexcept {
    const Vector3 way = target_.r - node.r;
    if (holds_place()) return way;
    Vector3 miss = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      if (held_[k]) miss += axes_.col(k).dot(way) * axes_.col(k);
    return miss;
  }
  /// A joint that holds the twist alone: the director turns by -∂φ/∂r' when the tangent moves.
  bool is_joint() const noexcept { return twist_ && !direction_; }
  Vector3 arm(const Node& node) const noexcept { return holonomy(target_.tangent, node.tangent); }
  /// ∂²φ/∂r'², by the same.
  Matrix bow(const Node& node) const noexcept { return holonomy_change(target_.tangent, node.tangent); }
  /// Puts the node exactly where it belongs.
  void correct(Node& node) const noexcept {
    if (holds_place()) node.r = target_.r;
    else node.r += miss(node);
    if (is_joint()) {
      const Vector3 u = unit(node.tangent);
      node.director = across(carry(target_.director, target_.tangent, u), u);
    }
    if (!direction_) return;
    const Scalar along = target_.tangent.dot(node.tangent);
    node.tangent = (along > 0 ? along : std::sqrt(node.tangent.squaredNorm())) * target_.tangent;
    node.director = twist_ ? target_.director : across(node.director, target_.tangent);
  }

  bool has_springs() const noexcept { return springs_; }
  /// Springs more, until the next place(): those of a damper.   @param at  where they have no force   @param places, turns  as of place()
  void damp(const Node& at, Scalar places, Scalar turns) noexcept {
    damper_ = {at, axes_of(at), places, turns};
  }
  /// Energy of the springs [J]; adds its derivatives.
  /// @param r  of the node's unknowns, out   @param K  the same; r' and φ after r
  template <class Residual, class Block>
  Scalar add_springs(const Node& node, Residual&& r, Block&& K) const noexcept {
    const Scalar energy = add({target_, axes_, stiffer_[0], stiffer_[1]}, node, r, K);
    const bool damped = damper_.places > 0 || damper_.turns > 0;
    return damped ? energy + add(damper_, node, r, K) : energy;
  }

 private:
  /// All springs of the support, so many times as stiff, without force where the node is `at`.
  struct Springs {
    Node at;
    Matrix axes;
    Scalar places, turns;  ///< against places, and against turns
  };
  template <class Residual, class Block>
  Scalar add(const Springs& of, const Node& node, Residual& r, Block& K) const noexcept {
    constexpr bool has_twist = std::decay_t<Residual>::RowsAtCompileTime == 7;
    const Vector3 x = of.axes.transpose() * (node.r - of.at.r), springs = of.places * place_,
                  force = springs.cwiseProduct(x);
    r.template segment<3>(0) += of.axes * force;
    K.template block<3, 3>(0, 0) += of.axes * springs.asDiagonal() * of.axes.transpose();
    Scalar energy = force.dot(x) / 2;
    const Scalar i = 1 / std::sqrt(node.tangent.squaredNorm());
    const Vector3 u = i * node.tangent, d3 = of.axes.col(2);
    if (across_[0] > 0 || across_[1] > 0) {
      // V = s q by u; then u = r'/|r'|.
      const Scalar q = 1 / (1 + d3.dot(u));
      Vector3 m = Vector3::Zero();
      Matrix H = Matrix::Zero();
      for (int k = 0; k < 2; ++k) {
        const Scalar stiffness = of.turns * across_[k];
        m += stiffness * of.axes.col(k).dot(u) * of.axes.col(k);
        H += 2 * q * stiffness * of.axes.col(k) * of.axes.col(k).transpose();
      }
      const Scalar s = m.dot(u);
      const Vector3 by_u = 2 * q * m - s * q * q * d3;
      H += 2 * s * q * q * q * d3 * d3.transpose() - 2 * q * q * (m * d3.transpose() + d3 * m.transpose());
      const Matrix P = Matrix::Identity() - u * u.transpose();
      const Vector3 g = P * by_u;
      energy += s * q;
      r.template segment<3>(3) += i * g;
      K.template block<3, 3>(3, 3) +=
          i * i * (P * H * P - u.dot(by_u) * P - (g * u.transpose() + u * g.transpose()));
    }
    if constexpr (has_twist)
      if (torsion_ > 0) {
        const Scalar twist = -angle_about(u, node.director, across(carry(of.at.director, d3, u), u)),
                     stiffness = of.turns * torsion_, moment = stiffness * twist;
        const Vector3 k = holonomy(of.at.tangent, node.tangent);
        energy += moment * twist / 2;
        r.template segment<3>(3) += moment * k;
        r[6] += moment;
        K.template block<3, 3>(3, 3) +=
            stiffness * k * k.transpose() - moment * holonomy_change(of.at.tangent, node.tangent);
        K.template block<3, 1>(3, 6) += stiffness * k;
        K.template block<1, 3>(6, 3) += stiffness * k.transpose();
        K(6, 6) += stiffness;
      }
    return energy;
  }
  /// By which the director is to turn [rad].
  Scalar twist(const Node& node) const noexcept {
    // What is across both tangents is carried from one to the other.
    if (node.director == target_.director) return 0;
    const Vector3 u = unit(node.tangent);
    return angle_about(u, node.director, across(carry(target_.director, target_.tangent, u), u));
  }
  bool holds_any_place() const noexcept { return held_[0] || held_[1] || held_[2]; }
  /// Nothing is held but by springs.
  bool on_springs() const noexcept { return springs_ && !holds_any_place() && !direction_ && !twist_; }

  bool held_[3], direction_, twist_, springs_;
  Vector3 place_;               // springs along the axes [N/m]
  Scalar stiffer_[2] = {1, 1};  // all springs against places, and against turns
  Scalar across_[2], torsion_;  // against the tangent's turn along d1 and d2, and against twist [N·m/rad]
  Node goal_, home_, start_, target_;
  Matrix axes_;
  Springs damper_{goal_, Matrix::Zero(), 0, 0};
  bool at_goal_ = false;  // the target is
};

}  // namespace hapbeam::detail
