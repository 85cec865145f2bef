// What a tick costs with one hand on a bed of many beams: touched ones, and those that are only there.
//
// Nylon bristles, 60 mm long and 2 mm thick, stand side by side, so close that a hand of 5 mm radius lies on about as many tips as
// the name says.  It strokes 1 mm to and fro at 5 Hz, 0.15 mm below the tips: bristles bend, slip off and are touched anew.
// With no contact it is between bristles, in a gap that is a little wider than the hand and its way.
//
//   MODEL/N/CONTACTS    N bristles in a row; fem: FemModel<> with 8 elements, pod: a PodModel of 16 × 12 presses
//                       whose shape has 8 pieces
//   single/MODEL/1      one Touch on one bristle, pressed all the time: what each contact costs at least
//   press/MODEL/N       a press of N copies of one model in turn, without contact
//
//   p50_us, p99_us      of a tick [µs]: median over the rounds, and over all ticks
//   touched             beams pressed in a tick, on average
//   per_contact_us      p50 over that [µs]
//   force_error         against one Touch a beam, for each that could be met: largest over the path, relative to the largest
//                       sum of their forces' sizes
//   bytes_a_beam        heap of the array over its beams
//   bytes_a_model       of one copy of the model
//
// HAPBEAM_QUICK=1 in the environment takes fewer rounds.  Everything is measured before the first line.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "support/heap.hpp"
#include "support/tick_times.hpp"
#include "support/training.hpp"
#include <hapbeam/beam.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/many/touch_many.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;

namespace {

constexpr double radius = 0.005, length = 0.06, overlap = 0.00015, contact_width = 0.0028;
constexpr int ticks = 400;

Beam bristle() { return {length, Section::circle(0.002), Material{3e9}, Support::clamped, Support::free}; }

TrainingPlan plan() {
  TrainingPlan plan = TrainingPlan::anywhere(bristle(), 0.005);
  plan.s_min = length / 2;
  plan.segments = 8;
  return plan;
}

/// One beam, and the hand on it alone.
template <class Model>
struct Alone {
  explicit Alone(const Model& given) : model(given), touch(model, radius) {}
  Alone(const Alone&) = delete;

  Model model;
  Touch<Model> touch;
};

/// N bristles, and the hand on them.
template <class Model>
struct Bed {
  Bed(const Model& model, int beams, int contacts)
      : pitch(contact_width / std::max(contacts, 1)),
        height(contacts > 0 ? length + bristle().thickness() / 2 + radius - overlap : length / 2),
        array(model, row(beams, pitch, contacts > 0 ? pitch : 2 * radius + 0.005), 512),
        touch(array, radius) {}
  Bed(const Bed&) = delete;

  /// @param gap  [m] in a third of its length
  static std::vector<BeamPlace> row(int beams, double pitch, double gap) {
    std::vector<BeamPlace> places;
    for (int i = 0; i < beams; ++i) {
      const double x = pitch * i;
      places.push_back({{i < beams / 3 ? x : x + gap - pitch, 0}, M_PI / 2, 0});
    }
    return places;
  }
  double place() const {
    const int third = array.size() / 3;
    return (array.frame(third - 1).origin.x() + array.frame(third).origin.x()) / 2;
  }
  std::vector<Press<double>> stroke() const {
    std::vector<Press<double>> path;
    for (int k = 0; k < ticks; ++k) path.push_back({place() + 0.001 * std::sin(2 * M_PI * k / 200), height});
    return path;
  }
  Response<double> operator()(const Press<double>& hand) noexcept {
    const auto felt = touch.tick({hand.s, hand.d});
    return {felt.force.norm(), felt.status};
  }

  double pitch, height;
  BeamArray<Model> array;
  Touch<BeamArray<Model>> touch;
};

using Counters = std::map<std::string, double>;

/// Along the path, against a loop over the beams that could be met.
template <class Model>
Counters check(Bed<Model>& bed, const std::vector<Press<double>>& path) {
  std::vector<std::pair<int, std::unique_ptr<Alone<Model>>>> near;
  for (int i = 0; i < bed.array.size(); ++i)
    if (std::abs(bed.array.frame(i).origin.x() - bed.place()) < length + 2 * radius)
      near.emplace_back(i, std::make_unique<Alone<Model>>(bed.array.kind(0).model));
  double worst = 0, largest = 0, touched = 0;
  for (const Press<double>& hand : path) {
    const auto felt = bed.touch.tick({hand.s, hand.d});
    touched += static_cast<double>(bed.touch.touches().size());
    Vector2<double> sum(0, 0);
    double size = 0;
    for (auto& [i, one] : near) {
      const auto& frame = bed.array.frame(i);
      const auto force = frame.turned(one->touch.tick(frame.local({hand.s, hand.d})).force);
      sum += force;
      size += force.norm();
    }
    worst = std::max(worst, (felt.force - sum).norm());
    largest = std::max(largest, size);
  }
  return {{"force_error", largest > 0 ? worst / largest : worst},
          {"touched", touched / static_cast<double>(path.size())},
          {"bytes_a_beam", static_cast<double>(bed.array.bytes()) / bed.array.size()}};
}

class Measured {
 public:
  Measured() {
    add_model("fem", FemModel<>(bristle(), 8));
    add_model("pod", PodModel<>(time_pod_training(bristle(), plan()).data));
    times_.run(std::getenv("HAPBEAM_QUICK") ? 5 : 15);
  }

  const std::vector<std::string>& names() const { return names_; }

  void report(benchmark::State& state, const std::string& name) const {
    const ModelTimes& own = times_.of(name);
    for (auto _ : state) state.SetIterationTime(own.p50() * 1e-6);
    state.counters["p50_us"] = own.p50();
    state.counters["p99_us"] = own.part(0.99);
    for (const auto& [counter, value] : counters_.at(name)) state.counters[counter] = value;
    const auto touched = counters_.at(name).find("touched");
    if (touched != counters_.at(name).end() && touched->second > 0)
      state.counters["per_contact_us"] = own.p50() / touched->second;
  }

 private:
  template <class Act>
  void add(const std::string& name, const std::vector<Press<double>>& path, Act act,
           const Counters& counters) {
    names_.push_back(name);
    counters_[name] = counters;
    times_.add(name, path, act);
  }

  template <class Model>
  void add_model(const std::string& label, const Model& model) {
    for (const int beams : {100, 1000, 10000, 100000})
      for (const int contacts : {0, 10, 100})
        if (contacts < beams) {
          const auto bed = std::make_shared<Bed<Model>>(model, beams, contacts);
          add(
              label + "/" + std::to_string(beams) + "/" + std::to_string(contacts), bed->stroke(),
              [bed](const Press<double>& hand) { return (*bed)(hand); }, check(*bed, bed->stroke()));
        }
    const double bytes = bytes_of([&] { return std::make_unique<Model>(model); });
    const auto one = std::make_shared<Alone<Model>>(model);
    std::vector<Press<double>> path;  // of a bristle that lies along x
    for (int k = 0; k < ticks; ++k)
      path.push_back(
          {0.9 * length + 0.001 * std::sin(2 * M_PI * k / 200), radius + model.thickness() / 2 - 0.003});
    const auto touch = [one](const Press<double>& hand) {
      const auto felt = one->touch.tick({hand.s, hand.d});
      return Response<double>{felt.force.norm(), felt.status};
    };
    add("single/" + label + "/1", path, touch, {{"touched", 1}, {"bytes_a_model", bytes}});
    for (const int n : {1, 1024}) {
      const auto models = std::make_shared<std::vector<Model>>(static_cast<std::size_t>(n), model);
      std::vector<Press<double>> presses;
      for (int k = 0; k < 4096; ++k)
        presses.push_back({length * (0.6 + 0.001 * ((37 * k) % 400)), 0.001 + 1e-6 * ((91 * k) % 4000)});
      const auto press = [models, k = std::size_t(0)](const Press<double>& next) mutable {
        return (*models)[k++ % models->size()].press(next);
      };
      add("press/" + label + "/" + std::to_string(n), presses, press, {{"bytes_a_model", bytes}});
    }
  }

  std::vector<std::string> names_;
  std::map<std::string, Counters> counters_;
  Rounds times_;
};

const bool registered = [] {
  static const Measured measured;
  for (const std::string& name : measured.names())
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&name](benchmark::State& state) { measured.report(state, name); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
