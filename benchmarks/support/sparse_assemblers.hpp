// What hapbeam's assembler is measured against: the same FemModel, the same Newton, mesh, elements and convergence
// rule, over Eigen's general sparse solvers (assembled_by.hpp).
//
// Both have the members of BlockTridiagonal that BeamSystem calls for one contact, so that the linear algebra is the only difference.
// Written as well as one can from outside: SimplicialLdlt analyses its pattern once, refills the values in place
// without searching, and allocates nothing of its own in a solve.  SparseLuFromTriplets is what one writes first.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include <hapbeam/element/element.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::benchmarks {

/// @tparam Ordering  Eigen::NaturalOrdering<int>: a chain fills in nothing, and with the upper triangle Eigen need not
///                   copy the matrix first; Eigen::AMDOrdering<int>: Eigen's default
template <typename Scalar, class Ordering>
class SimplicialLdlt {
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

 public:
  struct HeldRow {};

  explicit SimplicialLdlt(int elements)
      : K_(3 * (elements + 1), 3 * (elements + 1)), rhs_(K_.rows()), x_(K_.rows()) {
    // The upper triangle, column by column: the coupling to the node before, then this node's own triangle.
    std::vector<Eigen::Triplet<Scalar>> entries;
    for (int column = 0; column < K_.cols(); ++column)
      for (int row = std::max(0, column / 3 * 3 - 3); row <= column; ++row)
        entries.emplace_back(row, column, 1);
    K_.setFromTriplets(entries.begin(), entries.end());
    solver_.analyzePattern(K_);
    held_by_.reserve(8);
  }

  void add(int e, const Matrix6<Scalar>& K, const Vector6<Scalar>& r) noexcept {
    if (e == 0) {
      clear_own(0);
      rhs_.template head<3>().setZero();
    }
    clear_own(e + 1);
    for (int j = 0; j < 3; ++j) {
      Scalar* a = own(e, j);
      Scalar* b = own(e + 1, j);
      for (int i = 0; i <= j; ++i) a[i] += K(i, j);
      for (int i = 0; i < 3; ++i) b[i - 3] = K(i, j + 3);
      for (int i = 0; i <= j; ++i) b[i] += K(i + 3, j + 3);
    }
    rhs_.template segment<3>(3 * e) -= r.template head<3>();
    rhs_.template segment<3>(3 * e + 3) = -r.template tail<3>();
  }

  void prescribe(int node, int component, Scalar increment) noexcept {
    visit_row(node, component, [&](Scalar& entry, int row) {
      rhs_[row] -= increment * entry;
      entry = 0;
    });
    rhs_[3 * node + component] = 0;
  }

  void hold(int node, int component, Scalar increment) noexcept {
    held_by_loads_ = own(node, component)[component] * increment - rhs_[3 * node + component];
    held_by_.clear();
    visit_row(node, component, [&](Scalar& entry, int column) { held_by_.push_back({column, entry}); });
    prescribe(node, component, increment);
  }

  Status solve() {
    solver_.factorize(K_);
    if (solver_.info() != Eigen::Success) return Status::singular;
    x_ = solver_.solve(rhs_);
    return x_.allFinite() ? Status::ok : Status::non_finite;
  }

  Scalar energy() const noexcept { return rhs_.dot(x_); }
  Scalar reaction() const noexcept {
    Scalar sum = held_by_loads_;
    for (const auto& [column, entry] : held_by_) sum += entry * x_[column];
    return sum;
  }
  int negative_pivots() const { return static_cast<int>((solver_.vectorD().array() < 0).count()); }
  Vector3<Scalar> increment(int node) const noexcept { return x_.template segment<3>(3 * node); }

 private:
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
  void clear_own(int node) noexcept {
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i <= j; ++i) own(node, j)[i] = 0;
  }

  Matrix K_;
  Vector rhs_, x_;
  std::vector<std::pair<int, Scalar>> held_by_;
  Scalar held_by_loads_ = 0;
  Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Ordering> solver_;
};

template <typename Scalar>
using SimplicialLdltNatural = SimplicialLdlt<Scalar, Eigen::NaturalOrdering<int>>;
template <typename Scalar>
using SimplicialLdltAmd = SimplicialLdlt<Scalar, Eigen::AMDOrdering<int>>;

/// A list of triplets, a matrix of it, a new factorisation: everything anew in each iteration.
template <typename Scalar>
class SparseLuFromTriplets {
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

 public:
  struct HeldRow {};

  explicit SparseLuFromTriplets(int elements)
      : K_(3 * (elements + 1), 3 * (elements + 1)),
        rhs_(K_.rows()),
        x_(K_.rows()),
        fixed_(K_.rows()),
        given_(K_.rows()) {}

  void add(int e, const Matrix6<Scalar>& K, const Vector6<Scalar>& r) {
    if (e == 0) {
      triplets_.clear();
      rhs_.setZero();
      fixed_.setZero();
    }
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) triplets_.emplace_back(3 * e + i, 3 * e + j, K(i, j));
    rhs_.template segment<6>(3 * e) -= r;
  }

  void prescribe(int node, int component, Scalar increment) {
    fixed_[3 * node + component] = 1;
    given_[3 * node + component] = increment;
  }

  void hold(int node, int component, Scalar increment) {
    prescribe(node, component, increment);
    held_ = 3 * node + component;
  }

  Status solve() {
    held_by_.clear();
    held_by_loads_ = -rhs_[held_];
    for (const auto& entry : triplets_) {
      if (entry.row() != held_) continue;
      if (fixed_[entry.col()] != 0) held_by_loads_ += entry.value() * given_[entry.col()];
      else held_by_.push_back(entry);
    }
    for (auto& entry : triplets_) {
      const bool row = fixed_[entry.row()] != 0, column = fixed_[entry.col()] != 0;
      if (column) rhs_[entry.row()] -= given_[entry.col()] * entry.value();
      if ((row || column) && entry.row() != entry.col()) entry = {entry.row(), entry.col(), 0};
    }
    rhs_ = (fixed_.array() != 0).select(0, rhs_);
    K_.setFromTriplets(triplets_.begin(), triplets_.end());
    Eigen::SparseLU<Matrix> solver(K_);
    if (solver.info() != Eigen::Success) return Status::singular;
    x_ = solver.solve(rhs_);
    return x_.allFinite() ? Status::ok : Status::non_finite;
  }

  Scalar energy() const noexcept { return rhs_.dot(x_); }
  Scalar reaction() const noexcept {
    Scalar sum = held_by_loads_;
    for (const auto& entry : held_by_) sum += entry.value() * x_[entry.col()];
    return sum;
  }
  int negative_pivots() const noexcept { return 0; }  // LU does not tell; the benchmark's beams are stable
  Vector3<Scalar> increment(int node) const noexcept { return x_.template segment<3>(3 * node); }

 private:
  std::vector<Eigen::Triplet<Scalar>> triplets_, held_by_;
  int held_ = 0;
  Scalar held_by_loads_ = 0;
  Matrix K_;
  Vector rhs_, x_, fixed_, given_;
};

}  // namespace hapbeam::benchmarks
