// SPDX-License-Identifier: MIT
// Descent: downhill to a stable equilibrium, where Newton's method has none to go to, the beam after a snap.  LoadPath: the branch of equilibria
// that a beam follows while its loads rise and its ends are moved, from nothing to their full size.
//
// Each step of a Descent solves (K + μM) Δ = -r.  With μ so large that all pivots are positive that leads downhill; a step that
// raises the potential, or a tangent that is not positive, is taken back and μ grows tenfold; a step that lowers it lets
// μ fall tenfold, to zero in the end, where the step is Newton's.  It is the path of a beam in a viscous fluid, which settles
// in the hollow on whose slope it was let go; where it stands on a ridge, whoever calls must have nudged it.
//
// Newton's method under the full load finds an equilibrium, but not always that of the branch: a cantilever under PL²/EI = 15
// may end with its tip turned the other way round.  So a correction after the predictor may turn no node by more than half of what
// the one before turned any, nor by more than a quarter of a radian; else the step is taken back and cut.
//
// Where the branch ends, the beam falls to a stable shape just beyond, and the path goes on from there.  It has snapped if that shape
// is another under the load before, too: a column that has buckled goes back.
//
//   expression of a system, beyond those of NewtonRaphson
//   -----------------------   ------------------------------------------------------------------------
//   s.factor(μ)               assembles and solves for an increment  -> Status
//   s.advance()               adds it
//   s.negative_pivots()       of the last factor()
//   s.potential()             V - λ f · x at the last factor() [J]
//   s.neutral()               as μ: a stiffness that is none, but for round-off
//   s.find_tensions()         of what is an unknown beside the shape: potentials are those of shapes
//   s.turn()                  largest rotation of a node in the last increment [rad]
//   s.nudge(a)                of a LoadPath: moves it by about a [m] off an equilibrium that gives way
//
// Descent is real-time, LoadPath offline: noexcept and without allocation where the system's members are; at most max_solves linear solves, of a
// LoadPath beside those of a few Descents.
// Source: Levenberg 1944 and Marquardt 1963, on the potential of a beam; Den Heijer and Rheinboldt, On steplength algorithms for a class of
// continuation methods, SIAM J. Numer. Anal. 18 (1981), for steps that contraction sizes.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

struct Descent {
  int max_solves = 48;         ///< what bounds a tick
  double first_shift = 100;    ///< μ
  double largest_shift = 1e9;  ///< where no step goes down, there is none
  double farthest = 1;         ///< [rad] that the first step turns a node: nothing says whether it goes down
  double enough = 1e-3;  ///< [rad] a step of Newton's no larger, as √(ΔᵀKΔ L/EI), leaves the rest to it

  /// Goes down from where the system is.
  /// @param solves  in and out: linear solves, counted on   @param t  position on the system's path, its end
  /// @return whether it has come near a stable equilibrium
  template <class System>
  bool solve(System& system, int& solves, typename System::Scalar t = 1) const noexcept {
    using S = typename System::Scalar;
    // Round-off, of a potential and, where a beam without stress has none, of its shape.
    const S slack = 100 * std::numeric_limits<S>::epsilon(),
            nothing = S(1e-4 * enough * enough) * system.unit() * system.unit();
    S shift = S(first_shift), good = shift, bad = 0, least = (std::numeric_limits<S>::max)();
    system.set_target(t);
    system.save();
    bool stepped = false;
    for (const int last = solves + max_solves; solves < last;) {
      ++solves;
      system.find_tensions();
      Status status = system.factor(shift);
      // What costs nothing has a pivot of either sign: a second look decides.
      if (System::neutral() > 0 && shift == 0 && status == Status::ok && system.negative_pivots() > 0) {
        ++solves;
        status = system.factor(System::neutral());
      }
      const S potential = system.potential();
      if (!(potential <= least + slack * std::abs(least) + nothing)) {
        system.restore();
        shift = 10 * (std::max)(good, S(0.1));
        least = (std::numeric_limits<S>::max)();
      } else if (status != Status::ok || system.negative_pivots() > 0) {
        // Just above the least shift that will do, a step goes far along what gives way.
        bad = (std::max)(shift, S(0.1));
        shift = good > S(1.3) * bad ? std::sqrt(good * bad) : good > bad ? good : 10 * bad;
      } else if (!stepped && system.turn() > S(farthest)) {
        shift *= 10;
      } else {
        system.save();
        // The first step also brings the contact to its place, from where potentials can be compared.
        if (stepped) least = potential;
        stepped = true;
        const bool within = shift == 0 && system.increment() <= S(enough) * system.unit();
        system.advance();
        if (within) return true;
        good = shift;
        shift = (std::max)(shift / 10, S(1.2) * bad);
        if (good <= 1 && bad < S(0.1)) shift = 0;
        bad /= 2;
      }
      if (!(shift < S(largest_shift))) break;
    }
    system.restore();
    return false;
  }
};

/// Where a path has led.
template <typename Scalar>
struct PathEnd {
  SolveReport<Scalar> report;  ///< ok | snapped, where the beam has jumped on the way | iteration_limit
  bool fell;                   ///< whether the branch ended or became unstable
};

struct LoadPath {
  int max_solves = 10000;
  int max_iterations = 12;           ///< per step
  double largest_correction = 0.25;  ///< [rad]
  double nothing = 1e-6;             ///< [rad] a rotation that is round-off
  double resolution = 1e-5;          ///< how closely the end of a branch is found, of the load there
  double fork = 1e-2;  ///< the same where it becomes unstable: nearer to that nothing drives the beam aside
  double jump = 1e-5;  ///< energy set free by a jump, of EI/L, at least

  /// Goes from the start of the system's path to its end.
  template <class System>
  [[gnu::cold]] auto solve(System& system) const noexcept -> PathEnd<typename System::Scalar> {
    using S = typename System::Scalar;
    PathEnd<S> end{{Status::iteration_limit, 0, 0, 0, 0, 1}, false};
    SolveReport<S>& report = end.report;
    S &t = report.reached, step = 1, beyond = 0;
    bool snapped = false;
    system.save();
    while (t < 1) {
      if (report.solves > max_solves) return end;
      const S to = (std::min)(t + step, S(1));
      const Step<S> made = go(system, to, report.solves);
      if (made.stays) {
        t = to;
        step *= 2;
        ++report.steps;
        system.save();
        continue;
      }
      system.restore();
      step = made.shorter * (to - t);
      const S closely = S(made.gives_way ? fork : resolution), here = (std::max)(t, closely);
      // A slender rod gives way soon after the start.
      if (step > (t == 0 && made.gives_way ? S(resolution) * S(resolution) : closely * here)) continue;
      // The branch ends here.  At t = 0 it has not begun: a beam that is bowed to begin with is in no equilibrium.
      if (t > 0) beyond = (std::max)(4 * beyond, 4 * closely);
      const S past = (std::min)(t + beyond * here, S(1)), before = potential(system, t, report.solves);
      if (t == 0) beyond = closely;
      end.fell = true;
      const auto fall = [&](S at) {
        if (made.gives_way) system.nudge(system.length() / 1000);
        return descend(system, at, report.solves);
      };
      if (!fall(past)) return end;
      if (t > 0) {
        if (!descend(system, t, report.solves)) return end;
        if (before - potential(system, t, report.solves) > S(jump) * system.unit() * system.unit())
          snapped = true;
        else if (!fall(past)) return end;
        else t = past;
      }
      system.save();
      step = t > 0 ? beyond * here : S(1);
    }
    report.status = snapped ? Status::snapped : Status::ok;
    return end;
  }

 private:
  template <typename S>
  struct Step {
    bool stays;      ///< on the branch, and that is stable
    bool gives_way;  ///< on the branch, and that is not stable
    S shorter;       ///< part of the step that would stay
  };

  template <class System, typename S = typename System::Scalar>
  Step<S> go(System& system, S t, int& solves) const noexcept {
    constexpr Step<S> lost{false, false, S(0.25)};
    const S enough = t < 1 ? S(1e-4) : S(1e-5);
    system.set_target(t);
    S first = 0, before = 0;
    for (int k = 0; k < max_iterations; ++k) {
      ++solves;
      if (system.factor(0) != Status::ok) return lost;
      const S turn = system.turn();
      if (!std::isfinite(turn)) return lost;
      const bool done = turn <= (std::max)(k == 0 ? S(0) : enough * first, S(nothing));
      if (k > 0 && !done) {
        const S excess = (std::max)(2 * turn / before, turn / S(largest_correction));
        if (excess > 1) return {false, false, (std::max)(S(0.5) / excess, S(0.01))};
      }
      system.advance();
      if (done) return stable(system, solves, k) ? Step<S>{true, false, 1} : Step<S>{false, true, S(0.25)};
      if (k == 0) first = turn;
      before = turn;
    }
    return lost;
  }

  /// The last tangent is that of the state before the last increment.  Where it has a negative pivot, or that increment was the whole step,
  /// the tangent is assembled anew.
  template <class System>
  static bool stable(System& system, int& solves, int corrections) noexcept {
    if (corrections > 1 && system.negative_pivots() == 0) return true;
    ++solves;
    return system.factor(system.neutral()) == Status::ok && system.negative_pivots() == 0;
  }

  template <class System, typename S = typename System::Scalar>
  bool descend(System& system, S t, int& solves) const noexcept {
    Descent patient;
    patient.max_solves = max_solves;
    patient.largest_shift = 1e14;
    return patient.solve(system, solves, t);
  }

  template <class System, typename S = typename System::Scalar>
  static S potential(System& system, S t, int& solves) noexcept {
    ++solves;
    system.set_target(t);
    system.factor(0);
    return system.potential();
  }
};

}  // namespace hapbeam
