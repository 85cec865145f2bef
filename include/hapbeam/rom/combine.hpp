// The one loop that a trained model spends its time in: a linear combination of columns.
//
// Real-time: noexcept, no allocation, O(rows × columns).
#pragma once

#include <Eigen/Core>

namespace hapbeam::detail {

/// y = Σ_k x_k a_k with a_k the k-th run of `rows` numbers of A.   @param y  out, rows values
/// Eigen's product, because it is vectorised at every optimisation level: a loop is not at -O2.
template <typename Scalar>
void combine(const Scalar* A, int rows, const Scalar* x, int columns, Scalar* y) noexcept {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  Eigen::Map<Vector>(y, rows).noalias() =
      Eigen::Map<const Matrix>(A, rows, columns) * Eigen::Map<const Vector>(x, columns);
}

/// Σ x_k y_k
template <typename Scalar>
Scalar dot(const Scalar* x, const Scalar* y, int size) noexcept {
  Scalar sum = 0;
  for (int k = 0; k < size; ++k) sum += x[k] * y[k];
  return sum;
}

}  // namespace hapbeam::detail
