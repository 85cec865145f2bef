// The loop in space: a hand leans on a rod from any side, through the coupling that its device can render.
#include <cmath>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/step_response.hpp"
#include <hapbeam/hosts/placed_touch.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

Rod needle() {
  return Rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
}
/// Unit, across the x axis.
Point around(double angle) { return {0, std::cos(angle), std::sin(angle)}; }

DeviceInfo phantom() { return VirtualPhantom<>(HandPath({0, 0})).info(); }

}  // namespace

TEST_CASE(
    "through the default coupling a hand is at rest half a second after it leaned on a rod from any side",
    "[rod][loop]") {
  Random random(12);
  FemModel<RoundRod> wire(needle(), 8);
  FemModel<TwistedRod> hook(pressed_rod("hook").rod, 8);
  for (int i = 0; i < 60; ++i) {
    Situation who = random_hand(random);
    who.push = 1;  // a ball on a round rod rolls off unless the hand holds it by push/reach, 170 N/m
    who.from = around(random(0, 2 * pi));
    const VirtualCoupling coupling(
        safe_coupling(VirtualPhantom<Leaning>(Leaning{0}, who.options()).info(), who.delay));
    CAPTURE(i, who.hand_stiffness, who.hand_damping, who.grip_mass, who.period, who.delay,
            who.from.transpose());
    const auto check = [&](const StepResponse& r) {
      CHECK(r.speed <= 1e-3);
      CHECK(r.least_energy >= -1e-9);
      CHECK(r.generated == 0);
      CHECK(std::abs(r.force - who.push - who.hand_stiffness * r.position) <= who.friction * (1 + 1e-9));
      CHECK(r.force > 0);
    };
    check(step_response(wire, 0.16, coupling, who, 4));
    if (i % 4 != 0) continue;
    who.from = Point(0, 0, i % 8 == 0 ? 1 : -1);  // across the plane of the hook
    check(step_response(hook, 0.12, coupling, who, 4));
  }
}

TEST_CASE("a stroke through the loop has one beginning and one end, from whatever side", "[rod][loop]") {
  FemModel<RoundRod> wire(needle(), 8);
  for (int k = 0; k < 12; ++k) {
    const Point from = around(0.3 + k * pi / 6), beside = around(0.3 + k * pi / 6 + pi / 2);
    for (const double off : {0.0, 0.001}) {
      wire.reset();
      ServoOptions options;
      options.avatar_radius =
          0.02;  // a smaller ball would slip: its reach times 3EI/s³ is less than the force
      Servo<FemModel<RoundRod>> servo(wire, phantom(), options);
      DeviceState state{};
      state.status = DeviceStatus::running;
      double along = 0;  // of the force, the part that is not out of the rod
      for (int tick = 0; tick < 600; ++tick, state.time += 1e-3) {
        const double depth = 0.012 * std::sin(pi * tick / 600) - 0.003;
        state.position = Point(0.15, 0, 0) + (0.021 - depth) * from + off * beside;
        along = std::max(along, std::abs(servo.tick(state).x()));
      }
      const ServoRecord& r = servo.record();
      CAPTURE(k, off);
      CHECK(r.touches == 1);
      CHECK(r.max_force > 0.1);
      CHECK(along < 0.2 * r.max_force);
      CHECK(r.energy_generated == 0);
      CHECK(r.failed_ticks == 0);
      CHECK_FALSE(r.pressing);
      CHECK(r.hand == Eigen::Vector3d(state.position));
    }
  }
}

TEST_CASE("turned and moved with its scene, the loop feels the same", "[rod][loop]") {
  const Eigen::Matrix3d turn = (Eigen::Matrix3d() << 0, -1, 0, 0, 0, 1, -1, 0, 0).finished();
  const Placement placement(turn, {0.1, -0.02, 0.03}, 2);
  FemModel<RoundRod> one(needle(), 8), other(needle(), 8);
  ServoOptions options;
  options.avatar_radius = 0.003;
  VirtualCoupling coupling({800, 1});
  // In the scene's metres a spring is half as stiff, and forces are not scaled.
  Servo<FemModel<RoundRod>> plain(one, phantom(), options, VirtualCoupling({400, 0.5}));
  options.placement = placement;
  Servo<FemModel<RoundRod>> turned(other, phantom(), options, coupling);
  PlacedTouch<FemModel<RoundRod>> placed(other, 0.003, placement);
  for (int tick = 0; tick < 400; ++tick) {
    DeviceState state{};
    state.status = DeviceStatus::running, state.time = tick * 1e-3;
    const Eigen::Vector3d hand(0.12 + 0.02 * std::sin(0.01 * tick), 0.008 * std::cos(0.02 * tick), 0.001);
    state.position = hand;
    const Eigen::Vector3d expected = plain.tick(state);
    state.position = placement.device_position(hand);
    const Eigen::Vector3d felt = placement.rotation() * turned.tick(state);
    CAPTURE(tick);
    REQUIRE((felt - expected).norm() <= 1e-6 * (1e-3 + expected.norm()));
  }
  CHECK(plain.record().contact_ticks > 100);
  other.reset();
  Touch<FemModel<RoundRod>> touch(one, 0.003);
  const Point deep(0.15, 0.002, 0.0005);
  const Eigen::Vector3d alone = touch.tick(deep).force;
  CHECK((placement.rotation() * placed.tick(placement.device_position(deep)) - alone).norm() <=
        1e-9 * alone.norm());
}
