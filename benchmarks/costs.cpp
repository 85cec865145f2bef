// What sizes cost: modes, snapshots and the number of beams, in time and memory.  Elements: thesis_figures.
//
// The thesis' beam between two hinges, slid over from 0.3 to 0.7 of its span at 20 mm; a tick is a press with its shape.
//
//   modes/pod/N         a PodModel of 16 × 12 presses with N modes
//   snapshots/MODEL/N   a model of N presses, 4 positions for 3 depths; training it from 256 elements
//   near_support/MODEL/N    the same from 1 % of the span on, 10 mm deep: 32 positions for 12 depths
//   beams/MODEL/N       N beams ticked in turn, as a scene full of them would: a tick of one
//   elements/fem/N      what N elements hold of the memory
//
//   tick_us        median over the rounds [µs]
//   training_ms    presses of the full model, decomposition and tables [ms]; median over the rounds
//   force_error    largest of 500 random presses, relative to the closed form
//   shape_error    largest of as many, relative to 256 elements
//   bytes          of one model
//
// HAPBEAM_QUICK=1 in the environment takes fewer rounds.  Everything is measured before the first line.
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "support/heap.hpp"
#include "support/press_errors.hpp"
#include "support/thesis_beam.hpp"
#include "support/tick_times.hpp"
#include "support/training.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;

namespace {

const int rounds = std::getenv("HAPBEAM_QUICK") ? 3 : 9;

class Costs {
 public:
  using Counters = std::map<std::string, double>;

  Costs() {
    for (const int modes : {1, 2, 4, 6, 8, 12, 16, 24, 32}) {
      const auto trained = time_pod_training(thesis_beam(), plan(16, 12), 256, true, modes);
      add_trained("modes/pod/" + std::to_string(modes), PodModel<>(trained.data))["shape_error"] =
          trained.data.errors.all.shape_max;
    }
    for (const int k : {2, 3, 4, 5, 6, 8, 12, 16}) {
      const TrainingPlan grid = plan(4 * k, 3 * k);
      const std::string n = std::to_string(12 * k * k);
      add_training<PodModel<>>("snapshots/pod/" + n, grid,
                               [](const TrainingPlan& p) { return time_pod_training(thesis_beam(), p); });
      add_training<GalerkinModel<>>("snapshots/galerkin/" + n, grid, [](const TrainingPlan& p) {
        return time_galerkin_training(thesis_beam(), p);
      });
    }
    TrainingPlan wide = plan(32, 12);
    wide.s_min = 0.01 * length, wide.s_max = 0.99 * length, wide.depth = 0.01;
    const auto at_the_edge = known_presses(0.01, 0.99, wide.depth);
    add("near_support/pod/384",
        {{"force_error",
          force_errors(PodModel<>(time_pod_training(thesis_beam(), wide).data), at_the_edge).max}});
    add("near_support/galerkin/384",
        {{"force_error",
          force_errors(GalerkinModel<>(time_galerkin_training(thesis_beam(), wide).data), at_the_edge).max}});
    const PodModel<> pod(time_pod_training(thesis_beam(), plan(16, 12)).data);
    const GalerkinModel<> galerkin(time_galerkin_training(thesis_beam(), plan(16, 12)).data);
    for (int n = 1; n <= 1024; n *= 4) {
      add_beams("fem_8", FemModel<>(thesis_beam(), 8), n);
      add_beams("fem_64", FemModel<>(thesis_beam(), 64), n);
      add_beams("pod", pod, n);
      add_beams("galerkin", galerkin, n);
    }
    for (int n = 4; n <= 1024; n *= 2)
      add("elements/fem/" + std::to_string(n),
          {{"bytes", bytes_of([n] { return std::make_unique<FemModel<>>(thesis_beam(), n); })}});
    times_.run(rounds);
  }

  const std::map<std::string, Counters>& counters() const { return counters_; }
  const std::vector<std::string>& names() const { return names_; }
  /// Of a tick or of a training [µs]; 0 where neither was timed.
  double tick_us(const std::string& name) const { return timed_.count(name) ? times_.of(name).p50() : 0; }

 private:
  static TrainingPlan plan(int positions, int depths) {
    return TrainingPlan::anywhere(thesis_beam(), depth, positions, depths);
  }

  Counters& add(const std::string& name, const Counters& counters) {
    names_.push_back(name);
    return counters_[name] = counters;
  }

  template <class Model>
  Counters& add_trained(const std::string& name, const Model& model) {
    times_.add(name, presses(slide_path),
               [own = model](const Press<double>& press) mutable { return own.press(press); });
    timed_[name] = true;
    return add(name, {{"force_error", force_errors(model, anywhere()).max},
                      // A copy would share the table.
                      {"bytes", bytes_of([&model] { return std::make_unique<Model>(model.data()); })}});
  }

  /// @param train  plan -> Trained
  template <class Model, class Train>
  void add_training(const std::string& name, const TrainingPlan& plan, const Train& train) {
    std::vector<double> ms;
    for (int round = 0; round < rounds; ++round) {
      const auto trained = train(plan);
      ms.push_back(trained.snapshots_ms + trained.pod_ms);
      if (round == 0) add_trained(name, Model(trained.data));
    }
    counters_[name]["training_ms"] = median(ms);
  }

  template <class Model>
  void add_beams(const std::string& kind, const Model& model, int n) {
    const std::string name = "beams/" + kind + "/" + std::to_string(n);
    times_.add(name, [model, n](std::vector<double>& ns) {
      // Built in each round: a thousand models of every kind at once are more than a small machine has.
      std::vector<Model> beams(static_cast<std::size_t>(n), model);
      Status status = Status::ok;
      const auto sweep = [&](const Press<double>& press) {
        Response<double> last{};
        for (Model& beam : beams) {
          last = beam.press(press);
          if (last.status != Status::ok) status = last.status;
        }
        return last;
      };
      Response<double> response{};
      for (int tick = -20; tick < 200; ++tick) {
        const double time = time_tick(slide_path(tick), sweep, response) / n;
        if (tick >= 0) ns.push_back(time);
      }
      return status;
    });
    timed_[name] = true;
    add(name, {});
  }

  std::vector<std::string> names_;
  std::map<std::string, Counters> counters_;
  std::map<std::string, bool> timed_;
  Rounds times_;
};

const bool registered = [] {
  static const Costs costs;
  for (const std::string& name : costs.names())
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&name](benchmark::State& state) {
                                   const double tick = costs.tick_us(name);
                                   for (auto _ : state) state.SetIterationTime(tick * 1e-6);
                                   if (tick > 0) state.counters["tick_us"] = tick;
                                   for (const auto& [counter, value] : costs.counters().at(name))
                                     state.counters[counter] = value;
                                 })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
