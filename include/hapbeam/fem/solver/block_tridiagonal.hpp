// The assembler for a chain of elements: a symmetric block-tridiagonal system, solved by LDLᵀ.
// A block is as large as a node has unknowns: 3 in a plane, 6 or 7 in space.
//
// Element i couples node i with node i + 1 alone, so the tangent is
//
//        | D0  C0          |
//    K = | C0ᵀ D1  C1      |       Di' = Di - C(i-1)ᵀ D(i-1)'⁻¹ C(i-1)
//        |     C1ᵀ D2  ... |
//
// and one sweep factors and solves in O(n).  It runs from both ends to the middle node: each elimination waits for
// the one before it, and most of a sweep is waiting, so two chains side by side take hardly longer than one.
// With Di' = LPLᵀ the update is  Yᵀ(P⁻¹Y),  Y = L⁻¹C:  symmetric, and free of the second half of a solve.
// No pivoting: the pivots of LDLᵀ carry the inertia of K, so an indefinite tangent (a beam beyond its buckling load)
// is solved and counted, not rejected.
// Real-time: noexcept, no allocation after construction, about 75 multiply-adds and 3 divisions a node of 3 unknowns.
// Source: Golub and Van Loan, Matrix Computations, 4.5.1; from both ends: Dongarra and others, LINPACK Users' Guide, 7.
#pragma once

#include <cmath>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// @tparam Block  unknowns of a node
template <typename Scalar, int Elements = Eigen::Dynamic, int MaxElements = Elements, int Block = 3>
class BlockTridiagonal {
  using Diagonal = detail::Symmetric<Scalar, Block>;
  using Factor = detail::Ldlt<Scalar, Block>;
  using Pivots = detail::Pivots<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Block, 1>;
  using Matrix = Eigen::Matrix<Scalar, Block, Block>;

 public:
  explicit BlockTridiagonal(int elements) : rows_(elements) {}

  /// Adds element e: its tangent, and its residual to the right-hand side with the sign turned.
  /// Elements come in order, 0 to n - 1; element 0 starts a new system.
  [[gnu::always_inline]] void add(int e, const Eigen::Matrix<Scalar, 2 * Block, 2 * Block>& K,
                                  const Eigen::Matrix<Scalar, 2 * Block, 1>& r) noexcept {
    Row& a = rows_[e];
    Row& b = rows_[e + 1];
    if (e == 0) a.block = {}, a.x.setZero(), held_energy_ = 0;
    // Entry by entry: g++ 12 -O3 miscompiles a = {a.a00 + …, …} where this function is not inlined further.
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) a.block(i, j) += K(i, j), b.block(i, j) = K(Block + i, Block + j);
      HAPBEAM_UNROLL
      for (int i = 0; i < Block; ++i) a.coupling(i, j) = K(i, Block + j);
      a.x[j] -= r[j];
      b.x[j] = -r[Block + j];
    }
  }

  /// Prescribes the increment of one degree of freedom (in a plane 0: u, 1: w, 2: θ) of a node, after all elements are in: its
  /// column goes to the right-hand side, its row answers 0.  Inlined by intent, as hold(): the caller knows the component.
  [[gnu::always_inline]] void prescribe(int node, int component, Scalar increment) noexcept {
    Row& row = rows_[node];
    const auto take = [&](int k, Scalar& entry) {
      row.x[k] -= increment * entry;
      entry = 0;
    };
    for (int k = 0; k < component; ++k) take(k, row.block(component, k));
    for (int k = component + 1; k < Block; ++k) take(k, row.block(k, component));
    row.block(component, component) = 1;  // not the old entry, whose sign would count as a pivot's
    row.x[component] = 0;
    if (node > 0) {
      Row& before = rows_[node - 1];
      before.x -= increment * before.coupling.col(component);
      before.coupling.col(component).setZero();
    }
    if (node + 1 < rows_.size()) {
      rows_[node + 1].x -= increment * row.coupling.row(component).transpose();
      row.coupling.row(component).setZero();
    }
  }

  /// The same for the one degree of freedom whose reaction() is wanted, after all others are prescribed.
  [[gnu::always_inline]] void hold(int node, int component, Scalar increment) noexcept {
    const Row& row = rows_[node];
    const Scalar own = row.block(component, component);
    held_ = node;
    held_by_loads_ = own * increment - row.x[component];
    held_energy_ = own * increment * increment;
    held_by_.setZero();
    if (node > 0) held_by_.row(0) = rows_[node - 1].coupling.col(component).transpose();
    for (int k = 0; k < component; ++k) held_by_(1, k) = row.block(component, k);
    for (int k = component + 1; k < Block; ++k) held_by_(1, k) = row.block(k, component);
    if (node + 1 < rows_.size()) held_by_.row(2) = row.coupling.row(component);
    prescribe(node, component, increment);
  }

  /// Factors and solves.  @return ok | singular | non_finite
  Status solve() noexcept;

  /// xᵀKx of the last solve() [J]: the increment's length in the norm of the tangent, squared; negative where K is not
  /// positive along it.  No less than what the increment of hold() costs while all else stays: in two elements between
  /// clamped ends nothing else moves when their middle is pressed, and x is zero however far that goes.
  Scalar energy() const noexcept { return energy_; }

  /// Increment of one node, after solve(); 0 where it was prescribed.
  const Vector& increment(int node) const noexcept { return rows_[node].x; }

  /// What holds the degree of freedom of hold() after the increment, of the linear equations: its row of r + Kx [N].
  Scalar reaction() const noexcept {
    Scalar sum = held_by_loads_;
    for (int k = -1; k <= 1; ++k)
      if (held_ + k >= 0 && held_ + k < rows_.size()) sum += held_by_.row(k + 1).dot(rows_[held_ + k].x);
    return sum;
  }

  /// Number of negative pivots of the last solve(): the number of negative eigenvalues of the tangent.
  int negative_pivots() const noexcept { return negative_pivots_; }

 private:
  /// A node.  Eliminating it leaves the diagonal as it is, for the last look at the pivots, and puts L below it, P⁻¹Y
  /// into the coupling to the node that is eliminated later, and P⁻¹L⁻¹ of the right-hand side into x.
  struct Row {
    Diagonal block;   ///< Di
    Matrix coupling;  ///< K(i, i+1)
    Vector x;         ///< right-hand side, after solve() the increment
  };

  /// The node at which a chain stands: its block and right-hand side, less what the nodes before took away.
  struct Front {
    Diagonal block;
    Vector x;
  };

  /// The block that couples a node to the next on its way, (i, j) -> entry.
  template <bool FromRight>
  auto coupling(int node) noexcept {
    Matrix& c = rows_[FromRight ? node - 1 : node].coupling;
    return [&c](int i, int j) -> Scalar& { return FromRight ? c(j, i) : c(i, j); };
  }

  template <bool FromRight>
  void eliminate(int node, Front& front, Pivots& pivots) noexcept {
    using detail::less;
    Row& row = rows_[node];
    const Row& next = rows_[FromRight ? node - 1 : node + 1];
    const Factor factor(front.block);
    pivots.see(factor, row.block);
    keep(factor, row.block);
    const auto c = coupling<FromRight>(node);
    Vector y[Block], z[Block];
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int k = 0; k < Block; ++k) y[j][k] = c(k, j);
      y[j] = factor.forward(y[j]);
      z[j] = factor.scale(y[j]);
    }
    const Vector yx = factor.forward(front.x), zx = factor.scale(yx);
    HAPBEAM_UNROLL
    for (int k = 0; k < Block; ++k) {
      HAPBEAM_UNROLL
      for (int j = 0; j < Block; ++j) c(k, j) = z[j][k];
      row.x[k] = zx[k];
    }
    pivots.energy -= less(Scalar(0), yx, zx);
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int i = j; i < Block; ++i) front.block(i, j) = less(next.block(i, j), y[i], z[j]);
      front.x[j] = less(next.x[j], y[j], zx);
    }
  }

  /// L goes below the diagonal.
  [[gnu::always_inline]] static void keep(const Factor& factor, Diagonal& block) noexcept {
    HAPBEAM_UNROLL
    for (int j = 0; j < Block; ++j) {
      HAPBEAM_UNROLL
      for (int i = j + 1; i < Block; ++i) block(i, j) = factor.l(i, j);
    }
  }

  /// Solves for the node at which both chains end.  Both fronts hold its own block: once is enough.
  Vector join(Row& row, const Front& l, const Front& r, Pivots& pivots) const noexcept {
    Diagonal sum;
    for (int k = 0; k < Block * (Block + 1) / 2; ++k)
      sum.a[k] = l.block.a[k] + (r.block.a[k] - row.block.a[k]);
    const Factor factor(sum);
    pivots.see(factor, row.block);
    const Vector rhs = l.x + (r.x - row.x), y = factor.forward(rhs), z = factor.scale(y);
    pivots.energy -= detail::less(Scalar(0), y, z);
    return row.x = detail::backward(factor.l, z);
  }

  /// Increment of a node from that of the next on its way, whose components come in the order last to first.
  template <bool FromRight>
  Vector substitute(int node, const Vector& next) noexcept {
    Row& row = rows_[node];
    const auto c = coupling<FromRight>(node);
    Vector rest = row.x;
    HAPBEAM_UNROLL
    for (int i = 0; i < Block; ++i) {
      HAPBEAM_UNROLL
      for (int k = Block - 1; k >= 0; --k) rest[i] -= c(i, k) * next[k];
    }
    return row.x = detail::backward(row.block, rest);
  }

  detail::PerNode<Row, Elements, MaxElements> rows_;
  int negative_pivots_ = 0;
  Scalar energy_ = 0;
  int held_ = 0;  // node of hold()
  Scalar held_energy_ = 0;
  Scalar held_by_loads_ = 0;  // its row: what is known,
  Eigen::Matrix<Scalar, 3, Block> held_by_ =
      Eigen::Matrix<Scalar, 3,
                    Block>::Zero();  // and the entries of the node before, of its own and of the node after
};

// Outside of the class: only so does "extern template class BlockTridiagonal<…>;" keep a compiler from it.
template <typename Scalar, int Elements, int MaxElements, int Block>
Status BlockTridiagonal<Scalar, Elements, MaxElements, Block>::solve() noexcept {
  const int last = rows_.size() - 1, pairs = last / 2, middle = pairs;
  Pivots p, q;
  Front left{rows_[0].block, rows_[0].x}, right{rows_[last].block, rows_[last].x};
  // An even number of nodes has one more on the right.
  if (last % 2 != 0) eliminate<true>(last, right, q);
  for (int k = 0; k < pairs; ++k) {
    eliminate<false>(k, left, p);
    eliminate<true>(2 * middle - k, right, q);
  }
  Vector x = join(rows_[middle], left, right, p), y = x;
  for (int k = 1; k <= pairs; ++k) {
    x = substitute<false>(middle - k, x);
    y = substitute<true>(middle + k, y);
  }
  if (last % 2 != 0) substitute<true>(last, y);
  energy_ = p.energy + q.energy;
  if (held_energy_ > std::abs(energy_)) energy_ = held_energy_;
  negative_pivots_ = p.negative + q.negative;
  if (p.lowest <= 0 || q.lowest <= 0) return Status::singular;
  const bool finite = std::isfinite(p.lowest) && std::isfinite(q.lowest) && std::isfinite(energy_);
  return finite ? Status::ok : Status::non_finite;
}

}  // namespace hapbeam
