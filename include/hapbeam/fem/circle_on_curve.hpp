// A frictionless circle on a curve, seen from a node beside which the two touch: their distance and its derivatives.
//
// Beside the node the curve is its circle of curvature.  With t its direction there, n the normal on the side of the circle's
// centre, κ the curvature toward it, e the way from the node to the centre, δ = t·e and η = n·e,
//
//   D  = (2η - κ(η² + δ²))/(1 + S)       distance of the centre from the curve;  S = √((1 - κη)² + κ²δ²)
//   n* = ((1 - κη) n - κδ t)/S           normal where they touch
//   dD = -q + lever θ                    q: along n*,  p: along the curve, n* turned clockwise;  lever: p·e
//   d²D = -b p² - 2(1 + b h) pθ - h(1 + b h) θ²          b = κ/S,  h = n*·e
//
// A force that keeps D acts along n* through the point of contact.  Past an end of the curve its last point is touched: κ = -∞.
// Only the circle of curvature is approximate: the force is wrong by the third order in the distance from node to contact.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <hapbeam/angle.hpp>
#include <hapbeam/centreline.hpp>

namespace hapbeam::detail {

template <typename Scalar>
class CircleOnCurve {
 public:
  /// Of curvature times distance: a sharper curve is taken for one that is as sharp as that.  At 1 the circle touches it in two points.
  static constexpr Scalar sharpest = Scalar(0.5);

  CircleOnCurve() = default;
  /// @param centre  [m]   @param side  of the curve, +1 or -1   @param curvature  at the node, to the left [1/m]
  /// @param end  -1 or +1 where the curve begins or ends at the node, 0 within
  CircleOnCurve(const Vector2<Scalar>& centre, Scalar side, Scalar curvature, int end) noexcept
      : centre_(centre), side_(side), curvature_(side * curvature), end_(static_cast<Scalar>(end)) {}

  /// Turns the curve at the node.  @param angle  [rad] toward the circle
  void tilt(Scalar angle) noexcept { tilt_ = side_ * angle; }
  /// Whether the curve is too sharp for all this.  @param distance  from it [m]
  bool sharp(Scalar distance) const noexcept { return curvature_ * distance > sharpest; }

  /// Distance of the circle, and its derivatives, at the present node.
  struct View {
    Vector2<Scalar> normal;  ///< n*
    Scalar distance;         ///< D [m]; negative where the centre is on the other side
    Scalar lever;            ///< [m] from the node to the contact, along p
    Scalar height;           ///< h [m]
    Scalar bend;             ///< b [1/m]
    bool past_end;           ///< the end point is touched
  };
  View at(const CentrelineNode<Scalar>& node) const noexcept {
    using std::sqrt;
    // Places have fewer digits than displacements: the difference of two places comes first.
    const Vector2<Scalar> e((centre_.x() - node.s) - node.u, centre_.y() - node.w);
    const Vector2<Scalar> t = direction(tilt_ - node.theta), n(-side_ * t.y(), side_ * t.x());
    const Scalar along = t.dot(e), above = n.dot(e), squared = e.squaredNorm();
    if (end_ * along > 0 && above > 0) {
      const Scalar distance = sqrt(squared);
      return {e / distance, distance, 0, distance, -1 / distance, true};
    }
    const Scalar k = curvature_ * above > sharpest ? sharpest / above : curvature_, a = 1 - k * above,
                 b = k * along, s = sqrt(a * a + b * b), i = 1 / s;
    const Vector2<Scalar> normal = (a * n - b * t) * i;
    return {normal,
            (2 * above - k * squared) / (1 + s),
            normal.y() * e.x() - normal.x() * e.y(),
            normal.dot(e),
            k * i,
            false};
  }

 private:
  Vector2<Scalar> centre_{0, 0};
  Scalar side_ = 1, curvature_ = 0, end_ = 0, tilt_ = 0;
};

}  // namespace hapbeam::detail
