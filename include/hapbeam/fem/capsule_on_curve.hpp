// A frictionless capsule on a curve in space, seen from a node beside which the two touch: their distance and its derivatives.
//
// Beside the node r, of tangent τ and direction u = τ/|τ|, the curve is the parabola x(σ) = r + σu + σ²k/2 that turns with the
// node by the smallest rotation.  With w the way from there to the axis of the capsule, n = w/D, f = x - r and θ = u × dτ/|τ|,
//
//   D   = min |w| over σ and over the place λ on the axis a
//   dD  = -n · p                        p = dr + θ × f
//   d²D = (|p|² - w·(θ×(θ×f)) - v·H⁻¹v - (n·p)²)/D + 2 (u·dτ)(n·(θ×f))/|τ|
//   v   = (p·t - w·(θ×t), -p·a),   H = [t·t - w·k, -t·a; -t·a, a·a],   t = u + σk
//
// where σ and λ drop out of v and H as far as they do not move: σ at an end of the curve that the capsule has passed, λ at an end
// of the axis.  So a sphere is a capsule without a length, and across a plane a capsule is what a circle is in it.
// A force that keeps D acts along n through the point of contact.  Only the parabola is approximate, and that smallest rotations
// around a loop add up to a spin, which is left out: the force is wrong by the third order in the distance from node to contact.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/element/element.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/shaft.hpp>

namespace hapbeam::detail {

template <typename Scalar>
class CapsuleOnCurve {
  using Vector3 = VectorOf<Scalar, 3>;
  using Node = RodNode<Scalar>;

 public:
  /// Of curvature times distance: a sharper curve is taken for one that is as sharp as that.  At 1 the capsule touches it in two points.
  static constexpr Scalar sharpest = Scalar(0.5);

  CapsuleOnCurve() = default;
  /// @param node  as it is   @param curvature  there, across its tangent [1/m]
  /// @param end  -1 or +1 where the curve begins or ends at the node, 0 within
  CapsuleOnCurve(const Shaft<Scalar>& axis, const Node& node, const Vector3& curvature, int end) noexcept
      : axis_(axis), node_(node.r), direction_(unit(node.tangent)), curvature_(curvature), end_(end) {}

  /// Whether the curve is too sharp for all this.  @param distance  from it [m]
  bool sharp(Scalar distance) const noexcept {
    const Vector3 way = axis_.at(axis_.nearest(node_)) - node_;
    return curvature_.dot(way) * distance > sharpest * std::sqrt(way.squaredNorm());
  }

  /// What there is to say of the capsule while the node is here.
  struct View {
    Vector3 normal;   ///< n, out of the curve to the axis
    Scalar distance;  ///< D [m]
    Scalar lever;     ///< σ [m] from the node to the contact
    bool past_end;    ///< the end point is touched
    Vector3 arm;      ///< -∂D/∂τ [m]
    Vector3 u, t, k, w, f;
    Scalar length;         // |τ|
    bool follows, slides;  // σ moves, λ moves
  };

  View at(const Node& node) const noexcept {
    using std::sqrt;
    View v;
    v.length = sqrt(node.tangent.squaredNorm());
    v.u = node.tangent / v.length;
    v.k = carry(curvature_, direction_, v.u);
    const Scalar squared = axis_.way.squaredNorm();
    Scalar place = axis_.nearest(node.r), along = 0;
    for (int step = 0; step < 12; ++step) {
      look(node, along, place, v);
      const Scalar bend = v.w.dot(v.k), stiff = v.t.squaredNorm();
      if (bend > sharpest * stiff) v.k *= sharpest * stiff / bend;
      const Scalar g = -v.w.dot(v.t), h = v.w.dot(axis_.way), a = v.t.squaredNorm() - v.w.dot(v.k),
                   b = -v.t.dot(axis_.way);
      v.follows = !(end_ * along >= 0 && end_ != 0 && end_ * g <= 0);
      v.slides = squared > 0 && !(place <= 0 && h >= 0) && !(place >= 1 && h <= 0);
      const Scalar det = a * squared - b * b;
      Scalar along_by = v.follows ? -g / a : Scalar(0), place_by = v.slides ? -h / squared : Scalar(0);
      if (v.follows && v.slides && det > parallel * a * squared)
        along_by = (b * h - squared * g) / det, place_by = (b * g - a * h) / det;
      else if (v.follows && v.slides) v.follows = false, along_by = -along;
      const Scalar before = along, was = place;
      along += along_by;
      if (end_ != 0 && end_ * along > 0) along = 0;
      place = std::clamp(place + place_by, Scalar(0), Scalar(1));
      const Scalar moved = std::abs(along - before) + std::abs(place - was) * sqrt(squared);
      if (moved <= Scalar(1e-3) * std::sqrt(std::numeric_limits<Scalar>::epsilon()) * sqrt(v.w.squaredNorm()))
        break;
    }
    look(node, along, place, v);
    // Where curve and axis are parallel beside an end of the axis, that end is touched.
    v.slides = v.slides && place > 0 && place < 1;
    v.lever = along;
    v.distance = sqrt(v.w.squaredNorm());
    v.normal = v.distance > 0 ? Vector3(v.w / v.distance) : Vector3::Zero();
    v.past_end = end_ != 0 && along == 0 && end_ * v.w.dot(v.u) > 0;
    v.arm = (v.normal * v.f.dot(v.u) - v.f * v.normal.dot(v.u)) / v.length;
    return v;
  }

  /// d²D, by dr and dτ.
  Matrix6<Scalar> bend(const View& v) const noexcept {
    using Rows = Eigen::Matrix<Scalar, 3, 6>;
    using Row = Eigen::Matrix<Scalar, 1, 6>;
    const Scalar i = 1 / v.length;
    Rows P, T;
    P.setZero(), T.setZero();
    for (int c = 0; c < 3; ++c) {
      P(c, c) = 1, P(c, 3 + c) = i * v.u.dot(v.f);
      for (int r = 0; r < 3; ++r) P(r, 3 + c) -= i * v.u[r] * v.f[c];
      Vector3 e = Vector3::Zero();
      e[c] = i;
      T.col(3 + c) = cross3<Scalar>(v.u, e);
    }
    const Row wT = v.w.transpose() * T, fT = v.f.transpose() * T, np = v.normal.transpose() * P;
    Matrix6<Scalar> B = P.transpose() * P - np.transpose() * np;
    B -= (wT.transpose() * fT + fT.transpose() * wT) / 2;
    B += v.w.dot(v.f) * (T.transpose() * T);
    const Row s = v.t.transpose() * P - cross3(v.t, v.w).transpose() * T, l = -(axis_.way.transpose() * P);
    const Scalar a = v.t.squaredNorm() - v.w.dot(v.k), b = -v.t.dot(axis_.way), c = axis_.way.squaredNorm();
    if (v.follows && v.slides) {
      const Scalar det = a * c - b * b;
      B -= (c * (s.transpose() * s) - b * (s.transpose() * l + l.transpose() * s) + a * (l.transpose() * l)) /
           det;
    } else if (v.follows) {
      B -= s.transpose() * s / a;
    } else if (v.slides) {
      B -= l.transpose() * l / c;
    }
    B /= v.distance;
    const Matrix3 turn = i * (v.u * v.arm.transpose());
    B.template block<3, 3>(3, 3) += turn + turn.transpose();
    return B;
  }

 private:
  using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
  /// Sine squared of the angle between curve and axis below which they count as parallel: the node itself is then touched.
  static constexpr Scalar parallel = Scalar(1e-3);

  void look(const Node& node, Scalar along, Scalar place, View& v) const noexcept {
    v.t = v.u + along * v.k;
    v.f = along * (v.u + along / 2 * v.k);
    v.w = axis_.at(place) - node.r - v.f;
  }

  Shaft<Scalar> axis_{Vector3::Zero(), Vector3::Zero()};
  Vector3 node_ = Vector3::Zero(), direction_ = Vector3::UnitX(), curvature_ = Vector3::Zero();
  int end_ = 0;
};

}  // namespace hapbeam::detail
