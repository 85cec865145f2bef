// SPDX-License-Identifier: MIT
// How a piece of a beam that is clamped at both ends yields to a force within it.
//
//   EI g(x, y) = x² Y² [3 (l - x)(l - Y) - x Y] / 6 l³        x <= y,  Y = l - y;    on itself  EI g = x³ (l - x)³ / 3 l³
//
// It is what the cubic of an element lacks of the curve.
// Real-time: noexcept, no allocation, O(1).
// Source: the statics of a clamped beam, Roark's Formulas for Stress and Strain, 8.1.
#pragma once

namespace hapbeam::detail {

/// Times EI; derivatives by both places [m³], [m²], [m].
template <typename S>
struct ClampedPiece {
  S g, by_first, by_second, by_both, first_twice, second_twice;

  /// Of one place: by that, and twice by that, in by_first and first_twice.
  ClampedPiece(S l, S x) noexcept {
    const S i = 1 / l, a = x, b = l - x, ab = a * b * i, rise = (b - a) * i;
    g = ab * ab * ab / 3;
    by_first = ab * ab * rise;
    first_twice = 2 * ab * (rise * rise - ab * i);
    by_second = by_both = second_twice = 0;
  }
  /// How two places yield to each other: the one nearer to the first end is first.   @param x, y  x <= y
  ClampedPiece(S l, S x, S y) noexcept {
    const S Y = l - y, i = 1 / (6 * l * l * l), l2 = l * l;
    g = i * x * x * Y * Y * (3 * l2 - 3 * l * (x + Y) + 2 * x * Y);
    by_first = i * x * Y * Y * (6 * l2 - 9 * l * x - 6 * l * Y + 6 * x * Y);
    by_second = -i * x * x * Y * (6 * l2 - 6 * l * x - 9 * l * Y + 6 * x * Y);
    by_both = -i * x * Y * (12 * l2 - 18 * l * (x + Y) + 18 * x * Y);
    first_twice = i * Y * Y * (6 * l2 - 18 * l * x - 6 * l * Y + 12 * x * Y);
    second_twice = i * x * x * (6 * l2 - 6 * l * x - 18 * l * Y + 12 * x * Y);
  }
};

}  // namespace hapbeam::detail
