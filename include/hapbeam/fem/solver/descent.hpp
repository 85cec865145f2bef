// SPDX-License-Identifier: MIT
// Downhill to a stable equilibrium, where Newton's method has none to go to: the beam after a snap.
//
// Each step solves (K + μM) Δ = -r.  With μ so large that all pivots are positive that leads downhill; a step that
// raises the potential, or a tangent that is not positive, is taken back and μ grows tenfold; a step that lowers it lets
// μ fall tenfold, to zero in the end, where the step is Newton's.  It is the path of a beam in a viscous fluid, which settles
// in the hollow on whose slope it was let go; where it stands on a ridge, whoever calls must have nudged it.
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
//
// Real-time: noexcept and no allocation where the system's are; at most max_solves linear solves.
// Source: Levenberg 1944 and Marquardt 1963, on the potential of a beam.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace hapbeam
