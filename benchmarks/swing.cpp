// How fast and how well beams with mass are stepped: a steel ruler of 300 x 1 mm, let go with its tip turned by 1.2 rad.
//
//   swing/RULE/ELEMENTS/STEPS     steps a period, which takes 0.11 s: with 100 each is about a tick
//     share                  of a processor that this takes; 1: as long as the motion itself
//     tip_error              largest in the first period, over the length, against an elastica
//     energy_gained, _lost   largest rise above what it began with, and loss at the end, over that; not known of masses and springs
//
// All are run a few times; the fastest counts.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "support/first_mode_swing.hpp"
#include "support/mass_spring.hpp"
#include "support/time_rules.hpp"

namespace {

using namespace hapbeam;
using namespace hapbeam::testing;

const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850}, Support::clamped,
                 Support::free);
const FirstModeSwing& swing() {
  static const FirstModeSwing swing(ruler);
  return swing;
}

// What is stepped: step(dt), tip(), energy().

struct Library : LibrarySwing {
  Library(int elements, const Centreline<double>& shape) : LibrarySwing(ruler, elements, shape) {}
};

template <class Rule>
struct Ruled : Swing<Rule> {
  Ruled(int elements, const Centreline<double>& shape) : Swing<Rule>(ruler, elements, shape) {}
};

/// A step is so many as its fastest mode needs.
struct Chain {
  Chain(int elements, const Centreline<double>& shape)
      : masses(ruler, elements, 0.01, ruler.mass_per_length(0), 0) {
    masses.let_go_from(shape);
  }
  bool step(double dt) noexcept {
    const int steps = steps_in(dt);
    for (int k = 0; k < steps; ++k) masses.advance(dt / steps);
    return true;
  }
  int steps_in(double dt) const noexcept {
    return static_cast<int>(std::ceil(dt / benchmarks::MassSpring<2>::tick_time * masses.steps()));
  }
  Vector2<double> tip() const { return masses.tip(); }
  static double energy() { return std::nan(""); }
  benchmarks::MassSpring<2> masses;
};

/// @param parts  steps in a hundredth of a period
template <class Beam>
void run(benchmark::State& state, int elements, int parts) {
  const auto nodes = first_mode_shape(ruler.length(), elements);
  const Centreline<double> shape{nodes.data(), static_cast<int>(nodes.size()), true};
  const int rounds = std::getenv("HAPBEAM_QUICK") ? 2 : 9;
  for (auto _ : state) {
    double fastest = 1e9;
    for (int round = 0; round < rounds; ++round) {
      Beam beam(elements, shape);
      const auto begin = std::chrono::steady_clock::now();
      state.counters["tip_error"] = swing().error(
          parts, [&](double dt) { return beam.step(dt); }, [&] { return beam.tip(); });
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      fastest = std::min(fastest, took.count());
    }
    state.SetIterationTime(fastest);
    state.counters["share"] = fastest / swing().period();
    Beam beam(elements, shape);
    const double before = beam.energy();
    double most = before;
    const auto step = [&](double dt) {
      const bool found = beam.step(dt);
      most = std::max(most, beam.energy());
      return found;
    };
    (void)swing().error(parts, step, [&] { return beam.tip(); });
    if (!std::isfinite(before)) continue;
    state.counters["energy_gained"] = most / before - 1;
    state.counters["energy_lost"] = 1 - beam.energy() / before;
  }
}

template <class Beam>
void add(const std::string& rule, int elements, int parts, int steps) {
  const std::string name = "swing/" + rule + "/" + std::to_string(elements) + "/" + std::to_string(steps);
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) { run<Beam>(state, elements, parts); })
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  for (const int parts : {1, 2, 4, 8}) {
    const int steps = static_cast<int>(swing().size()) * parts;
    add<Library>("TR-BDF2", 16, parts, steps);
    add<Ruled<Bdf2>>("BDF2", 16, parts, steps);
    add<Ruled<GeneralizedAlpha>>("generalized alpha", 16, parts, steps);
    add<Ruled<AverageAcceleration>>("trapezoidal rule", 16, parts, steps);
    add<Ruled<BackwardEuler>>("backward Euler", 16, parts, steps);
  }
  for (const int elements : {8, 16, 32, 64}) {
    const double part = swing().period() / static_cast<double>(swing().size());
    const Chain chain(elements, FemModel<Corotational<>>(ruler, elements).shape());
    add<Chain>("masses and springs", elements, 1, static_cast<int>(swing().size()) * chain.steps_in(part));
  }
  return true;
}();

}  // namespace
