// Speed against accuracy: a servo's tick from the avatar's position to the force on the hand, for every method.
//
//   SCENE/MODEL/ELEMENTS/MODES/SNAPSHOTS     scenes: support/touch_scenes.hpp; 0 where a method has none
//
//   tick_ns_p50, _p99     of a tick [ns], contact included: median over the rounds, and over all ticks of a hand's path
//   force_error_max, _median   |F - truth| / |truth|, vectors, at stops that no method was trained with
//   outside_error_max     the same deeper than the scene, up to 1.6 times
//   bytes                 what the method holds for one beam
//
// All methods are compiled alike, each in a file of its own, start each tick from the one before, and share contact detection, but for the chains of masses,
// which have their own, and MuJoCo, which is measured where libmujoco-dev is installed.  What differs from FemModel in its linear solver
// alone is called Newton + solver.
// HAPBEAM_QUICK=1 in the environment takes fewer stops and rounds.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "support/assembled_by.hpp"
#include "support/closed_form_model.hpp"
#include "support/contender.hpp"
#include "support/crisfield.hpp"
#include "support/dense_assembler.hpp"
#include "support/heap.hpp"
#include "support/mass_spring.hpp"
#include "support/sparse_assemblers.hpp"
#include "support/tick_times.hpp"
#ifdef HAPBEAM_BENCHMARKS_MUJOCO
#include "support/mujoco_chain.hpp"
#endif
#include "support/touch_scenes.hpp"
#include "support/training.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;

namespace {

const bool quick = std::getenv("HAPBEAM_QUICK") != nullptr;
const int rounds = quick ? 3 : 9, stops = quick ? 16 : 64;
constexpr double slow_us = 100;  // a tick; what is slower is measured in fewer rounds

struct Size {
  int elements = 0, modes = 0, snapshots = 0;
};

struct Entry {
  std::string name;
  std::map<std::string, double> counters;
};

class Contest {
 public:
  Contest() {
    for (const TouchScene& scene : touch_scenes(stops)) {
      const bool turns = scene.name == "ruler" || scene.name == "arch", straight = scene.beam.straight();
      const std::vector<int> sizes = quick ? std::vector<int>{4, 8, 16, 64}
                                           : std::vector<int>{4, 8, 16, 32, 64, 128},
                             few = quick ? std::vector<int>{8, 16} : std::vector<int>{8, 16, 32, 64};
      if (straight) {
        fem<FemModel<Linear>>(scene, "Linear", sizes);
        fem<FemModel<VonKarman<FullIntegration>>>(scene, "VonKarman<FullIntegration>", sizes);
        fem<FemModel<VonKarman<ReducedIntegration>>>(scene, "VonKarman<ReducedIntegration>", sizes);
        fem<FemModel<>>(scene, "VonKarman<StabilityFunctions>", sizes);
        fem<FemModel<VonKarman<AssumedStrain>>>(scene, "VonKarman<AssumedStrain>", sizes);
      }
      fem<FemModel<Corotational<Linear>>>(scene, "Corotational<Linear>", sizes);
      fem<FemModel<Corotational<>>>(scene, "Corotational<VonKarman<StabilityFunctions>>", sizes);
      if (turns) solvers<Corotational<>>(scene, few);
      else solvers<VonKarman<>>(scene, few);
      for (const int n : few) {
        const auto make = [&scene, n] {
          return contender<MassSpring<2>>(scene.beam, n, avatar_radius, scene.mass_per_length, scene.lowest);
        };
        // A tick is of order n²: more masses are asked at fewer stops.
        add(scene, "mass-spring", {n, 0, 0}, make, static_cast<std::size_t>(n / 8));
      }
      if (turns) continue;
      trained(scene);
      add(scene, "closed form", {}, [&scene] { return contender<ClosedFormModel>(scene.beam); });
    }
    for (const TouchSceneIn<3>& scene : touch_scenes_in_space(stops)) {
      const std::vector<int> sizes = quick ? std::vector<int>{4, 8, 16} : std::vector<int>{4, 8, 16, 32, 64};
      if (scene.beam.arcs().empty()) fem<FemModel<RoundRod>>(scene, "RoundRod", sizes);
      fem<FemModel<TwistedRod>>(scene, "TwistedRod", sizes);
      fem<FemModel<CrisfieldRod>>(scene, "CrisfieldRod", sizes);
      const std::vector<int> few = quick ? std::vector<int>{8, 16} : std::vector<int>{8, 16, 32, 64};
      if (scene.beam.arcs().empty())
        for (const int n : few)
          add(
              scene, "mass-spring", {n, 0, 0},
              [&scene, n] {
                return contender<MassSpring<3>>(scene.beam, n, radius_in<3>, scene.mass_per_length,
                                                scene.lowest);
              },
              static_cast<std::size_t>(n / 8));
#ifdef HAPBEAM_BENCHMARKS_MUJOCO
      for (const int n : few)
        add(
            scene, "MuJoCo", {n, 0, 0},
            [&scene, n] {
              return contender<MujocoChain>(scene.beam, n, radius_in<3>, scene.mass_per_length);
            },
            static_cast<std::size_t>(n / 8));
#endif
    }
    times_.run(rounds);
  }

  const std::vector<Entry>& entries() const { return entries_; }
  const ModelTimes& times(const std::string& name) const { return times_.of(name); }

 private:
  template <class Model, class Scene>
  void fem(const Scene& scene, const std::string& model, const std::vector<int>& sizes) {
    for (const int n : sizes)
      add(scene, model, {n, 0, 0}, [&scene, n] { return contender<Model>(scene.beam, n); });
  }

  template <class Element>
  void solvers(const TouchScene& scene, const std::vector<int>& sizes) {
    fem<Solved<Element, SimplicialLdltNatural>>(scene, "Newton + SimplicialLDLT", sizes);
    // It cannot tell an arch that gives way.
    if (scene.beam.straight()) fem<Solved<Element, SparseLuFromTriplets>>(scene, "Newton + SparseLU", sizes);
    // Of order n³: 64 elements take milliseconds.
    fem<Solved<Element, DenseLdlt>>(scene, "Newton + dense LDLT",
                                    {sizes.begin(), std::min(sizes.begin() + 3, sizes.end())});
  }

  void trained(const TouchScene& scene) {
    struct Grid {
      int positions, depths, modes;  // 0: as many modes as the default truncation keeps
    };
    constexpr Grid grids[] = {{6, 6, 0},   {8, 8, 0},   {12, 8, 0},  {12, 12, 0}, {16, 12, 0},
                              {24, 16, 0}, {32, 24, 0}, {16, 12, 2}, {16, 12, 4}, {16, 12, 8}};
    for (const Grid& grid : grids) {
      const TrainingPlan plan = TrainingPlan::anywhere(scene.beam, scene.depth, grid.positions, grid.depths);
      pod<ChebyshevNodes>(scene, "PodModel<ChebyshevNodes>", plan, grid.modes);
      if (grid.modes == 0) {
        pod<EquispacedNodes>(scene, "PodModel<EquispacedNodes>", plan, 0);
        attempt(scene, "GalerkinModel", plan, [&] {
          const auto data = time_galerkin_training(scene.beam, plan).data;
          add(scene, "GalerkinModel", {0, data.shape.modes, data.positions * data.tensions},
              [data] { return contender<GalerkinModel<>>(data); });
        });
      }
    }
  }

  template <class Nodes>
  void pod(const TouchScene& scene, const std::string& model, const TrainingPlan& plan, int modes) {
    attempt(scene, model, plan, [&] {
      const auto data = time_pod_training<Nodes>(scene.beam, plan, 256, false, modes).data;
      add(scene, model, {0, data.shape.modes, data.positions * data.depths},
          [data] { return contender<PodModel<double, Nodes>>(data); });
    });
  }

  /// Training refuses too few snapshots: no model, no point.
  template <class Train>
  static void attempt(const TouchScene& scene, const std::string& model, const TrainingPlan& plan,
                      const Train& train) {
    try {
      train();
    } catch (const std::exception& refusal) {
      std::fprintf(stderr, "%s, %s of %d x %d: %s\n", scene.name.c_str(), model.c_str(), plan.positions,
                   plan.depths, refusal.what());
    }
  }

  /// @param make  () -> std::unique_ptr<Contender<D>>   @param every  so many stops one is asked
  template <int D, class Make>
  void add(const TouchSceneIn<D>& scene, const std::string& model, const Size& size, const Make& make,
           std::size_t every = 1) {
    const std::string name = scene.name + "/" + model + "/" + std::to_string(size.elements) + "/" +
                             std::to_string(size.modes) + "/" + std::to_string(size.snapshots);
    using Position = VectorOf<double, D>;
    const std::shared_ptr<Contender<D>> own = make();
    const auto errors = [&own, every](const std::vector<StopIn<D>>& known) {
      std::vector<double> all;
      for (std::size_t k = 0; k < known.size(); k += every) {
        const StopIn<D>& stop = known[k];
        own->reset();
        const auto felt = come_down([&own](const Position& position) { return own->tick(position); }, stop);
        all.push_back((felt.force - stop.force).norm() / stop.force.norm());
      }
      return all;
    };
    std::vector<double> inside = errors(scene.stops), outside = errors(scene.outside);
    entries_.push_back({name,
                        {{"elements", size.elements},
                         {"modes", size.modes},
                         {"snapshots", size.snapshots},
                         {"force_error_max", quantile(inside, 1)},
                         {"force_error_median", quantile(inside, 0.5)},
                         {"outside_error_max", quantile(outside, 1)},
                         {"bytes", bytes_of(make)}}});
    times_.add(name, [own, path = scene.path, away = scene.away, round = 0,
                      slow = false](std::vector<double>& ns) mutable {
      if (slow && ++round > 2) return Status::ok;
      TouchResult<double, D> felt;
      auto act = [&own](const Position& position) { return own->tick(position); };
      // Onto the beam; caches, and the branches that a processor learns.
      own->reset();
      const std::size_t first = path.size() - path.size() / 20;
      come_down(act, StopIn<D>{path[first], away, {}});
      for (std::size_t k = first; k < path.size(); ++k) time_tick(path[k], act, felt);
      for (const Position& position : path) ns.push_back(time_tick(position, act, felt));
      slow = middle(ns) > 1e3 * slow_us;
      return Status::ok;
    });
  }

  std::vector<Entry> entries_;
  Rounds times_;
};

// Names and sizes are known when the models have been trained: all is measured before the first line is printed.
const bool registered = [] {
  static const Contest contest;
  for (const Entry& entry : contest.entries())
    benchmark::RegisterBenchmark(entry.name.c_str(),
                                 [&entry](benchmark::State& state) {
                                   const ModelTimes& times = contest.times(entry.name);
                                   for (auto _ : state) state.SetIterationTime(times.p50() * 1e-6);
                                   for (const auto& [counter, value] : entry.counters)
                                     state.counters[counter] = value;
                                   state.counters["tick_ns_p50"] = 1e3 * times.p50();
                                   state.counters["tick_ns_p99"] = 1e3 * times.part(0.99);
                                 })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
