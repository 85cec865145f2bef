// The one loop that a trained model spends its time in: a linear combination of columns.
//
// Real-time: noexcept, no allocation, O(rows × columns).
#pragma once

#include <cstddef>

namespace hapbeam::detail {

/// y = Σ_k x_k a_k with a_k the first `rows` of the k-th run of `stride` numbers of A.  Four columns at a time, so that y is
/// read and written once for each four.  Eigen's product is as fast at -O3, and takes half as long to compile as all of
/// Eigen/Core.
/// @param y  out, rows values
template <typename Scalar>
[[gnu::noinline]] void combine(const Scalar* A, int stride, int rows, const Scalar* x, int columns,
                               Scalar* y) noexcept {
  for (int r = 0; r < rows; ++r) y[r] = 0;
  int k = 0;
  for (; k + 4 <= columns; k += 4, A += 4 * static_cast<std::ptrdiff_t>(stride)) {
    const Scalar *a = A, *b = a + stride, *c = b + stride, *d = c + stride;
    const Scalar p = x[k], q = x[k + 1], s = x[k + 2], t = x[k + 3];
    for (int r = 0; r < rows; ++r) y[r] += (p * a[r] + q * b[r]) + (s * c[r] + t * d[r]);
  }
  for (; k < columns; ++k, A += stride)
    for (int r = 0; r < rows; ++r) y[r] += x[k] * A[r];
}

/// Σ x_k y_k
template <typename Scalar>
Scalar dot(const Scalar* x, const Scalar* y, int size) noexcept {
  Scalar sum = 0;
  for (int k = 0; k < size; ++k) sum += x[k] * y[k];
  return sum;
}

}  // namespace hapbeam::detail
