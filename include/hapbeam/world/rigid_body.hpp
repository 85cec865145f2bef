// SPDX-License-Identifier: MIT
// Bodies of a World that do not yield: a plane, a sphere, a capsule, a thin tube about lines and arcs, which rods touch from inside and from outside, and
// any other whose signed distance is known.
//
//   World<RoundRod> world({{needle, 16}}, {RigidBody::plane({0, 0, 0}, {0, 0, 1}, 0.3)});
//
// Each tells how far a point is from its core, and which way that is.  The core is what its surface is its depth from: a plane, a point or an axis, the wall
// of a tube.
// Checks throw std::invalid_argument; all else is noexcept.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <hapbeam/friction.hpp>
#include <hapbeam/world/arc_spline.hpp>

namespace hapbeam {

/// Of a point from a surface.
struct SurfaceDistance {
  double distance;             ///< negative within [m]
  VectorOf<double, 3> normal;  ///< its gradient, away from what is nearest; unit
};

class RigidBody {
 public:
  using Vector = VectorOf<double, 3>;
  enum class Kind {
    half_space,  ///< all that is below a plane
    round,       ///< all that is within a radius of an axis
    tube,        ///< the wall of a tube, which has no thickness and is open at both ends
    field,       ///< all that is where a signed distance is negative
  };

  /// @param point  [m] on it   @param normal  out of it   @param friction  of body and rod the larger coefficients count
  static RigidBody plane(const Vector& point, const Vector& normal, const Friction& friction = {}) {
    if (!(normal.norm() > 0)) detail::reject("plane normal", normal.norm(), "", "more than 0");
    RigidBody body(Kind::half_space, ArcSpline(point, normal), 0, friction);
    body.size_ = 1;
    return body;
  }
  /// @param centre, radius  [m]; the radius may be 0
  static RigidBody sphere(const Vector& centre, double radius, const Friction& friction = {}) {
    return RigidBody(Kind::round, ArcSpline(centre), radius, friction);
  }
  /// @param from, to  [m] ends of its axis
  static RigidBody capsule(const Vector& from, const Vector& to, double radius,
                           const Friction& friction = {}) {
    return RigidBody(Kind::round, ArcSpline::line(from, to), radius, friction);
  }
  /// @param radius  [m] of its wall, more than 0
  static RigidBody tube(const Vector& from, const Vector& to, double radius, const Friction& friction = {}) {
    return tube(ArcSpline::line(from, to), radius, friction);
  }
  /// @param axis  its radius of curvature is larger than the radius
  static RigidBody tube(const ArcSpline& axis, double radius, const Friction& friction = {}) {
    if (!(axis.length() > 0)) detail::reject("tube length", axis.length(), "m", "more than 0");
    return RigidBody(Kind::tube, axis, detail::positive("body radius", radius, "m"), friction);
  }
  /// @param distance  noexcept, allocation-free where it is called in ticks; of no two points does it differ by more than they are apart
  /// @param depth  [m] half of where the body is thinnest: nothing that thick is passed   @param size  [m] no point of it is farther from the origin
  static RigidBody field(std::function<SurfaceDistance(const Vector&)> distance, double depth, double size,
                         const Friction& friction = {}) {
    RigidBody body(Kind::field, ArcSpline(Vector::Zero()), detail::not_negative("body depth", depth, "m"),
                   friction);
    if (!distance) detail::reject("body distance", 0, "", "a function");
    body.distance_ = std::move(distance), body.size_ = detail::positive("body size", size, "m");
    return body;
  }

  Kind kind() const noexcept { return kind_; }
  const Friction& friction() const noexcept { return friction_; }
  /// Of a round body or a tube [m].
  double radius() const noexcept { return radius_; }
  /// A sphere's is its centre, a plane's a point of it.
  const ArcSpline& axis() const noexcept { return axis_; }
  /// From the surface to the core [m].
  double depth() const noexcept { return kind_ == Kind::tube ? 0 : radius_; }
  /// No point is farther from where the axis begins [m]; of a plane 1.
  double size() const noexcept { return size_; }

  /// Of a point from the core.
  SurfaceDistance from_core(const Vector& p) const noexcept {
    if (kind_ == Kind::field) {
      const SurfaceDistance found = distance_(p);
      return {found.distance + radius_, found.normal};
    }
    const auto [r, tangent, beyond] = axis_.nearest(p);
    const Vector off = p - r;
    if (kind_ == Kind::half_space) return {tangent.dot(off), tangent};
    if (kind_ == Kind::round) return directed(off, Vector::UnitZ());
    const Vector across = off - tangent.dot(off) * tangent;
    const double size = std::sqrt(across.squaredNorm()), over = size - radius_;
    const Vector out = size > 0 ? Vector(across / size) : detail::beside(tangent);
    if (beyond == 0 && over != 0) return {std::abs(over), over < 0 ? Vector(-out) : out};
    return directed(over * out + beyond * tangent, out);
  }

 private:
  RigidBody(Kind kind, const ArcSpline& axis, double radius, const Friction& friction)
      : kind_(kind),
        axis_(axis),
        radius_(detail::not_negative("body radius", radius, "m")),
        size_(axis.length() + radius),
        friction_(friction) {
    friction_.check();
  }
  static SurfaceDistance directed(const Vector& off, const Vector& otherwise) noexcept {
    const double size = std::sqrt(off.squaredNorm());
    return {size, size > 0 ? Vector(off / size) : otherwise};
  }

  Kind kind_;
  ArcSpline axis_;
  double radius_, size_;
  Friction friction_;
  std::function<SurfaceDistance(const Vector&)> distance_;
};

}  // namespace hapbeam
