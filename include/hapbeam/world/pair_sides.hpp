// SPDX-License-Identifier: MIT
// What touches one rod: its sides of pairs, as columns of its equations and as their share of the dense ones of all pairs.
//
//   | K  B | | Δx |   | -r |       x: nodes of the rod,  u: δf along the axes of a pair, δs;  B = ∂²L/∂x∂u,  D = ∂²L/∂u∂u
//   | Bᵀ D | | u  | = | -g |       (D - Bᵀ K⁻¹ B) u = -g - Bᵀ K⁻¹ (-r),   by forward sweeps alone
//
// The tension of an element that has one is condensed with them.
// Takes the part of ContactRows for a RodChain.  Allocates at construction.  Real-time: all else is noexcept, allocation-free, O(sides · elements).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <hapbeam/world/pair_side.hpp>

namespace hapbeam::detail {

/// @tparam Chain  RodChain
template <class Chain>
class PairSides {
 public:
  using Side = PairSide<Chain>;
  using Assembler = typename Chain::Assembler;
  static constexpr int unknowns = Chain::unknowns, most = 2 * most_pairs;
  using Vector = VectorOf<double, 3>;
  using Residual = typename Side::Residual;
  using Tangent = typename Side::Tangent;

  PairSides(int elements, PairEquations& equations) : equations_(&equations) {
    // Of a rod on itself both sides are here, and have three columns of the same unknowns.
    sides_.reserve(most), tensions_.reserve(most),
        products_.reserve(2 * most * (4 * most + 1) + 3 * most_pairs);
    for (int k = 0; k < most; ++k) sides_.emplace_back(elements);
  }

  void clear() noexcept { size_ = 0, tensions_.clear(); }
  /// @param side  0: the first rod of the pair, 1: the second   @param row  where the pair's unknowns begin
  void add(RodPair& pair, std::size_t side, int row, int element) noexcept {
    Side& to = sides_[at(size_++)];
    to.pair = &pair, to.side = side, to.row = row, to.element = element;
  }

  /// Calls f(entries in all equations, unknown) of what friction drags along with a place.
  template <class F>
  void visit_dragged(F&& f) noexcept {
    each_dragged([&](Side& side) { f(side.drags, side.unknown(3)); });
  }

  // As ContactRows.

  bool any() const noexcept { return size_ > 0; }
  int size() const noexcept { return size_; }
  int element(int k) const noexcept { return sides_[at(k)].element; }
  bool in(int e) const noexcept {
    for (int k = 0; k < size_; ++k)
      if (element(k) == e) return true;
    return false;
  }
  template <class Parts>
  void seek(const Parts&) noexcept {}
  /// @return what the sides in an element store beside its nodes [J]
  template <class Parts>
  double touch(const Parts& parts, int e, Residual& r, Tangent& K) noexcept {
    r.setZero(), K.setZero();
    const auto &a = parts.nodes()[e], &b = parts.nodes()[e + 1];
    const RodProperties<double>& p = parts.properties(e);
    const auto inner = parts.inner(e);
    TensionRow<Residual> tension{inner.tension.row, inner.tension.residual, inner.tension.stiffness};
    double energy = 0;
    each_in(e, [&](Side& side) {
      energy += side.add(p, a, b, inner, *equations_, r, K, tension);
      each_in(e, [&](Side& before) {
        if (&before < &side && side.pair->yields_to(*before.pair))
          energy += Side::couple(p, inner, before, side, *equations_, r, tension);
      });
    });
    if (p.taut) condense(e, p, a, b, inner.tension, tension, r, K);
    each_in(e, [](Side& side) { side.raw = side.b; });
    return energy;
  }
  /// Calls change(what each column has of the unknowns of a node, its residual).
  template <class Change>
  void visit_node(int node, Change&& change) noexcept {
    for (int k = 0; k < size_; ++k) {
      Side& side = sides_[at(k)];
      if (node != side.element && node != side.element + 1) continue;
      const int from = node == side.element ? 0 : unknowns;
      for (int c = 0; c < side.columns(); ++c) {
        double rest = 0;
        change(side.b[at(c)].template segment<unknowns>(from), rest);
        (*equations_)[side.unknown(c)] -= rest;
      }
      if (double rest = 0; side.dragged()) change(side.b[4].template segment<unknowns>(from), rest);
    }
  }
  /// To be called after factor(): takes the rod out of the equations of the pairs.
  void eliminate(const Assembler& assembler) noexcept {
    for (int k = 0; k < size_; ++k)
      if (Side& side = sides_[at(k)]; side.columns() < 4) equations_->hold(side.unknown(3), -1);
    products_.clear();
    each_column([&](Side& side, int c) {
      assembler.forward(side.element, side.b[at(c)], side.column[at(c)]);
      side.along[at(c)] = assembler.product(side.column[at(c)]);
      (*equations_)[side.unknown(c)] -= side.along[at(c)];
    });
    each_dragged([&](Side& dragged) {
      assembler.forward(dragged.element, dragged.b[4], dragged.column[4]);
      each_column([&](Side& side, int c) {
        dragged.drags[at(side.unknown(c))] -= assembler.product(side.column[at(c)], dragged.column[4]);
      });
    });
    each_two_columns([&](int i, int j, const Column& a, const Column& b) {
      products_.push_back(assembler.product(a, b));
      (*equations_)(i, j) -= products_.back();
    });
  }
  /// To be called after the pairs' equations are solved.   @return ΔᵀKΔ, less what it is without a contact [J]
  double substitute(Assembler& assembler) noexcept {
    double change = 0;
    each_column([&](Side& side, int c) {
      const double u = (*equations_)[side.unknown(c)];
      change -= 2 * u * side.along[at(c)];
      assembler.add(side.column[at(c)], -u);
    });
    each_dragged([&](Side& side) { assembler.add(side.column[4], -(*equations_)[side.unknown(3)]); });
    std::size_t k = 0;
    each_two_columns([&](int i, int j, const Column&, const Column&) {
      change += (i == j ? 1 : 2) * (*equations_)[i] * (*equations_)[j] * products_[k++];
    });
    return change;
  }
  /// To be called where the nodes move.   @param by  (e) -> increments of both nodes   @param set  (e, N)
  template <class By, class Set, class ElementAt>
  double advance(By&& by, Set&& set, ElementAt&&) noexcept {
    for (const auto& [e, tension, row] : tensions_) {
      double sum = row.residual + row.row.dot(by(e));
      each_in(e, [&](const Side& side) {
        for (int c = 0; c < side.columns(); ++c) sum += side.by_N[at(c)] * (*equations_)[side.unknown(c)];
        if (side.dragged()) sum += side.by_N[4] * (*equations_)[side.unknown(3)];
      });
      set(e, tension - sum / row.stiff);
    }
    return 0;
  }
  /// B u of an element's nodes, whatever an end holds.
  Residual pushed(int e) const noexcept {
    Residual sum = Residual::Zero();
    for (int k = 0; k < size_; ++k) {
      const Side& side = sides_[at(k)];
      if (side.element != e) continue;
      for (int c = 0; c < side.columns(); ++c) sum += (*equations_)[side.unknown(c)] * side.raw[at(c)];
      if (side.dragged()) sum += (*equations_)[side.unknown(3)] * side.raw[4];
    }
    return sum;
  }

 private:
  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  using Column = typename Side::Column;

  template <class F>
  void each_in(int e, F&& f) noexcept {
    for (int k = 0; k < size_; ++k)
      if (sides_[at(k)].element == e) f(sides_[at(k)]);
  }
  template <class F>
  void each_column(F&& f) noexcept {
    for (int k = 0; k < size_; ++k)
      for (int c = 0; c < sides_[at(k)].columns(); ++c) f(sides_[at(k)], c);
  }
  template <class F>
  void each_dragged(F&& f) noexcept {
    for (int k = 0; k < size_; ++k)
      if (sides_[at(k)].dragged()) f(sides_[at(k)]);
  }
  /// Calls f(unknown, one no larger, their columns) for each two.
  template <class F>
  void each_two_columns(F&& f) noexcept {
    each_column([&](Side& side, int c) {
      each_column([&](Side& other, int d) {
        if (side.unknown(c) >= other.unknown(d))
          f(side.unknown(c), other.unknown(d), side.column[at(c)], other.column[at(d)]);
      });
    });
  }

  /// In the place of how it has been condensed without a contact.
  template <class Node, class Inner>
  void condense(int e, const RodProperties<double>& p, const Node& a, const Node& b, const Inner& inner,
                const TensionRow<Residual>& tension, Residual& r, Tangent& K) noexcept {
    PairEquations& dense = *equations_;
    Side::Spot::condense_tension(p, a, b, inner, tension.row, tension.residual, tension.stiff, r, K);
    const double over = 1 / tension.stiff;
    tensions_.push_back({e, inner.value, tension});
    each_in(e, [&](Side& side) {
      for (int c = 0; c < 4; ++c) {
        side.b[at(c)] -= side.by_N[at(c)] * over * tension.row;
        if (c == 3 && side.dragged()) side.b[4] -= side.by_N[4] * over * tension.row;
        dense[side.unknown(c)] += side.by_N[at(c)] * over * tension.residual;
        each_in(e, [&](const Side& other) {
          for (int d = 0; d < 4; ++d)
            if (side.unknown(c) >= other.unknown(d))
              dense(side.unknown(c), other.unknown(d)) -= side.by_N[at(c)] * over * other.by_N[at(d)];
        });
        each_in(e, [&](Side& other) {
          if (other.dragged() && c < side.columns())
            other.drags[at(side.unknown(c))] -= side.by_N[at(c)] * over * other.by_N[4];
        });
      }
    });
  }

  std::vector<Side> sides_;
  struct Tension {
    int element;
    double value;
    TensionRow<Residual> row;
  };
  std::vector<Tension> tensions_;  // of touched elements that have one
  std::vector<double> products_;   // bᵀK⁻¹b of each two columns
  PairEquations* equations_;
  int size_ = 0;
};

}  // namespace hapbeam::detail
