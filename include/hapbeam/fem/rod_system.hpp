// SPDX-License-Identifier: MIT
// The nonlinear equations of one rod in space: its elements, its ends, and what touches it.
//
//   ∂V/∂x = t f + contacts        unknown x: r, r' and, with twist, φ of every node, force and place of every contact
//
// The expressions are those of BeamSystem, so that Newton's method, descents, load paths and pushes are the same.  The unknowns of an
// end are those in its own axes, d1, d2 and tangent, where what a clamp holds are components.  The mesh stays; a contact is at any place of it.
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/body/touched_rod.hpp>
#include <hapbeam/fem/beam_system.hpp>
#include <hapbeam/fem/contact/contact_friction.hpp>
#include <hapbeam/fem/contact/contact_rows.hpp>
#include <hapbeam/fem/contact/drawn_mesh.hpp>
#include <hapbeam/fem/contact/rod_round_contact.hpp>
#include <hapbeam/fem/contact/system_contacts.hpp>
#include <hapbeam/fem/rod/rod_ends.hpp>
#include <hapbeam/fem/rod/rod_increments.hpp>
#include <hapbeam/fem/rod/rod_motion.hpp>
#include <hapbeam/fem/rod/rod_range.hpp>
#include <hapbeam/fem/rod/rod_shape.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>

namespace hapbeam {

namespace detail {

template <class Element, typename Scalar, int Most>
struct TouchedOf<Element, Scalar, Most, std::enable_if_t<dimension_of<Element> == 3>> {
  using Type = TouchedRod<Element, Scalar, Most>;
};

}  // namespace detail

template <class Element, typename ScalarType, int Elements, int MaxElements>
class RodSystem
    : public detail::RodShape<Element, ScalarType, Elements, MaxElements>,
      public detail::SystemContacts<
          RodSystem<Element, ScalarType, Elements, MaxElements>, ScalarType,
          detail::ContactFriction<ScalarType, 3, detail::RodRoundContact>,
          detail::ContactRows<
              Element, ScalarType, detail::AssemblerOf<Element, ScalarType, Elements, MaxElements>,
              detail::ContactFriction<ScalarType, 3, detail::RodRoundContact>, contacts_of<Element>>> {
  using Contacts = typename RodSystem::SystemContacts;
  using Shape = detail::RodShape<Element, ScalarType, Elements, MaxElements>;

 public:
  using Scalar = ScalarType;
  using Body = Rod;
  using typename Contacts::Contact;
  using typename Contacts::Rows;
  using typename Shape::Node;
  using typename Shape::State;
  using typename Shape::Vector3;
  using RoundContact = detail::RodRoundContact<Scalar>;
  using Friction = detail::ContactFriction<Scalar, 3, detail::RodRoundContact>;
  using Shape::elements;
  using Shape::node;
  using Shape::unknowns;
  using Increment = VectorOf<Scalar, unknowns>;

  /// @param number  of elements   @throws std::invalid_argument as RodElements
  RodSystem(const Rod& rod, int number)
      : Shape(rod, number),
        Contacts(number),
        increments_(number),
        assembler_(number),
        ends_(rod, rod_.nodes()),
        unit_(static_cast<Scalar>(
            std::sqrt((std::min)(rod.stiffness().bending1, rod.stiffness().bending2) / rod.length()))) {
    no_mechanism_ = factor(0) == Status::ok;  // in its natural shape
    if (rod.right_pose()) ends_[1].place_home(*rod.right_pose());
  }

  /// To be called where the rod has moved.
  void look(int k) noexcept {
    rows_.look(rod_, rows_.element(k), [](Scalar) {});
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

  /// Its ends belong where they do at rest.
  void go_home() noexcept {
    for (auto& end : ends_) end.go_home();
  }
  /// Places an end anew: where the next path leads.  @param k  0: left, 1: right
  /// @return false where it is neither clamped nor on springs, or the pose is none: nothing has changed
  bool place_end(std::size_t k, RodPose pose) noexcept {
    const bool valid = ends_[k].takes_pose() && pose.make_valid();
    if (valid) ends_[k].place(pose);
    return valid;
  }

  // Required by NewtonRaphson.

  void set_target(Scalar t) noexcept {
    Contacts::aim(t);
    for (auto& end : ends_) end.set_target(t);
  }
  void save() noexcept {
    Shape::keep_here();
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

  /// On the way down the forces of before are no longer there.
  void forget_force() noexcept { rows_.fall(); }

  Iteration<Scalar> iterate() noexcept {
    const Status status = factor(0);
    if (status != Status::ok) return {status, 0};
    Contacts::feel(potential_, assembler_.energy() + inner_energy_);
    weight_ = Contacts::weight(size_);
    advance();
    return {status, increment()};
  }

  // Required by Descent, in addition: the two halves of an iteration.

  void find_tensions() noexcept {}

  /// Assembles and solves for an increment, and leaves the state as it is.
  /// @param shift  what is added to the tangent: so many times EI/L³ on each place and EI/L on each rotation, shared out
  /// over the nodes   @return ok | singular | non_finite | iteration_limit, where an end has farther to turn than an increment leads
  Status factor(Scalar shift) noexcept;
  /// Adds the increment to the state: what turns keeps its length.  Without a contact, which would be missed, the chords turn
  /// as the tangents do, from the left end on (as chain.hpp says of the plane).
  void advance() noexcept;
  /// As a shift: a stiffness that is none.  A rod that is round may roll where it is bowed, but for round-off; 1/10⁷ of what bends one.
  static constexpr Scalar neutral() noexcept { return Scalar(1e-6); }
  /// Size of the last increment in the norm of the tangent [√J].
  Scalar increment() const noexcept {
    return std::sqrt(std::abs(rows_.any() ? rows_.energy() : assembler_.energy()) + std::abs(inner_energy_) +
                     longer_);
  }
  /// V - λ f · x before the last increment was added [J].
  Scalar potential() const noexcept { return potential_; }
  int negative_pivots() const noexcept {
    return rows_.any() ? rows_.negative_pivots() : assembler_.negative_pivots();
  }
  /// Bends the rod a little where nothing makes it leave an equilibrium, without a contact to where its loads push.  @param size  [m]
  void nudge(Scalar size) noexcept {
    const bool pressed = rows_.any();
    const Node& middle = node(elements() / 2);
    const Vector3 d1 = middle.director, d2 = detail::cross3(detail::unit(middle.tangent), d1);
    // Where nothing pushes, along the director and half as much across it.
    Vector3 way = d1 + d2 / 2;
    if (!pressed && rod_.loaded(load_)) {
      const Vector3 pushed = pushed_by(size, d1) * d1 + pushed_by(size, d2) * d2;
      // A flat rod may stand aside across that alone.
      if (const Scalar most = pushed.norm(); most > 0) way = pushed / most + way / 100;
    }
    Shape::bow(size * way, pressed ? rows_[0].s / length_ : Scalar(-1));
    ends_.correct(rod_.nodes());
  }

  // Required by LoadPath, in addition.

  /// Largest rotation of a node in the last increment [rad].
  Scalar turn() const noexcept {
    Scalar largest = 0;
    for (int i = 0; i <= elements(); ++i) {
      const Increment x = increment(i);
      const Vector3 u = detail::unit(node(i).tangent), t = x.template segment<3>(3);
      Scalar square = (t - u.dot(t) * u).squaredNorm();
      if constexpr (unknowns == 7) square += x[6] * x[6];
      largest = (std::max)(largest, std::sqrt(square));
    }
    return largest;
  }

  /// Of node i after factor(): r [m], r' and φ [rad].
  Increment increment(int i) const noexcept {
    const Increment x = assembler_.increment(i);
    return ends_.has(i) ? ends_.increment(x, i, node(i)) : x;
  }

  /// What holds an end of a rod that nothing touches: force [N] and moment about the end [N·m], in space.
  struct Hold {
    Vector3 force, moment;
  };
  Hold reaction(std::size_t k) const noexcept {
    Residual r;
    rod_.residual(k == 0 ? 0 : elements() - 1, load_, r);
    const Increment at = r.template segment<unknowns>(k == 0 ? 0 : unknowns);
    const Vector3 t = node(ends_.node(k)).tangent;
    Vector3 moment = detail::cross3<Scalar>(t, at.template segment<3>(3));
    if constexpr (unknowns == 7) moment += at[6] * detail::unit(t);
    return {at.template segment<3>(0), moment};
  }

  /// What the section at s carries, in a piece of drawn(), which holds s.
  InternalForces<Scalar, 3> internal_forces(int piece, Scalar s, Scalar) const noexcept {
    int e = drawn_.element_of(piece);
    // Where a contact was drawn instead of a node.
    if (e > 0 && s < node(e).s) --e;
    else if (e + 1 < elements() && s > node(e + 1).s) ++e;
    return rod_.internal_forces(e, s, load_, [&](auto&& touch) {
      for (int k = 0; k < rows_.size(); ++k)
        if (const Contact& contact = rows_[k]; rows_.element(k) == e)
          touch(contact.s, Vector3(contact.force * contact.normal + contact.friction), contact.place);
    });
  }

  /// Strain energy, that of the springs that hold it included [J].
  Scalar strain_energy() const noexcept {
    Scalar energy = rod_.strain_energy();
    each_touched([&](int e) { energy += rows_.strain_energy(rod_, e); });
    return energy + ends_.visit_springs(rod_.nodes(), [](int, const Block&, const Increment&) {});
  }
  /// V - λ f · x as it lies now [J].
  Scalar total_potential() const noexcept { return strain_energy() - rod_.work(load_); }

  // What is seen: the mesh, and in it the places of contacts.

  /// To be called where the rod has moved.
  void draw() noexcept {
    for (int k = 0; k < rows_.size(); ++k) look(k);
    drawn_.draw(
        elements(), [this](int i) -> const Node& { return node(i); },
        [this](Scalar s) { return element_at(s); }, rows_.size(), [this](int k) { return rows_[k].s; },
        [this](int k) { return mark(k); }, [this](int e, Scalar s) { return rod_.node_within(e, s); });
  }
  Centreline<Scalar, 3> drawn() const noexcept { return {drawn_.data(), drawn_.size()}; }
  /// n · r of it at s [m].
  using Shape::displacement;
  Scalar displacement(Scalar s, const Vector3& normal) const noexcept { return normal.dot(drawn().at(s).r); }

 private:
  friend Contacts;
  using Contacts::load_;
  using Contacts::rows_;
  using Shape::length_;
  using Shape::rod_;
  using Residual = typename Shape::Parts::Residual;
  using Block = Eigen::Matrix<Scalar, unknowns, unknowns>;
  int element_at(Scalar s) const noexcept { return this->centreline().segment_at(s); }
  /// That of before where it holds s, or nearly: a contact that goes to and fro over a node stays in one.
  int element_at(Scalar s, int before) const noexcept {
    const Scalar from = node(before).s, to = node(before + 1).s, over = (to - from) / 100;
    return from - over <= s && s <= to + over ? before : element_at(s);
  }
  /// Calls f(e) for each element that is touched.
  template <class F>
  void each_touched(F&& f) const noexcept {
    for (int k = 0; k < rows_.size(); ++k) {
      bool first = true;
      for (int j = 0; j < k; ++j) first = first && rows_.element(j) != rows_.element(k);
      if (first) f(rows_.element(k));
    }
  }
  /// What contacts are to their elements.  Not inlined by intent: factor() is long, and what all elements need comes first.   @return their energy [J]
  [[gnu::noinline]] Scalar add_contacts() noexcept {
    Scalar energy = 0;
    rows_.seek(rod_);
    each_touched([&](int e) {
      Residual r;
      typename Rows::Tangent K;
      energy += rows_.touch(rod_, e, r, K);
      assembler_.add_more(e, K, r);
    });
    return energy;
  }
  /// A node of drawn() where a contact is.
  Node mark(int k) noexcept {
    const Contact& contact = rows_[k];
    Node at = rod_.node_within(rows_.element(k), contact.s);
    // On what touches it, where an equilibrium was found: the last increment has left that by its square.
    const Scalar off = contact.gap + contact.force * contact.compliance,
                 left = std::abs(off) < length_ / 1000 ? off : Scalar(0);
    at.r = contact.place - left * contact.normal;
    detail::set_tangent<Scalar>(at, contact.tangent);
    return at;
  }
  /// The part of the work of its loads in a bow that changes its sign with that: none, where it is round-off [J].
  Scalar pushed_by(Scalar size, const Vector3& d) noexcept {
    Shape::bow(size * d, -1);
    const Scalar there = rod_.work(load_);
    Shape::bow(-2 * size * d, -1);
    const Scalar back = rod_.work(load_);
    Shape::bow(size * d, -1);
    const Scalar round_off = std::sqrt(std::numeric_limits<Scalar>::epsilon());
    return std::abs(there - back) > round_off * (std::abs(there) + std::abs(back)) ? there - back : Scalar(0);
  }
  void begin_path() noexcept { ends_.begin_path(rod_.nodes()); }

  /// An element's share of the shift is half of either node's.
  void add_shift(Scalar shift) noexcept {
    for (int i = 0; i <= elements(); ++i) {
      const Scalar length = node((std::min)(i + 1, elements())).s - node((std::max)(i - 1, 0)).s,
                   share = shift * unit_ * unit_ * length / (2 * length_);
      Increment diagonal = Increment::Constant(share);
      diagonal.template segment<3>(0) /= length_ * length_;
      assembler_.add_at(i, Block(diagonal.asDiagonal()), Increment::Zero());
    }
  }

  detail::RodIncrements<Scalar, Elements, MaxElements, unknowns> increments_;  // in advance()
  detail::AssemblerOf<Element, Scalar, Elements, MaxElements> assembler_;
  detail::RodEnds<Scalar, unknowns> ends_;
  bool no_mechanism_ = false;  // its ends and springs hold it
  Scalar size_ = 0, weight_ = 0, potential_ = 0, inner_energy_ = 0, longer_ = 0, unit_;
  detail::DrawnMesh<Node, Elements, MaxElements, contacts_of<Element>> drawn_{elements()};
};

// Outside of the class: only so does "extern template class RodSystem<…>;" keep a compiler from them.
template <class Element, typename Scalar, int Elements, int MaxElements>
Status RodSystem<Element, Scalar, Elements, MaxElements>::factor(Scalar shift) noexcept {
  if (!ends_.follow(rod_.nodes())) return Status::iteration_limit;
  const auto [strain, work, inner] =
      rod_.visit_tangents(load_, [&](int first, auto& K, auto& r) { assembler_.add_pairs(first, K, r); });
  inner_energy_ = inner, longer_ = 0;
  Scalar energy = strain;
  if (shift != 0) add_shift(shift);
  energy += ends_.visit_springs(
      rod_.nodes(), [this](int i, const Block& K, const Increment& r) { assembler_.add_at(i, K, r); });
  if (rows_.any()) energy += add_contacts();
  for (std::size_t k = 0; k < 2; ++k) {
    const Node& at = node(ends_.node(k));
    ends_.hold(k, at, assembler_);
    rows_.visit_node(ends_.node(k), [&](auto&& b, Scalar& residual) { ends_.hold_row(k, at, b, residual); });
  }
  weight_ = size_ =
      std::sqrt(2 * (std::max)(energy, Scalar(0)));  // of a rod without stress round-off has either sign
  potential_ = energy - work;
  if (rows_.any()) potential_ += rows_.potential() + rows_.friction_potential();
  const Status status = rows_.any() ? rows_.solve(assembler_) : assembler_.solve();
  // A round rod that is bowed between two ends on one axis may roll about it: that takes no force, and leads nowhere.
  if (status == Status::singular && shift == 0 && no_mechanism_) return factor(neutral());
  return status;
}

template <class Element, typename Scalar, int Elements, int MaxElements>
void RodSystem<Element, Scalar, Elements, MaxElements>::advance() noexcept {
  increments_.take(assembler_);
  for (std::size_t k = 0; k < 2; ++k)
    if (const int i = ends_.node(k); ends_.has(i)) increments_.set(i, increment(i));
  const bool free = !rows_.any();
  if (!free)
    longer_ += rows_.advance(
        [this](int e) {
          Residual both;
          both << increments_[e], increments_[e + 1];
          return both;
        },
        [](int, Scalar) {}, [this](Scalar s, int e) { return element_at(s, e); });
  Shape::move(increments_, free);
  if (free) ends_.close_chain(rod_.nodes(), length_);
  ends_.correct(rod_.nodes());
}

namespace detail {

template <class Element>
struct SystemOf<Element, std::enable_if_t<dimension_of<Element> == 3>> {
  using Body = Rod;
  using Side = RodSide;
  using Pose = RodPose;
  template <typename Scalar, int Elements, int MaxElements>
  using System = RodSystem<Element, Scalar, Elements, MaxElements>;
  template <typename Scalar>
  using Range = RodRange<Scalar>;
};

}  // namespace detail

}  // namespace hapbeam
