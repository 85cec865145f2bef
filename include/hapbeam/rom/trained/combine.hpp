// SPDX-License-Identifier: MIT
// The one loop that a trained model spends its time in: a linear combination of columns.
//
// Real-time: noexcept, no allocation, O(rows × columns).
#pragma once

#include <Eigen/Core>

namespace hapbeam::detail {

template <int Rows, typename Scalar>
[[gnu::always_inline]] inline void combine_rows(const Scalar* a, int stride, const Scalar* x, int columns,
                                                Scalar* y) noexcept {
  using Column = Eigen::Array<Scalar, Rows, 1>;
  Column sum = Column::Zero();
  for (int k = 0; k < columns; ++k, a += stride) sum += x[k] * Eigen::Map<const Column>(a);
  Eigen::Map<Column>{y} = sum;
}

/// y = Σ_k x_k a_k with a_k the first `rows` of the k-th run of `stride` numbers of A.  So many rows at a time as registers
/// hold, through all columns: A is read once and y is written once.  Quickest where rows is a multiple of eight.
/// @param y  out, rows values
template <typename Scalar>
[[gnu::noinline]] void combine(const Scalar* A, int stride, int rows, const Scalar* x, int columns,
                               Scalar* y) noexcept {
  constexpr int wide = 32, half = 16, narrow = 8;
  int r = 0;
  for (; r + wide <= rows; r += wide) combine_rows<wide>(A + r, stride, x, columns, y + r);
  for (; r + half <= rows; r += half) combine_rows<half>(A + r, stride, x, columns, y + r);
  for (; r + narrow <= rows; r += narrow) combine_rows<narrow>(A + r, stride, x, columns, y + r);
  for (; r < rows; ++r) combine_rows<1>(A + r, stride, x, columns, y + r);
}

/// The next multiple of eight.
constexpr int padded(int rows) noexcept { return (rows + 7) / 8 * 8; }

/// Σ x_k y_k
template <typename Scalar>
Scalar dot(const Scalar* x, const Scalar* y, int size) noexcept {
  Scalar sum = 0;
  for (int k = 0; k < size; ++k) sum += x[k] * y[k];
  return sum;
}

}  // namespace hapbeam::detail
