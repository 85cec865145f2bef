// Where the loop is stable that turns a hand: by the tip of a stylus, by its shaft, and by a held end; benchmarks/turning_map.cpp has
// the whole map.
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/turning_scenes.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double at_rest = 1e-3, turns_no_more = 0.03;  // [m/s], [rad/s]
constexpr double round_off = 1e-9;                      // [J]
constexpr TouchedBy ways[] = {TouchedBy::tip, TouchedBy::shaft, TouchedBy::grip};

/// A corner of the region that docs/haptics.md states.
TurningSituation corner(Random& random, double least_friction) {
  const auto one_of = [&](double a, double b) { return random.integer(0, 1) ? a : b; };
  return {one_of(300, 1000),
          one_of(0, 2),
          one_of(0.05, 0.4),
          one_of(4.5e-4, 5e-3),
          one_of(least_friction, 5e-3),
          one_of(3e-5, 2e-4),
          one_of(0.5e-3, 2e-3),
          random.integer(0, 1) ? 3 : 0};
}

}  // namespace

TEST_CASE(
    "at the corners of the stated region every hand that turns comes to rest, with four times the coupling "
    "as well",
    "[stylus loop]") {
  Random random(11);
  int pressing = 0, runs = 0;
  for (const TurningScene& scene : turning_scenes)
    for (const TouchedBy by : ways)
      for (const double factor : {1.0, 1.0, 4.0}) {
        const TurningSituation who = corner(random, 5e-4);
        const TurningResponse r = turning_response(scene, by, who, {factor, factor}, 4);
        CAPTURE(scene.name, static_cast<int>(by), factor, who.hand_stiffness, who.hand_damping, who.grip_mass,
                who.gimbal_damping, who.gimbal_friction, who.period, who.delay);
        CHECK(r.last_speed <= at_rest);
        CHECK(r.last_rate <= turns_no_more);
        CHECK(r.least_energy >= -round_off);
        CHECK(r.record.failed_ticks == 0);
        pressing += r.record.pressing, ++runs;
      }
  CHECK(pressing == runs);
}

TEST_CASE("without friction in the gimbal the shaft of a stylus comes to rest as the hand does alone",
          "[stylus loop]") {
  Random random(12);
  for (const TurningScene& scene : turning_scenes)
    for (int i = 0; i < 3; ++i) {
      const TurningSituation who = corner(random, 0);
      const TurningResponse r = turning_response(scene, TouchedBy::shaft, who, {}, 4),
                            alone = turning_response_alone(who, 4);
      CAPTURE(scene.name, who.hand_stiffness, who.hand_damping, who.gimbal_damping, who.gimbal_friction,
              who.period, who.delay);
      CHECK(r.last_speed <= at_rest);
      CHECK(r.last_rate <= turns_no_more + 1.1 * alone.last_rate);
      CHECK(r.least_energy >= -round_off);
    }
}

// K_r is small there, and the capsule that does not turn with it is wrong by 0.4 rad: docs/limits.md.
TEST_CASE(
    "a tip on a gimbal without friction, in a hand without damping, late by 8 ms, swings on; some of either "
    "ends that",
    "[stylus loop]") {
  TurningSituation who{300, 0, 0.05, 4.5e-4, 0, 3e-5, 2e-3, 3};
  const TurningScene& needle = turning_scenes[1];
  CHECK(turning_response(needle, TouchedBy::tip, who, {}, 12).last_rate > 10 * turns_no_more);
  who.hand_damping = 0.8;
  CHECK(turning_response(needle, TouchedBy::tip, who, {}, 4).last_rate <= turns_no_more);
  who.hand_damping = 0, who.gimbal_friction = 5e-4;
  CHECK(turning_response(needle, TouchedBy::tip, who, {}, 4).last_rate <= turns_no_more);
}

TEST_CASE("the criterion can fail: eight times the turning spring, without damper, gives energy to the hand",
          "[stylus loop]") {
  for (const TouchedBy by : ways) {
    TurningSituation who{300, 0, 0.05, 4.5e-4, 0, 3e-5, 2e-3, 3};
    if (by == TouchedBy::grip) who.hand_stiffness = 1000, who.gimbal_friction = 5e-4;
    const TurningResponse r = turning_response(turning_scenes[2], by, who, {8, 0}, 2);
    CAPTURE(static_cast<int>(by));
    CHECK(r.last_rate > 10 * turns_no_more);
    CHECK(r.least_energy < -round_off);
    CHECK(r.generated > 0);
  }
}
