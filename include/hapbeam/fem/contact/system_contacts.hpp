// SPDX-License-Identifier: MIT
// The contacts of a system, its goals: a path that leads to them, with the share of the loads that acts on the way, and their forces.
//
// Base class of ChainSystem, which has:  begin_path(), look(k), element_at(s, e), and the shape that they set.
// Real-time: noexcept, no allocation but at construction, O(contacts).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// @tparam Rows  ContactRows
template <class System, class Scalar, class Friction, class RowsType>
class SystemContacts {
 public:
  using Rows = RowsType;
  using Contact = typename Rows::Contact;

  // The goal of a path: all of the dead loads, the ends where they are placed, and contacts.

  /// Without a contact.
  void set_goal() noexcept {
    rows_.clear();
    start_load_ = load_;
    self().begin_path();
  }
  /// One contact more.   @param friction  null: none   @param stays  its place, until an equilibrium is found
  void add_goal(const Contact& goal, Friction* friction, bool stays = false) noexcept {
    rows_.add(goal, self().element_at(goal.s, goal.element()), friction, stays);
  }
  /// With a place that is held.   @param force  along its normal, about [N]
  template <int D>
  void set_goal(const Push<Scalar, D>& place, Scalar force = 0) noexcept {
    Contact contact;
    const bool same = rows_.size() == 1 && rows_[0].kind == Contact::Kind::along && rows_[0].s == place.s;
    if (same) contact = rows_[0];
    contact.kind = Contact::Kind::along;
    contact.s = place.s, contact.normal = place.normal, contact.reach = place.d;
    // What an element of a rod yields by is found from its force: that of another place says nothing of it.
    contact.force = D == 2 || same ? force : Scalar(0);
    contact.moves = false;
    set_goal();
    add_goal(contact, nullptr);
  }
  /// As they are, after look().
  const Rows& rows() const noexcept { return rows_; }
  void look_at_friction(int k) noexcept {
    self().look(k);
    rows_.friction(k)->look(rows_[k]);
  }
  /// To be called in an equilibrium where they have stayed.   @return whether the places of contacts are those of another one
  bool places_go_on() noexcept {
    if constexpr (Rows::dimension == 2) return false;
    else
      return rows_.go_on_to_tangent([this](Scalar s, int e) { return self().element_at(s, e); },
                                    self().length());
  }
  /// Of no contact any more.
  void forget_friction() noexcept { rows_.forget_friction(); }
  /// The force of contact k of the last linear equations, along the normal of a held place or toward what is round.  It is accurate to what Newton's next
  /// increment would change, and stays where a descent is on its way: that of the last equilibrium [N].
  Scalar linear_reaction(int k = 0) const noexcept { return reactions_[static_cast<std::size_t>(k)]; }
  /// V - λ f · x after the last iterate(), friction's included, to third order of its increment [J].
  Scalar foreseen_potential() const noexcept { return foreseen_potential_; }

 protected:
  explicit SystemContacts(int elements) : rows_(elements) {}

  /// So far along the path.
  void aim(Scalar t) noexcept {
    load_ = t < 1 ? start_load_ + t * (1 - start_load_) : Scalar(1);
    rows_.aim(t, [this](int k) {
      self().look(k);
      const Contact& contact = rows_[k];
      if (contact.kind == Contact::Kind::round) return contact.gap + contact.reach;
      return contact.normal.dot(contact.displacement());
    });
  }
  void save_contacts() noexcept {
    rows_.save();
    saved_load_ = load_, saved_reactions_ = reactions_;
  }
  void restore_contacts() noexcept {
    rows_.restore();
    load_ = saved_load_, reactions_ = saved_reactions_;
  }
  /// To be called after each linear solve.   @param potential  before the increment   @param energy  ΔᵀKΔ where nothing touches [J]
  /// @param inner  of the increment that inner unknowns make on their own [J]
  void feel(Scalar potential, Scalar energy, Scalar inner) noexcept {
    for (int k = 0; k < rows_.size(); ++k) reactions_[static_cast<std::size_t>(k)] = rows_.reaction(k);
    if (!rows_.any()) reactions_[0] = 0;
    rows_.feel_friction();
    foreseen_potential_ = potential - inner / 2 + (rows_.any() ? rows_.foreseen_change() : -energy / 2);
  }
  /// √(2V), or what the weakest of several contacts is worth, the force of which has to be exact, too [√J].
  Scalar weight(Scalar size) const noexcept {
    if constexpr (Rows::most > 1)
      if (rows_.size() > 1) return std::clamp(std::sqrt(rows_.weakest()), least_weight * size, size);
    return size;
  }
  /// Without a contact.   @param force  of the first one then [N]
  void let_go(Scalar force) noexcept {
    rows_.clear();
    reactions_ = {force};
  }

  Rows rows_;
  Scalar load_ = 0;  // of the dead loads

 private:
  static constexpr Scalar least_weight = Scalar(0.1);  // of a contact that may let go
  System& self() noexcept { return static_cast<System&>(*this); }

  std::array<Scalar, std::size_t(Rows::most)> reactions_{}, saved_reactions_{};  // [N]
  Scalar saved_load_ = 0, start_load_ = 0, foreseen_potential_ = 0;
};

}  // namespace hapbeam::detail
