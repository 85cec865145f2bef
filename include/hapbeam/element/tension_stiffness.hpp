// SPDX-License-Identifier: MIT
// How stiff a straight piece of a beam is against rotations of its ends, under a tension N that is the same all along it.
//
//   EI w'''' = N w'',   V = EI/(4l³) (B (a + b)² + A (a - b)²) + N rise²/(2l),     q = N l²/EI
//
// with a, b the end slopes against the chord, times -l.  A belongs to the symmetric half of the bending, B to the antisymmetric one:
//
//   z = √q,   A = z coth(z/2),   B = q/(A - 2)          A = 2, B = 6 without tension; z cot and so on in compression
//
// A piece with a hinge at its far end is half of an antisymmetric one of twice its length, a guided one half of a symmetric one:
// B(4q)/2 and A(4q)/2 stand for them.
// Up to |q| = 16 the functions come from Gauss's continued fraction, whose terms are all positive under tension,
//
//   B = 6 + q h,   h = ½/(5 + p c),   c = 1/(7 + p/(9 + p/(11 + …))),   p = q/4,   A = 2 + q/B
//
// by its convergent to 1e-17, and their derivatives from Riccati's equation, without a difference of what is nearly equal:
//
//   B' = (1 - B h)/4,   h' = h (c/2 - h)/4,   A' = (1 - q B'/B)/B
//
// Tension, compression and none have this one form.  Beyond it all is written in e^-z.  A piece under more compression than 16 EI/l²
// goes on by parabolas: Euler's load of its clamped ends is 39.5.
// Real-time: noexcept, no allocation, O(1).
// Source: stability functions: Livesley and Chandler, Stability Functions for Structural Frameworks, 1956.
#pragma once

#include <array>
#include <cmath>

#include <hapbeam/element/pack.hpp>

namespace hapbeam::detail {

template <typename S>
[[gnu::always_inline]] inline S larger(const S& a, const S& b) noexcept {
  return a < b ? b : a;
}
template <typename S>
[[gnu::always_inline]] inline bool all_less(const S& a, const S& b) noexcept {
  return a < b;
}

/// A and B with their first two derivatives by q.  a, b: what tension adds, A - 2 and B - 6, without cancellation.
template <typename S>
struct TensionStiffness {
  S a, a1, a2, b, b1, b2;

  S A() const noexcept { return 2 + a; }
  S B() const noexcept { return 6 + b; }
};

/// Numerator and denominator of c over p, scaled to 1/7 and 1 at p = 0.
struct TensionFraction {
  static constexpr int terms = 10, degree = terms / 2;
  std::array<double, degree + 1> above{}, below{};

  constexpr TensionFraction() {
    // n_k = (2k + 7) n_(k+1) + p n_(k+2), from the last term up: c = n_1/n_0
    std::array<double, degree + 1> next{}, now{};
    next[0] = 1, now[0] = 2 * terms + 5;
    for (int k = terms - 2; k >= 0; --k) {
      std::array<double, degree + 1> before{};
      for (std::size_t i = 0; i < before.size(); ++i)
        before[i] = (2 * k + 7) * now[i] + (i > 0 ? next[i - 1] : 0);
      next = now, now = before;
    }
    for (std::size_t i = 0; i < now.size(); ++i) above[i] = next[i] / now[0], below[i] = now[i] / now[0];
  }
};

template <typename S, std::size_t N>
[[gnu::always_inline]] inline S polynomial(const std::array<double, N>& c, const S& x) noexcept {
  S sum = S(c[N - 1]);
  for (std::size_t i = N - 1; i-- > 0;) sum = add_product(S(c[i]), sum, x);
  return sum;
}

/// |q| <= 16
template <typename S>
[[gnu::always_inline]] inline TensionStiffness<S> under_little_tension(const S& q) noexcept {
  static constexpr TensionFraction fraction;
  const S p = q * S(0.25), above = polynomial(fraction.above, p), below = polynomial(fraction.below, p);
  const S half = S(0.5) / add_product(S(5 * below), p, above), h = half * below, ch = half * above;
  TensionStiffness<S> k;
  k.b = q * h;
  const S B = 6 + k.b;
  k.b1 = (1 - B * h) * S(0.25);
  const S h1 = (ch * S(0.5) - h * h) * S(0.25);
  k.b2 = (k.b1 * h + B * h1) * S(-0.25);
  const S j = 1 / B;
  k.a = q * j;
  k.a1 = j * (1 - k.a * k.b1);
  k.a2 = -j * (k.a * k.b2 + 2 * k.b1 * k.a1);
  return k;
}

/// q >= 16
template <typename S>
TensionStiffness<S> under_much_tension(S q) noexcept {
  using std::exp;
  using std::sqrt;
  const S z = sqrt(q), p = exp(-z), i = 1 / (1 - p), pi = p * i, half = 1 / (2 * q);
  TensionStiffness<S> k;
  const S A = z * (1 + p) * i;
  k.a = A - 2;
  k.a1 = A * half - pi * i;
  k.a2 = (k.a1 - A / q) * half + pi * (1 + p) * i * i / (2 * z);
  const S j = 1 / k.a, B = q * j;
  k.b = B - 6;
  k.b1 = (1 - B * k.a1) * j;
  k.b2 = -(2 * k.a1 * k.b1 + B * k.a2) * j;
  return k;
}

/// Of any q.
template <typename S>
inline TensionStiffness<S> tension_stiffness(const S& q) noexcept {
  constexpr S border = 16;
  if (q >= border) return under_much_tension(q);
  if (!(q < -border)) return under_little_tension(q);
  TensionStiffness<S> k = under_little_tension(-border);
  const S by = q + border;
  k.a += by * (k.a1 + by * k.a2 / 2), k.a1 += by * k.a2;
  k.b += by * (k.b1 + by * k.b2 / 2), k.b1 += by * k.b2;
  return k;
}
/// Those of a cubic, which its consistent mass goes with.
template <typename S>
[[gnu::always_inline]] inline TensionStiffness<S> tension_stiffness_of_cubic(const S& q) noexcept {
  return {S(1. / 6) * q, S(1. / 6), S(0), S(0.1) * q, S(0.1), S(0)};
}
template <typename T, int Size>
[[gnu::always_inline]] inline TensionStiffness<Pack<T, Size>> tension_stiffness(
    const Pack<T, Size>& q) noexcept {
  if (all_less(q * q, Pack<T, Size>(256))) return under_little_tension(q);
  TensionStiffness<Pack<T, Size>> all;
  for (int i = 0; i < Size; ++i) {
    const TensionStiffness<T> k = tension_stiffness(q[i]);
    all.a.set(i, k.a), all.a1.set(i, k.a1), all.a2.set(i, k.a2);
    all.b.set(i, k.b), all.b1.set(i, k.b1), all.b2.set(i, k.b2);
  }
  return all;
}

}  // namespace hapbeam::detail
