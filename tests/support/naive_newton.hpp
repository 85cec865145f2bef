// Newton's method as it is first written, on the library's own equations: equal load steps, increments added as they are,
// a relative criterion, and no look at the pivots.  What it lacks is what it is compared with the library for.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <hapbeam/fem/beam_system.hpp>

namespace hapbeam::testing {

struct NaiveSolve {
  bool converged;
  int solves;
};

/// |Δ| over the size of the state, both in the norm of the tangent: the library's own measure, so that criteria do not differ.
struct RelativeEnergy {
  double tolerance = 1e-8;
  template <class System>
  bool operator()(const System& system) const {
    return static_cast<double>(system.increment()) <= tolerance * static_cast<double>(system.size());
  }
};

/// The largest change of a displacement over the largest displacement, as textbooks have it.
struct RelativeDisplacement {
  double tolerance = 1e-8;
  template <class System>
  bool operator()(const System& system) const {
    double change = 0, size = 0;
    for (int i = 0; i <= system.elements(); ++i) {
      change = std::max(change, static_cast<double>(system.increment(i).cwiseAbs().maxCoeff()));
      const auto& node = system.node(i);
      for (const auto x : {node.u, node.w, node.theta})
        size = std::max(size, std::abs(static_cast<double>(x)));
    }
    return change < tolerance * size;
  }
};

/// The forces that are left over the force of the contact, which condition's n⁴ keeps from ever being small on a fine mesh.
template <class Element>
struct RelativeResidual {
  double axial_stiffness,
      bending_stiffness;  ///< EA [N], EI [N·m²] of a beam between two hinges without loads
  int contact;            ///< its node
  double tolerance = 1e-8;
  double* least = nullptr;  ///< where the least of them is kept

  template <class System>
  bool operator()(const System& system) const {
    const int n = system.elements();
    std::vector<Vector3<double>> left(static_cast<std::size_t>(n) + 1, Vector3<double>::Zero());
    for (int e = 0; e < n; ++e) {
      const auto &a = system.node(e), &b = system.node(e + 1);
      Vector6<double> d, r;
      d << a.u, a.w, a.theta, b.u, b.w, b.theta;
      Element::residual(ElementProperties<double>(b.s - a.s, axial_stiffness, bending_stiffness), d, r);
      left[static_cast<std::size_t>(e)] += r.template head<3>();
      left[static_cast<std::size_t>(e) + 1] += r.template tail<3>();
    }
    Vector3<double>& at = left[static_cast<std::size_t>(contact)];
    const double force = std::abs(at[1]);
    at[1] = 0;
    left.front().template head<2>().setZero();
    left.back().template head<2>().setZero();
    double sum = 0;
    for (const auto& f : left) sum += f.squaredNorm();
    const double relative = std::sqrt(sum) / force;
    if (least) *least = std::min(*least, relative);
    return relative <= tolerance;
  }
};

/// From the system's state to its goal.  @param steps  equal ones   @param most  iterations in each
template <class System, class Criterion = RelativeEnergy>
NaiveSolve naive_newton(System& system, int steps = 1, int most = 25, Criterion&& done = {}) {
  using S = typename System::Scalar;
  NaiveSolve result{true, 0};
  for (int step = 1; step <= steps; ++step) {
    system.set_target(static_cast<S>(step) / static_cast<S>(steps));
    bool found = false;
    for (int k = 0; k < most && !found; ++k) {
      ++result.solves;
      if (system.factor(0) != Status::ok || !std::isfinite(system.increment())) return {false, result.solves};
      if (system.rows().any()) {
        system.advance();  // with a contact the library adds increments as they are, too
      } else {
        system.move([&](int i) { return system.increment(i); });
        system.find_tensions();
      }
      found = done(system);
    }
    if (!found) return {false, result.solves};
  }
  return result;
}

}  // namespace hapbeam::testing
