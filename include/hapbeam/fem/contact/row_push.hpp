// SPDX-License-Identifier: MIT
// A beam is laid on circles, a rod on capsules, or they are held at places: which of them touch, where, and the equilibrium are found together.
//
//   force >= 0,  gap >= 0,  force · gap = 0        for each obstacle
//
// A small complementarity problem, solved by an active set (row_contacts.hpp) of equilibria whose unknowns the places are, too.  It begins with
// those that touched in the push before, which mostly is the last one: then there is one solution.  A hand that goes on as it went finds beam, places and
// forces where they were foreseen.  An answer continues the last one, or says that it does not (continuation.hpp).
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, at most most_passes solutions, and the linear solves of
// AllDisplacements in all.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <hapbeam/fem/contact/active_set.hpp>
#include <hapbeam/fem/contact/contact_work.hpp>
#include <hapbeam/fem/contact/continuation.hpp>
#include <hapbeam/fem/contact/row_contacts.hpp>
#include <hapbeam/fem/contact/row_foresight.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

template <class System>
class RowPush {
  using Scalar = typename System::Scalar;
  using RoundContact = typename System::RoundContact;
  static constexpr int most = System::Rows::most, dimension = System::dimension;
  using Round = RoundOf<Scalar, dimension>;
  using State = InnerState<Scalar, dimension>;
  using Obstacle = hapbeam::Obstacle<Scalar, dimension>;
  using FrictionState = hapbeam::FrictionState<Scalar, dimension>;
  using Work = ContactWork<Scalar, dimension, most>;

 public:
  /// Forces are exact to so many times the solver's tolerance.  Where normal forces are no unknowns the next increment is smaller than it is taken for.
  static constexpr int slack = dimension == 2 ? 10 : 100;
  /// Solutions of a push: each obstacle touches or lets go.
  static constexpr int most_passes = 4 + 2 * most;
  /// Linear solves in which an equilibrium that is near is found, with friction of one in space, and with that of several.
  static constexpr int close_by = 6, near_in_space = 10, near_with_friction = 16;
  /// Times that places with friction go on, in an equilibrium of Coulomb's law.
  static constexpr int most_moves = 2;

  /// @throws std::invalid_argument where there are too few elements for so many contacts
  explicit RowPush(const System& system) : foresight_(system) {
    if (system.elements() < most + 1)
      throw std::invalid_argument("elements = " + std::to_string(system.elements()) + ": must be at least " +
                                  std::to_string(most + 1) + " for " + std::to_string(most) + " contacts");
  }

  /// To be called where something else moves the beam.
  void forget() noexcept {
    foresight_.reset();
    contacts_.forget_pieces();
    forget_shape();
  }
  /// The same where what the hands did goes on.
  void forget_shape() noexcept {
    work_.forget(), continuation_.forget();
    let_go_.known = false;
  }
  /// Lets go of the beam.   @return as AllDisplacements::let_go(); snapped where it falls farther than its last forces led it
  template <class Way>
  Status release(Way& way) noexcept {
    const LetGo<Scalar> before = let_go_;
    const Status status = way.let_go();
    return status == Status::ok && before.fell(way.system_.total_potential()) ? Status::snapped : status;
  }

  /// @param way  AllDisplacements, which settles the system   @param range  says where they can touch
  /// @param all  in: where they are and whether they touched;  out: whether they touch, and their forces
  /// @return the worst Status of those that touch | iteration_limit where the passes have ended before the changes
  template <class Way, class Extent>
  Status push(Way& way, Obstacle* all, int count, const Extent& range) noexcept {
    System& system = way.system_;
    let_go_.known = false;
    for (int i = 0; i < count; ++i) {
      auto& pushed = all[i].pushed;
      const bool elsewhere = contacts_.elsewhere(system, all[i]);
      if (elsewhere) continuation_.forget();
      if (elsewhere || (!is_answer(pushed.status) && !pushed.past_end))
        pushed = {0, Status::ok}, pushed.s = all[i].round.s;
    }
    // A straight beam that one body presses has one shape for each press.
    if (count == 1 && way.single_valued_) {
      continuation_.forget();
      return answer(way, all, count, range);
    }
    Before& before = before_;
    bool rough = false;
    for (int i = 0; i < count; ++i) to_[i] = all[i].round, rough = rough || all[i].friction;
    bool whole = true;  // the first answer, for all of the way
    const auto go = [&](Scalar t) {
      for (int i = 0; i < count; ++i) {
        before.obstacle[i] = all[i], before.state[i] = contacts_.slots[i];
        if (all[i].friction) before.friction[i] = *all[i].friction;
        if (!whole) all[i].round = from_.knows(i) ? between(from_.round(i), to_[i], t) : to_[i];
      }
      before.work = work_, before.continuation = continuation_, before.force = system.linear_reaction();
      return answer(way, all, count, range);
    };
    const auto judge = [&] {
      if (!began_ || work_.strange()) return Branch::same;
      return continuation_.judge(
          {potential_, work_.done() - taken_, work_.size(), work_.change(), system.strain(), system.length(),
           work_.way(), rough, dimension == 3 && work_.turned()},
          [&] { return farthest(system.view(foresight_.before()), system.centreline()); });
    };
    const auto keep = [&](Status status) {
      if (is_answer(status) && work_.any()) continuation_.know(potential_);
      else continuation_.forget();
    };
    const auto back = [&] {
      if (whole) from_ = before.work;
      whole = false;
      system.go_back(foresight_.before(), before.force);
      foresight_.forget();
      system.draw();
      for (int i = 0; i < count; ++i) {
        all[i] = before.obstacle[i];
        static_cast<State&>(contacts_.slots[i]) = before.state[i];
        if (all[i].friction) *all[i].friction = before.friction[i];
      }
      work_ = before.work;
    };
    return continuation_.follow(go, judge, keep, back);
  }

 private:
  /// What answer() changes.
  struct Before {
    Obstacle obstacle[most] = {};
    FrictionState friction[most];
    State state[most];
    Work work;
    Continuation<Scalar> continuation;
    Scalar force = 0;
  };

  template <class Way, class Extent>
  Status answer(Way& way, Obstacle* all, int count, const Extent& range) noexcept {
    System& system = way.system_;
    contacts_.begin(system, all, count, range);
    const bool goes_on = look_ahead(system);
    for (int i = 0; i < count; ++i)
      if (all[i].touching && !(all[i].pushed.force < 0) && contacts_.beside_a_touch(i))
        all[i].touching = false;
    active().begin(system);
    if (foresight_.forth()) active().go_on();
    began_ = false;
    Status status = Status::ok;
    bool snapped = false;
    for (int pass = 1;; ++pass) {
      if constexpr (most > 1)
        if (count > 1) contacts_.part(system);
      status = solve(way, pass == 1, goes_on);
      snapped = snapped || status == Status::snapped;
      if (!is_answer(status)) {
        contacts_.lose(system);
        break;
      }
      contacts_.take(system);
      if (!contacts_.review(system)) break;
      if (contacts_.ran_away()) system.go_back(foresight_.before(), 0), system.draw();
      if (pass == most_passes) {
        status = Status::iteration_limit;
        break;
      }
    }
    if (snapped && status == Status::ok) status = Status::snapped;
    for (int i = 0; i < count; ++i) contacts_.end(system, i, status);
    const auto left = active().leave(system, status, work_);
    taken_ = left.taken;
    potential_ = system.foreseen_potential() + left.stored;
    foresight_.know(status == Status::ok, active(), [this](int i) -> const State& {
      contacts_.slots[i].force = contacts_.force_of(active()[i]);
      return contacts_.slots[i];
    });
    return status;
  }

  /// Those that touched before answer() do not touch any more.
  LetGo<Scalar> lets_go(const System& system) noexcept {
    Work work = before_.work;
    work.begin();
    for (int i = 0; i < active().size(); ++i)
      if (active()[i].kind == ObstacleKind::round) work.apart(i, active()[i].round);
    Scalar rubbed = 0;
    for (int i = 0; i < active().size(); ++i)
      if (active()[i].friction)
        rubbed += before_.friction[i].force.norm() * (work.way() + before_.friction[i].skin.norm());
    const auto& last = before_.continuation;
    return {last.potential(), work.ahead(), rubbed, system.strain(), last.known()};
  }
  /// @return whether the hands go on as they went
  bool look_ahead(const System& system) noexcept {
    const bool goes_on = foresight_.look(active());
    for (int i = 0; i < active().size(); ++i) {
      auto& now = contacts_.slots[i];
      if (!active()[i].touching) continue;
      now.begins = now;
      if (!goes_on) continue;
      const State ahead = foresight_.ahead(i);
      now.force = ahead.force, now.take_curve(ahead);
      if (active()[i].kind == ObstacleKind::round && !now.held) contacts_.place(system, i, ahead.s);
    }
    return goes_on;
  }

  template <class Way>
  Status solve(Way& way, bool first, bool goes_on) noexcept {
    System& system = way.system_;
    if (active().number() == 0) {
      if (!way.single_valued_) {
        let_go_ = lets_go(system);
        return release(way);
      }
      way.to_rest();
      return Status::ok;
    }
    // With friction what is near is tried first; all of the way may be a fall.
    const bool rough = active().any_rough();
    // Places in space stay in that where they hardly slide, and all do where there was none: else there may be none.
    bool stay = dimension == 2;
    const auto stays = [&](int i) {
      return dimension == 3 && active().hardly_slides(i, system.length() / 100000);
    };
    int moves = 0;
    const auto aim = [&] {
      active().aim(
          system, [this](int i) { return contacts_.contact(i); }, [&](int i) { return stay || stays(i); });
    };
    // Where some stay, all may have to, and the solves of a push are for both ways.
    bool some = false;
    for (int i = 0; i < active().size(); ++i) some = some || (active().goal(i) >= 0 && stays(i));
    const auto few = [&] {
      return !rough || (most == 1 && dimension == 2) ? close_by
             : most == 1                             ? near_in_space
             : some && !stay                         ? near_with_friction * 3 / 4
                                                     : near_with_friction;
    };
    bool all = !rough || way.descends() || active().falls();
    const auto begin_again = [&](Scalar force) {
      system.go_back(foresight_.before(), force);
      for (int i = 0; i < active().size(); ++i)
        if (active().goal(i) >= 0) static_cast<State&>(contacts_.slots[i]) = contacts_.slots[i].begins;
    };
    // Whether Coulomb's law holds, and the places are those of the equilibrium.
    const auto agrees = [&](Status found) {
      if (!rough) return true;
      if (is_answer(found)) {
        const bool settled = active().settled(system), moved = system.places_go_on();
        if (settled && (!moved || ++moves > most_moves)) return true;
        contacts_.take(system);
      } else {
        if (all) return true;
        // What two hold between them turns late, what one holds before its place stays.
        const bool turns = (stay || most == 1) && active().turn();
        if (!turns && !stay) {
          stay = true;
          active().begin_again(system);
          if (began_) begin_again(0);
          return false;
        }
        all = !turns;
      }
      if (active().torn() && began_) begin_again(0);
      return false;
    };
    const Scalar last = system.linear_reaction();
    if (first) {
      foresight_.go_on(system);
      began_ = true;
      if (!goes_on || rough) curvature_ = {};
      if (goes_on) {
        Status status;
        // What friction settles between two solves is no step of a hand.
        do status = way.settle_at_once(slack, aim, few(), rough ? nullptr : &curvature_);
        while (!agrees(status) && !all);
        if (status == Status::ok) return status;
        foresight_.forget();
        begin_again(last);
        if (!rough && contacts_.hold_sharp(system)) {
          status = way.settle_at_once(slack, aim, few());
          if (status == Status::ok) return status;
          begin_again(last);
        }
      }
      if (way.single_valued_ && nearer_at_rest(way)) {
        way.to_rest();
        contacts_.begin_at_rest(system);
      }
    }
    Status status;
    do status = all ? way.settle(last, slack, aim).status : way.settle_at_once(slack, aim, few());
    while (!agrees(status));
    return status;
  }

  /// Whether all that touch are nearer to the shape at rest than to the present one.
  template <class Way>
  bool nearer_at_rest(const Way& way) noexcept {
    const System& system = way.system_;
    Scalar jump = 0, from_rest = 0;
    for (int i = 0; i < active().size(); ++i) {
      if (active().goal(i) < 0 || active()[i].kind != ObstacleKind::round) continue;
      const Scalar s = contacts_.slots[i].s;
      const RoundContact round{active()[i].round};
      const auto off = [&](const auto& line) {
        return std::abs(round.clearance(line.node_at(s)) - active()[i].round.reach);
      };
      jump = (std::max)(jump, off(system.centreline()));
      from_rest = (std::max)(from_rest, off(system.view(way.rest_state_)));
    }
    return jump > system.length() / 1000 && from_rest < jump;
  }

  ActiveSet<System>& active() noexcept { return contacts_.active; }

  RowContacts<System> contacts_;
  RowForesight<System> foresight_;
  Curvature<Scalar> curvature_;
  bool began_ = false;  // foresight_ has the state before this push
  Work work_, from_;
  Before before_;
  Round to_[most] = {};
  Continuation<Scalar> continuation_;
  LetGo<Scalar> let_go_;
  Scalar potential_ = 0, taken_ = 0;  // of the last answer, and by friction [J]
};

}  // namespace hapbeam::detail
