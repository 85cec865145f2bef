// SPDX-License-Identifier: MIT
// Residual and tangent of an element of a rod.  Its energy depends on the places of both nodes by Δ = r2 - r1 alone, so each
// derivative by Δ stands here once, and what is symmetric by its lower triangle.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <Eigen/Core>

#include <hapbeam/element/rod/rod_properties.hpp>

namespace hapbeam {

/// @tparam M  unknowns of a node beside its place: r', and φ if there is one
template <typename S, int M>
struct RodTangent {
  static constexpr int unknowns = 3 + M;

  S D[3], t1[M], t2[M];
  S DD[6], K11[M * (M + 1) / 2], K22[M * (M + 1) / 2];
  S D1[3 * M], D2[3 * M], K12[M * M];  // column by column

  /// ∂V/∂ of unknown i of both nodes.
  [[gnu::always_inline]] S operator[](int i) const noexcept {
    const int k = i % unknowns;
    if (k < 3) return i < unknowns ? -D[k] : D[k];
    return i < unknowns ? t1[k - 3] : t2[k - 3];
  }
  /// The entry of the tangent.
  [[gnu::always_inline]] S operator()(int i, int j) const noexcept {
    const bool upper = i % unknowns < 3 || j % unknowns >= 3;
    const int a = upper ? i : j, b = upper ? j : i, p = a % unknowns, q = b % unknowns;
    const bool first_a = a < unknowns, first_b = b < unknowns;
    if (q < 3) return first_a == first_b ? DD[half<3>(p, q)] : -DD[half<3>(p, q)];
    if (p < 3) {
      const S& by = first_b ? D1[3 * (q - 3) + p] : D2[3 * (q - 3) + p];
      return first_a ? -by : by;
    }
    if (first_a != first_b) return first_a ? K12[M * (q - 3) + p - 3] : K12[M * (p - 3) + q - 3];
    return first_a ? K11[half<M>(p - 3, q - 3)] : K22[half<M>(p - 3, q - 3)];
  }

  /// @param r  out   @param K  out, both triangles
  template <class Residual, class Tangent>
  void expand(Residual& r, Tangent& K) const noexcept {
    for (int j = 0; j < 2 * unknowns; ++j) {
      r[j] = (*this)[j];
      for (int i = 0; i < 2 * unknowns; ++i) K(i, j) = (*this)(i, j);
    }
  }

  /// Where the lower triangle of N rows has (i, j) or (j, i), column by column.
  template <int N>
  static constexpr int half(int i, int j) noexcept {
    const int row = i < j ? j : i, column = i < j ? i : j;
    return column * (2 * N - 1 - column) / 2 + row;
  }
};

namespace detail {

/// An unknown that is an element's own, and how it follows the nodes: its twist ψ [rad], or its tension N [N].
template <typename S, int Unknowns>
struct RodInner {
  using Row = Eigen::Matrix<S, 2 * Unknowns, 1>;

  S value = 0;
  S residual = 0;         ///< ∂V/∂ of it
  S stiffness = 1;        ///< ∂²V/∂² of it, of a tension negative
  Row row = Row::Zero();  ///< ∂²V/∂∂(unknowns)

  /// Energy of the increment that it makes on its own [J].
  S energy() const noexcept { return residual * residual / stiffness; }
  void advance(const Row& x) noexcept { value -= (residual + row.dot(x)) / stiffness; }
};

/// Those of an element, which do not depend on each other.
template <typename S, int Unknowns>
struct RodInners {
  RodInner<S, Unknowns> tension;
};
template <typename S>
struct RodInners<S, 7> {
  RodInner<S, 7> tension, twist;
};

}  // namespace detail

}  // namespace hapbeam
