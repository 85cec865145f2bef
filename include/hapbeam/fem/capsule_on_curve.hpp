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
// where σ and λ drop out of v and H as far as they do not move: σ at an end of the curve that the capsule has passed or of the piece
// in which it is sought, λ at an end of the axis.  So a sphere is a capsule without a length, and across a plane a capsule is what a
// circle is in it.  A force that keeps D acts along n through the point of contact.  Only the parabola is approximate, and that
// smallest rotations around a loop add up to a spin, which is left out: the force is wrong by the third order in the distance from
// node to contact.
//
// With the best λ at each σ, |w|²/2 has the slope -w·t and the second derivative |t|² - w·k, less (t·a)²/|a|² where λ moves.  Along an
// axis that does not end that is at least half of what it is at the node, as far as σ is sought: there is one minimum.
// Real-time: noexcept, no allocation; each step of the projection halves the one before or the bracket.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/element/element.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/shaft.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

template <typename Scalar>
class CapsuleOnCurve {
  using Vector3 = VectorOf<Scalar, 3>;
  using Node = RodNode<Scalar>;

 public:
  /// Of curvature times distance, at which a curve is too sharp for this.  At 1 the capsule touches it in two points.
  static constexpr Scalar sharpest = Scalar(0.5);

  CapsuleOnCurve() = default;
  /// @param node  as it is   @param curvature  there, across its tangent [1/m]
  /// @param end  -1 or +1 where the curve begins or ends at the node, 0 within
  CapsuleOnCurve(const Shaft<Scalar>& axis, const Node& node, const Vector3& curvature, int end) noexcept
      : axis_(axis), node_(node.r), direction_(unit(node.tangent)), curvature_(curvature), end_(end) {
    using std::sqrt;
    View v;
    v.u = v.b = direction_, v.k = curvature_;
    const Derivatives at_node = look(node, 0, v);
    if (!(at_node.second > parallel)) return;
    const Scalar squared = axis.way.squaredNorm(), farthest = sqrt(v.w.squaredNorm()) + sqrt(squared);
    const Scalar third = v.slides ? 3 * std::abs(axis.way.dot(v.u) * axis.way.dot(v.k)) / squared : Scalar(0);
    within_ = (std::min)({farthest, 1 / sqrt(curvature.squaredNorm()), at_node.second / (2 * third)});
  }

  /// Turns the curve at the node.  @param angle  [rad] toward the capsule, small
  void tilt(Scalar angle) noexcept {
    const Vector3 way = axis_.at(axis_.nearest(node_)) - node_,
                  across = way - direction_ * direction_.dot(way);
    tilt_ = angle * unit(across);
    cosine_ = 1 / std::sqrt(1 + angle * angle);
  }
  /// Whether the curve is too sharp for all this.  @param distance  from it [m]
  bool sharp(Scalar distance) const noexcept { return sharp(axis_, node_, curvature_, distance); }
  static bool sharp(const Shaft<Scalar>& axis, const Vector3& node, const Vector3& curvature,
                    Scalar distance) noexcept {
    const Vector3 way = axis.at(axis.nearest(node)) - node;
    return curvature.dot(way) * distance > sharpest * std::sqrt(way.squaredNorm());
  }

  /// Distance of the capsule, and its derivatives, at the present node.
  struct View {
    Vector3 normal;            ///< n, out of the curve to the axis
    Scalar distance;           ///< D [m]
    Scalar lever;              ///< σ [m] from the node to the contact
    bool past_end;             ///< the end point is touched
    Vector3 arm;               ///< -∂D/∂τ [m]
    Vector3 u, b, t, k, w, f;  // b: u, tilted
    Scalar length;             // |τ|
    bool follows, slides;      // σ moves, λ moves
  };

  View at(const Node& node) const noexcept {
    using std::sqrt;
    View v;
    v.length = sqrt(node.tangent.squaredNorm());
    v.u = node.tangent / v.length;
    v.k = carry(curvature_, direction_, v.u);
    v.b = cosine_ < 1 ? Vector3(cosine_ * (v.u + carry(tilt_, direction_, v.u))) : v.u;
    const Scalar bottom = end_ < 0 ? Scalar(0) : -within_, top = end_ > 0 ? Scalar(0) : within_;
    const Scalar fine = Scalar(1e-3) * sqrt(std::numeric_limits<Scalar>::epsilon());
    Scalar along = 0, low = bottom, high = top, before = std::numeric_limits<Scalar>::infinity();
    bool seen[2] = {false, false};  // what the slope is at bottom and top
    for (int step = 0; step < most_steps; ++step) {
      const Derivatives d = look(node, along, v);
      const bool ahead = d.first < 0;
      v.follows = along != (ahead ? top : bottom);
      if (!v.follows) break;
      (ahead ? low : high) = along;
      const Scalar middle = (low + high) / 2;
      Scalar next = d.second > 0 ? std::clamp(along - d.first / d.second, low, high) : middle;
      if (next == (ahead ? top : bottom) && !seen[ahead]) seen[ahead] = true;
      else if (!(std::abs(next - along) <= before / 2)) next = middle;
      before = std::abs(next - along);
      if (before <= fine * sqrt(v.w.squaredNorm())) break;
      along = next;
    }
    v.lever = along;
    v.distance = sqrt(v.w.squaredNorm());
    v.normal = v.distance > 0 ? Vector3(v.w / v.distance) : Vector3::Zero();
    v.past_end = end_ != 0 && along == 0 && Scalar(end_) * v.w.dot(v.u) > 0;
    v.arm = (v.normal * v.f.dot(v.u) - v.f * v.normal.dot(v.u)) / v.length;
    return v;
  }

  /// d²D, by dr and dτ.
  Matrix6<Scalar> bend(const View& v) const noexcept {
    // p = dr + Q dτ, and a row of numbers for each scalar that dr and dτ make: that of n·p is (n, arm).
    const Scalar i = 1 / v.length, uf = v.u.dot(v.f), wf = v.w.dot(v.f);
    const auto turned = [&](const Vector3& x) { return Vector3(i * (uf * x - v.u.dot(x) * v.f)); };  // Qᵀx
    const Vector3 wT = i * cross3(v.w, v.u), fT = i * cross3(v.f, v.u);
    Scalar rows[3][6], scales[3] = {-1, 0, 0};
    const auto fill = [](Scalar(&row)[6], const Vector3& r, const Vector3& t) {
      for (int k = 0; k < 3; ++k) row[k] = r[k], row[3 + k] = t[k];
    };
    fill(rows[0], v.normal, v.arm);
    fill(rows[1], v.t, turned(v.t) - i * cross3<Scalar>(cross3(v.t, v.w), v.u));
    // v·H⁻¹v by the pivots of H.
    const Scalar a = v.t.squaredNorm() - v.w.dot(v.k);
    if (v.follows) scales[1] = -1 / a;
    if (v.slides) {
      const Scalar b = -v.t.dot(axis_.way), c = axis_.way.squaredNorm();
      fill(rows[2], -axis_.way, -turned(axis_.way));
      const Scalar share = v.follows ? b / a : Scalar(0);
      for (int k = 0; k < 6; ++k) rows[2][k] -= share * rows[1][k];
      scales[2] = -1 / (c - share * b);
    }
    Matrix6<Scalar> B = Matrix6<Scalar>::Zero();
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k) {
      HAPBEAM_UNROLL
      for (int row = 0; row < 3; ++row) {
        const Scalar one = row == k ? Scalar(1) : Scalar(0);
        B(3 + row, k) = i * (uf * one - v.f[row] * v.u[k]);  // Qᵀ
        B(3 + row, 3 + k) = i * i *
                                ((uf * uf + wf) * one - uf * (v.f[row] * v.u[k] + v.u[row] * v.f[k]) +
                                 v.f[row] * v.f[k] - wf * v.u[row] * v.u[k]) -
                            (wT[row] * fT[k] + fT[row] * wT[k]) / 2;
      }
      B(k, k) = 1;
    }
    const Scalar by = 1 / v.distance;
    HAPBEAM_UNROLL
    for (int col = 0; col < 6; ++col) {
      HAPBEAM_UNROLL
      for (int row = col; row < 6; ++row) {
        Scalar sum = B(row, col);
        for (int k = 0; k < 2; ++k) sum += scales[k] * rows[k][row] * rows[k][col];
        if (v.slides) sum += scales[2] * rows[2][row] * rows[2][col];
        sum *= by;
        if (col >= 3) sum += i * (v.u[row - 3] * v.arm[col - 3] + v.arm[row - 3] * v.u[col - 3]);
        B(row, col) = B(col, row) = sum;
      }
    }
    return B;
  }

 private:
  /// Of the second derivative at the node: below that curve and axis count as parallel, and the node itself is touched.
  static constexpr Scalar parallel = Scalar(1e-3);
  /// As many as halve any bracket to its last place.
  static constexpr int most_steps = 2 * std::numeric_limits<Scalar>::digits;

  /// Of |w|²/2 by σ.
  struct Derivatives {
    Scalar first, second;
  };
  Derivatives look(const Node& node, Scalar along, View& v) const noexcept {
    v.t = v.b + along * v.k;
    v.f = along * (v.b + along / 2 * v.k);
    const Vector3 from_tip = node.r + v.f - axis_.tip;
    const Scalar squared = axis_.way.squaredNorm();
    const Scalar place = squared > 0 ? axis_.way.dot(from_tip) / squared : Scalar(0);
    v.slides = place > 0 && place < 1;
    v.w = std::clamp(place, Scalar(0), Scalar(1)) * axis_.way - from_tip;
    const Scalar leaning = v.slides ? v.t.dot(axis_.way) : Scalar(0);
    return {-v.w.dot(v.t),
            v.t.squaredNorm() - v.w.dot(v.k) - (v.slides ? leaning * leaning / squared : Scalar(0))};
  }

  Shaft<Scalar> axis_{Vector3::Zero(), Vector3::Zero()};
  Vector3 node_ = Vector3::Zero(), direction_ = Vector3::UnitX(), curvature_ = Vector3::Zero(),
          tilt_ = Vector3::Zero();  // across the direction
  Scalar cosine_ = 1;               // of the tilt
  Scalar within_ = 0;               // [m] of the node: there σ is sought
  int end_ = 0;
};

}  // namespace hapbeam::detail
