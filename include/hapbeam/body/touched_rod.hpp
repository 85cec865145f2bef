// SPDX-License-Identifier: MIT
// What contacts within an element of a rod add to its residual and tangent, and a column for each of them.
//
//   place       p = r(s, N) + v,   v = Σ C(s, s', N) F'          r, C: cut_piece.hpp
//   force       F = λ n + T                                      T: of friction
//
//   Π = V + Σ ½ F · v - Σ λ g                g = D(p) - R of a capsule, n · p - d of a held place
//
// Place s is where ∂Π/∂s = 0: where the true curve, which v bends, is tangent.  N is the tension of the element, where that is an unknown.  With
// H = -λ D'' + ∂T, of a contact as it lies, e what v is off, and α any s or N, an increment of the nodes by w at s gives
//
//   δv + w = A (w - e + J δα + C n δλ),  δF = -H (δv + w) + ζ δα + n δλ,   A = (I + C H)⁻¹,  J = C'F + C ζ,  ζ = -H r'
//
// with ' by α, and without T in the ζ of a place, which slides along.  v, s and N are condensed; the forces λ stay, as columns of the rod's system.  What T does to the nodes as s moves is not
// symmetric, and left out.  Where a contact hardly slides no equilibrium may be found without it: there s stays while that is sought.  How C turns with the section is in the residual (its moment is v × F), and in
// the tangent by the force and the twist.
// Real-time: noexcept, no allocation, O(contacts³).
// Source: derived here; docs/theory.md, Contact within an element.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <hapbeam/body/rod_bubbles.hpp>

namespace hapbeam::detail {

/// @tparam Most  contacts
template <class Element, typename S, int Most>
class TouchedRod : private RodBubbles<Element, S, Most> {
  using Base = RodBubbles<Element, S, Most>;
  using Base::at, Base::block, Base::C_, Base::contacts_, Base::count, Base::even, Base::fill, Base::force_,
      Base::ids_, Base::inner_, Base::J_, Base::most_rows, Base::N, Base::of, Base::p_, Base::parallel,
      Base::place, Base::rows, Base::seen_, Base::size, Base::spots_, Base::twice_, Base::unknowns,
      Base::vector, Base::yield_, typename Base::ByPlace, typename Base::Column, typename Base::Contact,
      typename Base::Matrix, typename Base::Spot, typename Base::Square, typename Base::Stack,
      typename Base::Vector;
  using Tangent = typename Spot::Tangent;

 public:
  using Base::add, Base::Base, Base::look, Base::strain_energy;

  /// Where a contact touches the curve as it lies: λ h(s) = 0 has a root λ = 0, and where λ is small Newton's method would take it.
  /// Where the curve is about as sharp as the capsule the contact stays where it is: place and nodes find theirs together.
  /// @param rod  RodElements   @param e  in and out: element   @param id  as of add()   @param here  out: the element with that contact where it is
  template <class Parts>
  static void seek(const Parts& rod, int& e, Contact& contact, int id,
                   std::optional<TouchedRod>& here) noexcept {
    const int before = e;
    const S from = contact.s;
    for (int step = 0; step < most_steps; ++step) {
      here.emplace(rod, e).add(contact, id);
      const S by = here->way_to_foot();
      if (std::isnan(by) && step > 0) {
        e = before, contact.s = from;
        here.reset();
        break;
      }
      if (!(std::abs(by) > close_by * contact.reach)) break;
      here.reset();
      const S s = std::clamp(contact.s + by, contact.least, contact.most);
      if (s != contact.s + by) contact.moves = false;
      contact.s = s;
      while (e > 0 && s < rod.nodes()[e].s) --e;
      while (e + 1 < rod.size() && s > rod.nodes()[e + 1].s) ++e;
      if (!contact.moves) break;
    }
    contact.enter(e);
  }
  S tension() const noexcept { return inner_.tension.value; }

  /// What they add to residual and tangent.   @param rub  (id of a contact) sets its friction, where it touches
  /// @return the energy of what they bend [J]
  template <class Rub>
  S condense(Column& r, Tangent& K, Rub&& rub) noexcept {
    for (int k = 0; k < count(); ++k) {
      if (k >= seen_) look(k);
      rub(ids_[at(k)]);
    }
    fill();
    // H of each, (I + C H)⁻¹, and what comes of them.
    Square H = Square::Zero(size(), size());
    for (int k = 0; k < count(); ++k)
      block(H, k, k) = contacts_[at(k)]->friction_tangent - contacts_[at(k)]->force * spots_[at(k)].curved;
    A_ = C_.lazyProduct(H);
    A_.diagonal().array() += 1;
    invert(A_);
    H_ = H.lazyProduct(A_), AC_ = A_.lazyProduct(C_);
    off_ = -yield_;
    for (int k = 0; k < count(); ++k) of(off_, k) += contacts_[at(k)]->bubble;
    const Stack He = H_.lazyProduct(off_);
    spread(He, H, r, K);
    condense_rows(r, K);
    return force_.dot(yield_) / 2 + force_.dot(off_) + off_.dot(He) / 2;
  }
  /// By how much Π changes as all that is condensed finds its own, but for what the nodes and forces make of that [J].
  S local_change() const noexcept { return change_; }
  /// How many negative pivots of the rod are of places where the curve is sharper than what touches it, and not of the rod.
  int turned() const noexcept { return turned_; }

  // Of contact k, after condense().

  /// ∂²Π/∂λ∂ of both nodes.
  const Column& column(int k) const noexcept { return rows_[at(k)].by_nodes; }
  /// ∂Π/∂λ [m]
  S residual(int k) const noexcept { return rows_[at(k)].residual; }
  /// ∂²Π/∂λ∂λ' [m/N]
  S yields(int k, int other) const noexcept { return rows_[at(k)].by[at(other)]; }

  /// All that was condensed, after an increment.  @param by  of the nodes   @param forces  of the contacts [N]
  /// @param longer  in and out: what the residuals of places were worth [J]   @return tension()
  S advance(const Column& by, const std::array<S, std::size_t(Most)>& forces, S& longer) noexcept {
    std::array<S, most_rows> goes{};
    std::copy_n(forces.begin(), count(), goes.begin());
    const auto lacks = [&](const Row& row) {
      S sum = row.residual + row.by_nodes.dot(by);
      for (int j = 0; j < rows(); ++j) sum += row.by[at(j)] * goes[at(j)];
      return sum;
    };
    if (p_->taut) {
      const Row& row = rows_[at(N())];
      const S stiff = row.by[at(N())];
      goes[at(N())] = -lacks(row) / stiff;
      longer += row.residual * (2 * goes[at(N())] + row.residual / stiff);
    }
    for (int k = count() - 1; k >= 0; --k) {
      Contact& contact = *contacts_[at(k)];
      const Row& row = rows_[at(place(k))];
      contact.off = 0;
      if (row.sought || contact.waits) {
        // A force that becomes a multiple of itself would take the place as many times too far as n · t is not yet none.
        const S change = forces[at(k)], before = std::abs(contact.force);
        const S sum = lacks(row) - row.by[at(k)] * (change - std::clamp(change, -before, before));
        const S ahead = row.sought ? std::clamp(-sum / row.by[at(place(k))], -p_->length, p_->length) : S(0);
        if (row.sought && contact.stays) {
          contact.off = -ahead;
        } else if (row.sought) {
          goes[at(place(k))] = ahead;
          longer += std::abs(sum * ahead);
        } else if (contact.force != 0) {
          longer += sum * sum * contact.reach / std::abs(contact.force);
        }
      }
      contact.waits = false;
    }
    Stack w(size());
    for (int k = 0; k < count(); ++k) of(w, k) = spots_[at(k)].move(by);
    const Stack across = w - off_;
    Stack z = A_.lazyProduct(across);
    for (int i = 0; i < rows(); ++i) z += goes[at(i)] * rows_[at(i)].yields;
    z -= w;
    for (int k = 0; k < count(); ++k) {
      Contact& contact = *contacts_[at(k)];
      contact.bubble += vector(z, k);
      // Of friction that begins to slide the tangent says more than its bound allows.
      const S most = 2 * (vector(yield_, k).norm() +
                          (block(C_, k, k) * contact.normal).norm() * std::abs(forces[at(k)])),
              bubble = contact.bubble.norm();
      if (contact.rough && bubble > most) contact.bubble *= most / bubble;
      contact.force += forces[at(k)];
      contact.s += goes[at(place(k))];
    }
    return p_->taut ? tension() + goes[at(N())] : tension();
  }

 private:
  /// Of an unknown: ∂Π, and ∂²Π by the nodes and by all unknowns.
  struct Row {
    bool sought = false;
    S residual = 0;
    Column by_nodes;
    std::array<S, most_rows> by;
    Stack yields;  // A (C'F + C ζ)
  };

  static constexpr int most_steps = 8;
  static constexpr S close_by = S(1e-3);  // of the reach: from there Newton's method goes with the rest

  /// Adds what all contacts are to the nodes, and finds their columns and what their places are.
  void spread(const Stack& He, Square& H, Column& r, Tangent& K) noexcept {
    const bool turns = turns_with_section();
    const Stack forces = force_ + He;
    r = -on_nodes(forces);
    if constexpr (unknowns == 7) K.col(6).setZero(), K.col(13).setZero();
    for (int k = 0; k < count(); ++k) {
      Spot& spot = spots_[at(k)];
      // Column by column, each whole.  The first one sets them, which takes less than to add to zeros.
      for (int j = 0; j < count(); ++j) {
        const Matrix stiff = block(H_, k, j);
        for (int c = 0; c < 3; ++c) {
          const Column on = spot.on_nodes(stiff.col(c));
          for (int q = 0; q < 4; ++q) {
            const Column by = spots_[at(j)].h[q].value * on;
            if (k + j == 0) K.col(Spot::start(q) + c) = by;
            else K.col(Spot::start(q) + c) += by;
          }
        }
      }
      const Vector F = vector(force_, k), v = vector(yield_, k);
      spot.turns.setZero();
      if (turns) spot.turns = spot.turn(cross3(v, F), r);
      if constexpr (unknowns == 7)
        if (!even()) spot.twist(F, v, block(C_, k, k), K);
    }
    std::array<Stack, most_rows> moves, zeta;  // r' and ζ, of a force n
    for (int i = 0; i < rows(); ++i) moves[at(i)].setZero(size()), zeta[at(i)].setZero(size());
    for (int k = 0; k < count(); ++k) {
      const Spot& spot = spots_[at(k)];
      of(zeta[at(k)], k) = contacts_[at(k)]->normal;
      of(moves[at(place(k))], k) = spot.t;
      of(zeta[at(place(k))], k) = contacts_[at(k)]->force * (spot.curved * spot.t);
      if (!p_->taut) continue;
      of(moves[at(N())], k) = spot.by_N;
      of(zeta[at(N())], k) = -(block(H, k, k) * spot.by_N);
    }
    for (int i = 0; i < rows(); ++i) {
      Row& row = rows_[at(i)];
      Stack steep = A_.transpose().lazyProduct(zeta[at(i)]);  // M ζ - H C'F, M = I - H C = Aᵀ
      row.yields = AC_.lazyProduct(zeta[at(i)]), row.residual = 0;
      if (i >= count()) {
        const Stack& bends = J_[at(i)];
        steep -= H_.lazyProduct(bends), row.yields += A_.lazyProduct(bends);
        row.residual = -force_.dot(bends) / 2;
      }
      row.residual += steep.dot(off_);
      row.by_nodes = -on_nodes(steep);
      moves[at(i)] += row.yields;
      for (int j = 0; j <= i; ++j) {
        S by = -moves[at(i)].dot(zeta[at(j)]);
        if (j >= count()) by -= twice_[at(i)][at(j)] + steep.dot(J_[at(j)]);
        row.by[at(j)] = rows_[at(j)].by[at(i)] = by;
      }
    }
    for (int k = 0; k < count(); ++k) {
      const Spot& spot = spots_[at(k)];
      const Contact& contact = *contacts_[at(k)];
      const Vector F = vector(force_, k), along = contact.force * contact.normal;
      Row &force = rows_[at(k)], &sought = rows_[at(place(k))], &tension = rows_[at(rows() - 1)];
      force.residual -= contact.gap;
      // The moment with which C turns grows with the force.
      if (turns)
        spot.turn(
            cross3<S>(block(C_, k, k) * contact.normal, F) + cross3<S>(vector(yield_, k), contact.normal),
            force.by_nodes);
      sought.residual -= along.dot(spot.t) + spot.turns.dot(spot.k);
      spot.pull(along, sought.by_nodes, Spot::by_place);
      if (!p_->taut) continue;
      tension.residual -= F.dot(spot.by_N) + spot.turns.dot(spot.turned_by_N);
      spot.pull(F, tension.by_nodes, [&](const ByPlace& weight) { return p_->softest() * weight.by(1); });
    }
    if (!p_->taut) return;
    Row& tension = rows_[at(N())];
    tension.residual += inner_.tension.residual, tension.by_nodes += inner_.tension.row;
    tension.by[at(N())] += inner_.tension.stiffness;
  }
  /// Whether C is not the same to all sides.
  bool turns_with_section() const noexcept {
    bool turns = !even();
    for (int k = 0; k < count(); ++k)
      turns = turns || contacts_[at(k)]->rough || contacts_[at(k)]->kind == Contact::Kind::along;
    return turns;
  }
  /// Condenses the places that are sought, and N.
  void condense_rows(Column& r, Tangent& K) noexcept {
    change_ = 0, turned_ = 0;
    for (int i = count(); i < rows(); ++i) {
      Row& row = rows_[at(i)];
      const S stiff = row.by[at(i)], over = 1 / stiff;
      if (i < N()) {
        const int k = i - count();
        Contact& contact = *contacts_[at(k)];
        const S scale = std::abs(contact.force) * spots_[at(k)].t.squaredNorm() / contact.reach;
        const bool told =
            contact.kind == Contact::Kind::round && contact.force != 0 && std::abs(stiff) > parallel * scale;
        // Along a curve that is flatter than the capsule the distance has a minimum.
        if (told) contact.sharp = stiff * contact.force > 0;
        row.sought = told && contact.moves && !contact.waits && !contact.rests;
        if (!row.sought || contact.stays) continue;
        if (contact.sharp) turned_ += contact.force > 0 ? 1 : -1;
        r -= (row.residual * over) * row.by_nodes;
        K -= (over * row.by_nodes).lazyProduct(row.by_nodes.transpose());
      } else {
        Spot::condense_tension(*p_, *Base::a_, *Base::b_, inner_.tension, row.by_nodes, row.residual, stiff,
                               r, K);
      }
      change_ -= row.residual * row.residual * over / 2;
      for (int j = 0; j < rows(); ++j) {
        if (j >= count() && j <= i) continue;
        Row& other = rows_[at(j)];
        const S part = row.by[at(j)] * over;
        other.residual -= part * row.residual;
        other.by_nodes -= part * row.by_nodes;
        for (int m = 0; m < rows(); ++m) other.by[at(m)] -= part * row.by[at(m)];
      }
    }
  }
  /// Nᵀf of all contacts.
  Column on_nodes(const Stack& f) const noexcept {
    Column sum = spots_[0].on_nodes(vector(f, 0));
    for (int k = 1; k < count(); ++k) sum += spots_[at(k)].on_nodes(vector(f, k));
    return sum;
  }

  /// By Gauss and Jordan.  I + C H is near I: what a bubble bends is small beside the reach.
  static void invert(Square& a) noexcept {
    for (int p = 0; p < a.rows(); ++p) {
      const S over = 1 / a(p, p);
      a(p, p) = 1;
      a.row(p) *= over;
      for (int i = 0; i < a.rows(); ++i) {
        if (i == p) continue;
        const S part = a(i, p);
        a(i, p) = 0;
        a.row(i) -= part * a.row(p);
      }
    }
  }

  Square A_, H_, AC_;
  Stack off_;  // v - CF
  std::array<Row, most_rows> rows_;
  S change_ = 0;
  int turned_ = 0;
};

}  // namespace hapbeam::detail
