// SPDX-License-Identifier: MIT
// Contacts within an element of a rod, as it lies: the curve beside each, which its bubble bends off what the nodes hold, and how all of them yield.
//
//   place       p = r(s, N) + v,   v = Σ C(s, s', N) F'          r: as the nodes hold it, C: what that lacks of the curve (cut_piece.hpp)
//   force       F = λ n + T                                      T: of friction
//
// Real-time: noexcept, no allocation, O(contacts²).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/body/rod_spot.hpp>
#include <hapbeam/element/rod/carried_frame.hpp>

namespace hapbeam::detail {

/// Base class of TouchedRod.   @tparam Most  contacts
template <class Element, typename S, int Most>
class RodBubbles {
 protected:
  static constexpr int unknowns = Element::unknowns;
  using Contact = InnerContact<S, 3>;
  using Inner = typename Element::template Inner<S>;
  using Vector = VectorOf<S, 3>;
  using Matrix = Eigen::Matrix<S, 3, 3>;
  /// Vectors of the contacts one behind the other, and matrices by two of them.  Where there may be one alone a compiler knows their size.
  static constexpr int numbers = Most == 1 ? 3 : Eigen::Dynamic;
  using Stack = Eigen::Matrix<S, numbers, 1, 0, 3 * Most, 1>;
  using Square = Eigen::Matrix<S, numbers, numbers, 0, 3 * Most, 3 * Most>;

 public:
  /// @param rod  RodElements   @param e  of its elements
  template <class Parts>
  RodBubbles(const Parts& rod, int e) noexcept
      : a_(&rod.nodes()[e]), b_(&rod.nodes()[e + 1]), p_(&rod.properties(e)), inner_(rod.inner(e)) {}

  /// @param contact  its place is in this element; stays until the last call   @param id  of no other one
  void add(Contact& contact, int id) noexcept {
    contacts_[at(count_)] = &contact;
    ids_[at(count_++)] = id;
  }
  /// Where the contacts are as it lies, after all have been added.
  void look() noexcept {
    for (int k = 0; k < count(); ++k) look(k);
  }
  /// What contacts bend of it alone, as it lies [J].
  S strain_energy() noexcept {
    look(), fill();
    return force_.dot(yield_) / 2;
  }

 protected:
  /// The curve beside a contact.
  struct Spot : RodSpot<Element, S> {
    Matrix curved;  // D''
    Vector turns;   // moment with which C turns with the section, crossed with u

    Vector move(const typename Spot::Column& by) const noexcept {
      Vector sum = this->h[0].value * by.template segment<3>(0);
      for (int q = 1; q < 4; ++q) sum += this->h[q].value * by.template segment<3>(this->start(q));
      return sum;
    }
    /// What a force there is on the nodes.
    typename Spot::Column on_nodes(const Vector& force) const noexcept {
      typename Spot::Column on;
      for (int q = 0; q < 4; ++q) on.template segment<3>(this->start(q)) = this->h[q].value * force;
      if constexpr (unknowns == 7) on[6] = on[13] = 0;
      return on;
    }
  };
  using Column = typename Spot::Column;
  using ByPlace = typename Spot::ByPlace;

  static constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  int count() const noexcept { return Most == 1 ? 1 : count_; }
  int size() const noexcept { return 3 * count(); }
  /// Of contact k.
  template <class Numbers>
  static auto of(Numbers& all, int k) noexcept {
    return all.template segment<3>(3 * k);
  }
  static auto block(Square& all, int i, int j) noexcept { return all.template block<3, 3>(3 * i, 3 * j); }
  static Vector vector(const Stack& all, int k) noexcept { return all.template segment<3>(3 * k); }
  /// Whether it yields alike along both axes of its section.
  bool even() const noexcept { return Spot::even(*p_); }
  /// Of what the second derivative of the distance is across.
  static constexpr S parallel = S(1e-3);

  /// From the place of the only contact to where the curve is tangent, no farther than an element [m].  NaN where there is none beside it.
  S way_to_foot() noexcept {
    look(0), seen_ = 1;
    const Contact& contact = *contacts_[0];
    Spot& spot = spots_[0];
    // Near enough for where it begins, the bubble is that of the force along n.
    S yields = Spot::stiffer(*p_);
    if (!even()) {
      spot.look_at_section(*p_, *a_, *b_, inner_, true);
      const S along = contact.normal.dot(spot.soft_axis);
      yields += std::abs(p_->soft[0] - p_->soft[1]) * along * along;
    }
    const S rise = spot.g.by(0) * contact.force / 2;
    const S off = contact.normal.dot(spot.t) + rise * yields, bends = contact.normal.dot(spot.k),
            round = spot.t.dot(Vector(spot.curved * spot.t));
    // Along a curve that is flatter than the capsule the distance has a minimum, which may be anywhere where it is nearly as sharp.
    const S least = parallel * spot.t.squaredNorm() / contact.reach;
    if (!(bends + round > (std::max)(least, round / 3))) return std::numeric_limits<S>::quiet_NaN();
    return std::clamp(-off / (bends + round), -p_->length, p_->length);
  }
  void look(int k) noexcept {
    Contact& contact = *contacts_[at(k)];
    Spot& spot = spots_[at(k)];
    spot.look(*p_, *a_, *b_, inner_.tension.value, contact.s - a_->s);
    contact.place = spot.r + contact.bubble;
    spot.curved.setZero();
    if (contact.kind == Contact::Kind::along) {
      contact.gap = contact.normal.dot(contact.place) - contact.reach;
      return;
    }
    const S along = contact.axis.nearest(contact.place);
    const Vector off = contact.place - contact.axis.at(along);
    const S distance = std::sqrt(off.squaredNorm());
    const Vector side = contact.side - spot.u * spot.u.dot(contact.side);
    // The axis may have passed the curve.  Nearer to it than half of the reach a plane stands for the capsule: there the direction to the axis says nothing.
    if (off.dot(side) < 0 && 2 * distance > contact.reach) {
      contact.normal = off / distance;
      contact.gap = distance - contact.reach;
      spot.curved = Matrix::Identity() - contact.normal * contact.normal.transpose();
      if (along > 0 && along < 1) {
        const Vector axis = contact.axis.way / std::sqrt(contact.axis.way.squaredNorm());
        spot.curved -= axis * axis.transpose();
      }
      spot.curved /= distance;
    } else {
      const S square = side.squaredNorm();
      if (square > 0) contact.normal = -side / std::sqrt(square);
      contact.gap = contact.normal.dot(off) - contact.reach;
    }
  }

  /// Compliances, forces, and what they make of the curve, of all contacts as they lie.
  void fill() noexcept {
    const int n = size();
    force_.resize(n), slope_.setZero(n), C_.resize(n, n);
    for (int k = 0; k < count(); ++k) {
      Spot& spot = spots_[at(k)];
      const Contact& contact = *contacts_[at(k)];
      of(force_, k) = contact.force * contact.normal + contact.friction;
      // Along itself the curve yields to nothing.
      spot.look_at_section(*p_, *a_, *b_, inner_, !contact.rough && contact.kind != Contact::Kind::along);
    }
    const S soft = p_->softest();
    for (int i = count(); i < rows(); ++i) J_[at(i)].setZero(n), twice_[at(i)].fill(0);
    for (int i = 0; i < count(); ++i) {
      const Spot& spot = spots_[at(i)];
      const ByPlace& own = spot.g;
      const Matrix shape = between(i, i);
      const Vector force = vector(force_, i), moved = shape * force;
      const S half = force.dot(moved) / 2, flat = spot.t.dot(Vector(spot.curved * spot.t));
      Contact& contact = *contacts_[at(i)];
      contact.wraps = flat > 0 ? -contact.normal.dot(spot.k + spot.bend * moved) / flat : S(0);
      block(C_, i, i) = own.value * shape;
      // What slides has its friction at another place of the curve.
      const Vector along = contact.force * contact.normal;
      of(J_[at(place(i))], i) += own.by(0) * moved, of(slope_, i) += own.by(0) / 2 * moved;
      bend_twice(place(i), place(i), along.dot(spot.k) + half * own.by(0, 0));
      if (p_->taut) {
        of(J_[at(N())], i) += soft * own.by(1) * moved;
        bend_twice(place(i), N(), along.dot(spot.turned_by_N) + half * soft * own.by(1, 0));
        bend_twice(N(), N(), force.dot(spot.by_N_twice) + half * soft * soft * own.by(1, 1));
      }
      for (int j = 0; j < i; ++j) {
        const S x = contact.s - a_->s, y = contacts_[at(j)]->s - a_->s;
        const int first = x <= y ? i : j, second = first == i ? j : i;
        const auto to = Spot::between(*p_, inner_.tension.value, (std::min)(x, y), (std::max)(x, y));
        const Matrix both = between(first, second);
        const Vector on_first = both * vector(force_, second),
                     on_second = both.transpose() * vector(force_, first);
        block(C_, first, second) = to.value * both, block(C_, second, first) = to.value * both.transpose();
        // As a place moves, or N grows: what C has of CF, and of ½ F · CF.
        const auto bend = [&](int row, S by) {
          of(J_[at(row)], first) += by * on_first, of(J_[at(row)], second) += by * on_second;
        };
        bend(place(first), to.by(0)), bend(place(second), to.by(1));
        // How steep the force at the other makes the curve.
        of(slope_, first) += to.by(0) * on_first, of(slope_, second) += to.by(1) * on_second;
        const S product = vector(force_, first).dot(on_first);
        bend_twice(place(first), place(first), product * to.by(0, 0));
        bend_twice(place(second), place(second), product * to.by(1, 1));
        bend_twice(place(first), place(second), product * to.by(1, 0));
        if (p_->taut) {
          bend(N(), soft * to.by(2));
          bend_twice(place(first), N(), product * soft * to.by(2, 0));
          bend_twice(place(second), N(), product * soft * to.by(2, 1));
          bend_twice(N(), N(), product * soft * soft * to.by(2, 2));
        }
      }
    }
    yield_ = C_.lazyProduct(force_);
    for (int k = 0; k < count(); ++k) contacts_[at(k)]->tangent = spots_[at(k)].t + vector(slope_, k);
  }
  /// How two places yield to each other, in units of a piece's.
  Matrix between(int i, int j) const noexcept { return Spot::shape(*p_, spots_[at(i)], spots_[at(j)]); }
  // Unknowns beside the nodes: the forces, the places, which are condensed, and so is N behind them.
  int place(int k) const noexcept { return count() + k; }
  int N() const noexcept { return 2 * count(); }
  int rows() const noexcept { return 2 * count() + (p_->taut ? 1 : 0); }
  void bend_twice(int i, int j, S by) noexcept {
    twice_[at(i)][at(j)] += by;
    if (i != j) twice_[at(j)][at(i)] += by;
  }

  static constexpr std::size_t most_rows = std::size_t(2 * Most + 1);
  const RodNode<S>*a_, *b_;
  const RodProperties<S>* p_;
  Inner inner_;  // ψ and N, as of the last equations
  std::array<Contact*, std::size_t(Most)> contacts_{};
  std::array<int, std::size_t(Most)> ids_{};
  int count_ = 0, seen_ = 0;  // how many there are, and have been looked at
  std::array<Spot, std::size_t(Most)> spots_;
  Square C_;
  Stack force_, yield_, slope_;                            // F, CF, how steep that is
  std::array<Stack, most_rows> J_;                         // of each place and N, C'F
  std::array<std::array<S, most_rows>, most_rows> twice_;  // F · r'' + ½ F · C''F
};

}  // namespace hapbeam::detail
