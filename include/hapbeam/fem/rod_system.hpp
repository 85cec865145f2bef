// SPDX-License-Identifier: MIT
// A rod in space as a chain of elements: how they are assembled, how its nodes move, and what its ends hold.
//
// RodSystem is its equations (system.hpp): r, r' and, with twist, φ of every node are unknowns.  Those of an
// end are those in its own axes, d1, d2 and tangent, where what a clamp holds are components.
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <hapbeam/body/touched_rod.hpp>
#include <hapbeam/fem/beam_system.hpp>
#include <hapbeam/fem/rod/end_path.hpp>
#include <hapbeam/fem/rod/rod_dynamics.hpp>
#include <hapbeam/fem/rod/rod_elements.hpp>
#include <hapbeam/fem/rod/rod_ends.hpp>
#include <hapbeam/fem/rod/rod_motion.hpp>

namespace hapbeam {

template <class ElementType, typename ScalarType, int Elements, int MaxElements>
class RodChain {
 public:
  using Element = ElementType;
  using Scalar = ScalarType;
  using Body = Rod;
  using Parts = RodElements<Element, Scalar, Elements, MaxElements>;
  using Node = typename Parts::Node;
  using Nodes = typename Parts::Nodes;
  using Vector3 = VectorOf<Scalar, 3>;
  using RoundContact = detail::RodRoundContact<Scalar>;
  using Friction = detail::ContactFriction<Scalar, 3, detail::RodRoundContact>;
  using Assembler = detail::AssemblerOf<Element, Scalar, Elements, MaxElements>;
  using Drawn = detail::DrawnMesh<Node, Elements, MaxElements, contacts_of<Element>>;
  using Inertia = detail::RodInertia<Scalar, Elements, MaxElements, Element::unknowns, Assembler>;
  using Viscosity = detail::ViscousRod<Element, Scalar, Elements, MaxElements>;
  using LedEnds = detail::LedEnds<RodChain>;
  static constexpr int unknowns = Element::unknowns;
  using Increment = VectorOf<Scalar, unknowns>;

  /// @param number  of elements   @throws std::invalid_argument as RodElements
  RodChain(const Rod& rod, int number)
      : parts_(rod, number),
        increments_(number),
        ends_(rod, parts_.nodes()),
        length_(static_cast<Scalar>(rod.length())),
        axial_(static_cast<Scalar>(rod.stiffness().axial)) {}
  /// Places the right end, where that is not the end of the natural shape.
  void place_right(const Rod& rod) noexcept {
    if (rod.right_pose()) ends_[1].place_home(*rod.right_pose());
  }
  /// EI about the axis that bends most easily [N·m²]
  static double bending(const Rod& rod) noexcept {
    return (std::min)(rod.stiffness().bending1, rod.stiffness().bending2);
  }

  Parts& parts() noexcept { return parts_; }
  const Parts& parts() const noexcept { return parts_; }
  /// Of what it is in motion with; null: at rest.
  void move_with(Inertia* inertia, const Viscosity*) noexcept { inertia_ = inertia; }
  bool in_motion() const noexcept { return inertia_ != nullptr; }

  // Nodes of ChainSystem's states.

  static void go_on(Nodes& now, Nodes& before, Scalar ratio) noexcept {
    detail::go_on<unknowns == 7>(now, before, ratio);
  }
  static void carry(const Node& x, Node& from, const Node& to) noexcept {
    from.r = x.r - (to.r - from.r);
    from.tangent = x.tangent - (to.tangent - from.tangent);
    from.director = x.director - (to.director - from.director);
  }
  /// Those of another scalar.
  template <class Other>
  static void take_node(const Other& from, Node& to) noexcept {
    to = {to.s, from.r.template cast<Scalar>(), from.tangent.template cast<Scalar>(),
          from.director.template cast<Scalar>()};
  }
  /// The shape of the same rod on another mesh, its ends where they are held there.
  void take_shape(const RodChain& other) noexcept {
    for (Node& node : parts_.nodes()) node = other.node_at(node.s);
    parts_.find_twists([&](Scalar s) { return other.node_at(s).director; });
    parts_.find_tensions();
    for (std::size_t k = 0; k < 2; ++k) ends_[k] = other.ends_[k];
  }
  static const Vector3& displacement(const RodPoint<Scalar>& at) noexcept { return at.r; }
  static Vector3 middle(const RodPoint<Scalar>& at) noexcept { return at.r; }
  /// Turned by more than 114° between them, or squeezed there as no rod is that may bend: to less than 0.7 of its length.
  static bool folds(const Node& a, const Node& b) noexcept {
    const Scalar along = a.tangent.dot(b.tangent), first = a.tangent.squaredNorm(),
                 second = b.tangent.squaredNorm();
    return (std::min)(first, second) < Scalar(0.5) ||
           (along < 0 && along * along > Scalar(0.16) * first * second);
  }
  /// By which an increment turns a node [rad].
  static Scalar turn(const Node& node, const Increment& x) noexcept {
    const Vector3 u = detail::unit(node.tangent), t = x.template segment<3>(3);
    Scalar square = (t - u.dot(t) * u).squaredNorm();
    if constexpr (unknowns == 7) square += x[6] * x[6];
    return std::sqrt(square);
  }
  /// Moves and turns a node by so much.
  static void bend(Node& node, const Vector3& by, const Vector3& slope) noexcept {
    node.r += by;
    detail::set_tangent<Scalar>(node, node.tangent + slope);
  }
  /// Where the mesh has none, in element e, which holds s.
  Node node_within(int e, Scalar s) const noexcept { return parts_.node_within(e, s); }
  Node node_at(Scalar s) const noexcept { return node_within(parts_.view(parts_.nodes()).segment_at(s), s); }
  /// That of a contact, in element e.   @param off  from what touches it
  template <class Contact>
  Node mark(int e, const Contact& contact, const Vector3& off) const noexcept {
    const Node& left = node(e);
    return {contact.s, contact.place - off, contact.tangent,
            detail::across(parts_.director_within(e, (contact.s - left.s) / (node(e + 1).s - left.s)),
                           detail::unit(contact.tangent))};
  }

  detail::RodEnds<Scalar, unknowns>& ends() noexcept { return ends_; }
  const detail::RodEnds<Scalar, unknowns>& ends() const noexcept { return ends_; }
  /// They belong where they do at rest.
  void go_home() noexcept {
    for (std::size_t k = 0; k < 2; ++k) ends_[k].go_home();
  }
  /// Places an end anew: where the next path leads.  @param k  0: left, 1: right
  /// @return false where it is neither clamped nor on springs, or the pose is none: nothing has changed
  bool place_end(std::size_t k, RodPose pose) noexcept {
    if (!takes(k, pose)) return false;
    ends_[k].place(pose);
    return true;
  }
  /// Whether an end can be there.  So far away that places keep no digits of the rod's shape it cannot.   @param pose  in and out, becomes valid
  bool takes(std::size_t k, RodPose& pose) const noexcept {
    const double farthest = 1e6 * static_cast<double>(node(parts_.size()).s);
    return ends_[k].takes_pose() && pose.make_valid() && pose.at.squaredNorm() <= farthest * farthest;
  }
  /// Of how sharply a force may bend element e beside an end.
  detail::SharpestBend<Scalar> sharpest(int e) const noexcept {
    const RodProperties<Scalar>& p = parts_.properties(e);
    return {4 * p.softest(), 16 / p.axial};
  }
  bool holds_end(std::size_t k) const noexcept { return ends_[k].holds_place(); }
  /// What holds an end.   @param load  λ   @param inertia  null: at rest
  template <class Rows>
  HeldEnd<Scalar> reaction(std::size_t k, Scalar load, const Rows& rows, const Inertia* inertia = nullptr,
                           const Viscosity* = nullptr) const noexcept {
    Residual r;
    const int e = k == 0 ? 0 : parts_.size() - 1;
    parts_.residual(e, load, r);
    if (rows.in(e)) r += touched(rows, e);
    Increment at = r.template segment<unknowns>(k == 0 ? 0 : unknowns);
    if (inertia) at += inertia->force(parts_.nodes(), ends_.node(k));
    return {at.template segment<3>(0), parts_.moment(at, node(ends_.node(k)).tangent),
            parts_.overdrawn() ? Status::out_of_range : Status::ok};
  }

  // Its equations.

  /// A round rod that is bowed may roll, but for round-off.
  static constexpr Scalar neutral() noexcept { return Scalar(1e-6); }
  /// That of places, which stretches the shortest element, and of what is in motion is inertia [√J].
  Scalar round_off(Scalar) const noexcept {
    const int n = parts_.size();
    const Scalar shortest = (std::min)(node(1).s, length_ - node(n - 1).s),
                 farthest = std::sqrt(node(0).r.squaredNorm()) + length_;
    const Scalar off = std::numeric_limits<Scalar>::epsilon() * farthest,
                 stretches = off * std::sqrt(axial_ * static_cast<Scalar>(n) / shortest);
    return inertia_ ? (std::max)(stretches, inertia_->round_off(off)) : stretches;
  }
  /// Residual and tangent of all elements.
  template <class Rows>
  [[gnu::always_inline]] detail::ChainEnergies<Scalar> assemble(Scalar load, Rows& rows,
                                                                Assembler& assembler) noexcept {
    auto [strain, work, all] =
        parts_.visit_tangents(load, [&](int first, auto& K, auto& r) { assembler.add_pairs(first, K, r); });
    Scalar energy = strain, inner = all;
    // Where it is touched, its tension has its equation there.
    if (rows.any() && parts_.taut())
      detail::each_touched(rows, [&](int e) { inner -= parts_.inner(e).tension.energy(); });
    if (parts_.has_more()) {
      const auto [stored, done] = add_more(load, assembler);
      energy += stored, work += done;
    }
    energy += ends_.visit_springs(
        parts_.nodes(), [&](int i, const Block& K, const Increment& r) { assembler.add_at(i, K, r); });
    if (rows.any()) energy += add_contacts(rows, assembler);
    if (inertia_) energy += inertia_->add(parts_.nodes(), assembler);
    // Without stress round-off has either sign.
    return {energy, work, inner, (std::max)(energy, Scalar(0)) + (inertia_ ? inertia_->scale() : Scalar(0))};
  }
  Increment increment(const Assembler& assembler, int i) const noexcept {
    const Increment x = assembler.increment(i);
    return ends_.has(i) ? ends_.increment(x, i, node(i)) : x;
  }
  /// Adds the increment of the last equations: what turns keeps its length.  Without a contact the chords turn as the tangents do, from the
  /// left end on (laid_beam.hpp).   @return by how much the increment is longer than its nodes alone say [J]
  template <class Rows, class ElementAt>
  Scalar advance(const Assembler& assembler, Rows& rows, ElementAt&& element_at) noexcept {
    increments_.take(assembler);
    for (std::size_t k = 0; k < 2; ++k)
      if (const int i = ends_.node(k); ends_.has(i)) increments_.set(i, increment(assembler, i));
    const bool free = !rows.any() && !inertia_;
    Scalar longer = 0;
    if (free) detail::turn_chords(parts_.nodes(), increments_);
    parts_.advance_inners(increments_, [&](int e) { return rows.in(e); });
    if (!free)
      longer = rows.advance(
          [this](int e) {
            Residual both;
            both.template head<unknowns>() = increments_[e];
            both.template tail<unknowns>() = increments_[e + 1];
            return both;
          },
          [this](int e, Scalar N) {
            if (parts_.taut()) parts_.set_tension(e, N);
          },
          element_at);
    detail::move_nodes<unknowns == 7>(parts_.nodes(), increments_, !free);
    if (free) ends_.close_chain(parts_.nodes(), length_);
    ends_.correct(parts_.nodes());
    return longer;
  }
  /// Takes another shape of the same rod.
  void lay(const Centreline<Scalar, 3>& shape) noexcept {
    for (Node& node : parts_.nodes()) {
      const RodPoint<Scalar> at = shape.at(node.s);
      node.r = at.r;
      if (unknowns == 7) node.tangent = at.tangent, node.director = director_of(shape, node.s);
      else detail::set_tangent<Scalar>(node, at.tangent);
    }
    parts_.find_twists([&](Scalar s) { return director_of(shape, s); });
    parts_.relax_twists();
    parts_.find_tensions();
  }
  /// A node that goes from place, tangent and twist to others.
  static Node moved(const Node& node, const typename Inertia::Placed& from,
                    const typename Inertia::Placed& to) noexcept {
    Node there = node;
    there.r = to.template head<3>();
    detail::set_tangent<Scalar>(there, to.template segment<3>(3));
    if constexpr (unknowns == 7)
      there.director =
          detail::turn<Scalar>(there.director, detail::unit(there.tangent), Scalar(to[6] - from[6]));
    return there;
  }
  /// Bends it a little, without a contact to where its loads push.   @param contact  its place, negative: none
  void nudge(Scalar size, Scalar contact, Scalar load) noexcept {
    const Node& middle = node(parts_.size() / 2);
    const Vector3 d1 = middle.director, d2 = detail::cross3(detail::unit(middle.tangent), d1);
    // Without loads along the director and half as much across it.
    Vector3 way = d1 + d2 / 2;
    if (contact < 0 && parts_.loaded(load)) {
      const Vector3 pushed = pushed_by(size, d1, load) * d1 + pushed_by(size, d2, load) * d2;
      // A flat rod may stand aside across that alone.
      if (const Scalar most = pushed.norm(); most > 0) way = pushed / most + way / 100;
    }
    bow(size * way, contact < 0 ? contact : contact / length_);
    ends_.correct(parts_.nodes());
  }

  // What it carries.

  /// That of its springs included, and not what contacts bend of the elements alone [J].
  template <class Touched>
  Scalar strain_energy(Touched&&) const noexcept {
    return parts_.strain_energy() +
           ends_.visit_springs(parts_.nodes(), [](int, const Block&, const Increment&) {});
  }
  /// What the section carries, in element e, as it lies, with what touches it.   @param curve  s -> node on it
  template <class Rows, class Curve>
  InternalForces<Scalar, 3> internal_forces(const Rows& rows, int e, const detail::CutAt<Scalar>& at,
                                            Scalar load, Scalar, Curve&& curve) const noexcept {
    return parts_.internal_forces(e, at, load, curve, [&](auto&& touch) {
      for (int k = 0; k < rows.size(); ++k)
        if (const auto& contact = rows[k]; rows.element(k) == e)
          touch(contact.s, Vector3(contact.force * contact.normal + contact.friction), contact.place);
    });
  }

 private:
  using Residual = typename Parts::Residual;
  using Block = Eigen::Matrix<Scalar, unknowns, unknowns>;
  const Node& node(int i) const noexcept { return parts_.nodes()[i]; }
  /// Residual and tangent of an elastic foundation and of moments.  Not inlined by intent.   @return energy, and work of λ times the moments [J]
  [[gnu::noinline]] std::array<Scalar, 2> add_more(Scalar load, Assembler& assembler) noexcept {
    return {parts_.visit_foundation(
                [&](int e, const auto& K, const Residual& r) { assembler.add_more(e, K, r); }),
            parts_.visit_moments(
                load, [&](int i, const Block& K, const Increment& r) { assembler.add_at(i, K, r); })};
  }
  /// Residual and tangent of contacts within elements.  Not inlined by intent.   @return their energy [J]
  template <class Rows>
  [[gnu::noinline]] Scalar add_contacts(Rows& rows, Assembler& assembler) noexcept {
    Scalar energy = 0;
    rows.seek(parts_);
    detail::each_touched(rows, [&](int e) {
      Residual r;
      typename Rows::Tangent K;
      energy += rows.touch(parts_, e, r, K);
      assembler.add_more(e, K, r);
    });
    return energy;
  }
  /// What contacts add to the residual of an element that they touch, as it lies.
  template <class Rows>
  Residual touched(const Rows& rows, int e) const noexcept {
    Residual r = rows.residual(parts_, e);
    // Its tension, which they have changed, was condensed without them.
    const auto inner = parts_.inner(e).tension;
    if (parts_.taut()) r -= (inner.residual / inner.stiffness) * inner.row;
    return r;
  }
  /// The director of a shape at s: between two nodes it turns evenly against one that is carried.
  static Vector3 director_of(const Centreline<Scalar, 3>& shape, Scalar s) noexcept {
    const int i = shape.segment_at(s);
    const Node &a = shape[i], &b = shape[i + 1];
    const Vector3 u = detail::unit(a.tangent), v = detail::unit(b.tangent),
                  t = detail::unit(shape.at(i, s).tangent),
                  carried = detail::across<Scalar>(detail::carry(a.director, u, v), v);
    const Scalar angle = detail::angle_about(v, carried, b.director) * (s - a.s) / (b.s - a.s);
    return detail::turn<Scalar>(detail::across<Scalar>(detail::carry(a.director, u, t), t), t, angle);
  }
  /// Bends it a little.
  /// @param e  how far and where to [m]   @param c  where the bow changes its side, of the length; negative: nowhere
  void bow(const Vector3& e, Scalar c) noexcept {
    for (Node& node : parts_.nodes()) {
      const Scalar t = node.s / length_, q = 1 - t, f = 16 * t * t * q * q,
                   g = c < 0 ? (3 + t) / Scalar(3.5) : 4 * (t - c),
                   slope = 32 * t * q * (1 - 2 * t) * g + f * (c < 0 ? 1 / Scalar(3.5) : Scalar(4));
      node.r += f * g * e;
      detail::set_tangent<Scalar>(node, node.tangent + slope / length_ * e);
    }
  }
  /// The part of the work of its loads that changes its sign with a bow; 0 where it is round-off [J].
  Scalar pushed_by(Scalar size, const Vector3& d, Scalar load) noexcept {
    bow(size * d, -1);
    const Scalar there = parts_.work(load);
    bow(-2 * size * d, -1);
    const Scalar back = parts_.work(load);
    bow(size * d, -1);
    const Scalar round_off = std::sqrt(std::numeric_limits<Scalar>::epsilon());
    return std::abs(there - back) > round_off * (std::abs(there) + std::abs(back)) ? there - back : Scalar(0);
  }

  Parts parts_;
  detail::ChainIncrements<Scalar, Elements, MaxElements, unknowns> increments_;  // in advance()
  detail::RodEnds<Scalar, unknowns> ends_;
  Scalar length_, axial_;
  Inertia* inertia_ = nullptr;  // of what it is in motion with
};

template <class Element, typename Scalar, int Elements, int MaxElements>
using RodSystem = ChainSystem<RodChain<Element, Scalar, Elements, MaxElements>>;

namespace detail {

template <class Element, typename Scalar, int Most>
struct TouchedOf<Element, Scalar, Most, std::enable_if_t<dimension_of<Element> == 3>> {
  using Type = TouchedRod<Element, Scalar, Most>;
};

template <class Element>
struct SystemOf<Element, std::enable_if_t<dimension_of<Element> == 3>> {
  using Body = Rod;
  using Side = RodSide;
  using Pose = RodPose;
  template <typename Scalar, int Elements, int MaxElements>
  using System = RodSystem<Element, Scalar, Elements, MaxElements>;
};

}  // namespace detail

}  // namespace hapbeam
