// SPDX-License-Identifier: MIT
// What dead loads do to an element of a beam in the plane.
//
// A force inside an element acts on a point of a bent piece, which the slope moves along the chord by
//
//   β = ½ (t ∫w'² ds - ∫w'² ds to the point)
//
// Without β an axial load is of second order, of third at any rotation; with it of fourth.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <hapbeam/angle.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/element/hermite.hpp>
#include <hapbeam/fem/loads.hpp>

namespace hapbeam {

namespace detail {

/// l β of a point at t of an element: ½ (k11 a² + 2 k12 ab + k22 b²), with a and b l times the rotations against the chord.
template <typename Scalar>
struct Bow {
  Scalar k11, k12, k22;

  explicit Bow(Scalar t) noexcept {
    const Scalar s = t * t;
    k11 = t * (S(2. / 15) - 1 + t * (4 + t * (S(-22. / 3) + t * (6 - S(1.8) * t))));
    k12 = s * (1 + t * (S(-11. / 3) + t * (S(4.5) - S(1.8) * t))) - t * S(1. / 30);
    k22 = t * (S(2. / 15) - s * (S(4. / 3) + t * (S(1.8) * t - 3)));
  }

 private:
  using S = Scalar;
};

}  // namespace detail

/// Subtracts λ ∂W/∂d from an element's residual and λ ∂²W/∂d² from its tangent, W the work of a load at t = (s - s1)/l in
/// it.  Moderate rotation:
///
///   W = f (u + β) + q w + (moment - q_arm) θ - f_arm θ²/2,   l β = bow - rise v
///
/// with v the cubic's height above the chord.  Without the slope's part, in a linear element, f works on u alone.
/// @tparam Slope  whether the slope feeds the element's membrane force   @return λ W [J]
template <bool Slope, typename Scalar>
Scalar subtract_moderate_load(const PointForce<Scalar>& load, Scalar t, Scalar lambda,
                              const ElementProperties<Scalar>& p, const Vector6<Scalar>& d,
                              Vector6<Scalar>& r, Matrix6<Scalar>* K) noexcept {
  using S = Scalar;
  const ShapeFunctions<S> shape(t, p.length);
  Vector6<S> force = lambda * shape.nodal_forces(load.force.x(), load.force.y(), load.moment - load.arm.y());
  Scalar work = force.dot(d);
  if constexpr (Slope) {
    const S f = lambda * load.force.x() * p.inverse_length, arm = lambda * load.arm.x();
    if (f == 0 && arm == 0) {
      r -= force;
      return work;
    }
    const detail::Bow<S> bow(t);
    const Deformation<S> e(p, d);
    // -l v = g1 a + g2 b, and θ = c1 a + c2 b - rise over l
    const S u = 1 - t, g1 = t * u * u, g2 = -t * t * u, i = p.inverse_length;
    const S c1 = u * (1 - 3 * t), c2 = t * (3 * t - 2), cr = c1 + c2 - 1;
    const S b1 = f * (bow.k11 * e.a + bow.k12 * e.b + e.rise * g1),
            b2 = f * (bow.k12 * e.a + bow.k22 * e.b + e.rise * g2), br = f * (g1 * e.a + g2 * e.b);
    const S theta = (c1 * e.a + c2 * e.b - e.rise) * i, m = -arm * theta * i;
    Vector6<S> by_slope;
    detail::expand(p, S(0), b1 + b2 + br + m * cr, b1 + m * c1, b2 + m * c2, by_slope);
    force += by_slope;
    work += (b1 * e.a + b2 * e.b + br * e.rise - arm * theta * theta) / 2;
    if (K) {
      const S k = -arm * i * i, k11 = f * bow.k11 + k * c1 * c1, k12 = f * bow.k12 + k * c1 * c2,
              k22 = f * bow.k22 + k * c2 * c2, r1 = f * (bow.k11 + bow.k12 + g1) + k * c1 * cr,
              r2 = f * (bow.k12 + bow.k22 + g2) + k * c2 * cr,
              rr = f * (bow.k11 + 2 * bow.k12 + bow.k22 + 2 * (g1 + g2)) + k * cr * cr;
      Matrix6<S> H;
      detail::expand(p, {S(0), S(0), S(0), S(0), rr, r1, r2, k11, k12, k22}, H);
      *K -= H;
    }
  }
  r -= force;
  return work;
}

/// The same at any rotation, and λ ∂²W/∂d² from the tangent K, where it is wanted:
///
///   W = f·(t Δ + v z + β e) + φ(θ),   φ = moment θ + axial_arm (cos θ - 1) - transverse_arm sin θ
///
/// with Δ, α, e, z the element's chord, its angle, direction and normal, v = -l (g1 θ1' + g2 θ2') the cubic's height above it,
/// θi' = θi + α, and θ = c1 θ1' + c2 θ2' - α the cubic's angle.
template <typename Scalar>
Scalar subtract_load(const PointForce<Scalar>& load, Scalar t, Scalar lambda,
                     const ElementProperties<Scalar>& p, const Vector6<Scalar>& d, Vector6<Scalar>& r,
                     Matrix6<Scalar>* K) noexcept {
  using S = Scalar;
  const S f = lambda * load.force.x(), q = lambda * load.force.y(), moment = lambda * load.moment,
          f_arm = lambda * load.arm.x(), q_arm = lambda * load.arm.y();
  const auto couple = [&](S theta) {
    return moment - f_arm * std::sin(theta) - q_arm * std::cos(theta);
  };  // φ'
  const auto turns = [&](S theta) {
    return moment * theta + f_arm * (std::cos(theta) - 1) - q_arm * std::sin(theta);
  };                                                                                                  // φ
  const auto stiffness = [&](S theta) { return q_arm * std::sin(theta) - f_arm * std::cos(theta); };  // φ''
  if (t == 0 || t == 1) {
    const int node = t == 0 ? 0 : 3;
    r[node] -= f;
    r[node + 1] -= q;
    r[node + 2] -= couple(d[node + 2]);
    if (K) (*K)(node + 2, node + 2) -= stiffness(d[node + 2]);
    return f * d[node] + q * d[node + 1] + turns(d[node + 2]);
  }
  const S l = p.length, x = l + d[3] - d[0], y = d[4] - d[1], chord = std::sqrt(x * x + y * y), i = 1 / chord,
          c = x * i, s = y * i, alpha = detail::angle_near(y, x, chord, -(d[2] + d[5]) / 2);
  const S u = 1 - t, g1 = t * u * u, g2 = -t * t * u, c1 = u * (1 - 3 * t), c2 = t * (3 * t - 2),
          ca = -6 * t * u;
  const S v = -l * (g1 * (d[2] + alpha) + g2 * (d[5] + alpha)), theta = c1 * d[2] + c2 * d[5] + ca * alpha;
  const S along = f * c + q * s, across = q * c - f * s, m = couple(theta), k = stiffness(theta), g = g1 + g2;
  const detail::Bow<S> bow(t);
  const S bow1 = bow.k11 * (d[2] + alpha) + bow.k12 * (d[5] + alpha),
          bow2 = bow.k12 * (d[2] + alpha) + bow.k22 * (d[5] + alpha);
  const S beta = l * (bow1 * (d[2] + alpha) + bow2 * (d[5] + alpha)) / 2;
  // By α, at fixed Δ, and by lθ1, lθ2, as the element's core has them.
  const S a = ca * m - l * g * across - v * along + across * beta + along * l * (bow1 + bow2),
          b1 = c1 * m * p.inverse_length - g1 * across + along * bow1,
          b2 = c2 * m * p.inverse_length - g2 * across + along * bow2;
  Vector6<S> force;
  detail::expand(p, t * f - a * i * s, t * q + a * i * c, b1, b2, force);
  r -= force;
  r[0] -= f;
  r[1] -= q;
  const S work = f * (d[0] + t * (x - l) - v * s) + q * (d[1] + t * y + v * c) + along * beta + turns(theta);
  if (!K) return work;
  const S k1 = bow.k11 + bow.k12, k2 = bow.k12 + bow.k22, ii = p.inverse_length, kk = k * ii * ii;
  const S aa = (ca * ca * k + 2 * l * g * along - v * across - along * beta + 2 * across * l * (bow1 + bow2) +
                along * l * (k1 + k2)) *
               i * i,
          turned = a * i * i, a1 = (ca * c1 * k * ii + g1 * along + across * bow1 + along * k1) * i,
          a2 = (ca * c2 * k * ii + g2 * along + across * bow2 + along * k2) * i;
  Matrix6<S> H;
  detail::expand(p,
                 {aa * s * s + 2 * turned * c * s, -aa * c * s - turned * (c * c - s * s), -a1 * s, -a2 * s,
                  aa * c * c - 2 * turned * c * s, a1 * c, a2 * c, c1 * c1 * kk + along * bow.k11 * ii,
                  c1 * c2 * kk + along * bow.k12 * ii, c2 * c2 * kk + along * bow.k22 * ii},
                 H);
  *K -= H;
  return work;
}

/// Subtracts λ times the loads from begin to end, the end itself where it is the last, as the functions above do.
/// @return λ W [J]     O(log loads)
template <class Element, typename Scalar>
Scalar subtract_loads(const DeadLoads<Scalar>& loads, Scalar begin, Scalar end, bool last, Scalar lambda,
                      const ElementProperties<Scalar>& p, const Vector6<Scalar>& d, Vector6<Scalar>& r,
                      Matrix6<Scalar>* K) noexcept {
  Scalar work = 0;
  loads.visit(begin, end, last, [&](const PointForce<Scalar>& load) {
    const Scalar t = load.s == end ? Scalar(1) : (load.s - begin) / p.length;
    if constexpr (any_rotation<Element>) work += subtract_load(load, t, lambda, p, d, r, K);
    else work += subtract_moderate_load<detail::membrane_feels_slope<Element>>(load, t, lambda, p, d, r, K);
  });
  return work;
}

}  // namespace hapbeam
