// What space costs: a tick of a rod beside one of the planar beam of finite rotation, with contact.
//
//   touch/MODEL/N   a steel wire, 300 mm long and 1.5 mm thick, clamped at both ends; a sphere of 30 mm presses its middle 1 to 5 mm deep and
//                   back, 10 µm a tick.  All models bend in the same plane and have N elements
//
//   p50_us, p99_us   of a tick [µs]: median over the rounds, and over all ticks
//   ratio            p50 over that of planar with as many elements, in the same round: median over the rounds
//   solves           linear solves of a tick, mean
//   force_error      largest over the path, relative to the largest force, against 512 planar elements
//
// Everything is measured on first need, whatever the filter.  HAPBEAM_QUICK=1 in the environment takes fewer rounds and sizes.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "support/tick_times.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;

namespace {

const bool quick = std::getenv("HAPBEAM_QUICK");
constexpr double length = 0.3, diameter = 0.0015, radius = 0.03, step = 1e-5;
constexpr int shallow = 100, deep = 500;  // steps

const std::vector<int>& element_counts() {
  static const std::vector<int> all =
      quick ? std::vector<int>{8, 16, 64} : std::vector<int>{8, 16, 64, 256, 1024};
  return all;
}

/// Depths in steps, down and up.  Many elements go a part of the way.
std::vector<int> path(int elements) {
  const int to = elements > 64 ? shallow + 100 : deep;
  std::vector<int> depths;
  for (int k = shallow; k < to; ++k) depths.push_back(k);
  for (int k = to; k > shallow; --k) depths.push_back(k);
  return depths;
}

template <class Element>
auto wire() {
  if constexpr (dimension_of<Element> == 2)
    return Beam(length, Section::circle(diameter), Material{200e9}, Support::clamped, Support::clamped);
  else
    return Rod(length, RodSection::circle(diameter), RodMaterial{200e9, 77e9}, RodSupport::clamped,
               RodSupport::clamped);
}

/// A wire and the sphere that presses it.
template <class Element>
struct Pressed {
  using Model = FemModel<Element>;
  using Vector = typename Touch<Model>::Vector;

  explicit Pressed(int elements) : model(wire<Element>(), elements), touch(model, radius) {
    for (int depth = 0; depth < shallow; ++depth) (*this)(depth);
  }
  Pressed(const Pressed&) = delete;

  Response<double> operator()(int depth) noexcept {
    Vector centre = Vector::Zero();
    centre[0] = length / 2;
    centre[1] = radius + diameter / 2 - depth * step;
    const auto felt = touch.tick(centre);
    return {felt.force[1], felt.status};
  }

  Model model;
  Touch<Model> touch;
};

class Measured {
 public:
  Measured() {
    for (const int n : element_counts()) {
      const std::vector<double> truth = forces<Corotational<>>(512, path(n));
      add<Corotational<>>("planar", n, truth);
      add<RoundRod>("round_rod", n, truth);
      add<TwistedRod>("twisted_rod", n, truth);
    }
    times_.run(quick ? 5 : 25);
  }

  void report(benchmark::State& state, const std::string& name, const std::string& against) const {
    const ModelTimes& own = times_.of(name);
    for (auto _ : state) state.SetIterationTime(own.p50() * 1e-6);
    if (own.status != Status::ok) state.SkipWithError(hapbeam::name(own.status));
    state.counters["p50_us"] = own.p50();
    state.counters["p99_us"] = own.part(0.99);
    state.counters["ratio"] = times_.ratio(name, against);
    state.counters["solves"] = solves_.at(name);
    state.counters["force_error"] = errors_.at(name);
  }

 private:
  template <class Element>
  static std::vector<double> forces(int elements, const std::vector<int>& depths, double* solves = nullptr) {
    Pressed<Element> pressed(elements);
    std::vector<double> all;
    for (const int depth : depths) {
      all.push_back(pressed(depth).force);
      if (solves)
        *solves += static_cast<double>(pressed.model.report().solves) / static_cast<double>(depths.size());
    }
    return all;
  }

  template <class Element>
  void add(const std::string& model, int n, const std::vector<double>& truth) {
    const std::string name = "touch/" + model + "/" + std::to_string(n);
    const std::vector<int> depths = path(n);
    const std::vector<double> own = forces<Element>(n, depths, &solves_[name]);
    double largest = 0, error = 0;
    for (std::size_t k = 0; k < own.size(); ++k) {
      largest = std::max(largest, std::abs(truth[k]));
      error = std::max(error, std::abs(own[k] - truth[k]));
    }
    errors_[name] = error / largest;
    const auto pressed = std::make_shared<Pressed<Element>>(n);
    times_.add(name, [depths, pressed](std::vector<double>& ns) {
      Response<double> response{};
      Status status = Status::ok;
      for (const int depth : depths) {
        ns.push_back(time_tick(depth, *pressed, response));
        if (response.status != Status::ok && status == Status::ok) status = response.status;
      }
      return status;
    });
  }

  std::map<std::string, double> errors_, solves_;
  Rounds times_;
};

const Measured& measured() {
  static const Measured all;
  return all;
}

const bool registered = [] {
  for (const int n : element_counts())
    for (const char* model : {"planar", "round_rod", "twisted_rod"}) {
      const std::string end = "/" + std::to_string(n), name = std::string("touch/") + model + end,
                        against = "touch/planar" + end;
      benchmark::RegisterBenchmark(
          name.c_str(), [name, against](benchmark::State& state) { measured().report(state, name, against); })
          ->Iterations(1)
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond);
    }
  return true;
}();

}  // namespace
