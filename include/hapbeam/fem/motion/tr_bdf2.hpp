// SPDX-License-Identifier: MIT
// The step of time: the trapezoidal rule to a part G of it, then the second backward difference; or backward Euler's rule in both stages.
//
//   minimise V(x) + ½ c |q(x) - q~|²       twice:  M c (q - q~) is the inertia, and the air's drag M α v
//   v = v~ + r (q - q^),   a = c (q - q^),   r² = c
//
// By the first rule both stages have one c.  It is of second order, L-stable, and monotone in energy in all that was tried with 50 steps or more in a
// period, but for blows: the trapezoidal rule throws back, and what pushed once pushes on.  By Euler's rule a stage has  V + ½ |v|²  no larger than the
// one before, whatever it may not pass.
// Allocates at construction; all else is noexcept and allocation-free, O(n).
// Source: Bank and others, IEEE Trans. CAD 4, 1985; Hosea and Shampine, Appl. Numer. Math. 20, 1996; Euler's: |v|² of a minimum.
#pragma once

#include <type_traits>

#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam {

/// @tparam Size  of what a node has: MassBlocks
template <typename S, int Elements, int MaxElements, int Size = 4>
class TrBdf2 {
 public:
  using Placed = Eigen::Matrix<S, Size, 1>;
  /// How one node moves.
  struct State {
    Placed q = Placed::Zero(), v = Placed::Zero(), a = Placed::Zero();
  };
  using States = detail::PerNode<State, Elements, MaxElements>;
  static constexpr int stages = 2;
  enum class Rule { second_order, euler };

  explicit TrBdf2(int elements) : now_(elements), between_(elements), before_(elements), from_(elements) {}

  /// Of node i, at the end of the last step.
  const State& operator[](int i) const noexcept { return now_[i]; }

  /// @param dt [s]   @param drag  α of the air [1/s]
  void begin(S dt, S drag) noexcept {
    span_ = follows_ ? length(1) : S(0);
    dt_ = dt, drag_ = drag, rate_ = 2 / (G * dt_), rule_ = Rule::second_order;
    for (int i = 0; i < now_.size(); ++i) before_[i] = now_[i];
  }
  Rule rule() const noexcept { return rule_; }
  /// By Euler's, from the next aim() to the end of the step.
  void take_euler() noexcept { rule_ = Rule::euler; }
  void take_back() noexcept {
    for (int i = 0; i < now_.size(); ++i) now_[i] = before_[i];
    follows_ = false;
  }
  /// Without velocity.   @param q  (i) -> where node i is
  template <class Where>
  void stop(Where&& q) noexcept {
    for (int i = 0; i < now_.size(); ++i) now_[i] = {}, now_[i].q = q(i);
    follows_ = false;
  }
  /// @param v  (i) -> velocity of node i, of place and tangent
  template <class Velocity>
  void throw_at(Velocity&& v) noexcept {
    for (int i = 0; i < now_.size(); ++i) {
      const auto thrown = v(i);
      now_[i].v.template head<std::decay_t<decltype(thrown)>::RowsAtCompileTime>() = thrown;
    }
  }
  /// Where it was before the last step, with the acceleration behind it.
  void start_again() noexcept {
    for (int i = 0; i < now_.size(); ++i) now_[i].q = before_[i].q, now_[i].v = before_[i].v;
    follows_ = false;
  }
  /// How long a stage is [s].
  S length(int stage) const noexcept { return (stage == 0 ? G : 1 - G) * dt_; }
  /// Where it ends, of the step.
  static constexpr S end(int stage) noexcept { return stage == 0 ? G : S(1); }

  /// Sets c and q~ of a stage.
  template <class Inertia>
  void aim(int stage, Inertia& inertia) noexcept {
    if (rule_ == Rule::euler) rate_ = 1 / length(stage);
    const S r = rate(), c = r * r, all = c + drag_ * r;
    inertia.set_rate(all);
    for (int i = 0; i < now_.size(); ++i) {
      from_[i] = from(stage, i);
      inertia.ghost()[i] = from_[i].place - drag_ / all * from_[i].velocity;
    }
  }
  /// Of node i, where a stage begins.
  const State& start(int stage, int i) const noexcept { return stage == 0 ? now_[i] : between_[i]; }
  /// How long a stage is in units of the one before; 0 where there is none, after a start.
  S onward(int stage) const noexcept {
    return stage == 1 ? length(1) / length(0) : span_ > 0 ? length(0) / span_ : S(0);
  }
  /// Where a node is about at the end of a stage: its acceleration goes on as over the one before.
  Placed foreseen(int stage, int i) const noexcept {
    const State &x = start(stage, i), &before = start(1 - stage, i);
    const S h = length(stage);
    return x.q + h * (x.v + h / 2 * (x.a + onward(stage) / 3 * (x.a - before.a)));
  }
  /// r of a stage after aim(), by which it has its rates [1/s].
  S rate() const noexcept { return rate_; }
  /// Of what changes by a rate: where a stage counts the change from, by r, to have the rate at its end.
  /// @param x, rate  at the beginning of the step   @param y  at the end of the first stage
  template <class X>
  X counted_from(int stage, const X& x, const X& rate, const X& y) const noexcept {
    if (rule_ == Rule::euler) return stage == 0 ? x : y;
    return stage == 0 ? X(x + rate / rate_) : X(new_ * y - old_ * x);
  }
  /// To be called where the stage has been solved.
  void know(int stage, int i, const Placed& q) noexcept {
    const S r = rate();
    const Placed faster = r * (q - from_[i].place);
    State& to = stage == 0 ? between_[i] : now_[i];
    to.q = q, to.v = from_[i].velocity + faster, to.a = r * faster;
    follows_ = stage == 1;
  }

 private:
  static constexpr S G = S(0.585786437626904951);  // 2 - √2: both stages have one c
  static constexpr S new_ = 1 / (G * (2 - G)), old_ = (1 - G) * (1 - G) * new_;
  struct From {
    Placed place = Placed::Zero(), velocity = Placed::Zero();  // q^, v~
  };
  From from(int stage, int i) const noexcept {
    const State &x = now_[i], &y = between_[i];
    const S half = 1 / rate();
    if (rule_ == Rule::euler) return {start(stage, i).q + half * start(stage, i).v, start(stage, i).v};
    if (stage == 0) {
      const Placed velocity = x.v + half * x.a;
      return {x.q + half * (x.v + velocity), velocity};
    }
    const Placed velocity = new_ * y.v - old_ * x.v;
    return {new_ * y.q - old_ * x.q + half * velocity, velocity};
  }

  States now_, between_, before_;
  detail::PerNode<From, Elements, MaxElements> from_;
  S dt_ = 0, drag_ = 0, rate_ = 0, span_ = 0;  // the last: of the stage before a step, 0: none
  Rule rule_ = Rule::second_order;
  bool follows_ = false;  // on such a stage
};

}  // namespace hapbeam
