// The full model: a finite-element beam under a prescribed displacement, as a ForceModel.
//
//   FemModel<> model(beam, 8);
//   const auto [force, status] = model.press({0.5 * beam.length(), -2e-3});
//
// press() moves the mesh so that a node lies at the contact, prescribes its transverse displacement, solves by
// Newton–Raphson with the tangent as predictor, from the last press or from rest, whichever is closer, and returns
// the reaction (thesis eq. 3.40–3.42).  Elements of any rotation take a push() along any direction as well.  A beam with
// more than one shape at rest keeps to the branch on which it is; where that ends or gives way it falls to a stable one,
// and the status says snapped.
// A straight beam without dead loads whose ends stand no closer than it is long has one unknown, the tension; of elements whose
// membrane strain is one number the model solves for that alone, with the same answers (taut_system.hpp).
// Composed of policies: Element × Assembler × Solver.  Sizes are fixed, or dynamic with a maximum (no heap at all
// but for the list of dead loads), or dynamic.
// Offline: construction allocates, and throws std::invalid_argument.  Servo: press(), reset() and all else are noexcept
// and allocation-free; a press, the pushes of a tick together, or a release take at most solver.max_solves linear solves of
// O(elements), the way of a beam that falls included, and two more each where it gives way.  What is not done then is
// iteration_limit: the force is that of the last equilibrium, and the next call goes on.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>

#include <hapbeam/element/von_karman.hpp>
#include <hapbeam/fem/beam_system.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/load_path.hpp>
#include <hapbeam/fem/solver/descent.hpp>
#include <hapbeam/fem/taut_system.hpp>

namespace hapbeam {

/// @tparam Element    Linear | VonKarman<FullIntegration | ReducedIntegration | AssumedStrain> | Corotational<…>
/// @tparam ScalarType double | float
/// @tparam Elements   number of elements, or Eigen::Dynamic      @tparam MaxElements  largest number, or Eigen::Dynamic
/// @tparam Assembler  BlockTridiagonal | Dense (reference, allocates, and always of all displacements)   @tparam Solver  NewtonRaphson
template <class Element = VonKarman<AssumedStrain>, typename ScalarType = double,
          int Elements = Eigen::Dynamic, int MaxElements = Elements,
          template <typename, int, int> class Assembler = BlockTridiagonal, class Solver = NewtonRaphson>
class FemModel {
 public:
  using Scalar = ScalarType;
  using ElementType = Element;

  /// Builds the beam and finds its shape at rest, the one that it reaches when its dead loads rise from nothing.  Look at
  /// rest() for how that went.
  /// @param elements two to most_elements(beam)   @throws std::invalid_argument naming field, value and what is allowed
  FemModel(const Beam& beam, int elements, const Solver& solver = {})
      : system_(make_system(beam, at_most(most_elements(beam), elements))),
        rest_nodes_(elements),
        length_(static_cast<Scalar>(beam.length())),
        uniform_(elements, length_),
        solver_(solver),
        thickness_(static_cast<Scalar>(beam.thickness())),
        shortest_(uniform_.shortest(length_)),
        left_yields_(!fixes_w(beam.left())),
        right_yields_(!fixes_w(beam.right())),
        left_guided_(left_yields_ && fixes_u(beam.left())),
        right_guided_(right_yields_ && fixes_u(beam.right())),
        single_valued_(beam.straight()) {
    find_range(beam);
    if (is_taut()) rest_ = report_ = {Status::ok, 0, 1, 1, 0, 1}, single_valued_ = true;
    else find_rest(beam);
    for (int i = 0; i <= elements; ++i) rest_nodes_[i] = shape()[i];
    check_rest();
    home_ = middle();
  }

  /// Elements that round-off allows.  The condition of the bending stiffness grows with their fourth power, and eps times it
  /// may be 32: in double 19483 elements, in float 128.  A beam with an end that does not hold w bends as one of twice the
  /// length, and has half as many.
  static int most_elements(const Beam& beam) noexcept {
    const double most = std::pow(32 / static_cast<double>(std::numeric_limits<Scalar>::epsilon()), 0.25);
    return static_cast<int>(fixes_w(beam.left()) && fixes_w(beam.right()) ? most : most / 2);
  }

  /// Prescribes the centreline's transverse displacement d [m] at arc position s [m]: its w, from the x axis.
  /// Within range() the answer is that of the request; else, out_of_range, that of the nearest request in range.
  /// Beside an end that yields, closer than a thousandth of the length (3 % in float), an element up to the contact
  /// would lose the force to round-off; there the end's node is pressed through a straight tip, which is off by about
  /// (δ/L)³ at a free end and (δ/L)² at a guided one.
  /// @return force [N] and ok | out_of_range | snapped | invalid_request | iteration_limit | singular | non_finite
  Response<Scalar> press(const Press<Scalar>& request) noexcept {
    const Press<Scalar> press = range().nearest(request);
    const bool in_range = press.s == request.s && press.d == request.d;
    left_ = solver_.max_solves;
    if constexpr (may_be_taut)
      if (taut()) return solve_taut(request.s, press, std::isfinite(request.d), in_range);
    return solve({request.s, press.d, {0, 1}}, press.s, std::isfinite(request.d), in_range);
  }

  /// Prescribes the displacement along any direction, by a force along it: what an element of any rotation needs where
  /// it has turned.  At an end that slides along a wall the wall takes what does not act along it.
  /// @return as press()
  template <class E = Element, std::enable_if_t<any_rotation<E>, int> = 0>
  Response<Scalar> push(const Push<Scalar>& request) noexcept {
    const Scalar s = range().nearest({request.s, 0}).s;
    const bool finite = std::isfinite(request.d) && request.normal.allFinite();
    if (!request.goes_on) left_ = solver_.max_solves;
    const Scalar node = away_from_ends(s);
    if (!((node == 0 && left_guided_) || (node == length_ && right_guided_)))
      return solve(request, s, finite, s == request.s);
    const Scalar u = system().node(node == 0 ? 0 : elements()).u;
    const Scalar n_w = std::copysign(std::max(Scalar(0.5), std::abs(request.normal.y())), request.normal.y());
    const Scalar d = (request.d - request.normal.x() * u) / n_w;
    const Response<Scalar> across =
        solve({request.s, d, {0, 1}}, s, finite && std::isfinite(d), s == request.s);
    const Scalar force = across.force / n_w;
    return std::isfinite(force) ? Response<Scalar>{force, across.status}
                                : Response<Scalar>{0, Status::non_finite};
  }

  Centreline<Scalar> shape() const noexcept {
    if constexpr (may_be_taut)
      if (const Taut* system = taut()) return system->centreline();
    return system().centreline();
  }

  /// Where press() answers with ok.  A support that holds w is rigid: the shortest element keeps its distance from it.
  /// Moderate rotation: |d| up to a tenth of the length and half of the distance to such a support, where it has ended,
  /// though the solver has not.  Any rotation: where the ends hold the beam along its axis, as far beyond what its length
  /// allows; where it can slide, 0.3 of the length and of the distance, the deepest that one call reaches from rest.  A
  /// push() has no such limit.
  Range<Scalar> range() const noexcept {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const Scalar length = length_;
    return {left_yields_ ? Scalar(0) : shortest_,
            right_yields_ ? length : length - shortest_,
            depth_,
            slope_,
            left_yields_ ? -infinity : Scalar(0),
            right_yields_ ? infinity : length};
  }

  Scalar thickness() const noexcept { return thickness_; }

  /// Lets go: the beam falls from its present shape to where it is at rest, which need not be rest() where it has more
  /// than one such shape.
  /// @return ok | snapped, where it has left the one that it was pressed from | iteration_limit, on its way: call again
  Status release() noexcept {
    if (single_valued_) {
      reset();
      return Status::ok;
    }
    const auto aim = [this] { system().set_goal(); };
    aim();
    report_ = {Status::ok, 0, 0, 0, 0, 1};
    Descent descent;
    descent.max_solves = solver_.max_solves;
    if (!fall(false, descent, aim) || folded()) {
      reset();
      return report_.status = Status::snapped;
    }
    if (report_.status != Status::snapped) return report_.status;
    const Scalar before = home_;
    home_ = middle();
    return std::abs(home_ - before) > length_ / 1000 ? Status::snapped : Status::ok;
  }

  /// Back to rest().
  void reset() noexcept {
    if constexpr (may_be_taut) {
      if (Taut* system = taut()) return system->rest();
    }
    system().set_state(uniform_, rest_nodes_.data());
    home_ = middle();
    falling_ = descending_ = false;
  }

  /// How the search for the shape under the dead loads ended: ok | snapped, where the branch on which the beam was ended
  /// before the loads had risen to their size, and rest() is the stable shape to which it then falls | iteration_limit,
  /// singular, non_finite, where there is none and no press is answered.
  const SolveReport<Scalar>& rest() const noexcept { return rest_; }
  /// How the last press ended: linear solves, load steps, estimated increment.
  const SolveReport<Scalar>& report() const noexcept { return report_; }
  /// Strain energy of the present shape [J].
  Scalar strain_energy() const noexcept {
    if constexpr (may_be_taut)
      if (const Taut* system = taut()) return system->strain_energy();
    return system().strain_energy();
  }
  int elements() const noexcept { return uniform_.elements(); }

 private:
  using General = BeamSystem<Element, Scalar, Elements, MaxElements, Assembler>;
  using Taut = TautSystem<Element, Scalar, Elements, MaxElements>;
  static constexpr bool may_be_taut =
      one_strain<Element> && std::is_same_v<Assembler<Scalar, Elements, MaxElements>,
                                            BlockTridiagonal<Scalar, Elements, MaxElements>>;
  using Systems = std::conditional_t<may_be_taut, std::variant<General, Taut>, std::variant<General>>;

  static Systems make_system(const Beam& beam, int elements) {
    if constexpr (may_be_taut)
      if (hapbeam::is_taut(beam)) return Systems(std::in_place_type<Taut>, beam, elements);
    return Systems(std::in_place_type<General>, beam, elements);
  }
  bool is_taut() const noexcept { return system_.index() != 0; }
  General& system() noexcept { return *std::get_if<General>(&system_); }
  const General& system() const noexcept { return *std::get_if<General>(&system_); }
  Taut* taut() noexcept { return std::get_if<Taut>(&system_); }
  const Taut* taut() const noexcept { return std::get_if<Taut>(&system_); }

  static int at_most(int most, int elements) {
    if (elements > most)
      throw std::invalid_argument("elements = " + std::to_string(elements) + ": must be at most " +
                                  std::to_string(most) +
                                  " for this beam and scalar: in finer meshes round-off leaves no digit");
    return elements;
  }

  void find_range(const Beam& beam) noexcept {
    const Scalar length = length_;
    depth_ = length / 10;
    slope_ = Scalar(0.5);
    if constexpr (any_rotation<Element>) {
      if (fixes_u(beam.left()) && fixes_u(beam.right())) {
        // How high a beam of this length can stand between its ends, over half the length.
        const auto span = (beam.length() + beam.right_place().u - beam.left_place().u) / beam.length();
        const Scalar sag = static_cast<Scalar>(std::sqrt(std::max(0.0, 1 - span * span)));
        depth_ += sag * length / 2;
        slope_ += sag;
      } else {
        depth_ = Scalar(0.3) * length;
        slope_ = Scalar(0.3);
      }
    }
  }

  /// Where the middle of the beam is [m].
  Scalar middle() const noexcept { return shape().at(length_ / 2).w; }

  /// @throws std::invalid_argument where the scalar does not hold the shape at rest
  [[gnu::cold]] void check_rest() const {
    bool finite = length_ >= std::numeric_limits<Scalar>::min();
    for (const CentrelineNode<Scalar>& node : shape())
      for (const Scalar value : {node.s, node.u, node.w, node.theta}) finite = finite && std::isfinite(value);
    if (!finite)
      throw std::invalid_argument(
          "beam: sizes, loads and placed ends must leave it a length and a shape at rest that the model's "
          "scalar holds");
  }

  /// The shape that the beam reaches when its loads rise from nothing and its ends are moved.  It is sought in double, whatever
  /// the model computes in: round-off would hide which way a branch goes on.
  void find_rest(const Beam& beam) {
    if constexpr (std::is_same_v<Scalar, double>) {
      follow_loads(system());
    } else {
      BeamSystem<Element, double, Elements, MaxElements, Assembler> exact(beam, elements());
      follow_loads(exact);
      for (int i = 0; i <= elements(); ++i)
        rest_nodes_[i] = {uniform_.position(i), static_cast<Scalar>(exact.node(i).u),
                          static_cast<Scalar>(exact.node(i).w), static_cast<Scalar>(exact.node(i).theta)};
      system().set_state(uniform_, rest_nodes_.data());
      system().set_goal();
      system().set_target(1);
      // Whether so many elements can be told apart in this scalar at all.
      if (is_answer(rest_.status) && system().factor(0) != Status::ok)
        throw std::invalid_argument(
            "elements = " + std::to_string(elements()) +
            ": too many for this beam in this scalar, its tangent at rest has no digits "
            "left; take fewer, or double");
    }
    report_ = rest_;
  }

  template <class System>
  void follow_loads(System& system) noexcept {
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
    if (report_.status != Status::ok || system().negative_pivots() == 0) return false;
    ++report_.solves;
    return system().factor(0) == Status::ok && system().negative_pivots() > 0;
  }

  /// From an equilibrium that gives way, or where none was found, down to a stable one.
  /// @param on_ridge  nothing but a nudge makes it go   @param descent  its max_solves bound the whole of it
  /// @param aim  sets the system's goal anew
  /// @return false where no way leads down: the shape is one that only a request beyond all reach can have made
  template <class Aim>
  bool fall(bool on_ridge, const Descent& descent, Aim&& aim) noexcept {
    if (on_ridge) system().nudge(length_ / 1000);
    int solves = report_.solves;
    const int budget = solves + descent.max_solves;
    bool any_way = true;
    descending_ = !descent.solve(system(), solves);
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

  /// Whether an element has turned so far in itself that it no longer stands for a beam: what only a request beyond all
  /// reach leaves, and what may be at rest and stable.
  bool folded() const noexcept {
    for (int i = 0; i < elements(); ++i)
      if (std::abs(system().node(i + 1).theta - system().node(i).theta) > 2) return true;
    return false;
  }

  /// Newton's method with no more than so many linear solves.
  SolveReport<Scalar> solve_within(int most, Scalar first_step = 1) noexcept {
    Solver solver = solver_;
    solver.max_solves = std::min(solver.max_solves, most);
    return solver.solve(system(), first_step);
  }

  /// A press of a beam that has one equilibrium.  @param s  of the request   @param press  the nearest in range
  Response<Scalar> solve_taut(Scalar s, const Press<Scalar>& press, bool finite, bool in_range) noexcept {
    Taut& system = *taut();
    const Scalar first_step = report_.step;
    report_ = {Status::invalid_request, 0, 0, 0, 0, first_step};
    if (!finite || !std::isfinite(s) || s < 0 || s > length_) return {0, Status::invalid_request};
    const ContactMesh<Scalar> mesh = uniform_.at(away_from_ends(press.s));
    system.set_goal(mesh, press.d, press.s - mesh.s());
    report_ = solver_.solve(system, first_step);
    if (report_.steps > 0) system.lay();
    const Scalar force = system.reaction();
    if (!std::isfinite(force)) return {0, report_.status = Status::non_finite};
    return {force, report_.status == Status::ok && !in_range ? Status::out_of_range : report_.status};
  }

  /// @param s  request.s, or the nearest in range
  Response<Scalar> solve(const Push<Scalar>& request, Scalar s, bool finite, bool in_range) noexcept {
    using std::abs;
    using std::isfinite;
    const Scalar first_step = report_.step;
    report_ = {Status::invalid_request, 0, 0, 0, 0, first_step};
    if (!finite || !isfinite(request.s) || request.s < 0 || request.s > length_)
      return {0, Status::invalid_request};
    if (!is_answer(rest_.status)) return {0, rest_.status};
    if (left_ <= 0) return {system().linear_reaction(), report_.status = Status::iteration_limit};
    const auto along = [&](const Displacement<Scalar>& at) {
      return request.normal.x() * at.u + request.normal.y() * at.w;
    };
    const Scalar last = system().linear_reaction();
    const Scalar jump = request.d - along(shape().at(s)), from_rest = request.d - along(rest_shape().at(s));
    if (single_valued_ && abs(from_rest) < abs(jump)) reset();
    const ContactMesh<Scalar> mesh = uniform_.at(away_from_ends(s));
    system().remesh(mesh);
    const auto aim = [&] { system().set_goal(mesh.node(), request.d, s - mesh.s(), request.normal); };
    aim();
    if (descending_) report_.status = Status::iteration_limit;
    else report_ = solve_within(left_, first_step);
    // A straight beam pressed across gives way in no element but those that lock.
    const bool on_ridge = (any_rotation<Element> || !single_valued_) && gives_way();
    Descent descent;
    descent.max_solves = left_ - report_.solves;
    if (on_ridge || (report_.status == Status::iteration_limit && !single_valued_)) {
      if (!fall(on_ridge, descent, aim)) {
        reset();
        falling_ = true;
      }
    } else if (any_rotation<Element> && report_.status == Status::iteration_limit && report_.steps == 0 &&
               left_ == solver_.max_solves) {
      reset();  // what the last request has left leads nowhere: the next one begins at rest
    } else if (falling_ && report_.status == Status::ok) {
      falling_ = false;
      report_.status = Status::snapped;
    }
    left_ -= report_.solves;
    const Status status = report_.status == Status::ok && !in_range ? Status::out_of_range : report_.status;
    // A beam that was set back to rest on the way has none yet.
    const Scalar now = system().linear_reaction(), force = is_answer(status) || now != 0 ? now : last;
    return isfinite(force) ? Response<Scalar>{force, status} : Response<Scalar>{0, Status::non_finite};
  }

  Centreline<Scalar> rest_shape() const noexcept { return system().view(rest_nodes_); }

  /// Where the node of a contact at s goes: s, or the end beside which an element would be too short for round-off.
  Scalar away_from_ends(Scalar s) const noexcept {
    const Scalar length = length_;
    return s < shortest_ && left_yields_ ? Scalar(0) : length - s < shortest_ && right_yields_ ? length : s;
  }

  Systems system_;
  detail::PerNode<CentrelineNode<Scalar>, Elements, MaxElements> rest_nodes_;
  Scalar length_;
  ContactMesh<Scalar> uniform_;
  Solver solver_;
  Scalar thickness_, shortest_;
  Scalar depth_ = 0, slope_ = 0;  // of range()
  bool left_yields_, right_yields_, left_guided_, right_guided_;
  bool single_valued_;       // one shape for each press, as far as is known
  int left_ = 0;             // linear solves that this tick may still take
  bool falling_ = false;     // off the shape that gave way, and not yet at a stable one
  bool descending_ = false;  // and not yet near one
  Scalar home_ = 0;          // middle() of the shape from which the beam is pressed
  SolveReport<Scalar> rest_{}, report_{};
};

}  // namespace hapbeam
