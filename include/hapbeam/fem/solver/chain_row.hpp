// SPDX-License-Identifier: MIT
// A row of a chain that is eliminated from both ends at once: a node of the left part in lane 0, and one of the right part in lane 1.
//
// Real-time: noexcept, no allocation, O(1): about 75 multiply-adds and 3 divisions a node of 3 unknowns.
#pragma once

#include <algorithm>
#include <type_traits>

#include <hapbeam/element/pack_rows.hpp>
#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/fem/solver/pivot_by_pivot.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// So many rows side by side, entry by entry, as elements of both chains are computed: of each row
/// the lower triangle of its block, the right-hand side, and what couples it with the next on the way.
template <typename Scalar, int Block, int Abreast>
struct alignas(2 * Abreast * sizeof(Scalar)) ChainRows {
  using Number = TwoNumbers<Scalar>;
  /// Columns of the coupling stand side by side as they are eliminated: so many strips of each of its rows.
  static constexpr int columns = columns_abreast<Scalar>, strips = (Block + columns - 1) / columns;
  static constexpr int x = triangle_size<Block>, coupling = x + Block;
  Number entry[coupling][Abreast];
  Number strip[Block * strips][Abreast][columns];

  /// Where a strip has a row: of columns that were crossed in pairs every other one comes first.
  static constexpr int place(int row) noexcept {
    return columns == 1 ? row : row % 2 * (Abreast / 2) + row / 2;
  }
  /// From entry (0, 0) of a row's coupling to (i, j).
  static constexpr int to_coupling(int i, int j) noexcept {
    return (i * strips + j / columns) * Abreast * columns + j % columns;
  }

  /// Adds elements that were computed side by side, in the order of PairOrder, to these rows and the next.
  /// @tparam Full  whether all of them are elements   @param count  of pairs that are   @param odd  the first is none
  template <bool Full, class Tangent, class Residual>
  static void add(ChainRows* rows, int count, bool odd, const Tangent& K, const Residual& r) noexcept {
    using Wide = std::decay_t<decltype(r[0])>;
    static_assert(Wide::size == 2 * Abreast, "a group of elements is one of rows");
    const auto kept = [odd](Wide wide) HAPBEAM_INLINED {
      if (!Full && odd) wide.set(0, 0);
      return wide;
    };
    // Of what belongs to a node: the share of the element on the way to the middle, and that of the one before.
    const auto share_out = [&](int e, const Wide& own, const Wide& next) HAPBEAM_INLINED {
      const Wide outer = kept(in_turn(own, next)), inner = kept(in_turn(next, own));
      Number(&at)[Abreast] = rows->entry[e];
      (outer + after(at[0].a, inner)).store(at[0].a);
      if (Full || count == Abreast) {
        rows[1].entry[e][0].set(lanes(inner[2 * Abreast - 2], inner[2 * Abreast - 1]));
      } else {
        Number all[Abreast];
        inner.store(all[0].a);
        at[count] = all[count - 1];
      }
    };
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) share_out(triangle<Block>(i, j), K(i, j), K(Block + i, Block + j));
      share_out(x + j, -r[j], -r[Block + j]);
    }
    // Out of line each would read all that K makes an entry of.
    const auto couples = [&](int i, int j)
                             HAPBEAM_INLINED { return kept(in_turn(K(i, Block + j), K(j, Block + i))); };
    HAPBEAM_UNROLL
    for (int g = 0; g < strips; ++g) {
      HAPBEAM_UNROLL
      for (int i = 0; i < Block; ++i)
        store(couples(i, columns * g), couples(i, (std::min)(columns * g + columns, Block) - 1),
              rows->strip[i * strips + g][0][0].a);
    }
  }

 private:
  /// One strip of all rows.   @param last  its last column; the first once more, which nothing reads, where that is alone
  template <class Wide>
  [[gnu::always_inline]] static void store(Wide first, Wide last, Scalar* to) noexcept {
    if constexpr (columns == 2) {
      PackRows<Scalar, 2 * Abreast>::cross_pairs(first, last);
      last.store(to + 2 * Abreast);
    }
    first.store(to);
  }
};

/// One of them.  Eliminating puts P⁻¹ on the diagonal, after a last look at the pivots, and L below it, P⁻¹Y into the coupling
/// to the nodes that are eliminated later, and P⁻¹L⁻¹ of the right-hand side into x.
template <typename Scalar, int Block, int Abreast>
struct ChainRow {
  using Rows = ChainRows<Scalar, Block, Abreast>;
  using Pair = Lanes<Scalar>;
  using Number = TwoNumbers<Scalar>;
  using Factor = Ldlt<Scalar, Block>;

  Number* first;    ///< entry
  Number* couples;  ///< (0, 0)

  [[gnu::always_inline]] Number& entry(int e) const noexcept { return first[Abreast * e]; }
  [[gnu::always_inline]] Number& block(int i, int j) const noexcept { return entry(triangle<Block>(i, j)); }
  /// Right-hand side, at the end the increment.
  [[gnu::always_inline]] Number& x(int i) const noexcept { return entry(Rows::x + i); }
  /// @param i  own unknown   @param j  that of the next node on the way
  [[gnu::always_inline]] Number& coupling(int i, int j) const noexcept {
    return couples[Rows::to_coupling(i, j)];
  }
  /// Columns of a row of it that stand side by side.
  [[gnu::always_inline]] Scalar* strip(int i, int g) const noexcept {
    return couples[Rows::to_coupling(i, g * Rows::columns)].a;
  }

  /// @param front, f  in: block and right-hand side of the nodes of a row, less what the nodes before took away;  out: of the next
  /// By value: what is reached through a reference would be read anew after each store.
  static void eliminate(const ChainRow row, const ChainRow next, Pair* front, Pair* f, Pair& energy,
                        Pivots<Scalar>& pivots) noexcept {
    eliminate_pivot_by_pivot<Block>(row, next, front, f, energy, pivots);
  }

  /// The same for the node at which both chains end, in lane 0.  @param f  right-hand sides of both
  static void join(const ChainRow row, Pair* front, Pair* f, Pair& energy, Pivots<Scalar>& pivots) noexcept {
    for (int k = 0; k < triangle_size<Block>; ++k) front[k] = total(front[k]);
    for (int k = 0; k < Block; ++k) f[k] = total(f[k]);
    const Factor factor(front);
    Pair z[Block];
    factor.forward(f);
    factor.scale(f, z);
    const Pair twice = less<Block>(Pair(0), f, z);
    energy += twice * lanes<Scalar>(1, 0);
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      pivots.see(lanes<Scalar>(factor.p[j][0], 1), row.block(j, j).get());
      row.block(j, j).a[0] = factor.i[j][0];
      HAPBEAM_UNROLL
      for (int i = j + 1; i < Block; ++i) row.block(i, j).a[0] = factor.l[triangle<Block>(i, j)][0];
      row.x(j).a[0] = z[j][0];
    }
  }
  /// Increment of that node, in both lanes.
  [[gnu::always_inline]] static void substitute_last(const ChainRow row, Pair* increment) noexcept {
    HAPBEAM_UNROLL
    for (int j = Block - 1; j >= 0; --j) {
      Scalar sum = row.x(j).a[0];
      HAPBEAM_UNROLL
      for (int k = Block - 1; k > j; --k) sum -= row.block(k, j).a[0] * increment[k][0];
      increment[j] = Pair(sum);
      row.x(j).a[0] = sum;
    }
  }

  /// One step of a column: f becomes L⁻¹f, what it makes of the next row is taken off next.   @return P⁻¹L⁻¹f in scaled
  static void forward(const ChainRow row, int lane, Scalar* f, Scalar* scaled) noexcept {
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) {
      HAPBEAM_UNROLL
      for (int i = k + 1; i < Block; ++i) f[i] -= row.block(i, k).a[lane] * f[k];
      scaled[k] = f[k] * row.block(k, k).a[lane];
    }
  }
  static void pass_on(const ChainRow row, int lane, const Scalar* f, Scalar* next) noexcept {
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) next[j] -= row.coupling(k, j).a[lane] * f[k];
    }
  }

  /// Increments of the nodes from those of the next on their way.  @param later  in: of those, out: of these
  [[gnu::always_inline]] static void substitute(const ChainRow row, Pair* later) noexcept {
    Pair rest[Block];
    HAPBEAM_UNROLL
    for (int i = 0; i < Block; ++i) {
      rest[i] = row.x(i).get();
      HAPBEAM_UNROLL
      for (int k = Block - 1; k >= 0; --k)
        rest[i] = subtract_product(rest[i], row.coupling(i, k).get(), later[k]);
    }
    HAPBEAM_UNROLL
    for (int j = Block - 1; j >= 0; --j) {
      HAPBEAM_UNROLL
      for (int k = Block - 1; k > j; --k) rest[j] = subtract_product(rest[j], row.block(k, j).get(), rest[k]);
    }
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) row.x(k).set(later[k] = rest[k]);
  }
};

}  // namespace hapbeam::detail
