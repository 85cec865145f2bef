// A hand on a rod is not surprised, by force or by torque, after a start, a reset, a failure or a pause.
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/engagement.hpp"
#include "support/hostile_states.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/held/grip.hpp>
#include <hapbeam/hosts/placed_touch.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

DeviceInfo six_axes() {
  VirtualPhantomOptions options;
  options.gimbal.present = true;
  return VirtualPhantom<>(HandPath({0, 0}), options).info();
}
Rod needle() {
  return Rod(0.2, RodSection::circle(0.006), spring_steel, RodSupport::clamped, RodSupport::free);
}
/// The stylus lies across the needle along z and presses it down, with the hand at the side.
ServoOptions across() {
  ServoOptions options;
  options.avatar_radius = 0.01;
  options.stylus.length = 0.2, options.stylus.ahead = 0.1;
  options.placement = Placement(Eigen::Matrix3d::Identity(), {0.1, 0.013, 0.05});
  return options;
}
/// Of a hand whose place and turn are `size` [m, rad] at most.
template <class Servo>
void check_records(Servo& servo, double size, const Eigen::Vector3d& middle, Random& random) {
  OrientedState hand;
  for (long tick = 0; tick < pause_ticks(1500); ++tick) {
    hand.position = middle + Eigen::Vector3d(random(size), random(size), random(size));
    hand.orientation = gimbal_orientation({random(size), random(size), random(size)});
    hand.time += 1e-3;
    const Wrench felt = ask(servo, hostile_state(hand, random));
    const char* const field = not_finite(servo.record());
    INFO("field: " << (field ? field : "none"));
    REQUIRE(field == nullptr);
    REQUIRE((felt.force.allFinite() && felt.torque.allFinite()));
  }
  CHECK(servo.record().contact_ticks > 50);
}

}  // namespace

TEST_CASE("a stylus on a rod: n ticks after a pause at most n T / 0.2 s of force and torque",
          "[rod][torque][pause]") {
  const DeviceInfo device = six_axes();
  FemModel<RoundRod> model(needle(), 8);
  Servo<FemModel<RoundRod>, Direct> servo(model, device, across());
  Random random(40);
  OrientedState hand;
  hand.position = {0, -0.008, 0}, hand.time = 1000;
  CHECK(surprises(servo, device, hand, pause_ticks(2000), random) == 0);
  for (int tick = 0; tick < 300; ++tick) hand.time += 1e-3, (void)servo.tick(hand);
  CHECK(servo.record().max_force > 5);
  CHECK(servo.record().max_torque > 0.05);
  check_records(servo, 0.02, {0, 0, 0}, random);
}

TEST_CASE("a held end: n ticks after a pause at most n T / 0.2 s of force and torque", "[rod][grip][pause]") {
  using Model = FemModel<TwistedRod>;
  const DeviceInfo device = six_axes();
  Rod rod(0.3, RodSection::circle(0.01), RodMaterial{3e9, 1.1e9}, GripCoupling::for_device(device).support(),
          RodSupport::clamped);
  rod.place_left({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}});
  Model model(rod, 4);
  Grip<Model> grip(model, RodSide::left);
  Servo<Grip<Model>> servo(grip, device);
  Random random(41);
  // The hand wanders: it takes the end where it is, and feels what it has done since.
  Engagement engagement(device);
  OrientedState hand;
  double most = 0, twist = 0;
  long wrong = 0;
  hand.time = 1000;
  for (long tick = 0; tick < pause_ticks(2000); ++tick) {
    const double s = 0.002 * static_cast<double>(tick);
    hand.position = 0.01 * Eigen::Vector3d(std::sin(3 * s), std::sin(5 * s), std::sin(7 * s));
    hand.orientation = gimbal_orientation({0.3 * std::sin(4 * s), 0.3 * std::sin(6 * s), std::sin(9 * s)});
    hand.time += 1e-3;
    if (random.integer(0, 400) == 0) hand.time += std::pow(10, random(-0.9, 4)), engagement.begins();
    if (random.integer(0, 400) == 0) hand.time -= random(0.11, 1e3), engagement.begins();
    if (random.integer(0, 400) == 0) servo.reset(), engagement.begins();
    const Wrench sent = servo.tick(hand);
    wrong += !engagement.allows(sent);
    most = std::max(most, sent.force.norm()), twist = std::max(twist, sent.torque.norm());
  }
  CHECK(wrong == 0);
  CHECK(most > 2);
  CHECK(twist > 0.02);
  check_records(servo, 0.01, {0, 0, 0}, random);
}

TEST_CASE("what a host places has a finite record for every finite pose", "[rod][hosts][pause]") {
  for (const double scale : {1.0, 1e-3, 1e6}) {
    FemModel<RoundRod> model(needle(), 8);
    PlacedTouch<FemModel<RoundRod>> placed(
        model, 0.003, Placement(Eigen::Matrix3d::Identity(), {0.1, 0.006, 0.05}, scale), {0.2, 0.1});
    Random random(42);
    OrientedState hand;
    for (long tick = 0; tick < pause_ticks(1000); ++tick) {
      hand.position = Eigen::Vector3d(random(0.02), random(0.01), random(0.02)) / scale;
      const OrientedState state = hostile_state(hand, random);
      const Wrench felt = placed.tick(HandPose{state.position, state.orientation});
      const ServoRecord& record = placed.picture().record;
      const char* const field = not_finite(record);
      INFO("field: " << (field ? field : "none"));
      REQUIRE(field == nullptr);
      REQUIRE((felt.force.allFinite() && felt.torque.allFinite()));
      if (!(state.position.cwiseAbs().maxCoeff() <= 1e9)) REQUIRE(record.model == Status::invalid_request);
    }
    CHECK(placed.picture().record.contact_ticks > 50);
  }
}
