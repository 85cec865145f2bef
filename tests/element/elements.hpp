// Random elements and states for the laws that every element obeys.
#pragma once

#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/von_karman.hpp>

namespace hapbeam::testing {

using Full = VonKarman<FullIntegration>;
using Reduced = VonKarman<ReducedIntegration>;
using Assumed = VonKarman<AssumedStrain>;
using TurningLinear = Corotational<Linear>;
using TurningFull = Corotational<Full>;
using TurningReduced = Corotational<Reduced>;
using Turning = Corotational<Assumed>;

/// From a wire to a bar: lengths 1 cm to 1 m, slendernesses l/r 10 to 1000.
inline ElementProperties<double> random_properties(Random& random) {
  const double length = std::pow(10, random(-2, 0)), EA = std::pow(10, random(2, 8));
  const double radius_of_gyration = length / std::pow(10, random(1, 3));
  return {length, EA, EA * radius_of_gyration * radius_of_gyration};
}

/// Rotations up to 0.3 rad, displacements up to 0.3 of the length, strains of the size of the slopes'
/// squares.
inline Vector6<double> random_state(Random& random, double length) {
  const double u = random(length), w = random(length);
  Vector6<double> d;
  d << u, w, random(0.3), u + random(0.05) * length, w + random(0.3) * length, random(0.3);
  return d;
}

/// The element of a state and all that moves with it, turned about node 1 by phi [rad], clockwise as θ is.
inline Vector6<double> turned(double phi, const Vector6<double>& d, double length) {
  const double s = std::sin(phi), x = length + d[3] - d[0], y = d[4] - d[1];
  // cos - 1 without its cancellation
  const double less = -2 * std::pow(std::sin(phi / 2), 2);
  Vector6<double> r = d;
  r[2] += phi;
  r[3] += less * x + s * y;
  r[4] += less * y - s * x;
  r[5] += phi;
  return r;
}

/// Steps that move each degree of freedom as much as the state: energies are polynomials, so differences need
/// not be small.
inline double step(int dof, double length) { return dof == 2 || dof == 5 ? 0.05 : 0.05 * length; }

/// ∂f/∂d[i] by the five-point rule, exact for polynomials of degree four.
template <class F>
auto derivative(F&& f, const Vector6<double>& d, int i, double h) {
  using Value = decltype(f(d));
  const auto difference = [&](double k) {
    Vector6<double> before = d, after = d;
    before[i] -= k * h;
    after[i] += k * h;
    return Value(f(after) - f(before));
  };
  const Value near = difference(1), far = difference(2);
  return Value((8 * near - far) / (12 * h));
}

}  // namespace hapbeam::testing
