// Newton's method: from far away, beyond a limit point, on a ridge, and at zero.
#include <cmath>

#include "report.hpp"
#include "support/arch.hpp"
#include "support/naive_newton.hpp"
#include "support/path.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam::benchmarks {

namespace {

using namespace hapbeam::testing;

struct Effort {
  int steps, naive,
      library;  // load steps and linear solves of the naive method, linear solves of the library
};

/// Of a cantilever of L = EI = 1 from rest to where a tip load of 10 bends it; the fewest equal steps that get there, a
/// power of two.
Effort far_effort(double EA, int elements) {
  Beam beam(1, EA, 1, 0.01, Support::clamped, Support::free);
  beam.add({1, 0, 10, 0});
  const int library = FemModel<Corotational<>>(beam, elements).rest().solves;
  for (int steps = 1;; steps *= 2) {
    System<> system(beam, elements);
    system.set_goal();
    const NaiveSolve naive = naive_newton(system, steps);
    if (naive.converged || steps == 4096) return {steps, naive.solves, library};
  }
}

void far(Report& report) {
  Series series = report.series("newton_far", "elements,naive_steps,naive_solves,hapbeam_solves");
  for (int n = 8; n <= 1024; n *= 2) {
    const Effort effort = far_effort(1e4, n);
    series.add(n, effort.steps, effort.naive, effort.library);
  }
  const Effort coarse = far_effort(1e4, 8), fine = far_effort(1e4, 1024), thin = far_effort(1e6, 1024);
  report.failure("newton-from-far-away", "with one load step; 8 elements require " +
                                             std::to_string(coarse.steps) + " steps, 1024 elements " +
                                             std::to_string(fine.steps));
  report.row("linear solves from rest to 0.81 lengths of deflection, 8 elements",
             std::to_string(coarse.naive), std::to_string(coarse.library));
  report.row("1024 elements", std::to_string(fine.naive), std::to_string(fine.library));
  report.row("1024 elements, EA L²/EI = 10⁶", std::to_string(thin.naive), std::to_string(thin.library));
}

void limit_points(Report& report) {
  const double rise = level_arch_rise(1, 0.2);
  const Beam arch = level_arch(1, 0.2, 20736, 1, 0.001, Support::pinned, Support::pinned);
  Beam loaded = arch;
  loaded.add({0.5, 0, -1, 0});
  const Path path = follow(
      loaded, 16, 0.002, [&](const auto& at) { return (rise - at.node(8).w) / rise; },
      [](const Equilibrium& e) { return e.way < 2.5; });
  Series along = report.series("limit_path", "down,load");
  for (const Equilibrium& e : path.points) along.add(e.way, e.load);
  const std::vector<Turn> limits = load_turns(path);

  // Up, past the first limit point, to where it says that it has converged.
  Series naive = report.series("limit_load", "down,load");
  System<> system(loaded, 16);
  double down = 0, jump = 0;
  for (double load = 0.1; jump < 1 && load < 3; load += 0.1) {
    system.set_load(load);
    for (int k = 0; k < 1000; ++k) {
      if (system.factor(0) != Status::ok) break;
      system.move([&](int i) { return system.increment(i); });
      system.find_tensions();
      if (RelativeEnergy{}(system)) break;
    }
    const double now = (rise - system.node(8).w) / rise;
    jump = now - down, down = now;
    naive.add(down, load);
  }

  Series pressed = report.series("limit_press", "down,load");
  FemModel<Corotational<>> model(arch, 16);
  double largest = 0, before = 0, most = 0;
  int solves = 0;
  for (int k = 1; k <= 250; ++k) {
    const double force = -model.press({0.5, rise * (1 - k / 100.0)}).force;
    if (k % 10 == 0) pressed.add(k / 100.0, force);
    largest = std::max(largest, force);
    most = std::max(most, std::abs(force - before));
    solves = std::max(solves, model.report().solves);
    before = force;
  }
  report.failure("limit-points", "at the limit load, " + number(limits.front().extreme, 4) + " EI/L², " +
                                     number(limits.front().other, 2) + " rises down");
  report.row("largest movement of the middle in a step, in rises", number(jump), "0.01, as prescribed");
  report.row("largest number of linear solves in a step", "some hundred, or no convergence",
             std::to_string(solves));
}

void buckling(Report& report) {
  const double EA = 1e6, euler = std::acos(-1.0) * std::acos(-1.0), push = 1e-4;
  Series series =
      report.series("buckling", "times_euler,naive_aside,hapbeam_aside,naive_stiffness,hapbeam_stiffness");
  const auto at = [&](double times, double& naive, double& aside, double& naive_k, double& k) {
    Beam beam(1, EA, 1, 0.001, Support::pinned, Support::pinned);
    beam.place({}, {-times * euler / EA, 0, 0});
    System<> system(beam, 16);
    lay_straight(system, 1);
    system.set_goal();
    naive_newton(system);
    naive = system.node(8).w;
    system.set_goal(Push<double>{0.5, push, {0, 1}});
    naive_newton(system);
    naive_k = system.rows().reaction(0) / push;
    FemModel<Corotational<>> model(beam, 16);
    aside = model.shape().at(0.5).w;
    k = model.press({0.5, aside - push}).force / -push;
  };
  double naive = 0, aside = 0, naive_k = 0, k = 0;
  for (double times = 0.1; times <= 10.01; times *= std::pow(10, 0.05)) {
    at(times, naive, aside, naive_k, k);
    series.add(times, naive, aside, naive_k, k);
  }
  report.failure("buckling", "at Euler's load");
  for (const double times : {0.5, 2.0, 10.0}) {
    at(times, naive, aside, naive_k, k);
    report.row("ends moved together by " + number(times) +
                   " times the shortening at Euler's load: deflection of the middle, in lengths",
               number(naive), number(std::abs(aside) < 1e-12 ? 0 : aside));
    report.row("the same: stiffness of a press, in EI/L³", number(naive_k), number(k));
  }
}

void zero(Report& report) {
  const double s = 0.3 * thesis_length;
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  report.failure("a-press-to-zero", "at a press whose force is zero");
  for (const double d : {1e-3, 1e-12, 0.0}) {
    System<VonKarman<>> system(beam, 16);
    system.set_goal(Push<double>{s, 1e-2, {0, 1}});
    naive_newton(system);
    system.set_goal(Push<double>{s, d, {0, 1}});
    const NaiveSolve naive = naive_newton(system, 1, 1000, RelativeDisplacement{});
    FemModel<> model(beam, 16);
    model.press({s, 1e-2});
    model.press({s, d});
    report.row("linear solves from a press of 10 mm to one of " + number(1e3 * d) + " mm",
               naive.converged ? std::to_string(naive.solves) : "no convergence",
               std::to_string(model.report().solves));
  }
}

}  // namespace

void newton(Report& report) {
  far(report);
  limit_points(report);
  buckling(report);
  zero(report);
}

}  // namespace hapbeam::benchmarks
