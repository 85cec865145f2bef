// SPDX-License-Identifier: MIT
// A press of a straight beam without dead loads whose ends stand no closer than it is long: the taut way of FemModel.
//
// TautSystem is solved for its one unknown by Newton–Raphson, from the last press on.  There is one equilibrium for each press,
// and it is stable: letting go leads back to rest.
// Allocates at construction; every other member is noexcept and allocation-free, and takes at most solver.max_solves
// iterations of O(1) and lays the shape in O(elements).
#pragma once

#include <cmath>

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/laid_mesh.hpp>
#include <hapbeam/fem/taut_system.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// The members are those of AllDisplacements.
template <typename ScalarType, int Elements, int MaxElements, class Solver>
class OneTension {
 public:
  using Scalar = ScalarType;

  /// @param beam  one that is_taut()
  OneTension(const Beam& beam, int elements, const Solver& solver)
      : system_(beam, elements), uniform_(elements, system_.length()), solver_(solver) {}

  Response<Scalar> press(const Push<Scalar>& request, bool valid) noexcept {
    const Scalar first_step = report_.step;
    report_ = {Status::invalid_request, 0, 0, 0, 0, first_step};
    if (!valid) return {0, Status::invalid_request};
    system_.set_goal(uniform_.at(request.s), request.s, request.d);
    report_ = solver_.solve(system_, first_step);
    if (report_.steps > 0) system_.lay();
    else system_.take_back();
    const Scalar force = system_.reaction();
    if (!std::isfinite(force)) report_.status = Status::non_finite;
    return {force, report_.status};
  }

  Status release() noexcept {
    reset();
    return Status::ok;
  }
  void reset() noexcept {
    system_.rest();
    report_.step = 1;
  }

  int elements() const noexcept { return uniform_.elements(); }
  Centreline<Scalar> shape() const noexcept { return system_.centreline(); }
  Scalar strain_energy() const noexcept { return system_.strain_energy(); }
  InternalForces<Scalar> internal_forces(int e, Scalar s, Scalar thickness) const noexcept {
    return system_.internal_forces(e, s, thickness);
  }
  const SolveReport<Scalar>& rest() const noexcept { return rest_; }
  const SolveReport<Scalar>& report() const noexcept { return report_; }

 private:
  TautSystem<Scalar, Elements, MaxElements> system_;
  ContactMesh<Scalar> uniform_;
  Solver solver_;
  SolveReport<Scalar> rest_{Status::ok, 0, 1, 1, 0, 1}, report_ = rest_;
};

}  // namespace hapbeam
