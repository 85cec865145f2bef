// SPDX-License-Identifier: MIT
// The curve of a straight piece of a beam under a tension that is the same all along it, and by how much its slope makes it longer
// than its chord.
//
//   EI w'''' = N w'',   ξ = x/l,   q = N l²/EI
//
// Of the end slopes against the chord, times -l, the symmetric half m = (a - b)/2 and the antisymmetric one p = (a + b)/2 bend it:
//
//   dw/dξ = rise - m σ' - p τ',     σ' = -sinh zη/sinh ½z,   τ' = (z cosh zη - 2 sinh ½z)/(z cosh ½z - 2 sinh ½z),   z = √q,   η = ξ - ½
//
// Up to q = 4 numerators and denominators are divided by their power of z.  What is left are entire functions of y = qη²,
//
//   sinh zη = zη (1 + y S3),   cosh zη = 1 + y S2,   S2 = ½ + y S4,   S3 = 1/6 + y S5,   S4 = Σ yᵏ/(2k + 4)!,   S5 = Σ yᵏ/(2k + 5)!
//
// Beyond, all is written in e^-zξ and e^-z(1-ξ), which do not grow.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>

namespace hapbeam::detail {

template <typename S>
class TensionedCurve {
 public:
  /// At one place; derivatives are by ξ.
  struct At {
    S rise;         ///< w since ξ = 0
    S slope;        ///< w'
    S square;       ///< ∫w'² dξ since ξ = 0
    S bend, shear;  ///< w'', w'''
  };

  /// @param q  not negative
  TensionedCurve(S q, S rise, S m, S p) noexcept : q_(q) {
    using std::exp;
    using std::sqrt;
    if (q < border) {
      const Series s(q / 4);
      constant_ = s.s3 / 4;
      base_ = rise;
      first_ = 2 * m / (1 + q / 4 * s.s3);
      second_ = 4 * p / (s.s2 - s.s3);
      start_ = about_middle(S(-0.5));
    } else {
      z_ = sqrt(q);
      inverse_ = 1 / z_;
      half_ = exp(-z_ / 2);
      across_ = half_ * half_;
      const S less = 1 - across_, turn = m / less, tilt = p / (z_ * (1 + across_) - 2 * less);
      base_ = rise + 2 * tilt * less;
      first_ = -turn - tilt * z_;
      second_ = turn - tilt * z_;
    }
  }

  At at(S x) const noexcept {
    using std::exp;
    return layered() ? by_layers(x, exp(-z_ * x), exp(-z_ * (1 - x))) : by_series(x);
  }
  At middle() const noexcept { return layered() ? by_layers(S(0.5), half_, half_) : by_series(S(0.5)); }
  At end() const noexcept { return layered() ? by_layers(1, across_, 1) : by_series(1); }

  /// Calls visit(j, At) at count places, evenly spaced, of which the first is the start or the middle: an exponential of all of them is
  /// a power of one.   @param power  j -> two numbers that are its scratch
  template <class Power, class Visit>
  [[gnu::always_inline]] void visit(int count, bool from_middle, S spacing, Power&& power,
                                    Visit&& visit) const noexcept {
    using std::exp;
    const S first = from_middle ? S(0.5) : S(0);
    if (!layered()) {
      for (int j = 0; j < count; ++j) visit(j, from_start(series(first + S(j) * spacing - S(0.5))));
      return;
    }
    const S ratio = exp(-z_ * spacing), rest = 1 - first - S(count - 1) * spacing;
    S down = from_middle ? half_ : S(1), up = rest > 0 ? exp(-z_ * rest) : S(1);
    for (int j = 0; j < count; ++j) {
      power(j).first = down, power(count - 1 - j).second = up;
      down *= ratio, up *= ratio;
    }
    for (int j = 0; j < count; ++j) {
      const auto p = power(j);
      visit(j, by_layers(first + S(j) * spacing, S(p.first), S(p.second)));
    }
  }

 private:
  static constexpr S border = 4;

  /// |y| <= 1: the first term that is left out is below 1e-19.
  struct Series {
    S s2, s3;
    explicit Series(S y) noexcept {
      // Of (2k + 4)! and (2k + 5)!, from the last one up: 1/(n (n - 1)) of the one before it is in each.
      S s4 = S(1. / 6402373705728000.), s5 = S(1. / 121645100408832000.);
      s4 = S(1. / 20922789888000.) + y * s4, s5 = S(1. / 355687428096000.) + y * s5;
      s4 = S(1. / 87178291200.) + y * s4, s5 = S(1. / 1307674368000.) + y * s5;
      s4 = S(1. / 479001600.) + y * s4, s5 = S(1. / 6227020800.) + y * s5;
      s4 = S(1. / 3628800.) + y * s4, s5 = S(1. / 39916800.) + y * s5;
      s4 = S(1. / 40320.) + y * s4, s5 = S(1. / 362880.) + y * s5;
      s4 = S(1. / 720.) + y * s4, s5 = S(1. / 5040.) + y * s5;
      s4 = S(1. / 24.) + y * s4, s5 = S(1. / 120.) + y * s5;
      s2 = S(0.5) + y * s4, s3 = S(1. / 6.) + y * s5;
      fifth = (s4 - 3 * s5 + s2 * s3) / 2;
    }
    S fifth;  ///< ∫(cosh t - 1)² dt over t⁵
  };

  bool layered() const noexcept { return !(q_ < border); }
  At by_series(S x) const noexcept { return from_start(about_middle(x - S(0.5))); }
  At from_start(At a) const noexcept {
    a.rise -= start_.rise;
    a.square -= start_.square;
    return a;
  }

  /// w' = base + first η S1 - second (η² S2 - constant), from η = 0 on.
  At about_middle(S h) const noexcept { return series(h); }
  /// The same.  Inlined by intent where it is called in a loop.
  [[gnu::always_inline]] At series(S h) const noexcept {
    const S hh = h * h, y = q_ * hh;
    const Series s(y);
    const S f = first_, g = second_, c = constant_, b = base_;
    const S sinh_z = h * (1 + y * s.s3), cosh = 1 + y * s.s2;  // sinh zη over z
    const S even = hh * s.s2, odd = hh * h * s.s3 - c * h;     // ∫sinh zη dη over z, ∫(η² S2 - c) dη
    const S sinh_square = hh * h * (s.s2 + s.s3 + y * s.s2 * s.s3) / 2,
            cosh_square = hh * hh * h * s.fifth - c * (hh * h * s.s3 + odd), product = even * (even / 2 - c);
    return {b * h + f * even - g * odd, b + f * sinh_z - g * (even - c),
            b * (b * h + 2 * (f * even - g * odd)) + f * f * sinh_square + g * g * cosh_square -
                2 * f * g * product,
            f * cosh - g * sinh_z, q_ * f * sinh_z - g * cosh};
  }

  /// w' = base + first e^-zξ + second e^-z(1-ξ).   @param near_start, near_end  the exponentials
  At by_layers(S x, S near_start, S near_end) const noexcept {
    const S f = first_, g = second_, b = base_, i = inverse_;
    const S from_start = f * (1 - near_start) * i, to_end = g * (near_end - across_) * i;
    const S rest = from_start + to_end;
    return {b * x + rest, b + f * near_start + g * near_end,
            b * (b * x + 2 * rest) +
                (from_start * f * (1 + near_start) + to_end * g * (near_end + across_)) / 2 +
                2 * f * g * across_ * x,
            z_ * (g * near_end - f * near_start), q_ * (f * near_start + g * near_end)};
  }

  S q_, base_, first_, second_;
  S constant_ = 0, z_ = 0, inverse_ = 0, half_ = 0, across_ = 0;  // 1/z, e^-z/2, e^-z
  At start_{};
};

}  // namespace hapbeam::detail
