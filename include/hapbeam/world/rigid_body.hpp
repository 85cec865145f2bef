// SPDX-License-Identifier: MIT
// Bodies of a World that do not yield: a plane, a sphere, a capsule and a thin tube, which rods touch from inside and from outside.
//
//   World<RoundRod> world({{needle, 16}}, {RigidBody::plane({0, 0, 0}, {0, 0, 1})});
//
// Checks throw std::invalid_argument; all else is noexcept.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/check.hpp>
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

  /// @param point  [m] on it   @param normal  out of it
  static RigidBody plane(const Vector& point, const Vector& normal) {
    return RigidBody(Kind::half_space, point, normal, 0);
  }
  /// @param centre, radius  [m]; the radius may be 0
  static RigidBody sphere(const Vector& centre, double radius) {
    return RigidBody(Kind::round, centre, Vector::Zero(), radius);
  }
  /// @param from, to  [m] ends of its axis
  static RigidBody capsule(const Vector& from, const Vector& to, double radius) {
    return RigidBody(Kind::round, from, to - from, radius);
  }
  /// @param radius  [m] of its wall, more than 0
  static RigidBody tube(const Vector& from, const Vector& to, double radius) {
    return RigidBody(Kind::tube, from, to - from, radius);
  }

  Kind kind() const noexcept { return kind_; }
  double radius() const noexcept { return radius_; }
  /// The end of its axis, or a point of the plane [m], and from there to its other end [m], or a normal.
  const Vector& tip() const noexcept { return tip_; }
  const Vector& way() const noexcept { return way_; }
  /// @throws std::invalid_argument naming what makes no sense
  void check() const {
    detail::finite("body place", tip_.squaredNorm() + way_.squaredNorm(), "m");
    const bool tube = kind_ == Kind::tube;
    if (!(std::isfinite(radius_) && radius_ >= 0 && (radius_ > 0 || !tube)))
      detail::reject("body radius", radius_, "m", tube ? "more than 0" : "0 or more");
    if (kind_ != Kind::round && !(way_.norm() > 0))
      detail::reject(tube ? "tube length" : "plane normal", way_.norm(), tube ? "m" : "", "more than 0");
  }

 private:
  RigidBody(Kind kind, const Vector& tip, const Vector& way, double radius)
      : kind_(kind), tip_(tip), way_(way), radius_(radius) {}

  Kind kind_;
  Vector tip_, way_;
  double radius_;
};

namespace detail {

/// A body as it lies, and its path in a tick: its tip goes straight, its axis turns.
class PlacedBody {
 public:
  using Vector = VectorOf<double, 3>;
  using Step = VectorOf<double, 6>;  // of both ends of its axis [m]

  /// @throws std::invalid_argument as RigidBody::check()
  explicit PlacedBody(const RigidBody& body) : body_(body) {
    body.check();
    extent_ = std::sqrt(body.way().squaredNorm());
    home_ = {body.tip(), extent_ > 0 ? Vector(body.way() / extent_) : Vector::Zero()};
    reset();
  }

  RigidBody::Kind kind() const noexcept { return body_.kind(); }
  double radius() const noexcept { return body_.radius(); }
  /// Of its axis, on which places are [m].
  double length() const noexcept { return kind() == RigidBody::Kind::half_space ? 0 : extent_; }
  Vector at(double s) const noexcept { return now_.tip + s * now_.axis; }
  /// Unit: of its axis, or out of the plane; 0 of a sphere.
  const Vector& axis() const noexcept { return now_.axis; }
  Shaft<double> shaft() const noexcept { return {now_.tip, length() * now_.axis}; }
  Shaft<double> saved_shaft() const noexcept { return {saved_.tip, length() * saved_.axis}; }
  /// How far a point of it has moved since save(), at most, squared [m²].
  double travel_squared() const noexcept {
    const Vector tip = now_.tip - saved_.tip, end = tip + length() * (now_.axis - saved_.axis);
    return (std::max)(tip.squaredNorm(), end.squaredNorm());
  }

  /// What it decides of a pair: the direction of a plane's force, and the axis of a tube.
  void lead(RodPair& pair) const noexcept {
    if (kind() == RigidBody::Kind::half_space) pair.normal = now_.axis;
    if (kind() == RigidBody::Kind::tube) pair.axis = now_.axis;
  }

  void reset() noexcept { goal_ = last_ = home_, step_.setZero(), restart(); }
  void restart() noexcept { now_ = start_ = saved_ = home_, moves = true; }
  void save() noexcept { saved_ = now_; }
  void restore() noexcept { now_ = saved_; }
  /// @param pose  of the frame in which it was built   @return whether it is one
  bool place(RodPose pose) noexcept {
    if (!pose.make_valid()) return false;
    const auto turned = [&](const Vector& x) -> Vector {
      return x[0] * pose.along + x[1] * pose.director + x[2] * cross3(pose.along, pose.director);
    };
    const Place goal{pose.at + turned(home_.tip), turned(home_.axis)};
    moves = moves || goal.tip != goal_.tip || goal.axis != goal_.axis;
    goal_ = goal;
    return true;
  }
  void begin_path() noexcept { start_ = now_; }
  void set_target(double t) noexcept {
    now_.tip = start_.tip + t * (goal_.tip - start_.tip);
    now_.axis = turned(t);
  }
  /// As RodBody: product with the step before, and the squares of both.
  std::array<double, 3> take_step() noexcept {
    Step step;
    step << goal_.tip - last_.tip, extent_ * (goal_.axis - last_.axis);
    const std::array<double, 3> products{step.dot(step_), step.squaredNorm(), step_.squaredNorm()};
    last_ = goal_, step_ = step;
    return products;
  }

  bool moves = true;  // since the last equilibrium

 private:
  struct Place {
    Vector tip, axis;
  };
  /// Between start and goal, by way of the middle of both.
  Vector turned(double t) const noexcept {
    const Vector &a = start_.axis, &b = goal_.axis;
    if (t >= 1 || a == b) return b;
    Vector middle = a + b;
    constexpr double opposite = 1e-12;
    if (!(middle.squaredNorm() > opposite)) {
      int least = 0;
      for (int k = 1; k < 3; ++k)
        if (std::abs(a[k]) < std::abs(a[least])) least = k;
      middle = across<double>(Vector::Unit(least), a);
    }
    middle = unit(middle);
    return t < 0.5 ? unit(Vector(a + 2 * t * (middle - a)))
                   : unit(Vector(middle + (2 * t - 1) * (b - middle)));
  }

  RigidBody body_;
  double extent_;
  Place home_, start_, now_, saved_, goal_, last_;
  Step step_;
};

}  // namespace detail

}  // namespace hapbeam
