// SPDX-License-Identifier: MIT
// A step of time: the trapezoidal rule to a part G of it, then the second backward difference.
//
//   minimise V(x) + ½ c |q(x) - q~|²       twice, with one c:  M c (q - q~) is the inertia, and the air's drag M α v
//
// Of second order, L-stable, and monotone in energy in all that was tried.  A stage has velocity and acceleration by the place that it finds:
//
//   v = v~ + r (q - q^),   a = c (q - q^),   r² = c
//
// Allocates at construction; all else is noexcept and allocation-free, O(n).
// Source: Bank and others, IEEE Trans. CAD 4, 1985; Hosea and Shampine, Appl. Numer. Math. 20, 1996.
#pragma once

#include <cmath>

#include <hapbeam/fem/dynamics/inertia.hpp>

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
  S rate() const noexcept { return 2 / (G * dt_); }
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
