// SPDX-License-Identifier: MIT
// A piece of an element, exact under its own tension: energy of a unit of its length, and derivatives of that by all that a piece has.
//
//   V = l D,   D = N (ε - ε0) - N²/2EA + ¼ EI (6 (P - P0)² + 2 (M - M0)² + (B - 6) P² + (A - 2) M²),   P = p + q,   M = p - q
//
// ε: stretch;  p, q: rotations of root and tip against the chord over the length l;  N: tension, an unknown;  A, B of N l²/EI:
// tension_stiffness.hpp;  P0, M0: those of the natural shape;  ε0: its stretch, with ½ w'²,  c/l - 1 + l² (P0²/40 + M0²/24),  c: its chord.
// Of an arc of curvature κ that is  P0 = 0, M0 = κ,  and ε0 = sin x/x - 1 + x²/6,  x = κ l/2;  where rotations are moderate, that of the whole element.
//
// D has no 1/l: a piece of no length has no energy, and the same derivatives as a short one.
// Real-time: noexcept, no allocation, O(1); O(arcs) where several lie in the element.
// Source: derived here; docs/theory.md, Contact within an element.
#pragma once

#include <cmath>
#include <limits>

#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/element/stability_functions.hpp>

namespace hapbeam::detail {

/// Of all pieces of an element.
template <typename S>
struct PieceProperties {
  S EA, EI;                                ///< [N], [N·m²]
  S curvature = 0;                         ///< natural, of what turns clockwise [1/m]
  S excess = 0;                            ///< natural stretch, with ½ w'², where rotations are moderate
  const NaturalShape<S>* shape = nullptr;  ///< where it has several arcs within the element
  bool straight;                           ///< by nature

  /// @param natural  null: one arc, or none
  PieceProperties(const ElementProperties<S>& p, S start, const NaturalShape<S>* natural) noexcept
      : EA(p.axial_stiffness),
        EI(p.bending_per_length3 * p.length * p.length * p.length),
        straight(p.natural_stretch == 0) {
    if (straight) return;
    const S i = p.inverse_length;
    curvature = (p.natural_a - p.natural_b) * i * i;
    excess = p.natural_stretch * i + natural_mean_square(p) * i * i / 2;
    const S end = start + p.length, digits = 16 * std::numeric_limits<S>::epsilon() * end;
    if (natural && natural->changes_within(start + digits, end - digits)) shape = natural;
  }
};

/// What the natural shape makes of a piece, with derivatives by the length.
template <bool Turns, typename S>
struct NaturalPiece {
  struct Changes {
    S value = 0, first = 0, second = 0;
  };
  Changes sum, difference, excess;  // P0, M0, ε0

  NaturalPiece(const PieceProperties<S>& all, S from, S to, S side, bool tip_moves) noexcept {
    const S left = side > 0 ? from : to, right = side > 0 ? to : from;
    if (!all.shape) {
      arc(side * all.curvature, right - left, all.excess);
    } else {
      const auto ends = all.shape->ends(left, right);
      if (all.shape->changes_within(left, right)) several(ends, right - left, side, tip_moves);
      else arc(-side * ends.curvature_a, right - left, S(0));
    }
  }

 private:
  /// @param k  of p less q   @param even  ε0 of moderate rotation
  void arc(S k, S length, S even) noexcept {
    difference.value = k;
    if constexpr (Turns) {
      // sin x/x - 1 + x²/6
      const S x2 = k * k * length * length / 4, x4 = x2 * x2,
              c = S(1. / 120) - x2 * (S(1. / 5040) - x2 * (S(1. / 362880) - x2 * S(1. / 39916800)));
      const S y1 = x2 * (S(1. / 60) - x2 * (S(1. / 1680) - x2 * (S(1. / 90720) - x2 * S(1. / 7983360)))),
              y2 = S(1. / 60) - x2 * (S(1. / 840) - x2 * (S(1. / 30240) - x2 * S(1. / 1995840)));
      const S by = k * k * length / 2;  // of x² by l
      excess = {x4 * c, y1 * by, y2 * by * by + y1 * k * k / 2};
    } else {
      excess.value = even;
    }
  }
  /// The end that moves goes along its tangent, and turns as it is curved there.
  void several(const typename NaturalShape<S>::Ends& ends, S length, S side, bool tip_moves) noexcept {
    const bool right_moves = (side > 0) == tip_moves;
    const S i = 1 / length, over = 1 / (1 + ends.shorter), rho = right_moves ? ends.b : ends.a,
            bends = right_moves ? ends.curvature_b : -ends.curvature_a;
    // Derivatives of the chord, and of its angle.
    const S c = std::cos(rho), s = std::sin(rho), half = std::sin(rho / 2), turn = -s * i * over,
            rho1 = bends + turn, turn2 = (c * s * i * over - c * rho1) * i * over;
    const Changes both{ends.a + ends.b, 2 * turn + bends, 2 * turn2},
        apart{side * (ends.a - ends.b), tip_moves ? -bends : bends, 0};
    const auto over_length = [&](const Changes& a) {
      const S value = a.value * i, first = (a.first - value) * i;
      return Changes{value, first, (a.second - 2 * first) * i};
    };
    sum = over_length(both), difference = over_length(apart);
    const Changes chord = over_length({ends.shorter * length, -2 * half * half, -s * rho1});
    excess = {chord.value + both.value * both.value / 40 + apart.value * apart.value / 24,
              chord.first + both.value * both.first / 20 + apart.value * apart.first / 12,
              chord.second + (both.first * both.first + both.value * both.second) / 20 +
                  (apart.first * apart.first + apart.value * apart.second) / 12};
  }
};

/// D and its derivatives by p, q, N and l; by ε it is N.
template <bool Turns, typename S>
struct PieceDensity {
  S D, p, q, N, l;
  S pp, pq, pN, qN, NN, pl, ql, Nl, ll;

  /// @param from, to  arc positions of root and tip [m]   @param side  1: the root is on the left, -1: on the right
  /// @param tip_moves  whether the tip is where the length changes
  PieceDensity(const PieceProperties<S>& all, S from, S to, S side, S tension, S stretch, S at_root, S at_tip,
               bool tip_moves) noexcept {
    const S EI = all.EI, yields = 1 / all.EA, length = side * (to - from);
    const S sum = at_root + at_tip, difference = at_root - at_tip;
    // N l²/EI and its derivatives
    const S more = Turns ? yields : S(0), i = 1 / EI, two = 2 * i * length,
            n = tension * (1 + more * tension), n1 = 1 + 2 * more * tension, tN = n1 * length * length * i,
            tl = n * two, tNN = more * length * two, tNl = n1 * two, tll = 2 * n * i;
    const TensionStiffness<S> f = tension_stiffness(S(n * length * length * i));
    const S half = EI / 2, s2 = sum * sum, d2 = difference * difference,
            u1 = half / 2 * (f.b1 * s2 + f.a1 * d2), u2 = half / 2 * (f.b2 * s2 + f.a2 * d2),
            w1 = half * (f.b1 * sum + f.a1 * difference), w2 = half * (f.b1 * sum - f.a1 * difference);
    // Less what bends nothing: the square of a difference keeps the digits of a piece that is nearly at rest.
    S bent = sum, arched = difference;
    N = stretch - tension * yields + u1 * tN, l = u1 * tl;
    pl = w1 * tl, ql = w2 * tl, Nl = u2 * tN * tl + u1 * tNl, ll = u2 * tl * tl + u1 * tll;
    pN = w1 * tN, qN = w2 * tN, NN = -yields + u2 * tN * tN + u1 * tNN;
    pp = half * (f.B() + f.A()), pq = half * (f.B() - f.A());
    D = tension * (stretch - tension * yields / 2);
    if (!all.straight) {
      const NaturalPiece<Turns, S> natural(all, from, to, side, tip_moves);
      const auto &sum0 = natural.sum, &difference0 = natural.difference, &excess = natural.excess;
      bent -= sum0.value, arched -= difference0.value;
      D -= tension * excess.value, N -= excess.value, Nl -= excess.first;
      l -= tension * excess.first + EI * (3 * bent * sum0.first + arched * difference0.first);
      ll += EI * (3 * (sum0.first * sum0.first - bent * sum0.second) + difference0.first * difference0.first -
                  arched * difference0.second) -
            tension * excess.second;
      pl -= EI * (3 * sum0.first + difference0.first), ql -= EI * (3 * sum0.first - difference0.first);
    }
    const S bs = half * (6 * bent + f.b * sum), ad = half * (2 * arched + f.a * difference);
    D += half / 2 * (6 * bent * bent + 2 * arched * arched + f.b * s2 + f.a * d2);
    p = bs + ad, q = bs - ad;
  }
};

}  // namespace hapbeam::detail
