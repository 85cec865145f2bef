// What the adapter does when something goes wrong: each fault ends in a defined state, and from each it can
// be started again.  Steady presses: the hand holds 20 mm below a floor of 1000 N/m, some 6 N.
#include <limits>
#include <vector>

#include "haptics/hdapi/hdapi_support.hpp"
#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/servo/placement.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Code = HdCode;

namespace {

const Eigen::Vector3d zero = Eigen::Vector3d::Zero();

/// A device that presses, at rest.
struct Holding {
  HdWorld world;
  HdWorld::Device& phantom = world.plug("one", press_and_hold());
  Floor floor;
  LockStepHdapi device;
  double steady = 0;
  Holding() {
    device.start(floor);
    world.run(ticks_to_rest);
    steady = force();
    REQUIRE(steady > 5);
  }
  double force() { return world.motors(phantom).y(); }
};

/// The press is back: friction leaves the arm within f / (k + k_hand) of where it was.
void check_recovered(Holding& p) {
  CHECK(p.device.status() == DeviceStatus::running);
  CHECK(std::abs(p.force() - p.steady) <= 1000 * 2 * 0.2 / 1500);
  CHECK(p.floor.last.cut == ForceCut::none);
}

void check_restarts(Holding& p) {
  p.device.stop();
  const std::uint64_t resets = p.floor.resets;
  p.device.start(p.floor);
  CHECK(p.device.running());
  p.world.run(ticks_to_rest);
  CHECK(p.floor.resets == resets + 1);
  check_recovered(p);
}

}  // namespace

TEST_CASE("after a force error the contact is forgotten and the force comes back by the ramp", "[hdapi]") {
  Holding p;
  const unsigned code = GENERATE(as<unsigned>(), Code::exceeded_max_force, Code::exceeded_max_force_impulse,
                                 Code::exceeded_max_velocity, Code::force_error);
  CAPTURE(code);
  const std::uint64_t resets = p.floor.resets;
  p.world.raise(code, &p.phantom);
  CHECK(p.force() == p.steady);
  p.world.tick();
  CHECK(p.world.motors(p.phantom) == zero);
  CHECK(p.floor.last.reset);
  CHECK(p.floor.last.status == DeviceStatus::force_error);
  CHECK(p.device.status() == DeviceStatus::force_error);
  CHECK(p.device.running());
  for (int i = 1; i <= 500; ++i) {
    p.world.tick();
    REQUIRE_FALSE(p.floor.last.reset);
    REQUIRE(p.device.status() == (i < 500 ? DeviceStatus::force_error : DeviceStatus::running));
    REQUIRE(p.force() == Approx(i / 500.0 * -1000 * p.floor.last.position.y()).epsilon(1e-12));
  }
  CHECK(p.floor.resets == resets + 1);
  p.world.run(ticks_to_rest);
  check_recovered(p);
  p.world.raise(code, &p.phantom);
  p.world.run(10);
  check_restarts(p);
  CHECK(p.world.violations() == 0);
}

TEST_CASE("a second force error while the force comes back begins the ramp anew", "[hdapi]") {
  Holding p;
  p.world.raise(Code::force_error, &p.phantom);
  p.world.run(400);
  CHECK(p.force() > 1);
  p.world.raise(Code::force_error, &p.phantom);
  p.world.tick();
  CHECK(p.force() == 0);
  CHECK(p.floor.last.reset);
  p.world.run(499);
  CHECK(p.device.status() == DeviceStatus::force_error);
  p.world.run(2);
  CHECK(p.device.status() == DeviceStatus::running);
}

TEST_CASE("an error that no loop can go on with ends it with zero force in the same tick", "[hdapi]") {
  Holding p;
  const unsigned code =
      GENERATE(as<unsigned>(), Code::invalid_enum, Code::invalid_value, Code::invalid_operation, 0x103,
               Code::bad_handle, Code::device_fault, Code::already_initiated, Code::comm_error,
               Code::comm_config_error, Code::timer_error, Code::illegal_begin, Code::illegal_end,
               Code::frame_error, 0x999);
  const bool names_device = GENERATE(true, false);
  CAPTURE(code, names_device);
  const std::uint64_t calls = p.floor.calls;
  p.world.raise(code, names_device ? &p.phantom : nullptr);
  p.world.tick();
  CHECK(p.world.motors(p.phantom) == zero);
  CHECK(p.phantom.committed == zero);
  CHECK_FALSE(p.phantom.enabled);
  CHECK_FALSE(p.device.running());
  const DeviceStatus status = code == Code::comm_error || code == Code::comm_config_error
                                  ? DeviceStatus::communication_lost
                                  : DeviceStatus::device_fault;
  CHECK(p.device.status() == status);
  CHECK(p.floor.calls == calls);
  CHECK(p.world.callbacks() == 0);
  p.world.run(10);
  CHECK(p.floor.calls == calls);
  CHECK(p.device.counts().ticks == calls);
  p.device.stop();
  CHECK(p.device.status() == status);
  check_restarts(p);
  CHECK(p.world.violations() == 0);
}

TEST_CASE("an error that a scheduler reports to somebody else leaves the loop alone", "[hdapi]") {
  Holding p;
  p.world.raise(GENERATE(as<unsigned>(), Code::scheduler_full, Code::invalid_priority));
  p.world.run(3);
  CHECK(p.device.status() == DeviceStatus::running);
  CHECK(p.force() == Approx(p.steady).margin(0.1));
}

TEST_CASE("of many errors in one tick the worst counts, wherever it stands", "[hdapi]") {
  Holding p;
  const int place = GENERATE(0, 1, 2, 3);
  const unsigned others[] = {Code::warm_motors, Code::force_error, Code::scheduler_full};
  for (int i = 0; i < 4; ++i) p.world.raise(i == place ? Code::comm_error : others[i % 3], &p.phantom);
  p.world.tick();
  CHECK(p.device.status() == DeviceStatus::communication_lost);
  CHECK(p.force() == 0);
  CHECK(p.world.errors_left() == 0);
}

TEST_CASE("a flood of errors is worked off tick by tick, and nothing in it is lost", "[hdapi]") {
  Holding p;
  p.world.raise(Code::device_fault, &p.phantom);  // the oldest, at the bottom
  for (int i = 0; i < 60; ++i) p.world.raise(Code::exceeded_max_velocity, &p.phantom);
  p.world.tick();
  CHECK(p.device.status() == DeviceStatus::force_error);
  CHECK(p.force() == 0);
  p.world.tick();
  CHECK(p.device.status() == DeviceStatus::device_fault);
  CHECK(p.force() == 0);
}

TEST_CASE("warm motors get less and less, and all of it when they have cooled", "[hdapi]") {
  Holding p;
  const auto heat = GENERATE(0.71, 1.5, std::numeric_limits<double>::quiet_NaN());
  p.phantom.temperature = 0.7;
  p.world.run(10);
  CHECK(p.device.status() == DeviceStatus::running);
  p.phantom.temperature = heat;
  double last = p.force();
  for (int i = 1; i <= 500; ++i) {
    p.world.tick();
    REQUIRE(p.device.status() == DeviceStatus::warm);
    REQUIRE(p.floor.last.status == DeviceStatus::warm);
    REQUIRE_FALSE(p.floor.last.reset);
    // Never faster than the ramp, with the floor's own share while the hand sinks in.
    REQUIRE(std::abs(p.force() - last) <= 1000 * 0.0204 / 500 + 1000 * 0.15e-3);
    last = p.force();
  }
  CHECK(p.world.motors(p.phantom) == zero);
  p.phantom.temperature = 0.51;  // not cool enough
  p.world.run(100);
  CHECK(p.force() == 0);
  CHECK(p.device.status() == DeviceStatus::warm);
  CHECK(p.device.running());
  p.phantom.temperature = 0.49;
  p.world.tick();
  CHECK(p.device.status() == DeviceStatus::running);
  p.world.run(ticks_to_rest);
  check_recovered(p);
  CHECK(p.world.violations() == 0);
}

TEST_CASE("a report of warm motors without a temperature gives them ten seconds", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  phantom.has_sensor = false;
  Floor floor;
  LockStepHdapi device;
  device.start(floor);
  world.run(ticks_to_rest);
  // A device that does not measure it must not raise an error in each tick.
  REQUIRE(device.status() == DeviceStatus::running);
  world.raise(Code::warm_motors, &phantom);
  world.run(500);
  CHECK(world.motors(phantom) == zero);
  CHECK(device.status() == DeviceStatus::warm);
  world.run(9500);
  CHECK(world.motors(phantom) == zero);
  CHECK(device.status() == DeviceStatus::warm);
  world.run(501);
  CHECK(device.status() == DeviceStatus::running);
  CHECK(world.motors(phantom).y() > 5);
}

TEST_CASE("an arm that is torn away faster than it may go is let go, then caught gently", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug(
      "one", HandPath({0, 0.05}).press(0.055, 0.5).rest(0.5).release(0.06, 0.04).press(0.06, 1).rest(9));
  phantom.top_speed = 0.5;
  Floor floor;
  LockStepHdapi device;
  device.start(floor);
  world.run(1000);
  CHECK(device.status() == DeviceStatus::running);
  bool seen = false;
  for (int i = 0; i < 200; ++i) {
    world.tick();
    if (device.status() != DeviceStatus::force_error) continue;
    if (!seen) CHECK(world.motors(phantom) == zero);
    seen = true;
  }
  CHECK(seen);
  CHECK(floor.resets > 1);
  world.run(4000);
  CHECK(device.status() == DeviceStatus::running);
  CHECK(world.motors(phantom).y() > 1);
}

TEST_CASE("a device that refuses forces that it once allowed never gets more, and is not given up",
          "[hdapi]") {
  Holding p;
  p.phantom.peak = 2;  // the driver's limit, changed behind the adapter's back
  double most = 0;
  for (int i = 0; i < 3000; ++i) {
    p.world.tick();
    most = std::max(most, p.force());
    REQUIRE(p.device.running());
  }
  CHECK(most > 0);
  CHECK(most <= 2);
  CHECK(p.floor.resets > 3);
  p.phantom.peak = 37.5;
  p.world.run(ticks_to_rest);
  check_recovered(p);
}

TEST_CASE("a device that reads nothing is a fault, not a place", "[hdapi]") {
  Holding p;
  p.phantom.has_readings = false;
  p.world.tick();
  CHECK(p.force() == 0);
  CHECK(p.device.status() == DeviceStatus::device_fault);
  p.phantom.has_readings = true;
  check_restarts(p);
}

TEST_CASE("unplugged while pressing: the force is gone within a tick, the rest stays", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", HandPath({0, 0.03}).press(0.025, 0.4).rest(1000));
  LockStepHdapi device;
  FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 8);
  struct Servo {
    Touch<FemModel<>> touch;
    Placement placement = Placement::in_plane({1.27, 0});
    int resets = 0;
    bool pressing = false;
    Eigen::Vector3d operator()(const DeviceState& state) noexcept {
      if (state.reset) touch.reset(), ++resets;
      const auto felt = touch.tick(placement.beam_position(state.position));
      pressing = felt.pressing;
      // A tenth of a steel beam: what the arm can hold without a coupling.
      return placement.device_force_of_beam(felt.force * 0.1);
    }
  } servo{Touch<FemModel<>>(model, 0.01)};
  device.start(servo);
  world.run(ticks_to_rest);
  const double steady = world.motors(phantom).y();
  REQUIRE(steady > 5);
  const std::uint64_t ticks = device.counts().ticks;

  world.unplug(phantom);
  CHECK(world.motors(phantom) == zero);
  world.tick();
  CHECK(device.status() == DeviceStatus::communication_lost);
  CHECK_FALSE(device.running());
  world.run(500);
  CHECK(device.counts().ticks == ticks);
  CHECK(servo.pressing);  // nobody has told the servo anything since
  CHECK(device.info().peak_force == 37.5);
  try {
    device.start(servo);
    FAIL("started without a device");
  } catch (const DeviceError& error) {
    CHECK(error.why() == DeviceStatus::communication_lost);
  }
  CHECK(device.status() == DeviceStatus::communication_lost);
  device.stop();

  world.plug(phantom);
  world.run(100);
  CHECK(world.motors(phantom) == zero);
  device.start(servo);
  CHECK(servo.resets == 1);
  world.run(2);
  CHECK(servo.resets == 2);
  // The hand has sunk in: one step of the ramp, of the peak at most.
  CHECK(world.motors(phantom).norm() <= 37.5 / 500 * (1 + 1e-12));
  world.run(2 * ticks_to_rest);
  // The same beam under the same hand; friction holds the arm within 2 f / (k_hand + k_beam).
  CHECK(std::abs(world.motors(phantom).y() - steady) <= 2100 * 2 * 0.2 / 2600);
  CHECK(world.violations() == 0);
}

TEST_CASE("unplugged while stopped: the first tick of the next loop says so", "[hdapi]") {
  Holding p;
  p.device.stop();
  p.world.unplug(p.phantom);
  p.device.start(p.floor);  // a driver may know nothing until a frame begins
  p.world.tick();
  CHECK(p.device.status() == DeviceStatus::communication_lost);
  // From then on the device is looked for.
  CHECK_THROWS_AS(p.device.start(p.floor), DeviceError);
  CHECK_FALSE(p.device.running());
  CHECK(p.device.status() == DeviceStatus::communication_lost);
  CHECK(p.world.callbacks() == 0);
  p.world.plug(p.phantom);
  check_restarts(p);
  CHECK(p.world.violations() == 0);
}

TEST_CASE("a device that somebody else closes is a fault", "[hdapi]") {
  Holding p;
  const std::uint64_t calls = p.floor.calls;
  p.phantom.handle = Code::invalid_handle;
  p.world.tick();
  CHECK(p.device.status() == DeviceStatus::device_fault);
  CHECK(p.floor.calls == calls);
  check_restarts(p);
}
