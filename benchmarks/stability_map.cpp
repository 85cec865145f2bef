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
//   stability_map friction          the default coupling on a ruler and a needle with friction: the hand leans down with 2 N, and half a second
//                                   later along the beam as well.  Counts for each coefficient: at_rest half a second after that and ever
//                                   after; slides_off: moves, and does with the same arm and coupling in a loop of 10 kHz, without delay and grid; slow:
//                                   moves in the sampled loop alone
//
// Nothing here is timed; the same numbers on every machine.  Chart: benchmarks/run.sh --stability.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "rod/rods.hpp"
#include "support/ruler.hpp"
#include "support/step_response.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
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

/// Leans down, and half a second later along the beam and, in space, aside as well.
struct LeaningAlong {
  Eigen::Vector3d down, along;  // [N]
  HandTarget operator()(double time) const noexcept {
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    return {zero, zero, (time < 0.3 ? zero : down) + (time < 0.8 ? zero : along)};
  }
};

struct AlongResponse {
  double speed = 0;         // [m/s] RMS, the largest over any 0.1 s from half a second after it leans along
  double least_energy = 0;  // [J] that hand, arm and motors have put into the loop
  double monitored = 0;     // [J]
  bool pressing = false;
};

template <class Model>
AlongResponse along_response(Model& model, double s, const CouplingFigures& figures, const Friction& friction,
                             const Situation& who, const Eigen::Vector3d& along) {
  constexpr double settled = 1.3, end = 3.3;  // [s]
  model.reset();
  VirtualPhantom<LeaningAlong> device({{0, -who.push, 0}, along}, who.options());
  ServoOptions options;
  options.avatar_radius = dimension_of<Model> == 2 ? 0.005 : 0.02;
  options.placement = above(model, s, who.from, options.avatar_radius);
  options.delay_ticks = who.delay, options.friction = friction;
  Servo<Model> servo(model, device.info(), options, VirtualCoupling(figures));
  struct Send {
    Servo<Model>& servo;
    Eigen::Vector3d sent;
    Eigen::Vector3d operator()(const DeviceState& state) noexcept { return sent = servo.tick(state); }
  } send{servo, Eigen::Vector3d::Zero()};
  std::array<Eigen::Vector3d, 17> held;  // newest first
  held.fill(Eigen::Vector3d::Zero());
  AlongResponse response;
  double energy = 0, squares = 0;
  long in_window = 0;
  const long window = std::lround(0.1 / who.period), first = std::lround(settled / who.period),
             ticks = std::lround(end / who.period);
  for (long k = 0; k < ticks; ++k) {
    const Eigen::Vector3d before = device.tip().position;
    device.step(send);
    std::move_backward(held.begin(), held.end() - 1, held.end());
    held[0] = send.sent;
    const Eigen::Vector3d moved = device.tip().position - before;
    energy += -held[static_cast<std::size_t>(who.delay)].dot(moved) +
              who.damping * moved.squaredNorm() / who.period + who.friction * moved.cwiseAbs().sum();
    response.least_energy = std::min(response.least_energy, energy);
    if (k < first) continue;
    squares += device.tip().velocity.squaredNorm();
    if (++in_window < window) continue;
    response.speed = std::max(response.speed, std::sqrt(squares / static_cast<double>(window)));
    squares = 0, in_window = 0;
  }
  response.monitored = servo.record().energy_generated;
  response.pressing = servo.record().pressing;
  return response;
}

template <class Model>
void lean_along(const char* name, Model model, double s) {
  for (const double ratio : {1.0, 0.7})
    for (const double mu : {0.1, 0.3, 0.6, 1.0})
      for (const bool spring : {true, false}) {
        long runs = 0, resting = 0, slides_off = 0, slow = 0, gives = 0;
        double fastest = 0;
        const Friction friction(mu, ratio * mu);
        for (const double along : {0.0, 0.5, 1.0})
          for (const double k : {0.0, 300.0, 1000.0})
            for (const double c : hand_dampings)
              for (const double grip : {0.05, 0.4})
                for (const double period : periods)
                  for (const int delay : delays)
                    for (const double resolution : {7e-6, 30e-6}) {
                      if ((k > 0) != spring) continue;
                      Situation who{k, c, grip, period, delay, resolution};
                      who.push = 2;
                      const bool space = dimension_of<Model> == 3;
                      const Eigen::Vector3d way(along, 0, space ? along / 5 : 0);
                      const CouplingFigures figures = default_figures(who);
                      const AlongResponse r = along_response(model, s, figures, friction, who, way);
                      ++runs;
                      gives += r.least_energy < -round_off || r.monitored > 0;
                      if (r.speed <= at_rest && r.pressing) {
                        ++resting;
                        fastest = std::max(fastest, r.speed);
                        continue;
                      }
                      who.period = 1e-4, who.delay = 0, who.resolution = 0;
                      const AlongResponse best = along_response(model, s, figures, friction, who, way);
                      ++(best.speed > at_rest || !best.pressing ? slides_off : slow);
                    }
        std::printf("%s,%g,%g,%s,%ld,%ld,%ld,%ld,%ld,%.3g\n", name, mu, ratio * mu,
                    spring ? "300 to 1000" : "0", runs, resting, slides_off, slow, gives, fastest * 1e3);
        std::fflush(stdout);
      }
}

void friction() {
  std::printf(
      "scene,sticking,sliding,hand_stiffness_N_per_m,combinations,at_rest,slides_off,slow,gives_energy,"
      "fastest_at_rest_mm_per_s\n");
  lean_along("ruler", FemModel<Corotational<>>(steel_ruler(), 8), 0.12);
  lean_along("needle",
             FemModel<RoundRod>(
                 Rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free), 8),
             0.16);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const double seconds = argc > 2 ? std::atof(argv[2]) : 60;
  if (what == "sweep" && argc <= 3 && seconds >= 1) sweep(seconds);
  else if (what == "border" && argc == 2) border();
  else if (what == "direct" && argc == 2) direct();
  else if (what == "friction" && argc == 2) friction();
  else
    return std::fputs(
               "stability_map: must be called with sweep [SECONDS, 1 or more], border, direct or friction\n",
               stderr),
           2;
  return 0;
}
