// SPDX-License-Identifier: MIT
// Friction at each of several contacts of a push (friction_law.hpp).
//
// Each has a law of its own, with a bound that follows its own normal force.  An equilibrium is one of Coulomb's where all of them have settled.
// Real-time: noexcept, no allocation, O(contacts).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::detail {

/// What contacts dissipate in a tick, so that the energy is balanced.
///
/// FrictionLaw::leave() takes a trapezoid for each contact, D = ½ (T before + T) · slip.  Their sum is
///
///   Σ D = W - ΔV        W: what the hands give (contact_work.hpp), V: energy of the beam and of sheared skins
///
/// to third order of the step where nothing happens within the tick.  A contact that gives way or turns back makes forces fall at once, and nodes of a
/// rod that follow contacts change V by more or less than friction takes.  All of them then take by the same factor more or less, so that what the
/// hands give, by trapezoids, is in V or was dissipated.  While all of them stick V is what they give, and need not be computed.
///
/// No factor is farther than a quarter from one: what is beyond is left for the next tick.  So is a tick in which all turns back, whose force is zero in the
/// mean and whose slip is not.  Where more than 0.003 of V is missing besides, the beam fell or the step is too long for trapezoids: it is not counted.
/// Real-time: noexcept, no allocation, O(elements) where something slides, else O(1).
template <typename Scalar>
class FrictionBalance {
 public:
  /// To be called where the beam moves otherwise.
  void forget() noexcept { known_ = false; }

  /// To be called where a push was answered.  @param work  its ContactWork
  /// @param potential  () -> V of the answer [J]   @param taken  Σ D [J]   @param slides  whether any of them slides now, or did before
  /// @return the factor; 1 where what touches is not what touched before
  template <class Work, class Potential>
  Scalar factor(const Work& work, Potential&& potential, Scalar taken, bool slides) noexcept {
    const bool known = known_ && work.same();
    const Scalar given = stored_ + work.done() - taken;
    known_ = true;
    if (known && !slides) {
      known_ = !(taken > 0);  // what damps a skin that sticks
      stored_ = given;
      return 1;
    }
    stored_ = potential();
    const Scalar rest = given - stored_;
    if (!known || !(std::abs(rest) <= taken + loose * std::abs(stored_))) return 1;
    const Scalar more = std::clamp(rest, -part * taken, part * taken);
    stored_ += rest - more;  // left for the next tick
    return taken > 0 ? 1 + more / taken : Scalar(1);
  }

 private:
  static constexpr Scalar part = Scalar(0.25), loose = Scalar(3e-3);

  Scalar stored_ = 0;
  bool known_ = false;
};

/// @tparam RoundContact  RoundContact<Scalar> | RodRoundContact<Scalar>   @tparam Most  obstacles
template <class System, class Obstacle, class RoundContact, int Most>
class SeveralFriction {
  using Scalar = typename System::Scalar;

 public:
  using Friction = typename System::Friction;
  using Vector = typename Friction::Vector;

  /// To be called where a push begins.   @param all  those that touch and have friction go on as they did
  void begin(const System& system, Obstacle* all, int count) noexcept {
    all_ = all, count_ = count, any_ = false;
    for (int i = 0; i < count; ++i) {
      laws_[i].reset();
      if (all[i].touching) meet(system, i);
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
    laws_[i]->begin_beside(RoundContact::node_at(system.drawn(), s));
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

  /// Of an obstacle, null: none.
  Friction* of(int i) noexcept { return laws_[i] ? &*laws_[i] : nullptr; }
  bool any() const noexcept { return any_; }
  /// Whether all that touches slides without friction.
  bool falls() noexcept {
    bool all = true;
    each([&](int, Friction& friction) { all = friction.falls() && all; });
    return all;
  }
  /// To be called where an equilibrium was found.  @param goal  i -> number of its contact in the system
  /// @return whether it is one of Coulomb's law, too
  template <class Goal>
  bool settled(System& system, Goal&& goal) noexcept {
    const auto normal_force = [&](int i) { return -system.linear_reaction(goal(i)); };
    int first = -1;
    each([&](int i, Friction& friction) {
      system.look_at_friction(goal(i));
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
  /// What a push leaves behind [J].
  struct Left {
    Scalar taken = 0;   ///< by friction
    Scalar stored = 0;  ///< in sheared skins, less what the system's foreseen_potential() has of friction
  };
  /// To be called where a push ends: what has no answer begins anew.
  /// @param work  a ContactWork   @param goal  as above, -1: none
  template <class Work, class Goal>
  Left leave(System& system, Status status, Work& work, FrictionBalance<Scalar>& balance,
             Goal&& goal) noexcept {
    const bool answered = is_answer(status);
    Scalar before[Most] = {};
    Left left;
    Scalar skins = 0;
    bool slides = false, on_its_way = status == Status::ok && any_;
    work.begin();
    for (int i = 0; i < count_; ++i) {
      auto* state = all_[i].friction;
      const bool touches = answered && all_[i].touching;
      if (state) before[i] = state->dissipated;
      if (state && of(i) && touches && goal(i) >= 0 && all_[i].pushed.force < 0) {
        system.look_at_friction(goal(i));
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
      const Scalar factor = balance.factor(
          work, [&] { return system.total_potential() + skins; }, left.taken, slides);
      each([&](int i, const Friction&) {
        Scalar& dissipated = all_[i].friction->dissipated;
        dissipated = before[i] + factor * (dissipated - before[i]);
      });
      left.taken *= factor;
    } else {
      balance.forget();
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
  bool any_ = false;
  std::optional<Friction> laws_[Most];
};

}  // namespace hapbeam::detail
