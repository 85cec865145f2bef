// SPDX-License-Identifier: MIT
// A number with its first and second derivatives by a few variables.
//
// Real-time: noexcept, no allocation, O(variables²).
// Source: forward differentiation, Griewank and Walther, Evaluating Derivatives, 2008, chapters 3 and 13.
#pragma once

#include <array>
#include <cstddef>

namespace hapbeam::detail {

/// @tparam V  variables
template <typename S, int V>
struct Jet {
  static constexpr std::size_t first = V, second = V * (V + 1) / 2;

  S value = 0;
  std::array<S, first> d{};
  std::array<S, second> dd{};  ///< by i and j <= i, row by row

  Jet() = default;
  Jet(S constant) noexcept : value(constant) {}
  static Jet variable(S value, int i) noexcept {
    Jet x(value);
    x.d[static_cast<std::size_t>(i)] = 1;
    return x;
  }
  const S& by(int i) const noexcept { return d[static_cast<std::size_t>(i)]; }
  const S& by(int i, int j) const noexcept {
    return i < j ? by(j, i) : dd[static_cast<std::size_t>(i * (i + 1) / 2 + j)];
  }

  /// f of it.  @param f0, f1, f2  f and its derivatives there
  Jet composed(const S& f0, const S& f1, const S& f2) const noexcept {
    Jet y(f0);
    for (std::size_t i = 0, k = 0; i < first; ++i) {
      y.d[i] = f1 * d[i];
      for (std::size_t j = 0; j <= i; ++j, ++k) y.dd[k] = f1 * dd[k] + f2 * d[i] * d[j];
    }
    return y;
  }
  friend Jet inverse(const Jet& x) noexcept {
    const S y = 1 / x.value;
    return x.composed(y, -y * y, 2 * y * y * y);
  }
  friend Jet operator+(Jet x, const Jet& y) noexcept {
    x.value += y.value;
    for (std::size_t i = 0; i < first; ++i) x.d[i] += y.d[i];
    for (std::size_t k = 0; k < second; ++k) x.dd[k] += y.dd[k];
    return x;
  }
  friend Jet operator*(const S& a, Jet x) noexcept {
    x.value *= a;
    for (S& e : x.d) e *= a;
    for (S& e : x.dd) e *= a;
    return x;
  }
  friend Jet operator-(const Jet& x, const Jet& y) noexcept { return x + S(-1) * y; }
  friend Jet operator*(const Jet& x, const Jet& y) noexcept {
    Jet z(x.value * y.value);
    for (std::size_t i = 0, k = 0; i < first; ++i) {
      z.d[i] = x.value * y.d[i] + y.value * x.d[i];
      for (std::size_t j = 0; j <= i; ++j, ++k)
        z.dd[k] = x.value * y.dd[k] + y.value * x.dd[k] + x.d[i] * y.d[j] + y.d[i] * x.d[j];
    }
    return z;
  }
};

}  // namespace hapbeam::detail
