// SPDX-License-Identifier: MIT
// Vectors of a few numbers.
//
// Their sums and multiples are vectors, and not expressions, of which a compiler makes some forty functions each.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <type_traits>

#include <Eigen/Core>

#include <hapbeam/unroll.hpp>

namespace hapbeam {

template <typename Scalar, int D>
using VectorOf = Eigen::Matrix<Scalar, D, 1>;
template <typename Scalar>
using Vector2 = VectorOf<Scalar, 2>;

namespace detail {

/// @tparam T  by which it is multiplied
template <typename S, int D, typename T = S>
using FewOf = std::enable_if_t<(D > 1 && D < 5 && std::is_convertible_v<T, S>), VectorOf<S, D>>;

/// @param f  k -> component k
template <typename S, int D, class F>
[[gnu::always_inline]] inline VectorOf<S, D> vector_of(F&& f) noexcept {
  VectorOf<S, D> v;
  HAPBEAM_UNROLL
  for (int k = 0; k < D; ++k) v[k] = f(k);
  return v;
}

}  // namespace detail

template <typename S, int D>
[[gnu::always_inline]] inline detail::FewOf<S, D> operator+(const Eigen::Matrix<S, D, 1>& a,
                                                            const Eigen::Matrix<S, D, 1>& b) noexcept {
  return detail::vector_of<S, D>([&](int k) HAPBEAM_INLINED { return S(a[k] + b[k]); });
}
template <typename S, int D>
[[gnu::always_inline]] inline detail::FewOf<S, D> operator-(const Eigen::Matrix<S, D, 1>& a,
                                                            const Eigen::Matrix<S, D, 1>& b) noexcept {
  return detail::vector_of<S, D>([&](int k) HAPBEAM_INLINED { return S(a[k] - b[k]); });
}
template <typename S, int D>
[[gnu::always_inline]] inline detail::FewOf<S, D> operator-(const Eigen::Matrix<S, D, 1>& a) noexcept {
  return detail::vector_of<S, D>([&](int k) HAPBEAM_INLINED { return S(-a[k]); });
}
template <typename S, int D, typename T>
[[gnu::always_inline]] inline detail::FewOf<S, D, T> operator*(const T& by,
                                                               const Eigen::Matrix<S, D, 1>& a) noexcept {
  return detail::vector_of<S, D>([&a, x = S(by)](int k) HAPBEAM_INLINED { return S(x * a[k]); });
}
template <typename S, int D, typename T>
[[gnu::always_inline]] inline detail::FewOf<S, D, T> operator*(const Eigen::Matrix<S, D, 1>& a,
                                                               const T& by) noexcept {
  return by * a;
}
template <typename S, int D, typename T>
[[gnu::always_inline]] inline detail::FewOf<S, D, T> operator/(const Eigen::Matrix<S, D, 1>& a,
                                                               const T& by) noexcept {
  return detail::vector_of<S, D>([&a, x = S(by)](int k) HAPBEAM_INLINED { return S(a[k] / x); });
}

}  // namespace hapbeam
