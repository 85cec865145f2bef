// SPDX-License-Identifier: MIT
// Hands that touch a beam in motion through their couplings, within a stage of its step: contacts that yield, found with the beam.
//
//   λ = K δ + B (δ - δ₀)/τ >= 0        δ: of a hand in the beam, behind a massless avatar;  τ: length of the stage
//
// is a contact with a compliance, D = R - λ/(K + B/τ) from about where the avatar is.  Which of them touch is found by an active set: the one that pulls
// most lets go, the deepest of the others comes.  What has let go in a stage is at its edge until the next.  A lasting touch goes on as it went.
// What touches beside an end that cannot move is no row: the beam feels none of it.
// Friction along the beam is that of statics (friction_law.hpp), of an avatar whose skin is the coupling.
// Real-time: noexcept, no allocation, at most most_passes solutions, with friction each of them more than once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/fem/contact/active_set.hpp>
#include <hapbeam/fem/contact/continuation.hpp>
#include <hapbeam/fem/contact/obstacle_gap.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam::detail {

/// Whether an end can move neither along nor across.
constexpr bool anchored(Support support) noexcept { return fixes_u(support) && fixes_w(support); }
inline bool anchored(const RodSupport& support) noexcept {
  return std::isinf(support.place1) && std::isinf(support.place2) && std::isinf(support.along);
}

template <class System>
class CoupledContacts {
  using Scalar = typename System::Scalar;
  static constexpr int most = System::Rows::most, dimension = System::dimension;
  using Vector = typename System::Vector;
  using Contact = typename System::Contact;
  using RoundContact = typename System::RoundContact;
  using Obstacle = hapbeam::Obstacle<Scalar, dimension>;
  using State = InnerState<Scalar, dimension>;
  using Hand = Coupled<Scalar, dimension>;
  using Round = decltype(Hand::hand);
  using View = RoundBeside<Scalar, dimension>;

 public:
  static constexpr int most_passes = 2 + 2 * most;

  /// @param range  where the beam may be pressed   @param left, right  whether that end can move neither along nor across
  CoupledContacts(const Range<Scalar>& range, bool left, bool right) noexcept
      : least_((std::max)(range.s_min, Scalar(0))), most_(range.s_max), rigid_{left, right} {}

  /// No hand has ever been there.
  void reset() noexcept { slots_ = {}, count_ = 0; }
  /// To be called where a step begins.   @param hands  where they go to; kept until end()
  void begin(const System& system, const Hand* hands, int count) noexcept {
    hands_ = hands;
    for (int i = 0; i < count; ++i) {
      Slot& now = slot(i);
      if (!now.touches()) now.foot = hands[i].hand.s;
      // One that comes from nowhere has its spring bent as it lies, and a damper at rest.
      if (i >= count_ || now.seen == Seen::never) {
        now = {};
        now.foot = hands[i].hand.s, now.from = hands[i].hand, now.seen = Seen::apart;
        now.penetration = (std::max)(
            hands[i].hand.reach - look_beside<RoundContact>(system, hands[i].hand, now.foot).gap, Scalar(0));
      }
      if (hands[i].friction) now.friction = *hands[i].friction;
    }
    count_ = count;
  }
  void end() noexcept {
    for (int i = 0; i < count_; ++i) {
      slot(i).from = hands_[i].hand;
      if (hands_[i].friction) *hands_[i].friction = slot(i).friction;
    }
  }
  /// What hand i feels at the end of a step.
  Pushed<Scalar, dimension> pushed(System& system, int i) const noexcept {
    const Slot& now = slot(i);
    if (!now.touches()) return {0, Status::ok};
    Round avatar = now.from;
    place_of(avatar) += now.place - avatar.reach * now.normal - RoundContact{now.from}.centre(now.place);
    const bool again = touches_again(system, avatar, now.at.s, now.wraps);
    return {-now.at.force, again ? Status::out_of_range : Status::ok, false, now.at.s, now.place,
            -now.normal};
  }
  /// As it is at the beginning of a part of a step, to be set where that is taken back.
  auto kept() const noexcept { return slots_; }
  template <class Kept>
  void take_back(const Kept& kept) noexcept {
    slots_ = kept;
    for (Slot& slot : slots_) slot.stages = 0;
  }
  /// Whether one has begun to touch in the last stage, on a spring that is stiffer than what the beam resists with there by its inertia.
  bool struck() const noexcept {
    for (int i = 0; i < count_; ++i)
      if (slot(i).stages == 1 && slot(i).hard) return true;
    return false;
  }
  /// To be called before a stage moves the system.
  void draw(System& system) const noexcept {
    for (int i = 0; i < count_; ++i)
      if (rough(i)) return system.draw();
  }

  /// One stage.   @param time τ [s]   @param way  that the hands have gone in the step, 0 to 1   @param onward  as of TrBdf2
  /// @param newton  (whether any touches) -> whether the system's goal was reached
  template <class Newton>
  bool solve(System& system, Scalar time, Scalar way, Scalar onward, Newton&& newton) noexcept {
    for (int i = 0; i < count_; ++i) {
      Slot& now = slot(i);
      const Scalar by_time = hands_[i].damping / time;
      now.whole = hands_[i].stiffness + by_time, now.lasting = by_time * now.penetration / now.whole;
      now.round = between(now.from, hands_[i].hand, way);
      now.next = now.at;
      if (now.touches()) now.foot = now.at.s, now.seen = Seen::touching;
      else now.seen = Seen::apart;
      if (now.stages > 1) now.next.go_on(now.at, now.before, onward);
      now.friction.stiffness = hands_[i].stiffness, now.friction.damping = by_time;
      if (now.touches() && comes_to_rigid(now)) now.seen = touches(system, now);
      all_[i].round = now.round, all_[i].friction = rough(i) ? &now.friction : nullptr;
      set(i, now.at.force);
    }
    active_.take(all_, count_);
    active_.begin(system);
    bool found = false;
    for (int pass = 0; pass < most_passes && !found; ++pass) {
      const bool any = active_.number() > 0;
      active_.aim(
          system, [&](int i) { return contact(system, i); }, [](int) { return false; });
      do
        if (!newton(any)) return system.forget_friction(), false;
      while (!active_.settled(system));
      take(system);
      found = !review(system);
    }
    for (int i = 0; i < count_; ++i) {
      Slot& now = slot(i);
      if (active_.goal(i) >= 0 && active_.of(i)) active_.of(i)->leave(now.friction, now.next.force);
      else now.friction.let_go();
      now.before = now.at, now.at = now.next;
      now.stages = now.touches() ? now.stages + 1 : 0;
      now.penetration = now.lasting + (now.touches() ? now.at.force / now.whole : Scalar(0));
    }
    system.forget_friction();
    return found;
  }

 private:
  enum class Seen {
    never,
    apart,
    let_go,    // in this stage
    touching,  // as a row of the system
    rigid,     // touching beside an end that cannot move
  };
  struct Slot {
    Seen seen = Seen::never;
    bool hard = false;       // its spring is stiffer than the beam
    int stages = 0;          // in which it has touched
    Round from{};            // the hand at the end of the last step
    Scalar penetration = 0;  // of the hand in the beam, as it lasts in the damper [m]
    Scalar foot = 0;         // place that is nearest to the hand, of the beam as it is drawn [m]
    State at, before, next;  // after the last stage, the one before, and in this one
    Vector place = Vector::Zero(), normal = Vector::Zero();
    Scalar wraps = 0;  // as of its contact
    FrictionState<Scalar, dimension> friction;
    Round round{};                  // the hand in this stage
    Scalar whole = 1, lasting = 0;  // K + B/τ [N/m], and what lasts of the penetration without a force [m]
    bool touches() const noexcept { return seen >= Seen::touching; }
  };
  static Vector2<Scalar>& place_of(Circle<Scalar>& circle) noexcept { return circle.centre; }
  static VectorOf<Scalar, 3>& place_of(Capsule<Scalar>& capsule) noexcept { return capsule.axis.tip; }
  Slot& slot(int i) noexcept { return slots_.data()[i]; }
  const Slot& slot(int i) const noexcept { return slots_.data()[i]; }
  bool rough(int i) const noexcept { return hands_[i].friction && hands_[i].friction->rough(); }

  /// From where the avatar is about: on the beam, and not in it as far as the hand.
  Contact contact(const System& system, int i) noexcept {
    Slot& now = slot(i);
    const View view = look(system, now);
    const Scalar aside = now.round.reach * now.round.reach - view.aside,
                 ahead = (std::max)(std::sqrt((std::max)(aside, Scalar(0))) - view.height, Scalar(0));
    Round& avatar = all_[i].round = now.round;
    avatar.s = now.foot, place_of(avatar) += ahead * view.facing;
    Contact contact;
    static_cast<State&>(contact) = now.next;
    RoundContact{avatar}.set(contact);
    contact.reach = avatar.reach;
    // One that has lasted for two parts is as round as it is; from afar a wide one, which soon is a plane, is met more often.
    const Scalar deep = ahead - now.lasting;
    (now.stages > 3 ? contact.ahead : contact.reach) += deep, contact.compliance = 1 / now.whole;
    contact.least = least_, contact.most = most_;
    contact.moves = true, contact.waits = now.next.force == 0;
    return contact;
  }
  /// What the system has found of those that touch.
  void take(System& system) noexcept {
    for (int i = 0; i < count_; ++i) {
      Slot& now = slot(i);
      if (const int goal = active_.goal(i); goal >= 0) {
        system.look(goal);
        const Contact& found = system.rows()[goal];
        now.hard = system.rows().share(goal) < Scalar(0.5);
        now.next = found, now.next.force = -system.linear_reaction(goal);
        now.place = found.place, now.normal = found.normal, now.wraps = found.moves ? found.wraps : Scalar(0);
      } else if (now.touches()) {
        const View view = look(system, now);
        now.next = {}, now.next.s = now.foot, now.next.force = now.whole * depth(now, view);
        now.normal = -view.normal, now.place = view.place, now.wraps = 0;
      }
      set(i, now.next.force);
    }
  }
  /// As the active set has it.   @param force  of the beam on it [N]
  void set(int i, Scalar force) noexcept {
    all_[i].valid = slot(i).seen != Seen::rigid;
    all_[i].touching = slot(i).touches(), all_[i].pushed.force = -force;
  }
  /// @return whether another one touches now, or one does not any more
  bool review(const System& system) noexcept {
    int changes = active_.worst();
    const bool pulls = changes >= 0;
    Scalar deepest = 0;
    for (int i = 0; i < count_ && !pulls; ++i) {
      if (slot(i).seen != Seen::apart) continue;
      const Scalar deep = depth(slot(i), look(system, slot(i)));
      if (deep > deepest) deepest = deep, changes = i;
    }
    if (changes < 0) return false;
    Slot& now = slot(changes);
    now.seen = pulls ? Seen::let_go : touches(system, now);
    now.next = {}, now.next.s = now.foot, now.stages = 0;
    set(changes, 0);
    if (now.seen == Seen::touching) active_.meet(system, changes);
    return true;
  }
  /// As what something touches.
  Seen touches(const System& system, Slot& now) const noexcept {
    const Scalar foot = look(system, now).foot;
    return (foot < least_ && rigid_[0]) || (foot > most_ && rigid_[1]) ? Seen::rigid : Seen::touching;
  }
  static View look(const System& system, Slot& now) noexcept {
    return look_beside<RoundContact>(system, now.round, now.foot);
  }
  static Scalar depth(const Slot& now, const View& view) noexcept {
    return now.round.reach - now.lasting - view.gap;
  }
  /// Whether it may come there within a stage.
  bool comes_to_rigid(const Slot& now) const noexcept {
    return (now.at.s < least_ + now.round.reach && rigid_[0]) ||
           (now.at.s > most_ - now.round.reach && rigid_[1]);
  }

  Scalar least_, most_;  // places of rows [m]
  bool rigid_[2];
  const Hand* hands_ = nullptr;
  int count_ = 0;
  std::array<Slot, std::size_t(most)> slots_{};
  Obstacle all_[most] = {};
  ActiveSet<System> active_;
};

}  // namespace hapbeam::detail
