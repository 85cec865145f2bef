// SPDX-License-Identifier: MIT
// Angles and directions in the plane, in a third of the instructions of the standard library, mostly without branches.
//
// The angle of a vector whose length is known is 2 atan r, r = y/(|v| + x).  Up to a right angle r is at most 1, and atan r / r a
// polynomial in r², by interpolation at Chebyshev's nodes: relative error 4e-17.  Directions are Taylor's series after the angle was
// brought below π/4.  Both have the last place but one.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

#include <Eigen/Core>

#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// π/2 in three parts, high + low + last.  The first two have so few digits that multiples by a thousand are exact.
template <typename S>
inline constexpr S high_quarter = S(1.57079632673412561417e+00);
template <typename S>
inline constexpr S low_quarter = S(6.07710050630396597660e-11);
template <typename S>
inline constexpr S last_quarter = S(2.02226624879595063154e-21);
template <>
inline constexpr float high_quarter<float> = 1.5703125f;
template <>
inline constexpr float low_quarter<float> = 4.837512969970703125e-4f;
template <>
inline constexpr float last_quarter<float> = 7.54978995489188216e-8f;

/// 2 atan r, |r| <= 1.
template <typename S>
[[gnu::always_inline]] inline S twice_atan(const S& r) noexcept {
  const S q = r * r, q2 = q * q, q4 = q2 * q2, q8 = q4 * q4;
  const auto four = [q, q2](double a, double b, double c, double d) {
    return (S(a) + q * S(b)) + q2 * (S(c) + q * S(d));
  };
  const S low =
      four(-0.333333333333307019, 0.199999999996479603, -0.14285714266926734, 0.111111105780020824) +
      q4 * four(-0.0909089979321734102, 0.0769219899745829418, -0.0666576491068972235, 0.0587682811448727217);
  const S high =
      four(-0.0523742347191881684, 0.0466874530484852871, -0.0408112475031788523, 0.0338712670270067489) +
      q4 * four(-0.0255686236443717393, 0.0167195960635073887, -0.00899108054265826073,
                0.00375113848396514119);
  const S last =
      S(-0.00112525443022346454) + q * S(0.000214238107386039468) - q2 * S(0.0000193423475928922986);
  return 2 * (r + r * q * (low + q8 * (high + q8 * last)));
}

/// atan2(y, x).  @param length  √(x² + y²)
template <typename S>
[[gnu::always_inline]] inline S angle(S y, S x, S length) noexcept {
  using std::abs;
  using std::atan2;
  const S whole = length + x;
  return abs(y) < whole ? twice_atan(y / whole) : atan2(y, x);
}

/// The same, in the turn nearest to another angle.
template <typename S>
[[gnu::always_inline]] inline S angle_near(S y, S x, S length, S other) noexcept {
  using std::abs;
  using std::nearbyint;
  constexpr S turn = S(6.283185307179586476925);
  const S principal = angle(y, x, length), turns = (principal - other) * (1 / turn);
  return abs(turns) < S(0.5) ? principal : principal - turn * nearbyint(turns);
}

/// cos x and sin x, |x| <= 0.79.
template <typename S>
[[gnu::always_inline]] inline void small_turn(const S& x, S& cosine, S& sine) noexcept {
  const S q = x * x, q2 = q * q, q4 = q2 * q2;
  sine = x + x * q *
                 ((S(-1. / 6) + q * S(1. / 120)) + q2 * (S(-1. / 5040) + q * S(1. / 362880)) +
                  q4 * ((S(-1. / 39916800) + q * S(1. / 6227020800.)) - q2 * S(1. / 1307674368000.)));
  cosine = 1 - q / 2 +
           q2 * ((S(1. / 24) - q * S(1. / 720)) + q2 * (S(1. / 40320) - q * S(1. / 3628800)) +
                 q4 * ((S(1. / 479001600) - q * S(1. / 87178291200.)) + q2 * S(1. / 20922789888000.)));
}

template <typename S>
void cos_and_sin(const S& alpha, S& cosine, S& sine) noexcept {
  using std::abs;
  using std::cos;
  using std::sin;
  if (sizeof(S) <= sizeof(double) && abs(alpha) < S(0.79)) small_turn(alpha, cosine, sine);
  else cosine = cos(alpha), sine = sin(alpha);
}

/// cos √q and sin √q / √q, 0 <= q < 0.25: the first term of Taylor's series that is left out is below 1e-17.
template <typename S>
[[gnu::always_inline]] inline void small_square_turn(const S& q, S& cosine, S& sine) noexcept {
  const S q2 = q * q, q4 = q2 * q2;
  cosine = ((1 - q * S(1. / 2)) + q2 * (S(1. / 24) - q * S(1. / 720))) +
           q4 * ((S(1. / 40320) - q * S(1. / 3628800)) + q2 * (S(1. / 479001600) - q * S(1. / 87178291200.)));
  sine = ((1 - q * S(1. / 6)) + q2 * (S(1. / 120) - q * S(1. / 5040))) +
         q4 * ((S(1. / 362880) - q * S(1. / 39916800)) +
               q2 * (S(1. / 6227020800.) - q * S(1. / 1307674368000.)));
}
/// The same of any q >= 0.
template <typename S>
void cos_and_sin_of_square(const S& q, S& cosine, S& sine) noexcept {
  using std::cos;
  using std::sin;
  using std::sqrt;
  if (q < S(0.25)) return small_square_turn(q, cosine, sine);
  const S angle = sqrt(q);
  cosine = cos(angle), sine = sin(angle) / angle;
}

template <typename S>
[[gnu::always_inline]] inline Eigen::Matrix<S, 2, 1> direction(S alpha) noexcept {
  using std::abs;
  using std::cos;
  using std::nearbyint;
  using std::sin;
  S sine, cosine;
  // Most are below an eighth of a turn: the same numbers in half of the instructions.
  if (abs(alpha) < S(0.785)) return small_turn(alpha, cosine, sine), Eigen::Matrix<S, 2, 1>(cosine, sine);
  if (!(abs(alpha) < 1000)) return {cos(alpha), sin(alpha)};
  const S quarters = nearbyint(alpha * S(0.636619772367581343)),
          x = ((alpha - quarters * high_quarter<S>)-quarters * low_quarter<S>)-quarters * last_quarter<S>;
  small_turn(x, cosine, sine);
  const int turn = static_cast<int>(quarters);
  const S c = turn & 1 ? sine : cosine, s = turn & 1 ? cosine : sine;
  return {(turn + 1) & 2 ? -c : c, turn & 2 ? -s : s};
}

}  // namespace hapbeam::detail
