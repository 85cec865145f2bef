// SPDX-License-Identifier: MIT
// A small dense symmetric system that need not be positive: PAPᵀ = LDLᵀ with pivots of one and of two, and the inertia that they tell.
//
// The matrix is scaled by its rows first, so that unknowns of different units may stand in one system.  An unknown whose pivot is round-off stays
// where it is.
// Real-time: noexcept, no allocation, O(n³).
// Source: Bunch and Parlett, Direct methods for solving symmetric indefinite systems, SIAM J. Numer. Anal. 8 (1971).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace hapbeam::detail {

/// @tparam Most  unknowns
template <typename Scalar, int Most>
class SymmetricIndefinite {
 public:
  using Unknowns = std::array<Scalar, static_cast<std::size_t>(Most)>;
  /// Becomes a system of so many unknowns, all of whose entries are 0.
  void resize(int n) noexcept {
    n_ = n;
    for (int i = 0; i < n; ++i) {
      x_[at(i)] = 0;
      std::fill_n(a_[at(i)].begin(), n, Scalar(0));
    }
  }
  /// Of the lower triangle: i >= j.
  Scalar& operator()(int i, int j) noexcept { return a_[at(i)][at(j)]; }
  /// Right-hand side, and the solution after solve().
  Unknowns& unknowns() noexcept { return x_; }
  Scalar& operator[](int i) noexcept { return x_[at(i)]; }
  Scalar operator[](int i) const noexcept { return x_[at(i)]; }
  /// Makes row and column of an unknown those of one that stays.   @param pivot  its sign counts
  void hold(int i, Scalar pivot) noexcept {
    for (int j = 0; j < n_; ++j) entry(i, j) = 0;
    a_[at(i)][at(i)] = pivot, x_[at(i)] = 0;
  }

  /// @return how many eigenvalues are negative
  int solve() noexcept {
    constexpr Scalar nothing = 256 * std::numeric_limits<Scalar>::epsilon();
    scale();
    int negative = 0, k = 0;
    while (k < n_) {
      const auto [p, q, size] = largest(k);
      if (!(size > nothing)) break;
      exchange(k, q);
      if (p != q) exchange(k + 1, p == k ? q : p);
      size_[at(k)] = p == q ? 1 : 2;
      negative += p != q || a_[at(k)][at(k)] < 0;
      k += eliminate(k, size_[at(k)]);
    }
    rank_ = k;
    solve(x_);
    return negative;
  }
  /// Of another right-hand side, after solve().   @param x  becomes the solution
  void solve(Unknowns& x) const noexcept {
    Unknowns y;
    for (int i = 0; i < n_; ++i) y[at(i)] = x[at(order_[at(i)])] * scale_[at(order_[at(i)])];
    for (int k = 0, size = 0; k < rank_; k += size) {
      size = size_[at(k)];
      for (int i = k + size; i < n_; ++i)
        for (int m = 0; m < size; ++m) y[at(i)] -= a_[at(i)][at(k + m)] * y[at(k + m)];
      divide(k, size, y);
    }
    for (int i = rank_; i < n_; ++i) y[at(i)] = 0;
    std::array<int, Most> starts;
    int count = 0;
    for (int k = 0; k < rank_; k += size_[at(k)]) starts[at(count++)] = k;
    while (count > 0) {
      const int k = starts[at(--count)], next = k + size_[at(k)];
      for (int m = k; m < next; ++m)
        for (int i = next; i < n_; ++i) y[at(m)] -= a_[at(i)][at(m)] * y[at(i)];
    }
    for (int i = 0; i < n_; ++i) x[at(order_[at(i)])] = y[at(i)] * scale_[at(order_[at(i)])];
  }

 private:
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  Scalar& entry(int i, int j) noexcept { return a_[at((std::max)(i, j))][at((std::min)(i, j))]; }

  void scale() noexcept {
    for (int i = 0; i < n_; ++i) {
      Scalar most = 0;
      for (int j = 0; j < n_; ++j) most = (std::max)(most, std::abs(entry(i, j)));
      scale_[at(i)] = most > 0 ? 1 / std::sqrt(most) : Scalar(1);
      order_[at(i)] = i;
    }
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j <= i; ++j) a_[at(i)][at(j)] *= scale_[at(i)] * scale_[at(j)];
  }
  /// A pivot of one at p = q, or of two at p > q, and the larger of both sizes.
  struct Pivot {
    int p, q;
    Scalar size;
  };
  Pivot largest(int k) const noexcept {
    constexpr Scalar alpha = Scalar(0.6403882032022076);  // (1 + √17)/8
    Pivot one{k, k, 0}, two{k, k, 0};
    for (int i = k; i < n_; ++i)
      for (int j = k; j <= i; ++j) {
        Pivot& most = i == j ? one : two;
        if (const Scalar size = std::abs(a_[at(i)][at(j)]); size > most.size) most = {i, j, size};
      }
    return one.size >= alpha * two.size ? one : two;
  }
  void exchange(int i, int j) noexcept {
    if (i == j) return;
    std::swap(order_[at(i)], order_[at(j)]);
    std::swap(a_[at(i)][at(i)], a_[at(j)][at(j)]);
    for (int m = 0; m < n_; ++m)
      if (m != i && m != j) std::swap(entry(i, m), entry(j, m));
  }
  /// Leaves a pivot's columns divided by it.   @return its size
  int eliminate(int k, int size) noexcept {
    const bool two = size == 2;
    const Inverse inverse = this->inverse(k, size);
    std::array<std::array<Scalar, 2>, Most> l;
    for (int i = k + size; i < n_; ++i) {
      l[at(i)] = inverse(a_[at(i)][at(k)], two ? a_[at(i)][at(k + 1)] : Scalar(0));
      for (int m = 0; m < size; ++m)
        for (int j = k + size; j <= i; ++j) a_[at(i)][at(j)] -= l[at(i)][at(m)] * a_[at(j)][at(k + m)];
    }
    for (int i = k + size; i < n_; ++i)
      for (int m = 0; m < size; ++m) a_[at(i)][at(k + m)] = l[at(i)][at(m)];
    return size;
  }
  /// Of a pivot.
  struct Inverse {
    Scalar a, b, c, over;
    std::array<Scalar, 2> operator()(Scalar u, Scalar v) const noexcept {
      return {(c * u - b * v) * over, (a * v - b * u) * over};
    }
  };
  Inverse inverse(int k, int size) const noexcept {
    const bool two = size == 2;
    const Scalar a = a_[at(k)][at(k)], b = two ? a_[at(k + 1)][at(k)] : Scalar(0),
                 c = two ? a_[at(k + 1)][at(k + 1)] : Scalar(1);
    return {a, b, c, 1 / (a * c - b * b)};
  }
  void divide(int k, int size, Unknowns& x) const noexcept {
    const auto divided = inverse(k, size)(x[at(k)], size == 2 ? x[at(k + 1)] : Scalar(0));
    for (int m = 0; m < size; ++m) x[at(k + m)] = divided[at(m)];
  }
  int n_ = 0, rank_ = 0;  // pivots
  std::array<std::array<Scalar, Most>, Most> a_{};
  Unknowns x_{}, scale_{};
  std::array<int, Most> order_{}, size_{};
};

}  // namespace hapbeam::detail
