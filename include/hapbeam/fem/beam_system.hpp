// The nonlinear equations of one beam: its elements, its supports, and one prescribed contact displacement.
//
//   ∂V/∂x = λ f,   n · (u, w)(contact) = d        unknown x: u, w, θ of every node
//
// One Newton step assembles residual and tangent element by element, enters supports and contact as known
// increments, solves and adds.
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <hapbeam/beam.hpp>
#include <hapbeam/fem/beam_shape.hpp>
#include <hapbeam/fem/chain.hpp>
#include <hapbeam/fem/contact_friction.hpp>
#include <hapbeam/fem/contact_point.hpp>
#include <hapbeam/fem/press_range.hpp>
#include <hapbeam/fem/round_contact.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/fem/starting_shapes.hpp>
#include <hapbeam/fem/supports.hpp>
#include <hapbeam/fem/system_contacts.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements>
class BeamSystem
    : public detail::BeamShape<Element, ScalarType, Elements, MaxElements>,
      public detail::SystemContacts<
          BeamSystem<Element, ScalarType, Elements, MaxElements>, ScalarType,
          detail::ContactPoint<ScalarType, any_rotation<Element>>, Vector2<ScalarType>,
          detail::CircleOnCurve<ScalarType>, detail::ContactFriction<ScalarType, 2, detail::RoundContact>,
          typename detail::AssemblerOf<Element, ScalarType, Elements, MaxElements>::HeldRow,
          contacts_of<Element> - 1> {
  using Contacts = typename BeamSystem::SystemContacts;
  using Shape = detail::BeamShape<Element, ScalarType, Elements, MaxElements>;

 public:
  using Scalar = ScalarType;
  using typename Shape::Node;
  using Friction = detail::ContactFriction<Scalar, 2, detail::RoundContact>;
  using Shape::elements;
  using Shape::node;

  /// @param number  of elements
  /// @throws std::invalid_argument where a load is not finite somewhere on the beam, or the number does not fit the type
  BeamSystem(const Beam& beam, int number)
      : Shape(beam, number),
        assembler_(number),
        ends_{detail::EndSupport<Scalar>(beam.left(), beam.left_place()),
              detail::EndSupport<Scalar>(beam.right(), beam.right_place())},
        unit_(static_cast<Scalar>(std::sqrt(beam.bending_stiffness() / beam.length()))) {
    const NaturalShape<Scalar>& natural = beam_.natural_shape();
    const auto stand = [&](Scalar side) {
      detail::lay(natural, ends_[0], ends_[1], beam_.mesh(), beam_.nodes());
      if (natural.straight()) detail::bow(ends_[0], ends_[1], side, beam_.nodes());
      return beam_.work(1);
    };
    const Scalar down = stand(-1), up = stand(1);
    if (detail::push_down(up, down)) stand(-1);
  }

  using Contacts::set_goal;
  /// Across the beam.
  void set_goal(int contact, Scalar d, Scalar lever = 0) noexcept { set_goal(contact, d, lever, {0, 1}); }

  // Required by NewtonRaphson.

  void set_target(Scalar t) noexcept {
    Contacts::aim(t);
    for (auto& end : ends_) end.set_target(t);
  }
  void save() noexcept {
    this->keep(saved_);
    Contacts::save_contacts();
  }
  void restore() noexcept {
    Shape::take_back();
    Contacts::restore_contacts();
  }
  Scalar size() const noexcept { return size_; }
  /// Strain energy before the last increment, at least that of a bend by 10⁻⁴ rad, of which no snap is told [J].
  Scalar strain() const noexcept { return (size_ * size_ + Scalar(1e-8) * unit_ * unit_) / 2; }
  Scalar unit() const noexcept { return unit_; }
  /// Of a beam without stress, of which nothing is left but what the round-off of displacements stretches its shortest element by [√J].
  Scalar round_off() const noexcept {
    const int n = elements();
    const auto moved = [this](int i) { return std::abs(node(i).u) + std::abs(node(i).w); };
    const Scalar shortest = (std::min)(beam_.mesh().position(1), length_ - beam_.mesh().position(n - 1)),
                 off = std::numeric_limits<Scalar>::epsilon() * (moved(0) + moved(n / 2) + moved(n)),
                 energy = beam_.properties()[0].axial_stiffness * static_cast<Scalar>(n) * off * off;
    return size_ * size_ * shortest <= energy ? std::sqrt(energy / shortest) : Scalar(0);
  }

  Iteration<Scalar> iterate() noexcept {
    const Status status = factor(0);
    if (status != Status::ok) return {status, 0};
    force_ = linear_reaction_ = contact_.node() < 0 ? Scalar(0) : assembler_.reaction();
    others_.each([&](auto& other) { other.force = other.reaction = assembler_.reaction(other.row); });
    Contacts::feel_friction();
    Contacts::foresee_potential(potential_, assembler_.energy());
    advance();
    return {status, increment()};
  }

  // Required by Descent, in addition: the two halves of an iteration.

  /// Assembles and solves for an increment, and leaves the state as it is.
  /// @param shift  what is added to the tangent: so many times EI/L³ on each displacement and EI/L on each rotation,
  ///               shared out over the nodes   @return ok | singular | non_finite
  Status factor(Scalar shift) noexcept {
    Scalar energy = 0, work = 0;
    const int c = contact_.node();
    Contacts::look_at_contacts();
    // What most elements need takes no address of their tangent: it stays in registers.
    typename Shape::Parts::Group group;
    const auto add = [&](int e, auto&& change) {
      Matrix6<Scalar> K;
      Vector6<Scalar> r;
      energy += beam_.tangent(e, group, r, K);
      change(r, K);
      assembler_.add(e, K, r);
    };
    const bool plain = shift == 0 && !beam_.loaded(load_);
    for (int e = 0; e < elements(); ++e) {
      beam_.respond(e, group);
      if (plain && !contact_.holds(e) && !contact_.holds(e + 1) && !others_.at(e) && !others_.at(e + 1)) {
        add(e, [](auto&, auto&) {});
        continue;
      }
      add(e, [&](Vector6<Scalar>& r, Matrix6<Scalar>& K) {
        work += beam_.subtract_loads(e, load_, r, K);
        if (shift != 0) add_shift(shift, e, K);
        if (contact_.holds(e)) contact_.transform(node(e), true, e == 0, r, K);
        if (contact_.holds(e + 1)) contact_.transform(node(e + 1), false, true, r, K);
        if (const auto* const other = others_.at(e)) other->point.transform(node(e), true, e == 0, r, K);
        if (const auto* const other = others_.at(e + 1))
          other->point.transform(node(e + 1), false, true, r, K);
        if (friction_) add_friction(e, contact_, *friction_, r, K);
        others_.each([&](const auto& other) {
          if (other.friction) add_friction(e, other.point, *other.friction, r, K);
        });
      });
    }
    size_ = std::sqrt(2 * energy);
    potential_ = energy - work;
    potential_ += Contacts::friction_potential();
    for (std::size_t k = 0; k < 2; ++k)
      ends_[k].visit(node(end(k)), [&](int component, Scalar now, Scalar target) {
        assembler_.prescribe(end(k), component, target - now);
      });
    if (c >= 0) assembler_.hold(c, 1, d_ - contact_.displacement());
    others_.each([&](auto& other) { hold(other); });
    return assembler_.solve();
  }
  /// The tangent holds what the contact's force makes of a circle.  On the way down the force of before is no longer there.
  void forget_force() noexcept {
    force_ = 0;
    for (auto& other : others_) other.force = 0;
    Contacts::fall_with_friction();
  }
  /// Adds the increment to the state.
  void advance() noexcept {
    const auto change = [this](int i) { return increment(i); };
    if constexpr (any_rotation<Element>) {
      if (contact_.node() < 0) {
        // Prescribed increments answer 0; a chain that ended where they were would share them out a second time.
        const auto with_ends = [this](int i) {
          Vector3<Scalar> x = increment(i);
          for (std::size_t k = 0; k < 2; ++k)
            if (i == end(k))
              ends_[k].visit(node(i),
                             [&x](int component, Scalar now, Scalar target) { x[component] = target - now; });
          return x;
        };
        detail::lay_chain<Element, Scalar>(beam_.nodes(), beam_.properties(), with_ends);
        detail::close_chain(beam_.nodes(), ends_[0], ends_[1]);
        return place();
      }
    }
    move(change);
  }
  /// As a shift: a stiffness that is none.
  static constexpr Scalar neutral() noexcept { return 0; }
  /// Size of the last increment in the norm of the tangent [√J].
  Scalar increment() const noexcept { return std::sqrt(std::abs(assembler_.energy())); }
  /// V - λ f · x before the last increment was added [J].
  Scalar potential() const noexcept { return potential_; }
  /// How many directions there are along which the tangent of the last increment is not stiff but gives way.
  int negative_pivots() const noexcept { return assembler_.negative_pivots(); }
  /// Bends the beam a little where nothing makes it leave an equilibrium, without a contact to where its loads push.  @param size  [m]
  void nudge(Scalar size) noexcept {
    const int c = contact_.node();
    const auto move = [&](Scalar by) { detail::nudge(beam_.nodes(), c < 0 ? Scalar(-1) : node(c).s, by); };
    if (c < 0 && beam_.loaded(load_)) {
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
    for (int i = 0; i <= elements(); ++i) largest = (std::max)(largest, std::abs(assembler_.increment(i)[2]));
    return largest;
  }

  /// Of node i after factor() [u, w, θ].
  Vector3<Scalar> increment(int i) const noexcept {
    if (const auto* const other = others_.at(i)) return other->point.back(assembler_.increment(i));
    return contact_.holds(i) ? contact_.back(assembler_.increment(i)) : assembler_.increment(i);
  }
  /// Adds to the state.  @param change  i -> [u, w, θ]
  template <class Change>
  void move(Change&& change) noexcept {
    for (int i = 0; i <= elements(); ++i) {
      const Vector3<Scalar> x = change(i);
      Node& to = beam_.nodes()[i];
      to.u += x[0];
      to.w += x[1];
      to.theta += x[2];
    }
    place();
  }

  /// Force along n that holds the contact at d, thesis eq. 3.42 [N].
  Scalar reaction() const noexcept {
    const int c = contact_.node();
    Vector6<Scalar> r;
    Vector2<Scalar> force = Vector2<Scalar>::Zero();
    if (c < elements()) {
      beam_.residual(c, load_, r);
      force += r.template head<2>();
    }
    if (c > 0) {
      beam_.residual(c - 1, load_, r);
      force += r.template segment<2>(3);
    }
    return contact_.normal().dot(force);
  }

  /// Strain energy [J].
  Scalar strain_energy() const noexcept { return beam_.strain_energy(); }
  /// V - λ f · x as it lies now [J].
  Scalar total_potential() const noexcept { return strain_energy() - beam_.work(load_); }
  /// What the section at s carries, in element e, which holds s.   @param thickness [m]
  InternalForces<Scalar> internal_forces(int e, Scalar s, Scalar thickness) const noexcept {
    return beam_.internal_forces(e, s, load_, thickness);
  }

 protected:
  using Contacts::load_;

 private:
  friend Contacts;  // sets its shape
  using Contacts::contact_;
  using Contacts::d_;
  using Contacts::force_;
  using Contacts::friction_;
  using Contacts::linear_reaction_;
  using Contacts::others_;
  using Contacts::start_load_;

  using Shape::beam_;
  using Shape::length_;
  using Shape::saved_;
  int end(std::size_t k) const noexcept { return k == 0 ? 0 : elements(); }

  void begin_path() noexcept {
    start_load_ = load_;
    for (std::size_t k = 0; k < 2; ++k) ends_[k].begin(node(end(k)));
  }

  /// Puts the ends and the contact exactly where they belong.
  void place() noexcept {
    for (std::size_t k = 0; k < 2; ++k)
      ends_[k].visit(beam_.nodes()[end(k)], [](int, Scalar& now, Scalar target) { now = target; });
    Contacts::correct_contacts(beam_.nodes());
  }
  template <class Other>
  void hold(Other& other) noexcept {
    const Scalar increment = other.d - other.point.displacement();
    const int c = other.point.node();
    assembler_.hold(c, 1, increment, other.row);
    assembler_.know(c, 1, increment, assembler_.held());
    for (auto& before : others_) {
      if (&before == &other) break;
      assembler_.know(c, 1, increment, before.row);
    }
  }

  /// Friction, along the surface, of a contact of element e.
  template <class Point>
  static void add_friction(int e, const Point& contact, const Friction& friction, Vector6<Scalar>& r,
                           Matrix6<Scalar>& K) noexcept {
    if (!contact.holds(e + 1) && !(e == 0 && contact.holds(0))) return;
    const int at = contact.holds(e + 1) ? 3 : 0;  // first row of its node
    const Vector2<Scalar>& n = contact.normal();
    r[at] -= n.y() * friction.force().x() - n.x() * friction.force().y();
    K(at, at) += friction.stiffness();
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

  detail::AssemblerOf<Element, Scalar, Elements, MaxElements> assembler_;
  std::array<detail::EndSupport<Scalar>, 2> ends_;
  Scalar size_ = 0, potential_ = 0, unit_;
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
  template <typename Scalar>
  using Round = Circle<Scalar>;
  template <typename Scalar>
  using RoundContact = detail::RoundContact<Scalar>;
};

}  // namespace detail

}  // namespace hapbeam
