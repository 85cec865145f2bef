// The planar rod that stretches and bends at any rotation, integrated as an initial-value problem, and paths of what is
// shot with it.  It shares no code with the library, nor a discretisation.
//
//   x' = (1 + N/EA) cos φ,   y' = (1 + N/EA) sin φ,   φ' = κ0 + M/EI,   M' = (1 + N/EA)(H sin φ - V cos φ)
//
// by arc position of the unloaded rod, with N = H cos φ + V sin φ the tension of the section's force (H, V).  Fourth-order
// Runge–Kutta: what n steps leave falls with n⁻⁴.
// Source: Reissner, On one-dimensional finite-strain beam theory, ZAMP 23 (1972), without shear.
#pragma once

#include <array>
#include <cmath>

#include <Eigen/LU>

namespace hapbeam::testing {

/// A section of the rod: where it is, its angle, and the moment there.
struct RodState {
  double x = 0, y = 0, phi = 0, moment = 0;
};

struct PlanarRod {
  double EA, EI;

  /// From one section to the one `length` further on, between which the force (H, V) acts.
  RodState along(RodState from, double length, double H, double V, double natural_curvature = 0,
                 int steps = 200) const {
    using Rates = std::array<double, 4>;
    const auto rates = [&](const RodState& at) -> Rates {
      const double c = std::cos(at.phi), s = std::sin(at.phi), stretch = 1 + (H * c + V * s) / EA;
      return {stretch * c, stretch * s, natural_curvature + at.moment / EI, stretch * (H * s - V * c)};
    };
    const auto after = [](const RodState& at, const Rates& r, double h) -> RodState {
      return {at.x + h * r[0], at.y + h * r[1], at.phi + h * r[2], at.moment + h * r[3]};
    };
    const double h = length / steps;
    for (int i = 0; i < steps; ++i) {
      const Rates a = rates(from), b = rates(after(from, a, h / 2)), c = rates(after(from, b, h / 2)),
                  d = rates(after(from, c, h));
      Rates mean;
      for (std::size_t k = 0; k < 4; ++k) mean[k] = (a[k] + 2 * b[k] + 2 * c[k] + d[k]) / 6;
      from = after(from, mean, h);
    }
    return from;
  }
};

/// The curve F(z) = 0 of N - 1 equations in N unknowns, followed by pseudo-arclength with Jacobians by differences.
template <int N>
class Curve {
 public:
  using Point = Eigen::Matrix<double, N, 1>;
  using Residual = Eigen::Matrix<double, N - 1, 1>;

  /// @param start  near the curve   @param scale  of each unknown   @param onward  about where to, in units of scale
  template <class F>
  Curve(F&& f, const Point& start, const Point& scale, const Point& onward)
      : scale_(scale), z_(start.cwiseQuotient(scale)), tangent_(onward.normalized()) {
    found_ = correct(f, z_, tangent_);
    turn(f);
  }

  bool found() const { return found_; }
  Point at() const { return z_.cwiseProduct(scale_); }
  /// d/ds along the curve, in units of scale.
  const Point& tangent() const { return tangent_; }

  template <class F>
  void step(F&& f, double size) {
    Point z = z_ + size * tangent_;
    found_ = correct(f, z, tangent_);
    z_ = z;
    turn(f);
  }

  /// Steps on until unknown k turns back, and returns the point where it does.
  template <class F>
  Point turning_point(F&& f, int k, double size, int most_steps) {
    for (int i = 0; i < most_steps && found_; ++i) {
      Curve before = *this;
      step(f, size);
      if (before.tangent_[k] * tangent_[k] > 0) continue;
      double low = 0, high = size;
      Curve middle = before;
      for (int bisection = 0; bisection < 40; ++bisection) {
        middle = before;
        const double half = (low + high) / 2;
        middle.step(f, half);
        (middle.tangent_[k] * before.tangent_[k] > 0 ? low : high) = half;
      }
      return middle.at();
    }
    found_ = false;
    return at();
  }

 private:
  template <class F>
  Eigen::Matrix<double, N, N> jacobian(F&& f, const Point& z) const {
    Eigen::Matrix<double, N, N> J;
    for (int k = 0; k < N; ++k) {
      const double h = 1e-5;  // central: 1e-10 of the third derivative, and 1e-11 of round-off
      Point up = z, down = z;
      up[k] += h, down[k] -= h;
      J.template block<N - 1, 1>(0, k) =
          (f(Point(up.cwiseProduct(scale_))) - f(Point(down.cwiseProduct(scale_)))) / (2 * h);
    }
    return J;
  }
  template <class F>
  bool correct(F&& f, Point& z, const Point& normal) const {
    for (int k = 0; k < 20; ++k) {
      auto J = jacobian(f, z);
      J.row(N - 1) = normal.transpose();
      Point right = Point::Zero();
      right.template head<N - 1>() = -f(Point(z.cwiseProduct(scale_)));
      const Point change = J.fullPivLu().solve(right);
      z += change;
      if (change.norm() <= 1e-11 * (1 + z.norm())) return true;
    }
    return false;
  }
  template <class F>
  void turn(F&& f) {
    auto J = jacobian(f, z_);
    J.row(N - 1) = tangent_.transpose();
    tangent_ = J.fullPivLu().solve(Point::Unit(N - 1)).normalized();
  }

  Point scale_, z_, tangent_;
  bool found_ = false;
};

}  // namespace hapbeam::testing
