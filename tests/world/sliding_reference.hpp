// A cantilever that a straight rigid rod rubs over along itself, once nothing but that rod moves, by shooting.
//
//   r' = (1 + F·u/EA) u,   u' = M × u/EI,   M' = -r' × F,   M(s) = 0            F = λ (μ e - n),  n = u(s) × e/|u(s) × e|
//
// from the clamp at 0 along x.  The rigid rod lies on the line p + x e, above at R n.
#pragma once

#include <cmath>

#include <Eigen/LU>

#include "rod/rods.hpp"

namespace hapbeam::testing {

struct Rubbed {
  double EA, EI;                ///< [N], [N·m²]
  Point along, through;         ///< e, p [m]
  double reach, mu;             ///< R [m]
  double force = 0, place = 0;  ///< λ [N] and s [m], found
  Point pull = Point::Zero();   ///< F on the cantilever [N]

  /// @param force, place  about what they are
  Rubbed& solve(double about_force, double about_place) {
    using Unknowns = Eigen::Matrix<double, 5, 1>;
    Unknowns x;
    x << 0, 0.1 * about_force * about_place, 0, about_force, about_place;
    for (int k = 0; k < 60; ++k) {
      const Unknowns rest = missing(x);
      Eigen::Matrix<double, 5, 5> J;
      for (int c = 0; c < 5; ++c) {
        const double step = 1e-6 * (c < 3 ? about_force * about_place : x[c]);
        Unknowns more = x, less = x;
        more[c] += step, less[c] -= step;
        J.col(c) = (missing(more) - missing(less)) / (2 * step);
      }
      const Unknowns by = J.partialPivLu().solve(rest);
      x -= (k < 12 ? 0.5 : 1.0) * by;
    }
    force = x[3], place = x[4];
    return *this;
  }

 private:
  struct State {
    Point r, u, M;
    State operator+(const State& o) const { return {r + o.r, u + o.u, M + o.M}; }
    State operator*(double h) const { return {h * r, h * u, h * M}; }
  };
  static Point cross(const Point& a, const Point& b) {
    return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
  }
  State rate(const State& y, const Point& F) const {
    const Point r = (1 + F.dot(y.u) / EA) * y.u;
    return {r, cross(y.M, y.u) / EI, -cross(r, F)};
  }
  /// M(0), λ and s -> M(s), and how far the line is from where it touches.
  Eigen::Matrix<double, 5, 1> missing(const Eigen::Matrix<double, 5, 1>& x) {
    constexpr int steps = 400;
    Point n(0, 0, 1);
    State y{};
    // n is that of where it ends.
    for (int again = 0; again < 30; ++again) {
      pull = x[3] * (mu * along - n);
      const double h = x[4] / steps;
      y = {Point::Zero(), Point(1, 0, 0), Point(x[0], x[1], x[2])};
      for (int i = 0; i < steps; ++i) {
        const State a = rate(y, pull), b = rate(y + a * (h / 2), pull), c = rate(y + b * (h / 2), pull),
                    d = rate(y + c * h, pull);
        y = y + (a + b * 2 + c * 2 + d) * (h / 6);
      }
      const Point next = cross(y.u, along).normalized();
      if ((next - n).norm() < 1e-14) break;
      n = next;
    }
    const Point off = through - y.r;
    Eigen::Matrix<double, 5, 1> rest;
    rest << y.M, off.dot(n) - reach, off.dot(cross(along, n));
    return rest;
  }
};

}  // namespace hapbeam::testing
