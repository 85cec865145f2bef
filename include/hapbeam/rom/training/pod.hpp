// SPDX-License-Identifier: MIT
// Proper orthogonal decomposition of a matrix of snapshots (thesis eq. 3.43–3.66).
//
//   X = U Σ Vᵀ,    x ≈ Σ_{i ≤ l} c_i φ_i,    ε²(l) = Σ_{i > l} σ_i²
//
// Policy: the method, Svd or the thesis' eigenvalues of XXᵀ.
// Snapshots are free of units, and the basis is orthonormal in their plain product.  In that of a stiffness, an energy that
// stretching dominates, shapes within a percent take 16 modes instead of 10.
// This header alone includes an SVD; a program that loads a trained model does not compile it.
// Offline: allocates and throws std::invalid_argument.
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <hapbeam/beam.hpp>

namespace hapbeam {

/// Singular values and left singular vectors of X, descending.
template <class Matrix>
struct Decomposition {
  Matrix U;               // m × p, p = min(m, n)
  Eigen::VectorXd sigma;  // p
};

/// By singular value decomposition: every σ to round-off of the largest.
/// Jacobi's: it compiles in a third of the time of the divided one, and is fast enough where one side is small.
struct Svd {
  static constexpr const char* name() noexcept { return "svd"; }
  template <class Matrix>
  static Decomposition<Matrix> decompose(const Matrix& X) {
    const Eigen::JacobiSVD<Matrix> svd(X, Eigen::ComputeThinU);
    return {svd.matrixU(), svd.singularValues()};
  }
};

/// By eigenvalues of XXᵀ, σ = √λ (thesis eq. 3.50–3.52). Values below √eps σ₁ = 1e-8 σ₁ are noise: their squares are
/// below the round-off of the largest, and their vectors are arbitrary.
struct MethodOfSnapshots {
  static constexpr const char* name() noexcept { return "method_of_snapshots"; }
  template <class Matrix>
  static Decomposition<Matrix> decompose(const Matrix& X) {
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(X * X.transpose());
    const Eigen::Index p = (std::min)(X.rows(), X.cols());
    return {solver.eigenvectors().rowwise().reverse().leftCols(p),
            solver.eigenvalues().reverse().head(p).cwiseMax(0).cwiseSqrt()};
  }
};

/// How many modes to keep.
class Truncation {
 public:
  /// @param modes 1 or more; all of them where there are fewer
  static Truncation count(int modes) {
    if (modes < 1) detail::refuse("modes = %d: must be 1 or more", modes);
    return {modes, 0};
  }
  /// The fewest that hold this part of Σσ².   @param part  in (0, 1]
  static Truncation energy(double part) {
    if (!(part > 0 && part <= 1)) detail::reject("energy", part, "", "above 0 and at most 1");
    return {0, 1 - part};
  }
  /// The fewest with ε(l)² <= tolerance² Σσ².   @param tolerance  in [0, 1)
  static Truncation error(double tolerance) {
    if (!(tolerance >= 0 && tolerance < 1)) detail::reject("error", tolerance, "", "0 or more and below 1");
    return {0, tolerance * tolerance};
  }

  int modes(const Eigen::VectorXd& sigma) const {
    const int all = static_cast<int>(sigma.size());
    if (count_ > 0) return (std::min)(count_, all);
    const double allowed = left_out_ * sigma.squaredNorm();
    double left_out = 0;
    int modes = all;
    while (modes > 1 && left_out + sigma[modes - 1] * sigma[modes - 1] <= allowed) {
      --modes;
      left_out += sigma[modes] * sigma[modes];
    }
    return modes;
  }

 private:
  Truncation(int count, double left_out) : count_(count), left_out_(left_out) {}
  int count_;
  double left_out_;
};

/// @tparam Reducer  Svd | MethodOfSnapshots
template <class Reducer = Svd>
class Pod {
 public:
  /// @param X  m × n, a snapshot a column, finite   @throws std::invalid_argument
  Pod(const Eigen::MatrixXd& X, const Truncation& truncation) {
    if (X.size() == 0 || !X.allFinite()) detail::refuse("snapshots: must be finite, one or more of them");
    const auto found = Reducer::decompose(X);
    sigma_ = found.sigma;
    basis_ = found.U.leftCols(truncation.modes(sigma_));
  }

  /// m × modes; a mode a column, orthonormal.
  const Eigen::MatrixXd& basis() const noexcept { return basis_; }
  int modes() const noexcept { return static_cast<int>(basis_.cols()); }
  /// All of them, descending.
  const Eigen::VectorXd& singular_values() const noexcept { return sigma_; }

  /// Coefficients of the best approximation of each column of X, modes × n (thesis eq. 3.44).
  Eigen::MatrixXd coefficients(const Eigen::MatrixXd& X) const { return basis_.transpose() * X; }

 private:
  Eigen::VectorXd sigma_;
  Eigen::MatrixXd basis_;
};

}  // namespace hapbeam
