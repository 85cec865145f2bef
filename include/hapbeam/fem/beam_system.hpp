// SPDX-License-Identifier: MIT
// The nonlinear equations of one beam: its elements, its supports, and what touches it.
//
//   ∂V/∂x = t f + contacts        unknown x: u, w, θ of every node, N of every element, force and place of every contact
//
// One Newton step assembles residual and tangent element by element, enters supports as known increments and contacts as rows
// (contact_rows.hpp), solves and adds.  The mesh stays; a contact is at any place of it.
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <hapbeam/beam.hpp>
#include <hapbeam/fem/beam_shape.hpp>
#include <hapbeam/fem/chain.hpp>
#include <hapbeam/fem/contact/contact_friction.hpp>
#include <hapbeam/fem/contact/contact_rows.hpp>
#include <hapbeam/fem/contact/drawn_mesh.hpp>
#include <hapbeam/fem/contact/round_contact.hpp>
#include <hapbeam/fem/contact/system_contacts.hpp>
#include <hapbeam/fem/dynamics/inertia.hpp>
#include <hapbeam/fem/press_range.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/fem/starting_shapes.hpp>
#include <hapbeam/fem/supports.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements>
class BeamSystem
    : public detail::BeamShape<Element, ScalarType, Elements, MaxElements>,
      public detail::SystemContacts<
          BeamSystem<Element, ScalarType, Elements, MaxElements>, ScalarType,
          detail::ContactFriction<ScalarType, 2, detail::RoundContact>,
          detail::ContactRows<
              Element, ScalarType, detail::AssemblerOf<Element, ScalarType, Elements, MaxElements>,
              detail::ContactFriction<ScalarType, 2, detail::RoundContact>, contacts_of<Element>>> {
  using Shape = detail::BeamShape<Element, ScalarType, Elements, MaxElements>;
  using Contacts = typename BeamSystem::SystemContacts;
  using Assembler = detail::AssemblerOf<Element, ScalarType, Elements, MaxElements>;

 public:
  using Scalar = ScalarType;
  using typename Shape::Node;
  using typename Shape::State;
  using RoundContact = detail::RoundContact<Scalar>;
  using Friction = detail::ContactFriction<Scalar, 2, detail::RoundContact>;
  using Shape::elements;
  using Shape::node;
  using typename Contacts::Contact;
  using typename Contacts::Rows;

  /// @param number  of elements
  /// @throws std::invalid_argument where a load is not finite somewhere on the beam, or the number does not fit the type
  BeamSystem(const Beam& beam, int number)
      : Shape(beam, number),
        Contacts(number),
        assembler_(number),
        before_(number),
        ends_{detail::EndSupport<Scalar>(beam.left(), beam.left_place()),
              detail::EndSupport<Scalar>(beam.right(), beam.right_place())},
        unit_(static_cast<Scalar>(std::sqrt(beam.bending_stiffness() / beam.length()))) {
    const NaturalShape<Scalar>& natural = beam_.natural_shape();
    const auto stand = [&](Scalar side) {
      detail::lay(natural, ends_[0], ends_[1], beam_.nodes());
      if (natural.straight()) detail::bow(ends_[0], ends_[1], side, beam_.nodes());
      return beam_.work(1);
    };
    const Scalar down = stand(-1), up = stand(1);
    if (detail::push_down(up, down)) stand(-1);
    Shape::find_tensions();
    for (int e = 0; e < number; ++e) {
      const ElementProperties<Scalar>& p = beam_.properties()[e];
      stiffness_ += p.axial_per_length + 12 * p.bending_per_length3;
    }
  }

  using Inertia = detail::Inertia<Scalar, Elements, MaxElements>;
  /// Of what it is in motion with; null: at rest.
  void move_with(const Inertia* inertia) noexcept { inertia_ = inertia; }
  /// To be called where the beam has moved.
  void look(int k) noexcept {
    const int e = rows_.element(k);
    rows_.look(beam_, e, [&](Scalar N) { beam_.set_tension(e, N); });
  }
  /// Sets the whole state, without a contact.
  void set_state(const State& state) noexcept { go_back(state, 0); }
  /// Back to an equilibrium that was left.  @param force  of its first contact [N]
  void go_back(const State& state, Scalar force) noexcept {
    Shape::set(state);
    Contacts::let_go(force);
  }
  /// The state of the same system in another scalar.
  template <class Other>
  void take_state(const Other& other) noexcept {
    Shape::take(other);
    Contacts::let_go(0);
  }

  // Required by NewtonRaphson.

  static constexpr bool in_pairs = Shape::Parts::has_tensions;

  void set_target(Scalar t) noexcept {
    Contacts::aim(t);
    for (auto& end : ends_) end.set_target(t);
    beam_.set_turning(1);
    last_size_ = std::numeric_limits<Scalar>::infinity();
  }
  void save() noexcept {
    this->keep(saved_);
    Contacts::save_contacts();
  }
  void restore() noexcept {
    Shape::take_back();
    Contacts::restore_contacts();
  }
  Scalar size() const noexcept { return weight_; }
  /// Strain energy before the last increment, at least that of a bend by 10⁻⁴ rad, of which no snap is told [J].
  Scalar strain() const noexcept { return (size_ * size_ + Scalar(1e-8) * unit_ * unit_) / 2; }
  Scalar unit() const noexcept { return unit_; }
  /// Of a beam without stress, of which nothing is left but what the round-off of displacements stretches and bends its elements by [√J].
  Scalar round_off() const noexcept {
    const int n = elements();
    const auto moved = [this](int i) { return std::abs(node(i).u) + std::abs(node(i).w); };
    const Scalar off = std::numeric_limits<Scalar>::epsilon() * (moved(0) + moved(n / 2) + moved(n)),
                 energy = stiffness_ * off * off;
    return 16 * size_ * size_ <= energy ? std::sqrt(energy) : Scalar(0);
  }

  Iteration<Scalar> iterate() noexcept {
    const Status status = factor(0);
    if (status != Status::ok) return {status, 0};
    Contacts::feel(potential_, assembler_.energy());
    weight_ = Contacts::weight(size_);
    advance();
    const Scalar size = increment();
    // Where the last increment has blown the state up, this one is small beside it.
    beam_.set_turning(size < near_ * (std::min)(size_, last_size_) ? Scalar(0) : Scalar(1));
    last_size_ = size_;
    return {status, size};
  }

  // Required by Descent, in addition: the two halves of an iteration.

  /// Assembles and solves for an increment, and leaves the state as it is.
  /// @param shift  what is added to the tangent: so many times EI/L³ on each displacement and EI/L on each rotation,
  ///               shared out over the nodes   @return ok | singular | non_finite
  Status factor(Scalar shift) noexcept {
    Scalar energy = 0, work = 0;
    // What most elements need takes no address of their tangent: it stays in registers.
    typename Shape::Parts::Group group;
    const auto add = [&](int e, auto&& change) {
      Matrix6<Scalar> K;
      Vector6<Scalar> r;
      energy += beam_.tangent(e, group, r, K);
      change(r, K);
      assembler_.add(e, K, r);
    };
    const bool plain = shift == 0 && !beam_.loaded(load_) && !inertia_;
    for (int e = 0; e < elements(); ++e) {
      beam_.respond(e, group);
      const auto load_and_shift = [&](Vector6<Scalar>& r, Matrix6<Scalar>& K) {
        work += beam_.subtract_loads(e, load_, r, K);
        if (shift != 0) add_shift(shift, e, K);
        if (inertia_) energy += inertia_->add(e, node(e), node(e + 1), r, K);
      };
      if (rows_.in(e)) {
        Matrix6<Scalar> K;
        Vector6<Scalar> r;
        energy += rows_.touch(beam_, e, r, K);
        if (!plain) load_and_shift(r, K);
        assembler_.add(e, K, r);
      } else if (plain) {
        add(e, [](auto&, auto&) {});
      } else {
        add(e, load_and_shift);
      }
    }
    longer_ = 0;
    // Where tensions are far from those of the nodes the energy has either sign.
    weight_ = size_ = std::sqrt(2 * (std::abs(energy) + (inertia_ ? inertia_->scale() : Scalar(0))));
    potential_ = energy - work;
    if (rows_.any()) potential_ += rows_.potential() + rows_.friction_potential();
    for (std::size_t k = 0; k < 2; ++k)
      ends_[k].visit(node(end(k)), [&](int component, Scalar now, Scalar target) {
        rows_.prescribe(end(k), component, target - now);
        assembler_.prescribe(end(k), component, target - now);
      });
    return rows_.any() ? rows_.solve(assembler_) : assembler_.solve();
  }
  /// On the way down the forces of before are no longer there.
  void forget_force() noexcept { rows_.fall(); }
  /// Adds the increment to the state.
  void advance() noexcept {
    if constexpr (any_rotation<Element>) {
      if (!rows_.any() && !inertia_) {
        // Prescribed increments answer 0; a chain that ended where they were would share them out a second time.
        const auto with_ends = [this](int i) {
          Vector3<Scalar> x = increment(i);
          for (std::size_t k = 0; k < 2; ++k)
            if (i == end(k))
              ends_[k].visit(node(i),
                             [&x](int component, Scalar now, Scalar target) { x[component] = target - now; });
          return x;
        };
        longer_ = beam_.follow(with_ends, [](int) { return false; });
        detail::lay_chain<Element, Scalar>(beam_.nodes(), beam_.properties(), beam_.tensions(), with_ends);
        detail::close_chain(beam_.nodes(), ends_[0], ends_[1]);
        return place_ends();
      }
    }
    move([this](int i) { return increment(i); });
    longer_ += rows_.advance(
        [this](int e) {
          const Node &a = before_[e], &b = before_[e + 1];
          return Vector6<Scalar>(beam_.displacements(e) -
                                 Vector6<Scalar>(a.u, a.w, a.theta, b.u, b.w, b.theta));
        },
        [this](int e, Scalar N) { beam_.set_tension(e, N); },
        [this](Scalar s, int e) { return element_at(s, e); });
  }
  /// As a shift: a stiffness that is none.
  static constexpr Scalar neutral() noexcept { return 0; }
  /// Size of the last increment in the norm of the tangent [√J].
  Scalar increment() const noexcept {
    return std::sqrt(std::abs((rows_.any() ? rows_.energy() : assembler_.energy()) + longer_));
  }
  /// V - λ f · x before the last increment was added [J].
  Scalar potential() const noexcept { return potential_; }
  /// How many directions there are along which the tangent of the last increment is not stiff but gives way.
  int negative_pivots() const noexcept {
    return rows_.any() ? rows_.negative_pivots() : assembler_.negative_pivots();
  }
  /// Bends the beam a little where nothing makes it leave an equilibrium, without a contact to where its loads push.  @param size  [m]
  void nudge(Scalar size) noexcept {
    const Scalar contact = rows_.any() ? rows_[0].s : Scalar(-1);
    const auto move = [&](Scalar by) { detail::nudge(beam_.nodes(), contact, by); };
    if (contact < 0 && beam_.loaded(load_)) {
      move(size);
      const Scalar up = beam_.work(load_);
      move(-2 * size);
      const Scalar down = beam_.work(load_);
      move(size);
      if (detail::push_down(up, down)) size = -size;
    }
    move(size);
  }

  // Required by LoadPath, in addition.

  /// Largest rotation of a node in the last increment [rad].
  Scalar turn() const noexcept {
    Scalar largest = 0;
    for (int i = 0; i <= elements(); ++i) largest = (std::max)(largest, std::abs(increment(i)[2]));
    return largest;
  }

  /// Of node i after factor() [u, w, θ].
  Vector3<Scalar> increment(int i) const noexcept { return assembler_.increment(i); }
  /// Adds to the state.  @param change  i -> [u, w, θ]
  template <class Change>
  void move(Change&& change) noexcept {
    for (int i = 0; i <= elements(); ++i) {
      const Vector3<Scalar> x = change(i);
      Node& to = beam_.nodes()[i];
      before_[i] = to;
      to.u += x[0];
      to.w += x[1];
      to.theta += x[2];
    }
    place_ends();
    longer_ = beam_.follow(
        [this](int i) {
          const Node &now = node(i), &then = before_[i];
          return Vector3<Scalar>(now.u - then.u, now.w - then.w, now.theta - then.theta);
        },
        [this](int e) { return rows_.in(e); });
  }

  /// Strain energy [J].
  Scalar strain_energy() const noexcept {
    Scalar sum = 0;
    for (int e = 0; e < elements(); ++e)
      sum += rows_.in(e) ? rows_.strain_energy(beam_, e) : beam_.strain_energy(e);
    return sum;
  }
  /// V - λ f · x as it lies now [J].
  Scalar total_potential() const noexcept { return strain_energy() - beam_.work(load_); }
  /// What the section at s carries, in a piece of drawn(), which holds s.   @param thickness [m]
  InternalForces<Scalar> internal_forces(int piece, Scalar s, Scalar thickness) const noexcept {
    int e = drawn_.element_of(piece);
    // Where a contact was drawn instead of a node.
    if (e > 0 && s < node(e).s) --e;
    else if (e + 1 < elements() && s > node(e + 1).s) ++e;
    if (!rows_.in(e)) return beam_.internal_forces(e, s, load_, thickness);
    // As it lies, with what touches it.
    typename Rows::Touched touched(beam_, e);
    std::array<Contact, Rows::most> contacts;
    std::array<PointForce<Scalar>, Rows::most> forces;
    int count = 0;
    for (int k = 0; k < rows_.size(); ++k)
      if (rows_.element(k) == e) touched.add(contacts[at(k)] = rows_[k], k);
    Vector6<Scalar> r;
    Matrix6<Scalar> K;
    (void)touched.condense(r, K, [](int) {});
    for (int k = 0; k < rows_.size(); ++k) {
      if (rows_.element(k) != e) continue;
      const Contact& contact = contacts[at(k)];
      const Vector2<Scalar> force = contact.force * contact.normal + contact.friction;
      forces[at(count)] = {contact.s, force.x(), force.y(), 0, 0, 0};
      if constexpr (Rows::most > 1)
        for (int i = count; i > 0 && forces[at(i)].s < forces[at(i - 1)].s; --i)
          std::swap(forces[at(i)], forces[at(i - 1)]);
      ++count;
    }
    (void)beam_.subtract_loads(e, load_, r);
    return beam_.internal_forces(
        e, drawn_[piece].s, s, load_, thickness, r, [this](Scalar x) { return drawn().at(x); }, forces.data(),
        count);
  }

  // What is seen: the mesh, and in it the places of contacts.

  /// To be called where the beam has moved.
  void draw() noexcept {
    drawn_.draw(
        elements(), [this](int i) -> const Node& { return node(i); },
        [this](Scalar s) { return element_at(s); }, rows_.size(), [this](int k) { return rows_[k].s; },
        [this](int k) { return mark(k); },
        [this](int e, Scalar s) {
          const Node &a = node(e), &b = node(e + 1);
          const bool straight = a.theta == 0 && b.theta == 0 && a.u == b.u && a.w == b.w;
          const Displacement<Scalar> there =
              straight ? Displacement<Scalar>{a.u, a.w, 0} : this->centreline().at(e, s);
          return Node{s, there.u, there.w, there.theta};
        });
  }
  Centreline<Scalar> drawn() const noexcept { return {drawn_.data(), drawn_.size(), any_rotation<Element>}; }
  /// n · (u, w) of it at s [m].
  using Shape::displacement;
  Scalar displacement(Scalar s, const Vector2<Scalar>& normal) const noexcept {
    return Shape::displacement_of(drawn(), s, normal);
  }

 protected:
  using Contacts::load_;

 private:
  friend Contacts;
  using Contacts::rows_;
  using Shape::beam_;
  using Shape::length_;
  using Shape::saved_;
  static constexpr std::size_t at(int k) noexcept { return static_cast<std::size_t>(k); }
  int end(std::size_t k) const noexcept { return k == 0 ? 0 : elements(); }
  void begin_path() noexcept {
    for (std::size_t k = 0; k < 2; ++k) ends_[k].begin(node(end(k)));
  }

  int element_at(Scalar s) const noexcept { return this->centreline().segment_at(s); }
  /// That of before where it holds s, or nearly: a contact that goes to and fro over a node stays in one.  Where a body bends the beam by a radian within
  /// an element, those on both sides of a node put the contact up to a hundredth of it apart.
  int element_at(Scalar s, int before) const noexcept {
    const Scalar from = node(before).s, to = node(before + 1).s, over = (to - from) / 100;
    return from - over <= s && s <= to + over ? before : element_at(s);
  }
  /// A node of drawn() where a contact is.
  Node mark(int k) noexcept {
    look(k);
    const Contact& contact = rows_[k];
    // On what touches it, where an equilibrium was found: the last increment has left that by its square.
    const Scalar off = contact.gap + contact.force * contact.compliance,
                 left = std::abs(off) < length_ / 1000 ? off : Scalar(0);
    const Vector2<Scalar> moved = contact.moved - left * contact.normal;
    return {contact.s, moved.x(), moved.y(), contact.theta};
  }

  /// Puts the ends exactly where they belong.
  void place_ends() noexcept {
    for (std::size_t k = 0; k < 2; ++k)
      ends_[k].visit(beam_.nodes()[end(k)], [](int, Scalar& now, Scalar target) { now = target; });
  }

  /// An element's share of the shift, half of it to either node.
  void add_shift(Scalar shift, int e, Matrix6<Scalar>& K) const noexcept {
    const Scalar share = shift * unit_ * unit_ * (node(e + 1).s - node(e).s) / (2 * length_),
                 across = share / (length_ * length_);
    for (const int k : {0, 3}) {
      K(k, k) += across;
      K(k + 1, k + 1) += across;
      K(k + 2, k + 2) += share;
    }
  }

  Assembler assembler_;
  typename Shape::Nodes before_;      // the last increment
  const Inertia* inertia_ = nullptr;  // of what it is in motion with
  std::array<detail::EndSupport<Scalar>, 2> ends_;
  static constexpr Scalar near_ = Scalar(0.05);  // to an equilibrium: an increment in units of the state
  Scalar size_ = 0, last_size_ = 0, weight_ = 0, longer_ = 0, potential_ = 0, unit_;
  Scalar stiffness_ = 0;  // of all elements, along and across [N/m]
  detail::DrawnMesh<Node, Elements, MaxElements, contacts_of<Element>> drawn_{elements()};
};

namespace detail {

/// What a model is made of that has such an element.  Elements in space have theirs in rod_system.hpp.
template <class Element, typename = void>
struct SystemOf {
  static_assert(dimension_of<Element> == 2, "#include <hapbeam/fem/rod_system.hpp> for elements in space");
  using Body = Beam;
  template <typename Scalar, int Elements, int MaxElements>
  using System = BeamSystem<Element, Scalar, Elements, MaxElements>;
  template <typename Scalar>
  using Range = PressRange<Element, Scalar>;
};

}  // namespace detail

}  // namespace hapbeam
