// The loop with a stylus whose shaft touches a rod: the torque, its work, and whether it comes to rest.
#include <cmath>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/turning_response.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

Rod needle(double diameter = 0.002) {
  return Rod(0.2, RodSection::circle(diameter), spring_steel, RodSupport::clamped, RodSupport::free);
}
VirtualPhantomOptions six_axes() {
  VirtualPhantomOptions options;
  options.gimbal.present = true;
  return options;
}
DeviceInfo phantom() { return VirtualPhantom<>(HandPath({0, 0}), six_axes()).info(); }

/// The stylus lies across a rod along x at `at`, on the side `from`; the hand is `lever` behind where they cross.
ServoOptions across(double at, double from, double lever, double thickness) {
  ServoOptions options;
  options.avatar_radius = 0.01;
  options.stylus.length = 0.2, options.stylus.ahead = 0.1;
  const Point out(0, std::cos(from), std::sin(from)), beside(0, -std::sin(from), std::cos(from));
  Eigen::Matrix3d axes;
  axes.col(0) = Point(1, 0, 0), axes.col(1) = out, axes.col(2) = beside;
  options.placement =
      Placement(axes, Point(at, 0, 0) + (options.avatar_radius + thickness / 2) * out + lever * beside);
  return options;
}

OrientedState state_at(int tick, const Point& position, const Eigen::Vector3d& angles) {
  OrientedState state;
  state.position = position, state.time = 1e-3 * tick, state.reset = tick == 0;
  state.orientation = gimbal_orientation(angles);
  return state;
}

}  // namespace

TEST_CASE("the force on a shaft turns the hand by its lever, in a scene of any size", "[rod][torque]") {
  for (const double lever : {-0.08, 0.0, 0.03, 0.09})
    for (const double scale : {1.0, 0.5, 2.0}) {
      FemModel<RoundRod> model(needle(), 8);
      ServoOptions options = across(0.15, 0.7, lever, 0.002);
      const Placement& p = options.placement;
      options.placement = Placement(p.rotation(), p.origin(), scale);
      Servo<FemModel<RoundRod>> servo(model, phantom(), options);
      Wrench felt;
      for (int tick = 0; tick < 600; ++tick)
        felt = servo.tick(state_at(tick, {0, -0.003 / scale * std::min(1.0, tick / 300.0), 0}, {0, 0, 0}));
      REQUIRE(felt.force.y() > 0.05);
      // The hand is at +z of the contact: (c - p) × F = (0, 0, -lever) × F, in the device's metres.
      const double arm = lever / scale;
      CAPTURE(lever, scale, felt.force.transpose(), felt.torque.transpose());
      CHECK(std::abs(felt.torque.x() - arm * felt.force.y()) <= 2e-3 * felt.force.norm() / scale);
      CHECK(std::abs(felt.torque.dot(felt.force)) <= 1e-12);
      CHECK(servo.record().torque == felt.torque);
      CHECK(servo.record().shaft.norm() == Approx(0.2));
    }
}

TEST_CASE("a tip on the hand, or a force that passes through it, turns nothing", "[rod][torque]") {
  FemModel<RoundRod> model(needle(), 8), other(needle(), 8);
  ServoOptions options = across(0.15, 0.3, 0, 0.002);
  options.stylus = {};
  Servo<FemModel<RoundRod>> sphere(model, phantom(), options), plain(other, phantom(), options);
  for (int tick = 0; tick < 400; ++tick) {
    const OrientedState state =
        state_at(tick, {0.0001 * std::sin(0.05 * tick), -0.00001 * tick, 0}, {0.3, 0.2, 0.01 * tick});
    const Wrench felt = sphere.tick(state);
    const Eigen::Vector3d force = plain.tick(static_cast<const DeviceState&>(state));
    CHECK(felt.torque.norm() <= 1e-12 * (1 + felt.force.norm()));
    CHECK((felt.force - force).norm() <= 1e-6 * (1e-3 + force.norm()));
  }
  CHECK(sphere.record().contact_ticks > 300);
}

TEST_CASE("a loop of place and orientation that closes takes no work", "[rod][torque]") {
  FemModel<RoundRod> model(needle(), 12);
  const ServoOptions options = across(0.14, 0.4, 0.05, 0.002);
  DeviceInfo device = phantom();
  // Without damper, and K that turns with K_r: both springs and the rod store what they take.
  Servo<FemModel<RoundRod>> servo(model, device, options, VirtualCoupling({800, 0}, {2, 0}));
  const int start = 400, steps = 6000;
  const auto at = [&](double tick, Point& place, Eigen::Vector3d& angles) {
    const double deep = std::min(1.0, tick / start), a = 2 * pi * std::max(0.0, tick - start) / steps;
    place = {0.003 * std::sin(a), -0.004 * deep - 0.001 * (1 - std::cos(a)), 0.002 * std::sin(2 * a)};
    angles = {0.03 * std::sin(2 * a), 0.02 * std::sin(a), 0.5 * std::sin(a)};
  };
  Point before, place;
  Eigen::Vector3d old, angles;
  Wrench last;
  double work = 0, way = 0;
  at(0, before, old);
  for (int tick = 0; tick <= start + 2 * steps; ++tick) {
    at(tick, place, angles);
    const Wrench felt = servo.tick(state_at(tick, place, angles));
    if (tick > start + steps) {  // the second round: the first has settled
      const Eigen::Matrix3d by = gimbal_orientation(angles) * gimbal_orientation(old).transpose();
      const Point turned(by(2, 1) - by(1, 2), by(0, 2) - by(2, 0), by(1, 0) - by(0, 1));
      const double step =
          (felt.force + last.force).dot(place - before) / 2 + (felt.torque + last.torque).dot(turned) / 4;
      work += step, way += std::abs(step);
    }
    last = felt, before = place, old = angles;
  }
  CHECK(servo.record().contact_ticks > 12000);
  CHECK(way > 1e-3);
  // The capsule is moved and not turned by K_r: what that leaves out is of second order in its turn.
  INFO(work << " of " << way);
  CHECK(std::abs(work) <= 2e-3 * way);
}

TEST_CASE("a hand that leans and twists through a stylus on a rod comes to rest, from whatever side",
          "[rod][torque]") {
  Random random(21);
  int pressing = 0;
  for (int i = 0; i < 30; ++i) {
    VirtualPhantomOptions who = six_axes();
    who.hand = {random(300, 1000), random(0, 2), random(0.05, 0.4)};
    const double square = grip_lever * grip_lever;
    who.gimbal.hand_stiffness = random(300, 1000) * square, who.gimbal.hand_damping = random(0, 2) * square;
    who.gimbal.grip_inertia = random(0.05, 0.4) * square;
    who.gimbal.damping = random(4.5e-4, 5e-3), who.gimbal.friction = random(5e-4, 5e-3);
    who.gimbal.resolution = random(3e-5, 2e-4);
    who.arm.period = random(0.5e-3, 2e-3), who.arm.delay_ticks = random.integer(0, 3);
    const double thickness = random(0.001, 0.006);
    FemModel<RoundRod> model(needle(thickness), 8);
    ServoOptions options = across(random(0.12, 0.17), random(0, 2 * pi), random(0, 0.1), thickness);
    options.delay_ticks = who.arm.delay_ticks;
    const Turning hand{{0, -random(0.3, 1), 0}, {0, random(0.01), 0}};
    const TurningResponse r = turning_response(model, hand, who, options, 0.5, 0.7);
    CAPTURE(i, who.arm.period, who.arm.delay_ticks, who.gimbal.damping, who.gimbal.hand_stiffness, thickness);
    CHECK(r.speed <= 1e-3);
    CHECK(r.rate <= 0.03);
    CHECK(r.least_energy >= -1e-9);
    // The account knows the way to a step of the encoders.
    CHECK(r.generated <= r.max_torque * who.gimbal.resolution + r.max_force * who.arm.resolution);
    CHECK(r.max_torque <= who.gimbal.peak_torque);
    pressing += r.record.pressing;
  }
  CHECK(pressing > 22);
}

TEST_CASE("a stylus: whole strokes, faults and jumps, and it is a shaft in space alone", "[rod][torque]") {
  FemModel<RoundRod> model(needle(), 8);
  const ServoOptions options = across(0.15, 1.1, 0.04, 0.002);
  VirtualPhantom<> device(HandPath({0, 0.003})
                              .press(0.008, 0.4)
                              .turn({0, 0.05, 1}, 0.4)
                              .slide(-0.02, 0.4)
                              .turn({0, -0.05, -1}, 0.4)
                              .release(0.01, 0.3)
                              .rest(0.2),
                          six_axes());
  Servo<FemModel<RoundRod>> servo(model, device.info(), options);
  device.run(servo, 2.1);
  CHECK(servo.record().touches >= 1);
  CHECK(servo.record().max_torque > 1e-3);
  CHECK(servo.record().failed_ticks == 0);
  CHECK_FALSE(servo.record().pressing);
  CHECK(servo.record().torque.isZero(0));
  CHECK(servo.record().energy_generated <= 1e-6);

  Random random(5);
  const double bad[] = {std::nan(""), double(INFINITY), 1e300};
  servo.reset();
  for (int tick = 0; tick < 3000; ++tick) {
    OrientedState state =
        state_at(tick, {random(0.02), random(0.02), random(0.02)}, {random(3.), random(3.), random(3.)});
    if (random(0, 1) < 0.05) state.position[random.integer(0, 2)] = bad[random.integer(0, 2)];
    if (random(0, 1) < 0.05)
      state.orientation(random.integer(0, 2), random.integer(0, 2)) = bad[random.integer(0, 2)];
    if (random(0, 1) < 0.02) state.reset = true;
    const Wrench felt = servo.tick(state);
    REQUIRE((felt.force.allFinite() && felt.torque.allFinite()));
    REQUIRE(felt.force.norm() <= device.info().peak_force * (1 + 1e-12));
    REQUIRE(felt.torque.norm() <= device.info().gimbal.peak_torque * (1 + 1e-12));
  }
  // Wherever the jumps have left it, a hand that begins anew touches from where it is.
  Wrench felt;
  for (int tick = 3000; tick < 3600; ++tick) {
    OrientedState state = state_at(tick, {0, -0.003 * std::min(1.0, (tick - 3000) / 300.0), 0}, {0, 0, 0});
    state.reset = tick == 3000;
    felt = servo.tick(state);
  }
  CHECK(felt.force.y() > 0.05);
  CHECK(felt.torque.x() == Approx(0.04 * felt.force.y()).epsilon(0.05));

  ServoOptions wrong = options;
  wrong.stylus.length = -1;
  CHECK_THROWS_WITH(Servo<FemModel<RoundRod>>(model, device.info(), wrong),
                    ContainsSubstring("stylus length = -1 m"));
  FemModel<> ruler(
      Beam(0.3, Section::rectangle(0.03, 0.003), Material{3e9}, Support::pinned, Support::roller), 8);
  CHECK_THROWS_WITH(Servo<FemModel<>>(ruler, device.info(), options),
                    ContainsSubstring("stylus length = 0.2 m"));
}
