// A beam under a load along its axis, pressed: against the equations of moderate rotation, integrated as an initial-value
// problem.
//
//   (EI w''' - N w')' = 0,   N' = -f,   N(x) = N0 - f x,   ∫ (N/EA - ½ w'²) dx = 0
//
// Under a given N0 the deflection is linear.  Where an end slides N vanishes there; else the ends' distance asks for N0.
// Fourth-order Runge–Kutta with 2000 steps leaves 1e-11.  It shares neither code nor discretisation with the library.
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/random.hpp"
#include "support/solver.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = 1, EA = 1e5, EI = 1, height = 0.01;

/// w, w', w'', EI w''' - N w', ∫½w'² dx
using State = std::array<double, 5>;

State sum(const State& a, double factor, const State& b) {
  State c{};
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = a[i] + factor * b[i];
  return c;
}

State integrate(State y, double N0, double f, double from, double to) {
  const auto rates = [&](double x, const State& at) {
    return State{at[1], at[2], (at[3] + (N0 - f * x) * at[1]) / EI, 0, at[1] * at[1] / 2};
  };
  const int steps = 1000;
  const double h = (to - from) / steps;
  for (int i = 0; i < steps; ++i) {
    const double x = from + i * h;
    const State a = rates(x, y), b = rates(x + h / 2, sum(y, h / 2, a)),
                c = rates(x + h / 2, sum(y, h / 2, b)), d = rates(x + h, sum(y, h, c));
    y = sum(sum(sum(sum(y, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
  }
  return y;
}

struct Ends {
  Support left, right;
  double
      buckles;  ///< the least load that does, in EI/L³, where the right end may slide.  Timoshenko and Gere, Theory of Elastic Stability, 2.12
  std::array<double, 3> error;  ///< with 8, 16 and 32 elements; docs/limits.md states the largest

  bool slides() const { return !fixes_u(right); }
  /// The two of the state that vanish at the right end.
  std::array<std::size_t, 2> vanish() const {
    if (right == Support::free) return {2, 3};
    return {0, right == Support::clamped ? 1u : 2u};
  }
};

struct Pressed {
  double force, excess;  // excess of the ends' distance over what it is
};

/// Pressed by d at s.
Pressed press(const Ends& ends, double N0, double f, double s, double d) {
  State turn{}, shear{};
  turn[ends.left == Support::clamped ? 2 : 1] = 1, shear[3] = 1;
  const State a = integrate(turn, N0, f, 0, s), b = integrate(shear, N0, f, 0, s),
              a1 = integrate(a, N0, f, s, L), b1 = integrate(b, N0, f, s, L),
              c1 = integrate(shear, N0, f, s, L);
  const auto [i, j] = ends.vanish();
  Eigen::Matrix3d M;
  M << a[0], b[0], 0, a1[i], b1[i], c1[i], a1[j], b1[j], c1[j];
  const Eigen::Vector3d x = M.partialPivLu().solve(Eigen::Vector3d(d, 0, 0));
  State y{};
  y = integrate(sum(sum(y, x[0], turn), x[1], shear), N0, f, 0, s);
  y[3] += x[2];
  y = integrate(y, N0, f, s, L);
  return {x[2], (N0 - f * L / 2) * L / EA - y[4]};
}

double force(const Ends& ends, double f, double s, double d) {
  if (ends.slides()) return press(ends, f * L, f, s, d).force;
  // The excess is smooth and grows with N0, so the secant converges in a few steps.
  double N0 = f / 2, next = N0 + 1, excess = press(ends, N0, f, s, d).excess;
  Pressed at = press(ends, next, f, s, d);
  for (int i = 0; i < 40 && at.excess != excess; ++i) {
    const double step = at.excess * (next - N0) / (at.excess - excess);
    N0 = next, excess = at.excess;
    next -= step;
    at = press(ends, next, f, s, d);
    if (std::abs(step) <= 1e-11 * (std::abs(next) + std::abs(f))) return at.force;
  }
  FAIL("the secant has not converged");
  return at.force;
}

const std::vector<Ends> all_ends{{Support::pinned, Support::pinned, 18.569, {5e-3, 4e-4, 3e-5}},
                                 {Support::clamped, Support::clamped, 74.629, {8e-3, 1.5e-3, 1.6e-4}},
                                 {Support::pinned, Support::roller, 18.569, {1.8e-3, 1e-4, 6e-6}},
                                 {Support::clamped, Support::roller, 52.501, {9e-3, 6e-4, 5e-5}},
                                 {Support::clamped, Support::free, 7.837, {6e-4, 8e-5, 5e-6}}};

}  // namespace

// A load that pulls where its end slides, or pulls one half where both are held, makes the boundary layer
// short; one that presses makes the force small.  The worst places are near supports and the largest loads, and are tried first.
TEST_CASE("a beam under a load along its axis is pressed to what the page states, at any place and depth",
          "[load]") {
  Random random(7);
  for (const Ends& ends : all_ends) {
    const double most = 3, least = ends.slides() ? -0.9 : -3, end = ends.right == Support::free ? 1 : 0.95;
    for (int k = 0; k < 100; ++k) {
      const bool corner = k < 40;
      const double f = ends.buckles * (corner ? k % 2 ? most : least : random(least, most)),
                   s = corner ? 0.05 + (end - 0.05) * (k / 2) / 19 : random(0.05, end),
                   d = height * std::pow(10, -random(0, 2)), exact = force(ends, f, s, d);
      Beam beam(L, EA, EI, height, ends.left, ends.right);
      beam.axial(f);
      for (std::size_t i = 0; i < 3; ++i) {
        const int n = 8 << i;
        const Response<double> response = FemModel<>(beam, n, patient_solver()).press({s, d});
        CAPTURE(name(ends.left), name(ends.right), f / ends.buckles, s, d, n, exact);
        CHECK(response.status == Status::ok);
        CHECK(relative_error(response.force, exact) <= ends.error[i]);
      }
    }
  }
}

TEST_CASE("a beam under a load along its axis is pressed with fourth order", "[load]") {
  const double s = 0.3, d = 0.01;
  for (const double f : {5.0, 50.0, -10.0}) {
    const double exact = force(all_ends[0], f, s, d);
    Beam beam(L, EA, EI, height, Support::pinned, Support::pinned);
    beam.axial(f);
    double error[4], turning[4];
    for (int k = 0; k < 4; ++k) {
      error[k] = relative_error(FemModel<>(beam, 8 << k, patient_solver()).press({s, d}).force, exact);
      turning[k] =
          relative_error(FemModel<Corotational<>>(beam, 8 << k, patient_solver()).press({s, d}).force, exact);
      CAPTURE(f, 8 << k, exact, error[k], turning[k]);
      CHECK(error[k] <= 5e-4 * std::pow(16, -k));
      // Of any rotation: slopes of 0.03 to 0.05 are 1e-3 of the force, whatever the mesh.
      CHECK(turning[k] <= 2e-3);
    }
    CAPTURE(f, error[0], error[1], error[2], error[3]);
    CHECK(observed_order(error[0], error[3]) >= 3 * 3.8);
  }
}
