// A solver so tight that what is left of an error belongs to the elements, or to round-off.
#pragma once

#include <hapbeam/fem/solver/newton_raphson.hpp>

namespace hapbeam::testing {

inline NewtonRaphson tight_solver() {
  NewtonRaphson solver;
  solver.relative_tolerance = 1e-13;
  return solver;
}

/// The same with time to get there, for load cases far from rest: what it finds is looked at, not how.
inline NewtonRaphson patient_solver() {
  NewtonRaphson solver = tight_solver();
  solver.max_solves = 1000;
  return solver;
}

}  // namespace hapbeam::testing
