// SPDX-License-Identifier: MIT
// What elements of a rod in space share: properties, and the cubic between two nodes.
//
//   r(ξ) = cubic of Hermite with r and r' = dr/ds of both nodes,   s the arc length of the rod when it is not loaded
//
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <cmath>

#include <hapbeam/element/pack.hpp>
#include <hapbeam/element/tension_stiffness.hpp>
#include <hapbeam/rod_centreline.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam {

/// What an element of a rod is made of.  Stiffnesses and natural strains stand at its Gauss points.
template <typename Scalar>
struct RodProperties {
  Scalar length = 0;          ///< l [m]
  Scalar inverse_length = 0;  ///< [1/m]
  Scalar axial = 0;           ///< EA [N]
  Scalar torsion = 0;         ///< GJ of all of it, of the mean compliance [N·m²]
  Scalar soft[2] = {1, 1};    ///< mean of 1/EI against what moves it along d1, and along d2 [1/(N·m²)]
  int number = 3;             ///< of Gauss points: 2 | 3
  bool round = false;         ///< bends alike about all axes, is straight by nature, and has three points
  bool taut = false;    ///< is straight by nature, between ends that may draw it: its tension is an unknown
  bool swings = false;  ///< is in motion: it bends under that as the cubic of its mass does
  struct Point {
    Scalar bending1 = 0;            ///< EI against curvature about d1 [N·m²]
    Scalar bending2 = 0;            ///< EI against curvature about d2 [N·m²]
    Scalar torsion = 0;             ///< GJ [N·m²]
    Scalar natural[3] = {0, 0, 0};  ///< curvature about d1, about d2, and twist, that cost nothing [1/m]
  } points[3];
  Scalar natural_strain[3] = {0, 0, 0};  ///< ε of the interpolated natural shape at ξ = 0, ½, 1

  [[gnu::always_inline]] Scalar softest() const noexcept {
    using detail::larger;
    return larger(soft[0], soft[1]);
  }
};

namespace detail {

/// Gauss points of an element, ξ, and their weights.
struct GaussRule {
  double x[3], weight[3];
};
inline constexpr GaussRule two_points{{0.21132486540518711775, 0.78867513459481288225, 0}, {0.5, 0.5, 0}},
    three_points{{0.11270166537925831148, 0.5, 0.88729833462074168852}, {5. / 18, 8. / 18, 5. / 18}};
/// @param number  2 | 3
constexpr const GaussRule& gauss_rule(int number) noexcept { return number == 2 ? two_points : three_points; }

/// r' and r'' at ξ as combinations of Δ = r2 - r1, r1' and r2'.
template <typename S>
struct CubicWeights {
  S a, a1, a2;  ///< of r': [1/m, 1, 1]
  S b, b1, b2;  ///< of r'': [1/m², 1/m, 1/m]

  CubicWeights(S x, S inverse_length) noexcept
      : a(6 * x * (1 - x) * inverse_length),
        a1(1 + x * (3 * x - 4)),
        a2(x * (3 * x - 2)),
        b(6 * (1 - 2 * x) * inverse_length * inverse_length),
        b1((6 * x - 4) * inverse_length),
        b2((6 * x - 2) * inverse_length) {}
};

/// The same at a place that is known at compile time, without the length: r' and r''l as combinations of Δ/l, r1' and r2'.
struct CubicAt {
  double a, a1, a2, b, b1, b2;

  constexpr explicit CubicAt(double x) noexcept
      : a(6 * x * (1 - x)),
        a1(1 + x * (3 * x - 4)),
        a2(x * (3 * x - 2)),
        b(6 * (1 - 2 * x)),
        b1(6 * x - 4),
        b2(6 * x - 2) {}
};

/// sum + factor · x for a factor that is known at compile time: nothing is added where it is zero.
template <typename S>
[[gnu::always_inline]] inline void add_share(S& sum, double factor, const S& x) noexcept {
  if (factor != 0) sum = add_product(sum, S(factor), x);
}

/// Lengths and directions of r' at node 1, in the middle and at node 2.
template <typename S>
struct EndsAndMiddle {
  VectorOf<S, 3> middle;  ///< r' there
  S n[3], inverse[3];     ///< |r'|, 1/|r'|
  VectorOf<S, 3> v[3];    ///< directions

  [[gnu::always_inline]] EndsAndMiddle(const RodProperties<S>& p, const RodNode<S>& a,
                                       const RodNode<S>& b) noexcept {
    using std::sqrt;
    const S by_chord = S(1.5) * p.inverse_length;
    HAPBEAM_UNROLL
    for (int r = 0; r < 3; ++r)
      middle[r] = by_chord * (b.r[r] - a.r[r]) - S(0.25) * (a.tangent[r] + b.tangent[r]);
    n[0] = sqrt(a.tangent.squaredNorm()), n[1] = sqrt(middle.squaredNorm());
    n[2] = sqrt(b.tangent.squaredNorm());
    // One division instead of three.
    const S two = n[0] * n[1], all = 1 / (two * n[2]), others = n[2] * all;
    inverse[0] = n[1] * others, inverse[1] = n[0] * others, inverse[2] = two * all;
    v[0] = inverse[0] * a.tangent, v[1] = inverse[1] * middle, v[2] = inverse[2] * b.tangent;
  }
};

/// Mass matrix of the quadratic through ξ = 0, ½, 1.
inline constexpr double quadratic_mass[3][3] = {
    {4. / 30, 2. / 30, -1. / 30}, {2. / 30, 16. / 30, 2. / 30}, {-1. / 30, 2. / 30, 4. / 30}};

}  // namespace detail

}  // namespace hapbeam
