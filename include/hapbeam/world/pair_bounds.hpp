// SPDX-License-Identifier: MIT
// What is not symmetric of the dense equations of all pairs: bounds follow normal forces, and friction goes along with places.
//
//   (A + Σ v pᵀ) u = b       A: symmetric, with given bounds;  p u = δλ of a pair that slides, or δs of a place;  v: what friction makes of it
//
// One after another by Sherman and Morrison's formula:  det (A + v pᵀ) = (1 + p A⁻¹v) det A.  Where friction makes stable what is not with given bounds that changes its
// sign.  A bound for which it has no answer, where rods jam, stays as it was given.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(pairs · unknowns²).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <hapbeam/world/pair_friction.hpp>

namespace hapbeam::detail {

/// @tparam Equations  SymmetricIndefinite
template <class Equations>
class PairBounds {
 public:
  using Unknowns = typename Equations::Unknowns;

  explicit PairBounds(std::size_t most) { bounds_.reserve(most); }
  void clear() noexcept { bounds_.clear(); }
  /// A pair that slides.   @param row  of its equations   @param stays  which of its places stay   @param force  λ [N]
  void add(const PairFriction& friction, int row, const std::array<bool, 2>& stays, double force) noexcept {
    bounds_.push_back({row, friction.row(), {}, 0});
    Unknowns& v = bounds_.back().answer;
    const auto column = friction.column(force);
    v.fill(0);
    for (std::size_t k = 0; k < 4; ++k)
      if (k < 2 || !stays[k - 2]) v[static_cast<std::size_t>(row) + 1 + k] = column[k];
  }
  /// A place with which friction goes along.
  void add(const Unknowns& v, int unknown) noexcept { bounds_.push_back({unknown - 2, {0, 0, 1}, v, 0}); }
  /// To be called after they are solved with given bounds.
  /// @param negative  eigenvalues with those that are one in a stable equilibrium are not   @return the same with bounds that follow
  int follow(Equations& equations, std::size_t unknowns, int negative) noexcept {
    constexpr double jams = 0.01;
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      Bound& bound = bounds_[i];
      equations.solve(bound.answer);
      for (std::size_t j = 0; j < i; ++j) bounds_[j].correct(bound.answer, unknowns);
      const double rest = 1 + bound.of(bound.answer);
      const bool frees = negative > 0 && rest < -jams;
      negative -= frees;
      bound.over = rest > jams || frees ? 1 / rest : 0.0;
    }
    for (const Bound& bound : bounds_) bound.correct(equations.unknowns(), unknowns);
    return negative;
  }

 private:
  struct Bound {
    int row;
    std::array<double, 3> p;
    Unknowns answer;  // A⁻¹v
    double over;

    double of(const Unknowns& x) const noexcept {
      const std::size_t at = static_cast<std::size_t>(row);
      return p[0] * x[at] + p[1] * x[at + 1] + p[2] * x[at + 2];
    }
    void correct(Unknowns& x, std::size_t unknowns) const noexcept {
      const double by = over * of(x);
      for (std::size_t i = 0; i < unknowns; ++i) x[i] -= by * answer[i];
    }
  };
  std::vector<Bound> bounds_;
};

}  // namespace hapbeam::detail
