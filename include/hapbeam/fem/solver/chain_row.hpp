// A row of a chain that is eliminated from both ends at once: a node of the left part in lane 0, and one of the right part in lane 1.
//
// Real-time: noexcept, no allocation, O(1): about 75 multiply-adds and 3 divisions a node of 3 unknowns.
#pragma once

#include <type_traits>

#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

/// Eliminating leaves the diagonal as it is, for the last look at the pivots, and puts L below it, P⁻¹Y into the coupling
/// to the nodes that are eliminated later, and P⁻¹L⁻¹ of the right-hand side into x.
template <typename Scalar, int Block>
struct ChainRow {
  using Pair = Lanes<Scalar>;
  using Number = TwoNumbers<Scalar>;
  using Factor = Ldlt<Scalar, Block>;
  static constexpr int columns = columns_abreast<Scalar, Block>;
  static constexpr int strips = (Block + columns - 1) / columns, padded = strips * columns;
  using Strip = detail::Strip<Scalar, columns>;

  Number block[triangle_size<Block>];
  Number coupling[Block][padded];  ///< own unknown, that of the next node on the way
  Number x[Block];                 ///< right-hand side, at the end the increment

  /// Adds elements that were computed side by side, in the order of PairOrder, to their rows.
  /// @param rows  from that of the first element on   @param count  of rows; a constant mostly
  template <class Count, class Tangent, class Residual>
  static void add(ChainRow* rows, Count count, const Tangent& K, const Residual& r) noexcept {
    using Wide = std::decay_t<decltype(r[0])>;
    constexpr int abreast = Wide::size / 2;
    const auto pair = [](const Wide& wide, int k) { return Pair(wide[2 * k], wide[2 * k + 1]); };
    // Of what belongs to a node: the share of the element on the way to the middle, and that of the one before.
    const auto share_out = [&](auto&& at, const Wide& own, const Wide& next) {
      const Wide outer = in_turn(own, next), inner = in_turn(next, own);
      Pair before = at(rows[0]).get();
      HAPBEAM_UNROLL
      for (int k = 0; k < abreast; ++k) {
        if (k == count) break;
        at(rows[k]).set(before + pair(outer, k));
        before = pair(inner, k);
      }
      at(rows[count]).set(before);
    };
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i)
        share_out(
            [ i, j ](ChainRow & at) -> auto& { return at.block[triangle<Block>(i, j)]; }, K(i, j),
            K(Block + i, Block + j));
      share_out(
          [j](ChainRow & at) -> auto& { return at.x[j]; }, -r[j], -r[Block + j]);
      HAPBEAM_UNROLL
      for (int i = 0; i < Block; ++i) {
        const Wide coupling = in_turn(K(i, Block + j), K(j, Block + i));
        HAPBEAM_UNROLL
        for (int k = 0; k < abreast; ++k)
          if (k < count) rows[k].coupling[i][j].set(pair(coupling, k));
      }
    }
  }

  /// @param front, f  in: block and right-hand side of the nodes of a row, less what the nodes before took away;  out: of the next
  void eliminate(const ChainRow& next, Pair* front, Pair* f, Pair& energy, Pivots<Scalar>& pivots) noexcept {
    const Factor factor(front);
    Pair zx[Block];
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      const Number& assembled = block[triangle<Block>(j, j)];
      for (int lane = 0; lane < 2; ++lane) pivots.see(factor.p[j][lane], assembled.a[lane]);
      HAPBEAM_UNROLL
      for (int i = j + 1; i < Block; ++i) block[triangle<Block>(i, j)].set(factor.l[triangle<Block>(i, j)]);
    }
    factor.forward(f);
    factor.scale(f, zx);
    energy = less<Block>(energy, f, zx);
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) x[k].set(zx[k]);
    // L⁻¹C and P⁻¹L⁻¹C, a few columns side by side.
    Strip y[strips][Block];
    HAPBEAM_UNROLL
    for (int g = 0; g < strips; ++g) {
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) y[g][k] = Strip::load(coupling[k][g * columns].a);
    }
    HAPBEAM_UNROLL
    for (int k = 0; k + 1 < Block; ++k) {
      HAPBEAM_UNROLL
      for (int i = k + 1; i < Block; ++i) {
        const Strip l = Strip::repeat(block[triangle<Block>(i, k)].a);
        HAPBEAM_UNROLL
        for (int g = 0; g < strips; ++g) y[g][i] = subtract_product(y[g][i], l, y[g][k]);
      }
    }
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) {
      Number pivot;
      pivot.set(factor.i[k]);
      const Strip inverse = Strip::repeat(pivot.a);
      HAPBEAM_UNROLL
      for (int g = 0; g < strips; ++g) (y[g][k] * inverse).store(coupling[k][g * columns].a);
    }
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      const auto column = [&y](int i, int k) { return y[i / columns][k].column(i % columns); };
      Strip z[Block];
      Pair sum = next.x[j].get();
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) {
        z[k] = Strip::repeat(coupling[k][j].a);
        sum = subtract_product(sum, column(j, k), zx[k]);
      }
      f[j] = sum;
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) {
        if (i > j && i % columns != 0) continue;  // stands beside the one before
        if (i % columns == 0 && i + columns <= Block) {
          Strip strip = Strip::load(next.block[triangle<Block>(i, j)].a);
          HAPBEAM_UNROLL
          for (int k = 0; k < Block; ++k) strip = subtract_product(strip, y[i / columns][k], z[k]);
          HAPBEAM_UNROLL
          for (int c = 0; c < columns; ++c) front[triangle<Block>(i, j) + c] = strip.column(c);
        } else {
          Pair entry = next.block[triangle<Block>(i, j)].get();
          HAPBEAM_UNROLL
          for (int k = 0; k < Block; ++k) entry = subtract_product(entry, column(i, k), z[k].column(0));
          front[triangle<Block>(i, j)] = entry;
        }
      }
    }
  }

  /// Solves for the node at which both chains end.  @param f  in: right-hand sides of both, out: its increment in both lanes
  void join(Pair* front, Pair* f, Pair& energy, Pivots<Scalar>& pivots) noexcept {
    for (int k = 0; k < triangle_size<Block>; ++k) front[k] = front[k] + front[k].swapped();
    for (int k = 0; k < Block; ++k) f[k] = f[k] + f[k].swapped();
    const Factor factor(front);
    Pair z[Block];
    factor.forward(f);
    factor.scale(f, z);
    const Pair twice = less<Block>(Pair::both(0), f, z);
    energy = energy + twice * Pair(1, 0);
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) pivots.see(factor.p[j][0], block[triangle<Block>(j, j)].a[0]);
    HAPBEAM_UNROLL
    for (int j = Block - 1; j >= 0; --j) {
      HAPBEAM_UNROLL
      for (int k = Block - 1; k > j; --k)
        z[j] = subtract_product(z[j], factor.l[triangle<Block>(k, j)], z[k]);
    }
    for (int k = 0; k < Block; ++k) f[k] = z[k], x[k].a[0] = z[k][0];
  }

  /// Increments of the nodes from those of the next on their way.  @param later  in: of those, out: of these
  void substitute(Pair* later) noexcept {
    Pair rest[Block];
    HAPBEAM_UNROLL
    for (int i = 0; i < Block; ++i) {
      rest[i] = x[i].get();
      HAPBEAM_UNROLL
      for (int k = Block - 1; k >= 0; --k)
        rest[i] = subtract_product(rest[i], coupling[i][k].get(), later[k]);
    }
    HAPBEAM_UNROLL
    for (int j = Block - 1; j >= 0; --j) {
      HAPBEAM_UNROLL
      for (int k = Block - 1; k > j; --k)
        rest[j] = subtract_product(rest[j], block[triangle<Block>(k, j)].get(), rest[k]);
    }
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) x[k].set(later[k] = rest[k]);
  }
};

}  // namespace hapbeam::detail
