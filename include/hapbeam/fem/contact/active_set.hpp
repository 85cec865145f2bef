// SPDX-License-Identifier: MIT
// The bodies that may touch a beam or rod: which of them do, the numbers of their contacts in its equations, and their friction.
//
// A push has one (row_push.hpp), and so has a step with mass (coupled_contacts.hpp).  Each of its equilibria is one of those that touch: of those that
// would have to pull the worst lets go.
// Each that is rough has a law of friction of its own (friction_law.hpp), with a bound that follows its own normal force.  An equilibrium is one of
// Coulomb's where all of them have settled.
// Real-time: noexcept, no allocation, O(contacts).   Source: Nocedal and Wright, Numerical Optimization, 16.5.
#pragma once

#include <algorithm>
#include <optional>

#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::detail {

template <class System>
class ActiveSet {
  using Scalar = typename System::Scalar;
  using RoundContact = typename System::RoundContact;
  static constexpr int most = System::Rows::most;

 public:
  using Obstacle = hapbeam::Obstacle<Scalar, System::dimension>;
  using Friction = typename System::Friction;
  using Vector = typename Friction::Vector;

  /// To be called where a push begins.   @param all  kept until it ends
  void take(Obstacle* all, int count) noexcept {
    all_ = all, count_ = count;
    std::fill(goals_, goals_ + most, -1);
  }
  int size() const noexcept { return count_; }
  Obstacle& operator[](int i) noexcept { return all_[i]; }
  const Obstacle& operator[](int i) const noexcept { return all_[i]; }
  /// Number of a contact in the system, -1: there was none in the last equilibrium.
  int goal(int i) const noexcept { return goals_[i]; }

  /// Gives all that touch and are the beam's to feel their numbers.   @return how many there are
  int number() noexcept {
    int contacts = 0;
    for (int i = 0; i < count_; ++i) goals_[i] = all_[i].touching && all_[i].valid ? contacts++ : -1;
    return contacts;
  }
  /// After that: they are the goal of the system.   @param contact  (i) -> as the system takes it   @param stays  (i) -> whether its place does
  /// Not inlined: it is called from several places, and each would have a copy of what a contact is made of.
  template <class EachContact, class Stays>
  [[gnu::noinline]] void aim(System& system, EachContact&& contact, Stays&& stays) noexcept {
    system.set_goal();
    for (int i = 0; i < count_; ++i)
      if (goals_[i] >= 0) system.add_goal(contact(i), of(i), stays(i));
  }
  /// The one that pulls most, which a support may; what is touched by nothing pulls the least.   @return -1: none
  int worst() const noexcept {
    int worst = -1;
    for (int i = 0; i < count_; ++i) {
      if (!all_[i].touching || all_[i].kind == ObstacleKind::support || all_[i].pushed.force < 0) continue;
      if (worst < 0 || all_[i].pushed.force > all_[worst].pushed.force) worst = i;
    }
    return worst;
  }

  // Friction.

  /// To be called where a push begins: that of those that touch goes on as it did.
  void begin(const System& system) noexcept {
    any_ = false;
    for (int i = 0; i < count_; ++i) {
      laws_[i].reset();
      if (all_[i].touching && all_[i].valid) meet(system, i);
    }
  }
  /// An obstacle has a contact now.
  void meet(const System& system, int i) noexcept {
    if (!rough(i)) return;
    laws_[i].emplace(*all_[i].friction, RoundContact{all_[i].round}, system, -all_[i].pushed.force,
                     count_ == 1);
    any_ = true;
  }
  /// The same where another place of its body has one already, and it goes on as that does.   @param s  [m]
  void meet_beside(const System& system, int i, int other, Scalar s) noexcept {
    if (!of(other)) return meet(system, i);
    laws_[i].emplace(*of(other));
    laws_[i]->begin_beside(system.drawn().node_at(s));
  }

  /// Whether it stuck in the push before, or slid by less than that.  @param way  [m]
  bool hardly_slides(int i, Scalar way) const noexcept {
    return rough(i) && all_[i].friction->known && !(all_[i].friction->slides && all_[i].friction->slip > way);
  }
  /// To be called where the way to an equilibrium begins anew.
  void begin_again(const System& system) noexcept {
    for (int i = 0; i < count_; ++i)
      if (all_[i].touching && laws_[i]) meet(system, i);
  }
  /// The hands go on as they went.
  void go_on() noexcept {
    each([](int, Friction& friction) { friction.go_on(); });
  }

  bool any_rough() const noexcept { return any_; }
  /// Whether all that touches slides without friction.
  bool falls() noexcept {
    bool all = true;
    each([&](int, Friction& friction) { all = friction.falls() && all; });
    return all;
  }
  /// To be called where an equilibrium was found.   @return whether it is one of Coulomb's law, too
  bool settled(System& system) noexcept {
    const auto normal_force = [&](int i) { return -system.linear_reaction(goals_[i]); };
    int first = -1;
    each([&](int i, Friction& friction) {
      system.look_at_friction(goals_[i]);
      if (friction.holds_too_much(normal_force(i)) &&
          (first < 0 || friction.last_bound() < of(first)->last_bound()))
        first = i;
    });
    // What two hold between them says nothing of either: the one that holds less slides, and then the other one may stick.
    if (first >= 0 && !of(first)->settled(normal_force(first))) return false;
    bool all = true;
    each([&](int i, Friction& friction) { all = friction.settled(normal_force(i)) && all; });
    return all;
  }
  /// To be called where no equilibrium is near.   @return whether there is another way to try
  bool turn() noexcept {
    bool any = false;
    each([&](int, Friction& friction) { any = friction.turn() || any; });
    return any;
  }
  /// Whether the way is long, and leads from the state before the push.
  bool torn() noexcept {
    bool any = false;
    each([&](int, Friction& friction) { any = friction.torn() || any; });
    return any;
  }
  /// Of an obstacle, null: none.
  Friction* of(int i) noexcept { return laws_[i] ? &*laws_[i] : nullptr; }

  /// What a push leaves behind [J].
  struct Left {
    Scalar taken = 0;   ///< by friction
    Scalar stored = 0;  ///< in sheared skins, less what the system's foreseen_potential() has of friction
  };
  /// To be called where a push ends: what has no answer begins anew.   @param work  a ContactWork
  template <class Work>
  Left leave(System& system, Status status, Work& work) noexcept {
    const bool answered = is_answer(status);
    Scalar before[most] = {};
    Left left;
    Scalar skins = 0;
    bool slides = false, on_its_way = status == Status::ok && any_;
    work.begin();
    for (int i = 0; i < count_; ++i) {
      auto* state = all_[i].friction;
      const bool touches = answered && all_[i].touching;
      if (state) before[i] = state->dissipated;
      if (state && of(i) && touches && goals_[i] >= 0 && all_[i].pushed.force < 0) {
        system.look_at_friction(goals_[i]);
        slides = slides || state->slides;
        of(i)->leave(*state, -all_[i].pushed.force);
        slides = slides || state->slides;
        left.taken += state->dissipated - before[i];
        skins += of(i)->held(*state);
        left.stored += of(i)->held(*state) - of(i)->potential();
        on_its_way = on_its_way && !of(i)->falls();
      } else if (state) {
        state->let_go();
      }
      if (!touches) {
        if (!all_[i].valid) work.absent(i);
        else if (all_[i].kind == ObstacleKind::round) work.apart(i, all_[i].round);
        continue;
      }
      if (all_[i].kind == ObstacleKind::round)
        work.touches(i, all_[i].round, all_[i].pushed, state ? state->force : Vector(Vector::Zero()));
      else work.holds(i, all_[i].place, all_[i].pushed.force);
    }
    if (any_ && on_its_way) {
      const Scalar factor = work.factor([&] { return system.total_potential() + skins; }, left.taken, slides);
      each([&](int i, const Friction&) {
        Scalar& dissipated = all_[i].friction->dissipated;
        dissipated = before[i] + factor * (dissipated - before[i]);
      });
      left.taken *= factor;
    } else {
      work.forget_stored();
    }
    system.forget_friction();
    return left;
  }

 private:
  bool rough(int i) const noexcept {
    return all_[i].kind == ObstacleKind::round && all_[i].friction && all_[i].friction->rough();
  }
  /// @param use  of those that touch
  template <class Use>
  void each(Use&& use) noexcept {
    for (int i = 0; any_ && i < count_; ++i)
      if (all_[i].touching && laws_[i]) use(i, *laws_[i]);
  }

  Obstacle* all_ = nullptr;
  int count_ = 0;
  int goals_[most] = {};
  bool any_ = false;  // of them is rough
  std::optional<Friction> laws_[most];
};

}  // namespace hapbeam::detail
