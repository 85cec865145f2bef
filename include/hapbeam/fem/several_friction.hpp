// Friction at each of several contacts of a push (friction_law.hpp).
//
// Each has a law of its own, with a bound that follows its own normal force.  An equilibrium is one of Coulomb's where all of them have settled.
// It is made where a push begins, and gone where the push ends.
// Real-time: noexcept, no allocation, O(contacts).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include <hapbeam/fem/giving_way.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::detail {

/// @tparam RoundContact  RoundContact<Scalar> | RodRoundContact<Scalar>   @tparam Most  obstacles
template <class System, class Obstacle, class RoundContact, int Most>
class SeveralFriction {
  using Scalar = typename System::Scalar;

 public:
  using Friction = typename System::Friction;

  /// @param all  those that touch and have friction go on as they did
  SeveralFriction(const System& system, Obstacle* all, int count) noexcept : all_(all), count_(count) {
    for (int i = 0; i < count; ++i)
      if (all[i].touching) meet(system, i);
  }
  /// An obstacle has a contact now.
  void meet(const System& system, int i) noexcept {
    if (!rough(i)) return;
    law(i).emplace(*all_[i].friction, RoundContact{all_[i].round}, system, -all_[i].pushed.force, false);
    any_ = true;
  }

  /// The hands go on as they went.
  void go_on() noexcept {
    each([](int, Friction& friction) { friction.go_on(); });
  }

  /// Of an obstacle, null: none.
  Friction* of(int i) noexcept { return law(i) ? &*law(i) : nullptr; }
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
    if (first >= 0 && of(first)->gives_way())
      giving_way_.mark(first, system, [this](auto&& use) { this->each(use); });
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
  /// To be called where a push ends: what has no answer begins anew.  @param goal  as above, -1: none
  template <class Goal>
  void leave(System& system, bool answered, Goal&& goal) noexcept {
    const int given_way = giving_way_.contact();
    const bool any =
        answered && given_way >= 0 && all_[given_way].touching && all_[given_way].pushed.force < 0;
    std::array<Last, Most> last;
    Scalar counted = 0;
    for (int i = 0; i < count_; ++i) {
      if (!all_[i].friction) continue;
      const int k = goal(i);
      if (answered && of(i) && all_[i].touching && k >= 0 && all_[i].pushed.force < 0) {
        system.look_at_friction(k);
        const auto& state = *all_[i].friction;
        if (any) last[at(i)] = {state.force, state.dissipated, state.known && !state.slides};
        counted += of(i)->leave(*all_[i].friction, -all_[i].pushed.force);
      } else {
        all_[i].friction->let_go();
      }
    }
    if (any) {
      Scalar rest = giving_way_.beyond_trapezoids(system, *of(given_way), last[at(given_way)].force, counted,
                                                  [this](auto&& use) { this->each(use); });
      const auto take = [&](int i, const Friction& friction) {
        const Scalar most = giving_way_.most(i, friction, last[at(i)].force),
                     part = std::clamp(rest, -most, most);
        Scalar& dissipated = all_[i].friction->dissipated;
        dissipated = (std::max)(dissipated + part, last[at(i)].dissipated);
        rest -= part;
      };
      take(given_way, *of(given_way));
      // Those that have given way at it.
      each([&](int i, const Friction& friction) {
        if (i != given_way && last[at(i)].stuck) take(i, friction);
      });
    }
    if (any_) system.forget_friction();
  }
  /// To be called thereafter where it was answered.  @param tilts  a ContactTilt
  template <class Tilts, class Goal>
  void learn(System& system, Tilts& tilts, Goal&& goal) noexcept {
    if (!any_) return;
    tilts.begin();
    each([&](int i, Friction& friction) {
      const Scalar normal_force = -all_[i].pushed.force;
      if (!(normal_force > 0)) return;
      tilts.learn(i, system, goal(i), friction.acting().dot(friction.place().along), normal_force,
                  all_[i].friction->tilt);
    });
  }

 private:
  /// Of a contact, in the push before.
  struct Last {
    typename Friction::Vector force = Friction::Vector::Zero();
    Scalar dissipated = 0;
    bool stuck = false;
  };

  bool rough(int i) const noexcept {
    return all_[i].kind == ObstacleKind::round && all_[i].friction && all_[i].friction->sticking > 0;
  }
  static std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
  std::optional<Friction>& law(int i) noexcept { return laws_[at(i)]; }
  /// @param use  of those that touch
  template <class Use>
  void each(Use&& use) noexcept {
    for (int i = 0; any_ && i < count_; ++i)
      if (all_[i].touching && law(i)) use(i, *law(i));
  }

  Obstacle* all_;
  int count_;
  bool any_ = false;
  std::array<std::optional<Friction>, Most> laws_;
  GivingWay<Friction, Most> giving_way_;
};

}  // namespace hapbeam::detail
