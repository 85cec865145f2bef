// SPDX-License-Identifier: MIT
// A piece of a beam whose ends are held, under a tension N that is the same all along it, cut at a place: what that does as an end turns, and under a force.
//
//   EI w'''' = N w'',     n = N/EI,  X = l - x
//
// Both parts have the stiffness of tension_stiffness.hpp, A1, B1 of n x² and A2, B2 of n X².  With deflection and slope of the cut as unknowns, and
// no length as a divisor, so that the cut may be as near to an end as it likes:
//
//   ww = 2 B1 X³ + 2 B2 x³ + n x² X² l,   wt = B2 x² - B1 X²,   tt = ((A1 + B1) X + (A2 + B2) x)/2,   D = ww tt - wt²
//
//   EI g = x³ X³ tt/D,   EI g' = -x² X² wt/D,   ψ = x X² (tt B1 X + wt (B1 - A1)/2)/D
//
// Without tension ψ is the cubic of Hermite, and EI g = x³ X³/3 l³.
// Real-time: noexcept, no allocation, O(1).
// Source: derived here; docs/theory.md, Contact within an element of a rod.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include <hapbeam/element/tension_stiffness.hpp>

namespace hapbeam::detail {

/// A number with its first and second derivatives by V variables.   Source: forward differentiation, Griewank and Walther, Evaluating Derivatives,
/// 2008, chapters 3 and 13.
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

/// @tparam J  Jet: derivatives by whatever its arguments depend on
template <class J>
struct CutPiece {
  J left, right;  ///< deflection as the left end, or the right one, turns by 1 against the chord [m]
  J g, slope;     ///< deflection and slope under a force, times EI [m³], [m²]
  J rise;         ///< g/(l - x) [m²]
  J chord;        ///< x/l
  decltype(J::value) bend;  ///< curvature under a force at the cut, times EI [m]

  /// @param l, x, n  length, place of the cut [m], N/EI [1/m²]
  CutPiece(const J& l, const J& x, const J& n) noexcept;
  /// Of a curve whose nodes hold places and tangents: how much it has of r1, r1', r2 and r2'.   @param inverse  1/l   @param h  out
  template <typename S>
  void weights(S inverse, J (&h)[4]) const noexcept {
    h[1] = left, h[3] = right;
    h[2] = chord - inverse * (left + right);
    h[0] = J(1) - h[2];
  }
};

// Outside of the class: only so does "extern template struct CutPiece<…>;" keep a compiler from it.
template <class J>
[[gnu::flatten]] CutPiece<J>::CutPiece(const J& l, const J& x, const J& n) noexcept {
  using S = std::decay_t<decltype(x.value)>;
  const S half = S(0.5);
  const J X = l - x, xx = x * x, XX = X * X, q1 = n * xx, q2 = n * XX, both = x * X, square = both * both;
  const TensionStiffness<S> k1 = tension_stiffness(q1.value), k2 = tension_stiffness(q2.value);
  const J A1 = q1.composed(k1.A(), k1.a1, k1.a2), B1 = q1.composed(k1.B(), k1.b1, k1.b2),
          A2 = q2.composed(k2.A(), k2.a1, k2.a2), B2 = q2.composed(k2.B(), k2.b1, k2.b2);
  const J ww = S(2) * (B1 * (XX * X) + B2 * (xx * x)) + n * square * l, wt = B2 * xx - B1 * XX,
          tt = half * ((A1 + B1) * X + (A2 + B2) * x), over = inverse(ww * tt - wt * wt),
          of_square = square * over;
  rise = of_square * x * tt;
  g = rise * X;
  slope = S(-1) * (of_square * wt);
  left = both * X * over * (tt * B1 * X + half * (wt * (B1 - A1)));
  right = S(-1) * (both * x * over * (tt * B2 * x - half * (wt * (B2 - A2))));
  chord = x * inverse(l);
  bend = -both.value * X.value * over.value *
         (B1.value * X.value * tt.value + half * (A1 + B1).value * wt.value);
}

/// The same without tension, by polynomials: derivatives by x, which is variable 0, are all that there are.
/// @param h  out: as of weights()   @param g  out   @return bend
template <typename S, class J>
[[gnu::always_inline]] inline S cut_slack_piece(S l, S x, J (&h)[4], J& g) noexcept {
  const S i = 1 / l, f = x * i, e = 1 - f, both = x * e, rise = e - f, slope = 6 * f * e * i,
          turn = 6 * rise * i * i;
  const auto set = [](J& of, S value, S first, S second) {
    of.value = value, of.d[0] = first, of.dd[0] = second;
  };
  const S second = f * f * (3 - 2 * f);
  set(h[0], 1 - second, -slope, -turn), set(h[2], second, slope, turn);
  set(h[1], both * e, 1 + f * (3 * f - 4), (6 * f - 4) * i);
  set(h[3], -both * f, f * (3 * f - 2), (6 * f - 2) * i);
  set(g, both * both * both / 3, both * both * rise, 2 * both * (rise * rise - both * i));
  return -2 * both * both * i;
}

/// How two places of it yield to each other, times EI [m³].   @param x, y  x <= y
template <class J>
J between_cuts(const J& l, const J& x, const J& y, const J& n) noexcept {
  const J rest = l - x;
  if (rest.value == 0) return J(0);
  const CutPiece<J> first(l, x, n), second(rest, y - x, n);
  // The part behind x, whose left end has moved and turned, against its chord.
  const J turns = first.slope + first.rise;
  return first.rise * (l - y) + turns * second.left + first.rise * second.right;
}

}  // namespace hapbeam::detail
