// SPDX-License-Identifier: MIT
// Proper orthogonal decomposition of a matrix of snapshots (thesis eq. 3.43–3.66).
//
//   X = U Σ Vᵀ,    x ≈ Σ_{i ≤ l} c_i φ_i,    ε²(l) = Σ_{i > l} σ_i²
//
// Policy: the method, Svd or the thesis' eigenvalues of XXᵀ.
// Snapshots are free of units, and the basis is orthonormal in their plain product.  In that of a stiffness, an energy that
// stretching dominates, shapes within a percent take 16 modes instead of 10.
// This header alone has an SVD; a program that loads a trained model does not compile it.
// Offline: allocates and throws std::invalid_argument.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include <hapbeam/beam.hpp>
#include <hapbeam/rom/trained/lagrange.hpp>

namespace hapbeam {

/// Singular values and left singular vectors of X, descending.
template <class Matrix>
struct Decomposition {
  Matrix U;               // m × p, p = min(m, n)
  Eigen::VectorXd sigma;  // p
};

/// By Jacobi's rotations, until the rows of X are orthogonal: every σ to round-off of the largest.  Of a matrix with more rows than columns
/// Householder's reflections leave the rows of R.  Eigen's compiles for seven seconds, and is no faster where one side is small.
/// Source: Hestenes 1958; Golub and Van Loan, Matrix Computations, 5.2.2 and 8.6.3.
struct Svd {
  static constexpr const char* name() noexcept { return "svd"; }
  template <class Matrix>
  static Decomposition<Matrix> decompose(const Matrix& X) {
    const int m = static_cast<int>(X.rows()), n = static_cast<int>(X.cols()), p = (std::min)(m, n);
    Matrix A = X, W(n, p), V = Matrix::Identity(p, p), U = Matrix::Zero(m, p);
    std::vector<double> weights(static_cast<std::size_t>(p), 0);  // of reflections, v in A: 1 - weight v vᵀ
    for (int r = 0; r < p; ++r)
      for (int i = 0; i < n; ++i) W(i, r) = X(r, i);
    for (int k = 0; k < p && m > p; ++k) {
      double* const v = &A(k, k);
      const double norm = std::sqrt(detail::dot(v, v, m - k)), diagonal = v[0] > 0 ? -norm : norm;
      if (norm > 0) weights[static_cast<std::size_t>(k)] = 1 / (norm * (norm + std::abs(v[0])));
      v[0] -= diagonal;
      for (int j = k + 1; j < p; ++j) reflect(weights[static_cast<std::size_t>(k)], v, &A(k, j), m - k);
      for (int i = 0; i < p; ++i) W(i, k) = i < k ? 0 : i > k ? A(k, i) : diagonal;
    }
    rotate(W, V);
    Decomposition<Matrix> found{U, Eigen::VectorXd(p)};
    std::vector<std::pair<double, int>> order;
    for (int r = 0; r < p; ++r) order.emplace_back(-std::sqrt(detail::dot(&W(0, r), &W(0, r), n)), r);
    std::sort(order.begin(), order.end());
    for (int r = 0; r < p; ++r) {
      const auto [size, from] = order[static_cast<std::size_t>(r)];
      found.sigma[r] = -size;
      std::copy_n(&V(0, from), p, &found.U(0, r));
      for (int k = p; k-- > 0;)
        reflect(weights[static_cast<std::size_t>(k)], &A(k, k), &found.U(k, r), m - k);
    }
    return found;
  }

 private:
  static void reflect(double weight, const double* v, double* x, int n) noexcept {
    if (weight == 0) return;
    const double by = weight * detail::dot(v, x, n);
    for (int i = 0; i < n; ++i) x[i] -= by * v[i];
  }
  /// Makes the columns of W orthogonal.   @param V  out: what it is multiplied by
  template <class Matrix>
  static void rotate(Matrix& W, Matrix& V) noexcept {
    const int n = static_cast<int>(W.rows()), p = static_cast<int>(W.cols());
    const double eps = std::numeric_limits<double>::epsilon(),
                 enough = eps * std::sqrt(static_cast<double>(n));
    double largest = 0;
    for (int r = 0; r < p; ++r) largest = (std::max)(largest, detail::dot(&W(0, r), &W(0, r), n));
    bool turns = true;
    for (int sweep = 0; sweep < 64 && turns; ++sweep) {
      turns = false;
      for (int r = 0; r < p; ++r)
        for (int q = r + 1; q < p; ++q) {
          double *const x = &W(0, r), *const y = &W(0, q);
          const double a = detail::dot(x, x, n), b = detail::dot(y, y, n), c = detail::dot(x, y, n);
          if (!(std::abs(c) > enough * std::sqrt(a * b)) || (std::min)(a, b) <= eps * eps * largest) continue;
          turns = true;
          const double half = (b - a) / (2 * c),
                       t = std::copysign(1 / (std::abs(half) + std::hypot(1, half)), half),
                       cosine = 1 / std::hypot(1, t), sine = cosine * t;
          const auto turn = [cosine, sine](double* first, double* second, int size) {
            for (int i = 0; i < size; ++i) {
              const double was = first[i];
              first[i] = cosine * was - sine * second[i], second[i] = sine * was + cosine * second[i];
            }
          };
          turn(x, y, n), turn(&V(0, r), &V(0, q), p);
        }
    }
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
  Eigen::MatrixXd coefficients(const Eigen::MatrixXd& X) const {
    Eigen::MatrixXd C(basis_.cols(), X.cols());
    for (Eigen::Index k = 0; k < C.cols(); ++k)
      for (Eigen::Index i = 0; i < C.rows(); ++i)
        C(i, k) = detail::dot(&basis_(0, i), &X(0, k), static_cast<int>(X.rows()));
    return C;
  }

 private:
  Eigen::VectorXd sigma_;
  Eigen::MatrixXd basis_;
};

}  // namespace hapbeam
