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
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <hapbeam/check.hpp>
#include <hapbeam/friction.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

/// A curve of straight lines and circular arcs, each of which begins along the end of the one before: the axis of a bar or of a vessel.
class ArcSpline {
 public:
  using Vector = VectorOf<double, 3>;
  struct Point {
    Vector r, tangent;  ///< [m], unit
    double beyond =
        0;  ///< how far what it is nearest to lies before the start, negative, or behind the end [m]
  };

  /// @param from  [m]   @param along  how it begins; one without pieces is a point
  explicit ArcSpline(const Vector& from, const Vector& along = Vector::UnitX())
      : from_(from), along_(detail::unit(along)) {
    detail::finite("axis place", from_.squaredNorm() + along_.squaredNorm(), "m");
  }
  static ArcSpline line(const Vector& from, const Vector& to) {
    const double length = std::sqrt((to - from).squaredNorm());
    return length == 0 ? ArcSpline(from) : ArcSpline(from, to - from).arc(length);
  }
  /// Goes on.   @param length  [m]   @param curvature  toward the centre, up to one turn; what of it is along the curve does not count [1/m]
  ArcSpline& arc(double length, const Vector& curvature = Vector::Zero()) {
    constexpr double straight = 1e-6;
    detail::positive("axis length", length, "m");
    const Point start = at(this->length());
    const Vector bend = curvature - start.tangent.dot(curvature) * start.tangent;
    const double size = std::sqrt(bend.squaredNorm()), half = length / 2, pi = std::acos(-1.0);
    if (!(size * half <= pi)) detail::reject("axis curvature", size, "1/m", "no more than one turn");
    Piece piece{start.r, start.tangent, Vector::Zero(), this->length() + half, half, 0, 1};
    if (size * length > straight)
      piece.inward = bend / size, piece.curvature = size, piece.end_cosine = std::cos(size * half);
    // Where it begins is known, and the rest is as seen from its middle.
    const Point middle = piece.at(half);
    const Vector about = detail::cross3(piece.tangent, piece.inward);
    piece.inward = detail::cross3(about, middle.tangent), piece.r = middle.r, piece.tangent = middle.tangent;
    pieces_.push_back(piece);
    return *this;
  }

  double length() const noexcept { return pieces_.empty() ? 0 : pieces_.back().s + pieces_.back().half; }
  Point at(double s) const noexcept {
    for (const Piece& piece : pieces_)
      if (s <= piece.s + piece.half || &piece == &pieces_.back()) return piece.at(s - piece.s);
    return {from_, along_};
  }
  Point nearest(const Vector& p) const noexcept {
    Point best{from_, along_};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Point point = pieces_[k].nearest(p);
      const double square = (p - point.r).squaredNorm();
      if (!(square < least)) continue;
      least = square, best = point;
      // Pieces that follow each other end in one plane.
      if (point.beyond < 0 ? k > 0 : k + 1 < pieces_.size()) best.beyond = 0;
    }
    return best;
  }

 private:
  /// As seen from its middle.
  struct Piece {
    Vector r, tangent, inward;
    double s, half, curvature, end_cosine;

    Point at(double x) const noexcept {
      if (curvature == 0) return {r + x * tangent, tangent};
      const double c = std::cos(curvature * x), d = std::sin(curvature * x);
      return round(c, d);
    }
    Point nearest(const Vector& p) const noexcept {
      if (curvature == 0) {
        const double x = tangent.dot(p - r), inside = std::clamp(x, -half, half);
        return {r + inside * tangent, tangent, x - inside};
      }
      const Vector off = p - r - inward / curvature;
      const double x = -off.dot(inward), y = off.dot(tangent), size = std::sqrt(x * x + y * y);
      if (!(size > 0)) return {r, tangent};
      if (x >= end_cosine * size) return round(x / size, y / size);
      Point end = round(end_cosine, std::copysign(std::sqrt(1 - end_cosine * end_cosine), y));
      end.beyond = (p - end.r).dot(end.tangent);
      return end;
    }
    Point round(double cosine, double sine) const noexcept {
      return {r + (sine * tangent + (1 - cosine) * inward) / curvature, cosine * tangent + sine * inward};
    }
  };

  Vector from_, along_;
  std::vector<Piece> pieces_;
};

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
