// The adapter on an emulated HDAPI: the order of its calls, its units, its limits, what it refuses.
#include <limits>

#include "haptics/hdapi/hdapi_support.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Nothing was done that HDAPI forbids, and nothing is left behind.
void check_clean(HdWorld& world) {
  CHECK(world.violations() == 0);
  CHECK(world.last_violation().empty());
  CHECK(world.errors_left() == 0);
  CHECK(world.callbacks() == 0);
  CHECK_FALSE(world.started());
}

}  // namespace

TEST_CASE("every error code has a class, and one that nobody knows ends the loop", "[hdapi]") {
  using C = HdCode;
  CHECK(classify<EmulatedHd>(C::success) == HdErrorClass::none);
  CHECK(classify<EmulatedHd>(C::warm_motors) == HdErrorClass::warm);
  CHECK(classify<EmulatedHd>(C::comm_error) == HdErrorClass::communication);
  CHECK(classify<EmulatedHd>(C::comm_config_error) == HdErrorClass::communication);
  CHECK(classify<EmulatedHd>(C::scheduler_full) == HdErrorClass::scheduler);
  CHECK(classify<EmulatedHd>(C::invalid_priority) == HdErrorClass::scheduler);
  int force = 0, ends = 0;
  for (unsigned code = 1; code < 0x10000; ++code) {
    force += classify<EmulatedHd>(code) == HdErrorClass::force;
    ends += classify<EmulatedHd>(code) >= HdErrorClass::fault;
  }
  CHECK(force == 4);
  CHECK(ends == 0xffff - 4 - 1 - 2);
  for (const unsigned code : {0x201u, 0x202u, 0x203u, 0x204u})
    CHECK(classify<EmulatedHd>(code) == HdErrorClass::force);
}

TEST_CASE("the calls of a life come in the documented order", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  Floor floor;
  {
    LockStepHdapi device;
    CHECK(device.status() == DeviceStatus::stopped);
    CHECK_FALSE(device.running());
    device.start(floor);
    CHECK(device.running());
    world.run(ticks_to_rest);
    CHECK(device.status() == DeviceStatus::running);
    CHECK(world.motors(phantom).y() > 1);
    device.stop();
    CHECK(device.status() == DeviceStatus::stopped);
    CHECK(world.motors(phantom) == Eigen::Vector3d::Zero());
    CHECK_FALSE(phantom.enabled);
    const std::uint64_t calls = floor.calls;
    CHECK(device.counts().ticks == calls);
    world.run(10);
    CHECK(floor.calls == calls);
    device.stop();
    device.start(floor);
    world.run(3);
  }
  CHECK(world.history ==
        "init check_calibration schedule enable_force start_scheduler stop_scheduler "
        "check_calibration schedule enable_force start_scheduler stop_scheduler disable_device ");
  check_clean(world);
}

TEST_CASE("a loop that never ran is unscheduled after the scheduler has stopped", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  Floor floor;
  {
    LockStepHdapi device;
    phantom.enable_error = HdCode::device_fault;
    CHECK_THROWS_AS(device.start(floor), DeviceError);
    CHECK(device.status() == DeviceStatus::device_fault);
    CHECK(world.callbacks() == 0);
    phantom.enable_error = HdCode::success;
    device.start(floor);
    world.run(3);
    CHECK(floor.calls == 3);
  }
  CHECK(world.history ==
        "init check_calibration schedule enable_force unschedule disable_force disable_device "
        "init check_calibration schedule enable_force start_scheduler stop_scheduler disable_device ");
  check_clean(world);
}

TEST_CASE("what the device says in mm is said in m, about the middle of its workspace", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  HdapiOptions options;
  options.friction = 0.2;
  options.position_resolution = 7e-6;
  options.damping = 5;
  options.apparent_mass = 0.21;
  LockStepHdapi device(options);
  const DeviceInfo& info = device.info();
  CHECK(info.name == "emulated Phantom");
  CHECK((info.workspace - Eigen::Vector3d(0.381, 0.267, 0.191)).norm() <= 1e-15);
  CHECK(info.peak_force == 37.5);
  CHECK(info.continuous_force == 6.2);
  CHECK(info.max_stiffness == 3500);
  CHECK(info.period == 1e-3);
  CHECK(info.friction == 0.2);
  CHECK(info.position_resolution == 7e-6);
  CHECK(info.damping == 5);
  CHECK(info.apparent_mass == 0.21);

  struct {
    HdWorld::Device* phantom;
    double worst = 0;
    Eigen::Vector3d operator()(const DeviceState& state) noexcept {
      // Half a step of the encoders from where the arm is, and the rounding of mm.
      worst = std::max(worst, (state.position - phantom->arm.tip().position).cwiseAbs().maxCoeff());
      fastest = std::max(fastest, -state.velocity.y());
      return {1, 0, 0};
    }
    double fastest = 0;
  } servo{&phantom};
  device.start(servo);
  world.run(300);
  CHECK(servo.worst <= 3.5e-6 + 1e-12);
  CHECK(servo.fastest > 0.1);
  CHECK(servo.fastest < 0.3);
  CHECK(world.motors(phantom).x() > 0);
}

TEST_CASE("behind HDAPI the hand feels what it feels on the same arm without it", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  LockStepHdapi device(at_once());
  VirtualPhantom<> same(press_and_hold());
  Floor behind, direct;
  device.start(behind);
  for (int i = 0; i < 1000; ++i) {
    world.tick();
    same.step(direct);
    // Positions differ by the rounding of mm, a step of the encoders at the border of one; the press is
    // stable.
    REQUIRE((phantom.arm.tip().position - same.tip().position).norm() <= 2e-6);
    REQUIRE(std::abs(behind.last.time - direct.last.time) <= 1e-9);
    REQUIRE(behind.last.reset == direct.last.reset);
    REQUIRE((behind.last.sent - direct.last.sent).norm() <= 1000 * 2e-5);
  }
  CHECK(direct.last.sent.y() > 5);
  CHECK(behind.resets == 1);
}

TEST_CASE("the force comes in by a straight ramp, and the servo is told what was sent", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", HandPath({0, 0}).rest(1));
  LockStepHdapi device;
  SteadyPush push;
  push.force = {0.3, 1, -2};
  device.start(push);
  for (int i = 0; i <= 600; ++i) {
    const Eigen::Vector3d before = world.motors(phantom);
    world.tick();
    REQUIRE(push.last.reset == (i == 0));
    REQUIRE(push.last.sent == before);
    REQUIRE(push.last.cut == (i > 0 && i <= 500 ? ForceCut::ramped : ForceCut::none));
    // Half a second: 500 steps.
    REQUIRE((world.motors(phantom) - push.force * std::min(1.0, i / 500.0)).norm() <= 1e-12);
  }
  CHECK(world.motors(phantom) == push.force);
  CHECK(device.counts().force_cut_ticks == 500);
  CHECK(device.status() == DeviceStatus::running);
}

TEST_CASE("whatever a servo asks for, what is sent is finite and within the limits", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", HandPath({0, 0}).rest(1));
  HdapiOptions options = at_once();
  options.force_limit = GENERATE(as<double>(), inf, 5.0);
  LockStepHdapi device(options);
  const double peak = std::min(37.5, options.force_limit);
  CHECK(device.info().peak_force == peak);
  CHECK(device.info().continuous_force == std::min(6.2, options.force_limit));
  SteadyPush push;
  device.start(push);
  world.run(2);
  for (const double bad : {not_a_number, inf, -inf}) {
    push.force = {1, bad, 0};
    world.tick();
    CHECK(world.motors(phantom) == Eigen::Vector3d::Zero());
    world.tick();
    CHECK(push.last.cut == ForceCut::not_finite);
  }
  push.force = {1e300, -1e300, 0};
  world.run(2);
  CHECK(world.motors(phantom).norm() == Approx(peak).epsilon(1e-15));
  CHECK(push.last.cut == ForceCut::peak);
  CHECK(push.last.sent == world.motors(phantom));
  CHECK(world.violations() == 0);
}

TEST_CASE("ticks that come late are counted, and time goes on", "[hdapi]") {
  HdWorld world;
  world.plug("one", press_and_hold());
  Floor floor;
  LockStepHdapi device;
  device.start(floor);
  world.run(10);
  CHECK(floor.last.time == Approx(9e-3).epsilon(1e-12));
  CHECK(device.counts().missed_ticks == 0);
  world.be_late(1);
  world.tick();
  CHECK(device.counts().missed_ticks == 1);
  world.be_late(3);
  world.tick();
  CHECK(device.counts().missed_ticks == 4);
  CHECK(device.counts().ticks == 12);
  CHECK(floor.last.time == Approx(15e-3).epsilon(1e-12));
  CHECK(device.status() == DeviceStatus::running);
  device.stop();
  device.start(floor);
  world.tick();
  CHECK(device.counts().missed_ticks == 0);
  CHECK(floor.last.time == 0);
}

TEST_CASE("a device that is not there is refused by name, and found when it is", "[hdapi]") {
  HdWorld world;
  HdapiOptions options;
  CHECK_THROWS_WITH(LockStepHdapi(options), ContainsSubstring("the default device cannot be initialised") &&
                                                ContainsSubstring("communication error (0x302)"));
  auto& phantom = world.plug("left", press_and_hold());
  options.device = "right";
  CHECK_THROWS_WITH(LockStepHdapi(options), ContainsSubstring("device 'right'"));
  options.device = "left";
  phantom.init_error = HdCode::device_fault;
  CHECK_THROWS_WITH(LockStepHdapi(options), ContainsSubstring("(0x300)"));
  phantom.init_error = HdCode::success;
  {
    LockStepHdapi device(options);
    CHECK_THROWS_WITH(LockStepHdapi(options), ContainsSubstring("(0x301)"));
    phantom.init_error = HdCode::success;
  }
  LockStepHdapi again(options);
  check_clean(world);
}

TEST_CASE("a device that names no limits is refused and let go", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  for (const double peak : {0.0, -1.0, inf, not_a_number}) {
    phantom.peak = peak;
    CHECK_THROWS_WITH(LockStepHdapi(), ContainsSubstring("names no maximal force"));
  }
  phantom.peak = 37.5;
  CHECK_NOTHROW(LockStepHdapi());
  check_clean(world);
}

TEST_CASE("options out of range are refused by name, value, unit and range", "[hdapi]") {
  HdWorld world;
  world.plug("one", press_and_hold());
  const auto refuses = [](void (*change)(HdapiOptions&), const char* text) {
    HdapiOptions options;
    change(options);
    CHECK_THROWS_WITH(LockStepHdapi(options), ContainsSubstring(text));
    CHECK_THROWS_AS(LockStepHdapi(options), std::invalid_argument);
  };
  refuses([](HdapiOptions& o) { o.rate = 99; }, "rate = 99 Hz: must be");
  refuses([](HdapiOptions& o) { o.rate = 10001; }, "rate = 10001 Hz: must be");
  refuses([](HdapiOptions& o) { o.force_limit = 0; }, "force_limit = 0 N");
  refuses([](HdapiOptions& o) { o.force_limit = not_a_number; }, "force_limit = nan N");
  refuses([](HdapiOptions& o) { o.ramp_time = 0; }, "ramp_time = 0 s");
  refuses([](HdapiOptions& o) { o.position_resolution = -1; }, "position_resolution = -1 m");
  refuses([](HdapiOptions& o) { o.friction = inf; }, "friction = inf N");
  refuses([](HdapiOptions& o) { o.damping = -5; }, "damping = -5 N·s/m");
  refuses([](HdapiOptions& o) { o.apparent_mass = not_a_number; }, "apparent_mass = nan kg");
}

TEST_CASE("a device of another rate is called at that rate, one that is unknown is refused", "[hdapi]") {
  HdWorld world;
  world.plug("one", press_and_hold());
  HdapiOptions options;
  options.rate = 500;
  Floor floor;
  {
    LockStepHdapi device(options);
    device.start(floor);
    world.run(100);
    CHECK(floor.last.time == Approx(0.198).epsilon(1e-12));
    CHECK(device.counts().missed_ticks == 0);
  }
  options.rate = 400;
  LockStepHdapi device(options);
  CHECK_THROWS_WITH(device.start(floor), ContainsSubstring("does not start") && ContainsSubstring("0x101"));
  CHECK(world.callbacks() == 0);
}

TEST_CASE("a scheduler without room is an error, and room found later is used", "[hdapi]") {
  HdWorld world;
  world.plug("one", press_and_hold());
  world.slots_allowed = 0;
  Floor floor;
  LockStepHdapi device;
  CHECK_THROWS_WITH(device.start(floor), ContainsSubstring("is not scheduled") && ContainsSubstring("0x501"));
  CHECK_FALSE(device.running());
  world.slots_allowed = 1;
  device.start(floor);
  world.run(3);
  CHECK(floor.calls == 3);
  device.stop();
  check_clean(world);
}
