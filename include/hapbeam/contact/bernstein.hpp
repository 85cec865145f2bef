// SPDX-License-Identifier: MIT
// Where a polynomial in Bernstein form changes sign on [0, 1], and the root polished there.
//
// The coefficients bound the polynomial and change sign at least as often as it does. No change means no root, and one
// change one root. Intervals with more are halved until the roots separate (variation diminishing: Lane and Riesenfeld,
// "Bounds on a polynomial", BIT 21, 1981). Zero counts as positive, so a root on the border of two intervals, or of two
// pieces of a curve, is counted once.
// No allocation, noexcept, bounded work.
#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace hapbeam::detail {

template <typename Scalar, int Degree>
using Bernstein = std::array<Scalar, Degree + 1>;

/// A parameter interval in which a polynomial changes sign once.
template <typename Scalar>
struct SignChange {
  Scalar low, high;  ///< 0 <= low < high <= 1
  Scalar guess;      ///< where the control polygon crosses zero
  bool rising;       ///< from negative to positive
};

/// Number of sign changes in the coefficients, 2 standing for more; position of the only one in `at`.
template <typename Scalar, std::size_t N>
[[gnu::always_inline]] inline int sign_changes(const std::array<Scalar, N>& c, int& at) noexcept {
  unsigned signs = 0;
  for (std::size_t k = 0; k < N; ++k) signs |= static_cast<unsigned>(c[k] < 0) << k;
  const unsigned changes = (signs ^ (signs >> 1)) & ((1U << (N - 1)) - 1);
  if (changes == 0) return 0;
  if ((changes & (changes - 1)) != 0) return 2;
  for (at = 0; (changes >> at) != 1;) ++at;
  return 1;
}

/// The coefficients on the left half of the interval; those on the right half replace c (de Casteljau).
template <typename Scalar, std::size_t N>
std::array<Scalar, N> split_in_half(std::array<Scalar, N>& c) noexcept {
  std::array<Scalar, N> left{};
  for (std::size_t level = 0; level < N; ++level) {
    left[level] = c[0];
    for (std::size_t k = 0; k + 1 + level < N; ++k) c[k] = (c[k] + c[k + 1]) / 2;
  }
  // The triangle's right edge is left behind in c, in the right order: c[k] was last written at level N-1-k.
  return left;
}

template <typename Scalar, std::size_t N>
SignChange<Scalar> bracket(const std::array<Scalar, N>& c, int at, Scalar low, Scalar width) noexcept {
  const std::size_t k = static_cast<std::size_t>(at);
  const Scalar knot = static_cast<Scalar>(at) + c[k] / (c[k] - c[k + 1]);
  return {low, low + width, low + width * knot / static_cast<Scalar>(N - 1), c[0] < 0};
}

/// Calls visit(SignChange) for each interval, in no particular order.  Roots closer than sqrt(eps) may be
/// reported as one, or, where they cancel (a double root), not at all: the polynomial is zero to round-off
/// there.
/// Real-time: noexcept, no allocation, at most `budget` halvings.
template <typename Scalar, std::size_t N, typename Visit>
void for_each_sign_change(const std::array<Scalar, N>& coefficients, Visit&& visit) noexcept {
  int at = 0;
  const int changes = sign_changes(coefficients, at);
  if (changes == 0) return;
  if (changes == 1) return visit(bracket(coefficients, at, Scalar(0), Scalar(1)));

  struct Interval {
    std::array<Scalar, N> c;
    Scalar low, width;
  };
  constexpr int deepest = std::numeric_limits<Scalar>::digits / 2;
  // At most (N-1)/2 intervals of one width still hold two changes, so this is never the stop that counts.
  constexpr int budget = 2 * deepest * static_cast<int>(N);
  const Scalar finest = std::ldexp(Scalar(1), -deepest);
  Interval stack[deepest + 2];
  int size = 0;
  stack[size++] = {coefficients, 0, 1};
  for (int work = 0; size > 0 && work < budget; ++work) {
    Interval& right = stack[size - 1];
    const int found = sign_changes(right.c, at);
    if (found <= 1 || right.width <= finest) {
      if ((right.c.front() < 0) != (right.c.back() < 0)) visit(bracket(right.c, at, right.low, right.width));
      --size;
      continue;
    }
    right.width /= 2;
    Interval left{{}, right.low, right.width};
    left.c = split_in_half(right.c);
    right.low += right.width;
    stack[size++] = left;
  }
}

/// Value and slope of a function at one parameter.
template <typename Scalar>
struct ValueSlope {
  Scalar value, slope;
};

/// The root of f in a bracket: Newton, and bisection where Newton would leave the bracket.
/// Stops when a step is below sqrt(eps), after which the error of a simple root is of the order of eps.
/// @param f  t -> ValueSlope     Real-time: noexcept, no allocation, at most 64 evaluations.
template <typename Scalar, typename F>
Scalar polish_root(const SignChange<Scalar>& bracket, F&& f) noexcept {
  const Scalar tolerance = std::ldexp(Scalar(1), -std::numeric_limits<Scalar>::digits / 2);
  Scalar low = bracket.low, high = bracket.high, t = bracket.guess;
  for (int i = 0; i < 64; ++i) {
    const ValueSlope<Scalar> at = f(t);
    if ((at.value < 0) == bracket.rising) low = t;
    else high = t;
    Scalar next = t - at.value / at.slope;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const Scalar step = std::abs(next - t);
    t = next;
    if (step <= tolerance) break;
  }
  return t;
}

}  // namespace hapbeam::detail
