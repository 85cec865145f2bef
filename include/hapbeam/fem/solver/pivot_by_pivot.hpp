// SPDX-License-Identifier: MIT
// How a row of a chain is eliminated: LDLᵀ of its block, and pivot by pivot what that makes of its right-hand side and of what couples it with
// the next row.
//
// A processor waits for each division by a pivot, and does not look as far ahead as the rest of a large block: what a pivot makes of all
// but the next column stands where the next one is divided by.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>

#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// As ChainRow::eliminate().   @tparam Row  ChainRow
template <int Block, typename Scalar, class Row>
[[gnu::always_inline]] inline void eliminate_pivot_by_pivot(const Row row, const Row next,
                                                            Lanes<Scalar>* front, Lanes<Scalar>* f,
                                                            Lanes<Scalar>& energy,
                                                            Pivots<Scalar>& pivots) noexcept {
  using Pair = Lanes<Scalar>;
  HAPBEAM_KEEP_IN_MEMORY();
  // Columns of the coupling stand side by side in strips.  Some have registers while the block is factored; the others come later.  Where
  // a column is left alone, the right-hand side stands beside it, as one more.
  constexpr int columns = columns_abreast<Scalar>, strips = (Block + columns - 1) / columns,
                at_once = (std::min)(12 / Block, strips);
  constexpr bool beside = strips * columns > Block;
  using Strips = Columns<Scalar>;
  using Strip = typename Strips::Wide;
  // In place: a compiler would copy the block in wider registers than it was stored from, for which a processor waits.
  Pair *const c = front, *const x = f;  // LP; L⁻¹ of the right-hand side, where it stands alone
  Pair l[triangle_size<Block>], inverse[Block], zx[Block];  // L, P⁻¹, P⁻¹L⁻¹ of the right-hand side
  Strip y[strips][Block];                                   // L⁻¹C

  const auto load = [&](auto g) HAPBEAM_INLINED {
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) {
      constexpr int from = g * columns, to = from + columns - 1;
      y[g][k] =
          to < Block ? Strip::load_aligned(row.strip(k, g)) : Strips::of(row.coupling(k, from).get(), x[k]);
    }
  };
  // A row of P⁻¹L⁻¹C.
  const auto scale = [&](auto g, auto k) HAPBEAM_INLINED {
    const Strip scaled = y[g][k] * Strips::repeat(inverse[k]);
    scaled.store_aligned(row.strip(k, g));  // beside the last column stands nothing else
    if (g * columns + columns > Block) row.x(k).set(zx[k] = Strips::column(scaled, columns - 1));
  };
  // What column k of L makes of column j of the block.
  const auto take_away = [&](auto k, auto j) HAPBEAM_INLINED {
    HAPBEAM_UNROLL
    for (int i = j; i < Block; ++i)
      c[triangle<Block>(i, j)] =
          subtract_product(c[triangle<Block>(i, j)], l[triangle<Block>(i, k)], c[triangle<Block>(j, k)]);
  };
  const auto use_up = [&](auto k) HAPBEAM_INLINED {
    for_each_constant<k / 2 * 2 + 4, Block>([&](auto j) HAPBEAM_INLINED { take_away(k, j); });
    for_each_constant<0, at_once>([&](auto g) HAPBEAM_INLINED { scale(g, k); });
    if (!beside) row.x(k).set(zx[k] = x[k] * inverse[k]);
    HAPBEAM_UNROLL
    for (int i = k + 1; i < Block; ++i) {
      if (!beside) x[i] = subtract_product(x[i], l[triangle<Block>(i, k)], x[k]);
      const Strip by = Strips::repeat(l[triangle<Block>(i, k)]);
      HAPBEAM_UNROLL
      for (int g = 0; g < at_once; ++g) y[g][i] = subtract_product(y[g][i], by, y[g][k]);
    }
  };
  const auto divide = [&](auto k) HAPBEAM_INLINED {
    pivots.see(c[triangle<Block>(k, k)], row.block(k, k).get());
    row.block(k, k).set(inverse[k]);
    HAPBEAM_UNROLL
    for (int i = k + 1; i < Block; ++i) {
      l[triangle<Block>(i, k)] = c[triangle<Block>(i, k)] * inverse[k];
      row.block(i, k).set(l[triangle<Block>(i, k)]);
    }
  };

  for_each_constant<0, at_once>(load);
  for_each_constant<0, (Block + 1) / 2>([&](auto two) HAPBEAM_INLINED {
    constexpr int k = 2 * two;
    constexpr bool both = k + 1 < Block;
    // The second pivot is det/pivot, whose inverse does not wait for that of the first.
    const Pair pivot = c[triangle<Block>(k, k)];
    inverse[k] = Pair(1) / pivot;
    if constexpr (both) {
      const Pair across = c[triangle<Block>(k + 1, k)];
      inverse[k + 1] = pivot / subtract_product(pivot * c[triangle<Block>(k + 1, k + 1)], across, across);
    }
    if constexpr (k > 0) use_up(constant<k - 2>), use_up(constant<k - 1>);
    divide(constant<k>);
    if constexpr (both) take_away(constant<k>, constant<k + 1>), divide(constant<k + 1>);
    for_each_constant<k + 2, (std::min)(k + 4, Block)>(
        [&](auto j) HAPBEAM_INLINED { take_away(constant<k>, j), take_away(constant<k + 1>, j); });
  });
  if constexpr (Block % 2 == 0) use_up(constant<Block - 2>);
  use_up(constant<Block - 1>);
  for_each_constant<at_once, strips>([&](auto g) HAPBEAM_INLINED {
    load(g);
    for_each_constant<0, Block>([&](auto k) HAPBEAM_INLINED {
      HAPBEAM_UNROLL
      for (int i = k + 1; i < Block; ++i)
        y[g][i] = subtract_product(y[g][i], Strips::repeat(row.block(i, k).a), y[g][k]);
      scale(g, k);
    });
  });
  if constexpr (beside) {
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) x[k] = Strips::column(y[strips - 1][k], columns - 1);
  }
  energy = less<Block>(energy, x, zx);

  // The next row's block and right-hand side, less C'P⁻¹L⁻¹ of both.  What is repeated is read once more as it was stored, in the instruction
  // that repeats it.
  HAPBEAM_UNROLL
  for (int j = 0; j < Block; ++j) {
    Strip z[Block];
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) z[k] = Strips::repeat(row.coupling(k, j).a);
    HAPBEAM_UNROLL
    for (int i = j; i < Block; ++i) {
      if (i > j && i % columns != 0) continue;  // stands beside the one before
      if (i % columns == 0 && (beside || i + columns <= Block)) {
        const int to = i + columns - 1;
        Strip strip =
            Strips::of(next.block(i, j).get(),
                       to < Block ? next.block((std::min)(to, Block - 1), j).get() : next.x(j).get());
        HAPBEAM_UNROLL
        for (int k = 0; k < Block; ++k) strip = subtract_product(strip, y[i / columns][k], z[k]);
        HAPBEAM_UNROLL
        for (int n = 0; n < columns; ++n)
          (i + n < Block ? front[triangle<Block>((std::min)(i + n, Block - 1), j)] : f[j]) =
              Strips::column(strip, n);
      } else {
        Pair entry = next.block(i, j).get();
        HAPBEAM_UNROLL
        for (int k = 0; k < Block; ++k)
          entry = subtract_product(entry, Strips::column(y[i / columns][k], i % columns),
                                   Strips::column(z[k], 0));
        front[triangle<Block>(i, j)] = entry;
      }
    }
  }
  if constexpr (!beside) {
    HAPBEAM_UNROLL
    for (int g = 0; g < strips; ++g) {
      Strip rest = Strips::of(next.x(g * columns).get(), next.x(g * columns + columns - 1).get());
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) rest = subtract_product(rest, y[g][k], Strips::repeat(row.x(k).a));
      HAPBEAM_UNROLL
      for (int n = 0; n < columns; ++n) f[g * columns + n] = Strips::column(rest, n);
    }
  }
}

}  // namespace hapbeam::detail
