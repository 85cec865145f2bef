// SPDX-License-Identifier: MIT
// The nonlinear equations of one chain of elements, a beam in the plane or a rod in space: the chain, its ends, and what touches it.
//
//   ∂V/∂x = t f + contacts        unknown x: those of every node and element, force and place of every contact
//
// One Newton step assembles residual and tangent element by element, enters what the ends hold as known increments and contacts as rows
// (contact_rows.hpp), solves and adds.  The mesh stays; a contact is at any place of it.
// All that is alike in the plane and in space is here; what is not is the chain's: how elements are assembled and nodes move
// (beam_system.hpp, rod_system.hpp).
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <hapbeam/element/tensioned_curve.hpp>
#include <hapbeam/fem/contact/contact_rows.hpp>
#include <hapbeam/fem/mesh.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/internal_forces.hpp>

namespace hapbeam {

namespace detail {

template <class Chain>
using RowsOf = ContactRows<typename Chain::Element, typename Chain::Scalar, typename Chain::Assembler,
                           typename Chain::Friction, contacts_of<typename Chain::Element>>;

/// Of a chain before an increment [J].
template <typename Scalar>
struct ChainEnergies {
  Scalar strain;    ///< that of contacts, springs and inertia included
  Scalar work;      ///< of λ times the loads
  Scalar inner;     ///< of the increment that inner unknowns make on their own
  Scalar measured;  ///< what increments are measured by
};

/// A force F bends an element too sharply at the distance σ from its end where F max(by_place σ², least) is above 1.
template <typename Scalar>
struct SharpestBend {
  Scalar by_place;  ///< [1/(N·m²)]
  Scalar least;     ///< [1/N]
};

/// Calls f(e) for each element that is touched.
template <class Rows, class F>
void each_touched(const Rows& rows, F&& f) noexcept {
  for (int k = 0; k < Rows::most && k < rows.size(); ++k) {  // a compiler sees how few
    bool first = true;
    for (int j = 0; j < k; ++j) first = first && rows.element(j) != rows.element(k);
    if (first) f(rows.element(k));
  }
}

}  // namespace detail

/// @tparam ChainType  BeamChain | RodChain
template <class ChainType>
class ChainSystem {
  using Parts = typename ChainType::Parts;

 public:
  using Chain = ChainType;
  using Scalar = typename Chain::Scalar;
  using Body = typename Chain::Body;
  using Node = typename Chain::Node;
  using RoundContact = typename Chain::RoundContact;
  using Friction = typename Chain::Friction;
  using Rows = detail::RowsOf<ChainType>;
  using Contact = typename Rows::Contact;
  static constexpr int dimension = Rows::dimension, unknowns = Rows::unknowns;
  using Vector = VectorOf<Scalar, dimension>;
  using Increment = VectorOf<Scalar, unknowns>;
  using Line = Centreline<Scalar, dimension>;

  /// What changes as the chain moves.
  struct State {
    explicit State(int elements) : nodes(elements), inner(Parts::own_unknowns * elements) {}
    typename Parts::Nodes nodes;
    typename Parts::Inners inner;  ///< unknowns of each element: its tension [N], or its twist [rad]
  };

  /// @param number  of elements   @throws std::invalid_argument as the elements, and where the number does not fit the type
  ChainSystem(const Body& body, int number)
      : chain_(body, number),
        assembler_(number),
        rows_(number),
        saved_(number),
        length_(static_cast<Scalar>(body.length())),
        unit_(static_cast<Scalar>(std::sqrt(Chain::bending(body) / body.length()))) {
    if constexpr (dimension == 3) {
      no_mechanism_ = factor(0) == Status::ok;  // in its natural shape
      chain_.place_right(body);
    }
  }

  Chain& chain() noexcept { return chain_; }
  const Chain& chain() const noexcept { return chain_; }
  const Parts& parts() const noexcept { return chain_.parts(); }
  int elements() const noexcept { return parts().size(); }
  Scalar length() const noexcept { return length_; }
  const Node& node(int i) const noexcept { return parts().nodes()[i]; }
  Line centreline() const noexcept { return parts().view(parts().nodes()); }
  /// A view of another state of it.
  Line view(const State& state) const noexcept { return parts().view(state.nodes); }

  /// @param state  out, the present one
  void keep(State& state) const noexcept {
    state.nodes.set(parts().nodes());
    state.inner.set(parts().inners());
  }
  /// Sets the whole state, without a contact.
  void set_state(const State& state) noexcept { go_back(state, 0); }
  /// Places its nodes alone.   @param at  i -> node
  template <class At>
  void place(At&& at) noexcept {
    for (int i = 0; i <= elements(); ++i) nodes()[i] = at(i);
    chain_.ends().correct(nodes());
  }
  /// Back to an equilibrium that was left.  @param force  of its first contact [N]
  void go_back(const State& state, Scalar force) noexcept {
    set(state);
    rows_.let_go(force);
  }
  /// The state of the same system in another scalar, on the same mesh.
  template <class Other>
  void take_state(const Other& other) noexcept {
    for (int i = 0; i <= elements(); ++i) Chain::take_node(other.node(i), nodes()[i]);
    each_inner([&](int e) { inners()[e] = static_cast<Scalar>(other.parts().inners()[e]); });
    rows_.let_go(0);
  }
  /// The shape of the same body on another mesh, without a contact.
  void take_shape(const ChainSystem& other) noexcept {
    chain_.take_shape(other.chain_);
    rows_.let_go(0);
  }

  // The goal of a path: all of the dead loads, the ends where they are placed, and contacts.

  /// Without a contact.
  void set_goal() noexcept {
    rows_.clear();
    start_load_ = load_;
    chain_.ends().begin_path(nodes());
  }
  /// One contact more.   @param friction  null: none   @param stays  its place, until an equilibrium is found
  void add_goal(const Contact& goal, Friction* friction, bool stays = false) noexcept {
    rows_.add(goal, element_at(goal.s, goal.element()), friction, stays);
  }
  /// With a place that is held.   @param force  along its normal, about [N]
  void set_goal(const Push<Scalar, dimension>& place, Scalar force = 0) noexcept {
    Contact contact;
    const bool same = rows_.size() == 1 && rows_[0].kind == Contact::Kind::along && rows_[0].s == place.s;
    if (same) contact = rows_[0];
    contact.kind = Contact::Kind::along;
    contact.s = place.s, contact.normal = place.normal, contact.reach = place.d;
    // What an element of a rod yields by is found from its force: that of another place says nothing of it.
    contact.force = dimension == 2 || same ? force : Scalar(0);
    contact.moves = false;
    set_goal();
    add_goal(contact, nullptr);
  }
  /// The goal is the contacts of another mesh, each at its place and held along its force.
  void set_goal_of(const ChainSystem& other) noexcept {
    set_goal();
    for (int k = 0; k < other.rows_.size(); ++k) {
      const Vector force = other.contact_force(k);
      const Scalar size = std::sqrt(force.squaredNorm());
      Contact contact;
      contact.kind = Contact::Kind::along, contact.moves = false;
      contact.s = other.rows_[k].s, contact.force = size;
      contact.normal = size > 0 ? Vector(force / size) : other.rows_[k].normal;
      contact.reach = contact.normal.dot(other.rows_[k].displacement());
      add_goal(contact, nullptr);
    }
  }
  /// On the body [N].
  Vector contact_force(int k) const noexcept {
    const Contact& contact = rows_[k];
    const Scalar reaction = linear_reaction(k);
    return (contact.kind == Contact::Kind::round ? -reaction : reaction) * contact.normal + contact.friction;
  }
  /// Extrapolates from a state before, times a ratio.   @param before  out: the present state
  void go_on(State& before, Scalar ratio) noexcept {
    Chain::go_on(nodes(), before.nodes, ratio);
    each_inner([&](int e) {
      const Scalar now = inners()[e];
      inners()[e] += ratio * (now - std::exchange(before.inner[e], now));
    });
  }
  /// Extrapolates by the step between two states.  @param from  out: the present state less the step from there to `to`
  void carry(State& from, const State& to) const noexcept {
    for (int i = 0; i <= elements(); ++i) Chain::carry(node(i), from.nodes[i], to.nodes[i]);
    each_inner([&](int e) { from.inner[e] += parts().inners()[e] - to.inner[e]; });
  }
  /// Gives each element the tension that belongs to the displacements of its nodes.
  void find_tensions() noexcept { chain_.parts().find_tensions(); }

  /// n · (u, w) or n · r at s, of a state, of the mesh, and as it is drawn [m].
  Scalar displacement(const State& state, Scalar s, const Vector& normal) const noexcept {
    return normal.dot(Chain::displacement(view(state).at(s)));
  }
  Scalar displacement(Scalar s, const Vector& normal) const noexcept {
    return normal.dot(Chain::displacement(drawn().at(s)));
  }
  /// How far the curve lies beside drawn() at s [m].
  Vector beside_drawn(Scalar s) const noexcept {
    const Line line = drawn();
    return beside(line, line.segment_at(s), element_at(s), s).place;
  }
  /// Whether the element at s is too long for its tension, or for such a force beside an end.  @param s  [m]   @param force  [N]
  bool too_coarse(Scalar s, const Vector& force) const noexcept {
    if constexpr (dimension == 3)
      if (parts().overdrawn(element_at(s), s, force)) return true;
    return bent_beside_end(s, force.norm());
  }
  /// Whether a force in the element beside an end that is held bends it so sharply, at the distance σ, that it may be off by 1 % and more:  in the plane
  /// F max(σ², (2h)²)/(EI + N σ²/2) above 1, h being the thickness, in space F max(σ², r²)/(EI + N σ²/2) above 1/4.   @param s [m]   @param force [N]
  bool bent_beside_end(Scalar s, Scalar force) const noexcept {
    const int last = elements() - 1;
    const auto bent = [&](std::size_t k, int e, Scalar off) {
      if (!chain_.holds_end(k)) return false;
      const auto sharpest = chain_.sharpest(e);
      const Scalar square = off * off;
      return force * (std::max)(square * sharpest.by_place, sharpest.least) >
             1 + parts().stiffening(e) * square / 2;
    };
    return (s <= node(1).s && bent(0, 0, s)) || (s >= node(last).s && bent(1, last, length_ - s));
  }
  /// Where its middle is: a beam's across alone [m].
  auto middle() const noexcept { return Chain::middle(centreline().at(length_ / 2)); }
  /// Whether an element has turned further in itself than its kinematics allows, and not so at rest.
  bool folded(const State& rest) const noexcept {
    for (int e = 0; e < elements(); ++e)
      if (Chain::folds(node(e), node(e + 1)) && !Chain::folds(rest.nodes[e], rest.nodes[e + 1])) return true;
    return false;
  }
  /// Contacts as they are, after look().
  const Rows& rows() const noexcept { return rows_; }
  /// To be called where the beam has moved.
  void look(int k) noexcept { look_in(rows_.element(k)); }
  void look_at_friction(int k) noexcept {
    look(k);
    rows_.friction(k)->look(rows_[k]);
  }
  /// To be called in an equilibrium where they have stayed.   @return whether the places of contacts are those of another one
  bool places_go_on() noexcept {
    if constexpr (dimension == 2) return false;
    else return rows_.go_on_to_tangent([this](Scalar s, int e) { return element_at(s, e); }, length_);
  }
  /// Of no contact any more.
  void forget_friction() noexcept { rows_.forget_friction(); }
  /// As of ContactRows [N].
  Scalar linear_reaction(int k = 0) const noexcept { return rows_.reached(k); }
  /// V - λ f · x after the last iterate(), friction's included, to third order of its increment [J].
  Scalar foreseen_potential() const noexcept { return foreseen_potential_; }

  // Required by NewtonRaphson.

  static constexpr bool in_pairs = Parts::has_tensions;

  void set_target(Scalar t) noexcept {
    load_ = t < 1 ? start_load_ + t * (1 - start_load_) : Scalar(1);
    rows_.aim(t, [this](int k) { look(k); });
    chain_.ends().set_target(t);
    set_turning(1);
    last_size_ = std::numeric_limits<Scalar>::infinity();
  }
  void save() noexcept {
    keep(saved_);
    rows_.save();
    saved_load_ = load_;
  }
  void restore() noexcept {
    set(saved_);
    rows_.restore();
    load_ = saved_load_;
  }
  Scalar size() const noexcept { return weight_; }
  /// Strain energy before the last increment, at least that of a bend by 10⁻⁴ rad, below which no snap is detected [J].
  Scalar strain() const noexcept { return (size_ * size_ + Scalar(1e-8) * unit_ * unit_) / 2; }
  Scalar unit() const noexcept { return unit_; }
  Scalar round_off() const noexcept { return chain_.round_off(size_); }

  Iteration<Scalar> iterate() noexcept {
    const Status status = factor(0);
    if (status != Status::ok) return {status, 0};
    rows_.feel();
    const Scalar change = rows_.any() ? rows_.foreseen_change() : -assembler_.energy() / 2;
    foreseen_potential_ = potential_ - inner_energy_ / 2 + change;
    weight_ = rows_.weight(size_);
    advance();
    const Scalar size = increment();
    // Where the last increment has blown the state up, this one is small beside it.
    set_turning(size < near_ * (std::min)(size_, last_size_) ? Scalar(0) : Scalar(1));
    last_size_ = size_;
    return {status, size};
  }

  // Required by Descent, in addition: the two halves of an iteration.

  /// Assembles and solves for an increment, and leaves the state as it is.
  /// @param shift  what is added to the tangent: so many times EI/L³ on each displacement and EI/L on each rotation,
  ///               shared out over the nodes
  /// @return ok | singular | non_finite | iteration_limit, where an end has farther to turn than an increment leads
  Status factor(Scalar shift) noexcept;
  /// What a shift adds to a tangent: to each node the share of half the elements beside it.
  template <class Assembler>
  void add_shift(Scalar shift, Assembler& to) const noexcept {
    for (int i = 0; i <= elements(); ++i) {
      const Scalar length = node((std::min)(i + 1, elements())).s - node((std::max)(i - 1, 0)).s,
                   share = shift * unit_ * unit_ * length / (2 * length_);
      Increment diagonal = Increment::Constant(share);
      diagonal.template head<dimension>() /= length_ * length_;
      to.add_at(i, Eigen::Matrix<Scalar, unknowns, unknowns>(diagonal.asDiagonal()), Increment::Zero());
    }
  }
  /// A descent begins: without the forces of before.
  void forget_force() noexcept { rows_.fall(); }
  /// Adds the increment to the state.
  void advance() noexcept;
  /// As a shift: a stiffness that is none.
  static constexpr Scalar neutral() noexcept { return Chain::neutral(); }
  /// Size of the last increment in the norm of the tangent [√J].
  Scalar increment() const noexcept {
    return std::sqrt(std::abs((rows_.any() ? rows_.energy() : assembler_.energy()) + longer_) +
                     std::abs(inner_energy_));
  }
  /// V - λ f · x before the last increment was added [J].
  Scalar potential() const noexcept { return potential_; }
  /// How many unstable directions the tangent of the last increment has.
  int negative_pivots() const noexcept {
    return rows_.any() ? rows_.negative_pivots() : assembler_.negative_pivots();
  }
  /// Bends it a little off an unstable equilibrium, without a contact to where its loads push.  @param size  [m]
  void nudge(Scalar size) noexcept { chain_.nudge(size, rows_.any() ? rows_[0].s : Scalar(-1), load_); }

  // Required by LoadPath, in addition.

  /// Largest rotation of a node in the last increment [rad].
  Scalar turn() const noexcept {
    Scalar largest = 0;
    for (int i = 0; i <= elements(); ++i) largest = (std::max)(largest, Chain::turn(node(i), increment(i)));
    return largest;
  }

  /// Of node i after factor(), displacements [m] and rotations [rad].
  Increment increment(int i) const noexcept { return chain_.increment(assembler_, i); }
  /// Adds to the state.  @param change  i -> increment of node i
  template <class Change>
  void move(Change&& change) noexcept {
    longer_ = chain_.move(change);
  }

  /// What holds an end.   @param k  0: left, 1: right   @param motion  what a chain takes of one in motion
  template <class... Motion>
  auto reaction(std::size_t k, const Motion*... motion) const noexcept {
    return chain_.reaction(k, load_, rows_, motion...);
  }
  /// Strain energy, that of the springs that hold it included [J].
  Scalar strain_energy() const noexcept {
    Scalar energy = chain_.strain_energy([this](int e) { return rows_.in(e); });
    detail::each_touched(rows_, [&](int e) {
      energy += rows_.as_touched(parts(), e, [](auto& touched) { return touched.strain_energy(); });
    });
    return energy;
  }
  /// V - λ f · x as it lies now [J].
  Scalar total_potential() const noexcept { return strain_energy() - parts().work(load_); }
  /// What the section at s carries, in a piece of drawn(), which holds s.   @param thickness [m]
  InternalForces<Scalar, dimension> internal_forces(int piece, Scalar s, Scalar thickness) const noexcept {
    int e = drawn_.element_of(piece);
    // Where a contact was drawn instead of a node.
    if (e > 0 && s < node(e).s) --e;
    else if (e + 1 < elements() && s > node(e + 1).s) ++e;
    const Scalar from = node(e).s, to = node(e + 1).s, at = (std::min)((std::max)(s, from), to);
    return chain_.internal_forces(rows_, e,
                                  {from, to, at, e + 1 == elements(), at == from || at == drawn_[piece].s},
                                  load_, thickness, [this, line = drawn(), e](Scalar x) {
                                    const int in = line.segment_at(x);
                                    Node there = line.node_at(in, x);
                                    const Beside by = beside(line, in, e, x);
                                    Chain::bend(there, by.place, by.slope);
                                    return there;
                                  });
  }

  // What is seen: the mesh, and in it the places of contacts.

  /// To be called where the beam has moved.
  void draw() noexcept {
    detail::each_touched(rows_, [this](int e) { look_in(e); });
    drawn_.draw(
        elements(), [this](int i) -> const Node& { return node(i); }, rows_.size(),
        [this](int k) { return std::pair(rows_.element(k), rows_[k].s); }, [this](int k) { return mark(k); },
        [this](int e, Scalar s) {
          Node node = chain_.node_within(e, s);
          const Beside by = beside(centreline(), e, e, s);
          Chain::bend(node, by.place, by.slope);
          return node;
        });
  }
  Line drawn() const noexcept { return parts().view(drawn_); }

 protected:
  Scalar load_ = 0;  // of the dead loads

 private:
  typename Parts::Nodes& nodes() noexcept { return chain_.parts().nodes(); }
  typename Parts::Inners& inners() noexcept { return chain_.parts().inners(); }
  void set(const State& state) noexcept {
    nodes().set(state.nodes);
    inners().set(state.inner);
  }
  template <class F>
  void each_inner(F&& f) const noexcept {
    for (int e = 0; e < Parts::own_unknowns * elements(); ++e) f(e);
  }
  void look_in(int e) noexcept {
    rows_.look(parts(), e, [&]([[maybe_unused]] Scalar tension) {
      if constexpr (dimension == 2) chain_.parts().set_tension(e, tension);
    });
  }
  void set_turning([[maybe_unused]] Scalar share) noexcept {
    if constexpr (dimension == 2) chain_.parts().set_turning(share);
  }
  int element_at(Scalar s) const noexcept { return centreline().segment_at(s); }
  /// How far the curve, which its tension straightens, lies beside a piece of a line in an element, and how much steeper it is.
  struct Beside {
    Vector place = Vector::Zero(), slope = Vector::Zero();
  };
  Beside beside(const Line& line, int piece, int e, Scalar s) const noexcept {
    using Curve = detail::TensionedCurve<Scalar>;
    Beside by;
    const Scalar n = parts().stiffening(e);
    if (!(n > 0)) return by;
    const Scalar from = line[piece].s, l = line[piece + 1].s - from;
    const auto control = line.segment(piece);
    // Of its ends' slopes against the chord, with tension and without.
    const Scalar at = (s - from) / l;
    for (int k = 0; k < dimension; ++k) {
      const Scalar chord = control(k, 3) - control(k, 0), a = chord - 3 * (control(k, 1) - control(k, 0)),
                   b = chord - 3 * (control(k, 3) - control(k, 2)), m = (a - b) / 2, p = (a + b) / 2;
      const auto taut = Curve(n * l * l, 0, m, p).at(at), slack = Curve(0, 0, m, p).at(at);
      by.place[k] = taut.rise - slack.rise, by.slope[k] = (taut.slope - slack.slope) / l;
    }
    return by;
  }
  /// That of before where it holds s, or nearly: a contact that goes to and fro over a node stays in one element.
  int element_at(Scalar s, int before) const noexcept {
    const Scalar from = node(before).s, to = node(before + 1).s, over = (to - from) / 10000;
    return from - over <= s && s <= to + over ? before : element_at(s);
  }
  /// A node of drawn() at a contact: on what touches it, where an equilibrium was found.
  Node mark(int k) const noexcept {
    const Contact& contact = rows_[k];
    const Scalar off = contact.gap - contact.ahead + contact.force * contact.compliance,
                 left = std::abs(off) < length_ / 1000 ? off : Scalar(0);
    return chain_.mark(rows_.element(k), contact, Vector(left * contact.normal));
  }
  Chain chain_;
  typename Chain::Assembler assembler_;
  Rows rows_;
  State saved_;
  Scalar length_, unit_;
  static constexpr Scalar near_ = Scalar(0.05);  // to an equilibrium: an increment in units of the state
  Scalar size_ = 0, last_size_ = 0, weight_ = 0, potential_ = 0, inner_energy_ = 0, longer_ = 0,
         foreseen_potential_ = 0;
  Scalar saved_load_ = 0, start_load_ = 0;
  bool no_mechanism_ = false;  // its ends and springs hold it
  typename Chain::Drawn drawn_{elements()};
};

// Outside of the class: only so does "extern template class ChainSystem<…>;" keep a compiler from them.
template <class Chain>
Status ChainSystem<Chain>::factor(Scalar shift) noexcept {
  if (!chain_.ends().follow(nodes())) return Status::iteration_limit;
  const detail::ChainEnergies<Scalar> energies = chain_.assemble(load_, rows_, assembler_);
  if (shift != 0) add_shift(shift, assembler_);
  inner_energy_ = energies.inner, longer_ = 0;
  weight_ = size_ = std::sqrt(2 * (energies.measured + rows_.held()));
  potential_ = energies.strain - energies.work;
  if (rows_.any()) potential_ += rows_.potential() + rows_.friction_potential();
  chain_.ends().hold(nodes(), rows_, assembler_);
  const Status status = rows_.any() ? rows_.solve(assembler_) : assembler_.solve();
  // A round rod that is bowed between two ends on one axis may roll about it, without force.
  if (status == Status::singular && shift == 0 && no_mechanism_) return factor(neutral());
  return status;
}

template <class Chain>
void ChainSystem<Chain>::advance() noexcept {
  longer_ = chain_.advance(assembler_, rows_, [this](Scalar s, int e) { return element_at(s, e); });
}

}  // namespace hapbeam
