// The nonlinear equations of one rod in space: its elements, its ends, and one prescribed contact displacement.
//
//   ∂V/∂x = λ f,   n · r(contact) = d        unknown x: r, r' and, with twist, φ of every node
//
// The expressions are those of BeamSystem, so that Newton's method, descents and load paths are the same.  The unknowns of an
// end are those in its own axes, d1, d2 and tangent, where what a clamp holds are components; the unknowns of the contact's
// node are those of rod_contact.hpp.
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/fem/beam_system.hpp>
#include <hapbeam/fem/contact_friction.hpp>
#include <hapbeam/fem/rod_contact.hpp>
#include <hapbeam/fem/rod_contact_rows.hpp>
#include <hapbeam/fem/rod_ends.hpp>
#include <hapbeam/fem/rod_increments.hpp>
#include <hapbeam/fem/rod_motion.hpp>
#include <hapbeam/fem/rod_range.hpp>
#include <hapbeam/fem/rod_round_contact.hpp>
#include <hapbeam/fem/rod_shape.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/fem/system_contacts.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements>
class RodSystem
    : public detail::RodShape<Element, ScalarType, Elements, MaxElements>,
      public detail::SystemContacts<
          RodSystem<Element, ScalarType, Elements, MaxElements>, ScalarType, detail::RodContact<ScalarType>,
          VectorOf<ScalarType, 3>, detail::CapsuleOnCurve<ScalarType>,
          detail::ContactFriction<ScalarType, 3, detail::RodRoundContact>,
          typename detail::AssemblerOf<Element, ScalarType, Elements, MaxElements>::HeldRow,
          contacts_of<Element> - 1> {
  using Contacts = typename RodSystem::SystemContacts;
  using Shape = detail::RodShape<Element, ScalarType, Elements, MaxElements>;

 public:
  using Scalar = ScalarType;
  using Body = Rod;
  using typename Shape::Node;
  using typename Shape::Vector3;
  using Friction = detail::ContactFriction<Scalar, 3, detail::RodRoundContact>;
  using Shape::elements;
  using Shape::mesh;
  using Shape::node;
  using Shape::unknowns;
  using Increment = VectorOf<Scalar, unknowns>;

  /// @param number  of elements   @throws std::invalid_argument as RodElements
  RodSystem(const Rod& rod, int number)
      : Shape(rod, number),
        increments_(number),
        assembler_(number),
        ends_(rod, rod_.nodes()),
        unit_(static_cast<Scalar>(
            std::sqrt((std::min)(rod.stiffness().bending1, rod.stiffness().bending2) / rod.length()))) {
    no_mechanism_ = factor(0) == Status::ok;  // in its natural shape
    if (rod.right_pose()) ends_[1].place_home(*rod.right_pose());
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
  Scalar size() const noexcept { return size_; }
  /// Strain energy before the last increment, at least that of a bend by 10⁻⁴ rad, of which no snap is told [J].
  Scalar strain() const noexcept { return (size_ * size_ + Scalar(1e-8) * unit_ * unit_) / 2; }
  Scalar unit() const noexcept { return unit_; }

  /// The tangent holds what the contact's force makes of a capsule, on the way down as well: there a rod slips around a sphere.
  void forget_force() noexcept { Contacts::fall_with_friction(); }

  Iteration<Scalar> iterate() noexcept {
    const Status status = factor(0);
    if (status != Status::ok) return {status, 0};
    advance();
    linear_reaction_ = force_;
    for (auto& other : others_) other.reaction = other.force;
    Contacts::feel_friction();
    Contacts::foresee_potential(potential_, assembler_.energy() + inner_energy_);
    return {status, increment()};
  }

  // Required by Descent, in addition: the two halves of an iteration.

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
    return std::sqrt(std::abs(assembler_.energy()) + std::abs(inner_energy_));
  }
  /// V - λ f · x before the last increment was added [J].
  Scalar potential() const noexcept { return potential_; }
  int negative_pivots() const noexcept { return assembler_.negative_pivots(); }
  /// Bends the rod a little where nothing makes it leave an equilibrium, without a contact to where its loads push.  @param size  [m]
  void nudge(Scalar size) noexcept {
    const bool pressed = contact_.node() >= 0;
    const Node& middle = node(elements() / 2);
    const Vector3 d1 = middle.director, d2 = detail::cross3(detail::unit(middle.tangent), d1);
    // Where nothing pushes, along the director and half as much across it.
    Vector3 way = d1 + d2 / 2;
    if (!pressed && rod_.loaded(load_)) {
      const Vector3 pushed = pushed_by(size, d1) * d1 + pushed_by(size, d2) * d2;
      // A flat rod may stand aside across that alone.
      if (const Scalar most = pushed.norm(); most > 0) way = pushed / most + way / 100;
    }
    Shape::bow(size * way, pressed ? node(contact_.node()).s / length_ : Scalar(-1));
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
    Increment x = assembler_.increment(i);
    const auto* const contact = contact_at(i);
    const Scalar moves = !contact ? Scalar(0) : contact == &contact_ ? moves_ : others_.at(i)->moves;
    if (ends_.has(i, contact)) return ends_.increment(x, i, node(i), contact, moves);
    if (contact) contact->complete(x, moves);
    return x;
  }

  /// What holds an end: force [N] and moment about the end [N·m], in space.
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

  /// What the section at s carries, in element e, which holds s.
  InternalForces<Scalar, 3> internal_forces(int e, Scalar s, Scalar) const noexcept {
    return rod_.internal_forces(e, s, load_);
  }

  /// Strain energy, that of the springs that hold it included [J].
  Scalar strain_energy() const noexcept {
    return rod_.strain_energy() +
           ends_.visit_springs(rod_.nodes(), [](int, const Block&, const Increment&) {});
  }
  /// V - λ f · x as it lies now [J].
  Scalar total_potential() const noexcept { return strain_energy() - rod_.work(load_); }

 private:
  friend Contacts;  // sets its shape
  using Contacts::contact_;
  using Contacts::d_;
  using Contacts::force_;
  using Contacts::friction_;
  using Contacts::linear_reaction_;
  using Contacts::load_;
  using Contacts::others_;
  using Contacts::start_load_;

  using Shape::length_;
  using Shape::rod_;
  using Residual = typename Shape::Parts::Residual;
  using Block = Eigen::Matrix<Scalar, unknowns, unknowns>;
  /// The contact that a node has, null: none.
  const detail::RodContact<Scalar>* contact_at(int i) const noexcept {
    if (contact_.holds(i)) return &contact_;
    const auto* const other = others_.at(i);
    return other ? &other->point : nullptr;
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
  void begin_path() noexcept {
    start_load_ = load_;
    ends_.begin_path(rod_.nodes());
  }

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
  Scalar moves_ = 0;
  bool no_mechanism_ = false;  // its ends and springs hold it
  Scalar size_ = 0, potential_ = 0, inner_energy_ = 0, unit_;
};

// Outside of the class: only so does "extern template class RodSystem<…>;" keep a compiler from them.
template <class Element, typename Scalar, int Elements, int MaxElements>
Status RodSystem<Element, Scalar, Elements, MaxElements>::factor(Scalar shift) noexcept {
  if (!ends_.follow(rod_.nodes())) return Status::iteration_limit;
  const int c = contact_.node();
  Contacts::look_at_contacts();
  const auto [strain, work, inner] =
      rod_.visit_tangents(load_, [&](int first, auto& K, auto& r) { assembler_.add_pairs(first, K, r); });
  inner_energy_ = inner;
  Scalar energy = strain;
  if (shift != 0) add_shift(shift);
  energy += ends_.visit_springs(
      rod_.nodes(), [this](int i, const Block& K, const Increment& r) { assembler_.add_at(i, K, r); });
  if (c >= 0) detail::add_bend<unknowns>(contact_, assembler_);
  for (const auto& other : others_) detail::add_bend<unknowns>(other.point, assembler_);
  const auto rub = [this](const auto& contact, const Friction* friction) {
    if (friction) detail::add_friction<unknowns>(contact, node(contact.node()), *friction, assembler_);
  };
  if (c >= 0) rub(contact_, friction_);
  others_.each([&](const auto& other) { rub(other.point, other.friction); });
  for (std::size_t k = 0; k < 2; ++k)
    ends_.hold(k, node(ends_.node(k)), contact_at(ends_.node(k)), assembler_);
  const auto lean_within = [this](const auto& contact) {
    const int i = contact.node();
    if (i > 0 && i < elements()) assembler_.lean(i, contact.leading(), contact.share());
  };
  lean_within(contact_);
  for (const auto& other : others_) lean_within(other.point);
  size_ = std::sqrt(2 * (std::max)(energy, Scalar(0)));  // of a rod without stress round-off has either sign
  potential_ = energy - work;
  potential_ += Contacts::friction_potential();
  moves_ = 0;
  if (c >= 0) detail::hold(contact_, moves_ = d_ - contact_.displacement(), assembler_, assembler_.held());
  others_.each([&](auto& other) { detail::hold_other<Scalar>(other, assembler_, others_); });
  const Status status = assembler_.solve();
  // A round rod that is bowed between two ends on one axis may roll about it: that takes no force, and leads nowhere.
  if (status == Status::singular && shift == 0 && no_mechanism_) return factor(neutral());
  return status;
}

template <class Element, typename Scalar, int Elements, int MaxElements>
void RodSystem<Element, Scalar, Elements, MaxElements>::advance() noexcept {
  force_ = contact_.node() < 0 ? Scalar(0) : contact_.along(assembler_.reaction());
  others_.each([&](auto& other) { other.force = other.point.along(assembler_.reaction(other.row)); });
  increments_.take(assembler_);
  const auto set = [&](int i) { increments_.set(i, increment(i)); };
  for (std::size_t k = 0; k < 2; ++k)
    if (const int i = ends_.node(k); ends_.has(i, contact_at(i))) set(i);
  const auto set_within = [&](int i) {
    if (i > 0 && i < elements()) set(i);
  };
  set_within(contact_.node());
  for (const auto& other : others_) set_within(other.point.node());
  const bool free = contact_.node() < 0;
  Shape::move(increments_, free);
  if (free) ends_.close_chain(rod_.nodes(), length_);
  ends_.correct(rod_.nodes());
  Contacts::correct_contacts(rod_.nodes());
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
  template <typename Scalar>
  using Round = Capsule<Scalar>;
  template <typename Scalar>
  using RoundContact = RodRoundContact<Scalar>;
};

}  // namespace detail

}  // namespace hapbeam
