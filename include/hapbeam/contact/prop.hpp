// SPDX-License-Identifier: MIT
// What may touch a beam: round avatars, which hands move, and props, which nobody moves: a peg, a wall, a stop, a support.
//
// Two pegs are a gap.  Plain values; offline.
#pragma once

#include <cmath>

#include <hapbeam/check.hpp>
#include <hapbeam/contact/find_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam {

/// A round avatar that a hand moves.
struct RoundAvatar {
  /// @param radius_  [m]   @param touches_  at so many places at most: 2 for one that is wide beside the bends of the beam
  constexpr RoundAvatar(double radius_, int touches_ = 1, const Friction& friction_ = {}) noexcept
      : radius(radius_), touches(touches_), friction(friction_) {}
  /// @param length  of the beam [m]   @throws std::invalid_argument naming what makes no sense
  void check(double length) const {
    detail::check_radius("avatar radius", radius, length);
    if (touches < 1) detail::reject("avatar touches", touches, "places", "1 or more");
    friction.check();
  }

  double radius;  ///< [m] >= 0
  int touches;
  Friction friction;
};

/// @tparam D  of the space in which the beam bends: 2 | 3
template <int D = 2>
class Prop {
 public:
  using Vector = VectorOf<double, D>;

  /// A rigid disc, in space a sphere.  @param centre, radius  [m]
  static Prop peg(const Vector& centre, double radius) {
    Prop prop;
    prop.centre_ = centre;
    prop.radius_ = radius;
    return prop;
  }
  /// In space a rigid round bar.  @param from, to  [m] ends of its axis
  template <int Space = D, std::enable_if_t<Space == 3, int> = 0>
  static Prop bar(const Vector& from, const Vector& to, double radius) {
    Prop prop = peg(from, radius);
    prop.shaft_ = to - from;
    return prop;
  }
  /// A rigid wall: a disc, in space a sphere, of a hundred lengths of the beam.  @param point  [m] on it   @param normal  out of it
  static Prop wall(const Vector& point, const Vector& normal) {
    Prop prop = peg(point, 0);
    prop.direction_ = normal;
    return prop;
  }
  /// One place of the beam goes no farther than that.  @param s  [m]   @param d  [m] along the normal; in space of its place
  /// @param normal  out of the beam to the stop
  static Prop stop(double s, double d, const Vector& normal) {
    Prop prop;
    prop.kind_ = ObstacleKind::stop;
    prop.s_ = s, prop.d_ = d;
    prop.direction_ = normal;
    return prop;
  }
  /// One place of the beam is held along a direction, as by a roller on both sides.
  static Prop support(double s, double d, const Vector& normal) {
    Prop prop = stop(s, d, normal);
    prop.kind_ = ObstacleKind::support;
    return prop;
  }

  /// The same of a rough peg, bar or wall.
  Prop rough(const Friction& friction) const {
    Prop prop = *this;
    prop.friction_ = friction;
    return prop;
  }

  ObstacleKind kind() const noexcept { return kind_; }
  const Friction& friction() const noexcept { return friction_; }
  /// @param length  of the beam [m]   @throws std::invalid_argument naming what makes no sense
  void check(double length) const {
    for (const double x : {centre_.squaredNorm(), shaft_.squaredNorm(), direction_.squaredNorm(), d_})
      detail::finite("prop", x, "");
    detail::check_radius("prop radius", radius_, length);
    friction_.check();
    if (kind_ == ObstacleKind::round) return;
    if (!friction_.none()) detail::reject("friction", friction_.sticking, "", "0 for a stop or a support");
    if (!(s_ >= 0 && s_ <= length)) detail::reject("prop s", s_, "m", "a place on the beam");
    if (!(direction_.norm() > 0)) detail::reject("prop normal", direction_.norm(), "", "a direction");
  }
  /// @param length  of the beam [m]
  template <typename Scalar>
  Avatar<Scalar, D> avatar(double length) const {
    Avatar<Scalar, D> avatar{};
    const bool is_wall = kind_ == ObstacleKind::round && direction_.norm() > 0;
    const double radius = is_wall ? 100 * length : radius_;
    avatar.radius = static_cast<Scalar>(radius);
    avatar.position =
        (is_wall ? Vector(centre_ - radius * direction_.normalized()) : centre_).template cast<Scalar>();
    if constexpr (D == 3) avatar.shaft = shaft_.template cast<Scalar>();
    return avatar;
  }
  template <typename Scalar>
  Push<Scalar, D> place() const {
    if (kind_ == ObstacleKind::round) return {0, 0, VectorOf<Scalar, D>::Zero()};
    return {static_cast<Scalar>(s_), static_cast<Scalar>(d_),
            direction_.normalized().template cast<Scalar>()};
  }

 private:
  ObstacleKind kind_ = ObstacleKind::round;
  Vector centre_ = Vector::Zero(), shaft_ = Vector::Zero(), direction_ = Vector::Zero();
  double radius_ = 0, s_ = 0, d_ = 0;
  Friction friction_;
};

}  // namespace hapbeam
