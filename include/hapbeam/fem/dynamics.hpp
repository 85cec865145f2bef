// SPDX-License-Identifier: MIT
// The dynamics of a beam in the plane: its inertia, as a step of time sees it, a spring to where it would be without force, and
// the step.
//
//   Π = V + ½ c |q - q~|²          |·|² = qᵀ M q,   q: place and unit tangent (x, y, cos θ, -sin θ) of each node
//
// In these unknowns the consistent mass of the cubic is constant.  That of sections that turn, ρI, is left out: the first frequency between hinges is
// (πh/L)²/24 of itself too high, h: height.
//
// A step is the trapezoidal rule to a part G of it, then the second backward difference:
//
//   minimise V(x) + ½ c |q(x) - q~|²       twice, with one c:  M c (q - q~) is the inertia, and the air's drag M α v
//
// Of second order, L-stable, and monotone in energy in all that was tried.  A stage has velocity and acceleration by the place that it finds:
//
//   v = v~ + r (q - q^),   a = c (q - q^),   r² = c
//
// Allocates and throws at construction; all else is noexcept and allocation-free, O(n).
// Source: derived here; consistent mass, Archer 1963; the step, Bank and others, IEEE Trans. CAD 4, 1985; Hosea and Shampine, Appl.
// Numer. Math. 20, 1996.
#pragma once

#include <array>

#include <hapbeam/angle.hpp>
#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam::detail {

/// Place [m] and unit tangent of a node.
template <typename S>
using Placed = Eigen::Matrix<S, 4, 1>;

template <typename S>
Placed<S> placed(const CentrelineNode<S>& node) noexcept {
  const Vector2<S> along = direction(-node.theta);
  return Placed<S>(node.s + node.u, node.w, along.x(), along.y());
}

template <typename S, int Elements, int MaxElements>
class Inertia {
  using Values = PerNode<Placed<S>, Elements, MaxElements>;

 public:
  /// @param at  (i) -> arc position of node i [m]   @throws std::invalid_argument where the beam has no density
  template <class At>
  Inertia(const Beam& beam, int elements, At&& at) : masses_(elements), ghost_(elements) {
    for (int e = 0; e < elements; ++e) {
      const double from = static_cast<double>(at(e)), l = static_cast<double>(at(e + 1)) - from;
      Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
      // Exact where the mass is even or tapers linearly.
      constexpr std::array<double, 4> x{0.0694318442029737124, 0.330009478207571868, 0.669990521792428132,
                                        0.930568155797026288},
          w{0.173927422568726929, 0.326072577431273071, 0.326072577431273071, 0.173927422568726929};
      for (std::size_t g = 0; g < x.size(); ++g) {
        const double t = x[g], u = 1 - t;
        const Eigen::Vector4d h(u * u * (1 + 2 * t), l * t * u * u, t * t * (3 - 2 * t), -l * t * t * u);
        const double mass = beam.mass_per_length(from + t * l);
        if (!(mass > 0))
          reject("density", mass, "kg/m³", "known for a beam that moves: Material{young, density}");
        sum += w[g] * l * mass * h * h.transpose();
      }
      masses_[e] = sum.template cast<S>();
    }
  }

  /// c [1/s²]
  S rate() const noexcept { return rate_; }
  void set_rate(S c) noexcept { rate_ = c; }
  Values& ghost() noexcept { return ghost_; }
  const Values& ghost() const noexcept { return ghost_; }
  /// What increments are measured by, beside the strain energy [J].
  S scale() const noexcept { return scale_; }
  void set_scale(S energy) noexcept { scale_ = energy; }

  /// Adds its part of an element's residual and tangent.   @return ½ c |q - q~|² [J]
  S add(int e, const CentrelineNode<S>& a, const CentrelineNode<S>& b, Vector6<S>& r,
        Matrix6<S>& K) const noexcept {
    const Placed<S> q[2] = {placed(a), placed(b)};
    const auto& M = masses_[e];
    // What it is off, by component: of places and tangents of both nodes.
    S x[4], y[4];
    for (int k = 0; k < 2; ++k) {
      const Placed<S>& ghost = ghost_[e + k];
      x[2 * k] = q[k][0] - ghost[0], x[2 * k + 1] = q[k][2] - ghost[2];
      y[2 * k] = q[k][1] - ghost[1], y[2 * k + 1] = q[k][3] - ghost[3];
    }
    S sum = 0;
    for (int k = 0; k < 2; ++k) {
      // ∂(cos θ, -sin θ)/∂θ = (-sin θ, -cos θ)
      const int at = 3 * k;
      const S cx = q[k][3], cy = -q[k][2];
      S f[2], g[2];  // c M of that, along x and y
      for (int d = 0; d < 2; ++d) {
        f[d] = g[d] = 0;
        for (int j = 0; j < 4; ++j) {
          const S m = rate_ * M(2 * k + d, j);
          f[d] += m * x[j], g[d] += m * y[j];
        }
        sum += x[2 * k + d] * f[d] + y[2 * k + d] * g[d];
      }
      r[at] += f[0], r[at + 1] += g[0], r[at + 2] += cx * f[1] + cy * g[1];
      K(at + 2, at + 2) += cy * f[1] - cx * g[1];
      for (int j = 0; j < 2; ++j) {
        const int to = 3 * j;
        const S dx = q[j][3], dy = -q[j][2];
        const S m = rate_ * M(2 * k, 2 * j), mt = rate_ * M(2 * k, 2 * j + 1),
                tm = rate_ * M(2 * k + 1, 2 * j), tt = rate_ * M(2 * k + 1, 2 * j + 1);
        K(at, to) += m, K(at + 1, to + 1) += m;
        K(at, to + 2) += mt * dx, K(at + 1, to + 2) += mt * dy;
        K(at + 2, to) += tm * cx, K(at + 2, to + 1) += tm * cy;
        K(at + 2, to + 2) += tt * (cx * dx + cy * dy);
      }
    }
    return sum / 2;
  }
  /// ½ |v|² [J].   @param v  (i) -> Placed of node i
  template <class V>
  S energy(V&& v) const noexcept {
    S sum = 0;
    for (int e = 0; e < masses_.size() - 1; ++e) {
      const Placed<S> a = v(e), b = v(e + 1);
      const Eigen::Matrix<S, 4, 1> x(a[0], a[2], b[0], b[2]), y(a[1], a[3], b[1], b[3]);
      sum += x.dot(masses_[e] * x) + y.dot(masses_[e] * y);
    }
    return sum / 2;
  }

 private:
  PerNode<Eigen::Matrix<S, 4, 4>, Elements, MaxElements>
      masses_;    // of places and tangents, a component [kg], [kg·m], [kg·m²]
  Values ghost_;  // q~
  S rate_ = 0, scale_ = 0;
};

}  // namespace hapbeam::detail

namespace hapbeam {

template <typename S, int Elements, int MaxElements>
class TrBdf2 {
 public:
  using Placed = detail::Placed<S>;
  /// How one node moves.
  struct State {
    Placed q = Placed::Zero(), v = Placed::Zero(), a = Placed::Zero();
  };
  using States = detail::PerNode<State, Elements, MaxElements>;
  static constexpr int stages = 2;

  explicit TrBdf2(int elements) : now_(elements), between_(elements), before_(elements) {}

  /// Of node i, at the end of the last step.
  State& operator[](int i) noexcept { return now_[i]; }
  const State& operator[](int i) const noexcept { return now_[i]; }

  /// @param dt [s]   @param drag  α of the air [1/s]
  void begin(S dt, S drag) noexcept {
    dt_ = dt, drag_ = drag;
    for (int i = 0; i < now_.size(); ++i) before_[i] = now_[i];
  }
  void take_back() noexcept {
    for (int i = 0; i < now_.size(); ++i) now_[i] = before_[i];
  }
  /// Where it was before the last step, with the acceleration behind it.
  void start_again() noexcept {
    for (int i = 0; i < now_.size(); ++i) now_[i].q = before_[i].q, now_[i].v = before_[i].v;
  }
  /// How long a stage is [s].
  S length(int stage) const noexcept { return (stage == 0 ? G : 1 - G) * dt_; }
  /// Where it ends, of the step.
  static constexpr S end(int stage) noexcept { return stage == 0 ? G : S(1); }

  /// Sets c and q~ of a stage.
  template <class Inertia>
  void aim(int stage, Inertia& inertia) const noexcept {
    const S r = rate(), c = r * r, all = c + drag_ * r;
    inertia.set_rate(all);
    for (int i = 0; i < now_.size(); ++i) {
      const auto [place, velocity] = from(stage, i);
      inertia.ghost()[i] = place - drag_ / all * velocity;
    }
  }
  /// Where a node is about at the end of a stage.
  Placed foreseen(int stage, int i) const noexcept {
    const State& x = stage == 0 ? now_[i] : between_[i];
    const S h = length(stage);
    return x.q + h * (x.v + (stage == 0 ? S(0) : h / 2) * x.a);
  }
  /// r of both stages, by which they have their rates [1/s].
  S rate() const noexcept { return 2 / (G * dt_); }
  /// Of what changes by a rate: where a stage counts the change from, by r, to have the rate at its end.
  /// @param x, rate  at the beginning of the step   @param y  at the end of the first stage
  template <class X>
  static X counted_from(int stage, const X& x, const X& rate, const X& y, S r) noexcept {
    return stage == 0 ? X(x + rate / r) : X(new_ * y - old_ * x);
  }
  /// To be called where the stage has been solved.
  void know(int stage, int i, const Placed& q) noexcept {
    const auto [place, velocity] = from(stage, i);
    const S r = rate();
    State& to = stage == 0 ? between_[i] : now_[i];
    to = {q, velocity + r * (q - place), r * r * (q - place)};
  }

 private:
  static constexpr S G = S(0.585786437626904951);  // 2 - √2: both stages have one c
  static constexpr S new_ = 1 / (G * (2 - G)), old_ = (1 - G) * (1 - G) * new_;
  struct From {
    Placed place, velocity;  // q^, v~
  };
  From from(int stage, int i) const noexcept {
    const State &x = now_[i], &y = between_[i];
    const S half = 1 / rate();
    if (stage == 0) {
      const Placed velocity = x.v + half * x.a;
      return {x.q + half * (x.v + velocity), velocity};
    }
    const Placed velocity = new_ * y.v - old_ * x.v;
    return {new_ * y.q - old_ * x.q + half * velocity, velocity};
  }

  States now_, between_, before_;
  S dt_ = 0, drag_ = 0;
};

}  // namespace hapbeam
