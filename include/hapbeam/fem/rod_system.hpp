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
#include <hapbeam/fem/rod_contact.hpp>
#include <hapbeam/fem/rod_elements.hpp>
#include <hapbeam/fem/rod_end.hpp>
#include <hapbeam/fem/rod_motion.hpp>
#include <hapbeam/fem/rod_range.hpp>
#include <hapbeam/fem/rod_round_contact.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements,
          template <typename, int, int, int> class Assembler>
class RodSystem {
  using Parts = RodElements<Element, ScalarType, Elements, MaxElements>;

 public:
  using Scalar = ScalarType;
  using Body = Rod;
  using Node = RodNode<Scalar>;
  using Nodes = typename Parts::Nodes;
  using Inners = typename Parts::Inners;
  using Vector3 = VectorOf<Scalar, 3>;
  static constexpr int unknowns = Element::unknowns;
  using Increment = VectorOf<Scalar, unknowns>;

  /// @throws std::invalid_argument as RodElements
  RodSystem(const Rod& rod, int elements)
      : rod_(rod, elements),
        saved_(elements),
        assembler_(elements),
        ends_{detail::RodEnd<Scalar>(rod.left(), node(0)),
              detail::RodEnd<Scalar>(rod.right(), node(elements))},
        length_(static_cast<Scalar>(rod.length())),
        unit_(static_cast<Scalar>(
            std::sqrt((std::min)(rod.stiffness().bending1, rod.stiffness().bending2) / rod.length()))) {
    if (rod.right_pose()) ends_[1].place(*rod.right_pose());
  }

  int elements() const noexcept { return rod_.size(); }
  Scalar length() const noexcept { return length_; }
  Centreline<Scalar, 3> centreline() const noexcept { return view(rod_.nodes()); }
  Centreline<Scalar, 3> view(const Nodes& nodes) const noexcept { return rod_.view(nodes); }
  const Node& node(int i) const noexcept { return rod_.nodes()[i]; }
  const Inners& inners() const noexcept { return rod_.inners(); }

  /// Moves to another mesh of as many elements and carries the shape over.
  void remesh(const ContactMesh<Scalar>& mesh) noexcept {
    if (!(mesh == rod_.mesh())) rod_.remesh(mesh, saved_.nodes, saved_.inners);
  }
  const ContactMesh<Scalar>& mesh() const noexcept { return rod_.mesh(); }
  /// What changes as the rod moves.
  struct State {
    explicit State(int elements) : nodes(elements), inners(elements) {}
    Nodes nodes;
    Inners inners;
  };
  Centreline<Scalar, 3> view(const State& state) const noexcept { return view(state.nodes); }
  /// The state as it is.  @param state  out
  void keep(State& state) const noexcept {
    for (int i = 0; i <= elements(); ++i) state.nodes[i] = node(i), state.inners[i] = rod_.inners()[i];
  }
  void set_state(const ContactMesh<Scalar>& mesh, const State& state) noexcept {
    rod_.set(mesh, state.nodes, state.inners);
    force_ = linear_reaction_ = 0;
  }
  /// That of the same system in another scalar, on the uniform mesh.
  template <class Other>
  void take_state(const Other& other) noexcept {
    const ContactMesh<Scalar> uniform(elements(), length_);
    const auto vector = [](const auto& x) { return Vector3(x.template cast<Scalar>()); };
    for (int i = 0; i <= elements(); ++i) {
      const auto& n = other.node(i);
      saved_.nodes[i] = {uniform.position(i), vector(n.r), vector(n.tangent), vector(n.director)};
      if constexpr (unknowns == 7) saved_.inners[i].twist = static_cast<Scalar>(other.inners()[i].twist);
    }
    set_state(uniform, saved_);
  }
  /// n · r of a state at s [m].
  Scalar displacement(const State& state, Scalar s, const Vector3& normal) const noexcept {
    return normal.dot(view(state).at(s).r);
  }
  Scalar displacement(Scalar s, const Vector3& normal) const noexcept {
    return normal.dot(centreline().at(s).r);
  }
  /// Where the middle of the rod is [m].
  Vector3 middle() const noexcept { return centreline().at(length_ / 2).r; }
  /// Whether an element has turned so far in itself that it no longer stands for a rod.
  bool folded() const noexcept {
    for (int i = 0; i < elements(); ++i)
      if (detail::unit(node(i).tangent).dot(detail::unit(node(i + 1).tangent)) < Scalar(-0.4)) return true;
    return false;
  }
  /// Places an end anew: where the next path leads.  @param k  0: left, 1: right
  /// @return false where it is not clamped, or the pose is none: nothing has changed
  bool place_end(std::size_t k, RodPose pose) noexcept {
    const bool valid = ends_[k].is_clamped() && pose.make_valid();
    if (valid) ends_[k].place(pose);
    return valid;
  }

  /// Where the path ends: all of the dead loads, the ends where they are placed, and no contact.
  void set_goal() noexcept {
    contact_ = {};
    begin_path();
  }
  /// The same with a contact: d = n · r at its node or, beside an end that yields, at a distance on a straight tip.
  /// @param contact node   @param d [m]   @param lever [m] from the node to the contact along the rod   @param normal n, unit
  void set_goal(int contact, Scalar d, Scalar lever, const Vector3& normal) noexcept {
    contact_ = {contact, lever, normal};
    start_d_ = contact_displacement();
    goal_d_ = d;
    begin_path();
  }
  /// The same with a capsule that the rod touches beside the node: d = -reach is then the wanted distance of its axis.
  void set_goal(int contact, Scalar d, const detail::CapsuleOnCurve<Scalar>& capsule) noexcept {
    contact_ = {contact, capsule};
    start_d_ = contact_displacement();
    goal_d_ = d;
    begin_path();
  }
  /// How that capsule lies to the contact's node.
  auto contact() const noexcept { return contact_.view(node(contact_.node())); }

  // What NewtonRaphson asks of a system.

  void set_target(Scalar t) noexcept {
    const auto between = [t](Scalar start, Scalar goal) { return t < 1 ? start + t * (goal - start) : goal; };
    load_ = between(start_load_, 1);
    d_ = between(start_d_, goal_d_);
    for (auto& end : ends_) end.set_target(t);
  }
  void save() noexcept {
    keep(saved_);
    saved_load_ = load_;
    saved_reaction_ = linear_reaction_;
  }
  void restore() noexcept {
    for (int i = 0; i <= elements(); ++i)
      rod_.nodes()[i] = saved_.nodes[i], rod_.inners()[i] = saved_.inners[i];
    load_ = saved_load_;
    force_ = linear_reaction_ = saved_reaction_;
  }
  Scalar size() const noexcept { return size_; }
  Scalar unit() const noexcept { return unit_; }

  /// The tangent holds what the contact's force makes of a capsule, on the way down as well: there a rod slips around a sphere.
  void forget_force() noexcept {}

  Iteration<Scalar> iterate() noexcept {
    const Status status = factor(0);
    if (status != Status::ok) return {status, 0};
    advance();
    linear_reaction_ = force_;
    return {status, increment()};
  }

  // What Descent asks beyond that: the two halves of an iteration.

  /// Assembles and solves for an increment, and leaves the state as it is.
  /// @param shift  what is added to the tangent: so many times EI/L³ on each place and EI/L on each rotation, shared out
  /// over the nodes   @return ok | singular | non_finite
  Status factor(Scalar shift) noexcept {
    using Residual = typename Parts::Residual;
    using Tangent = typename Parts::Tangent;
    Scalar energy = 0, work = 0;
    inner_energy_ = 0;
    const int c = contact_.node();
    if (c >= 0) contact_.look(node(c), force_);
    rod_.visit_tangents(load_, [&](int e, const auto& energies, Residual& r, Tangent& K) {
      energy += energies.strain;
      work += energies.work;
      inner_energy_ += rod_.inners()[e].energy();
      if (shift != 0) add_shift(shift, e, K);
      if (e == 0) energy += add_springs(ends_[0], node(0), 0, r, K);
      if (e + 1 == elements()) energy += add_springs(ends_[1], node(e + 1), unknowns, r, K);
      if (contact_.holds(e + 1)) contact_.bend(unknowns, K);
      else if (e == 0 && contact_.holds(0)) contact_.bend(0, K);
      if (own_axes(e)) transform(e, 0, r, K);
      if (own_axes(e + 1)) transform(e + 1, unknowns, r, K);
      assembler_.add(e, K, r);
    });
    size_ = std::sqrt(2 * energy);
    potential_ = energy - work;
    for (std::size_t k = 0; k < 2; ++k) {
      prescribed_[k].setZero();
      ends_[k].visit(node(end(k)), [&](int component, Scalar increment) {
        if (component >= unknowns) return;
        prescribed_[k][component] = increment;
        assembler_.prescribe(end(k), component, increment);
      });
    }
    moves_ = 0;
    if (c >= 0) assembler_.hold(c, 2, moves_ = d_ - contact_.displacement());
    return assembler_.solve();
  }
  /// Adds the increment to the state: what turns keeps its length.  Without a contact, which would be missed, the chords turn
  /// as the tangents do, from the left end on (as chain.hpp says of the plane).
  void advance() noexcept {
    force_ = contact_.node() < 0 ? Scalar(0) : assembler_.reaction();
    Increment before = increment(0);
    Vector3 way = before.template segment<3>(0),
            r = node(0).r;  // that the last node has gone, and where it was
    rod_.nodes()[0].r += way;
    detail::move_tangent(rod_.nodes()[0], before);
    for (int i = 1; i <= elements(); ++i) {
      const Increment x = increment(i);
      typename Parts::Residual both;
      both << before, x;
      rod_.inners()[i - 1].advance(both);
      Node& node = rod_.nodes()[i];
      const Vector3 chord = node.r - r, change = x.template segment<3>(0) - before.template segment<3>(0);
      way += contact_.node() < 0 ? Vector3(detail::turned(chord, change) - chord) : change;
      r = node.r;
      node.r += way;
      detail::move_tangent(node, x);
      before = x;
    }
    if (contact_.node() < 0) close_chain();
    for (std::size_t k = 0; k < 2; ++k) ends_[k].correct(rod_.nodes()[end(k)]);
    if (contact_.node() >= 0) contact_.correct(rod_.nodes()[contact_.node()], d_);
  }
  /// Size of the last increment in the norm of the tangent [√J].
  Scalar increment() const noexcept {
    return std::sqrt(std::abs(assembler_.energy()) + std::abs(inner_energy_));
  }
  /// V - λ f · x before the last increment was added [J].
  Scalar potential() const noexcept { return potential_; }
  int negative_pivots() const noexcept { return assembler_.negative_pivots(); }
  /// Bends the rod a little where nothing makes it leave an equilibrium: along the director in its middle and half as much
  /// across that.  @param size  [m]
  void nudge(Scalar size) noexcept {
    const Node& middle = node(elements() / 2);
    const Vector3 e = middle.director + detail::cross3(middle.tangent, middle.director) / 2;
    const Scalar c = contact_.node() < 0 ? Scalar(-1) : node(contact_.node()).s / length_;
    for (Node& node : rod_.nodes()) {
      const Scalar t = node.s / length_, q = 1 - t, f = 16 * size * t * t * q * q,
                   g = c < 0 ? (3 + t) / Scalar(3.5) : 4 * (t - c),
                   slope = 32 * size * t * q * (1 - 2 * t) * g + f * (c < 0 ? 1 / Scalar(3.5) : Scalar(4));
      node.r += f * g * e;
      detail::set_tangent<Scalar>(node, node.tangent + slope / length_ * e);
    }
    for (std::size_t k = 0; k < 2; ++k) ends_[k].correct(rod_.nodes()[end(k)]);
  }

  // What LoadPath asks beyond that.

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
    for (std::size_t k = 0; k < 2; ++k)
      if (i == end(k)) x += prescribed_[k];
    if (contact_.holds(i)) x[2] += moves_;
    if (!own_axes(i)) return x;
    const Matrix *const R = place_axes(i), *const T = tangent_axes(i);
    if (contact_.holds(i) && contact_.leans()) x[2] -= arm(T).dot(x.template segment<3>(3));
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

  /// Force along n that holds the contact at d, of the last linear equations [N].
  Scalar linear_reaction() const noexcept { return linear_reaction_; }

  /// What holds an end: force [N] and moment about the end [N·m], in space.
  struct Hold {
    Vector3 force, moment;
  };
  Hold reaction(std::size_t k) const noexcept {
    typename Parts::Residual r;
    rod_.residual(k == 0 ? 0 : elements() - 1, load_, r);
    const Increment at = r.template segment<unknowns>(k == 0 ? 0 : unknowns);
    const Vector3 t = node(end(k)).tangent;
    Vector3 moment = detail::cross3<Scalar>(t, at.template segment<3>(3));
    if constexpr (unknowns == 7) moment += at[6] * detail::unit(t);
    return {at.template segment<3>(0), moment};
  }

  /// Strain energy, that of the springs that hold it included [J].
  Scalar strain_energy() const noexcept {
    Scalar energy = rod_.strain_energy();
    typename Parts::Residual r = Parts::Residual::Zero();
    typename Parts::Tangent K = Parts::Tangent::Zero();
    for (std::size_t k = 0; k < 2; ++k) energy += add_springs(ends_[k], node(end(k)), 0, r, K);
    return energy;
  }

 private:
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  int end(std::size_t k) const noexcept { return k == 0 ? 0 : elements(); }
  bool own_axes(int i) const noexcept { return contact_.holds(i) || i == 0 || i == elements(); }
  /// The axes along which a node's unknowns of place are counted, and those of r'; null: those of space.
  const Matrix* place_axes(int i) const noexcept {
    return contact_.holds(i) ? &contact_.axes() : i == 0 ? ends_[0].place_axes() : ends_[1].place_axes();
  }
  const Matrix* tangent_axes(int i) const noexcept {
    return i == 0 ? ends_[0].tangent_axes() : i == elements() ? ends_[1].tangent_axes() : nullptr;
  }
  /// Of the contact, in the axes of r'.
  Vector3 arm(const Matrix* T) const noexcept {
    return T ? Vector3(T->transpose() * contact_.arm()) : contact_.arm();
  }
  Scalar contact_displacement() noexcept {
    contact_.look(node(contact_.node()), force_);
    return contact_.displacement();
  }

  void begin_path() noexcept {
    start_load_ = load_;
    for (std::size_t k = 0; k < 2; ++k) ends_[k].begin(node(end(k)));
  }

  /// To a node's own axes.  @param at  its first row in the element
  void transform(int i, int at, typename Parts::Residual& r, typename Parts::Tangent& K) const noexcept {
    const auto turn = [&](int k, const Matrix& Q) {
      r.template segment<3>(k) = Q.transpose().lazyProduct(r.template segment<3>(k)).eval();
      const Eigen::Matrix<Scalar, 2 * unknowns, 3> columns = K.template middleCols<3>(k).lazyProduct(Q);
      const Matrix own = Q.transpose().lazyProduct(columns.template middleRows<3>(k));
      K.template middleCols<3>(k) = columns;
      K.template middleRows<3>(k) = columns.transpose();
      K.template block<3, 3>(k, k) = own;
    };
    // An unknown that is its old self and a part of the tangent: what it was is what it is, less that part.
    const auto lean = [&](int unknown, const Vector3& part) {
      for (int j = 0; j < 3; ++j) {
        r[at + 3 + j] -= part[j] * r[at + unknown];
        K.col(at + 3 + j) -= part[j] * K.col(at + unknown);
      }
      for (int j = 0; j < 3; ++j) K.row(at + 3 + j) -= part[j] * K.row(at + unknown);
    };
    if constexpr (unknowns == 7)
      if (const auto* const joint = this->joint(i)) {
        K.template block<3, 3>(at + 3, at + 3) += r[at + 6] * joint->bow(node(i));
        lean(6, joint->arm(node(i)));
      }
    const Matrix *const R = place_axes(i), *const T = tangent_axes(i);
    if (R) turn(at, *R);
    if (T) turn(at + 3, *T);
    if (contact_.holds(i) && contact_.leans()) lean(2, arm(T));
  }
  /// @param at  the end's first row in the element   @return [J]
  static Scalar add_springs(const detail::RodEnd<Scalar>& end, const Node& node, int at,
                            typename Parts::Residual& r, typename Parts::Tangent& K) noexcept {
    if (!end.has_springs()) return 0;
    return end.add_springs(node, r.template segment<unknowns>(at),
                           K.template block<unknowns, unknowns>(at, at));
  }
  /// The end at node i where it is a joint that holds the twist.
  const detail::RodEnd<Scalar>* joint(int i) const noexcept {
    for (std::size_t k = 0; k < 2; ++k)
      if (i == end(k) && ends_[k].is_joint()) return &ends_[k];
    return nullptr;
  }

  /// Shares out what the chain misses of a held right end.  A left end that is not held moves all of it.
  void close_chain() noexcept {
    const Vector3 miss = ends_[1].miss(node(elements()));
    const bool left = ends_[0].is_anchored();
    for (Node& node : rod_.nodes()) node.r += left ? Vector3(miss * (node.s / length_)) : miss;
  }

  /// An element's share of the shift, half of it to either node.
  void add_shift(Scalar shift, int e, typename Parts::Tangent& K) const noexcept {
    const Scalar share = shift * unit_ * unit_ * (node(e + 1).s - node(e).s) / (2 * length_),
                 across = share / (length_ * length_);
    for (int k = 0; k < 2 * unknowns; ++k) K(k, k) += k % unknowns < 3 ? across : share;
  }

  Parts rod_;
  State saved_;
  Assembler<Scalar, Elements, MaxElements, unknowns> assembler_;
  std::array<detail::RodEnd<Scalar>, 2> ends_;
  Increment prescribed_[2] = {Increment::Zero(), Increment::Zero()};
  detail::RodContact<Scalar> contact_;
  Scalar moves_ = 0;
  Scalar length_;
  Scalar load_ = 0, saved_load_ = 0, start_load_ = 0;
  Scalar d_ = 0, start_d_ = 0, goal_d_ = 0;
  Scalar size_ = 0, potential_ = 0, inner_energy_ = 0, linear_reaction_ = 0, saved_reaction_ = 0, unit_;
  Scalar force_ = 0;  // of the last tangent's contact
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
