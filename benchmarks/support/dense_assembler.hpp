// The whole tangent as one dense matrix, factored by Eigen, in the place of hapbeam's assembler (assembled_by.hpp): O(n³).
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "whole_columns.hpp"
#include <hapbeam/element/element.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::benchmarks {

template <typename Scalar>
class DenseLdlt : public WholeColumns<DenseLdlt<Scalar>, Scalar> {
  using Columns = WholeColumns<DenseLdlt<Scalar>, Scalar>;
  friend Columns;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

 public:
  using Columns::add;

  explicit DenseLdlt(int elements) : K_(3 * (elements + 1), 3 * (elements + 1)), x_(K_.rows()) {}

  void start() noexcept { K_.setZero(), x_.setZero(); }
  void add(int e, const Matrix6<Scalar>& K, const Vector6<Scalar>& r) noexcept {
    K_.template block<6, 6>(3 * e, 3 * e) += K;
    x_.template segment<6>(3 * e) -= r;
  }
  void add_at(int node, const Matrix3& K, const Vector3<Scalar>& r) noexcept {
    K_.template block<3, 3>(3 * node, 3 * node) += K;
    x_.template segment<3>(3 * node) -= r;
  }

  void prescribe(int node, int component, Scalar increment) noexcept {
    const int k = 3 * node + component;
    const Scalar pivot = K_(k, k);
    x_ -= increment * K_.col(k);
    x_[k] = 0;
    K_.row(k).setZero();
    K_.col(k).setZero();
    K_(k, k) = pivot;
  }

  Status factor() {
    if (!K_.allFinite() || !x_.allFinite()) return Status::non_finite;
    const Vector assembled = K_.diagonal(), rhs = x_;
    factor_.compute(K_);
    x_ = solved(rhs);
    energy_ = rhs.dot(x_);
    negative_pivots_ = static_cast<int>((factor_.vectorD().array() < 0).count());
    // Its order of elimination is not the beam's, so a pivot that should be zero holds the round-off of all rows.
    const Scalar epsilon = std::numeric_limits<Scalar>::epsilon() * static_cast<Scalar>(K_.rows());
    const Vector unpermuted = factor_.transpositionsP().transpose() * factor_.vectorD();
    return (unpermuted.array().abs() > epsilon * assembled.array().abs()).all() ? Status::ok
                                                                                : Status::singular;
  }

  Scalar energy() const noexcept { return energy_; }
  int negative_pivots() const noexcept { return negative_pivots_; }
  Vector3<Scalar> increment(int node) const noexcept { return x_.template segment<3>(3 * node); }

 private:
  Vector solved(const Vector& b) const { return factor_.solve(b); }

  Matrix K_;
  Vector x_;
  Eigen::LDLT<Matrix> factor_;
  Scalar energy_ = 0;
  int negative_pivots_ = 0;
};

}  // namespace hapbeam::benchmarks
