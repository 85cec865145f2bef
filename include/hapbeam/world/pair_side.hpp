// SPDX-License-Identifier: MIT
// One side of a pair: what a contact within an element of a rod adds to that, to the pair's own equations, and as columns between both.
//
// The element lacks C of the curve at the place (rod_spot.hpp), and so it does there by a force at another place in it.
// Real-time: noexcept, no allocation but at construction, O(1).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/body/rod_spot.hpp>
#include <hapbeam/fem/solver/symmetric_indefinite.hpp>
#include <hapbeam/world/pair.hpp>

namespace hapbeam::detail {

inline constexpr int most_pairs = 16, pair_unknowns = 5;
/// f along the axes of a pair, s₁ and s₂; pair after pair.
using PairEquations = SymmetricIndefinite<double, pair_unknowns * most_pairs>;

/// N of an element, as an unknown that is condensed: ∂²L/∂N∂x, ∂L/∂N and ∂²L/∂N².
template <class Residual>
struct TensionRow {
  Residual row;
  double residual = 0, stiff = 0;
};

/// @tparam Chain  RodChain
template <class Chain>
class PairSide {
  static constexpr int unknowns = Chain::unknowns;
  using Vector = VectorOf<double, 3>;
  using Matrix = Eigen::Matrix<double, 3, 3>;

 public:
  using Spot = RodSpot<typename Chain::Element, double>;
  using Residual = typename Spot::Column;
  using Tangent = typename Spot::Tangent;
  using Column = typename Chain::Assembler::Column;

  explicit PairSide(int elements)
      : column{Column(elements), Column(elements), Column(elements), Column(elements), Column(elements)} {}

  RodPair* pair = nullptr;
  std::size_t side = 0;      // of it: the first rod, or the second
  int row = 0, element = 0;  // where the pair's unknowns begin, and that of the rod
  // The fifth is what friction does to the rod, and the rod not to the place, as that moves.
  std::array<Residual, 5> b, raw;  // ∂²L/∂x∂u, and the same whatever an end of the rod holds
  std::array<double, 4> along;     // bᵀK⁻¹(-r)
  std::array<double, 5> by_N;      // ∂²L/∂N∂u
  std::array<Column, 5> column;    // L⁻¹b
  PairEquations::Unknowns drags;   // entries of the fifth in all equations of pairs

  /// f along n, across it, and the place.
  int columns() const noexcept { return pair->fresh ? 1 : pair->held[side] ? pair->forces : 4; }
  int unknown(int c) const noexcept { return c < 3 ? row + c : row + 3 + static_cast<int>(side); }
  /// Whether there is a fifth.
  bool dragged() const noexcept { return pair->rough() && !pair->held[side]; }

  /// @param p, n1, n2, own  of the element: its nodes, and what are unknowns of its own   @param tension  of its sides, where that is one
  /// @return ½ F · C F [J]
  template <class Node, class Inner>
  double add(const RodProperties<double>& p, const Node& n1, const Node& n2, const Inner& own,
             PairEquations& dense, Residual& r, Tangent& K, TensionRow<Residual>& tension) noexcept {
    spot_.look(p, n1, n2, own.tension.value, pair->s[side] - n1.s);
    const Spot& spot = spot_;
    const double sign = side == 0 ? 1 : -1, C = spot.g.value;
    if (pair->kind == RodPair::Kind::rotation) return turn(sign, r, K), 0.0;
    if (pair->kind == RodPair::Kind::place)
      for (int c = node(), last = c + 3; c < last; ++c) K(c, c) += sign * pair->lent;
    const bool rough = pair->rough();
    // Places are of its part along n.
    const Vector& along_n = along_n_ = sign * pair->force * pair->normal;
    Vector &F = F_ = along_n, &T = T_ = Vector::Zero();
    if (rough) {
      T = sign * pair->friction.force(), F += T;
      drags.fill(0);
      b[4].setZero();
      spot.pull(T, b[4], Spot::by_place);
    }
    spot_.look_at_section(p, n1, n2, own, !rough);
    const bool even = Spot::even(p) && !rough;
    const Matrix yields = Spot::shape(p, spot, spot);
    const Vector yield = yields * F, v = C * yield, rise = spot.g.by(0) * yield;
    spot.pull(F, r, Spot::value);
    double place = -along_n.dot(spot.t) - along_n.dot(rise) / 2;
    if (!even) {
      spot.turn(cross3(v, F), r);
      place -= along_n.dot(turned_yield(yields, F, spot));
      if constexpr (unknowns == 7) spot.twist(F, v, C * yields, K);
    }
    const int here = unknown(3);
    for (int c = 0; c < 3; ++c) {
      const Vector axis = sign * pair->axes[at(c)];
      const Vector moved = yields * axis;
      dense[row + c] += axis.dot(spot.r + v);
      for (int d = 0; d <= c; ++d) dense(row + c, row + d) -= sign * C * moved.dot(pair->axes[at(d)]);
      if (c == 0 || !rough) dense(here, row + c) -= axis.dot(spot.t + rise);
      b[at(c)].setZero();
      spot.pull(axis, b[at(c)], Spot::value);
      if (!even) spot.turn(C * cross3<double>(moved, F) + cross3<double>(v, axis), b[at(c)]);
    }
    b[3].setZero();
    spot.pull(along_n, b[3], Spot::by_place);
    pair->pull[side] = place;
    dense[here] -= place;
    dense(here, here) -= along_n.dot(spot.k) + spot.g.by(0, 0) * along_n.dot(yield) / 2;
    if (p.taut) {
      const double soft = p.softest();
      const Vector moved = soft * spot.g.by(1) * yield;
      tension.residual -= F.dot(spot.by_N) + F.dot(moved) / 2;
      tension.stiff -= F.dot(spot.by_N_twice) + soft * soft * spot.g.by(1, 1) * F.dot(yield) / 2;
      spot.pull(F, tension.row, [soft](const ByPlace& w) { return soft * w.by(1); });
      for (int c = 0; c < 3; ++c) by_N[at(c)] = -sign * pair->axes[at(c)].dot(spot.by_N + moved);
      if (rough) by_N[4] = -T.dot(spot.turned_by_N) - soft * spot.g.by(0, 1) * T.dot(yield) / 2;
      by_N[3] = -along_n.dot(spot.turned_by_N) - soft * spot.g.by(0, 1) * along_n.dot(yield) / 2;
    }
    return F.dot(v) / 2;
  }

  /// What the forces of two sides in one element do at each other's places, after add() of both.   @return F₁ · C F₂ [J]
  template <class Inner>
  static double couple(const RodProperties<double>& p, const Inner& own, PairSide& a, PairSide& b,
                       PairEquations& dense, Residual& r, TensionRow<Residual>& tension) noexcept {
    if (a.spot_.x > b.spot_.x) return couple(p, own, b, a, dense, r, tension);
    const Between C = between(p, own.tension.value, a.spot_.x * p.length, b.spot_.x * p.length);
    a.yield_to(b, p, C, 0, dense, r), b.yield_to(a, p, C, 1, dense, r);
    const Matrix yields = Spot::shape(p, a.spot_, b.spot_);
    const auto enter = [&](int i, int j, double value) {
      dense((std::max)(i, j), (std::min)(i, j)) -= value;
    };
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d) enter(a.row + c, b.row + d, C.value * a.axis(c).dot(yields * b.axis(d)));
    enter(a.unknown(3), b.unknown(3), C.by(0, 1) * a.along_n_.dot(yields * b.along_n_));
    const double both = a.F_.dot(yields * b.F_), soft = p.softest();
    tension.residual -= soft * C.by(2) * both, tension.stiff -= soft * soft * C.by(2, 2) * both;
    return C.value * both;
  }

  /// r, r' and r''.
  struct Point {
    Vector r, tangent, curvature;
  };
  /// Of the true curve of a rod under a force there.
  template <class Parts>
  static Point point(const Parts& parts, int e, double s, const Vector& F, bool rough) noexcept {
    const RodProperties<double>& p = parts.properties(e);
    const Spot spot = spot_at(parts, e, parts.own(e), s, rough);
    const Matrix yields = Spot::shape(p, spot, spot);
    const Vector yield = yields * F;
    Vector t = spot.t + spot.g.by(0) / 2 * yield;
    if (rough || !Spot::even(p)) t += turned_yield(yields, F, spot);
    return {spot.r + spot.g.value * yield, t, spot.k + spot.bend * yield};
  }
  /// What a force at another place of the element adds to that.
  template <class Parts>
  static void bend(Point& sum, const Parts& parts, int e, double s, double other, const Vector& F,
                   const std::array<bool, 2>& rough) noexcept {
    const RodProperties<double>& p = parts.properties(e);
    const auto own = parts.own(e);
    const Spot here = spot_at(parts, e, own, s, rough[0]), there = spot_at(parts, e, own, other, rough[1]);
    const double from = parts.nodes()[e].s;
    const Between C = between(p, own.tension.value, (std::min)(s, other) - from, (std::max)(s, other) - from);
    const int i = s <= other ? 0 : 1;
    const Vector yield = Spot::shape(p, here, there) * F;
    sum.r += C.value * yield, sum.tangent += C.by(i) * yield, sum.curvature += C.by(i, i) * yield;
  }

 private:
  using Between = Jet<double, 3>;  // by both places and N/EI
  using ByPlace = typename Spot::ByPlace;
  template <class Parts, class Inner>
  static Spot spot_at(const Parts& parts, int e, const Inner& own, double s, bool rough) noexcept {
    const RodProperties<double>& p = parts.properties(e);
    const auto &n1 = parts.nodes()[e], &n2 = parts.nodes()[e + 1];
    Spot spot;
    spot.look(p, n1, n2, own.tension.value, s - n1.s);
    spot.look_at_section(p, n1, n2, own, !rough);
    return spot;
  }
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  Vector axis(int c) const noexcept { return side == 0 ? pair->axes[at(c)] : Vector(-pair->axes[at(c)]); }
  /// How two places yield to each other, in units of shape().  Two that press at one place share what they press with as one that has a little of its own.
  static Between between(const RodProperties<double>& p, double N, double x, double y) noexcept {
    constexpr double own = 1e-6;
    return (1 - own) * Spot::between(p, N, x, y);
  }
  /// As couple(): what the other does here.   @param i  which place of C this is
  void yield_to(PairSide& other, const RodProperties<double>& p, const Between& C, int i,
                PairEquations& dense, Residual& r) noexcept {
    const int here = unknown(3);
    const bool rough = pair->rough();
    const Matrix yields = Spot::shape(p, spot_, other.spot_);
    const Vector yield = yields * other.F_, rise = C.by(i) * yield;
    const double bend = C.by(i, i) * along_n_.dot(yield), soft = p.softest(), by_both = soft * C.by(2, i);
    // What of it turns with the section.
    const Vector turned = yield - Spot::stiffer(p) * other.F_;
    const double place = along_n_.dot(rise) + C.value * along_n_.dot(cross3<double>(turning(spot_), turned));
    pair->pull[side] -= place, dense[here] += place, dense(here, here) -= bend;
    for (int c = 0; c < 3; ++c) {
      const Vector of = axis(c), there = yields * other.axis(c);
      dense[row + c] += C.value * of.dot(yield);
      if (c == 0 || !rough) dense(here, row + c) -= of.dot(rise);
      const int its = other.row + c;
      dense((std::max)(here, its), (std::min)(here, its)) -= C.by(i) * along_n_.dot(there);
      if (rough) drags[at(its)] -= C.by(i) * T_.dot(there);
      if (p.taut) by_N[at(c)] -= soft * C.by(2) * of.dot(yield);
      spot_.turn(C.value * cross3<double>(turned, of), b[at(c)]);
      spot_.turn(C.value * cross3<double>(there - Spot::stiffer(p) * other.axis(c), F_), other.b[at(c)]);
    }
    if (rough) drags[at(other.unknown(3))] -= C.by(0, 1) * T_.dot(yields * other.along_n_);
    if (p.taut) by_N[3] -= by_both * along_n_.dot(yield);
    if (p.taut && rough) by_N[4] -= by_both * T_.dot(yield);
    spot_.turn(C.value * cross3<double>(turned, F_), r);
  }
  /// Of the section along the rod.
  static Vector turning(const Spot& spot) noexcept { return cross3(spot.u, spot.k) / spot.stretched; }
  /// Half of how C F changes along the rod because the section turns with it.
  static Vector turned_yield(const Matrix& yields, const Vector& F, const Spot& spot) noexcept {
    const Vector turns = turning(spot);
    return spot.g.value / 2 * (cross3<double>(turns, yields * F) - yields * cross3(turns, F));
  }
  /// Where those of the node of a joint begin.
  int node() const noexcept { return 2 * spot_.x < 1 ? 0 : unknowns; }
  /// The same as add(), of a moment of a joint.  Not inlined by intent: worlds without joints do not pay for it.
  [[gnu::noinline]] void turn(double sign, Residual& r, Tangent& K) noexcept {
    b[3].setZero(), by_N.fill(0);
    for (int c = 0; c < 3; ++c) {
      b[at(c)].setZero();
      if (c < columns()) spot_.turn(sign * pair->axes[at(c)], b[at(c)]);
    }
    const Vector &u = spot_.u, &e = pair->axis, M = sign * pair->force * pair->normal;
    spot_.turn(M, r);
    // θ of increments t of r' and φ, with v = t/|r'| and a = u · v:  u × v + φ u + ½ φ (v - a u),  and of a hinge  ½ (e · θ) e × θ.  Stretch is left out.
    const double i = 1 / spot_.stretched;
    const Vector q = cross3(M, e);
    const Matrix H = sign * pair->lent * (Matrix::Identity() - e * e.transpose()) -
                     (e * q.transpose() + q * e.transpose()) / 2;
    Matrix turns;
    for (int c = 0; c < 3; ++c) turns.col(c) = i * cross3<double>(u, Vector::Unit(c));
    const int t = node() + 3;
    K.template block<3, 3>(t, t) += turns.transpose() * H * turns;
    if constexpr (unknowns == 7) {
      const Vector mixed = turns.transpose() * (H * u) - i / 2 * (M - u * u.dot(M));
      K.template block<3, 1>(t, t + 3) += mixed;
      K.template block<1, 3>(t + 3, t) += mixed.transpose();
      K(t + 3, t + 3) += u.dot(H * u);
    }
  }
  Vector along_n_, T_, F_;  // λ n, T and their sum, on this rod
  Spot spot_;
};

}  // namespace hapbeam::detail
