// Steps of time: rules that give energy to a beam that swings far, or take it.
#include <cmath>
#include <utility>

#include "report.hpp"
#include "support/time_rules.hpp"

namespace hapbeam::benchmarks {

namespace {

using namespace hapbeam::testing;

constexpr double seconds = 0.5;

struct Course {
  double energy = 1;   ///< at the end, over that of the beginning
  double doubled = 0;  ///< when it had twice as much, 0: never [s]
  double failed = 0;   ///< when a step had no solution, 0: never [s]
};

/// @param each  (time [s], energy over that of the beginning), after each step
template <class Beam, class Each>
Course follow(Beam&& beam, double h, Each&& each) {
  Course course;
  const double before = beam.energy();
  for (double t = h; t < seconds + h / 2; t += h) {
    if (!beam.step(h)) return course.failed = t, course;
    course.energy = beam.energy() / before;
    if (course.doubled == 0 && course.energy > 2) course.doubled = t;
    each(t, course.energy);
  }
  return course;
}
template <class Beam>
Course follow(Beam&& beam, double h) {
  return follow(beam, h, [](double, double) {});
}

std::string milliseconds(double t) { return number(1e3 * t) + " ms"; }
std::string lost(const Course& course) {
  return course.failed > 0 ? "doubled after " + milliseconds(course.doubled) + ", no step after " +
                                 milliseconds(course.failed)
                           : percent(1 - course.energy) + " lost";
}

}  // namespace

void steps(Report& report) {
  const LetGo start;
  Series series = report.series("steps", "rule,ms,energy,tip_mm");
  const auto trace = [&](double rule, auto&& beam) {
    series.add(rule, 0.0, 1.0, 1e3 * beam.tip().y());
    return follow(beam, 1e-3,
                  [&](double t, double energy) { series.add(rule, 1e3 * t, energy, 1e3 * beam.tip().y()); });
  };
  const Course average = trace(1, start.by(AverageAcceleration())),
               euler = trace(2, start.by(BackwardEuler()));
  trace(3, start.by_library());

  const auto rows = [&](const auto& rule) {
    for (const double h : {1e-3, 2.5e-4, 1e-4})
      report.row("energy in half a second, steps of " + milliseconds(h), lost(follow(start.by(rule), h)),
                 lost(follow(start.by_library(), h)));
  };
  report.failure("trapezoidal-rule",
                 "with steps of 1 ms: twice the energy after " + milliseconds(average.doubled));
  rows(AverageAcceleration());
  report.failure("backward-euler",
                 "with steps of 1 ms: " + percent(1 - euler.energy) + " of the energy lost in half a second");
  rows(BackwardEuler());
}

}  // namespace hapbeam::benchmarks
