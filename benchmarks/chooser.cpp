// How good is choose()?  Random scenes, and for each of them all candidates by brute force.
//
//   chooser [scenes [seed]] > chooser.csv
//
// A row a scene: what was asked, what was chosen, its error on presses that the choice has not seen, its time, and the
// cheapest candidate that is right on these presses.  Errors are against Corotational<> with 512 elements.  Times are those
// of a hand that presses and slides slowly, the least of five passes, so that other work on the machine counts for little.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "../tests/support/random_scene.hpp"
#include "support/measure_tick_costs.hpp"
#include <hapbeam/scene/choose.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Clock = std::chrono::steady_clock;
constexpr double infinity = std::numeric_limits<double>::infinity();

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Of a press [s].
double time_on(SceneModel& model, const Scene& scene) {
  constexpr int passes = 5, presses = 150;
  const double s = (scene.s_min + scene.s_max) / 2, way = 0.005 * (scene.s_max - scene.s_min);
  const double depth = std::min(scene.depth, 0.9 * model.range().depth_at(s));
  double least = infinity;
  volatile double sink = 0;
  model.visit([&](auto& chosen) {
    for (int pass = 0; pass < passes; ++pass) {
      chosen.reset();
      const auto begin = Clock::now();
      for (int k = 1; k <= presses; ++k) {
        const double part = static_cast<double>(k) / presses;
        const Press<double> press{s + way * part, depth * (0.4 + 0.6 * part)};
        sink = scene.shape ? chosen.press(press).force : detail::force_of(chosen, press).force;
      }
      least = std::min(least, seconds_since(begin) / presses);
    }
  });
  return least;
}

std::vector<Candidate> all_candidates(const Scene& scene) {
  std::vector<Candidate> all;
  for (const Kinematics kinematics : {Kinematics::linear, Kinematics::von_karman, Kinematics::corotational})
    for (const int n : {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512})
      all.push_back({kinematics, Reduction::none, n});
  for (const int depths : {2, 3, 4, 6, 8, 12, 16, 24, 32})
    for (const int positions : {1, 3, 4, 6, 8, 12, 16, 24, 32, 48}) {
      if (scene.one_place() != (positions == 1)) continue;
      all.push_back({Kinematics::corotational, Reduction::pod, 64, positions, depths});
      all.push_back({Kinematics::von_karman, Reduction::galerkin, 64, positions, depths});
    }
  return all;
}

struct Measured {
  std::string text = "none";
  double error = 0, tick = infinity;
};

Measured measure(const Scene& scene, const Candidate& candidate, const std::vector<KnownPress>& presses) {
  SceneModel model = build(scene, candidate);
  std::string text = candidate.text();
  std::replace(text.begin(), text.end(), ',', ';');  // a comma ends a column
  return {text, worst_error(model, presses), time_on(model, scene)};
}

/// The cheapest that is right and fast enough, of those that are expected to cost less than a limit.
Measured cheapest(const Scene& scene, const TickCosts& costs, double limit,
                  const std::vector<KnownPress>& presses) {
  Measured best;
  for (const Candidate& candidate : all_candidates(scene)) {
    if (candidate.tick(costs, scene.shape) > limit) continue;
    try {
      const Measured measured = measure(scene, candidate, presses);
      if (measured.error <= scene.force_error && measured.tick <= scene.tick && measured.tick < best.tick)
        best = measured;
    } catch (const std::exception&) {  // cannot be built, which is no candidate then
    }
  }
  return best;
}

void print(int number, const Scene& scene) {
  const Beam& beam = scene.beam;
  const double L = beam.length(), EI = beam.bending_stiffness();
  std::printf("%d,%s-%s,%.4g,%.3g,%.3g,%.3g,%.3f,%.3f,%.3g,%.3g,%.3g,%d,", number, name(beam.left()),
              name(beam.right()), L, beam.thickness() / L, EI,
              beam.right_place().u * beam.axial_stiffness() * L / EI, scene.s_min / L, scene.s_max / L,
              scene.depth / L, scene.force_error, 1e6 * scene.tick, scene.shape);
}

/// Nothing for a scene that is deeper than what a beam of large rotation answers: it is rejected by name.
std::optional<Choice> try_choose(const Scene& scene, const TickCosts& costs) {
  try {
    return choose(scene, costs);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "chooser: a scene is left out: %s\n", error.what());
    return {};
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int scenes = argc > 1 ? std::atoi(argv[1]) : 400;
  Random random(argc > 2 ? static_cast<std::uint64_t>(std::atoll(argv[2])) : 1);
  const TickCosts costs = benchmarks::measure_tick_costs();
  std::puts(
      "scene,ends,length_m,height_per_length,EI_Nm2,tension_L2_per_EI,s_min_per_length,s_max_per_length,"
      "depth_per_length,tolerance,budget_us,shape,choose_ms,chosen,error,tick_us,cheapest,cheapest_error,"
      "cheapest_tick_us");
  for (int k = 0; k < scenes; ++k) {
    const Scene scene = random_scene(random);
    const std::vector<KnownPress> presses = held_out(scene, random, 60, 512);
    const auto begin = Clock::now();
    const std::optional<Choice> made = try_choose(scene, costs);
    if (!made) continue;
    const Choice& choice = *made;
    const double choosing = seconds_since(begin);
    const Measured chosen = choice.candidate ? measure(scene, *choice.candidate, presses) : Measured{};
    // What is expected to cost half as much again will not turn out the cheaper one.
    const double limit = choice.candidate ? 1.5 * choice.candidate->tick(costs, scene.shape) : scene.tick;
    const Measured best = cheapest(scene, costs, limit, presses);
    print(k, scene);
    std::printf("%.1f,%s,%.3g,%.3g,%s,%.3g,%.3g\n", 1e3 * choosing, chosen.text.c_str(), chosen.error,
                1e6 * chosen.tick, best.text.c_str(), best.error, 1e6 * best.tick);
    std::fflush(stdout);
  }
}
