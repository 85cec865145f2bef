// SPDX-License-Identifier: MIT
// Newton–Raphson with load stepping (thesis eq. 3.34–3.37) for any system that can take one Newton step.
//
// The path to the wanted state is a number t in [0, 1] that scales loads and prescribed displacements together.
// The first try goes all the way (t = 1); a step that does not converge is taken back and cut to an eighth, the next is four
// times the last that did, and a budget that ends before the way does leaves the size of the next step, so that any
// budget gets there in the end.  The first iteration of a step carries the prescribed increment through the tangent, so it
// is also the predictor.  Where that overshoots, the next ones come back by a factor of about 1.5 each until they are near, so a
// step that still halves its increments when its iterations are used up goes on, and one whose eighth increment is still
// nine tenths of the state is given up.
//
// Increments are measured in the norm of the tangent, |Δ|² = ΔᵀKΔ, where metres and radians, stretching and bending
// weigh what they cost, and which bounds the relative error of the contact force: |δF|/F <= about |Δ|/√(2V).
// A step has converged when the increment that would come next is below the tolerance; it need not be computed to be
// known, because Newton is quadratic: |Δ(k+1)| = C|Δ(k)|² with C taken for four times the larger of the last two that were
// measured, but no less than 10/√(2V), or 100/√(2V) while there are none (0.1 to 40 is usual; what is measured of an increment that leads back
// from a state that has blown up is nothing).  Where normal forces are unknowns of a nearly inextensible beam increments come in pairs, one of u and one
// of w, and the one of w follows from that of u: then C is 1000/√(2V) at least of the first increment, 20 000/√(2V) after one above a twentieth of
// √(2V), and 50/√(2V) else.  The tolerance is relative √(2V), never below absolute √(EI/L): a relative criterion has no meaning at rest.
// An increment that is 1/(10 √eps) times the one before ends a step without: where the energy has grown by the square of
// that, round-off keeps nothing of the state that it was, and where Newton's method then arrives is anywhere.
// An increment below ε = n √eps/20, in units of √(2V), also ends a step where the one before was below √ε: after a larger one an increment of N may
// follow, which leaves the next one of w larger than itself.  Increments stop shrinking at round-off, √eps n² of the state where
// bending is worst, of which no C can be measured; with C = 100/√(2V) the error of the step that was taken is eps n²/4.  That
// holds for the linear equations' force and not for one that is computed anew from rounded nodes.
//
//   expression of a system       meaning
//   --------------------------   -----------------------------------------------------------------------
//   s.set_target(t)              loads and prescribed displacement at path position t, from the saved state
//   s.iterate()                  one Newton step  -> {Status, |Δ|}
//   s.save(), s.restore()        keep the state; go back to the kept one
//   s.size()                     √(2V) of the state before the last step, or of what else is to be as exact [√J]
//   s.unit()                     √(EI/L), the size of a rotation by 1 rad [√J]
//   s.elements()                 n
//   System::in_pairs             true where normal forces are unknowns; may be left out
//   s.round_off()                |Δ| of an increment that is round-off in this state, which ends a step; may be left out
//
// Real-time: noexcept and no allocation where the system's are; at most max_solves linear solves.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// What one Newton step did.
template <typename Scalar>
struct Iteration {
  Status status;  ///< ok | singular | non_finite
  Scalar size;    ///< |Δ| [√J]
};

/// How a solve ended.
template <typename Scalar>
struct SolveReport {
  Status status;   ///< ok | iteration_limit | singular | non_finite
  int solves;      ///< linear solves, rejected steps included
  int steps;       ///< load steps that converged
  Scalar reached;  ///< path position t that the state stands for, 1 where status is ok
  Scalar error;  ///< |Δ| of the increment that would come next, estimated, over √(2V): relative force error
  Scalar step;   ///< of the path, to be tried first when the path is continued from here
};

/// What the first two increments of a solve made of the next ones, for solves that follow each other as the ticks of a hand do: |Δ(k+1)| = C|Δ(k)|².
/// An increment within a factor of two of the one that was measured, in units of √(2V), is taken to have four times its C.  That rises by a quarter with each
/// solve that is accepted by it, so that it is measured anew before it is a guess.  In a state that is larger C √(2V) is as many times as large: what hardly
/// moves is linear.
template <typename Scalar>
class Curvature {
 public:
  /// C √(2V) of increment k, of so many √(2V); infinite where nothing is known.   @param state √(2V) [√J]
  Scalar of(int k, Scalar size, Scalar state) const noexcept {
    const bool known = k <= 2 && size_[k - 1] < 2 * size && size < 2 * size_[k - 1];
    return known ? 4 * c_[k - 1] * (std::max)(state / state_[k - 1], Scalar(1))
                 : std::numeric_limits<Scalar>::infinity();
  }
  void measure(int k, Scalar size, Scalar next, Scalar state) noexcept {
    if (k <= 2) size_[k - 1] = size, c_[k - 1] = next / (size * size), state_[k - 1] = state;
  }
  void accept(int k) noexcept {
    if (k <= 2) c_[k - 1] *= Scalar(1.25);
  }

 private:
  Scalar size_[2] = {0, 0}, c_[2] = {0, 0}, state_[2] = {1, 1};
};

namespace detail {

template <class System>
using RoundOff = decltype(std::declval<const System&>().round_off());
template <class System>
using InPairs = std::enable_if_t<System::in_pairs>;

}  // namespace detail

struct NewtonRaphson {
  double relative_tolerance = 1e-8;   ///< of the force
  double absolute_tolerance = 1e-12;  ///< [rad] a rotation that is nothing
  int max_iterations = 16;            ///< per load step, and more while each halves the increment
  int max_solves = 48;                ///< in all, 3 or more: what bounds a tick
  double smallest_step = 1e-4;        ///< of the path
  bool pairs_differ = true;  ///< the first increment of a pair says nothing of that of the next solve

  /// Goes the way to t = 1.  @param first_step  of the path: 1, or what the report of an unfinished solve says
  /// @param known  of the solves before, null: they say nothing of this one;  else the way is one step, which is not taken back where it fails
  template <class System>
  auto solve(System& system, typename System::Scalar first_step = 1,
             Curvature<typename System::Scalar>* known = nullptr) const noexcept
      -> SolveReport<typename System::Scalar> {
    using S = typename System::Scalar;
    SolveReport<S> report{Status::ok, 0, 0, 0, 0, first_step};
    S& step = report.step;
    if (!known) system.save();
    while (report.reached < 1) {
      const S t = (std::min)(report.reached + step, S(1));
      system.set_target(t);
      report.status = iterate(system, report, known);
      if (report.status == Status::ok) {
        report.reached = t;
        ++report.steps;
        if (t < 1) system.save();
        step *= 4;
      } else {
        if (known) break;
        system.restore();
        const bool out_of_budget = report.solves >= max_solves;
        // A step that the budget cut short does not show that it was too large, unless it had the whole budget.
        if (!out_of_budget || report.steps == 0) step /= 8;
        if (step < S(smallest_step) || out_of_budget) break;
      }
    }
    if (report.reached == 1 || step < S(smallest_step)) step = 1;
    return report;
  }

 private:
  /// C √(2V) of increment k, until more is measured.   @param from_afar  after an increment above a twentieth of the state
  template <class System>
  static constexpr auto least_curvature(int k, bool from_afar) noexcept -> typename System::Scalar {
    if (detail::offers<detail::InPairs, System>) return k == 1 ? 1000 : from_afar ? 20000 : 50;
    return k > 2 ? 10 : 100;
  }
  template <class System>
  static auto round_off([[maybe_unused]] const System& system) noexcept -> typename System::Scalar {
    if constexpr (detail::offers<detail::RoundOff, System>) return system.round_off();
    else return 0;
  }
  template <class System, typename S>
  Status iterate(System& system, SolveReport<S>& report, Curvature<S>* known) const noexcept {
    const S n = static_cast<S>(system.elements());
    const S floor = S(absolute_tolerance) * system.unit();
    const S noise = n * std::sqrt(std::numeric_limits<S>::epsilon()) / 20;
    const S lost = 10 * std::sqrt(std::numeric_limits<S>::epsilon());
    S before = 0, measured_before = 0;
    bool shrinks = false, from_afar = false;
    for (int k = 1; (k <= max_iterations || shrinks) && report.solves < max_solves; ++k) {
      const Iteration<S> iteration = system.iterate();
      ++report.solves;
      if (iteration.status != Status::ok) return iteration.status;
      if (k > 1 && iteration.size * lost > before) return Status::iteration_limit;
      const S state = system.size(), tolerance = S(relative_tolerance) * state;
      // The first increment holds the jump of the contact, which the tangent's norm overstates: C is measured without it.
      const S measured = k > 2 ? 4 * iteration.size / (before * before) : S(0);
      S least = least_curvature<System>(k, from_afar);
      if (known) {
        if (k > 1) known->measure(k - 1, before / state, iteration.size / state, state);
        // The increment of w that follows one of u is another in the next element.
        if (k > 1 || !detail::offers<detail::InPairs, System> || !pairs_differ)
          least = (std::min)(least, known->of(k, iteration.size / state, state));
      }
      const S curvature = (std::max)({measured, measured_before, state > 0 ? least / state : S(0)});
      // No larger than this one, which is what round-off would else make of it.
      const S next =
          state > 0 ? (std::min)(curvature * iteration.size, S(1)) * iteration.size : iteration.size;
      report.error = state > 0 ? next / state : S(0);
      if (!std::isfinite(state)) return Status::non_finite;
      const bool lands = k == 1 || before <= std::sqrt(noise) * state;
      if (next <= (std::max)(tolerance, floor) || (lands && iteration.size <= noise * state) ||
          iteration.size <= round_off(system)) {
        if (known) known->accept(k);
        return Status::ok;
      }
      if (k == 8 && iteration.size > S(0.9) * state) return Status::iteration_limit;
      shrinks = iteration.size <= before / 2;
      from_afar = from_afar || iteration.size > S(0.05) * state;
      before = iteration.size;
      measured_before = measured;
    }
    return Status::iteration_limit;
  }
};

}  // namespace hapbeam
