// Continuation along a path of equilibria, past limit points of load and of displacement: what tests compare a press with.
//
// At an equilibrium (x, λ) the path goes along (v, 1), v = K⁻¹f.  A step goes a given length along it, and Newton's
// corrections stay in the plane normal to it:
//
//   K δ = -(r - λf),   K v' = f,   dλ = -⟨v, δ⟩ / ⟨v, v'⟩,   x += δ + dλ v',   λ += dλ
//
// with ⟨,⟩ the mean over the nodes of (Δu² + Δw²)/L² + Δθ².  With v' of the present tangent the corrections are Newton's;
// with v for it they shrink by a factor only, and the paths of frames take 6 to 15 times the solves.  The length counts how
// far the beam moves and turns, and not the load (Crisfield's cylinder): no scale of the load serves both before a limit
// point and at it, where counting it makes the steps shrink.  A plane (Riks) and not the cylinder itself: one linear
// equation for dλ instead of a quadratic one with roots to choose from.  Which way is on is what goes on from the step
// before.
// v is the difference that a little more load makes in an increment.
// Source: E. Riks, An incremental approach to the solution of snapping and buckling problems, Int. J. Solids Structures 15
// (1979); Crisfield, Non-linear Finite Element Analysis of Solids and Structures, vol. 1, ch. 9.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <hapbeam/fem/solver/ldlt.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::testing {

/// What a path was at its last equilibrium.
struct PathPoint {
  double load;          ///< λ
  int negative_pivots;  ///< directions along which the beam gives way under this load
};

struct ArcLength {
  double first_step = 0.01;     ///< length of the first step, radians turned or lengths moved on the mean
  double largest_step = 0.05;   ///< of any
  double smallest_step = 1e-8;  ///< where the path cannot be followed any more
  double tolerance = 1e-10;     ///< of a correction, in the norm above
  int enough_iterations = 4;    ///< corrections after which the next step is longer
  int max_iterations = 10;      ///< after which a step is taken back and halved

  /// Follows the path from λ = 0 and the system's present shape, toward larger λ.
  /// @param system  of path.hpp   @param visit  (system, PathPoint) -> bool, at each equilibrium: whether to go on
  /// @return ok, where visit has ended it | iteration_limit, singular, non_finite, where the path was lost
  template <class System, class Visit>
  Status solve(System& system, Visit&& visit) const {
    using S = typename System::Scalar;
    std::vector<Vector3<S>> v(static_cast<std::size_t>(system.elements()) + 1, Vector3<S>::Zero()),
        before = v, present = v, residual = v;
    const auto at = [](std::vector<Vector3<S>>& field, int i) -> Vector3<S>& {
      return field[static_cast<std::size_t>(i)];
    };
    const auto product = [&](auto&& a, auto&& b) {
      S sum = 0;
      for (int i = 0; i <= system.elements(); ++i) {
        const Vector3<S> p = a(i), q = b(i);
        sum += (p[0] * q[0] + p[1] * q[1]) / (system.length() * system.length()) + p[2] * q[2];
      }
      return sum / static_cast<S>(system.elements() + 1);
    };
    const auto rate = [&](int i) { return at(v, i); };
    const auto missing = [&](int i) { return at(residual, i); };
    const auto present_rate = [&](int i) { return at(present, i); };
    const auto correction = [&](int i) { return system.increment(i); };
    // Leaves the system as factored under its load.
    const auto find_rate = [&](std::vector<Vector3<S>>& to) {
      const S load = system.load(), more = S(1e-4) * (1 + std::abs(load));
      system.set_load(load + more);
      Status status = system.factor(0);
      for (int i = 0; i <= system.elements(); ++i) at(to, i) = system.increment(i);
      system.set_load(load);
      if (status == Status::ok) status = system.factor(0);
      for (int i = 0; i <= system.elements(); ++i) at(to, i) = (at(to, i) - system.increment(i)) / more;
      return status;
    };

    system.set_load(0);
    for (int k = 0;; ++k) {
      const Status status = system.factor(0);
      if (status != Status::ok) return status;
      system.advance();
      if (std::sqrt(product(correction, correction)) <= S(tolerance)) break;
      if (k == max_iterations) return Status::iteration_limit;
    }

    S step = S(first_step), direction = 1;
    while (true) {
      Status status = find_rate(v);
      if (status != Status::ok) return status;
      if (!visit(static_cast<const System&>(system),
                 PathPoint{static_cast<double>(system.load()), system.negative_pivots()}))
        return Status::ok;
      if (product(rate, [&](int i) { return at(before, i); }) < 0) direction = -direction;
      before = v;
      const S size = std::sqrt(product(rate, rate));
      system.save();
      for (bool found = false; !found;) {
        const S load = direction * step / size;
        system.set_load(system.load() + load);
        system.move([&](int i) -> Vector3<S> { return load * at(v, i); });
        int k = 0;
        for (; k < max_iterations && !found; ++k) {
          status = find_rate(present);
          if (status != Status::ok) break;
          for (int i = 0; i <= system.elements(); ++i) at(residual, i) = system.increment(i);
          const S change = -product(rate, missing) / product(rate, present_rate);
          const auto in_plane = [&](int i) -> Vector3<S> { return missing(i) + change * present_rate(i); };
          found = std::sqrt(product(in_plane, in_plane)) <= S(tolerance);
          system.move(in_plane);
          system.set_load(system.load() + change);
        }
        if (found) {
          if (k <= enough_iterations) step = (std::min)(S(1.5) * step, S(largest_step));
        } else {
          system.restore();
          step /= 2;
          if (step < S(smallest_step)) return status == Status::ok ? Status::iteration_limit : status;
        }
      }
    }
  }
};

}  // namespace hapbeam::testing
