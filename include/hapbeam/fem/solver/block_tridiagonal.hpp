// SPDX-License-Identifier: MIT
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
// Real-time: noexcept, no allocation after construction, O(n).
// Source: Golub and Van Loan, Matrix Computations, 4.5.1; from both ends: Dongarra and others, LINPACK Users' Guide, 7.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>

#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/element/pack.hpp>
#include <hapbeam/fem/solver/chain_node.hpp>
#include <hapbeam/fem/solver/chain_row.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

namespace detail {

/// Groups of rows of a chain, less one: PerNode has one more than elements, and two elements at least.
constexpr int row_groups(int elements, int size) noexcept {
  return elements == Eigen::Dynamic ? Eigen::Dynamic : (std::max)((elements + 1) / 2 / size, 2);
}

}  // namespace detail

/// @tparam Block  unknowns of a node
template <typename Scalar, int Elements = Eigen::Dynamic, int MaxElements = Elements, int Block = 3>
class BlockTridiagonal {
  using Lanes = detail::Lanes<Scalar>;
  /// As many rows lie side by side as elements are computed.
  static constexpr int abreast = detail::pack_size<Scalar> / 2;
  using Rows = detail::ChainRows<Scalar, Block, abreast>;
  using Row = detail::ChainRow<Scalar, Block, abreast>;
  using Vector = Eigen::Matrix<Scalar, Block, 1>;

 public:
  explicit BlockTridiagonal(int elements)
      : last_(elements),
        odd_(elements % 2),
        pairs_((elements + odd_) / 2),
        rows_(detail::row_groups(elements, abreast)) {
    // The left chain of an odd number of elements has one node more, to which nothing is coupled.
    if (odd_)
      for (int k = 0; k < Block; ++k) row(0).block(k, k).a[0] = 1;
  }

  /// Adds elements that were computed side by side, in the order of PairOrder, two at a time.
  /// @param first  place of the first, even; 0 starts a new system
  /// @param K  (i, j) -> entries of all: of the lower triangles of both nodes, and of what couples the first with the second
  /// @param r  [i] -> entries of all
  template <class Tangent, class Residual>
  void add_pairs(int first, const Tangent& K, const Residual& r) noexcept {
    const int row = first / 2, count = (std::min)(abreast, pairs_ - row);
    const bool odd = odd_ && first == 0;
    if (first == 0) {
      const Row start = this->row(0);
      HAPBEAM_UNROLL
      for (int k = 0; k < Rows::coupling; ++k) start.entry(k).set(Lanes(0));
    }
    Rows* const rows = &rows_[row / abreast];
    if (count == abreast && !odd) Rows::template add<true>(rows, count, odd, K, r);
    else Rows::template add<false>(rows, count, odd, K, r);
    if (odd)
      for (int k = 0; k < Block; ++k) this->row(0).block(k, k).a[0] = 1;
    if (row + count == pairs_) join_middle();
  }

  /// Adds to the tangent and to the residual of one node, after all elements are in.  @param K  (i, j) -> entry of a lower triangle
  template <class Tangent, class Residual>
  void add_at(int node, const Tangent& K, const Residual& r) noexcept {
    const auto own = own_of(node);
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) own(i, j) += K(i, j);
      own[j] -= r[j];
    }
  }
  /// Adds to the tangent and to the residual of both nodes of an element, after all are in.   @param K, r  as of add()
  template <class Tangent, class Residual>
  void add_more(int e, const Tangent& K, const Residual& r) noexcept {
    const Place left = place(e), right = place(e + 1);
    const auto a = own_of(e), b = own_of(e + 1);
    const bool inward = right.lane == 0;
    const Row coupled = row(inward ? left.row : right.row);
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) a(i, j) += K(i, j), b(i, j) += K(Block + i, Block + j);
      a[j] -= r[j], b[j] -= r[Block + j];
      HAPBEAM_UNROLL
      for (int i = 0; i < Block; ++i)
        (inward ? coupled.coupling(i, j).a[0] : coupled.coupling(j, i).a[1]) += K(i, Block + j);
    }
  }
  /// Adds to a node, after all elements are in, what is alike along each axis of two vectors that its first six unknowns are.
  /// @param a, b, c  of the first, of both, of the second   @param r  [i] -> residual
  template <class Residual>
  void add_even(int node, Scalar a, Scalar b, Scalar c, const Residual& r) noexcept {
    const auto own = own_of(node);
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k) own(k, k) += a, own(3 + k, k) += b, own(3 + k, 3 + k) += c;
    HAPBEAM_UNROLL
    for (int k = 0; k < 6; ++k) own[k] -= r[k];
  }
  /// The same of what couples the nodes of element e.   @param a, b, c, d  of the first node's first vector with both of the second, of its second with them
  void couple_even(int e, Scalar a, Scalar b, Scalar c, Scalar d) noexcept {
    HAPBEAM_UNROLL
    for (int k = 0; k < 3; ++k)
      couple_at(e, k, k, a), couple_at(e, k, 3 + k, b), couple_at(e, 3 + k, k, c),
          couple_at(e, 3 + k, 3 + k, d);
  }
  /// One entry more of what couples the nodes of element e.   @param i, j  of the first node, and of the second
  void couple_at(int e, int i, int j, Scalar by) noexcept {
    const Place left = place(e), right = place(e + 1);
    const bool inward = right.lane == 0;
    const Row coupled = row(inward ? left.row : right.row);
    (inward ? coupled.coupling(i, j).a[0] : coupled.coupling(j, i).a[1]) += by;
  }
  /// What the tangent so far has of a node, and of that and the other one of an element.  @param own, coupled  out: (i, j) -> entry, j of the other
  template <class Matrix>
  void row_of(int node, int other, Matrix& own, Matrix& coupled) noexcept {
    const auto block = own_of(node);
    for (int j = 0; j < Block; ++j)
      for (int i = 0; i < Block; ++i) own(i, j) = block(i, j);
    for_each_neighbour(node, [&](const auto&, const auto& c, bool left) {
      if (left != (other < node)) return;
      for (int j = 0; j < Block; ++j)
        for (int i = 0; i < Block; ++i) coupled(i, j) = c(i, j);
    });
  }
  /// Residual of one unknown of a node so far.
  Scalar residual(int node, int component) noexcept { return -own_of(node)[component]; }

  /// Three unknowns of a node from At on become those along other axes, after all elements are in:  old = Q new.
  template <int At, class Matrix>
  void turn(int node, const Matrix& Q) noexcept {
    at(node).template turn<At>(Q);
  }
  /// An unknown of a node is from now on its old self and a part of three others, after all elements are in:
  /// old = new - part · (unknowns from Others on).
  template <int Unknown, int Others, class Part>
  void lean(int node, const Part& part) noexcept {
    at(node).template lean<Unknown, Others>(part);
  }
  /// Prescribes the increment of a node, after all elements are in, but for how much longer r' becomes along u: of its unknowns 3 to 5,
  /// which are those of r', the last one is that from now on.   @param by  [i] -> increment of unknown i, as it was
  template <class Three, class Increment>
  void clamp(int node, const Three& u, const Increment& by) noexcept {
    at(node).clamp(u, by);
  }

  /// Prescribes the increment of one degree of freedom (in a plane 0: u, 1: w, 2: θ) of a node, after all elements are in: its
  /// column goes to the right-hand side, its row answers 0.  Inlined by intent: the caller knows the component.
  [[gnu::always_inline]] void prescribe(int node, int component, Scalar increment) noexcept {
    at(node).prescribe(component, increment);
  }

  /// Factors and solves.  @return ok | singular | non_finite
  Status solve() noexcept {
    const Status status = factor();
    substitute();
    return status;
  }

  // The two halves of it, between which the right-hand side may still change by what is found of further ones.

  /// Factors K = LPLᵀ, and takes the right-hand side to L⁻¹.  @return ok | singular | non_finite
  Status factor() noexcept;
  /// A right-hand side b of two neighbouring nodes, as L⁻¹b.  It begins at the node that is eliminated first, and ends in the middle.
  struct Column {
    struct Half {
      Scalar whole[Block], scaled[Block];  // L⁻¹b, P⁻¹L⁻¹b
    };
    int row = 0, lane = 0;
    detail::PerNode<Half, detail::row_groups(Elements, 1), detail::row_groups(MaxElements, 1)> way;
    explicit Column(int elements) : way((std::max)((elements + 1) / 2, 2)) {}
  };
  /// To be called after factor().   @param e  element of the two nodes   @param b  [i] -> entry, 0 where it is prescribed
  template <class Entries>
  void forward(int e, const Entries& b, Column& column) const noexcept {
    const Place left = place(e), right = place(e + 1);
    const bool from_left = left.row < right.row;
    const int outer = from_left ? 0 : Block, inner = Block - outer;
    column.row = from_left ? left.row : right.row;
    column.lane = from_left ? left.lane : right.lane;
    Scalar f[Block], next[Block];
    for (int k = 0; k < Block; ++k) f[k] = b[outer + k], next[k] = b[inner + k];
    for (int i = column.row;; ++i) {
      auto& half = column.way[i];
      Row::forward(row(i), i < pairs_ ? column.lane : 0, f, half.scaled);
      for (int k = 0; k < Block; ++k) half.whole[k] = f[k];
      if (i == pairs_) return;
      Row::pass_on(row(i), column.lane, f, next);
      for (int k = 0; k < Block; ++k) f[k] = next[k], next[k] = 0;
    }
  }
  /// bᵀK⁻¹b of two columns.
  Scalar product(const Column& a, const Column& b) const noexcept {
    Scalar sum = 0;
    for (int i = a.lane == b.lane ? (std::max)(a.row, b.row) : pairs_; i <= pairs_; ++i)
      for (int k = 0; k < Block; ++k) sum += a.way[i].whole[k] * b.way[i].scaled[k];
    return sum;
  }
  /// bᵀK⁻¹ of the right-hand side.
  Scalar product(const Column& b) const noexcept {
    Scalar sum = 0;
    for (int i = b.row; i <= pairs_; ++i)
      for (int k = 0; k < Block; ++k) sum += b.way[i].whole[k] * row(i).x(k).a[i < pairs_ ? b.lane : 0];
    return sum;
  }
  /// Adds so many times a column to the right-hand side.
  void add(const Column& b, Scalar times) noexcept {
    for (int i = b.row; i <= pairs_; ++i) {
      Scalar* const x = row(i).x(0).a + (i < pairs_ ? b.lane : 0);
      for (int k = 0; k < Block; ++k) x[2 * abreast * k] += times * b.way[i].scaled[k];
    }
  }
  /// From L⁻¹ of the right-hand side to the increments.
  void substitute() noexcept {
    Lanes later[Block];
    Row::substitute_last(row(pairs_), later);
    for (int i = pairs_; i > 0; --i) Row::substitute(row(i - 1), later);
  }

  /// xᵀKx of the last solve() [J]: the increment's length in the norm of the tangent, squared; negative where K is not
  /// positive along it.
  Scalar energy() const noexcept { return energy_; }

  /// Increment of one node, after solve(); 0 where it was prescribed.
  [[gnu::always_inline]] Vector increment(int node) const noexcept {
    const Place at = place(node);
    Vector increment;
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) increment[k] = row(at.row).x(k).a[at.lane];
    return increment;
  }

  /// The same of the nodes from a place of PairOrder on that is a multiple of the lanes.  @param x  out
  template <std::size_t Lanes>
  void increments(int first, Scalar (&x)[Block][Lanes]) const noexcept {
    static_assert(Lanes == 2 * abreast, "as many nodes as rows of both chains");
    const auto& rows = rows_[first / static_cast<int>(Lanes)];
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) std::memcpy(x[k], rows.entry[Rows::x + k], sizeof x[k]);
  }

  /// Number of negative pivots of the last solve(): the number of negative eigenvalues of the tangent.
  int negative_pivots() const noexcept { return negative_pivots_; }

 private:
  /// Both chains share the middle node, which stands in lane 0.
  void join_middle() noexcept {
    const Row middle = row(pairs_);
    HAPBEAM_UNROLL
    for (int k = 0; k < Rows::coupling; ++k) {
      const Lanes both = middle.entry(k).get();
      middle.entry(k).set(detail::lanes<Scalar>(both[0] + both[1], 0));
    }
  }

  static constexpr int triangle_size = detail::triangle_size<Block>;

  struct Place {
    int row, lane;
  };
  [[gnu::always_inline]] Place place(int node) const noexcept {
    const int from_left = node + odd_;
    return from_left <= pairs_ ? Place{from_left, 0} : Place{last_ - node, 1};
  }
  [[gnu::always_inline]] Row row(int i) const noexcept {
    const unsigned group = static_cast<unsigned>(i) / abreast, k = static_cast<unsigned>(i) % abreast;
    Rows& rows = const_cast<Rows&>(rows_[static_cast<int>(group)]);
    return {&rows.entry[0][k], rows.strip[0][Rows::place(static_cast<int>(k))]};
  }

  [[gnu::always_inline]] detail::NodeBlock<Scalar, Block, 2 * abreast> own_of(int node) const noexcept {
    const Place at = place(node);
    const Row row = this->row(at.row);
    return {row.block(0, 0).a + at.lane, row.x(0).a + at.lane};
  }
  [[gnu::always_inline]] auto at(int node) noexcept {
    return detail::ChainNode{own_of(node), [this, node](auto&& f) { this->for_each_neighbour(node, f); }};
  }
  /// Calls f(block of a neighbour, coupling with it, whether it is the left one) for each of the two.
  template <class F>
  [[gnu::always_inline]] void for_each_neighbour(int node, F&& f) noexcept {
    // A row has what couples it with the next on the way to the middle.
    const auto coupling = [this](int row, int lane, bool inward) {
      return detail::NodeCoupling<Scalar, Rows>{this->row(row).coupling(0, 0).a + lane, inward};
    };
    const Place here = place(node);
    if (node > 0) {
      const bool inward = here.lane == 1;
      f(own_of(node - 1), coupling(inward ? here.row : here.row - 1, here.lane, inward), true);
    }
    if (node < last_) {
      const Place next = place(node + 1);
      const bool inward = next.lane == 0;
      f(own_of(node + 1), coupling(inward ? here.row : next.row, next.lane, inward), false);
    }
  }

  int last_, odd_, pairs_;
  detail::PerNode<Rows, detail::row_groups(Elements, abreast), detail::row_groups(MaxElements, abreast)>
      rows_;
  int negative_pivots_ = 0;
  Scalar energy_ = 0;
};

// Outside of the class: only so does "extern template class BlockTridiagonal<…>;" keep a compiler from it.
template <typename Scalar, int Elements, int MaxElements, int Block>
Status BlockTridiagonal<Scalar, Elements, MaxElements, Block>::factor() noexcept {
  detail::Pivots<Scalar> pivots;
  Lanes front[triangle_size], f[Block], energy = Lanes(0);  // with the sign turned
  for (int k = 0; k < triangle_size; ++k) front[k] = row(0).entry(k).get();
  for (int k = 0; k < Block; ++k) f[k] = row(0).x(k).get();
  for (int i = 0; i < pairs_; ++i) Row::eliminate(row(i), row(i + 1), front, f, energy, pivots);
  Row::join(row(pairs_), front, f, energy, pivots);
  energy_ = -(energy[0] + energy[1]);
  negative_pivots_ = pivots.negative();
  const Status status = pivots.status();
  return status == Status::ok && !std::isfinite(energy_) ? Status::non_finite : status;
}

namespace detail {

/// Unknowns of a node between such elements.
template <class Element>
constexpr int unknowns_of() noexcept {
  if constexpr (dimension_of<Element> == 2) return 3;
  else return Element::unknowns;
}
/// What solves for a chain of such elements.  A program that measures another assembler specialises it for an element of its own.
template <class Element, typename Scalar, int Elements, int MaxElements>
struct Assembling {
  using Type = BlockTridiagonal<Scalar, Elements, MaxElements, unknowns_of<Element>()>;
};
template <class Element, typename Scalar, int Elements, int MaxElements>
using AssemblerOf = typename Assembling<Element, Scalar, Elements, MaxElements>::Type;

}  // namespace detail

}  // namespace hapbeam
