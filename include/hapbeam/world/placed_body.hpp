// SPDX-License-Identifier: MIT
// A rigid body of a World as it lies, and its path in a tick: where its axis begins goes straight, and it turns.
//
// Real-time: noexcept, no allocation but at construction, O(1).
#pragma once

#include <array>
#include <cmath>

#include <hapbeam/contact/box.hpp>
#include <hapbeam/fem/rod/end_path.hpp>
#include <hapbeam/support.hpp>
#include <hapbeam/world/rigid_body.hpp>

namespace hapbeam::detail {

class PlacedBody {
 public:
  using Vector = VectorOf<double, 3>;
  using Matrix = Eigen::Matrix<double, 3, 3>;
  using Step =
      VectorOf<double, 9>;  // of where the axis begins, and of two directions as far as it reaches [m]

  explicit PlacedBody(const RigidBody& body)
      : body_(body), begin_(body.axis().at(0).r), home_(Node{0, begin_, {1, 0, 0}, {0, 1, 0}}) {
    reset();
  }

  /// As it was built.
  const RigidBody& body() const noexcept { return body_; }
  /// Whether nothing can be behind it that has been before.
  bool is_thick() const noexcept { return body_.kind() == RigidBody::Kind::half_space; }
  /// Where the axis is [m].
  Vector at(double s) const noexcept { return now_.node.r + now_.axes * (body_.axis().at(s).r - begin_); }
  /// Places as it was built, of now or of save().
  template <class Places>
  Places local(const Places& x) const noexcept {
    return now_.local(x, begin_);
  }
  template <class Places>
  Places saved_local(const Places& x) const noexcept {
    return saved_.local(x, begin_);
  }
  Vector turned(const Vector& v) const noexcept { return now_.axes * v; }
  /// What is nearest to a place: its direction from there, its distance, and where it is from where the axis begins [m].
  struct Nearest {
    Vector normal, on;
    double distance;
  };
  Nearest nearest(const Vector& x) const noexcept {
    const Vector p = local(x);
    return nearest(p, body_.from_core(p));
  }
  /// @param p, found  as it was built
  Nearest nearest(const Vector& p, const SurfaceDistance& found) const noexcept {
    return {turned(found.normal), turned(p - found.distance * found.normal - begin_), found.distance};
  }
  /// A direction that has turned with it since save().
  Vector carried(const Vector& v) const noexcept { return now_.axes * (saved_.axes.transpose() * v); }
  /// How far a point of it has moved since save(), at most [m].
  double travel() const noexcept {
    return std::sqrt((now_.node.r - saved_.node.r).squaredNorm()) +
           body_.size() * std::sqrt((now_.axes - saved_.axes).squaredNorm());
  }
  /// From the core of the body to where it presses a rod [m].
  double reach(double radius) const noexcept { return radius + body_.depth(); }

  void reset() noexcept { goal_ = last_ = home_, step_.setZero(), restart(); }
  void restart() noexcept { now_ = start_ = saved_ = home_, moves = true; }
  void save() noexcept { saved_ = now_; }
  void restore() noexcept { now_ = saved_; }
  /// @param pose  of the frame in which it was built   @return whether it is one
  bool place(RodPose pose) noexcept {
    if (!pose.make_valid()) return false;
    Place to(Node{0, pose.at, pose.along, pose.director});
    to.node.r += to.axes * begin_;
    moves = moves || to.node.r != goal_.node.r || to.axes != goal_.axes;
    goal_ = to;
    return true;
  }
  /// From the core to a place, where it is led [m].
  double distance_at_goal(const Vector& x) const noexcept {
    return body_.from_core(goal_.local(x, begin_)).distance;
  }
  void begin_path() noexcept { start_ = now_; }
  void set_target(double t) noexcept {
    const Node &from = start_.node, &to = goal_.node;
    if (t >= 1) now_ = goal_;
    else now_ = Place(gone<double>(from, t * (to.r - from.r), t * rotation_between(from, to)));
  }
  /// As RodBody: product with the step before, and the squares of both.
  std::array<double, 3> take_step() noexcept {
    const Node &from = last_.node, &to = goal_.node;
    Step step;
    step << to.r - from.r, body_.size() * (to.tangent - from.tangent),
        body_.size() * (to.director - from.director);
    const std::array<double, 3> products{step.dot(step_), step.squaredNorm(), step_.squaredNorm()};
    last_ = goal_, step_ = step;
    return products;
  }

  bool moves = true;  // since the last equilibrium

 private:
  using Node = RodNode<double>;
  /// Where the axis begins, and the axes of the frame in which it was built.
  struct Place {
    explicit Place(const Node& at) noexcept : node(at) {
      axes << at.tangent, at.director, cross3(at.tangent, at.director);
    }
    template <class Places>
    Places local(const Places& x, const Vector& begin) const noexcept {
      Places to;
      for (int k = 0; k < x.cols(); ++k) {
        const Vector off = x.col(k) - node.r;
        for (int c = 0; c < 3; ++c) to(c, k) = axes.col(c).dot(off) + begin[c];
      }
      return to;
    }
    Node node;
    Matrix axes;
  };

  RigidBody body_;
  Vector begin_;
  Place home_, start_ = home_, now_ = home_, saved_ = home_, goal_ = home_, last_ = home_;
  Step step_;
};

}  // namespace hapbeam::detail
