// SPDX-License-Identifier: MIT
// The equations of rods and of the pairs that touch, as NewtonRaphson solves them.
//
// Each rod that moves is factored by itself; what is left is one dense symmetric system of all pairs (pair_sides.hpp).  Its inertia and that of the rods
// tell whether an equilibrium is stable: each pair has three negative eigenvalues of its own, of λ and of two places of least distance.
// Allocates and throws at construction; every other member is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include <hapbeam/world/rod_body.hpp>

namespace hapbeam {

/// A rod of a World.
struct WorldRod {
  Rod rod;
  int elements;  ///< 2 or more
};

namespace detail {

template <class Element>
class PairSystem {
 public:
  using Scalar = double;
  using Body = RodBody<Element>;

  /// @throws std::invalid_argument as RodBody
  explicit PairSystem(const std::vector<WorldRod>& rods) : equations_(std::make_unique<PairEquations>()) {
    bodies_.reserve(rods.size());
    for (const auto& [rod, elements] : rods) bodies_.emplace_back(rod, elements, *equations_);
  }

  std::vector<Body>& bodies() noexcept { return bodies_; }
  const std::vector<Body>& bodies() const noexcept { return bodies_; }
  Body& body(int i) noexcept { return bodies_[static_cast<std::size_t>(i)]; }
  const Body& body(int i) const noexcept { return bodies_[static_cast<std::size_t>(i)]; }

  // The pairs that touch.

  int pairs() const noexcept { return number_; }
  RodPair& pair(int k) noexcept { return pairs_[at(k)]; }
  const RodPair& pair(int k) const noexcept { return pairs_[at(k)]; }
  void clear() noexcept { number_ = 0; }
  /// @return whether there was room
  bool add(const RodPair& pair) noexcept {
    if (number_ == most_pairs) return false;
    pairs_[at(number_++)] = pair;
    return true;
  }
  void remove(int k) noexcept {
    for (--number_; k < number_; ++k) pairs_[at(k)] = pairs_[at(k + 1)];
  }
  /// Whether a pair is solved for.
  bool moves(const RodPair& pair) const noexcept { return body(pair.rod[0]).moves; }
  /// What moves moves all that it touches.
  void spread() noexcept {
    for (bool more = true; more;) {
      more = false;
      for (int k = 0; k < number_; ++k) {
        Body &a = body(pair(k).rod[0]), &b = body(pair(k).rod[1]);
        if (a.moves == b.moves) continue;
        a.moves = b.moves = more = true;
      }
    }
  }
  /// How far along their path, 0 to 1, the next step takes all ends.
  void aim(double t) noexcept { goal_ = t; }

  // Required by NewtonRaphson.

  /// A step is not divided.
  void set_target(double) noexcept {
    each([&](Body& body) { body.set_target(goal_); });
  }
  void save() noexcept {
    each([](Body& body) { body.save(); });
    saved_ = pairs_, saved_number_ = number_;
  }
  void restore() noexcept {
    each([](Body& body) { body.restore(); });
    pairs_ = saved_, number_ = saved_number_;
  }
  double size() const noexcept { return size_; }
  double unit() const noexcept {
    double square = 0;
    each([&](const Body& body) { square += body.system().unit() * body.system().unit(); });
    return std::sqrt(square);
  }
  int elements() const noexcept {
    int most = 0;
    each([&](const Body& body) { most = (std::max)(most, body.elements()); });
    return most;
  }
  double round_off() const noexcept {
    double sum = 0;
    each([&](const Body& body) { sum += body.system().round_off(); });
    return sum;
  }
  Iteration<double> iterate() noexcept {
    const Status status = factor(0);
    if (status == Status::ok) advance();
    return {status, increment()};
  }

  // For a fall, in addition.

  /// @param shift  as of ChainSystem   @return ok | singular | non_finite | iteration_limit
  Status factor(double shift) noexcept {
    lay_out();
    double measured = 0, inner = 0;
    negative_ = 0;
    Status status = Status::ok;
    each([&](Body& body) {
      const auto of = body.assemble(shift);
      measured += of.measured, inner += of.inner;
      negative_ += body.negative_pivots();
      if (worse(of.status, status)) status = of.status;
    });
    // A round rod that is bowed between two ends on one axis may roll about it.
    if (status == Status::singular && shift == 0) return factor(Body::System::neutral());
    if (status != Status::ok) return status;
    each([](Body& body) { body.eliminate(); });
    hold_fresh();
    negative_ += equations_->solve() - 3 * rows_;
    size_ = std::sqrt(2 * measured);
    double square = 0;
    each([&](Body& body) { square += body.substitute(); });
    increment_ = std::sqrt(std::abs(square) + std::abs(inner));
    return std::isfinite(increment_) ? Status::ok : Status::non_finite;
  }
  void advance() noexcept {
    each([](Body& body) { body.advance(); });
    int row = 0;
    for (int k = 0; k < number_; ++k) {
      RodPair& pair = this->pair(k);
      if (!moves(pair)) continue;
      const PairEquations& u = *equations_;
      pair.push(u[row], u[row + 1], u[row + 2]);
      for (std::size_t side = 0; side < 2; ++side) {
        const Body& body = this->body(pair.rod[side]);
        const double most = body.length() / body.elements();
        pair.slide(side, std::clamp(u[row + 3 + static_cast<int>(side)], -most, most), body.length());
      }
      row += pair_unknowns;
    }
  }
  double increment() const noexcept { return increment_; }
  int negative_pivots() const noexcept { return negative_; }
  double turn() const noexcept {
    double largest = 0;
    each([&](const Body& body) { largest = (std::max)(largest, body.turn()); });
    return largest;
  }

 private:
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  template <class F>
  void each(F&& f) noexcept {
    for (Body& body : bodies_)
      if (body.moves) f(body);
  }
  template <class F>
  void each(F&& f) const noexcept {
    for (const Body& body : bodies_)
      if (body.moves) f(body);
  }
  /// Gives each pair its rows, and each rod its sides.
  void lay_out() noexcept {
    each([](Body& body) { body.sides.clear(); });
    rows_ = 0;
    for (int k = 0; k < number_; ++k) rows_ += moves(pair(k));
    PairEquations& dense = *equations_;
    dense.resize(pair_unknowns * rows_);
    int row = 0;
    for (int k = 0; k < number_; ++k) {
      RodPair& pair = this->pair(k);
      if (!moves(pair)) continue;
      pair.look();
      dense[row] -= pair.reach;
      for (int c = 1; c < 3 && !pair.fresh; ++c) dense(row + c, row + c) = pair.reach / pair.force;
      for (std::size_t side = 0; side < 2; ++side) {
        Body& body = this->body(pair.rod[side]);
        body.sides.add(pair, side, row, body.line().segment_at(pair.s[side]));
      }
      row += pair_unknowns;
    }
  }

  /// What is new keeps its direction.
  void hold_fresh() noexcept {
    int row = 0;
    for (int k = 0; k < number_; ++k) {
      if (!moves(pair(k))) continue;
      for (int c = 1; c < 3 && pair(k).fresh; ++c) equations_->hold(row + c, 1);
      row += pair_unknowns;
    }
  }

  std::unique_ptr<PairEquations> equations_;
  std::vector<Body> bodies_;
  std::array<RodPair, most_pairs> pairs_, saved_;
  int number_ = 0, saved_number_ = 0;
  int rows_ = 0;  // pairs that are solved for
  double goal_ = 1;
  double size_ = 0, increment_ = 0;
  int negative_ = 0;
};

}  // namespace detail

}  // namespace hapbeam
