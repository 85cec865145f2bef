// What any rotation costs: a tick with elements that turn with the beam against one with moderate rotation.
//
//   press/MODEL/N     the beam of the thesis between hinges, its middle pressed 0 to 50 mm and back in 1000 ticks
//   touch/MODEL/N     the same beam, an avatar of 10 mm radius that presses it and slides along: contact, model and force
//   ruler/MODEL/N     a steel ruler, 300 x 25 x 1 mm, clamped at one end, bent down by an avatar and let up again
//
//   p50_us, p99_us    of a tick [µs]: median over the rounds, and over all ticks
//   ratio             p50 over that of von_karman with as many elements, in the same round: median over the rounds
//   force_error       largest over the path, relative to the largest force, against 256 elements of any rotation
//
// Everything is measured on first need, whatever the filter.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "support/thesis_beam.hpp"
#include "support/tick_times.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;

namespace {

constexpr int rounds = 9, ticks = 1000;
constexpr int element_counts[] = {8, 16, 64};
constexpr double radius = 0.01;

Beam ruler() {
  return {0.3, Section::rectangle(0.025, 0.001), Material{206.84e9}, Support::clamped, Support::free};
}

/// A scene is a beam and a path of requests: the middle's displacement, or the avatar's centre as (s, d) = (x, w).
struct Scene {
  std::string name;
  Beam beam;
  bool touches;
  std::vector<Press<double>> path;
};

std::vector<Scene> scenes() {
  std::vector<Scene> all{
      {"press", thesis_beam(), false, {}}, {"touch", thesis_beam(), true, {}}, {"ruler", ruler(), true, {}}};
  for (Scene& scene : all) {
    const double above = radius + scene.beam.thickness() / 2;
    for (int k = 0; k < ticks; ++k) {
      const double down = (1 - std::cos(2 * M_PI * k / ticks)) / 2;
      if (scene.name == "press") scene.path.push_back({length / 2, 0.05 * down});
      else if (scene.name == "touch")
        scene.path.push_back({length * (0.5 + 0.02 * std::sin(2 * M_PI * k / ticks)), above - 0.02 * down});
      else scene.path.push_back({0.2, above - 0.14 * down});
    }
  }
  return all;
}

/// Answers requests with forces, in contact or without.
template <class Element>
struct Answering {
  Answering(const Scene& scene, int elements)
      : model(scene.beam, elements), touch(model, radius), touches(scene.touches) {}
  Answering(const Answering&) = delete;

  Response<double> operator()(const Press<double>& request) noexcept {
    if (!touches) return model.press(request);
    const TouchResult<double> felt = touch.tick({request.s, request.d});
    return {felt.force.norm(), felt.status};
  }

  FemModel<Element> model;
  Touch<FemModel<Element>> touch;
  bool touches;
};

template <class Element>
std::vector<double> forces(const Scene& scene, int elements) {
  Answering<Element> answer(scene, elements);
  std::vector<double> all;
  for (const Press<double>& request : scene.path) all.push_back(answer(request).force);
  return all;
}

class Measured {
 public:
  Measured() {
    for (const Scene& scene : scenes()) {
      const std::vector<double> truth = forces<Corotational<>>(scene, 256);
      for (const int n : element_counts) {
        add<VonKarman<>>(scene, "von_karman", n, truth);
        add<Corotational<>>(scene, "corotational", n, truth);
        add<Corotational<Linear>>(scene, "corotational_linear", n, truth);
      }
    }
    times_.run(rounds);
  }

  void report(benchmark::State& state, const std::string& name, const std::string& against) const {
    const ModelTimes &own = times_.of(name), &other = times_.of(against);
    for (auto _ : state) state.SetIterationTime(own.p50() * 1e-6);
    std::vector<double> ratios;
    for (std::size_t k = 0; k < own.rounds.size(); ++k) ratios.push_back(own.rounds[k] / other.rounds[k]);
    state.counters["p50_us"] = own.p50();
    state.counters["p99_us"] = own.part(0.99);
    state.counters["ratio"] = median(ratios);
    state.counters["force_error"] = errors_.at(name);
  }

 private:
  template <class Element>
  void add(const Scene& scene, const std::string& model, int n, const std::vector<double>& truth) {
    const std::string name = scene.name + "/" + model + "/" + std::to_string(n);
    const std::vector<double> own = forces<Element>(scene, n);
    double largest = 0, error = 0;
    for (std::size_t k = 0; k < own.size(); ++k) {
      largest = std::max(largest, std::abs(truth[k]));
      error = std::max(error, std::abs(own[k] - truth[k]));
    }
    errors_[name] = error / largest;
    const auto answer = std::make_shared<Answering<Element>>(scene, n);
    times_.add(name, scene.path, [answer](const Press<double>& request) { return (*answer)(request); });
  }

  std::map<std::string, double> errors_;
  Rounds times_;
};

const Measured& measured() {
  static const Measured all;
  return all;
}

const bool registered = [] {
  for (const char* scene : {"press", "touch", "ruler"})
    for (const int n : element_counts)
      for (const char* model : {"von_karman", "corotational", "corotational_linear"}) {
        const std::string end = "/" + std::to_string(n), name = std::string(scene) + "/" + model + end,
                          against = std::string(scene) + "/von_karman" + end;
        benchmark::RegisterBenchmark(
            name.c_str(),
            [name, against](benchmark::State& state) { measured().report(state, name, against); })
            ->Iterations(1)
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
      }
  return true;
}();

}  // namespace
