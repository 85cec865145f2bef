// Where the loop is stable: the simulated Phantom and a hand that leans on a beam, in lock step.
//
//   stability_map sweep [SECONDS]   the default coupling on four beams, for every combination of push, hand, period, delay
//                                   and resolution; 60 s each unless told otherwise.  A line of CSV for each, its result:
//                                   at_rest half a second after the step and ever after; gives_energy; lost the beam;
//                                   slow: still moved by more than 1 mm/s RMS.  slow_as_the_arm_itself, slides_off: so it
//                                   was with the same arm in a loop of 10 kHz, without delay and grid
//   stability_map border            the largest stable stiffness of the coupling against the bound of Colgate and
//                                   Schenkel, for arms, periods and delays, for the worst of the hands
//   stability_map direct            without a coupling: the least damping of the arm with which it is stable
//
// Nothing here is timed; the same numbers on every machine.  Chart: benchmarks/run.sh --stability.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "../tests/support/step_response.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::benchmarks;
using namespace hapbeam::testing;

namespace {

constexpr int elements = 16;
constexpr double at_rest = 1e-3;    // [m/s]
constexpr double round_off = 1e-9;  // [J]
constexpr double hand_stiffnesses[] = {0, 250, 500, 1000}, hand_dampings[] = {0, 1, 2},
                 grips[] = {0.05, 0.2, 0.4};
constexpr double periods[] = {0.5e-3, 1e-3, 2e-3}, resolutions[] = {7e-6, 15e-6, 30e-6};
constexpr int delays[] = {0, 1, 2, 3};

struct Scene {
  const char* name;
  Beam beam;
  double s;     // [m]
  double push;  // [N] also a third of it, and twice
};

std::vector<Scene> scenes() {
  const Material steel{young};
  return {{"bar_tenth", thesis_beam(), length / 10, 3},
          {"bar_middle", thesis_beam(), length / 2, 3},
          {"strip_middle", Beam(0.5, Section::rectangle(0.02, 5e-4), steel, Support::pinned, Support::pinned),
           0.25, 3},
          {"ruler_tip", Beam(0.3, Section::rectangle(0.03, 1e-3), steel, Support::clamped, Support::free),
           0.29, 1}};
}

CouplingFigures default_figures(const Situation& who) {
  return safe_coupling(VirtualPhantom<Leaning>(Leaning{0}, who.options()).info(), who.delay);
}

/// The same arm, hand and spring on a loop of 10 kHz without delay and grid: what no servo can do better.
StepResponse unsampled(FemModel<>& model, double s, const CouplingFigures& figures, Situation who,
                       double seconds) {
  who.period = 1e-4, who.delay = 0, who.resolution = 0;
  return step_response(model, s, VirtualCoupling(figures), who, seconds);
}

void sweep(double seconds) {
  std::printf(
      "scene,push_N,hand_stiffness_N_per_m,hand_damping_Ns_per_m,grip_mass_kg,period_ms,delay_ticks,"
      "resolution_um,"
      "stiffness_N_per_m,damping_Ns_per_m,speed_mm_per_s,amplitude_mm,least_energy_J,monitored_energy_J,"
      "unsampled_speed_mm_per_s,result\n");
  for (const Scene& scene : scenes()) {
    FemModel<> model(scene.beam, elements);
    for (const double push : {scene.push / 3, scene.push, scene.push * 2})
      for (const double k : hand_stiffnesses)
        for (const double c : hand_dampings)
          for (const double grip : grips)
            for (const double period : periods)
              for (const int delay : delays)
                for (const double resolution : resolutions) {
                  Situation who{k, c, grip, period, delay, resolution};
                  who.push = push;
                  const CouplingFigures figures = default_figures(who);
                  const StepResponse r =
                      step_response(model, scene.s, VirtualCoupling(figures), who, seconds);
                  const bool moves = r.speed > at_rest, gives = r.least_energy < -round_off;
                  const bool lost = !(r.force > 0);
                  const StepResponse best =
                      moves || lost ? unsampled(model, scene.s, figures, who, lost ? seconds : 1.5)
                                    : StepResponse();
                  const char* result = gives                  ? "gives_energy"
                                       : lost                 ? (best.force > 0 ? "lost" : "slides_off")
                                       : !moves               ? "at_rest"
                                       : best.speed > at_rest ? "slow_as_the_arm_itself"
                                                              : "slow";
                  std::printf("%s,%.3g,%g,%g,%g,%g,%d,%g,%.1f,%.3f,%.4g,%.4g,%.3g,%.3g,%.4g,%s\n", scene.name,
                              push, k, c, grip, period * 1e3, delay, resolution * 1e6, figures.stiffness,
                              figures.damping, r.speed * 1e3, r.amplitude * 1e3, r.least_energy, r.generated,
                              best.speed * 1e3, result);
                }
    std::fflush(stdout);
  }
}

/// Comes to rest, however slowly, and gives out nothing, with the lightest and the heaviest, the freest and the stiffest hand.
bool stable(FemModel<>& model, double s, const CouplingFigures& figures, Situation who) {
  for (const double k : {0.0, 1000.0})
    for (const double grip : {0.05, 0.4}) {
      who.hand_stiffness = k, who.hand_damping = 0, who.grip_mass = grip;
      const StepResponse r = step_response(model, s, VirtualCoupling(figures), who, 4, 3);
      if (r.speed > at_rest || r.least_energy < -round_off) return false;
    }
  return true;
}

void border() {
  std::printf(
      "arm_damping_Ns_per_m,period_ms,delay_ticks,bound_N_per_m,largest_stiffness_N_per_m,default_N_per_m\n");
  FemModel<> model(thesis_beam(), elements);
  for (const double damping : {1.0, 2.0, 5.0, 10.0, 20.0})
    for (const double period : periods)
      for (const int delay : delays) {
        Situation who;
        who.damping = damping, who.period = period, who.delay = delay;
        const double bound = passive_stiffness(damping, period, delay);
        // The damper of the default; the spring alone is varied.
        const CouplingFigures figures = default_figures(who);
        double low = bound / 16, high = bound * 16;
        for (int i = 0; i < 9; ++i) {
          const double K = std::sqrt(low * high);
          (stable(model, length / 10, {K, figures.damping}, who) ? low : high) = K;
        }
        std::printf("%g,%g,%d,%.1f,%.1f,%.1f\n", damping, period * 1e3, delay, bound, low, figures.stiffness);
        std::fflush(stdout);
      }
}

void direct() {
  std::printf("place,push_N,period_ms,delay_ticks,least_damping_Ns_per_m\n");
  FemModel<> model(thesis_beam(), elements);
  for (const double push : {1.0, 3.0, 6.0})
    for (const double period : periods)
      for (const int delay : delays) {
        double low = 0.1, high = 1000;
        for (int i = 0; i < 12; ++i) {
          Situation who;
          who.push = push, who.period = period, who.delay = delay, who.damping = std::sqrt(low * high);
          const StepResponse r = step_response(model, length / 2, Direct(), who, 4, 3);
          (r.speed > at_rest ? low : high) = who.damping;
        }
        std::printf("middle,%g,%g,%d,%.3g\n", push, period * 1e3, delay, high);
        std::fflush(stdout);
      }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 60;
  if (what == "sweep" && argc <= 3 && seconds >= 1) sweep(seconds);
  else if (what == "border" && argc == 2) border();
  else if (what == "direct" && argc == 2) direct();
  else
    return std::fputs("stability_map: must be called with sweep [SECONDS, 1 or more], border or direct\n",
                      stderr),
           2;
  return 0;
}
