// SPDX-License-Identifier: MIT
// Residual and tangent of an element of a rod.  Its energy depends on the places of both nodes by Δ = r2 - r1 alone, so each
// derivative by Δ stands here once, and what is symmetric by its lower triangle.  With bending of a round rod at a Gauss point, and its stretch, with their
// derivatives by what they depend on, which rod.hpp brings to the unknowns of both nodes.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <Eigen/Core>

#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/vectors.hpp>

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

/// √(3/5)/2: Gauss points stand at ξ = ½ ± that, and in the middle.
inline constexpr double half_g = 0.38729833462074168852;

/// k |a × b|²/|a|⁴ with a = r' and b ~ r'', and its derivatives.
//   f = B/A - C²/A²,  A = a·a, B = b·b, C = a·b:
//   ∂²f/∂a² = 2fA I + 4fAA aaᵀ + 2fAC (abᵀ + baᵀ) + fCC bbᵀ,   ∂²f/∂b² = 2fB I + fCC aaᵀ,
//   ∂²f/∂a∂b = fC I + 4fAB abᵀ + 2fAC aaᵀ + fCC baᵀ
template <typename S>
struct RoundBend {
  S a[3], b[3], by_a[3], by_b[3], energy;
  S fA2, fB2, fC, x[3], y[3], z[3], u[3];

  /// @param g  Gauss point   @param times  a factor of k: b is shorter by its root   @param i  1/A
  [[gnu::always_inline]] RoundBend(const RodProperties<S>& p, int g, int times, const VectorOf<S, 3>& r1,
                                   const VectorOf<S, 3>& r2, const S& i) noexcept {
    const S B = r2.squaredNorm() * i, c = r1.dot(r2) * i, cc = c * c;
    // r'' is b/(half_g l).
    const S k =
        S(times * three_points.weight[g] / (2 * half_g * half_g)) * p.points[g].bending1 * p.inverse_length;
    energy = k * (B - cc);
    const S ki = k * i, fAA4 = 8 * ki * i * (B - 3 * cc), fAC2 = 8 * ki * i * c, fCC = -2 * ki * i;
    fA2 = 2 * ki * (2 * cc - B), fB2 = 2 * ki, fC = -2 * ki * c;
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r) {
      a[r] = r1[r], b[r] = r2[r];
      by_a[r] = add_product(S(fA2 * a[r]), fC, b[r]), by_b[r] = add_product(S(fB2 * b[r]), fC, a[r]);
      x[r] = add_product(S(fAA4 * a[r]), fAC2, b[r]);
      y[r] = add_product(S(fAC2 * a[r]), fCC, b[r]);
      u[r] = fCC * a[r];
      z[r] = u[r] + u[r];  // 4 fAB is 2 fCC
    }
  }

  [[gnu::always_inline]] S aa(int r, int s) const noexcept { return entry(fA2, x, y, r, s); }
  /// By a_r and b_s.
  [[gnu::always_inline]] S ab(int r, int s) const noexcept { return entry(fC, y, z, r, s); }
  [[gnu::always_inline]] S bb(int r, int s) const noexcept {
    return r == s ? add_product(fB2, u[r], a[s]) : S(u[r] * a[s]);
  }

 private:
  /// What stands on the diagonal, and f aᵀ + g bᵀ.
  [[gnu::always_inline]] S entry(const S& own, const S (&f)[3], const S (&g)[3], int r,
                                 int s) const noexcept {
    return r == s ? add_product(add_product(own, f[r], a[s]), g[r], b[s])
                  : add_product(S(f[r] * a[s]), g[r], b[s]);
  }
};

/// ½ l εᵀ EA M ε, of what is taut without the middle: its derivatives by r' in the middle, m, and at both ends, u and v, where it is not their directions that turn.
template <typename S>
struct RoundStretch {
  S energy = 0, N[3];
  VectorOf<S, 3> u, m, v;  // directions
  S turn[3], own[3];       // N/|r'|, and what stretches stiffen
  S beside, across;

  [[gnu::always_inline]] RoundStretch(const RodProperties<S>& p, const EndsAndMiddle<S>& at) noexcept
      : u(at.v[0]), m(at.v[1]), v(at.v[2]) {
    const auto& M = quadratic_mass;
    const S e[3] = {at.n[0] - 1, p.taut ? S(0) : S(at.n[1] - 1), at.n[2] - 1}, EA = p.axial * p.length,
            with_middle = p.taut ? S(0) : EA;
    HAPBEAM_UNROLL
    for (int i = 0; i < 3; ++i) {
      N[i] = (i == 1 ? with_middle : EA) * (S(M[i][0]) * e[0] + S(M[i][1]) * e[1] + S(M[i][2]) * e[2]);
      energy += N[i] * e[i] / 2;
      turn[i] = N[i] * at.inverse[i];
      own[i] = (i == 1 ? with_middle : EA) * S(M[i][i]) - turn[i];
    }
    beside = with_middle * S(M[0][1]), across = EA * S(M[0][2]);
  }
};

}  // namespace detail

}  // namespace hapbeam
