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
#include <array>
#include <cmath>

#include <hapbeam/fem/beam_system.hpp>
#include <hapbeam/fem/contact_friction.hpp>
#include <hapbeam/fem/rod_contact.hpp>
#include <hapbeam/fem/rod_end.hpp>
#include <hapbeam/fem/rod_increments.hpp>
#include <hapbeam/fem/rod_motion.hpp>
#include <hapbeam/fem/rod_range.hpp>
#include <hapbeam/fem/rod_round_contact.hpp>
#include <hapbeam/fem/rod_shape.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/fem/system_contacts.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements,
          template <typename, int, int, int> class Assembler>
class RodSystem
    : public detail::RodShape<Element, ScalarType, Elements, MaxElements>,
      public detail::SystemContacts<
          RodSystem<Element, ScalarType, Elements, MaxElements, Assembler>, ScalarType,
          detail::RodContact<ScalarType>, VectorOf<ScalarType, 3>, detail::CapsuleOnCurve<ScalarType>,
          detail::ContactFriction<ScalarType, 3, detail::RodRoundContact>,
          typename detail::HeldRowOf<Assembler<ScalarType, Elements, MaxElements, Element::unknowns>>::Type,
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
        ends_{detail::RodEnd<Scalar>(rod.left(), node(0)), detail::RodEnd<Scalar>(rod.right(), node(number))},
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
    this->keep(saved_);
    Contacts::save_contacts();
  }
  void restore() noexcept {
    Shape::take_back();
    Contacts::restore_contacts();
  }
  Scalar size() const noexcept { return size_; }
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
    return {status, increment()};
  }

  // Required by Descent, in addition: the two halves of an iteration.

  /// Assembles and solves for an increment, and leaves the state as it is.
  /// @param shift  what is added to the tangent: so many times EI/L³ on each place and EI/L on each rotation, shared out
  /// over the nodes   @return ok | singular | non_finite | iteration_limit, where an end has farther to turn than an increment leads
  Status factor(Scalar shift) noexcept {
    for (std::size_t k = 0; k < 2; ++k)
      if (!ends_[k].follows(node(end(k)))) return Status::iteration_limit;
    const int c = contact_.node();
    Contacts::look_at_contacts();
    const auto [strain, work, inner] =
        rod_.visit_tangents(load_, [&](int first, auto& K, auto& r) { assembler_.add_pairs(first, K, r); });
    inner_energy_ = inner;
    Scalar energy = strain;
    if (shift != 0) add_shift(shift);
    for (std::size_t k = 0; k < 2; ++k)
      if (ends_[k].has_springs()) {
        Increment r = Increment::Zero();
        Block K = Block::Zero();
        energy += ends_[k].add_springs(node(end(k)), r, K);
        assembler_.add_at(end(k), K, r);
      }
    if (c >= 0) add_bend(contact_);
    for (const auto& other : others_) add_bend(other.point);
    if (friction_ && c >= 0) add_friction(contact_, *friction_);
    others_.each([this](const auto& other) {
      if (other.friction) add_friction(other.point, *other.friction);
    });
    for (std::size_t k = 0; k < 2; ++k) hold_end(k);
    const auto lean_within = [this](const auto& contact) {
      if (const int i = contact.node(); i > 0 && i < elements()) lean(contact);
    };
    lean_within(contact_);
    for (const auto& other : others_) lean_within(other.point);
    size_ =
        std::sqrt(2 * (std::max)(energy, Scalar(0)));  // of a rod without stress round-off has either sign
    potential_ = energy - work;
    potential_ += Contacts::friction_potential();
    moves_ = 0;
    if (c >= 0) hold(contact_, moves_ = d_ - contact_.displacement(), assembler_.held());
    others_.each([&](auto& other) { hold(other); });
    const Status status = assembler_.solve();
    // A round rod that is bowed between two ends on one axis may roll about it: that takes no force, and leads nowhere.
    if (status == Status::singular && shift == 0 && no_mechanism_) return factor(neutral());
    return status;
  }
  /// Adds the increment to the state: what turns keeps its length.  Without a contact, which would be missed, the chords turn
  /// as the tangents do, from the left end on (as chain.hpp says of the plane).
  void advance() noexcept {
    force_ = contact_.node() < 0 ? Scalar(0) : along(contact_, assembler_.reaction());
    others_.each([&](auto& other) { other.force = along(other.point, assembler_.reaction(other.row)); });
    increments_.take(assembler_);
    increments_.set(0, increment(0)), increments_.set(elements(), increment(elements()));
    const auto set = [&](int i) {
      if (i > 0 && i < elements()) increments_.set(i, increment(i));
    };
    set(contact_.node());
    for (const auto& other : others_) set(other.point.node());
    const bool free = contact_.node() < 0;
    if (free) turn_chords();
    rod_.advance_inners(increments_);
    detail::move_nodes<unknowns == 7>(rod_.nodes(), increments_, !free);
    if (free) close_chain();
    for (std::size_t k = 0; k < 2; ++k) ends_[k].correct(rod_.nodes()[end(k)]);
    Contacts::correct_contacts(rod_.nodes());
  }
  /// As a shift: a stiffness that is none.  A rod that is round may roll where it is bowed, but for round-off; 1/10⁷ of what bends one.
  static constexpr Scalar neutral() noexcept { return Scalar(1e-6); }
  /// Size of the last increment in the norm of the tangent [√J].
  Scalar increment() const noexcept {
    return std::sqrt(std::abs(assembler_.energy()) + std::abs(inner_energy_));
  }
  /// V - λ f · x before the last increment was added [J].
  Scalar potential() const noexcept { return potential_; }
  int negative_pivots() const noexcept { return assembler_.negative_pivots(); }
  /// Bends the rod a little where nothing makes it leave an equilibrium.  @param size  [m]
  void nudge(Scalar size) noexcept {
    Shape::bow(size, contact_.node() < 0 ? Scalar(-1) : node(contact_.node()).s / length_);
    for (std::size_t k = 0; k < 2; ++k) ends_[k].correct(rod_.nodes()[end(k)]);
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
    const bool at_end = i == 0 || i == elements();
    if (at_end) {
      const std::size_t k = i == 0 ? 0 : 1;
      if (is_clamped(k)) return x = prescribed_[k] + along_end(k, x[5]);
      x += prescribed_[k];
    }
    const auto* const contact = contact_at(i);
    if (contact) {
      const Scalar moves = contact == &contact_ ? moves_ : others_.at(i)->moves;
      x.template head<3>() += way(*contact, moves);
      x[contact->leading()] -= share(*contact).dot(x.template head<6>());
    }
    if (!at_end) return x;
    const Matrix *const R = place_axes(i), *const T = tangent_axes(i);
    const auto turn = [&x](int at, const Matrix& Q) {
      const Vector3 v(x[at], x[at + 1], x[at + 2]);
      for (int k = 0; k < 3; ++k) x[at + k] = Q(k, 0) * v[0] + Q(k, 1) * v[1] + Q(k, 2) * v[2];
    };
    if (R) turn(0, *R);
    if (T) turn(3, *T);
    if constexpr (unknowns == 7)
      if (const auto* const joint = this->joint(i)) x[6] -= joint->arm(node(i)).dot(x.template segment<3>(3));
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
    const Vector3 t = node(end(k)).tangent;
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
    Scalar energy = rod_.strain_energy();
    Increment r = Increment::Zero();
    Block K = Block::Zero();
    for (std::size_t k = 0; k < 2; ++k)
      if (ends_[k].has_springs()) energy += ends_[k].add_springs(node(end(k)), r, K);
    return energy;
  }

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
  using Shape::saved_;
  using Residual = typename Shape::Parts::Residual;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  using Block = Eigen::Matrix<Scalar, unknowns, unknowns>;
  int end(std::size_t k) const noexcept { return k == 0 ? 0 : elements(); }
  /// The contact that a node has, null: none.
  const detail::RodContact<Scalar>* contact_at(int i) const noexcept {
    if (contact_.holds(i)) return &contact_;
    const auto* const other = others_.at(i);
    return other ? &other->point : nullptr;
  }
  bool is_clamped(std::size_t k) const noexcept {
    return ends_[k].template is_clamped<unknowns == 7>() && !contact_at(end(k));
  }
  /// The axes along which an end's unknowns of place are counted, and those of r'; null: those of space.
  const Matrix* place_axes(int i) const noexcept {
    return contact_at(i) ? nullptr : ends_[i == 0 ? 0 : 1].place_axes();
  }
  const Matrix* tangent_axes(int i) const noexcept { return ends_[i == 0 ? 0 : 1].tangent_axes(); }
  /// What of r, but for the component that d stands for, and of r' is part of d, in units of that component.
  VectorOf<Scalar, 6> share(const detail::RodContact<Scalar>& contact) const noexcept {
    const int i = contact.node(), k = contact.leading();
    const Matrix* const T = i == 0 || i == elements() ? tangent_axes(i) : nullptr;
    VectorOf<Scalar, 6> part;
    part.template head<3>() = along(contact, 1) * contact.normal();
    part.template tail<3>() =
        along(contact, 1) * (T ? Vector3(T->transpose() * contact.arm()) : contact.arm());
    part[k] = 0;
    return part;
  }
  /// d in units of the component that it stands for, or the force along n from one on that component.
  static Scalar along(const detail::RodContact<Scalar>& contact, Scalar x) noexcept {
    return x / contact.normal()[contact.leading()];
  }
  /// What a clamped end has of its own.
  Increment along_end(std::size_t k, Scalar longer) const noexcept {
    Increment x = Increment::Zero();
    x.template segment<3>(3) = longer * ends_[k].direction();
    return x;
  }
  void begin_path() noexcept {
    start_load_ = load_;
    for (std::size_t k = 0; k < 2; ++k) ends_[k].begin(node(end(k)));
  }

  void add_bend(const detail::RodContact<Scalar>& contact) noexcept {
    if (!contact.bends()) return;
    Block K = Block::Zero();
    K.template block<6, 6>(0, 0) = contact.bend();
    assembler_.add_at(contact.node(), K, Increment::Zero());
  }
  void lean(const detail::RodContact<Scalar>& contact) noexcept {
    assembler_.lean(contact.node(), contact.leading(), share(contact));
  }
  /// A way along n in what the node's unknowns of place are then.
  static Vector3 way(const detail::RodContact<Scalar>& contact, Scalar moves) noexcept {
    Vector3 by = moves * contact.normal();
    by[contact.leading()] = along(contact, moves);
    return by;
  }
  template <class Row>
  void hold(const detail::RodContact<Scalar>& contact, Scalar moves, Row& row) noexcept {
    assembler_.hold_along(contact.node(), contact.leading(), way(contact, moves), row);
  }
  template <class Other>
  void hold(Other& other) noexcept {
    other.moves = other.d - other.point.displacement();
    hold(other.point, other.moves, other.row);
    const Vector3 by = way(other.point, other.moves);
    const auto tell = [&](auto& row) {
      for (int k = 0; k < 3; ++k) assembler_.know(other.point.node(), k, by[k], row);
    };
    tell(assembler_.held());
    for (auto& before : others_) {
      if (&before == &other) break;
      tell(before.row);
    }
  }

  /// To the axes of an end, and what they hold is prescribed.
  void hold_end(std::size_t k) noexcept {
    const int i = end(k);
    if (is_clamped(k)) {
      prescribed_[k] = ends_[k].template way<Increment>(node(i));
      assembler_.clamp(i, ends_[k].direction(), prescribed_[k]);
      return;
    }
    transform(i);
    if (const auto* const contact = contact_at(i)) lean(*contact);
    prescribed_[k].setZero();
    ends_[k].template visit<unknowns == 7>(node(i), [&](int component, Scalar increment) {
      prescribed_[k][component] = increment;
      assembler_.prescribe(i, component, increment);
    });
  }
  void transform(int i) noexcept {
    if constexpr (unknowns == 7)
      if (const auto* const joint = this->joint(i)) {
        Block K = Block::Zero();
        K.template block<3, 3>(3, 3) = assembler_.residual(i, 6) * joint->bow(node(i));
        assembler_.add_at(i, K, Increment::Zero());
        assembler_.template lean<6, 3>(i, joint->arm(node(i)));
      }
    const Matrix *const R = place_axes(i), *const T = tangent_axes(i);
    if (R) assembler_.template turn<0>(i, *R);
    if (T) assembler_.template turn<3>(i, *T);
  }
  /// The end at node i where it is a joint that holds the twist.
  const detail::RodEnd<Scalar>* joint(int i) const noexcept {
    for (std::size_t k = 0; k < 2; ++k)
      if (i == end(k) && ends_[k].is_joint()) return &ends_[k];
    return nullptr;
  }

  void turn_chords() noexcept {
    Vector3 way = increments_[0].template segment<3>(0),
            r = node(0).r;  // that the last node has gone, and where it was
    rod_.nodes()[0].r += way;
    for (int i = 1; i <= elements(); ++i) {
      const Increment before = increments_[i - 1], x = increments_[i];
      Node& to = rod_.nodes()[i];
      const Vector3 chord = to.r - r, change = x.template segment<3>(0) - before.template segment<3>(0);
      way += detail::turned(chord, change) - chord;
      r = to.r;
      to.r += way;
    }
  }
  /// Shares out what the chain misses of a held right end.  A left end that is not held moves all of it.
  void close_chain() noexcept {
    const Vector3 miss = ends_[1].miss(node(elements()));
    const bool left = ends_[0].is_anchored();
    for (Node& to : rod_.nodes()) to.r += left ? Vector3(miss * (to.s / length_)) : miss;
  }

  /// Friction, at the place that is touched.
  void add_friction(const detail::RodContact<Scalar>& contact, const Friction& friction) noexcept {
    const Node& n = node(contact.node());
    Eigen::Matrix<Scalar, 3, 6> moves;  // that place, by r and r'
    moves.template leftCols<3>().setIdentity();
    moves.template rightCols<3>().setZero();
    if (contact.round()) {
      const auto view = contact.view(n);
      moves.template rightCols<3>() =
          (view.u.dot(view.f) * Matrix::Identity() - view.u * view.f.transpose()) / view.length;
    }
    Increment r = Increment::Zero();
    Block K = Block::Zero();
    r.template head<6>() = -moves.transpose().lazyProduct(friction.force());
    const Eigen::Matrix<Scalar, 3, 6> stiff = friction.tangent().lazyProduct(moves);
    K.template block<6, 6>(0, 0) = moves.transpose().lazyProduct(stiff);
    assembler_.add_at(contact.node(), K, r);
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
  Assembler<Scalar, Elements, MaxElements, unknowns> assembler_;
  std::array<detail::RodEnd<Scalar>, 2> ends_;
  Increment prescribed_[2] = {Increment::Zero(), Increment::Zero()};
  Scalar moves_ = 0;
  bool no_mechanism_ = false;  // its ends and springs hold it
  Scalar size_ = 0, potential_ = 0, inner_energy_ = 0, unit_;
};

namespace detail {

template <class Element>
struct SystemOf<Element, std::enable_if_t<dimension_of<Element> == 3>> {
  using Body = Rod;
  using Side = RodSide;
  using Pose = RodPose;
  template <typename Scalar, int Elements, int MaxElements,
            template <typename, int, int, int> class Assembler>
  using System = RodSystem<Element, Scalar, Elements, MaxElements, Assembler>;
  template <typename Scalar>
  using Range = RodRange<Scalar>;
  template <typename Scalar>
  using Round = Capsule<Scalar>;
  template <typename Scalar>
  using RoundContact = RodRoundContact<Scalar>;
};

}  // namespace detail

}  // namespace hapbeam
