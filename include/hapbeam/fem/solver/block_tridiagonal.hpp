// The assembler for a chain of elements: a symmetric block-tridiagonal system of 3×3 blocks, solved by LDLᵀ.
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
// is solved and counted, not refused.
// Real-time: noexcept, no allocation after construction, about 75 multiply-adds and 3 divisions a node.
// Source: Golub and Van Loan, Matrix Computations, 4.5.1; from both ends: Dongarra and others, LINPACK Users' Guide, 7.
#pragma once

#include <cmath>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/solver/ldlt3.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

template <typename Scalar, int Elements = Eigen::Dynamic, int MaxElements = Elements>
class BlockTridiagonal {
  using Block = detail::Symmetric3<Scalar>;
  using Factor = detail::Ldlt3<Scalar>;
  using Pivots = detail::Pivots<Scalar>;
  using Vector = Vector3<Scalar>;

 public:
  explicit BlockTridiagonal(int elements) : rows_(elements) {}

  /// Adds element e: its tangent, and its residual to the right-hand side with the sign turned.
  /// Elements come in order, 0 to n - 1; element 0 starts a new system.
  [[gnu::always_inline]] void add(int e, const Matrix6<Scalar>& K, const Vector6<Scalar>& r) noexcept {
    Row& a = rows_[e];
    Row& b = rows_[e + 1];
    if (e == 0) a.block = {0, 0, 0, 0, 0, 0}, a.x.setZero(), held_energy_ = 0;
    // Entry by entry: g++ 12 -O3 miscompiles a = {a.a00 + …, …} where this function is not inlined further.
    a.block.a00 += K(0, 0), a.block.a10 += K(1, 0), a.block.a20 += K(2, 0);
    a.block.a11 += K(1, 1), a.block.a21 += K(2, 1), a.block.a22 += K(2, 2);
    b.block = {K(3, 3), K(4, 3), K(5, 3), K(4, 4), K(5, 4), K(5, 5)};
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) a.coupling(i, j) = K(i, j + 3);
      a.x[j] -= r[j];
      b.x[j] = -r[j + 3];
    }
  }

  /// Prescribes the increment of one degree of freedom (0: u, 1: w, 2: θ) of a node, after all elements are in: its
  /// column goes to the right-hand side, its row answers 0.  Inlined by intent, as hold(): the caller knows the component.
  [[gnu::always_inline]] void prescribe(int node, int component, Scalar increment) noexcept {
    Row& row = rows_[node];
    Block& d = row.block;
    Scalar* const diagonal[] = {&d.a00, &d.a11, &d.a22};
    Scalar* const beside[3][2] = {{&d.a10, &d.a20}, {&d.a10, &d.a21}, {&d.a20, &d.a21}};
    for (int k = 0; k < 2; ++k) {
      Scalar& entry = *beside[component][k];
      row.x[k < component ? k : k + 1] -= increment * entry;
      entry = 0;
    }
    *diagonal[component] = 1;  // not the old entry, whose sign would count as a pivot's
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
    const Block& d = row.block;
    const Scalar own[3][3] = {{d.a00, d.a10, d.a20}, {d.a10, d.a11, d.a21}, {d.a20, d.a21, d.a22}};
    held_ = node;
    held_by_loads_ = own[component][component] * increment - row.x[component];
    held_energy_ = own[component][component] * increment * increment;
    held_by_.setZero();
    if (node > 0) held_by_.row(0) = rows_[node - 1].coupling.col(component).transpose();
    for (int k = 0; k < 3; ++k)
      if (k != component) held_by_(1, k) = own[component][k];
    if (node + 1 < rows_.size()) held_by_.row(2) = row.coupling.row(component);
    prescribe(node, component, increment);
  }

  /// Factors and solves.  @return ok | singular | non_finite
  Status solve() noexcept {
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

  /// xᵀKx of the last solve() [J]: the increment's length in the norm of the tangent, squared; negative where K is not
  /// positive along it.  No less than what the increment of hold() costs while all else stays: in two elements between
  /// clamped ends nothing else moves when their middle is pressed, and x is zero however far that goes.
  Scalar energy() const noexcept { return energy_; }

  /// Increment of one node [m, m, rad], after solve(); 0 where it was prescribed.
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
    Block block;               ///< Di
    Matrix3<Scalar> coupling;  ///< K(i, i+1)
    Vector x;                  ///< right-hand side, after solve() the increment
  };

  /// The node at which a chain stands: its block and right-hand side, less what the nodes before took away.
  struct Front {
    Block block;
    Vector x;
  };

  /// The block that couples a node to the next on its way, (i, j) -> entry.
  template <bool FromRight>
  auto coupling(int node) noexcept {
    Matrix3<Scalar>& c = rows_[FromRight ? node - 1 : node].coupling;
    return [&c](int i, int j) -> Scalar& { return FromRight ? c(j, i) : c(i, j); };
  }

  template <bool FromRight>
  void eliminate(int node, Front& front, Pivots& pivots) noexcept {
    using detail::less;
    Row& row = rows_[node];
    const Row& next = rows_[FromRight ? node - 1 : node + 1];
    const Factor factor(front.block);
    pivots.see(factor, row.block);
    row.block.a10 = factor.l10;
    row.block.a20 = factor.l20;
    row.block.a21 = factor.l21;
    const auto c = coupling<FromRight>(node);
    const Vector y0 = factor.forward(c(0, 0), c(1, 0), c(2, 0)),
                 y1 = factor.forward(c(0, 1), c(1, 1), c(2, 1)),
                 y2 = factor.forward(c(0, 2), c(1, 2), c(2, 2)),
                 y = factor.forward(front.x[0], front.x[1], front.x[2]);
    const Vector z0 = factor.scale(y0), z1 = factor.scale(y1), z2 = factor.scale(y2), z = factor.scale(y);
    for (int k = 0; k < 3; ++k) {
      c(k, 0) = z0[k];
      c(k, 1) = z1[k];
      c(k, 2) = z2[k];
      row.x[k] = z[k];
    }
    pivots.energy -= less(Scalar(0), y, z);
    const Block& d = next.block;
    front.block = {less(d.a00, y0, z0), less(d.a10, y1, z0), less(d.a20, y2, z0),
                   less(d.a11, y1, z1), less(d.a21, y2, z1), less(d.a22, y2, z2)};
    front.x = {less(next.x[0], y0, z), less(next.x[1], y1, z), less(next.x[2], y2, z)};
  }

  /// Solves for the node at which both chains end.  Both fronts hold its own block: once is enough.
  Vector join(Row& row, const Front& l, const Front& r, Pivots& pivots) const noexcept {
    const Block &a = l.block, &b = r.block, &d = row.block;
    const Factor factor({a.a00 + (b.a00 - d.a00), a.a10 + (b.a10 - d.a10), a.a20 + (b.a20 - d.a20),
                         a.a11 + (b.a11 - d.a11), a.a21 + (b.a21 - d.a21), a.a22 + (b.a22 - d.a22)});
    pivots.see(factor, d);
    const Vector rhs = l.x + (r.x - row.x), y = factor.forward(rhs[0], rhs[1], rhs[2]), z = factor.scale(y);
    pivots.energy -= detail::less(Scalar(0), y, z);
    const Scalar x1 = z[1] - factor.l21 * z[2];
    return row.x = {z[0] - factor.l20 * z[2] - factor.l10 * x1, x1, z[2]};
  }

  /// Increment of a node from that of the next on its way, whose components come in the order 2, 1, 0.
  template <bool FromRight>
  Vector substitute(int node, const Vector& next) noexcept {
    Row& row = rows_[node];
    const auto c = coupling<FromRight>(node);
    const auto rest = [&](int i) {
      return row.x[i] - c(i, 2) * next[2] - c(i, 1) * next[1] - c(i, 0) * next[0];
    };
    const Scalar x2 = rest(2), x1 = rest(1) - row.block.a21 * x2,
                 x0 = rest(0) - row.block.a20 * x2 - row.block.a10 * x1;
    return row.x = {x0, x1, x2};
  }

  detail::PerNode<Row, Elements, MaxElements> rows_;
  int negative_pivots_ = 0;
  Scalar energy_ = 0;
  int held_ = 0;  // node of hold()
  Scalar held_energy_ = 0;
  Scalar held_by_loads_ = 0;  // its row: what is known,
  Matrix3<Scalar> held_by_ =
      Matrix3<Scalar>::Zero();  // and the entries of the node before, of its own and of the node after
};

}  // namespace hapbeam
