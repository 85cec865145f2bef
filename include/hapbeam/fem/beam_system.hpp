// SPDX-License-Identifier: MIT
// A beam in the plane as a chain of elements: how they are assembled, how its nodes move, and how its ends are held.
//
// BeamSystem is its equations (system.hpp): u, w, θ of every node and the tension N of every element are unknowns.
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <cmath>
#include <limits>

#include <hapbeam/beam.hpp>
#include <hapbeam/fem/beam_elements.hpp>
#include <hapbeam/fem/contact/round_contact.hpp>
#include <hapbeam/fem/dynamics.hpp>
#include <hapbeam/fem/laid_beam.hpp>
#include <hapbeam/fem/system.hpp>
#include <hapbeam/fem/viscosity.hpp>

namespace hapbeam {

template <class ElementType, typename ScalarType, int Elements, int MaxElements>
class BeamChain {
 public:
  using Element = ElementType;
  using Scalar = ScalarType;
  using Body = Beam;
  using Parts = BeamElements<Element, Scalar, Elements, MaxElements>;
  using Node = typename Parts::Node;
  using Nodes = typename Parts::Nodes;
  using RoundContact = detail::RoundContact<Scalar>;
  using Friction = detail::ContactFriction<Scalar, 2, detail::RoundContact>;
  using Assembler = detail::AssemblerOf<Element, Scalar, Elements, MaxElements>;
  using Drawn = detail::DrawnMesh<Node, Elements, MaxElements, contacts_of<Element>>;
  using Inertia = detail::Inertia<Scalar, Elements, MaxElements>;
  using Viscosity = detail::Viscosity<Element, Scalar, Elements, MaxElements>;
  using LedEnds = detail::NoLedEnds<BeamChain>;

  /// @param number  of elements
  /// @throws std::invalid_argument where a load is not finite somewhere on the beam, or the number does not fit the type
  [[gnu::cold]] BeamChain(const Beam& beam, int number)
      : parts_(beam, number), increments_(number), ends_(beam, number) {
    const NaturalShape<Scalar>& natural = parts_.natural_shape();
    const auto stand = [&](Scalar side) {
      detail::lay(natural, ends_[0], ends_[1], parts_.nodes());
      if (natural.straight()) detail::bow(ends_[0], ends_[1], side, parts_.nodes());
      return parts_.work(1);
    };
    const Scalar down = stand(-1), up = stand(1);
    if (detail::push_down(up, down)) stand(-1);
    parts_.find_tensions();
    for (int e = 0; e < number; ++e) {
      const ElementProperties<Scalar>& p = parts_.properties()[e];
      stiffness_ += p.axial_per_length + 12 * p.bending_per_length3;
    }
  }
  /// EI [N·m²]
  static double bending(const Beam& beam) noexcept { return beam.bending_stiffness(); }

  Parts& parts() noexcept { return parts_; }
  const Parts& parts() const noexcept { return parts_; }
  /// Of what it is in motion with; null: at rest.
  void move_with(Inertia* inertia, const Viscosity* viscosity) noexcept {
    inertia_ = inertia, viscosity_ = viscosity;
  }

  // Nodes of ChainSystem's states.

  static void go_on(Nodes& now, Nodes& before, Scalar ratio) noexcept {
    const auto on = [ratio](Scalar x, Scalar was) { return x + ratio * (x - was); };
    for (int i = 0; i < now.size(); ++i) {
      // All four numbers side by side, which takes a third of the instructions: s goes on by nothing.
      Node &x = now[i], &b = before[i];
      const Scalar s = x.s, u = x.u, w = x.w, theta = x.theta;
      x = {on(s, b.s), on(u, b.u), on(w, b.w), on(theta, b.theta)};
      b = {s, u, w, theta};
    }
  }
  static void carry(const Node& x, Node& from, const Node& to) noexcept {
    from = {x.s, x.u - (to.u - from.u), x.w - (to.w - from.w), x.theta - (to.theta - from.theta)};
  }
  /// Those of another scalar.
  template <class Other>
  static void take_node(const Other& from, Node& to) noexcept {
    to = {to.s, static_cast<Scalar>(from.u), static_cast<Scalar>(from.w), static_cast<Scalar>(from.theta)};
  }
  /// The shape of the same beam on another mesh.
  void take_shape(const BeamChain& other) noexcept {
    for (Node& node : parts_.nodes()) node = other.node_at(node.s);
    parts_.find_tensions();
  }
  static Vector2<Scalar> displacement(const Displacement<Scalar>& at) noexcept { return {at.u, at.w}; }
  static VectorOf<Scalar, 1> middle(const Displacement<Scalar>& at) noexcept {
    return VectorOf<Scalar, 1>(at.w);
  }
  static bool folds(const Node& a, const Node& b) noexcept { return std::abs(b.theta - a.theta) > 2; }
  /// By which an increment turns a node [rad].
  static Scalar turn(const Node&, const Vector3<Scalar>& increment) noexcept {
    return std::abs(increment[2]);
  }
  /// Moves and turns a node by so much.
  static void bend(Node& node, const Vector2<Scalar>& by, const Vector2<Scalar>& slope) noexcept {
    const Vector2<Scalar> along = detail::direction(Scalar(-node.theta));
    node.u += by.x(), node.w += by.y();
    node.theta -= along.x() * slope.y() - along.y() * slope.x();
  }
  /// Where the mesh has none, in element e, which holds s.
  Node node_within(int e, Scalar s) const noexcept {
    const Node &a = parts_.nodes()[e], &b = parts_.nodes()[e + 1];
    const bool straight = a.theta == 0 && b.theta == 0 && a.u == b.u && a.w == b.w;
    return straight ? Node{s, a.u, a.w, 0} : parts_.view(parts_.nodes()).node_at(e, s);
  }
  Node node_at(Scalar s) const noexcept { return node_within(parts_.view(parts_.nodes()).segment_at(s), s); }
  /// That of a contact.   @param off  from what touches it
  template <class Contact>
  static Node mark(int, const Contact& contact, const Vector2<Scalar>& off) noexcept {
    const Vector2<Scalar> moved = contact.moved - off;
    return {contact.s, moved.x(), moved.y(), contact.theta};
  }

  detail::BeamEnds<Scalar>& ends() noexcept { return ends_; }
  /// Of how sharply a force may bend element e beside an end.  A hinge lets it turn.
  detail::SharpestBend<Scalar> sharpest(int e) const noexcept {
    const auto& p = parts_.properties()[e];
    return {1 / (p.bending_per_length3 * p.length * p.length * p.length), 48 / p.axial_stiffness};
  }
  bool holds_end(std::size_t k) const noexcept { return ends_[k].held[1] && ends_[k].held[2]; }

  // Its equations.

  static constexpr Scalar neutral() noexcept { return 0; }
  /// By what the round-off of displacements stretches and bends the elements of a beam without stress, and of places what it is to the inertia of
  /// one in motion [√J].   @param state  √(2V)
  Scalar round_off(Scalar state) const noexcept {
    const int n = parts_.size();
    if (inertia_) return inertia_->round_off(std::numeric_limits<Scalar>::epsilon() * parts_.nodes()[n].s);
    const auto moved = [this](int i) {
      return std::abs(parts_.nodes()[i].u) + std::abs(parts_.nodes()[i].w);
    };
    const Scalar off = std::numeric_limits<Scalar>::epsilon() * (moved(0) + moved(n / 2) + moved(n)),
                 energy = stiffness_ * off * off;
    return 16 * state * state <= energy ? std::sqrt(energy) : Scalar(0);
  }
  /// Residual and tangent of all elements.
  template <class Rows>
  [[gnu::always_inline]] detail::ChainEnergies<Scalar> assemble(Scalar load, Rows& rows,
                                                                Assembler& assembler) noexcept {
    using Wide = typename Parts::Wide;
    using Matrix3 = Eigen::Matrix<Scalar, 3, 3>;
    Wide strain = 0;
    Scalar energy = 0, work = 0;
    if (inertia_) energy += inertia_->look(parts_.nodes());
    const bool plain = !parts_.loaded(load) && !viscosity_;
    parts_.visit_tangents([&](int first, Wide& each, Vector6<Wide>& r, Matrix6<Wide>& K) HAPBEAM_INLINED {
      const auto change = [&](int e, int lane) {
        Vector6<Scalar> its;
        Matrix6<Scalar> stiff;
        if (rows.in(e)) each.set(lane, rows.touch(parts_, e, its, stiff)), parts_.leave(e);
        else Parts::get_lane(lane, r, K, its, stiff);
        work += parts_.subtract_loads(e, load, its, &stiff);
        if (viscosity_) energy += viscosity_->add(e, parts_.displacements(e), its, stiff);
        Parts::set_lane(lane, its, stiff, r, K);
      };
      if (!plain) parts_.for_each_lane(first, change);
      else
        detail::each_touched(rows, [&](int e) {
          if (const int lane = parts_.place(e) - first; lane >= 0 && lane < Parts::lanes) change(e, lane);
        });
      if (inertia_) inertia_->add(first, r, K);
      parts_.add(first, each, strain);
      assembler.add_pairs(first, K, r);
    });
    if (inertia_) {
      Matrix3 K = Matrix3::Zero();
      Vector3<Scalar> r = Vector3<Scalar>::Zero();
      inertia_->add_last(r, K);
      assembler.add_at(parts_.size(), K, r);
    }
    energy += total(strain);
    // Where tensions are far from those of the nodes the energy has either sign.
    return {energy, work, 0, std::abs(energy) + (inertia_ ? inertia_->scale() : Scalar(0))};
  }
  static Vector3<Scalar> increment(const Assembler& assembler, int i) noexcept {
    return assembler.increment(i);
  }
  /// Adds the increment of the last equations.   @return as of BeamElements::follow() [J]
  template <class Rows, class ElementAt>
  Scalar advance(const Assembler& assembler, Rows& rows, ElementAt&& element_at) noexcept {
    increments_.take(assembler);
    if constexpr (any_rotation<Element>) {
      if (!rows.any() && !inertia_) {
        // A chain that ended where its ends were would share out a second time what is prescribed.
        ends_.lead(parts_.nodes(), increments_);
        const Scalar longer = parts_.follow(increments_);
        detail::lay_chain<Element, Scalar>(parts_.nodes(), parts_.properties(), parts_.inners(),
                                           [this](int i) { return increments_[i]; });
        detail::close_chain(parts_.nodes(), ends_[0], ends_[1]);
        ends_.correct(parts_.nodes());
        return longer;
      }
    }
    const Scalar longer = move();
    return longer + rows.advance(
                        [this](int e) {
                          Vector6<Scalar> both;
                          both.template head<3>() = increments_[e];
                          both.template tail<3>() = increments_[e + 1];
                          return both;
                        },
                        [this](int e, Scalar N) { parts_.set_tension(e, N); }, element_at);
  }
  /// Adds to its nodes.  @param change  i -> [u, w, θ]   @return the same
  template <class Change>
  Scalar move(Change&& change) noexcept {
    for (int i = 0; i < parts_.nodes().size(); ++i) increments_.set(i, change(i));
    return move();
  }
  /// Takes another shape of the same beam.
  void lay(const Centreline<Scalar>& shape) noexcept {
    for (Node& node : parts_.nodes()) node = shape.node_at(node.s);
    parts_.find_tensions();
  }
  /// A node that goes from place and tangent to others: it turns as the tangent does.
  static Node moved(const Node& node, const detail::Placed<Scalar>& from,
                    const detail::Placed<Scalar>& to) noexcept {
    const Scalar along = from[2] * to[2] + from[3] * to[3], aside = from[3] * to[2] - from[2] * to[3];
    return {node.s, to[0] - node.s, to[1],
            node.theta + detail::angle(aside, along, std::sqrt(along * along + aside * aside))};
  }
  /// Bends it a little, without a contact to where its loads push.   @param contact  its place, negative: none
  void nudge(Scalar size, Scalar contact, Scalar load) noexcept {
    const auto move = [&](Scalar by) { detail::nudge(parts_.nodes(), contact, by); };
    if (contact < 0 && parts_.loaded(load)) {
      move(size);
      const Scalar up = parts_.work(load);
      move(-2 * size);
      const Scalar down = parts_.work(load);
      move(size);
      if (detail::push_down(up, down)) size = -size;
    }
    move(size);
  }

  // What it carries.

  /// [J]   @param touched  (e) -> whether an element's is known otherwise
  template <class Touched>
  Scalar strain_energy(Touched&& touched) const noexcept {
    Scalar sum = 0;
    for (int e = 0; e < parts_.size(); ++e)
      if (!touched(e)) sum += parts_.strain_energy(e);
    return sum;
  }
  /// Forces on the nodes of element e, as it lies, less loads.
  template <class Rows>
  Vector6<Scalar> nodal_forces(const Rows& rows, int e, Scalar load) const noexcept {
    Vector6<Scalar> r;
    if (!rows.in(e)) return parts_.residual(e, load, r), r;
    r = rows.residual(parts_, e);
    (void)parts_.subtract_loads(e, load, r);
    return r;
  }
  /// What holds an end: along x and w [N], and moment [N·m].   @param load  λ   @param inertia, viscosity  null: none
  template <class Rows>
  VectorOf<Scalar, 3> reaction(std::size_t k, Scalar load, const Rows& rows, const Inertia* inertia,
                               const Viscosity* viscosity) const noexcept {
    const int e = k == 0 ? 0 : parts_.size() - 1;
    Vector6<Scalar> r = nodal_forces(rows, e, load);
    Matrix6<Scalar> unused = Matrix6<Scalar>::Zero();
    if (viscosity) (void)viscosity->add(e, parts_.displacements(e), r, unused);
    VectorOf<Scalar, 3> sum = r.template segment<3>(k == 0 ? 0 : 3);
    if (inertia) sum += inertia->force(parts_.nodes(), k == 0 ? 0 : e + 1);
    return sum;
  }
  /// What the section carries, in element e, as it lies, with what touches it.   @param thickness [m]   @param curve  s -> node on it
  template <class Rows, class Curve>
  InternalForces<Scalar> internal_forces(const Rows& rows, int e, const detail::CutAt<Scalar>& at,
                                         Scalar load, Scalar thickness, Curve&& curve) const noexcept {
    return parts_.internal_forces(
        at, load, thickness, nodal_forces(rows, e, load), curve, [&](auto& cut, bool whole) {
          for (int k = 0; k < rows.size(); ++k)
            if (const auto& contact = rows[k]; rows.element(k) == e && (whole || at.passed(contact.s)))
              cut.pass(contact.force * contact.normal + contact.friction,
                       detail::cut_place<Element>(curve(contact.s)).r);
        });
  }

 private:
  Scalar move() noexcept {
    ends_.lead(parts_.nodes(), increments_);
    increments_.for_each_node([this](int i, const Vector3<Scalar>& x) HAPBEAM_INLINED {
      Node& node = parts_.nodes()[i];
      node.u += x[0], node.w += x[1], node.theta += x[2];
    });
    ends_.correct(parts_.nodes());
    return parts_.follow(increments_);
  }

  Parts parts_;
  detail::ChainIncrements<Scalar, Elements, MaxElements, 3> increments_;  // the last ones
  Inertia* inertia_ = nullptr;                                            // of what it is in motion with
  const Viscosity* viscosity_ = nullptr;
  detail::BeamEnds<Scalar> ends_;
  Scalar stiffness_ = 0;  // of all elements, along and across [N/m]
};

template <class Element, typename Scalar, int Elements, int MaxElements>
using BeamSystem = ChainSystem<BeamChain<Element, Scalar, Elements, MaxElements>>;

namespace detail {

/// What a model is made of that has such an element.  Elements in space have theirs in rod_system.hpp.
template <class Element, typename = void>
struct SystemOf {
  static_assert(dimension_of<Element> == 2, "#include <hapbeam/fem/rod_system.hpp> for elements in space");
  using Body = Beam;
  template <typename Scalar, int Elements, int MaxElements>
  using System = BeamSystem<Element, Scalar, Elements, MaxElements>;
};

}  // namespace detail

}  // namespace hapbeam
