// SPDX-License-Identifier: MIT
// What a touched element, a chain of pieces with a node at each contact, is to its beam: residual, tangent and a column for each contact.
//
//   Π = Σ V - Σ λ g                g = D - R of a circle, n · (u, w) - d of a held place
//
// Place s is where two lengths change: ∂Π/∂s = 0 says that the curve is tangent, because the mesh carries no force of its own there.
// Deformations, tensions and places are unknowns of the element alone and are condensed, from the longest piece outward; the forces λ stay, as columns of
// the beam's system.
// Real-time: noexcept, no allocation, O(contacts²).
// Source: derived here; docs/theory.md, Contact within an element.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include <hapbeam/body/piece_chain.hpp>
#include <hapbeam/element/pack.hpp>
#include <hapbeam/vectors.hpp>

namespace hapbeam::detail {

/// @tparam Most  contacts
template <class Element, typename S, int Most>
class TouchedElement : private PieceChain<Element, S, Most> {
  static_assert(has_own_tension<Element>,
                "pieces are exact under a tension of their own: other elements are a SplitElement");
  using Base = PieceChain<Element, S, Most>;
  using Base::bridge_density, Base::chain_, Base::contacts_, Base::count_, Base::density, Base::find_pieces,
      Base::id, Base::in_order, Base::lay_nodes, Base::length, Base::longest_, Base::N_, Base::nodes_,
      Base::number_, Base::of, Base::properties_, Base::root_of, Base::see, Base::shortest, Base::turning_,
      Base::Turns, typename Base::Chord, typename Base::Contact, typename Base::Density, typename Base::Node,
      typename Base::Piece, typename Base::Vector;
  // Of a front: u, w, θ, s of both nodes between which pieces have been condensed, forces, and the gradient.  Of a piece that is condensed into it its
  // own come first; a node of the mesh has no s.
  static constexpr int state = 4, both = 2 * state, gradient = both + Most, wide = gradient + 1;
  static constexpr int own = 4, ends = Most > 1 ? 4 : 3, made = own + ends, all = made + ends;
  // Whole blocks of what stands side by side, of which the last may have more than is read.
  using Block = Pack<S, (std::min)(pack_size<S>, 4)>;
  static constexpr std::size_t block = Block::size, last = all + Most, width = (last / block + 1) * block;
  using Row = std::array<S, width>;
  using Front = std::array<std::array<S, wide>, both>;

 public:
  using Base::add, Base::Base, Base::look, Base::strain_energy, Base::tension;

  /// Residual and tangent, its contacts included.   @param rub  (id of a contact) sets its friction, where it touches   @return V [J]
  template <class Rub>
  S condense(Vector6<S>& r, Matrix6<S>& K, Rub&& rub) noexcept {
    find_pieces();
    lay_nodes();
    for (auto& row : yields_) row.fill(0);
    change_ = longer_ = 0;
    turned_ = 0;
    bridge();
    for (int k = longest_ - 1; k >= 0; --k) touch(k, 0, rub), stand(k, 0);
    for (int k = longest_; k < count_; ++k) touch(k, state, rub), stand(k, state);
    for (int i = 0; i < 6; ++i) {
      const auto& row = front_[of(i < 3 ? i : i + 1)];
      r[i] = row[gradient];
      for (int j = 0; j < 6; ++j) K(i, j) = row[of(j < 3 ? j : j + 1)];
      for (int k = 0; k < count_; ++k) columns_[of(k)][i] = row[of(both + k)];
    }
    return energy_;
  }
  /// By how much Π changes as all that is condensed finds its own, but for what the nodes and forces make of that [J].
  S local_change() const noexcept { return change_; }

  /// How many negative pivots of the beam are of places where the curve is sharper than what touches it, and not of the beam.
  int turned() const noexcept { return turned_; }

  // Of contact k, after condense().

  /// ∂²Π/∂λ∂(u, w, θ) of both nodes.
  const Vector6<S>& column(int k) const noexcept { return columns_[of(k)]; }
  /// ∂Π/∂λ [m]
  S residual(int k) const noexcept { return residual_[of(k)]; }
  /// ∂²Π/∂λ∂λ' [m/N]
  S yields(int k, int other) const noexcept {
    return yields_[of((std::min)(k, other))][of((std::max)(k, other))];
  }

  /// All that was condensed, after an increment.  @param by  of the nodes   @param forces  of the contacts [N]
  /// @param longer  in and out: as of BeamElements::follow() [J]   @return tension of the longest piece [N]
  S advance(const Vector6<S>& by, const std::array<S, Most>& forces, S& longer) noexcept {
    // Of nodes and contacts, from node 1 to node 2: each piece after those that were condensed into it later.
    std::array<std::array<S, state>, Most + 2> nodes{};
    for (int i = 0; i < 3; ++i) nodes[0][of(i)] = by[i], nodes[of(count_ + 1)][of(i)] = by[3 + i];
    const auto go = [&](int k, int root, int other) {
      Row x{};
      for (int i = 0; i < ends; ++i)
        x[of(own + i)] = nodes[of(root)][of(i)], x[of(made + i)] = nodes[of(other)][of(i)];
      nodes[of(k + 1)] = recover(k, x, forces, longer);
    };
    for (int k = count_ - 1; k >= longest_; --k) go(k, k + 2, 0);
    for (int k = 0; k < longest_; ++k) go(k, k, longest_ + 1);
    S change = bridge_.lack;
    for (int i = 0; i < state; ++i)
      change += bridge_.by[of(i)] * nodes[of(longest_)][of(i)] +
                bridge_.by[of(state + i)] * nodes[of(longest_ + 1)][of(i)];
    const S step = -change / bridge_.stiff;
    longer += longer_ + bridge_.lack * (2 * step + bridge_.lack / bridge_.stiff);
    for (int k = 0; k < count_; ++k) contacts_[of(k)]->force += forces[of(k)];
    return N_ + step;
  }

 private:
  /// What advance() needs of a piece that was condensed.
  struct Record {
    bool moves = false, waits = false;
    S side = 1;
    std::array<Row, 4> rows;
    Vector on, turn, slides;  // derivatives of the tip: by ε, by the rotation of its root, by s
    S length, turns;          // [m]; of its rotation by s
    std::array<S, 4> tension;
    S lack, stiff;
  };
  /// Compliance of its length [m/N].
  S softest() const noexcept {
    const S l = nodes_[1].s - nodes_[0].s;
    return l * l * l / properties_.EI;
  }
  /// The longest piece, between its nodes.
  void bridge() noexcept {
    const Node &a = chain_[of(longest_)], &b = chain_[of(longest_ + 1)];
    const Chord chord = this->bridge_chord();
    const S l = b.s - a.s, i = 1 / l;
    S stretch, p, q;
    const Density D = bridge_density(chord, stretch, p, q);
    energy_ = l * D.D;
    const S lack = l * D.N, stiff = l * D.NN, missing = -lack / stiff, inverse = 1 / stiff;
    change_ += lack * missing / 2;
    // By stretch, rotation of either end and length, without N.
    const S Nl = D.N + l * D.Nl - (1 + stretch) - D.pN * p - D.qN * q;
    const S fp = D.pp * i, fq = D.pq * i, pl = D.pl - fp * p - fq * q, ql = D.ql - fq * p - fp * q,
            ll = 2 * D.l + l * D.ll - 2 * (p * D.pl + q * D.ql) + fp * (p * p + q * q) + 2 * fq * p * q;
    const S cc = -inverse, cp = -D.pN * inverse, cq = -D.qN * inverse, cl = -Nl * inverse;
    const S pp = fp + D.pN * cp, pq = fq + D.pN * cq, qq = fp + D.qN * cq, pL = pl + D.pN * cl,
            qL = ql + D.qN * cl, lL = ll + Nl * cl;
    const S pull = N_ + missing, gp = D.p + D.pN * missing, gq = D.q + D.qN * missing,
            gl = D.D + l * D.l - N_ * (1 + stretch) - p * D.p - q * D.q + Nl * missing;
    const S swings = gp + gq, j = 1 / chord.length,
            bow = larger(N_, S(N_ + turning_ * missing)) * chord.length,
            leans = cp + cq - (Turns ? swings * j : S(0)), lengthens = pL + qL - (Turns ? S(0) : swings * j);
    // Derivatives by chord, angle and length as those by place of B against A, and length.
    using Three = std::array<S, 3>;
    const auto by_place = [&chord, across = Vector(j * chord.along)](S c, S turn, S longer) {
      const Vector& along = chord.along;
      const S alpha = chord.angle;
      return Turns ? Three{along.x() * c - across.y() * turn, along.y() * c + across.x() * turn, longer}
                   : Three{c, alpha * c + across.x() * turn,
                           longer - alpha * (alpha * c / 2 + across.x() * turn)};
    };
    // Of chord, angle and length: the tangent, rotations of A and B, the gradient, and N.
    const S parts[3][7] = {{cc, leans, cl, cp, cq, pull, 1},
                           {leans, pp + 2 * pq + qq + bow, lengthens, pp + pq, pq + qq, swings, D.pN + D.qN},
                           {cl, lengthens, lL, pL, qL, gl, Nl}};
    Three there[7], K[3];
    HAPBEAM_UNROLL
    for (int n = 0; n < 7; ++n) there[n] = by_place(parts[0][n], parts[1][n], parts[2][n]);
    HAPBEAM_UNROLL
    for (std::size_t m = 0; m < 3; ++m) {
      const Three row = by_place(there[0][m], there[1][m], there[2][m]);
      HAPBEAM_UNROLL
      for (std::size_t n = 0; n <= m; ++n) K[m][n] = K[n][m] = row[n];
    }
    const Three &by_a = there[3], &by_b = there[4], &pulls = there[5], &lacks = there[6];
    // A takes it off, and B adds it.
    const std::array<std::size_t, 3> of_a{0, 1, 3}, of_b{4, 5, 7};
    for (std::size_t m = 0; m < 3; ++m) {
      const std::size_t ma = of_a[m], mb = of_b[m];
      for (std::size_t n = 0; n < 3; ++n) {
        const std::size_t na = of_a[n], nb = of_b[n];
        front_[ma][na] = front_[mb][nb] = K[m][n];
        front_[ma][nb] = front_[mb][na] = -K[m][n];
      }
      front_[ma][2] = front_[2][ma] = -by_a[m], front_[mb][2] = front_[2][mb] = by_a[m];
      front_[ma][6] = front_[6][ma] = -by_b[m], front_[mb][6] = front_[6][mb] = by_b[m];
      front_[ma][gradient] = -pulls[m], front_[mb][gradient] = pulls[m];
      bridge_.by[ma] = -lacks[m], bridge_.by[mb] = lacks[m];
    }
    front_[2][2] = pp, front_[6][6] = qq, front_[2][6] = front_[6][2] = pq;
    front_[2][gradient] = gp, front_[6][gradient] = gq, bridge_.by[2] = D.pN, bridge_.by[6] = D.qN;
    for (auto& row : front_)
      for (int k = 0; k < Most; ++k) row[of(both + k)] = 0;
    bridge_.lack = lack, bridge_.stiff = stiff;
  }
  /// A contact at an end of the front, which is at `from` of it.
  template <class Rub>
  void touch(int k, int from, Rub&& rub) noexcept {
    see(k);
    Contact& contact = in_order(k);
    const S bend = Turns && contact.kind == Contact::Kind::round && contact.gap > -contact.reach / 2
                       ? contact.force / (contact.gap + contact.reach)
                       : S(0);
    const int number = number_[of(k)];
    const Vector n = contact.normal, t(-n.y(), n.x());
    residual_[of(number)] = -contact.gap;
    for (int i = 0; i < 2; ++i) {
      auto& row = front_[of(from + i)];
      row[gradient] -= contact.force * n[i];
      row[of(both + number)] -= n[i];
      for (int j = 0; j < 2; ++j) row[of(from + j)] -= bend * t[i] * t[j];
    }
    if (contact.kind == Contact::Kind::along) {
      const S arm = contact.s - chain_[of(k + 1)].s;
      const Vector left = Turns ? Vector(-contact.tangent.y(), contact.tangent.x()) : Vector(0, 1);
      auto& row = front_[of(from + 2)];
      row[gradient] += contact.force * arm * n.dot(left);
      row[of(both + number)] += arm * n.dot(left);
      if (Turns) row[of(from + 2)] += contact.force * arm * n.dot(contact.tangent);
    }
    if constexpr (Turns) add_friction(k, from, t, rub);
  }
  /// At a contact that was added.   @param t  along the surface
  template <class Rub>
  void add_friction(int k, int from, const Vector& t, Rub&& rub) noexcept {
    Contact& contact = in_order(k);
    // Friction is at this place of the beam: it moves with the curve, less as far as s goes along it.
    rub(id(k));
    const S rubs = contact.friction.dot(t), stiff = contact.friction_stiffness;
    if (rubs == 0 && stiff == 0) return;
    // The jump of N + N²/2EA is that of N times the mean of 1 + N/EA.
    const int beside = k < longest_ ? k + 1 : k - 1;
    const S N = k + 1 == longest_ || k == longest_ ? N_ : in_order(beside).piece.tension,
            stretched = 1 + (contact.piece.tension + N) / (2 * properties_.EA);
    const std::array<S, 4> slides{t.x(), t.y(), 0, -stretched * t.dot(contact.tangent)};
    for (int i = 0; i < 4; ++i) {
      auto& row = front_[of(from + i)];
      row[gradient] -= rubs * slides[of(i)];
      for (int j = 0; j < 4; ++j) row[of(from + j)] += stiff * slides[of(i)] * slides[of(j)];
    }
  }

  /// Condenses a piece whose tip is that end of the front: then its root is.
  void stand(int k, int from) noexcept {
    Contact& contact = in_order(k);
    const Piece& piece = contact.piece;
    const bool is_left = from == 0;
    const Node& root = root_of(k);
    const S side = is_left ? S(1) : S(-1), l = length(k), stretch = piece.stretch, p = piece.at_root,
            q = piece.at_tip, N = piece.tension, alpha = l * p - root.theta;
    const Density D = density(k);
    energy_ += l * D.D;
    if (!properties_.shape)
      contact.wraps = contact.reach * (std::abs(D.q) / properties_.EI + std::abs(properties_.curvature));
    Record& record = records_[of(k)];
    record.side = side;

    // The way from root to tip is l h(ε, α), with derivatives.
    Vector h, by_stretch, by_turn, both_by, turn_twice;
    if constexpr (Turns) {
      const Vector e = direction(alpha), z(-e.y(), e.x());
      h = (1 + stretch) * e, by_stretch = e, by_turn = (1 + stretch) * z, both_by = z, turn_twice = -h;
    } else {
      h = Vector(1 + stretch - alpha * alpha / 2, alpha), by_stretch = Vector(1, 0),
      by_turn = Vector(-alpha, 1);
      both_by = Vector(0, 0), turn_twice = Vector(-1, 0);
    }
    // The tip is made of its deformations, its s, and u, w, θ, s of its root: what a row of its u, w, θ, s is by those.
    const Vector on = l * by_stretch * side, turn = l * by_turn * side, slides = h + l * p * by_turn;
    const S turns = side * (q - p);
    record.length = l, record.on = on, record.turn = turn, record.slides = slides, record.turns = turns;
    const auto by_parts = [&](const auto& u, const auto& w, const auto& theta,
                              const auto& s) HAPBEAM_INLINED {
      using Number = std::decay_t<decltype(u)>;
      const Number along = slides.x() * u + slides.y() * w + turns * theta,
                   by_root = theta - turn.x() * u - turn.y() * w;
      return std::array<Number, 8>{
          on.x() * u + on.y() * w, -l * by_root, l * theta, along + s, u, w, by_root, -along};
    };
    // TᵀFT of the front, and TᵀF of the rest: the upper triangle is right.
    std::array<Row, all> A;
    const std::size_t from_tip = of(from), from_other = of(state - from);
    std::array<Row, state> half{};
    for (std::size_t i = 0; i < state; ++i) {
      const auto& f = front_[from_tip + i];
      const auto row = by_parts(f[from_tip], f[from_tip + 1], f[from_tip + 2], f[from_tip + 3]);
      HAPBEAM_UNROLL
      for (std::size_t j = 0; j < made; ++j) half[i][j] = row[j];
      for (std::size_t c = 0; c < ends; ++c) half[i][made + c] = f[from_other + c];
      for (std::size_t c = 0; c <= Most; ++c) half[i][all + c] = f[both + c];
    }
    for (std::size_t j = 0; j < width; j += block) {
      const auto rows = by_parts(Block::load(&half[0][j]), Block::load(&half[1][j]), Block::load(&half[2][j]),
                                 Block::load(&half[3][j]));
      HAPBEAM_UNROLL
      for (std::size_t i = 0; i < made; ++i) rows[i].store(&A[i][j]);
    }
    for (std::size_t i = 0; i < ends; ++i) {
      const auto& f = front_[from_other + i];
      A[made + i].fill(0);
      for (std::size_t j = 0; j < ends; ++j) A[made + i][made + j] = f[from_other + j];
      for (std::size_t c = 0; c <= Most; ++c) A[made + i][all + c] = f[both + c];
    }
    // Its own energy, without N, and what its way bends the forces on the tip.
    const S lack = l * D.N, stiff = l * D.NN, inverse = 1 / stiff, missing = -lack * inverse;
    change_ += lack * missing / 2;
    const std::array<S, 4> row{l, l * D.pN, l * D.qN, l * D.Nl};
    record.tension = row, record.lack = lack, record.stiff = stiff;
    const Vector f = side * Vector(front_[from_tip][gradient], front_[from_tip + 1][gradient]);
    const S swings = f.dot(by_turn), g3 = l * f.dot(both_by), g4 = l * f.dot(turn_twice), sp = side * p;
    const auto own_of = [&](std::size_t i, std::size_t j) { return -row[i] * row[j] * inverse; };
    A[0][0] += own_of(0, 0), A[0][1] += own_of(0, 1) + g3 * l, A[0][2] += own_of(0, 2);
    A[1][1] += own_of(1, 1) + l * D.pp + g4 * l * l, A[1][2] += own_of(1, 2) + l * D.pq,
        A[2][2] += own_of(2, 2) + l * D.pp;
    // By s of the tip, and by s of its root, which takes it off.  What is not in balance is left out: its share of a length that changes is nothing that
    // deformations of a unit of length should make up for.
    const S es = side * (own_of(0, 3) - missing) + g3 * sp,
            ps = side * (own_of(1, 3) + l * (D.pl + swings) - D.pN * missing) + g4 * l * sp,
            qs = side * (own_of(2, 3) + l * D.ql - D.qN * missing),
            ss = own_of(3, 3) + 2 * D.l + l * D.ll + 2 * swings * p + g4 * p * p,
            st = -side * swings - g4 * sp, gs = side * (D.D + l * D.l + row[3] * missing);
    A[0][3] += es, A[1][3] += ps, A[2][3] += qs, A[3][3] += ss, A[3][6] += st;
    A[0][6] -= g3, A[1][6] -= g4 * l, A[6][6] += g4;
    A[0][last] += l * N + row[0] * missing, A[1][last] += l * D.p + row[1] * missing,
        A[2][last] += l * D.q + row[2] * missing, A[3][last] += gs;
    if constexpr (Most > 1)
      A[0][7] -= es, A[1][7] -= ps, A[2][7] -= qs, A[3][7] -= ss, A[6][7] -= st, A[7][7] += ss,
          A[7][last] -= gs;

    const auto eliminate = [&](auto number) {
      constexpr std::size_t u = number;
      const Row row_u = record.rows[u] = A[u];
      const S over = 1 / row_u[u];
      HAPBEAM_UNROLL
      for (std::size_t i = u + 1; i < all; ++i) {
        const Block factor(row_u[i] * over);
        HAPBEAM_UNROLL
        for (std::size_t j = i / block * block; j < width; j += block)
          (Block::load(&A[i][j]) - factor * Block::load(&row_u[j])).store(&A[i][j]);
      }
      for (std::size_t c = 0; c < Most; ++c) {
        const S factor = row_u[all + c] * over;
        residual_[c] -= factor * row_u[last];
        for (std::size_t d = c; d < Most; ++d) yields_[c][d] -= factor * row_u[all + d];
      }
      const S by = row_u[last] * row_u[last] * over;
      change_ -= by / 2;
      if (u < 3) longer_ += std::abs(by);
    };
    for_each_constant<0, 3>(eliminate);
    record.moves = record.waits = false;
    if constexpr (Turns) {
      // A force of the pieces along the beam, which exact ones would not have, is not to be taken for that of the contact, nor what is out of balance for what
      // that bends.  What friction jams keeps its row longer: between that and the foot it would go to and fro.
      const S theirs = A[3][last] + contact.force * contact.normal.dot(contact.tangent),
              most = contact.friction.isZero(0) ? S(0.05) : S(0.25);
      const bool told =
          std::abs(theirs) <= most * std::abs(contact.force) &&
          std::abs(change_) <= contact.force * contact.force * softest() &&
          std::abs(A[3][3]) > 64 * std::numeric_limits<S>::epsilon() *
                                  std::abs(front_[from_tip + 3][from_tip + 3]);  // little is left of it
      if (told) contact.sharp = A[3][3] * contact.force > contact.curvature * contact.force * contact.force;
      record.moves = told && contact.moves && !contact.waits && !contact.rests;
      record.waits = told && contact.moves && contact.waits && !contact.rests;
      if (record.waits) record.rows[3] = A[3];
      if (record.moves) {
        // Along a curve that is flatter than the circle the distance has a minimum; where it is as sharp it has none.
        const S least = std::sqrt(std::numeric_limits<S>::epsilon()) *
                        std::abs(contact.force / (contact.gap + contact.reach));
        if (std::abs(A[3][3]) < least) A[3][3] = std::copysign(least, A[3][3]);
        if (A[3][3] * contact.force > 0) turned_ += contact.force > 0 ? 1 : -1;
        eliminate(constant<3>);
      }
    }
    const auto place = [&](std::size_t i) { return i < made ? from_tip + i - own : from_other + i - made; };
    HAPBEAM_UNROLL
    for (std::size_t i = own; i < all; ++i) {
      for (std::size_t j = i; j < all; ++j) front_[place(i)][place(j)] = front_[place(j)][place(i)] = A[i][j];
      for (std::size_t c = 0; c <= Most; ++c) front_[place(i)][both + c] = A[i][all + c];
    }
  }

  /// What was condensed with a piece, and its tip.   @param x  increments of its root and of the other end of the front, from own on   @return that of its tip
  std::array<S, state> recover(int k, Row& x, const std::array<S, Most>& forces, S& longer) noexcept {
    const Record& record = records_[of(k)];
    Contact& contact = in_order(k);
    // A place is where λ n · t = 0.  A force that becomes a multiple of itself would take it as many times too far as n · t is not yet none.
    const int number = number_[of(k)];
    const S by = forces[of(number)], most = std::abs(contact.force),
            beyond = by - std::clamp(by, -most, most);
    const auto lacks = [&](int u) {
      const Row& row = record.rows[of(u)];
      return dot(row, x) - (u == 3 ? row[of(all + number)] * beyond : S(0));
    };
    for (int c = 0; c < Most; ++c) x[of(all + c)] = forces[of(c)];
    x[last] = 1;
    const S waiting = record.waits ? lacks(3) : S(0);
    for (int u = record.moves ? 3 : 2; u >= 0; --u) x[of(u)] = -lacks(u) / record.rows[of(u)][of(u)];
    S change = record.lack + record.tension[3] * record.side * (Most > 1 ? x[3] - x[own + 3] : x[3]);
    for (std::size_t i = 0; i < 3; ++i) change += record.tension[i] * x[i];
    const S step = -change / record.stiff;
    longer += record.lack * (2 * step + record.lack / record.stiff);
    Piece& piece = contact.piece;
    piece.stretch += x[0], piece.at_root += x[1], piece.at_tip += x[2], piece.tension += step;
    const S turned = x[own + 2] - record.length * x[1], along = Most > 1 ? x[3] - x[own + 3] : x[3];
    const Vector moved =
        Vector(x[own], x[own + 1]) + x[0] * record.on - turned * record.turn + along * record.slides;
    const std::array<S, state> tip{moved.x(), moved.y(), turned + record.length * x[2] + along * record.turns,
                                   x[3]};
    contact.moved += Vector(tip[0] - tip[3], tip[1]), contact.theta += tip[2];
    // Friction is told exactly where it is.
    contact.seen = !contact.rough;
    if constexpr (Turns) contact.seen = move_place(record, x[3], waiting, contact, longer) && contact.seen;
    if (contact.seen) this->see(contact, {contact.moved, contact.theta, chain_[of(k + 1)].s + x[3]});
    return tip;
  }
  /// The place of a contact goes as it was condensed.   @param by  so far [m]   @param waiting  the force along the beam that it lacks [N]
  /// @return whether it has
  bool move_place(const Record& record, S by, S waiting, Contact& contact, S& longer) const noexcept {
    const S l = nodes_[1].s - nodes_[0].s;
    // Beside a node it stays where it is held off that.
    const auto beside = [&](S s) {
      const S close_by = S(1.01) * shortest(true);
      return std::abs(s - nodes_[0].s) < close_by || std::abs(s - nodes_[1].s) < close_by;
    };
    S goes = std::clamp(by, -l, l), stiff = std::abs(record.rows[3][3]);
    if (contact.waits || contact.rests) {
      // The force along the beam that it lacks, as if that bent as sharply as the circle.
      if (record.waits) longer += waiting * waiting * contact.reach / std::abs(contact.force);
      contact.waits = false;
      return by == 0;
    }
    if (contact.moves && !record.moves) {
      // A force that is next to none says nothing of its place.  That is the foot of the centre.
      const Vector off(contact.moved.x() - (contact.centre.x() - contact.s),
                       contact.moved.y() - contact.centre.y());
      goes = std::clamp(S(-direction(S(-contact.theta)).dot(off)), -l, l),
      stiff = std::abs(contact.force) / off.norm();
    }
    if (contact.moves && !(beside(contact.s) && beside(contact.s + goes))) {
      longer += stiff * goes * goes;
      contact.s += goes;
      return goes == by;
    }
    return by == 0;
  }

  static S dot(const Row& a, const Row& b) noexcept {
    Block sum(0);
    for (std::size_t j = 0; j < width; j += block) sum += Block::load(&a[j]) * Block::load(&b[j]);
    S whole = sum[0];
    for (int i = 1; i < Block::size; ++i) whole += sum[i];
    return whole;
  }
  struct Bridge {
    std::array<S, both> by;
    S lack, stiff;
  };

  Front front_;
  Bridge bridge_;
  std::array<Record, Most> records_;
  std::array<std::array<S, Most>, Most> yields_;
  std::array<S, Most> residual_;
  std::array<Vector6<S>, Most> columns_;
  int turned_ = 0;
  S energy_ = 0, change_ = 0, longer_ = 0;
};

}  // namespace hapbeam::detail
