// SPDX-License-Identifier: MIT
// Bodies of a World that do not yield: a plane, a sphere, a capsule and a thin tube, which rods touch from inside and from outside.
//
//   World<RoundRod> world({{needle, 16}}, {RigidBody::plane({0, 0, 0}, {0, 0, 1}, 0.3)});
//
// Checks throw std::invalid_argument; all else is noexcept.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/check.hpp>
#include <hapbeam/fem/rod/end_path.hpp>
#include <hapbeam/support.hpp>
#include <hapbeam/world/pair.hpp>

namespace hapbeam {

class RigidBody {
 public:
  using Vector = VectorOf<double, 3>;
  enum class Kind {
    half_space,  ///< all that is below a plane
    round,       ///< all that is within a radius of an axis
    tube,        ///< the wall of a tube, which has no thickness and is open at both ends
  };

  /// @param point  [m] on it   @param normal  out of it   @param friction  of body and rod the larger coefficients count
  static RigidBody plane(const Vector& point, const Vector& normal, const Friction& friction = {}) {
    return RigidBody(Kind::half_space, point, normal, 0, friction);
  }
  /// @param centre, radius  [m]; the radius may be 0
  static RigidBody sphere(const Vector& centre, double radius, const Friction& friction = {}) {
    return RigidBody(Kind::round, centre, Vector::Zero(), radius, friction);
  }
  /// @param from, to  [m] ends of its axis
  static RigidBody capsule(const Vector& from, const Vector& to, double radius,
                           const Friction& friction = {}) {
    return RigidBody(Kind::round, from, to - from, radius, friction);
  }
  /// @param radius  [m] of its wall, more than 0
  static RigidBody tube(const Vector& from, const Vector& to, double radius, const Friction& friction = {}) {
    return RigidBody(Kind::tube, from, to - from, radius, friction);
  }

  Kind kind() const noexcept { return kind_; }
  double radius() const noexcept { return radius_; }
  const Friction& friction() const noexcept { return friction_; }
  /// The end of its axis, or a point of the plane [m], and from there to its other end [m], or a normal.
  const Vector& tip() const noexcept { return tip_; }
  const Vector& way() const noexcept { return way_; }
  /// @throws std::invalid_argument naming what makes no sense
  void check() const {
    friction_.check();
    detail::finite("body place", tip_.squaredNorm() + way_.squaredNorm(), "m");
    const bool tube = kind_ == Kind::tube;
    if (!(std::isfinite(radius_) && radius_ >= 0 && (radius_ > 0 || !tube)))
      detail::reject("body radius", radius_, "m", tube ? "more than 0" : "0 or more");
    if (kind_ != Kind::round && !(way_.norm() > 0))
      detail::reject(tube ? "tube length" : "plane normal", way_.norm(), tube ? "m" : "", "more than 0");
  }

 private:
  RigidBody(Kind kind, const Vector& tip, const Vector& way, double radius, const Friction& friction)
      : kind_(kind), tip_(tip), way_(way), radius_(radius), friction_(friction) {}

  Kind kind_;
  Vector tip_, way_;
  double radius_;
  Friction friction_;
};

namespace detail {

/// A body as it lies, and its path in a tick: its tip goes straight, and it turns.
class PlacedBody {
 public:
  using Vector = VectorOf<double, 3>;
  using Step = VectorOf<double, 9>;  // of its tip, and of two directions as far as it reaches [m]

  /// @throws std::invalid_argument as RigidBody::check()
  explicit PlacedBody(const RigidBody& body) : body_(body) {
    body.check();
    extent_ = std::sqrt(body.way().squaredNorm());
    if (extent_ > 0) home_axis_ = body.way() / extent_;
    home_ = placed({0, body.tip(), {1, 0, 0}, {0, 1, 0}});
    reset();
  }

  RigidBody::Kind kind() const noexcept { return body_.kind(); }
  double radius() const noexcept { return body_.radius(); }
  /// Of its axis, on which places are [m].
  double length() const noexcept { return kind() == RigidBody::Kind::half_space ? 0 : extent_; }
  Vector at(double s) const noexcept { return now_.tip() + s * now_.axis; }
  /// Unit: of its axis, or out of the plane; 0 of a sphere.
  const Vector& axis() const noexcept { return now_.axis; }
  /// How a place on it goes along that, where it does.
  Vector tangent() const noexcept { return length() > 0 ? now_.axis : Vector(Vector::Zero()); }
  Shaft<double> shaft() const noexcept { return {now_.tip(), length() * now_.axis}; }
  Shaft<double> saved_shaft() const noexcept { return {saved_.tip(), length() * saved_.axis}; }
  /// How far a point of it has moved since save(), at most, squared [m²].
  double travel_squared() const noexcept {
    const Vector tip = now_.tip() - saved_.tip(), end = tip + length() * (now_.axis - saved_.axis);
    return (std::max)(tip.squaredNorm(), end.squaredNorm());
  }

  /// A direction that has turned with it since save().
  Vector carried(const Vector& v) const noexcept {
    return axes_of(now_.frame) * (axes_of(saved_.frame).transpose() * v);
  }

  /// What it decides of a pair: the direction of a plane's force, and the axis of a tube.
  void lead(RodPair& pair) const noexcept {
    constexpr double flat = 1e9;
    if (kind() == RigidBody::Kind::half_space) pair.normal = now_.axis, pair.curve = flat;
    if (kind() == RigidBody::Kind::tube) pair.axis = now_.axis;
  }

  void reset() noexcept { goal_ = last_ = home_, step_.setZero(), restart(); }
  void restart() noexcept { now_ = start_ = saved_ = home_, moves = true; }
  void save() noexcept { saved_ = now_; }
  void restore() noexcept { now_ = saved_; }
  /// @param pose  of the frame in which it was built   @return whether it is one
  bool place(RodPose pose) noexcept {
    if (!pose.make_valid()) return false;
    Node to{0, pose.at, pose.along, pose.director};
    to.r += turned(to, home_.tip());
    const Node& last = goal_.frame;
    moves = moves || to.r != last.r || to.tangent != last.tangent || to.director != last.director;
    goal_ = placed(to);
    return true;
  }
  void begin_path() noexcept { start_ = now_; }
  void set_target(double t) noexcept {
    const Node &from = start_.frame, &to = goal_.frame;
    if (t >= 1) now_ = goal_;
    else now_ = placed(gone<double>(from, t * (to.r - from.r), t * rotation_between(from, to)));
  }
  /// As RodBody: product with the step before, and the squares of both.
  std::array<double, 3> take_step() noexcept {
    const Node &from = last_.frame, &to = goal_.frame;
    const double reaches = extent_ + radius();
    Step step;
    step << to.r - from.r, reaches * (to.tangent - from.tangent), reaches * (to.director - from.director);
    const std::array<double, 3> products{step.dot(step_), step.squaredNorm(), step_.squaredNorm()};
    last_ = goal_, step_ = step;
    return products;
  }

  bool moves = true;  // since the last equilibrium

 private:
  using Node = RodNode<double>;
  /// Its tip, and the axes of the frame in which it was built.
  struct Place {
    Node frame;
    Vector axis;
    const Vector& tip() const noexcept { return frame.r; }
  };
  /// A vector of the frame in which it was built.
  static Vector turned(const Node& frame, const Vector& x) noexcept {
    return x[0] * frame.tangent + x[1] * frame.director + x[2] * cross3(frame.tangent, frame.director);
  }
  Place placed(const Node& frame) const noexcept { return {frame, turned(frame, home_axis_)}; }

  RigidBody body_;
  double extent_;
  Vector home_axis_ = Vector::Zero();
  Place home_, start_, now_, saved_, goal_, last_;
  Step step_;
};

}  // namespace detail

}  // namespace hapbeam
