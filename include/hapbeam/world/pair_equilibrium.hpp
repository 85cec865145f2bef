// SPDX-License-Identifier: MIT
// Equilibria of rods and pairs: who touches whom, Newton's method for those, and falls where no equilibrium goes on.
//
// Pairs are an active set: after each solution the one that pulls most lets go, or the deepest of those that do not touch yet does.  A fall goes down as in a
// viscous fluid, (K + μM) Δ = -r, with the pairs that touch on the way; μ grows where a step leads too far or is not stable, and goes to zero.
// Real-time: noexcept, no allocation; at most max_solves linear solves between two begin(), and two more in each solution that gives way.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <hapbeam/world/approach.hpp>
#include <hapbeam/world/pair_system.hpp>

namespace hapbeam::detail {

/// How a step ended.
enum class Outcome {
  settled,
  too_far,  ///< rods that may meet have moved too far for one step, or there was no time for more
  lost,     ///< no stable equilibrium goes on
  full,     ///< no room for another contact, or elements are too long for the force of one
};

template <class Element>
class PairEquilibrium {
 public:
  using System = PairSystem<Element>;
  using Body = typename System::Body;
  /// Of the distance of rods to their reach, that keeps them on their sides.
  static constexpr double closest = 0.5;
  static constexpr double nothing = 1e-6;  ///< of a reach

  /// @throws std::invalid_argument as PairSystem
  PairEquilibrium(const std::vector<WorldRod>& rods, const std::vector<RigidBody>& rigid,
                  const std::vector<Joint>& joints, const NewtonRaphson& solver)
      : system_(rods, rigid, joints), solver_(solver) {}
  System& system() noexcept { return system_; }
  const System& system() const noexcept { return system_; }

  /// Begins a tick, or a step of time.   @param share  so many times as many solves as in a tick are in it
  void begin(int share = 1) noexcept {
    solves_ = 0, most_solves_ = share * solver_.max_solves, changed_ = false,
    failure_ = Status::iteration_limit;
    kind_ = 0, lost_ = 0;
  }
  /// Begins a stage, 0 or 1, of a step of time.   @param known  whether that of the step before tells how linear it is
  void begin_stage(int stage, bool known) noexcept {
    kind_ = 1 + stage, changed_ = false, lost_ = 0;
    if (!known) curvature_[std::size_t(kind_)] = {};
  }
  int solves() const noexcept { return solves_; }
  int left() const noexcept { return most_solves_ - solves_; }
  /// Whether another pair touches than before begin().
  bool changed() const noexcept { return changed_; }
  /// Why the last step was lost.
  Status failure() const noexcept { return failure_; }

  /// Finds the equilibrium for where the ends are led, and who touches whom there.
  Outcome settle() noexcept {
    Curvature<double> unknown;
    int leaves = 0, tries = 0;
    let_go_ = {-1, -1};
    system_.begin_friction(guesses[std::size_t(lost_) % guesses.size()]);
    for (int k = system_.joints(); k < system_.pairs(); ++k) {
      RodPair& pair = system_.pair(k);
      if (has_left_row(k)) pair.held[0] = false;
      pair.mark();
    }
    for (int pass = 0; pass < 4 + 2 * most_pairs; ++pass) {
      if (left() <= 0) return Outcome::too_far;
      NewtonRaphson solver = solver_;
      solver.max_solves = (std::min)(left(), solver_.max_solves);
      if (kind_ > 0) solver.relative_tolerance = in_time;
      solver.max_iterations = (std::min)(solver.max_iterations, pass == 0 ? 8 : 16);
      const SolveReport<double> report =
          solver.solve(system_, 1, pass == 0 ? &curvature_[std::size_t(kind_)] : &unknown);
      solves_ += report.solves;
      if (report.status != Status::ok) {
        system_.restore();
        if (lost_++ == 0 && system_.rough() && left() > 0) return settle();
        return failure_ = report.status, Outcome::lost;
      }
      const Look look = look_around(system_);
      // What leaps as it begins to slide does so in steps of any length.
      if (!look.close) return tries > 0 ? Outcome::lost : Outcome::too_far;
      // What pulls as it sticks may press as it slides.
      if (!system_.settled()) {
        if (tries++ < most_tries) continue;
        return failure_ = Status::iteration_limit, Outcome::lost;
      }
      if (release(pulling()) || release(needless())) continue;
      // One that comes back to its end has left it for a place that gives way.
      if (leave_end()) {
        if (leaves++ < 2) continue;
        return failure_ = Status::iteration_limit, Outcome::lost;
      }
      if (look.deepest < -nothing && !is_at_edge(look)) {
        if (!meet(look)) return Outcome::full;
        continue;
      }
      if (look.least < closest) return Outcome::full;
      if (system_.is_open()) return failure_ = Status::singular, Outcome::lost;
      // What is in motion may be on its way down.
      return kind_ == 0 && gives_way() ? (failure_ = Status::iteration_limit, Outcome::lost)
                                       : Outcome::settled;
    }
    return failure_ = Status::iteration_limit, Outcome::lost;
  }
  /// Down to the next stable equilibrium, as in a viscous fluid:  (K + μM) Δ = -r,  with the pairs that touch on the way, which slide without friction.
  /// A step may raise the potential by a tenth of what bends all by 1 rad: the second order of a turn, which the next one takes back.
  /// @param from, to  of the path, 0 to 1, on which ends and bodies are led meanwhile
  Outcome fall(double from, double to) noexcept {
    constexpr double first_shift = 100, least_shift = 1e-3, largest_shift = 1e12, farthest = 1, enough = 1e-3,
                     any = std::numeric_limits<double>::infinity();
    system_.let_go();
    system_.save();
    if (on_ridge_)
      for (Body& body : system_.bodies())
        if (body.moves && (body.sides.any() || body.negative_pivots() > 0))
          body.chain().nudge(body.length() / 1000, -1, 1);
    on_ridge_ = false;
    double bad = 0;                         // a shift with which a step went too far
    double led = to - from, highest = any;  // that the potential may be where nothing is led [J]
    for (double shift = first_shift; left() > 0;) {
      const double next = (std::min)(from + led, to);
      system_.aim(next);
      system_.set_target(1);
      ++solves_;
      const bool steep = system_.factor(shift) != Status::ok || system_.negative_pivots() > 0;
      if (!steep && system_.turn() <= farthest) {
        const bool near_by = shift == 0 && next >= to && system_.increment() <= enough * system_.unit();
        system_.advance();
        const Look look = look_around(system_);
        const double potential = system_.potential();
        if (look.close && look.least >= closest && (next > from || potential <= highest)) {
          const int pairs = system_.pairs();
          while (release(pulling()) || leave_end()) continue;
          if (look.deepest < -nothing && !meet(look)) return Outcome::full;
          system_.save();
          highest = look.deepest < -nothing || system_.pairs() != pairs
                        ? any
                        : (std::min)(highest, potential + system_.unit() * system_.unit() / 10);
          from = next, led *= 4;
          if (near_by && settle() == Outcome::settled) return Outcome::settled;
          if (near_by) system_.restore(), shift = first_shift;
          else shift = shift > least_shift || bad > least_shift ? (std::max)(shift / 10, 1.5 * bad) : 0;
          bad /= 2;
          continue;
        }
        system_.restore();
      }
      bad = (std::max)(shift, least_shift), shift = 3 * bad, led /= 4;
      if (!(shift > largest_shift)) continue;
      return failure_ = Status::iteration_limit, Outcome::lost;
    }
    return Outcome::too_far;
  }

 private:
  // Of the stiffness by which friction is found, one after the other has led nowhere: by turns softer and stiffer leads somewhere soonest.
  static constexpr std::array<RubGuess, 5> guesses{{{1, RubGuess::slips},
                                                    {1, RubGuess::learns},
                                                    {1. / 30, RubGuess::sticks},
                                                    {3, RubGuess::slips},
                                                    {1e-3, RubGuess::sticks}}};
  static constexpr double apart = 1e-3;    // of a reach
  static constexpr double in_time = 1e-9;  // of the force: errors of steps add up
  static constexpr int most_tries = 7;     // of friction to settle

  bool gives_way() noexcept {
    on_ridge_ = false;
    if (system_.negative_pivots() <= 0) return false;
    ++solves_;
    on_ridge_ = system_.factor(Body::System::neutral()) == Status::ok && system_.negative_pivots() > 0;
    return on_ridge_;
  }
  /// A place leaves an end of its rod.   @return whether there is one
  bool leave_end() noexcept {
    for (int k = system_.joints(); k < system_.pairs(); ++k)
      for (std::size_t side = 0; side < 2; ++side)
        if (system_.moves(system_.pair(k)) &&
            (side == 0 && system_.is_pinned(system_.pair(k)) ? has_left_row(k)
                                                             : system_.pair(k).leaves_end(side)))
          return system_.pair(k).held[side] = false, true;
    return false;
  }
  /// The pair that pulls most.   @return -1: there is none
  int pulling() const noexcept {
    int worst = -1;
    for (int k = system_.joints(); k < system_.pairs(); ++k) {
      const RodPair& pair = system_.pair(k);
      if (system_.moves(pair) && !(pair.force > 0) && (worst < 0 || pair.force < system_.pair(worst).force))
        worst = k;
    }
    return worst;
  }
  /// A pair that is apart, between clamps that no force moves, or one of two that have come together.   @return -1: there is none
  int needless() const noexcept {
    for (int k = system_.joints(); k < system_.pairs(); ++k) {
      const RodPair& pair = system_.pair(k);
      if (!system_.moves(pair)) continue;
      const auto is_apart = [&](double distance) { return distance - pair.reach > apart * pair.reach; };
      // Under compression, and where others press, the true curve bulges beyond the drawn one.
      if (is_apart(pair.distance(system_.between(pair))) && is_apart(system_.distance(pair))) return k;
      for (int j = system_.joints(); j < k; ++j)
        if (beside_each_other(system_, pair, system_.pair(j), 1, 0)) return k;
    }
    return -1;
  }
  /// @param pair  negative: none   @return whether it has let go
  bool release(int pair) noexcept {
    if (pair < 0) return false;
    let_go_ = system_.pair(pair).rod;
    system_.remove(pair);
    return changed_ = true;
  }

  bool is_beside_another(int k) const noexcept {
    const RodPair& pair = system_.pair(k);
    const double stride = system_.along_tube(pair) ? row_stride : 1;
    for (int j = 0; j < system_.pairs(); ++j)
      if (j != k && beside_each_other(system_, pair, system_.pair(j), 0, stride)) return true;
    return false;
  }
  /// Whether it has been in a row of contacts, and is no more.
  bool has_left_row(int k) const noexcept {
    return system_.is_pinned(system_.pair(k)) && !is_beside_another(k);
  }

  /// What lets go in a stage of a step of time stays away in it: the drawn cubics may still lie in each other.
  bool is_at_edge(const Look& look) const noexcept {
    constexpr double edge = 0.05;  // of a reach
    return kind_ > 0 && look.pair.rod == let_go_ && look.deepest > -edge;
  }
  /// One more touches.   @return whether there was room
  bool meet(const Look& look) noexcept {
    changed_ = true;
    RodPair pair = look.pair;
    for (std::size_t side = 0; side < 2; ++side)
      pair.held[side] = pair.s[side] <= 0 || pair.s[side] >= system_.length(pair.rod[side]);
    if (!system_.add(pair)) return false;
    const int added = system_.pairs() - 1;
    // In a row along a tube the gap has no least distance to which a place could go.
    for (int k = system_.joints(); k <= added; ++k) {
      RodPair& beside = system_.pair(k);
      const bool stays = system_.along_tube(beside) ? beside.fresh || !system_.parts(beside) : k == added;
      beside.held[0] = beside.held[0] || (stays && is_beside_another(k));
    }
    system_.pair(added).mark();
    system_.spread();
    return true;
  }

  System system_;
  NewtonRaphson solver_;
  std::array<Curvature<double>, 3> curvature_;   // of equilibria, and of both stages of a step of time
  int solves_ = 0, most_solves_ = 0, kind_ = 0;  // the last: which of them
  std::array<int, 2> let_go_{};                  // of which rods a pair has in this solution
  int lost_ = 0;                                 // times that friction has led nowhere in this step
  bool changed_ = false, on_ridge_ = false;
  Status failure_ = Status::iteration_limit;
};

}  // namespace hapbeam::detail
