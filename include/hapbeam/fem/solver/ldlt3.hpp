// The small pieces of a block elimination: LDLᵀ of one symmetric 3×3 block, and what its pivots tell.
//
// Real-time: noexcept, no allocation, O(1).  Source: Golub and Van Loan, Matrix Computations, 4.1.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace hapbeam {

template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
template <typename Scalar>
using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;

namespace detail {

/// A symmetric 3×3 matrix, its lower triangle.
template <typename S>
struct Symmetric3 {
  S a00, a10, a20, a11, a21, a22;
};

/// A = L P Lᵀ of a symmetric 3×3 matrix, L unit lower.
template <typename S>
struct Ldlt3 {
  S l10, l20, l21;
  S p0, p1, p2;  ///< pivots
  S i0, i1, i2;  ///< their inverses

  explicit Ldlt3(const Symmetric3<S>& a) noexcept {
    p0 = a.a00;
    i0 = 1 / p0;
    l10 = a.a10 * i0;
    l20 = a.a20 * i0;
    p1 = a.a11 - l10 * a.a10;
    i1 = 1 / p1;
    const S c21 = a.a21 - l20 * a.a10;
    l21 = c21 * i1;
    p2 = a.a22 - l20 * a.a20 - l21 * c21;
    i2 = 1 / p2;
  }

  /// L⁻¹ b
  Vector3<S> forward(S b0, S b1, S b2) const noexcept {
    const S y1 = b1 - l10 * b0;
    return {b0, y1, b2 - l20 * b0 - l21 * y1};
  }
  /// P⁻¹ y
  Vector3<S> scale(const Vector3<S>& y) const noexcept { return {y[0] * i0, y[1] * i1, y[2] * i2}; }
};

/// v - aᵀb.  The last component is known last: it is subtracted last.
template <typename S>
S less(S v, const Vector3<S>& a, const Vector3<S>& b) noexcept {
  return v - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
}

/// What a chain of eliminations has seen.
template <typename S>
struct Pivots {
  /// Least |pivot| - eps |its diagonal entry before elimination|; the first that is not positive is kept, NaN too.
  S lowest = std::numeric_limits<S>::max();
  S energy = 0;  ///< Σ yᵀP⁻¹y of the right-hand side [J]
  int negative = 0;

  void see(const Ldlt3<S>& factor, const Symmetric3<S>& assembled) noexcept {
    see(factor.p0, assembled.a00);
    see(factor.p1, assembled.a11);
    see(factor.p2, assembled.a22);
  }

 private:
  void see(S pivot, S assembled) noexcept {
    using std::abs;
    const S left = abs(pivot) - std::numeric_limits<S>::epsilon() * abs(assembled);
    if (lowest > 0 && !(left >= lowest)) lowest = left;
    negative += pivot < 0;
  }
};

}  // namespace detail

}  // namespace hapbeam
