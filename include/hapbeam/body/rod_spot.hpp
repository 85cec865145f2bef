// SPDX-License-Identifier: MIT
// The curve of an element of a rod at one place, as its nodes and its tension hold it, and what it lacks there of the true one under a force.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/body/cut_piece.hpp>
#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/element/rod/round_tension.hpp>

namespace hapbeam::detail {

template <typename S>
struct RodSpot {
  using Vector = VectorOf<S, 3>;
  using ByPlace = Jet<S, 2>;  // by s and N/EI

  ByPlace h[4];                          // r as of r1, r1', r2, r2'
  ByPlace g;                             // what it lacks: compliance, times EI
  S bend;                                // curvature under a force there, times EI
  Vector r, t, k, u;                     // r, r', r'', direction of r'
  Vector by_N, by_N_twice, turned_by_N;  // r as of N, and r', where that is an unknown
  S stretched, x;                        // |r'|, ξ

  /// Along the axis along which an element yields less [1/(N·m²)].
  static S stiffer(const RodProperties<S>& p) noexcept { return (std::min)(p.soft[0], p.soft[1]); }
  /// 1 + N/EA: so much longer it is than where s counts.   @param n  N/EI of the softest
  template <class J>
  static J stretch(const RodProperties<S>& p, const J& n) noexcept {
    return J(1) + 1 / (p.softest() * p.axial) * n;
  }

  /// How two places of an element yield to each other, times EI: by both and by N/EI.
  /// @param N  as of look()   @param x, y  from the left node, x <= y [m]
  static Jet<S, 3> between(const RodProperties<S>& p, S N, S x, S y) noexcept {
    using J = Jet<S, 3>;
    const J n = p.taut ? J::variable(N * p.softest(), 2) : J(0), longer = stretch(p, n);
    return between_cuts(J(p.length), J::variable(x, 0), J::variable(y, 1), n * longer) * longer * longer;
  }

  /// Where r1, r1', r2 and r2' stand among so many unknowns a node.
  static constexpr int start(int unknowns, int q) noexcept { return q < 2 ? 3 * q : unknowns + 3 * (q - 2); }
  /// Takes off a moment that turns with the section.   @param of  of both nodes
  template <class Column>
  void turn(const Vector& moment, Column& of) const noexcept {
    constexpr int unknowns = Column::RowsAtCompileTime / 2;
    const Vector turns = cross3(moment, u) / stretched;
    for (int q = 0; q < 4; ++q) of.template segment<3>(start(unknowns, q)) -= h[q].by(0) * turns;
    if constexpr (unknowns == 7) {
      const S about = moment.dot(u);
      of[6] -= (1 - x) * about, of[13] -= x * about;
    }
  }
  /// @param a, b  nodes   @param N  tension, where that is an unknown [N]   @param s  from a [m]
  void look(const RodProperties<S>& p, const RodNode<S>& a, const RodNode<S>& b, S N, S s) noexcept {
    using std::sqrt;
    const S soft = p.softest();
    x = s * p.inverse_length;
    if (p.taut) {
      const ByPlace n = ByPlace::variable(N * soft, 1), longer = stretch(p, n);
      const CutPiece<ByPlace> cut(ByPlace(p.length), ByPlace::variable(s, 0), n * longer);
      cut.weights(p.inverse_length, h);
      g = cut.g * longer * longer, bend = cut.bend * longer.value * longer.value;
    } else {
      bend = cut_slack_piece(p.length, s, h, g);
    }
    const Vector chord = b.r - a.r;
    const auto all = [&](auto&& of) -> Vector {
      return of(h[2]) * chord + of(h[1]) * a.tangent + of(h[3]) * b.tangent;
    };
    r = a.r + all([](const ByPlace& w) { return w.value; });
    t = all([](const ByPlace& w) { return w.by(0); });
    k = all([](const ByPlace& w) { return w.by(0, 0); });
    if (p.taut) {
      by_N = soft * all([](const ByPlace& w) { return w.by(1); });
      by_N_twice = soft * soft * all([](const ByPlace& w) { return w.by(1, 1); });
      turned_by_N = soft * all([](const ByPlace& w) { return w.by(1, 0); });
    }
    stretched = sqrt(t.squaredNorm());
    u = t / stretched;
  }
};

/// The same with the directions in which it yields.
template <class Element, typename S>
struct YieldingSpot : RodSpot<S> {
  using typename RodSpot<S>::Vector;
  using Matrix = Eigen::Matrix<S, 3, 3>;

  Matrix axes;       // all, or those across r'
  Vector soft_axis;  // of the section

  /// Whether it yields alike along both axes of its section.
  static bool even(const RodProperties<S>& p) noexcept {
    return Element::unknowns < 7 || p.soft[0] == p.soft[1];
  }
  /// @param all  what pushes across the true curve, and so not quite across the cubic, moves it along itself; what rubs does not
  template <class Inner>
  void look_at_section(const RodProperties<S>& p, const RodNode<S>& a, const RodNode<S>& b,
                       [[maybe_unused]] const Inner& inner, bool all) noexcept {
    axes = Matrix::Identity();
    if (!all) axes -= this->u * this->u.transpose();
    if constexpr (Element::unknowns == 7)
      if (!even(p)) {
        const Vector d1 = Element::director(p, a, b, inner.twist.value, this->x);
        soft_axis = p.soft[0] > p.soft[1] ? d1 : cross3(this->u, d1);
      }
  }
  /// How two places yield to each other, in units of g.
  static Matrix shape(const RodProperties<S>& p, const YieldingSpot& a, const YieldingSpot& b) noexcept {
    Matrix sum = RodSpot<S>::stiffer(p) * (&a == &b ? a.axes : Matrix(a.axes * b.axes));
    if (!even(p)) sum += std::abs(p.soft[0] - p.soft[1]) * a.soft_axis * b.soft_axis.transpose();
    return sum;
  }
};

/// Adds to the tangent of an element what a tension that it lacks does (round_tension.hpp).
/// @tparam Unknowns  of a node   @param more  [N]
template <int Unknowns, typename S, class Tangent>
void stiffen(const RodProperties<S>& p, const RodNode<S>& a, const RodNode<S>& b, S more,
             Tangent& K) noexcept {
  using Matrix = Eigen::Matrix<S, 3, 3>;
  constexpr auto start = [](int q) { return RodSpot<S>::start(Unknowns, q); };
  const EndsAndMiddle<S> ends(p, a, b);
  const S draws = more * p.length, by_chord = S(1.5) * p.inverse_length;
  const S middle[4] = {-by_chord, S(-0.25), by_chord, S(-0.25)};
  const auto turns = [&](int k) {
    return Matrix(
        (draws * S(k == 1 ? RoundTension<S>::by_middle : RoundTension<S>::by_end) * ends.inverse[k]) *
        (Matrix::Identity() - ends.v[k] * ends.v[k].transpose()));
  };
  K.template block<3, 3>(start(1), start(1)) += turns(0);
  K.template block<3, 3>(start(3), start(3)) += turns(2);
  const Matrix inside = turns(1);
  for (int q = 0; q < 4; ++q)
    for (int o = 0; o < 4; ++o)
      K.template block<3, 3>(start(q), start(o)) += (middle[q] * middle[o]) * inside;
}

}  // namespace hapbeam::detail
