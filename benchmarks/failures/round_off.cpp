// Digits: fine meshes in double, and float.
#include <cmath>
#include <limits>

#include "report.hpp"
#include "support/closed_form.hpp"
#include "support/condition.hpp"
#include "support/error.hpp"
#include "support/naive_newton.hpp"
#include "support/path.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam::benchmarks {

namespace {

using namespace hapbeam::testing;

constexpr double s = 0.25 * thesis_length, d = 5e-3;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

template <typename Scalar>
double error(int n) {
  FemModel<VonKarman<>, Scalar> model(pinned(), n);
  const Response<Scalar> response = model.press({Scalar(s), Scalar(d)});
  const double exact = PinnedPress(thesis_length, thesis_EA, thesis_EI)(s, d);
  return response.status == Status::ok ? relative_error(static_cast<double>(response.force), exact) : none;
}

/// The least of what fifty iterations leave of the residual, over the force.
double least_residual(int n) {
  System<VonKarman<>> system(pinned(), n);
  system.set_goal(Push<double>{s, d, {0, 1}});
  double least = 1;
  naive_newton(system, 1, 50, RelativeResidual<VonKarman<>>{thesis_EA, thesis_EI, n / 4, 0, &least});
  return least;
}

int naive_float_solves(int n) {
  BeamSystem<VonKarman<>, float, Eigen::Dynamic, Eigen::Dynamic> system(pinned(), n);
  system.set_goal(Push<float>{float(s), float(d), {0, 1}});
  const NaiveSolve naive = naive_newton(system, 1, 1000);
  return naive.converged ? naive.solves : 0;
}

}  // namespace

void round_off(Report& report) {
  Series series = report.series("round_off", "elements,double,float,residual");
  const int finest = FemModel<VonKarman<>, float>::most_elements(pinned());
  int residual_fails = 0;
  for (int n = 4; n <= 16384; n *= 2) {
    const double residual = least_residual(n), single = n <= finest ? error<float>(n) : none;
    if (residual_fails == 0 && residual > 1e-8) residual_fails = n;
    series.add(n, error<double>(n), single, residual);
  }
  report.failure("float", "on any mesh: a tolerance of 1e-8 is below the last digit");
  FemModel<VonKarman<>, float> model(pinned(), 16);
  model.press({float(s), float(d)});
  const int naive = naive_float_solves(16);
  report.row("linear solves of a press, 16 elements, tolerance 1e-8",
             naive == 0 ? "no convergence" : std::to_string(naive), std::to_string(model.report().solves));
  for (const int n : {8, 64})
    report.row("error of the force with " + std::to_string(n) + " elements", "–", number(error<float>(n)));
  report.failure("thousands-of-elements",
                 "a residual of 1e-8 is not reached at " + std::to_string(residual_fails) + " elements");
  for (const int n : {8, 32})
    report.row(std::to_string(n) + " elements: condition number of the bending stiffness",
               number(bending_condition(n)), "–");
  for (const int n : {1024, 16384})
    report.row(std::to_string(n) + " elements: least residual over the force; error of the force",
               number(least_residual(n)), number(error<double>(n)));
}

}  // namespace hapbeam::benchmarks
