// How good is choose() of a rod?  Random scenes in space, and for each of them all sizes of rods by brute force.
//
//   chooser_rods [scenes [seed]] > chooser_rods.csv
//
// A row a scene: what was asked, what was chosen, its error on pushes that the choice has not seen, and the fewest elements of a
// rod that keep the tolerance on these pushes and are expected to be fast enough.  Every other scene is a hook, a ring, a helix or a bow out of its plane.
// Errors are against TwistedRod with 256 elements.  Times are of the processor, so that other work on the machine counts for little.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "../tests/support/random_rod_scene.hpp"
#include <hapbeam/scene/choose_rod.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

struct Measured {
  std::string text = "none";
  double error = 0;
};

Measured measure(const RodScene& scene, const Candidate& candidate, const std::vector<KnownPush>& pushes) {
  RodModel model = build(scene, candidate);
  std::string text = candidate.text();
  std::replace(text.begin(), text.end(), ',', ';');  // a comma ends a column
  return {text, worst_error(model, pushes)};
}

/// The cheapest rod that keeps the tolerance, by what it is expected to cost.
Measured cheapest(const RodScene& scene, const TickCosts& costs, const std::vector<KnownPush>& pushes) {
  Measured best;
  double least = scene.tick;
  for (const Kinematics kinematics : {Kinematics::round_rod, Kinematics::twisted_rod})
    for (const int n : {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192}) {
      const Candidate candidate{kinematics, Reduction::none, n};
      const double tick = candidate.tick(costs, true);
      if (tick > least) break;
      try {
        const Measured measured = measure(scene, candidate, pushes);
        if (measured.error > scene.force_error) continue;
        best = measured, least = tick;
        break;
      } catch (const std::invalid_argument&) {  // a rod that this kind does not model
        break;
      }
    }
  return best;
}

/// Nothing for a scene that is deeper than what a rod answers: it is rejected by name.
std::optional<Choice> try_choose(const RodScene& scene, const TickCosts& costs) {
  try {
    return choose(scene, costs);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "chooser_rods: a scene is left out: %s\n", error.what());
    return {};
  }
}

void print(int number, const char* shape, const RodScene& scene) {
  const Rod& rod = scene.rod;
  const double L = rod.length();
  std::printf("%d,%s,%s-%s,%.4g,%.3g,%.3g,%.3g,%.3f,%.3f,%.3g,%.3g,%.3g,", number, shape, name(rod.left()),
              name(rod.right()), L, rod.thickness() / L, rod.stiffness().bending1,
              rod.stiffness().bending2 / rod.stiffness().bending1, scene.s_min / L, scene.s_max / L,
              scene.depth / L, scene.force_error, 1e6 * scene.tick);
}

}  // namespace

int main(int argc, char** argv) {
  const int scenes = argc > 1 ? std::atoi(argv[1]) : 200;
  const std::uint64_t seed = argc > 2 ? static_cast<std::uint64_t>(std::atoll(argv[2])) : 1;
  const TickCosts costs = TickCosts::typical();
  std::puts(
      "scene,shape,ends,length_m,thickness_per_length,EI1_Nm2,EI2_per_EI1,s_min_per_length,s_max_per_length,"
      "depth_per_length,tolerance,budget_us,choose_ms,chosen,error,cheapest,cheapest_error");
  for (int k = 0; k < scenes; ++k) {
    Random random(1000 * seed + static_cast<std::uint64_t>(k));
    const bool curled = k % 2 != 0;
    const RodScene scene = curled ? random_curled_rod_scene(random) : random_rod_scene(random);
    const char* const shape = curled                     ? "curled"
                              : scene.rod.straight()     ? "straight"
                              : scene.rod.arcs().empty() ? "loaded"
                                                         : "bent";
    const std::clock_t begin = std::clock();
    const std::optional<Choice> choice = try_choose(scene, costs);
    const double choosing = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (!choice) continue;
    const std::vector<KnownPush> pushes = held_out<FemModel<TwistedRod>>(scene, random, 60, 256);
    if (pushes.empty()) continue;
    const Measured chosen = choice->candidate ? measure(scene, *choice->candidate, pushes) : Measured{};
    const Measured best = cheapest(scene, costs, pushes);
    print(k, shape, scene);
    std::printf("%.1f,%s,%.3g,%s,%.3g\n", 1e3 * choosing, chosen.text.c_str(), chosen.error,
                best.text.c_str(), best.error);
    std::fflush(stdout);
  }
}
