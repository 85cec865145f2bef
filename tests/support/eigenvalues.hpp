// Eigenvalues and inverse of a small symmetric matrix by cyclic Jacobi rotations: slow, accurate to a few eps
// of the largest eigenvalue, and nothing that the library computes with.  Source: Golub and Van Loan, Matrix
// Computations, 8.5.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace hapbeam::testing {

/// A = V diag(values) Vᵀ
struct Spectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;

  explicit Spectrum(Eigen::MatrixXd A) : vectors(Eigen::MatrixXd::Identity(A.rows(), A.cols())) {
    const Eigen::Index n = A.rows();
    const double negligible = 1e-32 * A.squaredNorm();
    for (double off = 1; off > negligible;) {
      off = 0;
      for (Eigen::Index p = 0; p < n; ++p)
        for (Eigen::Index q = p + 1; q < n; ++q) {
          const double a = A(p, q);
          off += a * a;
          if (a == 0) continue;
          const double tau = (A(q, q) - A(p, p)) / (2 * a);
          const double t = (tau < 0 ? -1 : 1) / (std::abs(tau) + std::sqrt(1 + tau * tau));
          const double c = 1 / std::sqrt(1 + t * t), s = t * c;
          for (Eigen::Index k = 0; k < n; ++k) {
            const double x = A(k, p), y = A(k, q), v = vectors(k, p), w = vectors(k, q);
            A(k, p) = c * x - s * y;
            A(k, q) = s * x + c * y;
            vectors(k, p) = c * v - s * w;
            vectors(k, q) = s * v + c * w;
          }
          for (Eigen::Index k = 0; k < n; ++k) {
            const double x = A(p, k), y = A(q, k);
            A(p, k) = c * x - s * y;
            A(q, k) = s * x + c * y;
          }
        }
    }
    values = A.diagonal();
  }

  double smallest() const { return values.cwiseAbs().minCoeff(); }
  double condition() const { return values.cwiseAbs().maxCoeff() / smallest(); }
  int negative() const { return static_cast<int>((values.array() < 0).count()); }

  /// A⁻¹ b
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    const Eigen::VectorXd y = vectors.transpose() * b;
    return vectors * y.cwiseQuotient(values);
  }
};

}  // namespace hapbeam::testing
