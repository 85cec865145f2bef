// Two devices on one scheduler: one thread, one stack of errors, and neither pays for the other.
#include <cstring>
#include <vector>

#include "haptics/hdapi/hdapi_support.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;
using Code = HdCode;

namespace {

const Eigen::Vector3d zero = Eigen::Vector3d::Zero();

HdapiOptions named(const char* name) {
  HdapiOptions options;
  options.device = name;
  return options;
}

/// Two hands, at rest on floors of different stiffness.
struct Two {
  HdWorld world;
  HdWorld::Device& left = world.plug("left", press_and_hold());
  HdWorld::Device& right = world.plug("right", press_and_hold());
  Floor left_floor{1000}, right_floor{2000};
  LockStepHdapi on_left{named("left")}, on_right{named("right")};
  Two() {
    on_left.start(left_floor);
    on_right.start(right_floor);
    world.run(ticks_to_rest);
  }
};

/// The forces on the right hand, tick by tick, while something is done to the left one.
template <typename Act>
std::vector<double> forces_right(Act act) {
  Two two;
  act(two);
  std::vector<double> forces;
  for (int i = 0; i < 700; ++i) {
    two.world.tick();
    forces.push_back(two.world.motors(two.right).y());
  }
  CHECK(two.on_right.status() == DeviceStatus::running);
  CHECK(two.right_floor.resets == 1);
  CHECK(two.world.violations() == 0);
  return forces;
}

}  // namespace

TEST_CASE("two devices share one scheduler and feel what is under each", "[hdapi]") {
  Two two;
  CHECK(two.world.starts == 1);
  CHECK(two.world.callbacks() == 2);
  // Hand 500 N/m in series with the floor, friction 0.2 N either way.
  CHECK(std::abs(two.world.motors(two.left).y() - 0.02 * 500 * 1000 / 1500) <= 0.2);
  CHECK(std::abs(two.world.motors(two.right).y() - 0.02 * 500 * 2000 / 2500) <= 0.2);
  two.on_left.stop();
  CHECK(two.world.started());
  CHECK(two.world.motors(two.left) == zero);
  CHECK(two.world.motors(two.right).y() > 5);
  const std::uint64_t calls = two.left_floor.calls;
  two.world.run(10);
  CHECK(two.left_floor.calls == calls);
  CHECK(two.on_right.running());
  two.on_right.stop();
  CHECK_FALSE(two.world.started());
  CHECK(two.world.motors(two.right) == zero);
  CHECK(two.world.callbacks() == 0);
  CHECK(two.world.violations() == 0);
  CHECK(two.world.last_violation().empty());
}

TEST_CASE("whatever happens to one device, the other's force is the same to the bit", "[hdapi]") {
  const auto undisturbed = forces_right([](Two&) {});
  REQUIRE(undisturbed.back() > 5);
  CHECK(forces_right([](Two& two) { two.world.raise(Code::force_error, &two.left); }) == undisturbed);
  CHECK(forces_right([](Two& two) { two.world.raise(Code::device_fault, &two.left); }) == undisturbed);
  CHECK(forces_right([](Two& two) { two.world.raise(Code::warm_motors, &two.left); }) == undisturbed);
  CHECK(forces_right([](Two& two) { two.world.unplug(two.left); }) == undisturbed);
  CHECK(forces_right([](Two& two) { two.left.has_readings = false; }) == undisturbed);
  CHECK(forces_right([](Two& two) { two.left.calibration = Code::calibration_needs_update; }) == undisturbed);
  CHECK(forces_right([](Two& two) { two.left_floor.stiffness = 1e300; }) == undisturbed);
  // Closed by somebody else: what is meant for it must not reach the device that is current instead.
  CHECK(forces_right([](Two& two) { two.left.handle = Code::invalid_handle; }) == undisturbed);
}

TEST_CASE("stopping and starting one costs the other nothing", "[hdapi]") {
  // A synchronous call takes a tick of its own.
  const auto undisturbed = forces_right([](Two& two) { two.world.run(50); });
  for (const bool again : {false, true}) {
    const auto forces = forces_right([&](Two& two) {
      const std::uint64_t before = two.right_floor.calls;
      two.on_left.stop();
      two.on_left.stop();
      if (again) two.on_left.start(two.left_floor);
      while (two.right_floor.calls < before + 50) two.world.tick();
    });
    CHECK(forces == undisturbed);
  }
}

TEST_CASE("an error finds its device, whichever's tick finds the error", "[hdapi]") {
  Two two;
  const bool left = GENERATE(true, false);
  LockStepHdapi& hit = left ? two.on_left : two.on_right;
  LockStepHdapi& other = left ? two.on_right : two.on_left;
  const bool ends = GENERATE(true, false);
  two.world.raise(ends ? Code::comm_error : Code::exceeded_max_velocity, left ? &two.left : &two.right);
  two.world.run(2);
  CHECK(hit.status() == (ends ? DeviceStatus::communication_lost : DeviceStatus::force_error));
  CHECK(other.status() == DeviceStatus::running);
  CHECK(two.world.motors(left ? two.left : two.right).norm() <= 0.02);
}

TEST_CASE("the first of two in a tick learns of an error that the second finds, one tick later", "[hdapi]") {
  Two two;
  struct Raises {
    Two* two;
    bool armed = true;
    Eigen::Vector3d operator()(const DeviceState&) noexcept {
      if (two->left_floor.calls % 100 == 50 && armed)
        two->world.raise(Code::device_fault, &two->left), armed = false;
      return {0, 1, 0};
    }
  } raises{&two};
  two.on_right.stop();
  two.on_right.start(raises);
  while (raises.armed) two.world.tick();
  const std::uint64_t calls = two.left_floor.calls;
  two.world.tick();
  CHECK(two.on_left.status() == DeviceStatus::device_fault);
  CHECK(two.world.motors(two.left) == zero);
  CHECK(two.left_floor.calls == calls);
  CHECK(two.on_right.running());
}

TEST_CASE("an error that names no device is everybody's", "[hdapi]") {
  Two two;
  two.world.raise(Code::timer_error);
  two.world.run(2);
  CHECK(two.on_left.status() == DeviceStatus::device_fault);
  CHECK(two.on_right.status() == DeviceStatus::device_fault);
  CHECK(two.world.motors(two.left) == zero);
  CHECK(two.world.motors(two.right) == zero);
  two.on_left.stop();
  two.on_right.stop();
  two.on_left.start(two.left_floor);
  CHECK_THROWS_AS(two.on_right.start(two.right_floor), std::logic_error);
  two.on_left.stop();
  CHECK_FALSE(two.world.started());
}

TEST_CASE("a device that was lost is connected again when the others have stopped", "[hdapi]") {
  Two two;
  two.world.unplug(two.left);
  two.world.tick();
  two.world.plug(two.left);
  const std::uint64_t resets = two.right_floor.resets;
  CHECK_THROWS_WITH(two.on_left.start(two.left_floor), ContainsSubstring("stop the other devices first"));
  CHECK_THROWS_AS(LockStepHdapi(named("third")), std::logic_error);
  CHECK(two.on_left.status() == DeviceStatus::communication_lost);
  CHECK(two.right_floor.resets == resets);
  CHECK(two.on_right.status() == DeviceStatus::running);
  two.on_right.stop();
  two.on_left.start(two.left_floor);
  two.on_right.start(two.right_floor);
  two.world.run(ticks_to_rest);
  CHECK(two.on_left.status() == DeviceStatus::running);
  CHECK(two.on_right.status() == DeviceStatus::running);
  CHECK(std::abs(two.world.motors(two.left).y() - 0.02 * 500 * 1000 / 1500) <= 0.2);
  CHECK(two.world.violations() == 0);
}

TEST_CASE("a device that is destroyed beside a running one is disabled when that stops", "[hdapi]") {
  HdWorld world;
  auto& left = world.plug("left", press_and_hold());
  world.plug("right", press_and_hold());
  Floor floor;
  {
    auto on_left = std::make_unique<LockStepHdapi>(named("left"));
    LockStepHdapi on_right(named("right"));
    on_left->start(floor);
    on_right.start(floor);
    world.run(5);
    on_left.reset();
    CHECK(left.handle != Code::invalid_handle);
    CHECK(world.motors(left) == zero);
    CHECK_FALSE(left.enabled);
    world.run(5);
    CHECK(on_right.running());
    on_right.stop();
    CHECK(left.handle == Code::invalid_handle);
  }
  CHECK(world.violations() == 0);
  CHECK(world.errors_left() == 0);
}

TEST_CASE("a second loop that cannot be had leaves the first alone", "[hdapi]") {
  HdWorld world;
  world.plug("left", press_and_hold());
  auto& right = world.plug("right", press_and_hold());
  HdapiOptions slow = named("right");
  slow.rate = 500;
  Floor floor, second;
  LockStepHdapi on_left(named("left"));
  SECTION("another rate") {
    LockStepHdapi on_right(slow);
    on_left.start(floor);
    CHECK_THROWS_WITH(on_right.start(second),
                      ContainsSubstring("rate = 500 Hz: must be that of the devices"));
  }
  SECTION("no room in the scheduler") {
    LockStepHdapi on_right(named("right"));
    on_left.start(floor);
    world.slots_allowed = 1;
    CHECK_THROWS_AS(on_right.start(second), DeviceError);
    CHECK(on_right.status() == DeviceStatus::device_fault);
  }
  SECTION("not calibrated") {
    LockStepHdapi on_right(named("right"));
    right.calibration = Code::calibration_needs_update;
    on_left.start(floor);
    CHECK_THROWS_AS(on_right.start(second), DeviceError);
    CHECK(on_right.status() == DeviceStatus::calibration_needed);
    on_right.calibrate();  // in a callback, beside the loop that runs
    on_right.start(second);
    CHECK(on_right.running());
  }
  SECTION("forces that cannot be enabled") {
    LockStepHdapi on_right(named("right"));
    right.enable_error = Code::device_fault;
    on_left.start(floor);
    CHECK_THROWS_AS(on_right.start(second), DeviceError);
    CHECK(on_right.status() == DeviceStatus::device_fault);
    CHECK(world.callbacks() == 1);
  }
  world.run(10);
  CHECK(on_left.status() == DeviceStatus::running);
  CHECK(floor.resets == 1);
  CHECK(world.violations() == 0);
}
