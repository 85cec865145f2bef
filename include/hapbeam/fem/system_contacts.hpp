// The contacts of a rod at nodes of its mesh: prescribed displacements, the path that leads to them, the share of the loads, and friction.
//
// The first contact is a point of its own; those beyond it cost nothing where there are none (other_contacts.hpp).
// Real-time: noexcept, no allocation, O(contacts).
#pragma once

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/other_contacts.hpp>

namespace hapbeam::detail {

/// Base class of a System.
/// @tparam Point  RodContact   @tparam Round  CapsuleOnCurve   @tparam Friction  of a contact
/// @tparam Row  of the assembler, to ask for a reaction   @tparam Others  the most contacts beyond the first
template <class System, typename Scalar, class Point, class Vector, class Round, class Friction, class Row,
          int Others>
class SystemContacts {
 public:
  /// Where the path ends: all of the dead loads, the ends where they are placed, and no contact.
  void set_goal() noexcept {
    contact_ = {};
    others_.clear();
    self().begin_path();
  }
  /// The same with a contact: d = n · displacement at its node or, beside an end that yields, at a distance on a straight tip.
  /// @param contact node   @param d [m]   @param lever [m] from the node to the contact, along the beam
  /// @param normal n, a unit vector; other than (0, 1) where the element is valid at finite rotation
  void set_goal(int contact, Scalar d, Scalar lever, const Vector& normal) noexcept {
    begin(d, Point(contact, lever, normal));
  }
  /// The same with a circle or capsule that is touched beside the node: d = -reach is then the wanted distance of its centre or axis.
  void set_goal(int contact, Scalar d, const Round& round) noexcept { begin(d, Point(contact, round)); }

  // What AllDisplacements asks beyond that, and why its System is of a shape that can be set.

  /// Sets the whole state, under no contact's force.
  template <class Mesh, class State>
  void set_state(const Mesh& mesh, const State& state) noexcept {
    go_back(mesh, state, 0);
  }
  /// Back to an equilibrium that was left.  @param force  of its contact [N]
  template <class Mesh, class State>
  void go_back(const Mesh& mesh, const State& state, Scalar force) noexcept {
    self().set(mesh, state);
    set_force(force);
  }
  /// The state of the same system in another scalar, on the uniform mesh.
  template <class Other>
  void take_state(const Other& other) noexcept {
    self().take(other);
    set_force(0);
  }

  // What SeveralPush asks beyond that.

  /// One contact more, after the first.  @param as  those of the first   @param force  of the last tangent's [N]
  /// @param friction  of it, null: none
  template <class... As>
  void add_goal(Scalar force, Friction* friction, int contact, Scalar d, const As&... as) noexcept {
    auto& other = others_.add();
    other.point = {contact, as...};
    other.friction = friction;
    other.force = other.reaction = force;
    other.point.look(self().node(contact), force);
    other.start = other.point.displacement();
    other.goal = d;
  }
  /// Of the contacts, in the order in which they were set: the force along n, of linear_reaction() [N].
  Scalar linear_reaction(int k) const noexcept { return k == 0 ? linear_reaction_ : others_[k - 1].reaction; }
  /// Before the first goal is set: the force of its contact in the last tangent [N].
  void set_force(Scalar force) noexcept { force_ = linear_reaction_ = force; }
  /// How the circle or capsule of one of them lies to its node.
  auto contact(int k) const noexcept {
    const auto& point = k == 0 ? contact_ : others_[k - 1].point;
    return point.view(self().node(point.node()));
  }
  /// The node of one of them, -1 where a plane stands for what is round.
  int round_node(int k) const noexcept {
    const auto& point = k == 0 ? contact_ : others_[k - 1].point;
    return point.round() ? point.node() : -1;
  }

  /// How that of the first one lies to its node.
  auto contact() const noexcept { return contact_.view(self().node(contact_.node())); }

  /// Of the first contact of the next goals, null: none.
  void set_friction(Friction* friction) noexcept { friction_ = friction; }
  /// Of no contact any more.
  void forget_friction() noexcept {
    friction_ = nullptr;
    others_.each([](auto& other) { other.friction = nullptr; });
  }
  /// To be called where the beam has moved.
  void look_at_friction() noexcept { look(*friction_, contact_); }
  /// The same of contact k, in the order in which they were set.
  void look_at_friction(int k) noexcept {
    if (k == 0) return look_at_friction();
    look(*others_[k - 1].friction, others_[k - 1].point);
  }

  /// The same as reaction() at the end of the last iterate(), of its linear equations, r + KΔ: accurate to what Newton's next
  /// increment would change.  reaction() has the round-off of nodes in it, EA/l and 12EI/l³ times their last places, which
  /// those equations have balanced.  It is saved and restored with the state, and stays where the mesh moves or a descent
  /// is on its way: the force of the last equilibrium.
  Scalar linear_reaction() const noexcept { return linear_reaction_; }
  /// V - λ f · x after the last iterate(), friction's included, to third order of its increment [J].
  Scalar foreseen_potential() const noexcept { return foreseen_potential_; }

 protected:
  /// So far along the path.
  void aim(Scalar t) noexcept {
    const auto between = [t](Scalar start, Scalar goal) { return t < 1 ? start + t * (goal - start) : goal; };
    load_ = between(start_load_, 1);
    d_ = between(start_d_, goal_d_);
    for (auto& other : others_) other.d = between(other.start, other.goal);
  }
  void save_contacts() noexcept {
    saved_load_ = load_;
    saved_reaction_ = linear_reaction_;
    for (auto& other : others_) other.saved = other.reaction;
  }
  void restore_contacts() noexcept {
    load_ = saved_load_;
    force_ = linear_reaction_ = saved_reaction_;
    for (auto& other : others_) other.force = other.reaction = other.saved;
  }
  /// To be called where the beam has moved, before it is assembled.
  void look_at_contacts() noexcept {
    if (contact_.node() >= 0) contact_.look(self().node(contact_.node()), force_);
    for (auto& other : others_) other.point.look(self().node(other.point.node()), other.force);
    if (friction_) look_at_friction();
    others_.each([this](auto& other) {
      if (other.friction) look(*other.friction, other.point);
    });
  }
  /// To be called after each linear solve.
  void feel_friction() noexcept {
    if (friction_) friction_->feel(-force_);
    others_.each([](auto& other) {
      if (other.friction) other.friction->feel(-other.force);
    });
  }
  /// To be called after each linear solve, too.  @param potential  before the increment   @param energy  ΔᵀKΔ [J]
  void foresee_potential(Scalar potential, Scalar energy) noexcept {
    foreseen_potential_ = potential - energy / 2;
    if (contact_.node() >= 0) foreseen_potential_ += linear_reaction_ * (d_ - contact_.displacement());
    for (const auto& other : others_)
      foreseen_potential_ += other.reaction * (other.d - other.point.displacement());
  }
  /// To be called where the beam falls.
  void fall_with_friction() noexcept {
    if (friction_) friction_->fall();
    others_.each([](auto& other) {
      if (other.friction) other.friction->fall();
    });
  }
  /// [J]
  Scalar friction_potential() noexcept {
    Scalar potential = friction_ ? friction_->potential() : Scalar(0);
    others_.each([&](auto& other) {
      if (other.friction) potential += other.friction->potential();
    });
    return potential;
  }
  /// Moves nodes along n until the contacts are where they should be.
  template <class Nodes>
  void correct_contacts(Nodes& nodes) noexcept {
    if (contact_.node() >= 0) contact_.correct(nodes[contact_.node()], d_);
    for (auto& other : others_) other.point.correct(nodes[other.point.node()], other.d);
  }

  Point contact_;
  OtherContacts<OtherContact<Point, Scalar, Friction, Row>, Others> others_;
  Friction* friction_ = nullptr;                       // of the first contact
  Scalar load_ = 0, saved_load_ = 0, start_load_ = 0;  // of the dead loads
  Scalar d_ = 0, start_d_ = 0, goal_d_ = 0;            // of the first contact [m]
  Scalar linear_reaction_ = 0, saved_reaction_ = 0;    // [N]
  Scalar force_ = 0;                                   // of the last tangent's contact [N]
  Scalar foreseen_potential_ = 0;                      // [J]

 private:
  System& self() noexcept { return static_cast<System&>(*this); }
  const System& self() const noexcept { return static_cast<const System&>(*this); }
  void look(Friction& friction, const Point& contact) noexcept {
    friction.look(contact, self().node(contact.node()));
  }
  void begin(Scalar d, const Point& point) noexcept {
    contact_ = point;
    others_.clear();
    contact_.look(self().node(contact_.node()), force_);
    start_d_ = contact_.displacement();
    goal_d_ = d;
    self().begin_path();
  }
};

}  // namespace hapbeam::detail
