// Newton–Raphson with load stepping (thesis eq. 3.34–3.37) for any system that can take one Newton step.
//
// The path to the wanted state is a number t in [0, 1] that scales loads and prescribed displacements together.
// The first try goes all the way (t = 1); a step that does not converge is taken back and cut to a quarter.  The
// first iteration of a step carries the prescribed increment through the tangent, so it is also the predictor.
//
// A step has converged when the increment that would come next is below the tolerance.  With q = ‖Δ(k)‖/‖Δ(k-1)‖ < ½
// that increment is about q² ‖Δ(k)‖ (ten times that is assumed), because Newton is quadratic; it need not be computed to
// be known.  Where the first increment is as large as the state (first touch, zero crossing) its ratio shows no such
// thing yet, and q ‖Δ(k)‖ is assumed.  The tolerance is max(relative ‖x‖, absolute L, 4 eps ‖x‖): the floor keeps a relative
// criterion alive at zero, and below a few units in the last place of x no iteration leads.
//
//   expression of a system       meaning
//   --------------------------   -----------------------------------------------------------------------
//   s.set_target(t)              loads and prescribed displacement at path position t, from the saved state
//   s.iterate()                  one Newton step  -> {Status, size of the increment [m]}
//   s.save(), s.restore()        keep the state; go back to the kept one
//   s.size()                     largest displacement [m]
//   s.length()                   of the beam [m]
//
// Real-time: noexcept and no allocation where the system's are; at most max_solves linear solves.
#pragma once

#include <limits>

#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// What one Newton step did.
template <typename Scalar>
struct Iteration {
  Status status;  ///< ok | singular | non_finite
  Scalar size;    ///< [m] largest nodal increment, rotations times the element length
};

/// How a solve ended.
template <typename Scalar>
struct SolveReport {
  Status status;     ///< ok | iteration_limit | singular | non_finite
  int solves;        ///< linear solves, rejected steps included
  int steps;         ///< load steps that converged
  Scalar reached;    ///< path position t that the state stands for, 1 where status is ok
  Scalar increment;  ///< [m] estimated size of the increment that would come next
};

struct NewtonRaphson {
  double relative_tolerance = 1e-9;   ///< of the largest displacement; float stops at its round-off before
  double absolute_tolerance = 1e-13;  ///< of the beam's length
  int max_iterations = 12;            ///< per load step
  int max_solves = 48;                ///< in all: what bounds a tick
  double smallest_step = 1e-4;        ///< of the path

  template <class System>
  auto solve(System& system) const noexcept -> SolveReport<typename System::Scalar> {
    using S = typename System::Scalar;
    SolveReport<S> report{Status::ok, 0, 0, 0, 0};
    S step = 1;
    system.save();
    while (report.reached < 1) {
      const S t = report.reached + step < 1 ? report.reached + step : S(1);
      system.set_target(t);
      report.status = iterate(system, report);
      if (report.status == Status::ok) {
        report.reached = t;
        ++report.steps;
        system.save();
        step *= 2;
      } else {
        system.restore();
        step /= 4;
        if (step < S(smallest_step) || report.solves >= max_solves) break;
      }
    }
    return report;
  }

 private:
  template <class System, typename S>
  Status iterate(System& system, SolveReport<S>& report) const noexcept {
    S before = 0;
    for (int k = 1; k <= max_iterations && report.solves < max_solves; ++k) {
      const Iteration<S> iteration = system.iterate();
      ++report.solves;
      if (iteration.status != Status::ok) return iteration.status;
      report.increment = next_increment(k, iteration.size, before, system.size());
      if (report.increment <= tolerance(system)) return Status::ok;
      before = iteration.size;
    }
    return Status::iteration_limit;
  }

  /// Size of increment k + 1 from those of k and k - 1, ‖Δ‖ [m].
  template <typename S>
  static S next_increment(int k, S size, S before, S state) noexcept {
    if (k == 1) return size;
    const S rate = size / before;
    const bool quadratic = k > 2 || before < state / 4;
    return size * (rate < S(0.1) && quadratic ? 10 * rate * rate : rate < 1 ? rate : S(1));
  }

  template <class System>
  auto tolerance(const System& system) const noexcept -> typename System::Scalar {
    using S = typename System::Scalar;
    const S floor = S(absolute_tolerance) * system.length(), wanted = S(relative_tolerance),
            least = 4 * std::numeric_limits<S>::epsilon();
    const S relative = (wanted > least ? wanted : least) * system.size();
    return relative > floor ? relative : floor;
  }
};

}  // namespace hapbeam
