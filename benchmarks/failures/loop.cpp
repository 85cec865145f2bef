// The loop: explicit steps, couplings that are too stiff, delay, coarse encoders and missed ticks.
#include <cmath>
#include <vector>

#include "report.hpp"
#include "support/mass_spring.hpp"
#include "support/random.hpp"
#include "support/step_response.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam::benchmarks {

namespace {

using namespace hapbeam::testing;

constexpr double tenth = thesis_length / 10, middle = thesis_length / 2, at_rest = 1e-3;  // [m], [m], [m/s]

CouplingFigures default_figures(const Situation& who, int delay) {
  return safe_coupling(VirtualPhantom<Leaning>(Leaning{0}, who.options()).info(), delay);
}

template <class Coupling>
double speed(FemModel<>& model, double s, const Coupling& coupling, const Situation& who) {
  return step_response(model, s, coupling, who, 4, 3).speed;
}
std::string mm_per_s(double speed) { return speed <= at_rest ? "at rest" : number(1e3 * speed) + " mm/s"; }

void mass_spring(Report& report) {
  constexpr double mass = 7850 * inch * inch * thesis_length;
  const auto diverges = [&](int pieces, double dt) {
    MassSpringChain chain(pinned(), pieces, mass, 0);
    Random random(1);
    const std::size_t last = static_cast<std::size_t>(pieces);
    for (std::size_t i = 1; i < last; ++i) chain.position(i) += Vector2<double>(random(1e-6), random(1e-6));
    for (int k = 0; k < 3000; ++k) chain.step(dt, chain.middle(), 0);
    for (std::size_t i = 1; i < last; ++i)
      if (!(std::abs(chain.position(i).x() - thesis_length * static_cast<double>(i) / pieces) < 1e-3))
        return 1.0;
    return 0.0;
  };
  Series series = report.series("mass_spring", "masses,largest_step_us,critical_step_us");
  for (int pieces = 4; pieces <= 128; pieces *= 2) {
    const MassSpringChain chain(pinned(), pieces, mass, 0);
    const double largest =
        first_beyond([&](double dt) { return diverges(pieces, dt); }, 0.5, chain.critical_step(), 1e-3);
    series.add(pieces, 1e6 * largest, 1e6 * chain.critical_step());
    if (pieces != 16) continue;
    report.failure("masses-and-springs", "steps of " + number(1e6 * largest) + " µs with 16 masses, " +
                                             number(std::ceil(1e-3 / largest)) + " steps per tick");
    report.row("spring of a chain of 16 masses, over K_c (eq. 2.2) at 1 kHz",
               number(chain.spring() / (chain.mass() / (9.8696 * 1e-6))), "no time step");
    report.row("largest stable step; step by eq. 2.2, µs",
               number(1e6 * largest) + "; " + number(1e6 * chain.critical_step()), "no time step");
  }
}

/// Comes to rest with the lightest and the heaviest, the freest and the stiffest hand, as in stability_map.
bool stable(FemModel<>& model, const CouplingFigures& figures, Situation who) {
  for (const double k : {0.0, 1000.0})
    for (const double grip : {0.05, 0.4}) {
      who.hand_stiffness = k, who.hand_damping = 0, who.grip_mass = grip;
      const StepResponse r = step_response(model, tenth, VirtualCoupling(figures), who, 4, 3);
      if (r.speed > at_rest || r.least_energy < -1e-9) return false;
    }
  return true;
}

void stiffness_and_delay(Report& report) {
  FemModel<> model(pinned(), 16);
  const auto border = [&](int delay) {
    Situation who;
    who.delay = delay;
    const double damping = default_figures(who, delay).damping;
    return first_beyond(
        [&](double K) {
          return stable(model, {K, damping}, who) ? 0.0 : 1.0;
        },
        0.5, 100, 3e5);
  };
  Situation who;
  report.failure("too-stiff", number(border(0) / 1e3) + " kN/m; the passivity bound b/(T/2) is " +
                                  number(passive_stiffness(who.damping, who.period, 0) / 1e3) + " kN/m");
  report.row("speed of the arm, pressed at a tenth of the span, 163 kN/m: direct; coupled",
             mm_per_s(speed(model, tenth, Direct(), who)),
             mm_per_s(speed(model, tenth, VirtualCoupling(default_figures(who, 0)), who)) + ", through " +
                 number(default_figures(who, 0).stiffness / 1e3) + " kN/m");
  report.failure("delay", "at one tick, bar at mid-span, 21 kN/m");
  for (const int delay : {1, 2, 3}) {
    who.delay = delay;
    report.row(std::to_string(delay) + (delay == 1 ? " tick" : " ticks") +
                   " late: speed at mid-span, direct; largest stable coupling, default coupling",
               mm_per_s(speed(model, middle, Direct(), who)),
               number(border(delay)) + ", " + number(default_figures(who, delay).stiffness) + " N/m");
  }

  Series traces = report.series("traces", "time,direct,direct_late,coupled,coupled_late");
  std::vector<double> found[4], times;
  const auto trace = [&](std::size_t k, double s, const auto& coupling, int delay) {
    who.delay = delay;
    step_response(model, s, coupling, who, 1, 0.5, [&](double time, double y) {
      if (k == 0) times.push_back(time - Leaning::at);
      found[k].push_back(1e3 * y);
    });
  };
  const auto coupled = [&](int delay) { return VirtualCoupling(default_figures(who, delay)); };
  trace(0, tenth, Direct(), 0);
  trace(1, middle, Direct(), 2);
  trace(2, tenth, coupled(0), 0);
  trace(3, middle, coupled(2), 2);
  for (std::size_t k = 200; k < times.size() && k < 1000; k += 2)
    traces.add(times[k], found[0][k], found[1][k], found[2][k], found[3][k]);
}

void encoders(Report& report) {
  FemModel<> model(pinned(), 16);
  Situation who;
  const VirtualCoupling fine({passive_stiffness(who.damping, who.period, 0), 0});
  Series series = report.series("quantisation", "resolution_um,fine_mm_per_s,default_mm_per_s");
  const auto at = [&](double resolution, bool knows) {
    who.resolution = resolution;
    double worst = 0;
    for (const double push : {1.0, 3.0, 6.0}) {
      who.push = push;
      const VirtualCoupling coupling = knows ? VirtualCoupling(default_figures(who, 0)) : fine;
      worst = std::max(worst, speed(model, tenth, coupling, who));
    }
    return worst;
  };
  double begins = 0;
  for (double resolution = 5e-6; resolution < 1e-3; resolution *= std::pow(10, 0.1)) {
    const double coarse = at(resolution, false);
    if (begins == 0 && coarse > at_rest) begins = resolution;
    series.add(1e6 * resolution, 1e3 * coarse, 1e3 * at(resolution, true));
  }
  report.failure("coarse-encoders", "10 kN/m: steps of " + number(1e6 * begins) + " µm; the bound 2f/K is " +
                                        number(1e6 * 2 * who.friction / fine.figures().stiffness) + " µm");
  for (const double resolution : {7e-6, 200e-6, 400e-6}) {
    const double buzz = at(resolution, false), rest = at(resolution, true);
    report.row("steps of " + number(1e6 * resolution) + " µm: coupling of 10 kN/m; default coupling",
               mm_per_s(buzz), mm_per_s(rest) + ", " + number(default_figures(who, 0).stiffness) + " N/m");
  }
}

void missed_ticks(Report& report) {
  FemModel<> model(pinned(), 16);
  Situation who;
  who.of = 30;
  const auto at = [&](int missed, double s, const auto& coupling) {
    who.missed = missed;
    return speed(model, s, coupling, who);
  };
  const auto told = [&](int missed) { return VirtualCoupling(default_figures(who, std::min(missed, 16))); };
  Series series = report.series("missed", "missed,direct_mm_per_s,default_mm_per_s,told_mm_per_s");
  int direct_begins = 0, default_begins = 0;
  for (int missed = 0; missed <= 25; ++missed) {
    const double direct = at(missed, middle, Direct()), by_default = at(missed, tenth, told(0));
    if (direct_begins == 0 && direct > at_rest) direct_begins = missed;
    if (default_begins == 0 && by_default > at_rest) default_begins = missed;
    series.add(missed, 1e3 * direct, 1e3 * by_default, 1e3 * at(missed, tenth, told(missed)));
  }
  report.failure("missed-ticks", "at " + std::to_string(direct_begins) + " of 30 ticks in a row direct, at " +
                                     std::to_string(default_begins) + " with the default coupling");
  for (const int missed : {8, 20})
    report.row(
        std::to_string(missed) +
            " of 30 ticks missed: direct at mid-span; default coupling, coupling with the gap as delay",
        mm_per_s(at(missed, middle, Direct())),
        mm_per_s(at(missed, tenth, told(0))) + ", " + mm_per_s(at(missed, tenth, told(missed))));
}

}  // namespace

void loop(Report& report) {
  mass_spring(report);
  stiffness_and_delay(report);
  encoders(report);
  missed_ticks(report);
}

}  // namespace hapbeam::benchmarks
