// One tick of a moving press: hapbeam's full model against the same Newton over Eigen's sparse solvers.  This beam has one
// unknown, its tension (one_tension); block_tridiagonal solves for all displacements, as a beam with dead loads needs.
//
// The thesis' beam, both ends pinned, from 4 to 4096 elements.  A period of 1000 ticks of 1 ms either presses mid-span
// from 0 to 50 mm and back or slides along the beam; each tick starts from the one before.  Time is that of a tick.
//
//   force_error   of the press by 50 mm at mid-span, relative to the closed form
//   solves        Newton iterations a tick
//   solve_ns      a Newton iteration [ns]: median of time over solves of each tick, hence all of a press is in it
//   p50_us, p99_us    of the ticks [µs]
//
// The last line holds what is claimed: SimplicialLDLT's time for a Newton iteration, with the same elements, over that of
// either (ratio_ of block_tridiagonal, tension_ratio_ of one_tension, whose time has all of a press in it and so its shape),
// and the exponent with which BlockTridiagonal's grows from 64 to 4096 elements.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "support/assembled_by.hpp"
#include "support/sparse_assemblers.hpp"
#include "support/statistics.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;

namespace {

constexpr double force_at_50_mm = 11105.121222;  // [N] closed form: tests/data/von_karman_press_pinned.csv

/// The same element by another name, whose closed form the model does not take.
template <class Membrane>
struct NodeByNode : VonKarman<Membrane> {
  using Abreast = NodeByNode;
};

/// solve_ns of every run, by solver and number of elements.
std::map<std::pair<std::string, int>, std::vector<double>> runs;

template <class Model>
void ticks(benchmark::State& state, const std::string& solver, Path path, int elements) {
  using Clock = std::chrono::steady_clock;
  Model model(thesis_beam(), elements);
  for (int mm = 5; mm < 50; mm += 5) model.press({length / 2, 1e-3 * mm});
  const double error = model.press({length / 2, 0.05}).force / force_at_50_mm - 1;
  model.reset();

  const int count = period * std::clamp(256 / elements, 1, 8);
  std::vector<double> tick_ns, solve_ns;
  tick_ns.reserve(static_cast<std::size_t>(count));
  solve_ns.reserve(static_cast<std::size_t>(count));
  double solves = 0, total = 0;
  for (auto _ : state) {
    for (int tick = -50; tick < count; ++tick) {
      const Press<double> press = path(tick);
      const auto begin = Clock::now();
      const Response<double> response = model.press(press);
      const double ns = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
      benchmark::DoNotOptimize(response);
      if (response.status != Status::ok) return state.SkipWithError(name(response.status));
      if (tick < 0) continue;  // caches, and the branches that a processor learns
      total += ns;
      solves += model.report().solves;
      tick_ns.push_back(ns);
      solve_ns.push_back(ns / model.report().solves);
    }
    state.SetIterationTime(total * 1e-9 / count);
  }
  state.counters["elements"] = elements;
  state.counters["force_error"] = std::abs(error);
  state.counters["solves"] = solves / count;
  state.counters["p50_us"] = quantile(tick_ns, 0.5) * 1e-3;
  state.counters["p99_us"] = quantile(tick_ns, 0.99) * 1e-3;
  const double median = quantile(solve_ns, 0.5);
  state.counters["solve_ns"] = median;
  if (path == press_path) runs[{solver, elements}].push_back(median);
}

/// Median over the repetitions; 0 where it was not run.
double solve_ns(const std::string& solver, int elements) {
  auto& values = runs[{solver, elements}];
  return values.empty() ? 0 : quantile(values, 0.5);
}

const char* const ours = "block_tridiagonal/reduced";
const char* const by_tension = "one_tension/stability_functions";
const char* const theirs[] = {"simplicial_ldlt_natural/reduced", "simplicial_ldlt_amd/reduced"};
constexpr int sizes[] = {4, 16, 64, 256, 1024, 4096};

void summary(benchmark::State& state) {
  for (auto _ : state) state.SetIterationTime(0);
  // Least squares of log(time) over log(elements).
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const int elements : sizes) {
    const double own = solve_ns(ours, elements);
    double other = solve_ns(theirs[0], elements);
    // Against the faster of the two.
    if (const double amd = solve_ns(theirs[1], elements); amd > 0) other = std::min(other, amd);
    if (own == 0 || other == 0) return state.SkipWithError("needs all runs of press/");
    if (elements >= 16) {
      state.counters["ratio_" + std::to_string(elements)] = other / own;
      state.counters["tension_ratio_" + std::to_string(elements)] = other / solve_ns(by_tension, elements);
    }
    if (elements < 64) continue;
    const double log_n = std::log(elements), log_t = std::log(own);
    n += 1, x += log_n, y += log_t, xx += log_n * log_n, xy += log_n * log_t;
  }
  state.counters["exponent"] = (n * xy - x * y) / (n * xx - x * x);
}

template <class Model>
void add(const std::string& path_name, Path path, const std::string& solver, int elements) {
  const std::string name = path_name + "/" + solver + "/" + std::to_string(elements);
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) { ticks<Model>(state, solver, path, elements); })
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
}

// All solvers of a size one after another: a machine that slows down meanwhile does so for all.
const bool registered = [] {
  for (const auto& [name, path] : {std::pair{"press", &press_path}, std::pair{"slide", &slide_path}})
    for (const int elements : sizes) {
      add<FemModel<>>(name, path, by_tension, elements);
      add<FemModel<NodeByNode<StabilityFunctions>>>(name, path, "block_tridiagonal/stability_functions",
                                                    elements);
      add<FemModel<VonKarman<ReducedIntegration>>>(name, path, ours, elements);
      add<Solved<VonKarman<ReducedIntegration>, SimplicialLdltNatural>>(name, path, theirs[0], elements);
      add<Solved<VonKarman<ReducedIntegration>, SimplicialLdltAmd>>(name, path, theirs[1], elements);
      if (elements <= 1024)
        add<Solved<VonKarman<ReducedIntegration>, SparseLuFromTriplets>>(
            name, path, "sparse_lu_from_triplets/reduced", elements);
    }
  benchmark::RegisterBenchmark("summary", summary)->Iterations(1)->UseManualTime();
  return true;
}();

}  // namespace
