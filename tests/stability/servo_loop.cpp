// Where the loop is stable: a hand leans on a beam, simulated in lock step; benchmarks/stability_map.cpp has the whole map.
#include <cmath>
#include <vector>

#include "once_training.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/step_response.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/known_devices.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double at_rest = 1e-3;    // [m/s]
constexpr double round_off = 1e-9;  // [J]
constexpr double tenth = thesis_length / 10, middle = thesis_length / 2;

CouplingFigures default_figures(const Situation& who) {
  return safe_coupling(VirtualPhantom<Leaning>(Leaning{0}, who.options()).info(), who.delay);
}

/// Any of the hands, loops and encoders of the map.
Situation any(Random& random) {
  Situation who;
  who.hand_stiffness = random(0, 1) < 0.2 ? 0 : random(0, 1000);
  who.hand_damping = random(0, 1) < 0.2 ? 0 : random(0, 2);
  who.grip_mass = random(0.05, 0.4);
  who.period = random(0.5e-3, 2e-3);
  who.delay = random.integer(0, 3);
  who.resolution = random(7e-6, 30e-6);
  return who;
}

/// @param roughest  coefficient of friction on the beam
template <typename Model>
void check_at_rest(Model& model, double s, double push, int situations, unsigned seed, double roughest = 0) {
  Random random(seed);
  for (int i = 0; i < situations; ++i) {
    Situation who = any(random);
    who.push = push;
    if (roughest > 0) who.rough = random(0.1, roughest);
    const StepResponse r = step_response(model, s, VirtualCoupling(default_figures(who)), who, 10);
    CAPTURE(who.rough, who.hand_stiffness, who.hand_damping, who.grip_mass, who.period, who.delay,
            who.resolution);
    CHECK(r.speed <= at_rest);
    CHECK(r.least_energy >= -round_off);
    CHECK(r.generated == 0);
    // It is the beam that holds the hand: push, hand's spring and force balance to what friction takes.
    CHECK(std::abs(r.force - push - who.hand_stiffness * r.position) <= who.friction * (1 + 1e-9));
    CHECK(r.force > 0);
  }
}

}  // namespace

// An early prototype had 3 mm and 150 mm/s.  After some seconds warm motors weaken it, and do not end it.
TEST_CASE("pressed directly at a tenth of the span, the steel bar throws the hand about, for ever",
          "[servo loop]") {
  FemModel<> model(pinned(), 16);
  const StepResponse soon = step_response(model, tenth, Direct(), {}, 5, 1);
  INFO(soon.amplitude * 1e3 << " mm, " << soon.speed * 1e3 << " mm/s, " << soon.frequency << " Hz");
  CHECK(soon.amplitude >= 2e-3);
  CHECK(soon.speed >= 0.15);
  CHECK((soon.frequency >= 10 && soon.frequency <= 40));
  CHECK(soon.least_energy < -0.1);
  CHECK(soon.generated > 0.5);
  const StepResponse late = step_response(model, tenth, Direct(), {}, 60, 55);
  CHECK(late.amplitude >= 0.3e-3);
  CHECK(late.speed >= 0.03);
  CHECK(late.least_energy < soon.least_energy);
}

TEST_CASE("pressed directly at mid-span it takes damping, more with each tick of delay and with the period",
          "[servo loop]") {
  FemModel<> model(pinned(), 16);
  const auto stable = [&](double damping, double period, int delay) {
    Situation who;
    who.damping = damping, who.period = period, who.delay = delay;
    return step_response(model, middle, Direct(), who, 4, 3).speed <= at_rest;
  };
  // Borders of docs/data/stability_direct.csv, a third to either side.
  struct Border {
    double period;
    int delay;
    double damping;
  };
  for (const Border& b : {Border{1e-3, 0, 1.22},
                          {1e-3, 1, 21.4},
                          {1e-3, 2, 40.1},
                          {1e-3, 3, 57.3},
                          {0.5e-3, 1, 6.44},
                          {2e-3, 0, 11.5},
                          {2e-3, 1, 48.3}}) {
    CAPTURE(b.period, b.delay);
    CHECK(stable(b.damping * 1.33, b.period, b.delay));
    CHECK_FALSE(stable(b.damping / 1.33, b.period, b.delay));
  }
}

TEST_CASE("through the default coupling every hand is at rest half a second after a step, and gets no energy",
          "[servo loop]") {
  FemModel<> bar(pinned(), 16);
  check_at_rest(bar, tenth, 3, 150, 1);
  check_at_rest(bar, middle, 3, 150, 2);
  FemModel<> strip(
      Beam(0.5, Section::rectangle(0.02, 5e-4), Material{thesis_young}, Support::pinned, Support::pinned),
      16);
  check_at_rest(strip, 0.25, 3, 100, 3);
  FemModel<> ruler(
      Beam(0.3, Section::rectangle(0.03, 1e-3), Material{thesis_young}, Support::clamped, Support::free), 16);
  check_at_rest(ruler, 0.29, 1, 100, 4);
}

TEST_CASE("so it is with every model of the bar", "[servo loop]") {
  FemModel<Linear> linear(pinned(), 8);
  check_at_rest(linear, tenth, 3, 25, 5);
  FemModel<VonKarman<>, float> single(pinned(), 8);
  check_at_rest(single, 0.3 * thesis_length, 3, 25, 6);
  TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.02);
  plan.positions = plan.depths = 8;
  const auto full = full_model(pinned(), 32);
  PodModel<> pod(train_pod(take_snapshots(pinned(), full, plan)));
  check_at_rest(pod, tenth, 3, 25, 7);
  GalerkinModel<> galerkin(train_galerkin(take_snapshots_at_tensions(pinned(), full, plan)));
  check_at_rest(galerkin, tenth, 3, 25, 8);
}

TEST_CASE("so it is with friction on the beam", "[servo loop]") {
  FemModel<Corotational<>> ruler(
      Beam(0.3, Section::rectangle(0.03, 1e-3), Material{thesis_young}, Support::clamped, Support::free), 8);
  check_at_rest(ruler, 0.12, 2, 60, 10, 1);
  check_at_rest(ruler, 0.2, 1, 60, 11, 1);
}

// A host that runs free: 500 Hz to 8 kHz, and no tick where it should be.
TEST_CASE("so it is at any rate from 500 Hz to 8 kHz, with ticks that come 30 % early or late",
          "[servo loop]") {
  FemModel<> bar(pinned(), 16);
  Random random(9);
  for (int i = 0; i < 60; ++i) {
    Situation who = any(random);
    who.period = 1 / (500 * std::pow(16, random(0, 1)));
    who.jitter = 0.3;
    CAPTURE(who.hand_stiffness, who.hand_damping, who.grip_mass, who.period, who.delay, who.resolution);
    const StepResponse r =
        step_response(bar, i % 2 ? tenth : middle, VirtualCoupling(default_figures(who)), who, 5);
    CHECK(r.speed <= at_rest);
    CHECK(r.least_energy >= -round_off);
    CHECK(r.generated == 0);
  }
}

// Arms without any damping of their own, which is less than any has, in hands of the published fits: a hand of 0.8 N·s/m rings
// for some seconds by itself.
TEST_CASE("through the coupling of a known device, whose damping is unknown, a hand is at rest as well",
          "[servo loop]") {
  FemModel<> bar(pinned(), 16);
  Random random(10);
  for (const DeviceInfo& device : known_devices()) {
    if (device.damping > 0) continue;
    for (int i = 0; i < 8; ++i) {
      Situation who;
      who.hand_stiffness = random(380, 770), who.hand_damping = random(0.8, 1.8),
      who.grip_mass = random(0.2, 0.22);
      who.damping = 0, who.friction = device.friction, who.resolution = device.position_resolution;
      who.apparent_mass = device.apparent_mass > 0 ? device.apparent_mass : random(0.05, 0.3);
      who.push = 0.8 * device.continuous_force;
      CAPTURE(device.name, who.hand_stiffness, who.hand_damping, who.grip_mass, who.apparent_mass);
      const StepResponse r = step_response(bar, tenth, VirtualCoupling::for_device(device), who, 12, 10);
      CHECK(r.speed <= at_rest);
      CHECK(r.force > 0);
    }
  }
}

TEST_CASE("the criterion can fail: a coupling that is far too stiff for its delay buzzes", "[servo loop]") {
  FemModel<> model(pinned(), 16);
  for (const int delay : {1, 2, 3}) {
    Situation who;
    who.delay = delay;
    const double bound = passive_stiffness(who.damping, who.period, delay);
    const StepResponse r = step_response(model, tenth, VirtualCoupling({8 * bound, 0}), who, 4, 3);
    CHECK(r.speed > 10 * at_rest);
    CHECK(r.least_energy < -round_off);
    CHECK(r.generated > 0);
  }
}

TEST_CASE("what the loop generates its monitor can take back, as far as the arm's damping goes",
          "[servo loop]") {
  FemModel<> model(pinned(), 16);
  Situation who;
  who.delay = 1;
  const VirtualCoupling too_stiff({8000, 0});
  const StepResponse without = step_response(model, tenth, too_stiff, who, 4, 3);
  who.dissipate = true;
  const StepResponse with = step_response(model, tenth, too_stiff, who, 4, 3);
  CHECK(without.speed > 10 * at_rest);
  CHECK(with.speed <= at_rest);
  CHECK(with.generated <= 0.01 * without.generated);
}
