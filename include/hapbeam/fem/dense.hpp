// The reference assembler: the whole tangent as one dense matrix, factored by Eigen.
//
// It computes what BlockTridiagonal computes, in O(n³), without knowing that a beam is a chain.  Use it to check
// an assembler or an element, never in a servo loop: it allocates.  Exceptions: only at construction.
#pragma once

#include <Eigen/LU>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/block_tridiagonal.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

template <typename Scalar, int Elements = Eigen::Dynamic, int MaxElements = Elements>
class Dense {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

 public:
  explicit Dense(int elements) : K_(3 * (elements + 1), 3 * (elements + 1)), x_(3 * (elements + 1)) {}

  void add(int e, const Matrix6<Scalar>& K, const Vector6<Scalar>& r) noexcept {
    if (e == 0) {
      K_.setZero();
      x_.setZero();
    }
    K_.template block<6, 6>(3 * e, 3 * e) += K;
    x_.template segment<6>(3 * e) -= r;
  }

  void add_force(int node, const Vector3<Scalar>& force) noexcept { x_.template segment<3>(3 * node) += force; }

  void prescribe(int node, int component, Scalar increment) noexcept {
    const int k = 3 * node + component;
    const Scalar pivot = K_(k, k);
    x_ -= increment * K_.col(k);
    K_.row(k).setZero();
    K_.col(k).setZero();
    K_(k, k) = pivot;
    x_[k] = increment * pivot;
  }

  Status solve() {
    const Eigen::PartialPivLU<Matrix> factor(K_);
    const Scalar smallest = factor.matrixLU().diagonal().cwiseAbs().minCoeff();
    const Scalar largest = factor.matrixLU().diagonal().cwiseAbs().maxCoeff();
    if (!(largest <= std::numeric_limits<Scalar>::max())) return Status::non_finite;
    x_ = factor.solve(x_).eval();
    return smallest > 4 * std::numeric_limits<Scalar>::epsilon() * largest ? Status::ok : Status::singular;
  }

  Vector3<Scalar> increment(int node) const noexcept { return x_.template segment<3>(3 * node); }

 private:
  Matrix K_;
  Vector x_;
};

}  // namespace hapbeam
