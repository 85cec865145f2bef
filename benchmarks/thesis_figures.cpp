// Figures 3.8 to 3.11 of the thesis: what elements and snapshots cost, with the error of the force beside each time.
//
// The thesis' beam between two hinges, pressed at mid-span from 0 to 50 mm and back in 1000 ticks.
//
//   figure_3_8/pinned/N        a tick of the full model with N elements
//   figure_3_9/pinned/N        training a PodModel with N elements: 14 presses, POD, tables
//   figure_3_10/pinned/N/…     a tick of the PodModel so trained: force alone, or force and shape
//   figure_3_11/pinned/N/…     a tick of a PodModel trained with N snapshots of 256 elements
//   …/half/…                   the same for the thesis' own case: half of the beam, roller and guided end, pressed at
//                              the guided end.  Its force is linear in d: every model has it to round-off
//
//   time_us          of a tick, or of a training [µs]: median over the rounds
//   force_error      largest of 500 random presses from 2 % of the depth up, relative to the closed form
//
// Everything is measured on first need, whatever the filter.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "support/press_errors.hpp"
#include "support/thesis_beam.hpp"
#include "support/tick_times.hpp"
#include "support/training.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;

namespace {

constexpr int rounds = 9;
constexpr int snapshots = 14;  // of figures 3.9 and 3.10
constexpr int element_counts[] = {4, 8, 16, 32, 64, 128, 256, 512, 1024};
constexpr int snapshot_counts[] = {4, 5, 6, 8, 10, 12, 14, 20, 28, 40, 64};

/// A beam, where it is pressed, and what that takes.
struct Setting {
  std::string name;
  Beam beam;
  double s;
  std::vector<Known> known;
};

Setting pinned() { return {"pinned", thesis_beam(), length / 2, at_mid_span()}; }

/// F = 3 EI d/s³ of a half beam without tension, s its length.
Setting half() {
  const Beam beam = thesis_beam(Support::roller, Support::guided, length / 2);
  const double s = beam.length();
  std::vector<Known> known = at_mid_span();
  for (auto& [press, force] : known) {
    press.s = s;
    force = 3 * beam.bending_stiffness() * press.d / (s * s * s);
  }
  return {"half", beam, s, known};
}

/// One point of one figure.
struct Entry {
  int figure;           // the thesis' is 3.figure
  std::string setting;  // pinned | half
  int n;                // elements, or snapshots in figure 3.11
  std::string what;     // of a trained model: force | shape

  std::string name() const {
    return "figure_3_" + std::to_string(figure) + "/" + setting + "/" + std::to_string(n) +
           (what.empty() ? "" : "/" + what);
  }
};

std::vector<Entry> entries() {
  std::vector<Entry> all;
  for (const char* setting : {"pinned", "half"}) {
    for (const int n : element_counts) all.push_back({8, setting, n, ""});
    for (const int n : element_counts) all.push_back({9, setting, n, ""});
    for (const char* what : {"force", "shape"}) {
      for (const int n : element_counts) all.push_back({10, setting, n, what});
      for (const int n : snapshot_counts) all.push_back({11, setting, n, what});
    }
  }
  return all;
}

class Figures {
 public:
  Figures() {
    const Setting settings[] = {pinned(), half()};
    for (const Entry& entry : entries()) {
      const Setting& setting = settings[entry.setting == "half"];
      if (entry.figure == 8) add_full(entry.name(), setting, entry.n);
      else if (entry.figure == 9) add_training(entry.name(), setting, entry.n);
      else if (entry.figure == 10) add_trained(entry.name(), setting, entry.n, snapshots, entry.what);
      else add_trained(entry.name(), setting, 256, entry.n, entry.what);
    }
    times_.run(rounds);
  }

  const ModelTimes& times(const std::string& name) const { return times_.of(name); }
  double error(const std::string& name) const { return errors_.at(name); }

 private:
  static std::vector<Press<double>> path(const Setting& setting) {
    std::vector<Press<double>> path = presses(press_path);
    for (Press<double>& press : path) press.s = setting.s;
    return path;
  }

  static PodModelData<double> train(const Setting& setting, int elements, int depths) {
    return time_pod_training(setting.beam, TrainingPlan::at(setting.s, depth, depths), elements).data;
  }

  void add_full(const std::string& name, const Setting& setting, int elements) {
    const FemModel<> model(setting.beam, elements);
    errors_[name] = force_errors(model, setting.known).max;
    times_.add(name, path(setting),
               [own = model](const Press<double>& press) mutable { return own.press(press); });
  }

  void add_training(const std::string& name, const Setting& setting, int elements) {
    errors_[name] = force_errors(PodModel<>(train(setting, elements, snapshots)), setting.known).max;
    times_.add(name, [setting, elements](std::vector<double>& ns) {
      const auto plan = TrainingPlan::at(setting.s, depth, snapshots);
      time_pod_training(setting.beam, plan, elements);  // caches
      const auto trained = time_pod_training(setting.beam, plan, elements);
      ns.push_back(1e6 * (trained.snapshots_ms + trained.pod_ms));
      return Status::ok;
    });
  }

  void add_trained(const std::string& name, const Setting& setting, int elements, int depths,
                   const std::string& what) {
    const PodModel<> model(train(setting, elements, depths));
    errors_[name] = force_errors(model, setting.known).max;
    if (what == "force")
      times_.add(name, path(setting), [own = model](const Press<double>& press) { return own.force(press); });
    else
      times_.add(name, path(setting),
                 [own = model](const Press<double>& press) mutable { return own.press(press); });
  }

  Rounds times_;
  std::map<std::string, double> errors_;
};

void report(benchmark::State& state, const Entry& entry) {
  static const Figures figures;
  const ModelTimes& times = figures.times(entry.name());
  for (auto _ : state) state.SetIterationTime(times.p50() * 1e-6);
  if (times.status != Status::ok) return state.SkipWithError(name(times.status));
  state.counters["n"] = entry.n;
  state.counters["time_us"] = times.p50();
  state.counters["force_error"] = figures.error(entry.name());
}

const bool registered = [] {
  for (const Entry& entry : entries())
    benchmark::RegisterBenchmark(entry.name().c_str(),
                                 [entry](benchmark::State& state) { report(state, entry); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
