// A beam under a load along its axis, pressed: against the equations of moderate rotation, integrated as an initial-value
// problem.
//
//   (EI w''' - N w')' = 0,   N' = -f,   N(x) = N0 - f x,   ∫ (N/EA - ½ w'²) dx = 0
//
// Under a given N0 the deflection is linear, and the ends' distance asks for N0.  Fourth-order Runge–Kutta with 4000 steps
// leaves 1e-12.  It shares neither code nor discretisation with the library.
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/solver.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = 1, EA = 1e5, EI = 1;

/// w, w', w'', EI w''' - N w', ∫½w'² dx
using State = Eigen::Matrix<double, 5, 1>;

State integrate(State y, double N0, double f, double from, double to) {
  const auto rates = [&](double x, const State& at) {
    State r;
    r << at[1], at[2], (at[3] + (N0 - f * x) * at[1]) / EI, 0, at[1] * at[1] / 2;
    return r;
  };
  const int steps = 2000;
  const double h = (to - from) / steps;
  for (int i = 0; i < steps; ++i) {
    const double x = from + i * h;
    const State a = rates(x, y), b = rates(x + h / 2, y + h / 2 * a), c = rates(x + h / 2, y + h / 2 * b),
                d = rates(x + h, y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return y;
}

struct Pressed {
  double force, excess;  // excess of the ends' distance over what it is
};

/// Between hinges, pressed by d at s.
Pressed press(double N0, double f, double s, double d) {
  State slope = State::Zero(), shear = State::Zero();
  slope[1] = 1, shear[3] = 1;
  const State a = integrate(slope, N0, f, 0, s), b = integrate(shear, N0, f, 0, s),
              a1 = integrate(a, N0, f, s, L), b1 = integrate(b, N0, f, s, L),
              c1 = integrate(shear, N0, f, s, L);
  Eigen::Matrix3d M;
  M << a[0], b[0], 0, a1[0], b1[0], c1[0], a1[2], b1[2], c1[2];
  const Eigen::Vector3d x = M.partialPivLu().solve(Eigen::Vector3d(d, 0, 0));
  State y = x[0] * slope + x[1] * shear;
  y = integrate(y, N0, f, 0, s);
  y[3] += x[2];
  y = integrate(y, N0, f, s, L);
  return {x[2], (N0 - f * L / 2) * L / EA - y[4]};
}

double force(double f, double s, double d) {
  // The excess is smooth and grows with N0, so the secant converges in a few steps.
  double N0 = f / 2, next = N0 + 1, excess = press(N0, f, s, d).excess;
  Pressed at = press(next, f, s, d);
  for (int i = 0; i < 20 && at.excess != excess; ++i) {
    const double step = at.excess * (next - N0) / (at.excess - excess);
    N0 = next, excess = at.excess;
    next -= step;
    at = press(next, f, s, d);
    if (std::abs(step) <= 1e-12 * (std::abs(next) + f)) return at.force;
  }
  FAIL("the secant has not converged");
  return at.force;
}

}  // namespace

// 5 to 50 EI/L³ is 1/4 to 3 of what buckles the beam, were its other end free to slide.
TEST_CASE("a beam under a load along its axis is pressed with fourth order, 5e-4 at 8 elements", "[load]") {
  const double s = 0.3, d = 0.01;
  for (const double f : {5.0, 50.0, -10.0}) {
    const double exact = force(f, s, d);
    Beam beam(L, EA, EI, 0.01, Support::pinned, Support::pinned);
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
