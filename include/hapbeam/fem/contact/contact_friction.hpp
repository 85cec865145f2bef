// SPDX-License-Identifier: MIT
// Coulomb friction of the contact of one push, as a system knows it: the law, and where the two bodies touch.
//
// It is made where a push begins, taken by the system for its goals, and gone where the push ends: a model without friction carries none of it.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cmath>
#include <limits>

#include <hapbeam/fem/contact/friction_law.hpp>

namespace hapbeam::detail {

/// @tparam RoundContact  RoundContact<Scalar> | RodRoundContact<Scalar>
template <typename Scalar, int D, template <typename> class RoundContact>
class ContactFriction : public FrictionLaw<Scalar, D> {
 public:
  /// @param state  what the touch remembers   @param round  the avatar   @param system  that is pushed, as it lies before
  /// @param normal_force  of the tick before [N]   @param alone  whether it is the only contact
  template <class System>
  ContactFriction(const FrictionState<Scalar, D>& state, const RoundContact<Scalar>& round,
                  const System& system, Scalar normal_force, bool alone) noexcept
      : round_(round) {
    const auto line = system.drawn();
    const auto node = round.node_at(line, round.request().s);
    const Scalar per_length = system.unit() / system.length();
    const int beside = line.node_near(round.request().s);
    // The mean of both pieces has an error of first order.  A contact that is alone keeps it, and with it the last bit of its forces: it costs up
    // to 4e-6 of what is dissipated on a bar between hinges that is bent by four times its thickness.
    this->begin(state, alone, round.place(round.look(node, 0), node),
                alone ? line.stretch(beside) : line.extrapolated_stretch(beside), round.request().reach,
                per_length * per_length / std::sqrt(std::numeric_limits<Scalar>::epsilon()),
                system.length() / 1000, normal_force);
  }

  /// Where this is a copy of that of another place of the avatar.   @param node  where they touch
  template <class Node>
  void begin_beside(const Node& node) noexcept {
    FrictionLaw<Scalar, D>::begin_beside(round_.place(round_.look(node, 0), node));
  }
  /// To be called where the beam has moved.  @param contact  an InnerContact
  template <class Contact>
  void look(const Contact& contact) noexcept {
    FrictionLaw<Scalar, D>::look(round_.friction_place(contact));
  }
  /// Its force on the contact, after that.
  template <class Contact>
  void give(Contact& contact) const noexcept {
    contact.friction = this->force();
    if constexpr (D == 2) contact.friction_stiffness = this->stiffness();
    else contact.friction_tangent = this->tangent();
  }

 private:
  RoundContact<Scalar> round_;
};

}  // namespace hapbeam::detail
