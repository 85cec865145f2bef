// The assembler for a chain of elements: a symmetric block-tridiagonal system, solved by LDLᵀ.
// A block is as large as a node has unknowns: 3 in a plane, 6 or 7 in space.
//
// Element i couples node i with node i + 1 alone, so the tangent is
//
//        | D0  C0          |
//    K = | C0ᵀ D1  C1      |       Di' = Di - C(i-1)ᵀ D(i-1)'⁻¹ C(i-1)
//        |     C1ᵀ D2  ... |
//
// and one sweep factors and solves in O(n).  It runs from both ends to the middle node, and each of its operations is done for
// both chains in the two lanes of a register.
// With Di' = LPLᵀ the update is  Yᵀ(P⁻¹Y),  Y = L⁻¹C:  symmetric, and free of the second half of a solve.
// No pivoting: the pivots of LDLᵀ carry the inertia of K, so an indefinite tangent (a beam beyond its buckling load)
// is solved and counted, not rejected.
// Real-time: noexcept, no allocation after construction, about 75 multiply-adds and 3 divisions a node of 3 unknowns.
// Source: Golub and Van Loan, Matrix Computations, 4.5.1; from both ends: Dongarra and others, LINPACK Users' Guide, 7.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// @tparam Block  unknowns of a node
template <typename Scalar, int Elements = Eigen::Dynamic, int MaxElements = Elements, int Block = 3>
class BlockTridiagonal {
  using Factor = detail::Ldlt<Scalar, Block>;
  using Lanes = detail::Lanes<Scalar>;
  using Number = detail::TwoNumbers<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Block, 1>;

 public:
  explicit BlockTridiagonal(int elements)
      : last_(elements), odd_(elements % 2), pairs_((elements + odd_) / 2), rows_(half(elements)) {
    // The left chain of an odd number of elements has one node more, to which nothing is coupled.
    if (odd_)
      for (int k = 0; k < Block; ++k) rows_[0].block[triangle(k, k)].a[0] = 1;
  }

  /// Adds element e: its tangent, and its residual to the right-hand side with the sign turned.
  /// Elements come in order, 0 to n - 1; element 0 starts a new system.
  /// @param K  (i, j) -> entry: of the lower triangles of both nodes, and of what couples the first with the second
  /// @param r  [i] -> entry
  template <class Tangent, class Residual>
  [[gnu::always_inline]] void add(int e, const Tangent& K, const Residual& r) noexcept {
    const Place at = place(e), to = place(e + 1);
    Row &a = rows_[at.row], &b = rows_[to.row];
    const int p = at.lane, q = to.lane;
    if (e == 0) {
      for (auto& entry : a.block) entry.a[p] = 0;
      for (auto& entry : a.x) entry.a[p] = 0;
      held_energy_ = 0;
    }
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) {
        a.block[triangle(i, j)].a[p] += K(i, j);
        b.block[triangle(i, j)].a[q] = K(Block + i, Block + j);
      }
      a.x[j].a[p] -= r[j];
      b.x[j].a[q] = -r[Block + j];
    }
    if (q == 0) {
      HAPBEAM_UNROLL
      for (int j = 0; j < Block; ++j) {
        HAPBEAM_UNROLL
        for (int i = 0; i < Block; ++i) a.coupling[i][j].a[0] = K(i, Block + j);
      }
    } else {
      HAPBEAM_UNROLL
      for (int j = 0; j < Block; ++j) {
        HAPBEAM_UNROLL
        for (int i = 0; i < Block; ++i) b.coupling[j][i].a[1] = K(i, Block + j);
      }
    }
  }

  /// Adds elements that were computed side by side, in the order of PairOrder, two at a time.
  /// @param first  place of the first, even; 0 starts a new system
  /// @param K  (i, j) -> entries of all: of the lower triangles of both nodes, and of what couples the first with the second
  /// @param r  [i] -> entries of all
  template <class Tangent, class Residual>
  void add_pairs(int first, Tangent& K, Residual& r) noexcept {
    using Wide = std::decay_t<decltype(r[0])>;
    constexpr int abreast = Wide::size / 2;
    const int row = first / 2, count = (std::min)(abreast, pairs_ - row);
    if (first == 0) {
      for (auto& entry : rows_[0].block) entry.set(Lanes::both(0));
      for (auto& entry : rows_[0].x) entry.set(Lanes::both(0));
      held_energy_ = 0;
      if (odd_) leave_first_out(K, r);
    }
    if (count == abreast) add_rows(row, std::integral_constant<int, abreast>(), K, r);
    else add_rows(row, count, K, r);
    if (first == 0 && odd_)
      for (int k = 0; k < Block; ++k) rows_[0].block[triangle(k, k)].a[0] = 1;
    if (row + count == pairs_) join_middle();
  }

  /// Adds to the tangent and to the residual of one node, after all elements are in.  @param K  (i, j) -> entry of a lower triangle
  template <class Tangent, class Residual>
  void add_at(int node, const Tangent& K, const Residual& r) noexcept {
    const Own own = own_of(node);
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) own(i, j) += K(i, j);
      own[j] -= r[j];
    }
  }
  /// Residual of one unknown of a node so far.
  Scalar residual(int node, int component) noexcept { return -own_of(node)[component]; }

  /// Three unknowns of a node from At on become those along other axes, after all elements are in:  old = Q new.
  template <int At, class Matrix>
  void turn(int node, const Matrix& Q) noexcept {
    const auto times = [&Q](Scalar& a, Scalar& b, Scalar& c) {
      const Scalar x = a, y = b, z = c;
      a = x * Q(0, 0) + y * Q(1, 0) + z * Q(2, 0);
      b = x * Q(0, 1) + y * Q(1, 1) + z * Q(2, 1);
      c = x * Q(0, 2) + y * Q(1, 2) + z * Q(2, 2);
    };
    const Own own = own_of(node);
    times(own[At], own[At + 1], own[At + 2]);
    for_each_neighbour(node, [&](const Own&, const Coupling& c) {
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) times(c(At, k), c(At + 1, k), c(At + 2, k));
    });
    Scalar square[3][3];
    HAPBEAM_UNROLL
    for (int i = 0; i < 3; ++i) {
      HAPBEAM_UNROLL
      for (int j = 0; j < 3; ++j) square[i][j] = own(At + i, At + j);
      times(square[i][0], square[i][1], square[i][2]);
    }
    HAPBEAM_UNROLL
    for (int j = 0; j < 3; ++j) {
      times(square[0][j], square[1][j], square[2][j]);
      HAPBEAM_UNROLL
      for (int i = j; i < 3; ++i) own(At + i, At + j) = square[i][j];
    }
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k)
      if (k < At || k >= At + 3) times(own(k, At), own(k, At + 1), own(k, At + 2));
  }
  /// An unknown of a node is from now on its old self and a part of three others, after all elements are in:
  /// old = new - part · (unknowns from Others on).
  template <int Unknown, int Others, class Part>
  void lean(int node, const Part& part) noexcept {
    const Own own = own_of(node);
    for_each_neighbour(node, [&](const Own&, const Coupling& c) {
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) {
        const Scalar by = c(Unknown, k);
        HAPBEAM_UNROLL
        for (int j = 0; j < 3; ++j) c(Others + j, k) -= part[j] * by;
      }
    });
    HAPBEAM_UNROLL
    for (int j = 0; j < 3; ++j) {
      const int other = Others + j;
      own[other] -= part[j] * own[Unknown];
      own(other, other) += part[j] * (part[j] * own(Unknown, Unknown) - 2 * own(Unknown, other));
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k)
        if (k != other) own(k, other) -= part[j] * own(k, Unknown);
    }
  }

  /// Prescribes the increment of one degree of freedom (in a plane 0: u, 1: w, 2: θ) of a node, after all elements are in: its
  /// column goes to the right-hand side, its row answers 0.  Inlined by intent, as hold(): the caller knows the component.
  [[gnu::always_inline]] void prescribe(int node, int component, Scalar increment) noexcept {
    const auto take = [increment](Scalar& rhs, Scalar& entry) {
      rhs -= increment * entry;
      entry = 0;
    };
    const Own own = own_of(node);
    for (int k = 0; k < component; ++k) take(own[k], own(component, k));
    for (int k = component + 1; k < Block; ++k) take(own[k], own(k, component));
    own(component, component) = 1;  // not the old entry, whose sign would count as a pivot's
    own[component] = 0;
    for_each_neighbour(node, [&](const Own& other, const Coupling& c) {
      for (int k = 0; k < Block; ++k) take(other[k], c(component, k));
    });
  }

  /// The same for the one degree of freedom whose reaction() is wanted, after all others are prescribed.
  [[gnu::always_inline]] void hold(int node, int component, Scalar increment) noexcept {
    const Own own = own_of(node);
    const Scalar diagonal = own(component, component);
    held_ = node;
    held_by_loads_ = diagonal * increment - own[component];
    held_energy_ = diagonal * increment * increment;
    for (int k = 0; k < Block; ++k) {
      held_by_[0][k] = held_by_[2][k] = 0;
      held_by_[1][k] = k == component ? Scalar(0) : own(k, component);
    }
    for_each_neighbour(node, [&](const Own& other, const Coupling& c) {
      Scalar* const to = other.before ? held_by_[0] : held_by_[2];
      for (int k = 0; k < Block; ++k) to[k] = c(component, k);
    });
    prescribe(node, component, increment);
  }

  /// Factors and solves.  @return ok | singular | non_finite
  Status solve() noexcept;

  /// xᵀKx of the last solve() [J]: the increment's length in the norm of the tangent, squared; negative where K is not
  /// positive along it.  No less than what the increment of hold() costs while all else stays: in two elements between
  /// clamped ends nothing else moves when their middle is pressed, and x is zero however far that goes.
  Scalar energy() const noexcept { return energy_; }

  /// Increment of one node, after solve(); 0 where it was prescribed.
  [[gnu::always_inline]] Vector increment(int node) const noexcept {
    const Place at = place(node);
    Vector increment;
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) increment[k] = rows_[at.row].x[k].a[at.lane];
    return increment;
  }

  /// What holds the degree of freedom of hold() after the increment, of the linear equations: its row of r + Kx [N].
  Scalar reaction() const noexcept {
    Scalar sum = held_by_loads_;
    for (int k = -1; k <= 1; ++k) {
      if (held_ + k < 0 || held_ + k > last_) continue;
      const Vector x = increment(held_ + k);
      for (int i = 0; i < Block; ++i) sum += held_by_[k + 1][i] * x[i];
    }
    return sum;
  }

  /// Number of negative pivots of the last solve(): the number of negative eigenvalues of the tangent.
  int negative_pivots() const noexcept { return negative_pivots_; }

 private:
  /// The left chain of an odd number of elements begins with none.
  template <class Tangent, class Residual>
  static void leave_first_out(Tangent& K, Residual& r) noexcept {
    for (int j = 0; j < 2 * Block; ++j) {
      r[j].set(0, 0);
      for (int i = 0; i < 2 * Block; ++i) K(i, j).set(0, 0);
    }
  }
  /// @param count  of rows; a constant mostly
  template <class Count, class Tangent, class Residual>
  void add_rows(int row, Count count, const Tangent& K, const Residual& r) noexcept {
    using Wide = std::decay_t<decltype(r[0])>;
    constexpr int abreast = Wide::size / 2;
    Row* const rows = &rows_[row];
    const auto pair = [](const Wide& wide, int k) { return Lanes(wide[2 * k], wide[2 * k + 1]); };
    // Of what belongs to a node: the share of the element on the way to the middle, and that of the one before.
    const auto add = [&](auto&& at, const Wide& own, const Wide& next) {
      const Wide outer = in_turn(own, next), inner = in_turn(next, own);
      Lanes before = at(rows[0]).get();
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
        add(
            [ i, j ](Row & at) -> auto& { return at.block[triangle(i, j)]; }, K(i, j),
            K(Block + i, Block + j));
      add(
          [j](Row & at) -> auto& { return at.x[j]; }, -r[j], -r[Block + j]);
      HAPBEAM_UNROLL
      for (int i = 0; i < Block; ++i) {
        const Wide coupling = in_turn(K(i, Block + j), K(j, Block + i));
        HAPBEAM_UNROLL
        for (int k = 0; k < abreast; ++k)
          if (k < count) rows[k].coupling[i][j].set(pair(coupling, k));
      }
    }
  }
  /// Both chains share the middle node, which stands in lane 0.
  void join_middle() noexcept {
    const auto join = [](Number& entry) { entry.a[0] += entry.a[1], entry.a[1] = 0; };
    for (auto& entry : rows_[pairs_].block) join(entry);
    for (auto& entry : rows_[pairs_].x) join(entry);
  }

  static constexpr int triangle_size = detail::triangle_size<Block>;
  static constexpr int triangle(int i, int j) noexcept { return detail::triangle<Block>(i, j); }

  static constexpr int columns = detail::columns_abreast<Scalar, Block>;
  static constexpr int strips = (Block + columns - 1) / columns, padded = strips * columns;
  using Strip = detail::Strip<Scalar, columns>;

  /// A node of the left chain in lane 0 and one of the right chain in lane 1; the middle node, lane 0, is the last row.
  /// Eliminating them leaves the diagonal as it is, for the last look at the pivots, and puts L below it, P⁻¹Y into the coupling
  /// to the node that is eliminated later, and P⁻¹L⁻¹ of the right-hand side into x.
  struct Row {
    Number block[triangle_size];
    Number coupling[Block][padded];  ///< own unknown, that of the next node on the way
    Number x[Block];                 ///< right-hand side, after solve() the increment
  };
  struct Place {
    int row, lane;
  };
  [[gnu::always_inline]] Place place(int node) const noexcept {
    const int from_left = node + odd_;
    return from_left <= pairs_ ? Place{from_left, 0} : Place{last_ - node, 1};
  }
  /// Rows, less one: PerNode has one more than elements, and two elements at least.
  static constexpr int half(int elements) noexcept {
    return elements == Eigen::Dynamic ? Eigen::Dynamic : elements < 3 ? 2 : (elements + 1) / 2;
  }

  /// Block and right-hand side of a node.
  struct Own {
    Scalar *block, *x;
    bool before;  // the node that was asked for

    [[gnu::always_inline]] Scalar& operator()(int i, int j) const noexcept {
      const int low = (std::min)(i, j), high = (std::max)(i, j);
      return block[2 * triangle(high, low)];
    }
    [[gnu::always_inline]] Scalar& operator[](int i) const noexcept { return x[2 * i]; }
  };
  [[gnu::always_inline]] Own own_of(int node, bool before = false) noexcept {
    const Place at = place(node);
    Row& row = rows_[at.row];
    return {row.block[0].a + at.lane, row.x[0].a + at.lane, before};
  }
  /// What couples a node with another: its own unknown, that of the other.
  struct Coupling {
    Scalar* entries;
    int own, other;
    [[gnu::always_inline]] Scalar& operator()(int i, int j) const noexcept {
      return entries[2 * (own * i + other * j)];
    }
  };
  /// Calls f(Own of a neighbour, Coupling) for each of the two.
  template <class F>
  [[gnu::always_inline]] void for_each_neighbour(int node, F&& f) noexcept {
    const int lane = place(node).lane;
    // A row has what couples it with the next on the way to the middle.
    if (node > 0) {
      Row& row = rows_[place(lane == 0 ? node - 1 : node).row];
      f(own_of(node - 1, true),
        Coupling{row.coupling[0][0].a + lane, lane == 0 ? 1 : padded, lane == 0 ? padded : 1});
    }
    if (node < last_) {
      const Place next = place(node + 1);
      Row& row = rows_[next.lane == 0 ? place(node).row : next.row];
      f(own_of(node + 1),
        Coupling{row.coupling[0][0].a + next.lane, next.lane == 0 ? padded : 1, next.lane == 0 ? 1 : padded});
    }
  }

  /// @param front, f  in: block and right-hand side of the nodes of a row, less what the nodes before took away;  out: of the next
  void eliminate(int row, Lanes* front, Lanes* f, Lanes& energy, detail::Pivots<Scalar>& pivots) noexcept {
    Row& at = rows_[row];
    const Row& next = rows_[row + 1];
    const Factor factor(front);
    Lanes zx[Block];
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      const Number& assembled = at.block[triangle(j, j)];
      for (int lane = 0; lane < 2; ++lane) pivots.see(factor.p[j][lane], assembled.a[lane]);
      HAPBEAM_UNROLL
      for (int i = j + 1; i < Block; ++i) at.block[triangle(i, j)].set(factor.l[triangle(i, j)]);
    }
    factor.forward(f);
    factor.scale(f, zx);
    energy = detail::less<Block>(energy, f, zx);
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) at.x[k].set(zx[k]);
    // L⁻¹C and P⁻¹L⁻¹C, a few columns side by side.
    Strip y[strips][Block];
    HAPBEAM_UNROLL
    for (int g = 0; g < strips; ++g) {
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) y[g][k] = Strip::load(at.coupling[k][g * columns].a);
    }
    HAPBEAM_UNROLL
    for (int k = 0; k + 1 < Block; ++k) {
      HAPBEAM_UNROLL
      for (int i = k + 1; i < Block; ++i) {
        const Strip l = Strip::repeat(at.block[triangle(i, k)].a);
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
      for (int g = 0; g < strips; ++g) (y[g][k] * inverse).store(at.coupling[k][g * columns].a);
    }
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      const auto column = [&y](int i, int k) { return y[i / columns][k].column(i % columns); };
      Strip z[Block];
      Lanes sum = next.x[j].get();
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) {
        z[k] = Strip::repeat(at.coupling[k][j].a);
        sum = subtract_product(sum, column(j, k), zx[k]);
      }
      f[j] = sum;
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) {
        if (i > j && i % columns != 0) continue;  // stands beside the one before
        if (i % columns == 0 && i + columns <= Block) {
          Strip strip = Strip::load(next.block[triangle(i, j)].a);
          HAPBEAM_UNROLL
          for (int k = 0; k < Block; ++k) strip = subtract_product(strip, y[i / columns][k], z[k]);
          HAPBEAM_UNROLL
          for (int c = 0; c < columns; ++c) front[triangle(i, j) + c] = strip.column(c);
        } else {
          Lanes entry = next.block[triangle(i, j)].get();
          HAPBEAM_UNROLL
          for (int k = 0; k < Block; ++k) entry = subtract_product(entry, column(i, k), z[k].column(0));
          front[triangle(i, j)] = entry;
        }
      }
    }
  }

  /// Solves for the node at which both chains end.  @param x  in: right-hand sides of both, out: its increment in both lanes
  void join(Lanes* front, Lanes* x, Lanes& energy, detail::Pivots<Scalar>& pivots) noexcept {
    Row& at = rows_[pairs_];
    for (int k = 0; k < triangle_size; ++k) front[k] = front[k] + front[k].swapped();
    for (int k = 0; k < Block; ++k) x[k] = x[k] + x[k].swapped();
    const Factor factor(front);
    Lanes z[Block];
    factor.forward(x);
    factor.scale(x, z);
    const Lanes twice = detail::less<Block>(Lanes::both(0), x, z);
    energy = energy + twice * Lanes(1, 0);
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) pivots.see(factor.p[j][0], at.block[triangle(j, j)].a[0]);
    HAPBEAM_UNROLL
    for (int j = Block - 1; j >= 0; --j) {
      HAPBEAM_UNROLL
      for (int k = Block - 1; k > j; --k) z[j] = subtract_product(z[j], factor.l[triangle(k, j)], z[k]);
    }
    for (int k = 0; k < Block; ++k) x[k] = z[k], at.x[k].a[0] = z[k][0];
  }

  /// Increments of a row's nodes from those of the next on their way, whose components come in the order last to first.
  void substitute(int row, Lanes* x) noexcept {
    Row& at = rows_[row];
    Lanes rest[Block];
    HAPBEAM_UNROLL
    for (int i = 0; i < Block; ++i) {
      rest[i] = at.x[i].get();
      HAPBEAM_UNROLL
      for (int k = Block - 1; k >= 0; --k) rest[i] = subtract_product(rest[i], at.coupling[i][k].get(), x[k]);
    }
    HAPBEAM_UNROLL
    for (int j = Block - 1; j >= 0; --j) {
      HAPBEAM_UNROLL
      for (int k = Block - 1; k > j; --k)
        rest[j] = subtract_product(rest[j], at.block[triangle(k, j)].get(), rest[k]);
    }
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) at.x[k].set(x[k] = rest[k]);
  }

  int last_, odd_, pairs_;
  detail::PerNode<Row, half(Elements), half(MaxElements)> rows_;
  int negative_pivots_ = 0;
  Scalar energy_ = 0;
  int held_ = 0;  // node of hold()
  Scalar held_energy_ = 0;
  Scalar held_by_loads_ = 0;       // its row: what is known,
  Scalar held_by_[3][Block] = {};  // and the entries of the node before, of its own and of the node after
};

// Outside of the class: only so does "extern template class BlockTridiagonal<…>;" keep a compiler from it.
template <typename Scalar, int Elements, int MaxElements, int Block>
Status BlockTridiagonal<Scalar, Elements, MaxElements, Block>::solve() noexcept {
  detail::Pivots<Scalar> pivots;
  Lanes front[triangle_size], f[Block], energy = Lanes::both(0);  // with the sign turned
  for (int k = 0; k < triangle_size; ++k) front[k] = rows_[0].block[k].get();
  for (int k = 0; k < Block; ++k) f[k] = rows_[0].x[k].get();
  for (int row = 0; row < pairs_; ++row) eliminate(row, front, f, energy, pivots);
  join(front, f, energy, pivots);
  for (int row = pairs_; row > 0; --row) substitute(row - 1, f);
  energy_ = -(energy[0] + energy[1]);
  if (held_energy_ > std::abs(energy_)) energy_ = held_energy_;
  negative_pivots_ = pivots.negative;
  if (pivots.lowest <= 0) return Status::singular;
  return std::isfinite(pivots.lowest) && std::isfinite(energy_) ? Status::ok : Status::non_finite;
}

}  // namespace hapbeam
