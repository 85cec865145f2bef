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

template <class Element, typename S>
struct RodSpot {
  static constexpr int unknowns = Element::unknowns;
  using Vector = VectorOf<S, 3>;
  using Matrix = Eigen::Matrix<S, 3, 3>;
  using Column = VectorOf<S, 2 * unknowns>;  // of both nodes
  using Tangent = Eigen::Matrix<S, 2 * unknowns, 2 * unknowns>;
  using Properties = RodProperties<S>;
  using Node = RodNode<S>;
  using ByPlace = Jet<S, 2>;  // by s and N/EI

  ByPlace h[4];                          // r as of r1, r1', r2, r2'
  ByPlace g;                             // what it lacks: compliance, times EI
  S bend;                                // curvature under a force there, times EI
  Vector r, t, k, u;                     // r, r', r'', direction of r'
  Vector by_N, by_N_twice, turned_by_N;  // r as of N, and r', where that is an unknown
  S stretched, x;                        // |r'|, ξ
  Matrix axes;                           // in which it yields: all, or those across r'
  Vector soft_axis;                      // of the section

  // Weights.
  static constexpr auto value = [](const ByPlace& w) { return w.value; };
  static constexpr auto by_place = [](const ByPlace& w) { return w.by(0); };

  /// Where r1, r1', r2 and r2' stand among the unknowns of both nodes.
  static constexpr int start(int q) noexcept { return q < 2 ? 3 * q : unknowns + 3 * (q - 2); }
  /// Along the axis along which an element yields less [1/(N·m²)].
  static S stiffer(const Properties& p) noexcept { return (std::min)(p.soft[0], p.soft[1]); }
  /// Whether it yields alike along both axes of its section.
  static bool even(const Properties& p) noexcept { return unknowns < 7 || p.soft[0] == p.soft[1]; }
  /// How two places of an element yield to each other, times EI: by both and by N/EI.
  /// @param N  as of look()   @param x, y  from the left node, x <= y [m]
  static Jet<S, 3> between(const Properties& p, S N, S x, S y) noexcept {
    using J = Jet<S, 3>;
    const J n = p.taut ? J::variable(N * p.softest(), 2) : J(0), longer = stretch(p, n);
    return between_cuts(J(p.length), J::variable(x, 0), J::variable(y, 1), n * longer) * longer * longer;
  }
  /// The same along the axes of space, in units of that, or of g.
  static Matrix shape(const Properties& p, const RodSpot& a, const RodSpot& b) noexcept {
    Matrix sum = stiffer(p) * (&a == &b ? a.axes : Matrix(a.axes * b.axes));
    if (!even(p)) sum += std::abs(p.soft[0] - p.soft[1]) * a.soft_axis * b.soft_axis.transpose();
    return sum;
  }

  /// @param a, b  nodes   @param N  tension, where that is an unknown [N]   @param s  from a [m]
  void look(const Properties& p, const Node& a, const Node& b, S N, S s) noexcept {
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
    r = a.r + all(value);
    t = all(by_place);
    k = all([](const ByPlace& w) { return w.by(0, 0); });
    if (p.taut) {
      by_N = soft * all([](const ByPlace& w) { return w.by(1); });
      by_N_twice = soft * soft * all([](const ByPlace& w) { return w.by(1, 1); });
      turned_by_N = soft * all([](const ByPlace& w) { return w.by(1, 0); });
    }
    stretched = sqrt(t.squaredNorm());
    u = t / stretched;
  }
  /// After look().   @param inner  the element's own unknowns
  /// @param all  what pushes across the true curve, and so not quite across the cubic, moves it along itself; what rubs does not
  template <class Inner>
  void look_at_section(const Properties& p, const Node& a, const Node& b, [[maybe_unused]] const Inner& inner,
                       bool all) noexcept {
    axes = Matrix::Identity();
    if (!all) axes -= u * u.transpose();
    if constexpr (unknowns == 7)
      if (!even(p)) {
        const Vector d1 = Element::director(p, a, b, inner.twist.value, x);
        soft_axis = p.soft[0] > p.soft[1] ? d1 : cross3(u, d1);
      }
  }

  /// Takes off a force there, times a weight.   @param of  of both nodes   @param weight  (ByPlace) -> of what r is of: its value, or a derivative
  template <class Weight>
  void pull(const Vector& force, Column& of, Weight&& weight) const noexcept {
    for (int q = 0; q < 4; ++q) of.template segment<3>(start(q)) -= weight(h[q]) * force;
  }
  /// Takes off a moment that turns with the section.   @return it across the curve, by r'
  Vector turn(const Vector& moment, Column& of) const noexcept {
    const Vector turns = cross3(moment, u) / stretched;
    pull(turns, of, by_place);
    if constexpr (unknowns == 7) {
      const S about = moment.dot(u);
      of[6] -= (1 - x) * about, of[13] -= x * about;
    }
    return turns;
  }
  /// By how much the moment of a force grows as the section twists.   @param v  by which the curve yields   @param C  to the force alone [m/N]
  void twist(const Vector& force, const Vector& v, const Matrix& C, Tangent& K) const noexcept {
    static_assert(unknowns == 7);
    const Vector turned = cross3<S>(u, v) - C * cross3<S>(u, force);
    const S grows = u.dot(cross3<S>(turned, force)), y = 1 - x;
    K(6, 6) -= y * y * grows, K(13, 13) -= x * x * grows;
    K(6, 13) -= x * y * grows, K(13, 6) -= x * y * grows;
  }

  /// Condenses the tension of an element, in the place of how that has been condensed without a contact: with what one that it lacks now does
  /// (round_tension.hpp).   @param before  it without a contact: row, residual and stiffness   @param row, residual, stiffness  of it now
  template <class Tension>
  static void condense_tension(const Properties& p, const Node& a, const Node& b, const Tension& before,
                               const Column& row, S residual, S stiffness, Column& r, Tangent& K) noexcept {
    const S was = 1 / before.stiffness, over = 1 / stiffness;
    r += before.residual * was * before.row - residual * over * row;
    const Column taken = was * before.row, given = over * row;
    for (int j = 0; j < 2 * unknowns; ++j) K.col(j) += before.row[j] * taken - row[j] * given;
    const auto lacks = [](S force, S stiff) { return (std::max)(-force / stiff, S(0)); };
    const S draws = (lacks(residual, stiffness) - lacks(before.residual, before.stiffness)) * p.length,
            by_chord = S(1.5) * p.inverse_length;
    const EndsAndMiddle<S> ends(p, a, b);
    const S middle[4] = {-by_chord, S(-0.25), by_chord, S(-0.25)};
    const auto turns = [&](int i) {
      return Matrix(
          (draws * S(i == 1 ? RoundTension<S>::by_middle : RoundTension<S>::by_end) * ends.inverse[i]) *
          (Matrix::Identity() - ends.v[i] * ends.v[i].transpose()));
    };
    K.template block<3, 3>(start(1), start(1)) += turns(0);
    K.template block<3, 3>(start(3), start(3)) += turns(2);
    const Matrix inside = turns(1);
    for (int q = 0; q < 4; ++q)
      for (int o = 0; o < 4; ++o)
        K.template block<3, 3>(start(q), start(o)) += (middle[q] * middle[o]) * inside;
  }

 private:
  /// 1 + N/EA: so much longer it is than where s counts.   @param n  N/EI of the softest
  template <class J>
  static J stretch(const Properties& p, const J& n) noexcept {
    return J(1) + 1 / (p.softest() * p.axial) * n;
  }
};

}  // namespace hapbeam::detail
