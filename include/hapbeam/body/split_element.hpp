// SPDX-License-Identifier: MIT
// An element that is touched at places within it, split there: a chain of ordinary elements between its nodes, with a node at each contact.
//
//   Π = Σ V - Σ λ g                g = D - R of a circle, n · (u, w) - d of a held place
//
// It is for elements that are not exact under their tension: a chain of exact pieces (touched_element.hpp) would not be what they are.
// A contact beside a node of the mesh acts on that one (node_front.hpp).  Inner nodes are condensed in the order of s; the forces λ stay, as
// columns of the beam's system.
// Real-time: noexcept, no allocation, O(contacts³).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <hapbeam/body/beam_pieces.hpp>
#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/body/node_front.hpp>
#include <hapbeam/centreline.hpp>

namespace hapbeam::detail {

/// @tparam Most  contacts
template <class Element, typename S, int Most>
class SplitElement {
  static constexpr bool Turns = any_rotation<Element>;
  using Vector = Vector2<S>;
  using Node = CentrelineNode<S>;
  using Nodes = std::array<Node, Most + 2>;
  using Contact = InnerContact<S>;
  // Left: it has a node of its own, right: it acts on one of the mesh.
  using Root = typename RootedPiece<S>::Root;
  using Pieces = BeamPieces<Element, S>;

 public:
  /// @param beam  BeamElements   @param e  of its elements
  template <class Parts>
  SplitElement(const Parts& beam, int e) noexcept
      : SplitElement(beam.pieces(), beam.nodes()[e], beam.nodes()[e + 1], beam.tension(e)) {}
  /// @param tension  what tension() answers [N]
  SplitElement(const Pieces& pieces, const Node& left, const Node& right, S tension) noexcept
      : pieces_(&pieces), ends_{left, right}, tension_(tension) {}

  /// @param contact  its place is in this element; stays until the last call   @param id  of no other one
  void add(Contact& contact, int id) noexcept {
    int k = count_++;
    number_[of(k)] = k;
    contacts_[of(k)] = &contact, ids_[of(k)] = id;
    for (; k > 0 && in_order(k).s < in_order(k - 1).s; --k) std::swap(number_[of(k)], number_[of(k - 1)]);
  }
  /// Where the contacts are as it lies, after all have been added.
  void look() noexcept {
    lay_nodes();
    for (int k = 0; k < count_; ++k) (void)see(k);
  }
  /// Strain energy as it lies [J].
  S strain_energy() noexcept {
    lay_nodes();
    S energy = 0;
    for (int i = 0; i <= inner_; ++i) energy += Element::energy(properties(i), displacements(i));
    return energy;
  }
  /// [N]
  S tension() const noexcept { return tension_; }

  /// Residual and tangent, its contacts included.   @param rub  (id of a contact) sets its friction, where it touches   @return V [J]
  template <class Rub>
  S condense(Vector6<S>& r, Matrix6<S>& K, Rub&& rub) noexcept {
    lay_nodes();
    S energy = Element::tangent(properties(0), displacements(0), r, K);
    front_.begin(r, K);
    const auto touch = [&](int node) {
      for (int k = 0; k < count_; ++k) {
        if (spots_[of(k)].node != node) continue;
        const GapChange<S> gap = see(k);
        rub(ids_[of(number_[of(k)])]);
        front_.touch(node == 0, number_[of(k)], in_order(k), gap);
      }
    };
    for (int i = 1; i <= inner_; ++i) {
      touch(i);
      energy += Element::tangent(properties(i), displacements(i), r, K);
      front_.condense(r, K);
    }
    touch(0), touch(inner_ + 1);
    r = front_.residual(), K = front_.tangent();
    for (int k = 0; k < count_; ++k) columns_[of(k)] = front_.column(k);
    return energy;
  }
  /// By how much Π changes as all that is condensed finds its own, but for what the nodes and forces make of that [J].
  S local_change() const noexcept { return front_.change(); }
  /// How many negative pivots of the beam are not of the beam, less those of it that have been condensed.
  int turned() const noexcept { return -front_.negative_pivots(); }

  // Of contact k, after condense().

  /// ∂²Π/∂λ∂(u, w, θ) of both nodes.
  const Vector6<S>& column(int k) const noexcept { return columns_[of(k)]; }
  /// ∂Π/∂λ [m]
  S residual(int k) const noexcept { return front_.residual(k); }
  /// ∂²Π/∂λ∂λ' [m/N]
  S yields(int k, int other) const noexcept { return front_.yields(k, other); }

  /// All that was condensed, after an increment.  @param by  of the nodes   @param forces  of the contacts [N]
  /// @param longer  in and out: as of BeamElements::follow() [J]   @return tension()
  S advance(const Vector6<S>& by, const std::array<S, Most>& forces, S& longer) noexcept {
    std::array<VectorOf<S, 3>, Most + 2> x;
    x[0] = by.template head<3>(), x[of(inner_ + 1)] = by.template tail<3>();
    for (int i = inner_; i > 0; --i) x[of(i)] = front_.recover(i - 1, x[0], x[of(i + 1)], forces);
    longer += front_.longer();
    for (int k = 0; k < count_; ++k) {
      Contact& contact = in_order(k);
      const Spot& spot = spots_[of(k)];
      const VectorOf<S, 3>& moved = x[of(spot.node)];
      contact.force += forces[of(number_[of(k)])];
      contact.moved += moved.template head<2>(), contact.theta += moved[2];
      if (!contact.moves) continue;
      const S goes = spot.goes(moved, length());
      longer += std::abs(contact.force * spot.bend) * goes * goes;
      contact.s += goes;
    }
    return tension_;
  }

 private:
  using Spot = ContactOnNode<Turns, S>;
  static constexpr std::size_t of(int i) noexcept { return static_cast<std::size_t>(i); }
  Contact& in_order(int k) const noexcept { return *contacts_[of(number_[of(k)])]; }
  S length() const noexcept { return ends_[1].s - ends_[0].s; }
  /// Length of the shortest piece [m].  What stands beside it has 12 EI/l³ of its own, and loses (l/a)³ eps of that to the stiffness of a piece of
  /// length a: here √eps.  An arm of that length leaves to its column what the curvature turns with the nodes, of second order of it over the
  /// length of the beam.  Beside a support a press may be as near as contact_mesh.hpp says.
  S shortest() const noexcept {
    return (std::min)(shortest_element<S>(pieces_->length()),
                      length() * std::cbrt(std::sqrt(std::numeric_limits<S>::epsilon())));
  }

  /// On which node each contact acts, and where those are.
  void lay_nodes() noexcept {
    std::array<S, Most> s;
    choose_nodes(s);
    // An inner node lies where its contact was.  It goes along the curve, as a new one comes on it, to where that is.
    Nodes known;
    int last = 0;
    known[0] = ends_[0];
    const S apart = shortest() / 4;
    for (int k = 0; k < count_; ++k) {
      const Contact& contact = in_order(k);
      if (is_inner(k) && contact.piece.root == Root::left && contact.was > known[of(last)].s + apart &&
          contact.was < ends_[1].s - apart)
        known[of(++last)] = {contact.was, contact.moved.x(), contact.moved.y(), contact.theta};
    }
    known[of(++last)] = ends_[1];
    const Centreline<S> curve(known.data(), last + 1, Turns);
    chain_[0] = ends_[0], chain_[of(inner_ + 1)] = ends_[1];
    for (int k = 0; k < count_; ++k) {
      Contact& contact = in_order(k);
      const Root before = contact.piece.root;
      contact.piece.root = is_inner(k) ? Root::left : Root::right, contact.piece.next = -1;
      if (!is_inner(k)) continue;
      Node& node = chain_[of(spots_[of(k)].node)];
      node = {s[of(k)], contact.moved.x(), contact.moved.y(), contact.theta};
      if (before == Root::left && node.s == contact.was) continue;
      const Displacement<S> at = curve.at(node.s);
      node.u = at.u, node.w = at.w, node.theta = at.theta;
    }
  }
  /// @param s  out: of each contact, apart from the one before it
  void choose_nodes(std::array<S, Most>& s) noexcept {
    const S least = shortest();
    inner_ = 0;
    for (int k = 0; k < count_; ++k) {
      Contact& contact = in_order(k);
      // One that goes to and fro between a node of its own and one of the mesh stays.
      const S close_by = contact.piece.root == Root::right ? S(1.5) * least : least;
      S& at = s[of(k)] = contact.s;
      if (inner_ > 0 && spots_[of(k - 1)].node == inner_) at = (std::max)(at, s[of(k - 1)] + least);
      if (contact.moves) contact.s = at;
      Spot& spot = spots_[of(k)] = {};
      if (at - ends_[0].s < close_by) spot.arm = at - ends_[0].s;
      else if (ends_[1].s - at < close_by) spot.node = Most + 1, spot.arm = at - ends_[1].s;
      else spot.node = ++inner_;
    }
    for (int k = 0; k < count_; ++k)
      if (spots_[of(k)].node == Most + 1) spots_[of(k)].node = inner_ + 1;
  }
  bool is_inner(int k) const noexcept { return spots_[of(k)].node > 0 && spots_[of(k)].node <= inner_; }
  ElementProperties<S> properties(int i) const noexcept {
    return pieces_->between(chain_[of(i)].s, chain_[of(i + 1)].s);
  }
  Vector6<S> displacements(int i) const noexcept {
    const Node &a = chain_[of(i)], &b = chain_[of(i + 1)];
    return {a.u, a.w, a.theta, b.u, b.w, b.theta};
  }
  GapChange<S> see(int k) noexcept {
    Spot& spot = spots_[of(k)];
    const S curvature = Centreline<S>(chain_.data(), inner_ + 2, Turns).curvature(spot.node);
    return spot.look(in_order(k), chain_[of(spot.node)], curvature, length());
  }

  const Pieces* pieces_;
  std::array<Node, 2> ends_;
  S tension_;
  Nodes chain_;
  std::array<Spot, Most> spots_;
  NodeFront<S, Most> front_;
  std::array<Vector6<S>, Most> columns_;
  std::array<Contact*, Most> contacts_{};
  std::array<int, Most> number_{}, ids_{};
  int count_ = 0, inner_ = 0;
};

}  // namespace hapbeam::detail
