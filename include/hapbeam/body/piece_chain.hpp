// SPDX-License-Identifier: MIT
// An element that is touched at places within it: a chain of pieces between its nodes, each exact under its own tension, with a node at each contact.
//
// The longest piece lies between two nodes, as an element does.  The others stand on the node on their other side, their root, and carry their tip:
//
//   α = l p - θ,     x' = x ± l (1 + ε)(cos α, sin α),     θ' = l q - α          p, q, ε: of a unit of length (piece.hpp)
//
// so that a contact may lie as near to a node as it likes, and pass it.  Of moderate rotation (cos α, sin α) (1 + ε) becomes (1 + ε - α²/2, α), and
// a contact is a place that is held, without friction: nothing round touches such elements.
// Real-time: noexcept, no allocation, O(contacts²).
// Source: derived here; docs/theory.md, Contact within an element.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <hapbeam/angle.hpp>
#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/body/piece.hpp>

namespace hapbeam::detail {

/// Base class of TouchedElement.   @tparam Most  contacts
template <class Element, typename S, int Most>
class PieceChain {
 protected:
  static constexpr bool Turns = any_rotation<Element>;
  using Vector = Vector2<S>;
  using Contact = InnerContact<S>;
  using Piece = RootedPiece<S>;
  using Root = typename Piece::Root;
  using Density = PieceDensity<Turns, S>;

  /// A node, of the mesh or inner.
  struct Node {
    Vector moved;  // u, w
    S theta, s;
  };

 public:
  /// @param beam  BeamElements   @param e  of its elements
  template <class Parts>
  PieceChain(const Parts& beam, int e) noexcept
      : PieceChain(beam.properties()[e], beam.nodes()[e].s, beam.displacements(e), beam.tension(e),
                   beam.turning(), &beam.natural_shape()) {}
  /// @param turning  as of OwnTension   @param p  of it   @param start  arc position of node 1 [m]   @param d  of its nodes   @param N  tension of the longest piece [N]
  PieceChain(const ElementProperties<S>& p, S start, const Vector6<S>& d, S N, S turning = 1,
             const NaturalShape<S>* natural = nullptr) noexcept
      : properties_(p, start, natural),
        nodes_{Node{{d[0], d[1]}, d[2], start}, Node{{d[3], d[4]}, d[5], start + p.length}},
        N_(N),
        turning_(turning) {}

  /// @param contact  its place is in this element; stays until the last call   @param id  of no other one
  void add(Contact& contact, int id) noexcept {
    int k = count_++;
    number_[of(k)] = k;
    contacts_[of(k)] = &contact, ids_[of(k)] = id;
    for (; k > 0 && in_order(k).s < in_order(k - 1).s; --k) std::swap(number_[of(k)], number_[of(k - 1)]);
  }
  /// Where the contacts are as it lies, after all have been added.
  void look() noexcept {
    find_pieces();
    lay_nodes();
    for (int k = 0; k < count_; ++k) see(k);
  }
  /// Strain energy as it lies [J].
  S strain_energy() noexcept {
    find_pieces();
    lay_nodes();
    S energy = 0;
    for (int k = 0; k < count_; ++k) energy += length(k) * density(k).D;
    S stretch, p, q;
    return energy + (chain_[of(longest_ + 1)].s - chain_[of(longest_)].s) *
                        bridge_density(bridge_chord(), stretch, p, q).D;
  }
  /// Of the longest piece [N].
  S tension() const noexcept { return N_; }

 protected:
  /// Length of the shortest piece: places have no more digits than that [m].
  S shortest(bool sought) const noexcept {
    const S l = nodes_[1].s - nodes_[0].s,
            digits = 16 * std::numeric_limits<S>::epsilon() * (std::abs(nodes_[1].s) + l);
    return sought ? (std::max)(S(1e-10) * l, digits) : digits;
  }
  static constexpr std::size_t of(int i) noexcept { return static_cast<std::size_t>(i); }
  Contact& in_order(int k) const noexcept { return *contacts_[of(number_[of(k)])]; }
  int id(int k) const noexcept { return k < 0 || k >= count_ ? -1 : ids_[of(number_[of(k)])]; }

  /// Which piece is the longest, and whether the others stand where they stood.
  void find_pieces() noexcept {
    longest_ = 0;
    S length = 0;
    chain_[0] = nodes_[0], chain_[of(count_ + 1)] = nodes_[1];
    for (int k = 0; k < count_; ++k) {
      Contact& contact = in_order(k);
      const S least = shortest(contact.moves);
      const auto keep_off = [&](S& s, S from) {
        if (std::abs(s - from) < least) s = s < from ? from - least : from + least;
      };
      S& s = chain_[of(k + 1)].s;
      s = contact.s;
      keep_off(s, nodes_[1].s), keep_off(s, nodes_[0].s);
      if (k > 0) s = (std::max)(s, chain_[of(k)].s + least);
      if (contact.moves) contact.s = s;
    }
    for (int k = 0; k <= count_; ++k) {
      const S by = chain_[of(k + 1)].s - chain_[of(k)].s;
      if (by > length) length = by, longest_ = k;
    }
    bool stand = true;
    for (int k = 0; k < count_; ++k) stand = stand && stands(k);
    if (!stand) lay_pieces();
  }
  Root root(int k) const noexcept { return k < longest_ ? Root::left : Root::right; }
  int next(int k) const noexcept { return id(k < longest_ ? k - 1 : k + 1); }
  bool stands(int k) const noexcept {
    const Piece& piece = in_order(k).piece;
    return piece.root == root(k) && piece.next == next(k);
  }
  /// Lays the pieces that have another root now, from where their ends are.
  void lay_pieces() noexcept {
    std::array<bool, Most + 2> known{};
    known[0] = known[of(count_ + 1)] = true;
    for (int k = 0; k < count_; ++k) {
      const Contact& contact = in_order(k);
      if (contact.piece.root == Root::none) continue;
      known[of(k + 1)] = true;
      Node& at = chain_[of(k + 1)];
      if (contact.piece.next == -1)
        at = tip(contact.piece, nodes_[contact.piece.root == Root::left ? 0 : 1], at.s);
      else at.moved = contact.moved, at.theta = contact.theta;
    }
    // The tension of the longest piece of before goes to what was laid over it.
    const auto turn = [&](int k, Root now) {
      Piece& piece = in_order(k).piece;
      if (piece.root == Root::none) piece.tension = N_;
      else if (piece.root != now) std::swap(N_, piece.tension);
    };
    const auto lay = [&](int k, int root_node) {
      Contact& contact = in_order(k);
      if (stands(k)) return;
      // Of a short piece the places of its ends do not say how it is bent.
      const S l = std::abs(chain_[of(k + 1)].s - chain_[of(root_node)].s);
      const bool is_new = !known[of(k + 1)] || l < S(0.01) * (nodes_[1].s - nodes_[0].s);
      contact.piece.root = root(k), contact.piece.next = next(k);
      const Node& at = chain_[of(root_node)];
      if (is_new) {
        const int by = root_node <= k ? 1 : -1;
        int other = k + 1 + by;
        while (!known[of(other)]) other += by;
        Node& its = chain_[of(k + 1)];
        begin(contact.piece, at, chain_[of(other)], its.s);
        its = tip(contact.piece, at, its.s);
        known[of(k + 1)] = true;
      } else {
        join(contact.piece, at, chain_[of(k + 1)]);
      }
    };
    for (int k = 0; k < longest_; ++k) turn(k, Root::left);
    for (int k = count_ - 1; k >= longest_; --k) turn(k, Root::right);
    for (int k = 0; k < longest_; ++k) lay(k, k);
    for (int k = count_ - 1; k >= longest_; --k) lay(k, k + 2);
  }
  /// Where the tip of a piece is, at s.
  static Node tip(const Piece& piece, const Node& root, S s) noexcept {
    const S side = side_of(piece), l = side * (s - root.s), alpha = l * piece.at_root - root.theta;
    Vector by;
    if constexpr (Turns) {
      const Vector to = direction(alpha);
      const S less = to.x() > 0 ? -to.y() * to.y() / (1 + to.x()) : to.x() - 1;
      by = Vector(piece.stretch + (1 + piece.stretch) * less, (1 + piece.stretch) * to.y());
    } else {
      by = Vector(piece.stretch - alpha * alpha / 2, alpha);
    }
    return {root.moved + side * l * by, l * piece.at_tip - alpha, s};
  }
  static S side_of(const Piece& piece) noexcept { return piece.root == Root::left ? S(1) : S(-1); }
  /// Chord of what is between two nodes.
  struct Chord {
    S length, extension, angle;  // along it and more than l [m], [rad]
    Vector along;                // it

    Chord(const Node& a, const Node& b) noexcept {
      const Vector by = b.moved - a.moved;
      const S l = b.s - a.s;
      if constexpr (Turns) {
        const S x = l + by.x(), w = by.y();
        length = std::sqrt(x * x + w * w);
        extension = (by.x() * (l + x) + w * w) / (length + std::abs(l));
        along = Vector(x, w) / length;
        angle = angle_near(w, x, length, S(-(a.theta + b.theta) / 2));
      } else {
        angle = by.y() / l;
        extension = by.x() + by.y() * angle / 2;
        length = l, along = Vector(1, 0);
      }
    }
  };
  /// A piece between where its ends are.
  static void join(Piece& piece, const Node& root, const Node& tip) noexcept {
    const bool left = piece.root == Root::left;
    const Chord chord(left ? root : tip, left ? tip : root);
    const S i = 1 / (side_of(piece) * (tip.s - root.s));
    piece.stretch = chord.extension * i;
    piece.at_root = (root.theta + chord.angle) * i, piece.at_tip = (tip.theta + chord.angle) * i;
  }
  /// A piece in what lies between its root and another node: a cubic, and beside the root what tension makes of its end.
  void begin(Piece& piece, const Node& root, const Node& other, S s) const noexcept {
    const bool left = piece.root == Root::left;
    const Chord chord(left ? root : other, left ? other : root);
    const S l = std::abs(other.s - root.s), i = 1 / l, f = std::abs(s - root.s) * i,
            a = (root.theta + chord.angle) * i, b = (other.theta + chord.angle) * i;
    piece.at_root = (2 - f) * a + (1 - f) * b, piece.at_tip = -2 * (1 - f) * a - (1 - 2 * f) * b;
    if (f < S(0.01)) {
      const auto k = tension_stiffness(S(piece.tension * l * l / properties_.EI));
      piece.at_root = (k.B() * (a + b) + k.A() * (a - b)) / 4;
      piece.at_tip = -piece.at_root;
    }
    // N is in balance.
    piece.stretch = -Density(properties_, root.s, s, side_of(piece), piece.tension, S(0), piece.at_root,
                             piece.at_tip, true)
                         .N;
  }
  void lay_nodes() noexcept {
    for (int k = 0; k < longest_; ++k)
      chain_[of(k + 1)] = tip(in_order(k).piece, chain_[of(k)], chain_[of(k + 1)].s);
    for (int k = count_ - 1; k >= longest_; --k)
      chain_[of(k + 1)] = tip(in_order(k).piece, chain_[of(k + 2)], chain_[of(k + 1)].s);
  }
  const Node& root_of(int k) const noexcept { return chain_[of(k < longest_ ? k : k + 2)]; }
  /// Of a piece with a root.
  S length(int k) const noexcept { return side_of(in_order(k).piece) * (chain_[of(k + 1)].s - root_of(k).s); }
  Density density(int k) const noexcept {
    const Piece& piece = in_order(k).piece;
    return {properties_,    root_of(k).s,  chain_[of(k + 1)].s,
            side_of(piece), piece.tension, piece.stretch,
            piece.at_root,  piece.at_tip,  true};
  }
  Chord bridge_chord() const noexcept { return {chain_[of(longest_)], chain_[of(longest_ + 1)]}; }
  /// Of the longest one.   @param stretch, p, q  out
  Density bridge_density(const Chord& chord, S& stretch, S& p, S& q) const noexcept {
    const Node &a = chain_[of(longest_)], &b = chain_[of(longest_ + 1)];
    const S l = b.s - a.s, i = 1 / l;
    stretch = chord.extension * i, p = (a.theta + chord.angle) * i, q = (b.theta + chord.angle) * i;
    return {properties_, a.s, b.s, S(1), N_, stretch, p, q, longest_ < count_};
  }
  /// Where a contact is as it lies.
  void see(int k) noexcept { see(in_order(k), chain_[of(k + 1)]); }
  static void see(Contact& contact, const Node& node) noexcept {
    contact.moved = node.moved, contact.theta = node.theta;
    contact.place = Vector(node.s + node.moved.x(), node.moved.y());
    contact.tangent = Turns ? direction(S(-node.theta)) : Vector(1, -node.theta);
    if (Turns && contact.kind == Contact::Kind::round) {
      bool unused;
      contact.gap = contact.look_at_circle(node.s, unused) - contact.reach;
    } else {
      // Of the place, which a node that is held off another is beside.
      const Vector moved = node.moved + (contact.s - node.s) * (contact.tangent - Vector(1, 0));
      contact.gap = contact.normal.dot(moved) - contact.reach;
    }
  }

  PieceProperties<S> properties_;
  std::array<Node, 2> nodes_;
  std::array<Node, Most + 2> chain_;
  S N_, turning_;
  std::array<Contact*, Most> contacts_{};
  std::array<int, Most> number_{}, ids_{};
  int count_ = 0, longest_ = 0;
};

}  // namespace hapbeam::detail
