// SPDX-License-Identifier: MIT
// The full model: a finite-element beam under a prescribed displacement, as a ForceModel.
//
//   FemModel<> model(beam, 8);
//   const auto [force, status] = model.press({0.5 * beam.length(), -2e-3});
//
// press() prescribes the transverse displacement of any place and returns the reaction (thesis eq. 3.40–3.42).  Elements of finite
// rotation take a push() along any direction as well, and one by bodies.  The mesh stays; the place lies within an element.
// A straight beam without dead loads, whose ends stand no closer than it is long and whose elements are exact under their tension, is
// solved for the tension alone, without the error of a mesh (taut_system.hpp).  All else is solved for the displacements of all nodes
// (all_displacements.hpp).  A beam with more than one shape at rest keeps to its branch; where that ends it falls to a stable shape,
// and the status is snapped.
// Policies: Element × Solver.  Sizes are fixed, dynamic with a maximum (no heap but for the list of dead loads), or dynamic.
// Offline: construction allocates, and throws std::invalid_argument.  Servo: all else is noexcept and allocation-free; a press, a push
// or a release takes at most solver.max_solves linear solves of O(elements), a fall included, and two more in each solution where the
// beam is unstable.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <variant>

#include <hapbeam/check.hpp>
#include <hapbeam/element/von_karman.hpp>
#include <hapbeam/fem/all_displacements.hpp>
#include <hapbeam/fem/press.hpp>
#include <hapbeam/fem/taut_system.hpp>
#include <hapbeam/internal_forces.hpp>

namespace hapbeam {

/// @tparam Element    Linear | VonKarman<Membrane> | Corotational<Local>
/// @tparam ScalarType double | float
/// @tparam Elements   number of elements, or Eigen::Dynamic      @tparam MaxElements  largest number, or Eigen::Dynamic
/// @tparam Solver     NewtonRaphson
template <class Element = VonKarman<>, typename ScalarType = double, int Elements = Eigen::Dynamic,
          int MaxElements = Elements, class Solver = NewtonRaphson>
class FemModel {
  using Of = detail::SystemOf<Element>;

 public:
  using Scalar = ScalarType;
  using Body = typename Of::Body;  ///< Beam, or Rod in space
  static constexpr int dimension = dimension_of<Element>;
  using ElementType = Element;
  /// At how many places it may be touched at once.
  static constexpr int contacts = contacts_of<Element>;

  /// Builds the beam and finds its shape at rest, the one that it reaches when its dead loads rise from nothing: see rest().
  /// @param elements two to most_elements(beam)   @throws std::invalid_argument naming field, value and what is allowed
  FemModel(const Body& beam, int elements, const Solver& solver = {})
      : ways_(make_way(beam, at_most(most_elements(beam), elements), solver)),
        range_(beam, any_rotation<Element>),
        thickness_(static_cast<Scalar>(beam.thickness())) {
    check_rest();
  }

  /// Elements that round-off allows: eps times the condition number of the bending stiffness, their fourth power, is at most 32.  In double
  /// these are 19483, in float 128; half as many where an end does not hold w.
  static int most_elements(const Body& beam) noexcept {
    const double most = std::pow(32 / static_cast<double>(std::numeric_limits<Scalar>::epsilon()), 0.25);
    return static_cast<int>(PressRange<Scalar>(beam).holds_both() ? most : most / 2);
  }

  /// Prescribes the centreline's transverse displacement d [m] at arc position s [m]: its w, from the x axis.
  /// Within range() the answer is that of the request; else, out_of_range, that of the nearest request in range.
  /// Closer to an end that yields than a thousandth of the length (3 % in float), the end's node is pressed through a straight tip.  Its
  /// error is about (δ/L)³ at a free end and (δ/L)² at a guided one.
  /// @return force [N] and ok | out_of_range | snapped | invalid_request | iteration_limit | singular | non_finite
  template <int D = dimension, std::enable_if_t<D == 2, int> = 0>
  Response<Scalar> press(const Press<Scalar>& request) noexcept {
    const Press<Scalar> press = range().nearest(request);
    const bool valid = std::isfinite(request.d) && range_.on_beam(request.s);
    return solve({press.s, press.d, {0, 1}}, valid, press.s == request.s && press.d == request.d);
  }

  /// Prescribes the displacement along any direction, by a force along it.  At an end that slides along a wall the wall takes what does not
  /// act along it.
  /// @return as press(); invalid_request also where the normal is not unit to half a thousandth; in space out_of_range also as of obstacles
  template <class E = Element, std::enable_if_t<any_rotation<E>, int> = 0>
  Response<Scalar> push(const Push<Scalar, dimension>& request) noexcept {
    const Scalar s = range().nearest({request.s, 0}).s;
    const bool is_unit =
        std::abs(request.normal.squaredNorm() - 1) < Scalar(1e-3);  // false for what is no number
    const bool valid = std::isfinite(request.d) && is_unit && range_.on_beam(request.s);
    if constexpr (dimension == 2)
      if (const Scalar end = range_.node(s); range_.on_wall(end)) return push_wall(request, s, end, valid);
    return solve({s, request.d, request.normal}, valid, s == request.s);
  }

  /// Lays the centreline on circles, in space capsules: which of them touch, where, and the equilibrium are found together.  Each pushes or does
  /// not touch; none pulls.  Several<Element, Contacts> takes so many, any other element one.
  /// @param obstacles  in and out: count of them
  /// @return ok | snapped | iteration_limit | singular | non_finite; each obstacle has a status of its own, too.  out_of_range: nearer to a support
  ///         than range() says, or where the error may exceed 1 %: bent too sharply beside a held end, or a rod without a tension of its own, drawn too taut.
  template <class E = Element, std::enable_if_t<any_rotation<E>, int> = 0>
  Status push(Obstacle<Scalar, dimension>* obstacles, int count) noexcept;

  [[gnu::always_inline]] Centreline<Scalar, dimension> shape() const noexcept {
    return take(ways_, [](const auto& way) { return way.shape(); });
  }

  /// Moves and turns a clamped end of a rod, or the springs of an end.
  /// @return force and moment that this takes, and ok | out_of_range: bent or turned too sharply for its tension and elements | snapped | invalid_request |
  ///         iteration_limit | singular | non_finite
  template <class InSpace = Of>
  HeldEnd<Scalar> hold(typename InSpace::Side side, const typename InSpace::Pose& pose) noexcept;

  /// Where press() answers with ok: press.hpp says how far that is.  A push() has no limit of depth.
  Range<Scalar> range() const noexcept { return range_.range(); }

  Scalar thickness() const noexcept { return thickness_; }

  /// The beam goes from its present shape to one at rest, which need not be rest() where it has more than one.
  /// @return ok | snapped, where that is not the one it was pressed from | iteration_limit, on its way: call again
  Status release() noexcept;

  /// Back to rest().
  void reset() noexcept;

  /// How the search for the shape under the dead loads ended: ok | snapped, where the branch ended before the loads had risen to their size,
  /// and the beam has fallen to a stable shape | iteration_limit, singular, non_finite: no press is answered.
  const SolveReport<Scalar>& rest() const noexcept {
    return take(
        ways_, [](const auto& way) -> auto& { return way.rest(); });
  }
  /// How the last press ended: linear solves, load steps, estimated increment.
  const SolveReport<Scalar>& report() const noexcept {
    return take(
        ways_, [](const auto& way) -> auto& { return way.report(); });
  }
  /// Strain energy of the present shape [J].
  Scalar strain_energy() const noexcept;
  int elements() const noexcept {
    return take(ways_, [](const auto& way) { return way.elements(); });
  }

  /// What the section at arc position s carries in the present shape: internal_forces.hpp.   O(log n)
  InternalForces<Scalar, dimension> internal_forces(Scalar s) const noexcept {
    return internal_forces(shape().segment_at(s), s);
  }
  /// The same in an element that is known to hold s.   @param element  from 0
  InternalForces<Scalar, dimension> internal_forces(int element, Scalar s) const noexcept;

  /// Takes the shape of another model of the same beam, and answers where that is touched: force_error.hpp.
  MeshDifference<Scalar> differ_from(const FemModel& other) noexcept;

 private:
  using General = AllDisplacements<Element, Scalar, Elements, MaxElements, Solver>;
  using Taut = OneTension<Scalar, Elements, MaxElements, Solver>;
  static constexpr bool may_be_taut = exact_under_tension<Element>;
  using Ways = std::conditional_t<may_be_taut, std::variant<General, Taut>, std::variant<General>>;

  static Ways make_way(const Body& beam, int elements, const Solver& solver);

  /// Calls f with the solver of this beam: OneTension or AllDisplacements.
  template <class AnyWays, class F>
  [[gnu::always_inline]] static decltype(auto) take(AnyWays& ways, F&& f) noexcept {
    if constexpr (may_be_taut)
      if (auto* const way = std::get_if<Taut>(&ways)) return f(*way);
    return f(*std::get_if<General>(&ways));
  }

  /// Whether the mesh is too coarse for the tension or a force at s.
  bool too_coarse(Scalar s, const VectorOf<Scalar, dimension>& force) const noexcept {
    return std::get_if<General>(&ways_)->too_coarse(s, force);
  }
  static Status judged(Status status, bool in_range) noexcept {
    return status == Status::ok && !in_range ? Status::out_of_range : status;
  }

  static int at_most(int most, int elements) {
    if (elements > most)
      detail::refuse(
          "elements = %d: must be at most %d for this beam and scalar: in finer meshes round-off leaves no "
          "digit",
          elements, most);
    return elements;
  }

  /// @throws std::invalid_argument where the scalar does not hold the shape at rest
  [[gnu::cold]] void check_rest() const {
    bool finite = range_.length() >= (std::numeric_limits<Scalar>::min)();
    for (const auto& node : shape()) finite = finite && is_finite(node);
    if (!finite)
      detail::refuse(
          "beam: sizes, loads and placed ends must leave it a length and a shape at rest that the model's "
          "scalar holds");
  }

  /// @param nearest  request in range   @param valid  whether the request was one   @param in_range  whether it was the nearest
  Response<Scalar> solve(const Push<Scalar, dimension>& nearest, bool valid, bool in_range) noexcept;
  /// Along a wall, which takes what does not act along it.
  template <int D = dimension, std::enable_if_t<D == 2, int> = 0>
  Response<Scalar> push_wall(const Push<Scalar>& request, Scalar s, Scalar node, bool valid) noexcept {
    const Scalar u = shape()[node == 0 ? 0 : elements()].u;
    const Scalar n_w =
        std::copysign((std::max)(Scalar(0.5), std::abs(request.normal.y())), request.normal.y());
    const Scalar d = (request.d - request.normal.x() * u) / n_w;
    const Response<Scalar> across = solve({s, d, {0, 1}}, valid && std::isfinite(d), s == request.s);
    return finite({across.force / n_w, across.status});
  }
  static Response<Scalar> finite(const Response<Scalar>& response) noexcept {
    return std::isfinite(response.force) ? response : Response<Scalar>{0, Status::non_finite};
  }

  Ways ways_;
  PressRange<Scalar> range_;
  Scalar thickness_;
};

// What costs a compiler seconds is defined outside of the class: only so does "extern template class FemModel<>;" keep it
// out of all files but one.
template <class Element, typename Scalar, int Elements, int MaxElements, class Solver>
auto FemModel<Element, Scalar, Elements, MaxElements, Solver>::make_way(const Body& beam, int elements,
                                                                        const Solver& solver) -> Ways {
  if constexpr (may_be_taut)
    if (is_taut(beam)) return Ways(std::in_place_type<Taut>, beam, elements, solver);
  return Ways(std::in_place_type<General>, beam, elements, solver);
}

template <class Element, typename Scalar, int Elements, int MaxElements, class Solver>
Response<Scalar> FemModel<Element, Scalar, Elements, MaxElements, Solver>::solve(
    const Push<Scalar, dimension>& nearest, bool valid, bool in_range) noexcept {
  const Response<Scalar> response = take(ways_, [&](auto& way) { return way.press(nearest, valid); });
  // In a plane a press has its range.
  if constexpr (dimension == 3)
    in_range = in_range && !too_coarse(nearest.s, response.force * nearest.normal);
  return finite({response.force, judged(response.status, in_range)});
}

template <class Element, typename Scalar, int Elements, int MaxElements, class Solver>
template <class E, std::enable_if_t<any_rotation<E>, int>>
Status FemModel<Element, Scalar, Elements, MaxElements, Solver>::push(Obstacle<Scalar, dimension>* obstacles,
                                                                      int count) noexcept {
  if (count < 0 || count > contacts_of<Element>) return Status::invalid_request;
  for (int i = 0; i < count; ++i) {
    auto& obstacle = obstacles[i];
    obstacle.valid = obstacle.valid && is_finite(obstacle);
  }
  Status status = std::get_if<General>(&ways_)->push(obstacles, count, range_);
  for (int i = 0; i < count; ++i) {
    auto& pushed = obstacles[i].pushed;
    if (!std::isfinite(pushed.force)) pushed.force = 0, pushed.status = status = Status::non_finite;
    if (obstacles[i].touching)
      pushed.status = judged(pushed.status, range().nearest({pushed.s, 0}).s == pushed.s &&
                                                !too_coarse(pushed.s, pushed.force * pushed.normal));
  }
  return status;
}

template <class Element, typename Scalar, int Elements, int MaxElements, class Solver>
template <class InSpace>
auto FemModel<Element, Scalar, Elements, MaxElements, Solver>::hold(
    typename InSpace::Side side, const typename InSpace::Pose& pose) noexcept -> HeldEnd<Scalar> {
  return std::get<General>(ways_).hold(side, pose);
}

template <class Element, typename Scalar, int Elements, int MaxElements, class Solver>
Status FemModel<Element, Scalar, Elements, MaxElements, Solver>::release() noexcept {
  return take(ways_, [](auto& way) { return way.release(); });
}

template <class Element, typename Scalar, int Elements, int MaxElements, class Solver>
void FemModel<Element, Scalar, Elements, MaxElements, Solver>::reset() noexcept {
  take(ways_, [](auto& way) { way.reset(); });
}

template <class Element, typename Scalar, int Elements, int MaxElements, class Solver>
MeshDifference<Scalar> FemModel<Element, Scalar, Elements, MaxElements, Solver>::differ_from(
    const FemModel& other) noexcept {
  auto* const mine = std::get_if<General>(&ways_);
  const auto* const its = std::get_if<General>(&other.ways_);
  return mine && its ? mine->differ_from(*its) : MeshDifference<Scalar>{0, 0};
}

template <class Element, typename Scalar, int Elements, int MaxElements, class Solver>
Scalar FemModel<Element, Scalar, Elements, MaxElements, Solver>::strain_energy() const noexcept {
  return take(ways_, [](const auto& way) { return way.strain_energy(); });
}

template <class Element, typename Scalar, int Elements, int MaxElements, class Solver>
auto FemModel<Element, Scalar, Elements, MaxElements, Solver>::internal_forces(int element,
                                                                               Scalar s) const noexcept
    -> InternalForces<Scalar, dimension> {
  return take(ways_, [&](const auto& way) { return way.internal_forces(element, s, thickness_); });
}

}  // namespace hapbeam
