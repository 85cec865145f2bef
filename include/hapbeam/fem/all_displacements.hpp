// A press of any beam, solved for the displacements of all nodes: the general way of FemModel.
//
// The mesh moves so that a node lies at the contact, and BeamSystem is solved by Newton–Raphson from the last press or from
// rest, whichever is closer.  A beam with more than one shape at rest keeps to the branch on which it is; where that ends or
// gives way it falls to a stable one (Descent), and the status says snapped.
// Offline: construction allocates, finds the shape at rest and may throw.  Servo: every other member is noexcept and
// allocation-free where the assembler is; a press, a push or a release takes at most solver.max_solves linear solves of
// O(elements), a fall included, and two more on each mesh where the beam gives way.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include <hapbeam/fem/beam_system.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/contact_search.hpp>
#include <hapbeam/fem/load_path.hpp>
#include <hapbeam/fem/press_range.hpp>
#include <hapbeam/fem/solver/descent.hpp>

namespace hapbeam {

template <class Element, typename ScalarType, int Elements, int MaxElements,
          template <typename, int, int, int> class Assembler, class Solver>
class AllDisplacements {
 public:
  using Scalar = ScalarType;
  using Body = typename detail::SystemOf<Element>::Body;
  using Round = typename detail::SystemOf<Element>::template Round<Scalar>;
  using RoundContact = typename detail::SystemOf<Element>::template RoundContact<Scalar>;
  using Extent = typename detail::SystemOf<Element>::template Range<Scalar>;
  static constexpr int dimension = dimension_of<Element>;

  /// Finds the shape at rest.
  /// @throws std::invalid_argument as BeamSystem, and where the scalar cannot tell so many elements apart
  AllDisplacements(const Body& beam, int elements, const Solver& solver)
      : system_(beam, elements),
        rest_state_(elements),
        uniform_(elements, system_.length()),
        solver_(solver),
        single_valued_(beam.straight()) {
    find_rest(beam);
    system_.keep(rest_state_);
    home_ = system_.middle();
  }

  /// Prescribes the displacement along request.normal at request.s.
  /// @param node  [m] where the mesh has its node: at request.s, or at an end beside it   @param valid  whether there is a request
  /// @return force [N], not always finite, and ok | snapped | invalid_request | iteration_limit | singular | non_finite
  Response<Scalar> press(const Push<Scalar, dimension>& request, Scalar node, bool valid) noexcept {
    using std::abs;
    if (!begins(valid)) return {0, report_.status};
    const Scalar last = system_.linear_reaction(), s = request.s;
    const Scalar jump = request.d - system_.displacement(s, request.normal),
                 from_rest = request.d - system_.displacement(rest_state_, s, request.normal);
    if (single_valued_ && abs(from_rest) < abs(jump)) to_rest();
    const ContactMesh<Scalar> mesh = uniform_.at(node);
    system_.remesh(mesh);
    return settle(last, 1, [&] { system_.set_goal(mesh.node(), request.d, s - mesh.s(), request.normal); });
  }

  /// Of the beam's length: so far from its node a contact is as exact as at it, to a few 1e-6 of the force.
  static constexpr Scalar beside = Scalar(1.5e-4);
  /// And so is the force, in units of the solver's tolerance.
  static constexpr int slack = 100;
  /// So often the node follows the contact in a push.
  static constexpr int most_meshes = 4;

  /// Lays the beam on a circle, a rod on a capsule.  The mesh has its node where they were thought to touch, and follows where they do if that is
  /// not beside it.
  /// @param range  says where a node can be   @param valid  whether there is a request   @return as press()
  Pushed<Scalar, dimension> push(const Round& request, const Extent& range, bool valid) noexcept {
    using std::abs;
    const RoundContact round{request};
    using Search = detail::ContactSearch<Scalar, dimension>;
    if (!begins(valid)) return {0, report_.status};
    // On a curve that is too sharp for it the law holds at the node alone.
    const Scalar near = beside * system_.length(), exactly = Scalar(1e-5) * request.reach;
    Search search;
    Vector normal = Vector::Zero();
    Scalar s = request.s;
    bool snapped = false;
    for (int meshes = 1;; ++meshes) {
      Trial trial{s, normal};
      Pushed<Scalar, dimension> pushed = push_at(request, range, trial);
      snapped = snapped || pushed.status == Status::snapped;
      const Scalar off = std::max(abs(trial.ahead), trial.miss);
      const bool there = off <= (trial.by_plane ? exactly : near);
      if (there || meshes == most_meshes || !is_answer(pushed.status) || pushed.force >= 0) {
        pushed.miss = there ? Scalar(0) : off;
        if (snapped && pushed.status == Status::ok) pushed.status = Status::snapped;
        return pushed;
      }
      typename Search::Aim next{s + trial.ahead, normal};
      if (trial.by_plane)
        next =
            search.after({next.s, pushed.normal}, round.residual(trial.ahead, trial.normal, pushed.normal));
      s = std::clamp(next.s, Scalar(0), system_.length());
      normal = next.normal;
    }
  }

  /// Moves a clamped end of a rod, without a contact.
  template <class Side, class Pose>
  HeldEnd<Scalar> hold(Side side, const Pose& pose) noexcept {
    const auto k = static_cast<std::size_t>(side);
    const auto take = [&] {
      const auto [force, moment] = system_.reaction(k);
      return HeldEnd<Scalar>{force, moment, report_.status};
    };
    report_ = {Status::invalid_request, 0, 0, 0, 0, report_.step};
    if (!is_answer(rest_.status)) return report_.status = rest_.status, take();
    if (!system_.place_end(k, pose)) return take();
    single_valued_ = false;
    const auto aim = [this] { system_.set_goal(); };
    aim();
    report_ = solve_within(solver_.max_solves, descending_ ? Scalar(1) : report_.step);
    Descent descent;
    descent.max_solves = solver_.max_solves - report_.solves;
    const bool on_ridge = gives_way();
    if ((on_ridge || report_.status == Status::iteration_limit) && !fall(on_ridge, descent, aim)) reset();
    return take();
  }

  /// Falls to the shape at rest on whose slope the beam is; one that is folded, which only a request beyond all reach leaves,
  /// and which may be stable, goes back to where it began.   @return ok | snapped | iteration_limit
  Status release() noexcept {
    if (single_valued_) {
      reset();
      return Status::ok;
    }
    const auto aim = [this] { system_.set_goal(); };
    aim();
    report_ = {Status::ok, 0, 0, 0, 0, 1};
    Descent descent;
    descent.max_solves = solver_.max_solves;
    if (!fall(false, descent, aim) || system_.folded()) {
      to_rest();
      return report_.status = Status::snapped;
    }
    if (report_.status != Status::snapped) return report_.status;
    const Middle before = home_;
    home_ = system_.middle();
    return (home_ - before).norm() > system_.length() / 1000 ? Status::snapped : Status::ok;
  }

  /// Back to the shape that construction has found, and to steps of the size that a new model takes.
  void reset() noexcept {
    to_rest();
    report_.step = 1;
  }

  int elements() const noexcept { return system_.elements(); }
  Centreline<Scalar, dimension> shape() const noexcept { return system_.centreline(); }
  Scalar strain_energy() const noexcept { return system_.strain_energy(); }
  /// How the search for the shape at rest ended.
  const SolveReport<Scalar>& rest() const noexcept { return rest_; }
  /// How the last press or release ended.
  const SolveReport<Scalar>& report() const noexcept { return report_; }

 private:
  template <typename S>
  using SystemIn = typename detail::SystemOf<Element>::template System<S, Elements, MaxElements, Assembler>;
  using System = SystemIn<Scalar>;
  using Node = typename System::Node;
  using Vector = VectorOf<Scalar, dimension>;
  using Middle = decltype(std::declval<const System&>().middle());

  void to_rest() noexcept {
    system_.set_state(uniform_, rest_state_);
    home_ = system_.middle();
    falling_ = descending_ = sharp_ = false;
  }

  /// @return whether there is a request to answer; if not, report() has its status
  bool begins(bool valid) noexcept {
    left_ = solver_.max_solves;
    report_ = {Status::invalid_request, 0, 0, 0, 0, report_.step};
    if (valid && !is_answer(rest_.status)) report_.status = rest_.status;
    return valid && is_answer(rest_.status);
  }

  struct Trial {
    Scalar s;  ///< [m] where the node goes
    Vector
        normal;  ///< in: of the plane that stands for the circle, zero: of the node;  out: the one that was taken
    bool by_plane = false;  ///< whether a plane stood for the circle
    Scalar ahead = 0;       ///< [m] from there to the contact
    Scalar miss = 0;        ///< [m] from the circle's centre to where it should be
  };

  /// A push with the node at trial.s, or at the end beside it.  At an end that slides along a wall the wall takes what does not
  /// act along it.
  Pushed<Scalar, dimension> push_at(const Round& request, const Extent& range, Trial& trial) noexcept {
    using std::abs;
    constexpr bool planar = dimension == 2;
    const RoundContact round{request};
    const Scalar s = range.range().nearest({trial.s, 0}).s, length = system_.length();
    const ContactMesh<Scalar> mesh = uniform_.at(range.node(s));
    const int c = mesh.node(), end = c == 0 ? -1 : c == elements() ? 1 : 0;
    const bool outside = planar && s != trial.s;
    bool wall = false, beside_support = false;
    if constexpr (planar) {
      wall = range.on_wall(mesh.s());
      // There a hand soon bends the beam more sharply than the mesh can show.
      const Scalar clear = 2 * request.reach;
      beside_support =
          outside || s - range.range().left_support < clear || range.range().right_support - s < clear;
    }
    const Scalar last = system_.linear_reaction();
    system_.remesh(mesh);
    // The contact's node; beside a support, where there is none, the place that takes its displacement.
    const auto node = [&] { return outside ? round.node_at(shape(), trial.s) : system_.node(c); };
    const auto look = [&](const Node& seen) { return round.look(seen, end); };
    const auto start = look(node());
    const Scalar jump = abs(round.distance(start) - request.reach);
    if (single_valued_ && jump > length / 1000 &&
        abs(round.distance(look(round.node_at(system_.view(rest_state_), mesh.s()))) - request.reach) <
            jump) {
      to_rest();
      system_.remesh(mesh);
    }
    const auto through = [&] {
      if constexpr (planar) return false;
      else return round.is_through(look(node()));
    };
    Scalar across = 1;  // component of the force that the beam takes
    const Response<Scalar> response = settle(last, slack, [&] {
      const auto law = round.beside(shape(), c, end);
      trial.by_plane = wall || beside_support || sharp_ || law.sharp(request.reach) || through();
      if (!trial.by_plane) return system_.set_goal(c, -request.reach, law);
      if (trial.normal.isZero(0) || wall) trial.normal = round.normal(look(node()));
      const Vector& normal = trial.normal;
      const Scalar d = round.plane(normal, trial.s, node());
      if (!wall) return system_.set_goal(c, d, 0, normal);
      if constexpr (planar) {
        across = std::copysign(std::max(Scalar(0.5), abs(normal.y())), normal.y());
        system_.set_goal(c, (d - normal.x() * system_.node(c).u) / across);
      }
    });
    const bool answer = is_answer(response.status);
    sharp_ = answer && round.beside(shape(), c, end).sharp(request.reach);
    // What is no answer may have left that mesh.
    const Node now = answer ? node() : round.node_at(shape(), trial.s);
    const auto view = answer && !trial.by_plane ? system_.contact() : look(now);
    Pushed<Scalar, dimension> pushed{response.force / across, response.status};
    pushed.past_end = answer ? view.past_end : start.past_end;
    pushed.point = round.point(view, now);
    pushed.normal = view.normal;
    const Scalar touched = std::clamp(now.s + round.ahead(view), Scalar(0), length);
    trial.ahead = touched - trial.s;
    pushed.s = trial.by_plane || !answer ? trial.s : touched;
    if (trial.by_plane) trial.miss = round.miss(trial.normal, now);
    return pushed;
  }

  /// Solves for what aim() sets as the system's goal.  @param last  the force before [N]   @param looser  than the solver's tolerance
  /// @return as press()
  template <class Aim>
  Response<Scalar> settle(Scalar last, int looser, Aim&& aim) noexcept {
    const Scalar first_step = report_.step;
    report_ = {Status::iteration_limit, 0, 0, 0, 0, first_step};
    if (left_ <= 0) return {system_.linear_reaction(), report_.status};
    aim();
    if (!descending_) report_ = solve_within(left_, first_step, looser);
    // A straight beam pressed across gives way in no element but those that lock.
    const bool on_ridge = (any_rotation<Element> || !single_valued_) && gives_way();
    Descent descent;
    descent.max_solves = left_ - report_.solves;
    // A straight rod has one shape for each press, but it slips around a capsule.
    const bool slips = dimension == 3 && looser != 1;
    if (on_ridge || (report_.status == Status::iteration_limit && (!single_valued_ || slips))) {
      if (!fall(on_ridge, descent, aim)) {
        to_rest();
        falling_ = true;
      }
    } else if (any_rotation<Element> && report_.status == Status::iteration_limit && report_.steps == 0 &&
               left_ == solver_.max_solves) {
      to_rest();  // what the last request has left leads nowhere: the next one begins at rest
    } else if (falling_ && report_.status == Status::ok) {
      falling_ = false;
      report_.status = Status::snapped;
    }
    left_ -= report_.solves;
    // A beam that was set back to rest on the way has none yet.
    const Scalar now = system_.linear_reaction();
    return {is_answer(report_.status) || now != 0 ? now : last, report_.status};
  }

  /// The shape that the beam reaches when its loads rise from nothing and its ends are moved.  It is sought in double, whatever
  /// the model computes in: round-off would hide which way a branch goes on.
  void find_rest(const Body& beam) {
    if constexpr (std::is_same_v<Scalar, double>) {
      follow_loads(system_);
    } else {
      SystemIn<double> exact(beam, elements());
      follow_loads(exact);
      system_.take_state(exact);
      system_.set_goal();
      system_.set_target(1);
      // Whether so many elements can be told apart in this scalar at all.
      if (is_answer(rest_.status) && system_.factor(0) != Status::ok)
        throw std::invalid_argument(
            "elements = " + std::to_string(elements()) +
            ": too many for this beam in this scalar, its tangent at rest has no digits "
            "left; take fewer, or double");
    }
    report_ = rest_;
  }

  template <class AnySystem>
  void follow_loads(AnySystem& system) noexcept {
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

  /// Whether the equilibrium that was found is none to stay at.  The last tangent is that of the state before the last
  /// increment, where a slender beam may be under a compression that is gone now: a second look decides.
  bool gives_way() noexcept {
    if (report_.status != Status::ok || system_.negative_pivots() == 0) return false;
    ++report_.solves;
    return system_.factor(0) == Status::ok && system_.negative_pivots() > 0;
  }

  /// From an equilibrium that gives way, or where none was found, down to a stable one.
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
    descending_ = !descent.solve(system_, solves);
    if (!descending_) {
      aim();
      report_ = solve_within(budget - solves);
      if (report_.status == Status::ok)
        report_.status = gives_way() ? Status::iteration_limit : Status::snapped;
    } else {
      report_.status = Status::iteration_limit;
      report_.solves = 0;
      any_way = solves >= budget;
    }
    report_.solves += solves;
    falling_ = report_.status == Status::iteration_limit;
    return any_way;
  }

  /// Newton's method with no more than so many linear solves.  @param looser  than the solver's tolerance
  SolveReport<Scalar> solve_within(int most, Scalar first_step = 1, int looser = 1) noexcept {
    Solver solver = solver_;
    solver.max_solves = std::min(solver.max_solves, most);
    solver.relative_tolerance *= looser;
    return solver.solve(system_, first_step);
  }

  System system_;
  typename System::State rest_state_;
  ContactMesh<Scalar> uniform_;
  Solver solver_;
  bool single_valued_;       // one shape for each press, as far as is known
  int left_ = 0;             // linear solves that this request may still take
  bool sharp_ = false;       // where the last circle touched
  bool falling_ = false;     // off the shape that gave way, and not yet at a stable one
  bool descending_ = false;  // and not yet near one
  Middle home_;              // where the middle is in the shape from which the beam is pressed
  SolveReport<Scalar> rest_{}, report_{};
};

}  // namespace hapbeam
