// SPDX-License-Identifier: MIT
// Vectors of a few contacts one behind the other, and matrices by two of them.
//
// Real-time: noexcept, no allocation, O(contacts²), an inverse O(contacts³).
#pragma once

#include <array>
#include <cstddef>

#include <hapbeam/centreline.hpp>

namespace hapbeam::detail {

/// @tparam Most  contacts
template <typename S, int Most>
class Stacked {
 protected:
  using Vector = VectorOf<S, 3>;
  using Matrix = Eigen::Matrix<S, 3, 3>;
  /// So many numbers of it are used.
  using Stack = std::array<S, std::size_t(3 * Most)>;
  using Square = std::array<Stack, std::size_t(3 * Most)>;

  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  /// Of contacts.  Where there may be one alone a compiler knows it.
  int count() const noexcept { return Most == 1 ? 1 : count_; }
  int size() const noexcept { return 3 * count(); }

  static Vector vector(const Stack& of, int k) noexcept {
    return {of[at(3 * k)], of[at(3 * k + 1)], of[at(3 * k + 2)]};
  }
  static void put(Square& to, int i, int j, const Matrix& m) noexcept {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) to[at(3 * i + r)][at(3 * j + c)] = m(r, c);
  }
  static Matrix block(const Square& of, int i, int j) noexcept {
    Matrix m;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) m(r, c) = of[at(3 * i + r)][at(3 * j + c)];
    return m;
  }
  Square product(const Square& a, const Square& b) const noexcept {
    // Row by row: where the sum of one number is innermost, g++ 12 at -O3 loads rows as aligned that are not.
    Square c;
    for (int i = 0; i < size(); ++i) {
      c[at(i)].fill(0);
      for (int k = 0; k < size(); ++k)
        for (int j = 0; j < size(); ++j) c[at(i)][at(j)] += a[at(i)][at(k)] * b[at(k)][at(j)];
    }
    return c;
  }
  Stack times(const Square& a, const Stack& x) const noexcept {
    Stack y{};
    for (int i = 0; i < size(); ++i)
      for (int k = 0; k < size(); ++k) y[at(i)] += a[at(i)][at(k)] * x[at(k)];
    return y;
  }
  /// By Gauss and Jordan.  I + C H is near I: what a bubble bends is small beside the reach.
  Square inverse(Square a) const noexcept {
    const int n = size();
    for (int p = 0; p < n; ++p) {
      const S over = 1 / a[at(p)][at(p)];
      a[at(p)][at(p)] = 1;
      for (int j = 0; j < n; ++j) a[at(p)][at(j)] *= over;
      for (int i = 0; i < n; ++i) {
        if (i == p) continue;
        const S part = a[at(i)][at(p)];
        a[at(i)][at(p)] = 0;
        for (int j = 0; j < n; ++j) a[at(i)][at(j)] -= part * a[at(p)][at(j)];
      }
    }
    return a;
  }

  int count_ = 0;
};

}  // namespace hapbeam::detail
