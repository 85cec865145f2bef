// SPDX-License-Identifier: MIT
// A press of any beam or rod, solved for the displacements of all nodes: the general way of FemModel.
//
// BeamSystem or RodSystem is solved by Newton–Raphson from the last press or from rest, whichever is closer; where a branch ends, by
// Descent to a stable shape.
// Offline: construction allocates, finds the shape at rest and may throw.  Servo: every other member is noexcept and
// allocation-free, with the solves of FemModel.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <hapbeam/check.hpp>
#include <hapbeam/fem/beam_system.hpp>
#include <hapbeam/fem/contact/row_push.hpp>
#include <hapbeam/fem/press.hpp>
#include <hapbeam/fem/solver/load_path.hpp>

namespace hapbeam {

/// How a model on one mesh answers otherwise than one on another.
template <typename Scalar>
struct MeshDifference {
  Scalar difference;  ///< [N] largest at a contact; infinite where the one has no such equilibrium
  Scalar force;       ///< [N] largest of the other
};

template <class Element, typename ScalarType, int Elements, int MaxElements, class Solver>
class AllDisplacements {
 public:
  using Scalar = ScalarType;
  using Body = typename detail::SystemOf<Element>::Body;
  static constexpr int dimension = dimension_of<Element>;

  /// Finds the shape at rest.
  /// @throws std::invalid_argument as BeamSystem, and where round-off leaves no stiffness of so many elements
  [[gnu::cold]] AllDisplacements(const Body& beam, int elements, const Solver& solver)
      : system_(beam, elements), rest_state_(elements), solver_(solver), single_valued_(beam.straight()) {
    find_rest(beam);
    system_.keep(rest_state_);
    home_ = system_.middle();
    drawn(0);
  }

  /// Prescribes the displacement along request.normal at request.s.
  /// @param valid  whether there is a request
  /// @return force [N], not always finite, and ok | snapped | invalid_request | iteration_limit | singular | non_finite
  Response<Scalar> press(const Push<Scalar, dimension>& request, bool valid) noexcept {
    if (!begins(valid)) return {0, report_.status};
    if constexpr (any_rotation<Element>) pushes_.forget();
    return place_.push(*this, request);
  }

  /// Lays the beam on circles, a rod on capsules.  @param all  in and out   @param range  says where they can touch
  /// @return the status that is common to all of them
  Status push(Obstacle<Scalar, dimension>* all, int count, const PressRange<Scalar>& range) noexcept {
    if (!begins(true)) return report_.status;
    place_.forget();
    return drawn(pushes_.push(*this, all, count, range));
  }

  /// Whether the mesh is too coarse for a force at s.   @param s  [m]   @param force  [N]
  bool too_coarse(Scalar s, const VectorOf<Scalar, dimension>& force) const noexcept {
    return system_.too_coarse(s, force);
  }

  /// Moves a clamped end of a rod, without a contact.
  template <class Side, class Pose>
  HeldEnd<Scalar> hold(Side side, const Pose& pose) noexcept {
    const auto k = static_cast<std::size_t>(side);
    const auto take = [&] {
      HeldEnd<Scalar> held = system_.reaction(k);
      if (report_.status != Status::ok) held.status = report_.status;
      return held;
    };
    report_ = {Status::invalid_request, 0, 0, 0, 0, report_.step};
    if (!is_answer(rest_.status)) return report_.status = rest_.status, take();
    if (!system_.chain().place_end(k, pose)) return take();
    single_valued_ = false;
    pushes_.forget_shape(), place_.forget();
    const auto aim = [this] { system_.set_goal(); };
    aim();
    // On the way down Newton's method may be near enough by now.
    report_ =
        descends() ? solve_within(solver_.max_solves / 4) : solve_within(solver_.max_solves, report_.step);
    Descent descent;
    descent.max_solves = solver_.max_solves - report_.solves;
    const bool on_ridge = gives_way(), on_its_way = report_.steps > 0 && descent.max_solves <= 0;
    if ((on_ridge || (report_.status == Status::iteration_limit && !on_its_way)) &&
        !fall(on_ridge, descent, aim))
      reset();
    HeldEnd<Scalar> held = drawn(take());
    if (!held.force.allFinite() || !held.moment.allFinite())
      held.force.setZero(), held.moment.setZero(), held.status = report_.status = Status::non_finite;
    // A shape from which nothing leads to the hand's pose is left for that at rest.
    unanswered_ = is_answer(held.status) ? 0 : unanswered_ + 1;
    if (held.status == Status::non_finite || unanswered_ == patience) {
      const Status status = report_.status;
      reset();
      report_.status = status;
    }
    return held;
  }

  /// Descends to a shape at rest.  One that is folded, which only a request beyond all reach leaves, goes back to where it began.
  /// @return ok | snapped | iteration_limit
  Status release() noexcept { return drawn(report_.status = pushes_.release(*this)); }
  Status let_go() noexcept {
    forget();
    if (single_valued_) {
      reset();
      return Status::ok;
    }
    const auto aim = [this] { system_.set_goal(); };
    aim();
    report_ = {Status::ok, 0, 0, 0, 0, 1};
    Descent descent;
    descent.max_solves = solver_.max_solves;
    if (!fall(false, descent, aim) || system_.folded(rest_state_)) {
      to_rest();
      return report_.status = Status::snapped;
    }
    if (report_.status != Status::snapped) return report_.status;
    const Middle before = home_;
    home_ = system_.middle();
    return (home_ - before).norm() > system_.length() / 1000 ? Status::snapped : Status::ok;
  }

  /// Back to the shape that construction has found, as a new model.
  void reset() noexcept {
    to_rest();
    report_.step = 1;
    drawn(0);
  }

  /// Takes the shape of another one of the same body, and answers where that is touched.
  MeshDifference<Scalar> differ_from(const AllDisplacements& other) noexcept {
    using Vector = typename System::Vector;
    forget();
    course_ = Course::stands;
    system_.take_shape(other.system_);
    system_.set_goal_of(other.system_);
    report_ = solve_within(solver_.max_solves);
    MeshDifference<Scalar> found{0, 0};
    for (int k = 0; k < other.system_.rows().size(); ++k) {
      const Vector its = other.system_.contact_force(k), miss = system_.contact_force(k) - its;
      found.difference = (std::max)(found.difference, std::sqrt(miss.squaredNorm()));
      found.force = (std::max)(found.force, std::sqrt(its.squaredNorm()));
    }
    const bool stands = report_.status == Status::ok && !gives_way() && std::isfinite(found.difference);
    if (!stands) found.difference = std::numeric_limits<Scalar>::infinity();
    return drawn(found);
  }

  int elements() const noexcept { return system_.elements(); }
  Centreline<Scalar, dimension> shape() const noexcept { return system_.drawn(); }
  Scalar strain_energy() const noexcept { return system_.strain_energy(); }
  InternalForces<Scalar, dimension> internal_forces(int e, Scalar s, Scalar thickness) const noexcept {
    return system_.internal_forces(e, s, thickness);
  }
  /// How the search for the shape at rest ended.
  const SolveReport<Scalar>& rest() const noexcept { return rest_; }
  /// How the last press or release ended.
  const SolveReport<Scalar>& report() const noexcept { return report_; }

 private:
  template <typename S>
  using SystemIn = typename detail::SystemOf<Element>::template System<S, Elements, MaxElements>;
  using System = SystemIn<Scalar>;
  using Pushes = detail::RowPush<System>;
  friend Pushes;
  using Places = detail::PlacePush<Element, System>;
  friend Places;
  using Middle = decltype(std::declval<const System&>().middle());

  enum class Course {
    stands,
    falls,     ///< off the shape that gave way, and not yet at a stable one
    descends,  ///< and not yet near one
  };
  bool descends() const noexcept { return course_ == Course::descends; }
  void descend() noexcept { course_ = Course::descends; }

  void to_rest() noexcept {
    system_.set_state(rest_state_);
    if constexpr (dimension == 3) system_.chain().go_home();
    home_ = system_.middle();
    course_ = Course::stands;
    unanswered_ = 0;
    forget();
  }
  /// Draws the beam.   @return the answer
  template <class Answer>
  const Answer& drawn(const Answer& answer) noexcept {
    system_.draw();
    return answer;
  }
  void forget() noexcept { pushes_.forget(), place_.forget(); }

  /// @return whether there is a request to answer; if not, report() has its status
  bool begins(bool valid) noexcept {
    left_ = solver_.max_solves;
    first_ = true;
    report_ = {Status::invalid_request, 0, 0, 0, 0, report_.step};
    if (valid && !is_answer(rest_.status)) report_.status = rest_.status;
    return valid && is_answer(rest_.status);
  }

  /// settle() in a few iterations, for a beam that is on its branch and nearly there.  @param few  linear solves   @param known  as of NewtonRaphson
  /// @return ok, or the system may be anywhere
  template <class Aim>
  Status settle_at_once(int looser, Aim&& aim, int few, Curvature<Scalar>* known = nullptr) noexcept {
    aim();
    report_ = solve_within((std::min)(left_, few), 1, looser, known);
    const bool stable = !gives_way();
    left_ -= report_.solves;
    if (report_.status != Status::ok || !stable) report_ = {Status::iteration_limit, 0, 0, 0, 0, 1};
    return report_.status;
  }

  /// Solves for what aim() sets as the system's goal.  @param last  the force before [N]   @param looser  than the solver's tolerance
  /// @return as press()
  template <class Aim>
  Response<Scalar> settle(Scalar last, int looser, Aim&& aim) noexcept {
    const Scalar first_step = report_.step;
    report_ = {Status::iteration_limit, 0, 0, 0, 0, first_step};
    if (left_ <= 0) return {system_.linear_reaction(), report_.status};
    aim();
    if (!descends()) report_ = solve_within(left_, first_step, looser);
    // A straight beam pressed across is unstable in no element but those that lock.
    const bool on_ridge = (any_rotation<Element> || !single_valued_) && gives_way();
    Descent descent;
    descent.max_solves = left_ - report_.solves;
    // A straight rod has one shape for each press, but it slips around a capsule.
    const bool slips = dimension == 3 && looser != 1;
    if (on_ridge || (report_.status == Status::iteration_limit && (!single_valued_ || slips))) {
      if (!fall(on_ridge, descent, aim)) {
        to_rest();
        course_ = Course::falls;
      }
    } else if (any_rotation<Element> && report_.status == Status::iteration_limit && report_.steps == 0 &&
               first_) {
      to_rest();  // what the last request has left leads nowhere: the next one begins at rest
    } else if (course_ == Course::falls && report_.status == Status::ok) {
      course_ = Course::stands;
      report_.status = Status::snapped;
    }
    left_ -= report_.solves;
    first_ = false;
    // A beam that was set back to rest on the way has none yet.
    const Scalar now = system_.linear_reaction();
    return {is_answer(report_.status) || now != 0 ? now : last, report_.status};
  }

  /// The shape that the beam reaches when its loads rise from nothing and its ends are moved, in double: in float round-off hides how a branch
  /// continues.
  [[gnu::cold]] void find_rest(const Body& beam) {
    if constexpr (dimension == 3) beam.check_held();
    if constexpr (std::is_same_v<Scalar, double>) {
      follow_loads(system_);
    } else {
      SystemIn<double> exact(beam, elements());
      follow_loads(exact);
      system_.take_state(exact);
      system_.set_goal();
      system_.set_target(1);
      // Whether round-off leaves a stiffness of so many elements.
      if (is_answer(rest_.status) && system_.factor(0) != Status::ok)
        detail::refuse(
            "elements = %d: too many for this beam in this scalar, its tangent at rest has no digits left; "
            "take "
            "fewer, or double",
            elements());
    }
    report_ = rest_;
  }

  template <class AnySystem>
  [[gnu::cold]] void follow_loads(AnySystem& system) noexcept {
    system.set_goal();
    const auto path = LoadPath{}.solve(system);
    auto last = path.report;
    if (is_answer(last.status)) {
      system.set_goal();
      last = solver_.solve(system);
      last.solves += path.report.solves;
      last.steps = path.report.steps;
      // A beam that is nearly free of stress has no digits beyond those of its path.
      if (last.status == Status::ok || last.status == Status::iteration_limit)
        last.status = path.report.status;
    }
    single_valued_ = single_valued_ && !path.fell;
    rest_ = {last.status,          last.solves,        last.steps,
             Scalar(last.reached), Scalar(last.error), Scalar(last.step)};
  }

  /// Whether the equilibrium that was found is unstable.  The last tangent is that of the state before the last increment, where a slender
  /// beam may be under a compression that is gone: then the tangent is assembled anew.
  bool gives_way() noexcept {
    if (report_.status != Status::ok || system_.negative_pivots() == 0) return false;
    ++report_.solves;
    return system_.factor(system_.neutral()) == Status::ok && system_.negative_pivots() > 0;
  }

  /// From an unstable equilibrium, or where none was found, down to a stable one.
  /// @param on_ridge  nothing but a nudge makes it go   @param descent  its max_solves bound the whole of it
  /// @param aim  sets the system's goal anew
  /// @return false where no way leads down: the shape is one that only a request beyond all reach can have made
  template <class Aim>
  bool fall(bool on_ridge, const Descent& descent, Aim&& aim) noexcept {
    if (on_ridge) system_.nudge(system_.length() / 1000);
    int solves = report_.solves;
    const int budget = solves + descent.max_solves;
    bool any_way = true;
    system_.forget_force();
    if (descent.solve(system_, solves)) {
      aim();
      report_ = solve_within(budget - solves);
      if (report_.status == Status::ok)
        report_.status = gives_way() ? Status::iteration_limit : Status::snapped;
      course_ = report_.status == Status::iteration_limit ? Course::falls : Course::stands;
    } else {
      descend();
      report_.status = Status::iteration_limit;
      report_.solves = 0;
      any_way = solves >= budget;
    }
    report_.solves += solves;
    return any_way;
  }

  /// Newton's method with no more than so many linear solves.  @param looser  than the solver's tolerance
  SolveReport<Scalar> solve_within(int most, Scalar first_step = 1, int looser = 1,
                                   Curvature<Scalar>* known = nullptr) noexcept {
    Solver solver = solver_;
    solver.max_solves = (std::min)(solver.max_solves, most);
    solver.relative_tolerance *= looser;
    return solver.solve(system_, first_step, known);
  }

  System system_;
  typename System::State rest_state_;
  Solver solver_;
  bool single_valued_;  // one shape for each press, as far as is known
  Pushes pushes_{system_};
  Places place_{system_};
  bool first_ = true;  // nothing has been solved for this request
  int left_ = 0;       // linear solves that this request may still take
  Course course_ = Course::stands;
  static constexpr int patience = 32;
  int unanswered_ = 0;  // poses of an end in succession
  Middle home_;         // where the middle is in the shape from which the beam is pressed
  SolveReport<Scalar> rest_{}, report_{};
};

}  // namespace hapbeam
