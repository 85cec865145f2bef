// How NewtonRaphson converges on a beam, and each way in which it stops.
#include <limits>
#include <sstream>
#include <vector>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using System = BeamSystem<VonKarman<>, double, Eigen::Dynamic, Eigen::Dynamic>;

/// A spring k x = λ f of one unknown that can be told to fail: the least that NewtonRaphson can solve.
struct Spring {
  using Scalar = double;
  double x = 0, target = 0, saved = 0;
  int fail_until = 0;  // steps longer than 1/fail_until do not converge
  Status failure = Status::singular;
  int iterations = 0;

  void set_target(double t) noexcept { target = t; }
  void save() noexcept { saved = x; }
  void restore() noexcept { x = saved; }
  double size() const noexcept { return std::abs(x); }
  double unit() const noexcept { return 1; }
  int elements() const noexcept { return 2; }
  Iteration<double> iterate() noexcept {
    ++iterations;
    if (fail_until > 0 && (target - saved) * fail_until > 1) {
      x = -1e3;  // whatever a failed iteration leaves behind
      return {failure, 0};
    }
    const double increment = target - x;
    x = target;
    return {Status::ok, std::abs(increment)};
  }
};

/// Newton's increments and the states before them, as a beam has shown them; the last goes on for ever.
template <typename ScalarType>
struct Recorded {
  using Scalar = ScalarType;
  struct Step {
    Scalar increment, state;
  };
  std::vector<Step> steps;
  std::size_t next = 0;

  void set_target(Scalar) noexcept {}
  void save() noexcept {}
  void restore() noexcept { next = steps.size() - 1; }
  Scalar size() const noexcept { return steps[next == 0 ? 0 : next - 1].state; }
  Scalar unit() const noexcept { return 1; }
  int elements() const noexcept { return 32; }
  Iteration<Scalar> iterate() noexcept {
    if (next < steps.size()) ++next;
    return {Status::ok, steps[next - 1].increment};
  }
};

}  // namespace

// e(k+1) = C e(k)² makes log(e2/e1) / log(e1/e0) tend to 2.  The first increment carries the press;
// increments below 1e-13 of the state are round-off.
TEST_CASE("Newton is quadratic: each increment is the square of the one before", "[newton]") {
  for (const int elements : {4, 16, 64})
    for (const double position : {0.1, 0.3, 0.5}) {
      System system(thesis_beam(Support::pinned, Support::pinned), elements);
      system.set_goal(Push<double>{position * thesis_length, 20e-3, {0, 1}});
      system.set_target(1);
      std::vector<double> sizes;
      std::ostringstream sequence;
      for (int k = 0; k < 10; ++k) {
        const Iteration<double> iteration = system.iterate();
        REQUIRE(iteration.status == Status::ok);
        if (k > 0) sizes.push_back(iteration.size / system.size());
        if (k > 0) sequence << sizes.back() << ' ';
      }
      std::size_t last = sizes.size() - 1;
      while (last > 2 && sizes[last] < 1e-13) --last;
      const double order =
          std::log(sizes[last] / sizes[last - 1]) / std::log(sizes[last - 1] / sizes[last - 2]);
      INFO(elements << " elements at " << position << ": increments " << sequence.str() << ", order "
                    << order);
      CHECK(order >= 1.8);
      CHECK(sizes.back() <= 1e-13);
    }
}

TEST_CASE("a step that does not converge is taken back and cut until it does", "[newton]") {
  Spring spring;
  spring.fail_until = 3;
  const SolveReport<double> report = NewtonRaphson{}.solve(spring);
  CHECK(report.status == Status::ok);
  CHECK(report.reached == 1);
  CHECK(report.steps >= 3);
  CHECK(report.solves == spring.iterations);
  CHECK(spring.x == 1);
}

TEST_CASE("each way to stop has its status and leaves the last state that converged", "[newton]") {
  NewtonRaphson solver;
  for (const Status failure : {Status::singular, Status::non_finite}) {
    Spring never;
    never.failure = failure;
    never.fail_until = std::numeric_limits<int>::max();
    const SolveReport<double> report = solver.solve(never);
    CHECK(report.status == failure);
    CHECK(report.reached == 0);
    CHECK(never.x == 0);
    CHECK(report.solves <= solver.max_solves);
  }
  Spring slow;
  slow.fail_until = 1000;
  solver.max_solves = 40;
  const SolveReport<double> report = solver.solve(slow);
  CHECK(report.status != Status::ok);
  CHECK(report.solves == 40);
  CHECK(report.reached > 0);
  CHECK(slow.x == report.reached);
}

// A state that has blown up is large, and so is the increment that leads back from it: against either the next one looks
// small, and is not.  Recorded from a ruler of 32 elements in float, which answered 37 kN for 0.2 kN.
TEMPLATE_TEST_CASE("what follows an increment that has blown up is not taken for convergence", "[newton]",
                   float, double) {
  for (const auto& steps :
       {std::vector<typename Recorded<TestType>::Step>{
            {29.0f, 1.75f}, {2.21e7f, 2.21e7f}, {81.4f, 382.5f}, {40.0f, 300.0f}},
        {{21.5f, 1.6f}, {3.0e5f, 3.0e5f}, {1.48f, 50.6f}, {1.5f, 50.0f}},
        {{238.3f, 31.9f}, {3.53f, 26.6f}, {11.9f, 28.9f}, {2.63f, 26.5f}, {0.25f, 26.4f}}}) {
    Recorded<TestType> beam{steps};
    const auto report = NewtonRaphson{}.solve(beam);
    CAPTURE(steps.back().increment);
    CHECK(report.status == Status::iteration_limit);
    CHECK(report.steps == 0);
  }
}

// From rest and from a neighbouring press; against a solver that leaves nothing but round-off.
TEST_CASE("the default solver leaves no more than its tolerance in the force", "[newton]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const int elements : {4, 16, 64}) {
      const Beam beam = thesis_beam(end, end);
      const NewtonRaphson defaults;
      FemModel<> model(beam, elements), exact(beam, elements, tight_solver());
      double worst = 0;
      for (const double position : {0.07, 0.2, 0.43, 0.5})
        for (int k = -20; k <= 20; ++k) {
          const Press<double> press{position * thesis_length, 2.5e-3 * k};
          if (k % 3 == 0) model.reset();
          const Response<double> response = model.press(press);
          REQUIRE(response.status == Status::ok);
          const double force = exact.press(press).force;
          if (k != 0) worst = std::max(worst, relative_error(response.force, force));
        }
      INFO(name(end) << ", " << elements << " elements: " << worst);
      CHECK(worst <= defaults.relative_tolerance);
    }
}
