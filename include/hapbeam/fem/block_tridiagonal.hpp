// The assembler for a chain of elements: a symmetric block-tridiagonal system of 3×3 blocks, solved by LDLᵀ.
//
// Element i couples node i with node i + 1 alone, so the tangent is
//
//        | D0  C0          |
//    K = | C0ᵀ D1  C1      |       Di' = Di - C(i-1)ᵀ D(i-1)'⁻¹ C(i-1)
//        |     C1ᵀ D2  ... |
//
// and one sweep factors and solves in O(n).  No pivoting: the pivots of LDLᵀ carry the inertia of K, so an
// indefinite tangent (a beam beyond its buckling load) is solved and counted, not refused.
// Real-time: noexcept, no allocation after construction, about 180 multiply-adds and 3 divisions a node.
// Source: Golub and Van Loan, Matrix Computations, 4.5.1.
#pragma once

#include <cmath>
#include <limits>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/per_node.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <typename Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

namespace detail {

/// A = L D Lᵀ of a symmetric 3×3 matrix (its lower triangle), L unit lower.
template <typename S>
struct Ldlt3 {
  S l10, l20, l21;
  S p0, p1, p2;  ///< pivots
  S i0, i1, i2;  ///< their inverses

  explicit Ldlt3(const Matrix3<S>& a) noexcept {
    p0 = a(0, 0);
    i0 = 1 / p0;
    l10 = a(1, 0) * i0;
    l20 = a(2, 0) * i0;
    p1 = a(1, 1) - l10 * a(1, 0);
    i1 = 1 / p1;
    const S c21 = a(2, 1) - l20 * a(1, 0);
    l21 = c21 * i1;
    p2 = a(2, 2) - l20 * a(2, 0) - l21 * c21;
    i2 = 1 / p2;
  }

  Vector3<S> solve(const Vector3<S>& b) const noexcept {
    const S y1 = b[1] - l10 * b[0], y2 = b[2] - l20 * b[0] - l21 * y1;
    const S x2 = y2 * i2, x1 = y1 * i1 - l21 * x2, x0 = b[0] * i0 - l10 * x1 - l20 * x2;
    return {x0, x1, x2};
  }
};

}  // namespace detail

template <typename Scalar, int Elements = Eigen::Dynamic, int MaxElements = Elements>
class BlockTridiagonal {
 public:
  explicit BlockTridiagonal(int elements) : rows_(elements) {}

  /// Adds element e: its tangent, and its residual to the right-hand side with the sign turned.
  /// Elements come in order, 0 to n - 1; element 0 starts a new system.
  void add(int e, const Matrix6<Scalar>& K, const Vector6<Scalar>& r) noexcept {
    Row& a = rows_[e];
    Row& b = rows_[e + 1];
    if (e == 0) {
      a.diagonal = K.template topLeftCorner<3, 3>();
      a.x = -r.template head<3>();
    } else {
      a.diagonal += K.template topLeftCorner<3, 3>();
      a.x -= r.template head<3>();
    }
    a.coupling = K.template topRightCorner<3, 3>();
    b.diagonal = K.template bottomRightCorner<3, 3>();
    b.x = -r.template tail<3>();
  }

  /// Adds a force [N, N, N·m] to the right-hand side of one node.
  void add_force(int node, const Vector3<Scalar>& force) noexcept { rows_[node].x += force; }

  /// Prescribes the increment of one degree of freedom (0: u, 1: w, 2: θ) of a node, after all elements are in: its
  /// column goes to the right-hand side, its row answers 0.
  void prescribe(int node, int component, Scalar increment) noexcept {
    Row& row = rows_[node];
    row.x -= increment * row.diagonal.col(component);
    row.x[component] = 0;
    row.diagonal.row(component).setZero();
    row.diagonal.col(component).setZero();
    row.diagonal(component, component) = 1;  // not the old entry, whose sign would count as a pivot's
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

  /// Factors and solves.  @return ok | singular | non_finite
  Status solve() noexcept {
    using std::abs;
    constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    const int last = rows_.size() - 1;
    // |pivot| - eps |its diagonal entry before elimination|; the first that is not positive is kept, NaN too.
    Scalar lowest = std::numeric_limits<Scalar>::max();
    Vector3<Scalar> assembled = rows_[0].diagonal.diagonal();
    negative_pivots_ = 0;
    energy_ = 0;
    for (int i = 0;; ++i) {
      Row& row = rows_[i];
      const detail::Ldlt3<Scalar> factor(row.diagonal);
      const Scalar pivots[] = {factor.p0, factor.p1, factor.p2};
      for (int k = 0; k < 3; ++k) {
        negative_pivots_ += pivots[k] < 0;
        const Scalar left = abs(pivots[k]) - epsilon * abs(assembled[k]);
        if (lowest > 0 && !(left >= lowest)) lowest = left;
      }
      const Vector3<Scalar> rhs = row.x;
      row.x = factor.solve(rhs);
      energy_ += rhs.dot(row.x);
      if (i == last) break;
      // coupling becomes D'⁻¹ C; the next row loses Cᵀ D'⁻¹ C and Cᵀ D'⁻¹ x.
      Row& next = rows_[i + 1];
      assembled = next.diagonal.diagonal();
      const Matrix3<Scalar> c = row.coupling;
      for (int k = 0; k < 3; ++k) row.coupling.col(k) = factor.solve(c.col(k));
      next.diagonal.noalias() -= c.transpose().lazyProduct(row.coupling);
      next.x.noalias() -= c.transpose().lazyProduct(row.x);
    }
    for (int i = last - 1; i >= 0; --i) rows_[i].x.noalias() -= rows_[i].coupling.lazyProduct(rows_[i + 1].x);
    if (lowest <= 0) return Status::singular;
    return std::isfinite(lowest) && std::isfinite(energy_) ? Status::ok : Status::non_finite;
  }

  /// xᵀKx of the last solve() [J]: the increment's length in the norm of the tangent, squared; negative where K is not
  /// positive along it.
  Scalar energy() const noexcept { return energy_; }

  /// Increment of one node [m, m, rad], after solve(); 0 where it was prescribed.
  const Vector3<Scalar>& increment(int node) const noexcept { return rows_[node].x; }

  /// Number of negative pivots of the last solve(): the number of negative eigenvalues of the tangent.
  int negative_pivots() const noexcept { return negative_pivots_; }

 private:
  struct Row {
    Matrix3<Scalar> diagonal, coupling;  ///< Di; K(i, i+1), after solve() D'⁻¹ K(i, i+1)
    Vector3<Scalar> x;                   ///< right-hand side, after solve() the increment
  };

  detail::PerNode<Row, Elements, MaxElements> rows_;
  int negative_pivots_ = 0;
  Scalar energy_ = 0;
};

}  // namespace hapbeam
