// A servo drives an array through the coupling, the monitor and the guard of one beam.
#include <algorithm>

#include "many/rows.hpp"
#include "support/catch.hpp"
#include "support/engagement.hpp"
#include "support/hostile_states.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>
#include <hapbeam/haptics/servo/servo_many.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {
using Model = FemModel<Corotational<>>;
}

TEMPLATE_TEST_CASE("a simulated Phantom strokes a brush: felt, finite, nothing generated", "",
                   VirtualCoupling, Direct) {
  constexpr double radius = 0.005;
  BeamArray<Model> brush(Model(bristle(), 8), row(20, 0.005));
  VirtualPhantom<> device(HandPath({-0.08, 0}).slide(0.16, 1.2).rest(0.1));
  ServoOptions options;
  options.avatar_radius = radius;
  options.placement = Placement::in_plane({0.0475, 0.06 + radius - 0.003});
  ServoLoop<VirtualPhantom<>, BeamArray<Model>, TestType> loop(device, brush, options);
  int seen = 0;
  for (int k = 0; k < 130; ++k) {
    device.run(loop.servo(), 0.01);
    const auto& picture = loop.picture();
    seen = std::max(seen, picture.size());
    for (int i = 0; i < picture.size(); ++i) {
      REQUIRE((picture.beam(i) >= 0 && picture.beam(i) < brush.size()));
      REQUIRE(picture.shape(i).size() == 10);
      REQUIRE(picture.shape(i).any_rotation());
    }
  }
  const ServoRecord& record = loop.servo().record();
  CHECK(seen >= 2);
  CHECK(record.contact_ticks > 400);
  CHECK(record.failed_ticks == 0);
  CHECK(record.max_force > 0.3);
  CHECK(record.max_force < 10);
  CHECK(record.energy_generated < 1e-9);
  CHECK_FALSE(record.pressing);
}

TEST_CASE("a hand in a brush is not surprised after a pause, and any finite state has a finite record",
          "[pause]") {
  constexpr double radius = 0.005;
  BeamArray<Model> brush(Model(bristle(), 4), row(20, 0.005));
  const DeviceInfo device = VirtualPhantom<>(HandPath({0, 0})).info();
  ServoOptions options;
  options.avatar_radius = radius;
  options.placement = Placement::in_plane({0.0475, 0.06 + radius - 0.003});
  Servo<BeamArray<Model>, Direct> servo(brush, device, options);
  Random random(40);
  OrientedState hand;
  hand.position = {0, -0.01, 0}, hand.time = 1000;
  // Pressed directly and held still, it feels one force, and no more than that.
  for (int tick = 0; tick < 400; ++tick) hand.time += 1e-3, (void)ask(servo, hand);
  const double whole = servo.record().force.norm() * (1 + 1e-9);
  CHECK(whole > 0.01);
  servo.reset();
  hand.time += 1;
  CHECK(surprises(servo, device, hand, pause_ticks(2000), random, whole) == 0);
  servo.reset();
  CHECK(surprises_of_host(servo, device, hand.position, pause_ticks(2000), random, whole) == 0);
  for (long tick = 0; tick < pause_ticks(2000); ++tick) {
    hand.position = {random(0.08), random(0.02), 0}, hand.time += 1e-3;
    (void)servo.tick(static_cast<const DeviceState&>(hostile_state(hand, random)));
    const char* const field = not_finite(servo.record());
    INFO("field: " << (field ? field : "none"));
    REQUIRE(field == nullptr);
  }
}
