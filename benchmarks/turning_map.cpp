// Where the loop is stable that turns a hand: the simulated Phantom with a gimbal, in lock step, and a hand that leans, twists about
// all axes and is led to another pose from one moment to the next.  It touches a rod by the tip of a stylus or by its shaft, or holds its end.
//
//   turning_map [ROD...]   wire, needle, bar, hook or all; by tip, shaft and grip, for every combination of hand, gimbal, period and
//                          delay at the corners of the region that docs/haptics.md states, and for K_r and B_r of the coupling at
//                          1 to 8 times what the device can render.  A line of CSV for each, its result:
//                          at_rest half a second after the step and ever after; slower; slower_as_alone: so it was with the same hand
//                          that touches nothing; moves: still, after four seconds; slips_off the rod; gives_energy
//
// Nothing here is timed; the same numbers on every machine.  Table: benchmarks/run.sh --stability.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "support/turning_scenes.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double duration = 4;                                     // [s]
constexpr double slow = 1e-3, slow_turn = 0.03, round_off = 1e-9;  // [m/s], [rad/s], [J]
constexpr TurningFactors factors[] = {{1, 1}, {2, 2}, {4, 4}, {8, 8}, {8, 0}};

constexpr double hand_stiffnesses[] = {300, 1000}, hand_dampings[] = {0, 2}, grips[] = {0.05, 0.4};
constexpr double gimbal_dampings[] = {4.5e-4, 5e-3}, gimbal_frictions[] = {0, 5e-4, 5e-3},
                 gimbal_resolutions[] = {3e-5, 2e-4};
constexpr double periods[] = {0.5e-3, 2e-3};
constexpr int delays[] = {0, 3};

template <typename F>
void each_situation(F&& f) {
  for (const double k : hand_stiffnesses)
    for (const double c : hand_dampings)
      for (const double grip : grips)
        for (const double damping : gimbal_dampings)
          for (const double friction : gimbal_frictions)
            for (const double resolution : gimbal_resolutions)
              for (const double period : periods)
                for (const int delay : delays)
                  f(TurningSituation{k, c, grip, damping, friction, resolution, period, delay});
}

const char* name(TouchedBy by) {
  return by == TouchedBy::tip ? "tip" : by == TouchedBy::shaft ? "shaft" : "grip";
}

bool rests(double speed, double rate) { return speed <= slow && rate <= slow_turn; }

const char* result(const TurningResponse& r, const TurningSituation& who) {
  if (r.least_energy < -round_off) return "gives_energy";
  if (!r.record.pressing) return "slips_off";
  if (rests(r.speed, r.rate)) return "at_rest";
  if (rests(r.last_speed, r.last_rate)) return "slower";
  const TurningResponse alone = turning_response_alone(who, duration);
  return rests(r.last_speed - 1.1 * alone.last_speed, r.last_rate - 1.1 * alone.last_rate) ? "slower_as_alone"
                                                                                           : "moves";
}

void map(const TurningScene& scene) {
  for (const TouchedBy by : {TouchedBy::tip, TouchedBy::shaft, TouchedBy::grip})
    for (const TurningFactors& factor : factors)
      each_situation([&](const TurningSituation& who) {
        const TurningResponse r = turning_response(scene, by, who, factor, duration);
        const CouplingFigures turning = factor.of(who.device(), who.delay);
        std::printf("%s,%s,%g,%g,%g,%g,%g,%g,%g,%g,%g,%d,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%.2g,%.2g,%s\n",
                    scene.name, name(by), factor.stiffness, factor.damping, who.hand_stiffness,
                    who.hand_damping, who.grip_mass, who.gimbal_damping * 1e3, who.gimbal_friction * 1e3,
                    who.gimbal_resolution * 1e6, who.period * 1e3, who.delay, turning.stiffness,
                    turning.damping * 1e3, r.speed * 1e3, r.rate, r.last_speed * 1e3, r.last_rate,
                    r.max_torque * 1e3, r.least_energy, r.generated, result(r, who));
      });
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<TurningScene> chosen;
  for (const TurningScene& scene : turning_scenes)
    if (argc == 1 || std::count(argv + 1, argv + argc, std::string(scene.name)) > 0) chosen.push_back(scene);
  if (argc > 1 && static_cast<int>(chosen.size()) != argc - 1)
    return std::fputs("turning_map: must be called with wire, needle, bar, hook, or nothing\n", stderr), 2;
  std::printf(
      "rod,touched_by,stiffness_factor,damping_factor,hand_stiffness_N_per_m,hand_damping_Ns_per_m,grip_mass_"
      "kg,"
      "gimbal_damping_mNms,gimbal_friction_mNm,gimbal_resolution_urad,period_ms,delay_ticks,stiffness_Nm,"
      "damping_mNms,speed_mm_per_s,rate_rad_per_s,last_speed_mm_per_s,last_rate_rad_per_s,torque_mNm,"
      "least_energy_J,monitored_energy_J,result\n");
  for (const TurningScene& scene : chosen) map(scene);
  return 0;
}
