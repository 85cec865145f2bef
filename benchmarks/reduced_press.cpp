// One tick of a moving press: what is trained against what is solved.
//
// The thesis' beam, both ends pinned.  press/: mid-span from 0 to 50 mm and back in 1000 ticks; slide/: along the beam.
//
//   fem/N                    the full model with N elements: force and shape
//   pod_1, galerkin_1        trained at mid-span alone, 14 depths or tensions
//   pod_2, galerkin_2        trained at 5 to 95 % of the span, 16 positions by 12 depths or tensions
//   …/force, …/shape         the force alone, or force and shape as in a FEM tick
//   hand_over/WHERE/N/TICK   Guarded<pod_2, fem/N> across the edge of what was trained; below
//
//   p50_us, p99_us, max_us   of the ticks [µs]: p50 the median over the rounds
//   force_error_*            of 500 random presses, relative to the closed form: at mid-span beside press/, at 5 to 95 %
//                            of the span beside slide/
//   shape_error_max          of 500 others, largest |Δw| along the beam over |d|, relative to 256 elements
//   snapshots_ms, pod_ms     training with 256 elements: presses of the full model, and the rest
//
// hand_over: WHERE is `near`, where the full model was last asked some 20 ticks before, or `rest`, where it never was.
// TICK is `first` (the tick that hands over), `full` (those after it), `fast` (those in the trained range), or `alone`:
// fem/N by itself on the same path.
//
// Everything is measured on first need, whatever the filter.  The last line holds what is claimed: the time of 8 elements
// over that of each other model, median over the rounds.
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "support/press_errors.hpp"
#include "support/thesis_beam.hpp"
#include "support/tick_times.hpp"
#include "support/training.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/guarded.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;

namespace {

using Counters = std::map<std::string, double>;

constexpr int rounds = 15;
constexpr int fem_sizes[] = {4, 8, 16, 32, 64, 128, 256, 1024};
constexpr int guard_sizes[] = {8, 64};

class Comparison {
 public:
  Comparison() {
    for (const int elements : fem_sizes) {
      const FemModel<> model(thesis_beam(), elements);
      const std::string name = "fem/" + std::to_string(elements);
      add_shape("press/" + name, model, press_path, force_counters(model, at_mid_span()));
      add_shape("slide/" + name, model, slide_path, force_counters(model, anywhere()));
    }
    const TrainingPlan here = TrainingPlan::at(length / 2, depth),
                       everywhere = TrainingPlan::anywhere(thesis_beam(), depth);
    const auto pod_2 = time_pod_training(thesis_beam(), everywhere, 256, true);
    add_trained<PodModel<>>("pod_1", time_pod_training(thesis_beam(), here, 256, true), false);
    add_trained<PodModel<>>("pod_2", pod_2, true);
    add_trained<GalerkinModel<>>("galerkin_1", time_galerkin_training(thesis_beam(), here, 256, true), false);
    add_trained<GalerkinModel<>>("galerkin_2", time_galerkin_training(thesis_beam(), everywhere, 256, true),
                                 true);
    for (const int elements : guard_sizes) {
      const Guarded guarded(PodModel<>(pod_2.data), FemModel<>(thesis_beam(), elements));
      add_hand_over("near", guarded, elements, false);
      add_hand_over("rest", guarded, elements, true);
    }
    times_.run(rounds);
  }

  const Rounds& times() const { return times_; }
  const Counters& counters(const std::string& name) const { return counters_.at(name); }

 private:
  template <class Model>
  static Counters force_counters(const Model& model, const std::vector<Known>& known) {
    const ForceErrors errors = force_errors(model, known);
    return {{"force_error_median", errors.median},
            {"force_error_p95", errors.p95},
            {"force_error_max", errors.max}};
  }

  template <class Model>
  void add_shape(const std::string& name, const Model& model, Path path, const Counters& counters) {
    times_.add(name, presses(path),
               [own = model](const Press<double>& press) mutable { return own.press(press); });
    counters_[name] = counters;
  }

  template <class Model>
  void add_trained(const std::string& name, const Trained<typename Model::Data>& trained, bool slides) {
    const Model model(trained.data);
    for (const auto& [path_name, path, known] : {std::tuple{"press/", &press_path, &at_mid_span()},
                                                 std::tuple{"slide/", &slide_path, &anywhere()}}) {
      if (path == slide_path && !slides) continue;
      Counters counters = force_counters(model, *known);
      counters["snapshots_ms"] = trained.snapshots_ms;
      counters["pod_ms"] = trained.pod_ms;
      const std::string full_name = path_name + name;
      times_.add(full_name + "/force", presses(path),
                 [own = model](const Press<double>& press) mutable { return own.force(press); });
      counters_[full_name + "/force"] = counters;
      counters["shape_error_max"] = trained.data.errors.all.shape_max;
      add_shape(full_name + "/shape", model, path, counters);
    }
  }

  /// Along the beam and, every 40 ticks, 1 mm past the depth that was trained, as fast as press/ at its fastest.
  static Press<double> hand_over_path(int tick) {
    return {slide_path(tick).s, depth + 1e-3 * std::sin(turn * 25 * tick)};
  }

  /// @param forgets  the full model starts from rest each time
  void add_hand_over(const std::string& where, const Guarded<PodModel<>, FemModel<>>& guarded, int elements,
                     bool forgets) {
    const std::string name = "hand_over/" + where + "/" + std::to_string(elements) + "/";
    struct Split {
      std::vector<double> first, full, fast;
    };
    const auto split = std::make_shared<Split>();
    times_.add(name + "first", [=, model = guarded](std::vector<double>& ns) mutable {
      *split = {};
      Status status = Status::ok;
      Response<double> response{};
      auto act = [&model](const Press<double>& press) { return model.press(press); };
      for (int tick = 0; tick < 8 * period; ++tick) {
        const bool full_before = model.full_answers();
        const double time = time_tick(hand_over_path(tick), act, response);
        if (response.status != Status::ok && status == Status::ok) status = response.status;
        auto& kind = !model.full_answers() ? split->fast : full_before ? split->full : split->first;
        if (tick >= 50) kind.push_back(time);
        if (forgets && full_before && !model.full_answers()) model.reset();
      }
      ns = split->first;
      return status;
    });
    times_.add(name + "full", [split](std::vector<double>& ns) { return ns = split->full, Status::ok; });
    times_.add(name + "fast", [split](std::vector<double>& ns) { return ns = split->fast, Status::ok; });
    for (const char* kind : {"first", "full", "fast"}) counters_[name + kind] = {};
    if (!forgets) add_shape(name + "alone", guarded.full(), hand_over_path, {});
  }

  Rounds times_;
  std::map<std::string, Counters> counters_;
};

const Comparison& comparison() {
  static const Comparison all;
  return all;
}

void report(benchmark::State& state, const std::string& name) {
  const ModelTimes& times = comparison().times().of(name);
  for (auto _ : state) state.SetIterationTime(times.p50() * 1e-6);
  if (times.status != Status::ok) return state.SkipWithError(hapbeam::name(times.status));
  for (const auto& [counter, value] : comparison().counters(name)) state.counters[counter] = value;
  state.counters["p50_us"] = times.p50();
  state.counters["p99_us"] = times.part(0.99);
  state.counters["max_us"] = times.part(1);
}

const std::vector<std::string> trained_names = {
    "press/pod_1/force", "press/pod_1/shape", "press/galerkin_1/force", "press/galerkin_1/shape",
    "press/pod_2/force", "press/pod_2/shape", "press/galerkin_2/force", "press/galerkin_2/shape",
    "slide/pod_2/force", "slide/pod_2/shape", "slide/galerkin_2/force", "slide/galerkin_2/shape"};

void summary(benchmark::State& state) {
  for (auto _ : state) state.SetIterationTime(0);
  for (const std::string& name : trained_names)
    state.counters[name] = comparison().times().ratio(name.substr(0, 6) + "fem/8", name);
}

const bool registered = [] {
  std::vector<std::string> names;
  for (const char* path : {"press/", "slide/"})
    for (const int elements : fem_sizes) names.push_back(path + ("fem/" + std::to_string(elements)));
  names.insert(names.end(), trained_names.begin(), trained_names.end());
  for (const int elements : guard_sizes)
    for (const char* tick : {"near/N/alone", "near/N/first", "near/N/full", "near/N/fast", "rest/N/first"})
      names.push_back("hand_over/" + std::string(tick).replace(5, 1, std::to_string(elements)));
  for (const std::string& name : names)
    benchmark::RegisterBenchmark(name.c_str(), [name](benchmark::State& state) { report(state, name); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("summary", summary)->Iterations(1)->UseManualTime();
  return true;
}();

}  // namespace
