// What hapbeam's assembler is measured against: the same FemModel, the same Newton, mesh, elements and convergence
// rule, over Eigen's general sparse solvers (assembled_by.hpp).
//
// Both have the members of BlockTridiagonal that ChainSystem calls of a beam, so that the linear algebra is the only difference.
// Written as well as one can from outside: SimplicialLdlt analyses its pattern once, refills the values in place
// without searching, and allocates nothing of its own in a solve.  SparseLuFromTriplets is what one writes first.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include "whole_columns.hpp"
#include <hapbeam/element/element.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::benchmarks {

/// @tparam Ordering  Eigen::NaturalOrdering<int>: a chain fills in nothing, and with the upper triangle Eigen need not
///                   copy the matrix first; Eigen::AMDOrdering<int>: Eigen's default
template <typename Scalar, class Ordering>
class SimplicialLdlt : public WholeColumns<SimplicialLdlt<Scalar, Ordering>, Scalar> {
  using Columns = WholeColumns<SimplicialLdlt<Scalar, Ordering>, Scalar>;
  friend Columns;
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Block = Eigen::Matrix<Scalar, 3, 3>;

 public:
  using Columns::add;

  explicit SimplicialLdlt(int elements)
      : K_(3 * (elements + 1), 3 * (elements + 1)), rhs_(K_.rows()), x_(K_.rows()) {
    // The upper triangle, column by column: the coupling to the node before, then this node's own triangle.
    std::vector<Eigen::Triplet<Scalar>> entries;
    for (int column = 0; column < K_.cols(); ++column)
      for (int row = std::max(0, column / 3 * 3 - 3); row <= column; ++row)
        entries.emplace_back(row, column, 1);
    K_.setFromTriplets(entries.begin(), entries.end());
    solver_.analyzePattern(K_);
  }

  void start() noexcept { K_.coeffs().setZero(), rhs_.setZero(); }
  void add(int e, const Matrix6<Scalar>& K, const Vector6<Scalar>& r) noexcept {
    for (int j = 0; j < 3; ++j) {
      Scalar* a = own(e, j);
      Scalar* b = own(e + 1, j);
      for (int i = 0; i <= j; ++i) a[i] += K(i, j);
      for (int i = 0; i < 3; ++i) b[i - 3] = K(i, j + 3);
      for (int i = 0; i <= j; ++i) b[i] += K(i + 3, j + 3);
    }
    rhs_.template segment<6>(3 * e) -= r;
  }
  void add_at(int node, const Block& K, const Vector3<Scalar>& r) noexcept {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i <= j; ++i) own(node, j)[i] += K(i, j);
    rhs_.template segment<3>(3 * node) -= r;
  }

  void prescribe(int node, int component, Scalar increment) noexcept {
    visit_row(node, component, [&](Scalar& entry, int row) {
      rhs_[row] -= increment * entry;
      entry = 0;
    });
    rhs_[3 * node + component] = 0;
  }

  Status factor() {
    solver_.factorize(K_);
    if (solver_.info() != Eigen::Success) return Status::singular;
    x_ = solved(rhs_);
    energy_ = rhs_.dot(x_);
    return x_.allFinite() ? Status::ok : Status::non_finite;
  }

  Scalar energy() const noexcept { return energy_; }
  int negative_pivots() const { return static_cast<int>((solver_.vectorD().array() < 0).count()); }
  Vector3<Scalar> increment(int node) const noexcept { return x_.template segment<3>(3 * node); }

 private:
  Vector solved(const Vector& b) const { return solver_.solve(b); }
  /// Entry (0, j) of a node's diagonal block; the entries above it are the coupling's.
  Scalar* own(int node, int j) noexcept {
    return K_.valuePtr() + K_.outerIndexPtr()[3 * node + j] + (node > 0 ? 3 : 0);
  }
  /// Calls visit(entry, column) for each entry of a row but the diagonal one.
  template <class Visitor>
  void visit_row(int node, int component, Visitor&& visit) noexcept {
    Scalar* column = own(node, component);
    if (node > 0)
      for (int i = 0; i < 3; ++i) visit(column[i - 3], 3 * node - 3 + i);
    for (int i = 0; i < component; ++i) visit(column[i], 3 * node + i);
    for (int j = component + 1; j < 3; ++j) visit(own(node, j)[component], 3 * node + j);
    if (3 * node + 3 < K_.cols())
      for (int j = 0; j < 3; ++j) visit(own(node + 1, j)[component - 3], 3 * node + 3 + j);
  }

  Matrix K_;
  Vector rhs_, x_;
  Scalar energy_ = 0;
  Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Ordering> solver_;
};

template <typename Scalar>
using SimplicialLdltNatural = SimplicialLdlt<Scalar, Eigen::NaturalOrdering<int>>;
template <typename Scalar>
using SimplicialLdltAmd = SimplicialLdlt<Scalar, Eigen::AMDOrdering<int>>;

/// A list of triplets, a matrix of it, a new factorisation: everything anew in each iteration.
template <typename Scalar>
class SparseLuFromTriplets : public WholeColumns<SparseLuFromTriplets<Scalar>, Scalar> {
  using Columns = WholeColumns<SparseLuFromTriplets<Scalar>, Scalar>;
  friend Columns;
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Block = Eigen::Matrix<Scalar, 3, 3>;

 public:
  using Columns::add;

  explicit SparseLuFromTriplets(int elements)
      : K_(3 * (elements + 1), 3 * (elements + 1)),
        rhs_(K_.rows()),
        x_(K_.rows()),
        fixed_(K_.rows()),
        given_(K_.rows()) {}

  void start() { triplets_.clear(), rhs_.setZero(), fixed_.setZero(); }
  void add(int e, const Matrix6<Scalar>& K, const Vector6<Scalar>& r) {
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) triplets_.emplace_back(3 * e + i, 3 * e + j, K(i, j));
    rhs_.template segment<6>(3 * e) -= r;
  }
  void add_at(int node, const Block& K, const Vector3<Scalar>& r) {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) triplets_.emplace_back(3 * node + i, 3 * node + j, K(i, j));
    rhs_.template segment<3>(3 * node) -= r;
  }

  void prescribe(int node, int component, Scalar increment) {
    fixed_[3 * node + component] = 1;
    given_[3 * node + component] = increment;
  }

  Status factor() {
    for (auto& entry : triplets_) {
      const bool row = fixed_[entry.row()] != 0, column = fixed_[entry.col()] != 0;
      if (column) rhs_[entry.row()] -= given_[entry.col()] * entry.value();
      if ((row || column) && entry.row() != entry.col()) entry = {entry.row(), entry.col(), 0};
    }
    rhs_ = (fixed_.array() != 0).select(0, rhs_);
    K_.setFromTriplets(triplets_.begin(), triplets_.end());
    solver_.emplace(K_);
    if (solver_->info() != Eigen::Success) return Status::singular;
    x_ = solved(rhs_);
    energy_ = rhs_.dot(x_);
    return x_.allFinite() ? Status::ok : Status::non_finite;
  }

  Scalar energy() const noexcept { return energy_; }
  int negative_pivots() const noexcept { return 0; }  // LU does not tell; the benchmark's beams are stable
  Vector3<Scalar> increment(int node) const noexcept { return x_.template segment<3>(3 * node); }

 private:
  Vector solved(const Vector& b) const { return solver_->solve(b); }

  std::vector<Eigen::Triplet<Scalar>> triplets_;
  std::optional<Eigen::SparseLU<Matrix>> solver_;
  Scalar energy_ = 0;
  Matrix K_;
  Vector rhs_, x_, fixed_, given_;
};

}  // namespace hapbeam::benchmarks
