// SPDX-License-Identifier: MIT
// Vectors of a few numbers, and loops of known length that are to be written out: HAPBEAM_UNROLL stands before those.
//
// g++ -O2 does not unroll short loops over small matrices, which then go through memory.  clang does not where the length depends on an
// argument of the function: for_each_constant() makes such an argument a constant.
// Sums and multiples of vectors are vectors, and not expressions, of which a compiler makes some forty functions each.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <type_traits>

#include <Eigen/Core>

#if defined(__clang__)
#define HAPBEAM_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define HAPBEAM_UNROLL _Pragma("GCC unroll 16")
#else
#define HAPBEAM_UNROLL
#endif

/// Behind the arguments of a lambda that is to be inlined wherever it is called.
#if defined(__GNUC__)
#define HAPBEAM_INLINED __attribute__((always_inline))
#else
#define HAPBEAM_INLINED
#endif

/// A compiler reads memory anew behind this.  In a loop it keeps numbers out of registers where those are too few.
#if defined(__GNUC__)
#define HAPBEAM_KEEP_IN_MEMORY() asm volatile("" : : : "memory")
#else
#define HAPBEAM_KEEP_IN_MEMORY() static_cast<void>(0)
#endif

namespace hapbeam {

template <typename Scalar, int D>
using VectorOf = Eigen::Matrix<Scalar, D, 1>;
template <typename Scalar>
using Vector2 = VectorOf<Scalar, 2>;

namespace detail {

template <int K>
inline constexpr std::integral_constant<int, K> constant{};

/// Calls f(constant<k>) for each k from From to End - 1.
template <int From, int End, class F>
[[gnu::always_inline]] inline void for_each_constant(F&& f) noexcept {
  if constexpr (From < End) {
    f(constant<From>);
    for_each_constant<From + 1, End>(f);
  }
}

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
