// The small pieces of a block elimination: LDLᵀ of one symmetric block, and what its pivots tell.
//
// Blocks are small and their size is known, so each loop is unrolled by intent: g++ -O2 would leave loops, whose entries go
// through memory.
// Real-time: noexcept, no allocation, O(N³).  Source: Golub and Van Loan, Matrix Computations, 4.1.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

#include <hapbeam/unroll.hpp>

namespace hapbeam {

template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <typename Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

namespace detail {

/// A symmetric N×N matrix, its lower triangle, column by column.
template <typename S, int N>
struct Symmetric {
  S a[N * (N + 1) / 2];

  static constexpr int index(int i, int j) noexcept { return j * (2 * N - 1 - j) / 2 + i; }
  /// @param i,j  i >= j
  S& operator()(int i, int j) noexcept { return a[index(i, j)]; }
  const S& operator()(int i, int j) const noexcept { return a[index(i, j)]; }
};

/// v - aᵀb.  The last component is known last: it is subtracted last.
template <typename S, int N>
[[gnu::always_inline]] inline S less(S v, const Eigen::Matrix<S, N, 1>& a,
                                     const Eigen::Matrix<S, N, 1>& b) noexcept {
  HAPBEAM_UNROLL
  for (int k = 0; k < N; ++k) v -= a[k] * b[k];
  return v;
}

/// A = L P Lᵀ of a symmetric N×N matrix, L unit lower.
template <typename S, int N>
struct Ldlt {
  using Vector = Eigen::Matrix<S, N, 1>;
  Symmetric<S, N> l;  ///< below its diagonal: L
  S p[N];             ///< pivots
  S i[N];             ///< their inverses

  [[gnu::always_inline]] explicit Ldlt(const Symmetric<S, N>& a) noexcept {
    Symmetric<S, N> c = a;  // LP
    HAPBEAM_UNROLL
    for (int j = 0; j < N; ++j) {
      HAPBEAM_UNROLL
      for (int row = j; row < N; ++row) {
        HAPBEAM_UNROLL
        for (int k = 0; k < j; ++k) c(row, j) -= l(row, k) * c(j, k);
      }
      p[j] = c(j, j);
      i[j] = 1 / p[j];
      HAPBEAM_UNROLL
      for (int row = j + 1; row < N; ++row) l(row, j) = c(row, j) * i[j];
    }
  }

  /// L⁻¹ b
  [[gnu::always_inline]] Vector forward(Vector b) const noexcept {
    HAPBEAM_UNROLL
    for (int row = 1; row < N; ++row) {
      HAPBEAM_UNROLL
      for (int k = 0; k < row; ++k) b[row] -= l(row, k) * b[k];
    }
    return b;
  }
  /// P⁻¹ y
  [[gnu::always_inline]] Vector scale(Vector y) const noexcept {
    HAPBEAM_UNROLL
    for (int k = 0; k < N; ++k) y[k] *= i[k];
    return y;
  }
};

/// L⁻ᵀ z, from the last component to the first.
template <typename S, int N>
[[gnu::always_inline]] inline Eigen::Matrix<S, N, 1> backward(const Symmetric<S, N>& l,
                                                              Eigen::Matrix<S, N, 1> z) noexcept {
  HAPBEAM_UNROLL
  for (int j = N - 2; j >= 0; --j) {
    HAPBEAM_UNROLL
    for (int k = N - 1; k > j; --k) z[j] -= l(k, j) * z[k];
  }
  return z;
}

/// What a chain of eliminations has seen.
template <typename S>
struct Pivots {
  /// Least |pivot| - eps |its diagonal entry before elimination|; the first that is not positive is kept, NaN too.
  S lowest = (std::numeric_limits<S>::max)();
  S energy = 0;  ///< Σ yᵀP⁻¹y of the right-hand side [J]
  int negative = 0;

  template <int N>
  [[gnu::always_inline]] void see(const Ldlt<S, N>& factor, const Symmetric<S, N>& assembled) noexcept {
    HAPBEAM_UNROLL
    for (int k = 0; k < N; ++k) see(factor.p[k], assembled(k, k));
  }

 private:
  void see(S pivot, S assembled) noexcept {
    using std::abs;
    const S left = abs(pivot) - std::numeric_limits<S>::epsilon() * abs(assembled);
    if (lowest > 0 && !(left >= lowest)) lowest = left;
    negative += pivot < 0;
  }
};

}  // namespace detail

}  // namespace hapbeam
