// A value with its first two derivatives by one parameter, as the coefficients of its Taylor polynomial,
//
//   f(x + h) = c0 + c1 h + c2 h² + …
//
// The functions below exist for plain values as well, so that a recursion that is written once runs with its derivatives or
// without.
// Real-time: noexcept, no allocation, O(1).   Source: Griewank and Walther, Evaluating Derivatives, 2008, ch. 13.
#pragma once

#include <hapbeam/fem/solver/lanes.hpp>

namespace hapbeam::detail {

/// @tparam V  a scalar, or Lanes
template <typename V>
struct Taylor {
  V c0, c1, c2;
};

/// a + bc
[[gnu::always_inline]] inline float add_product(float a, float b, float c) noexcept { return a + b * c; }
[[gnu::always_inline]] inline double add_product(double a, double b, double c) noexcept { return a + b * c; }
[[gnu::always_inline]] inline long double add_product(long double a, long double b, long double c) noexcept {
  return a + b * c;
}
template <typename V>
[[gnu::always_inline]] inline Taylor<V> add_product(const Taylor<V>& a, const Taylor<V>& b,
                                                    const Taylor<V>& c) noexcept {
  return {add_product(a.c0, b.c0, c.c0), add_product(add_product(a.c1, b.c0, c.c1), b.c1, c.c0),
          add_product(add_product(add_product(a.c2, b.c0, c.c2), b.c1, c.c1), b.c2, c.c0)};
}

template <typename V>
[[gnu::always_inline]] inline Taylor<V> operator+(const Taylor<V>& a, const Taylor<V>& b) noexcept {
  return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2};
}
template <typename V>
[[gnu::always_inline]] inline Taylor<V> operator-(const Taylor<V>& a, const Taylor<V>& b) noexcept {
  return {a.c0 - b.c0, a.c1 - b.c1, a.c2 - b.c2};
}
template <typename V>
[[gnu::always_inline]] inline Taylor<V> operator*(const Taylor<V>& a, const Taylor<V>& b) noexcept {
  return {a.c0 * b.c0, add_product(V(a.c0 * b.c1), a.c1, b.c0),
          add_product(add_product(V(a.c0 * b.c2), a.c1, b.c1), a.c2, b.c0)};
}

/// a times a constant
template <typename V>
[[gnu::always_inline]] inline V scaled(const V& constant, const V& a) noexcept {
  return constant * a;
}
template <typename V>
[[gnu::always_inline]] inline Taylor<V> scaled(const V& constant, const Taylor<V>& a) noexcept {
  return {constant * a.c0, constant * a.c1, constant * a.c2};
}

/// 1/a
template <typename Scalar>
[[gnu::always_inline]] inline Scalar inverse(const Scalar& a) noexcept {
  return 1 / a;
}
template <typename Scalar>
[[gnu::always_inline]] inline Lanes<Scalar> inverse(const Lanes<Scalar>& a) noexcept {
  return Lanes<Scalar>::both(1) / a;
}
template <typename V>
[[gnu::always_inline]] inline Taylor<V> inverse(const Taylor<V>& a) noexcept {
  const V i = inverse(a.c0), j = -(a.c1 * i * i);
  return {i, j, -(add_product(V(a.c2 * i), a.c1, j) * i)};
}

/// The value alone.
template <typename V>
[[gnu::always_inline]] inline const V& value(const V& a) noexcept {
  return a;
}
template <typename V>
[[gnu::always_inline]] inline const V& value(const Taylor<V>& a) noexcept {
  return a.c0;
}

}  // namespace hapbeam::detail
