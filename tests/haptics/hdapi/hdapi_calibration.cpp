// Who calibrates a device, when, and what its hand feels until that is done: nothing.
#include "haptics/hdapi/hdapi_support.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;
using Code = HdCode;

namespace {

const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
constexpr int interval = 100;  // [ticks] from one question to the next

/// A hand that presses from the start, on a device that does not know where its arm is and reads 30 mm too low: asked,
/// the floor would throw the hand up.
struct Uncalibrated {
  HdWorld world;
  HdWorld::Device& phantom = world.plug("one", press_and_hold());
  std::unique_ptr<LockStepHdapi> device;
  Floor floor;
  Uncalibrated(unsigned styles, unsigned calibration) {
    phantom.styles = styles;
    lose(calibration);
    device = std::make_unique<LockStepHdapi>();
  }
  void lose(unsigned calibration) {
    phantom.calibration = calibration;
    phantom.misplaced = {0, -30, 0};
  }
  /// Ticks until the servo is asked again, in which nothing is felt and nothing that was said before stands.
  int ticks_in_silence() {
    const std::uint64_t calls = floor.calls;
    for (int i = 0; i < 10000; ++i) {
      REQUIRE(world.motors(phantom) == zero);
      REQUIRE(device->status() == DeviceStatus::calibrating);
      REQUIRE(device->running());
      world.tick();
      if (floor.calls > calls) return i;
    }
    return -1;
  }
  /// From the tick in which the servo is asked again: it begins anew at the true place, and the force comes in by the ramp.
  void check_comes_back() {
    CHECK(device->status() == DeviceStatus::running);
    CHECK(floor.last.reset);
    CHECK(floor.last.sent == zero);
    CHECK((floor.last.position - phantom.arm.tip().position).norm() <= 1e-3);  // a tick later
    CHECK(world.motors(phantom) == zero);
    for (int i = 1; i <= 500; ++i) {
      world.tick();
      REQUIRE_FALSE(floor.last.reset);
      const double asked = std::max(0.0, -1000 * floor.last.position.y());
      REQUIRE(world.motors(phantom).y() == Approx(i / 500.0 * asked).epsilon(1e-12).margin(1e-12));
    }
  }
};

}  // namespace

TEST_CASE("encoders are set to zero only where somebody says that the arm is in its place", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  phantom.calibration =
      GENERATE(as<unsigned>(), HdCode::calibration_needs_update, HdCode::calibration_needs_manual_input);
  Floor floor;
  LockStepHdapi device;
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      device.start(floor);
      FAIL("started without calibration");
    } catch (const DeviceError& error) {
      CHECK(error.why() == DeviceStatus::calibration_needed);
      CHECK_THAT(error.what(), ContainsSubstring("reset position"));
    }
    CHECK(device.status() == DeviceStatus::calibration_needed);
    CHECK_FALSE(device.running());
    CHECK(world.callbacks() == 0);
    CHECK_FALSE(phantom.enabled);
  }
  CHECK(phantom.resets == 0);
  device.calibrate();
  CHECK(phantom.resets == 1);
  CHECK(device.status() == DeviceStatus::stopped);
  device.start(floor);
  CHECK_THROWS_AS(device.calibrate(), std::logic_error);
  CHECK_THROWS_AS(device.start(floor), std::logic_error);
  CHECK(device.running());
  CHECK(world.violations() == 0);
}

TEST_CASE("a device that calibrates itself does so in the servo loop, and is felt afterwards", "[hdapi]") {
  const unsigned styles = GENERATE(as<unsigned>(), Code::calibration_auto, Code::calibration_inkwell,
                                   Code::calibration_encoder_reset | Code::calibration_inkwell,
                                   Code::calibration_inkwell | Code::calibration_auto);
  Uncalibrated p(styles, Code::calibration_needs_update);
  p.device->calibrate();  // no person's affair
  CHECK(p.device->status() == DeviceStatus::stopped);
  p.device->start(p.floor);
  CHECK(p.ticks_in_silence() == interval);
  CHECK(p.floor.last.time == Approx(0.1).epsilon(1e-12));
  p.check_comes_back();
  p.world.run(ticks_to_rest);
  CHECK(p.world.motors(p.phantom).y() > 5);
  CHECK(p.phantom.updates == 1);
  CHECK(p.phantom.resets == 0);
  CHECK(p.device->counts().missed_ticks == 0);
  // It knows: the next loop has nothing to wait for.
  p.device->stop();
  const std::uint64_t calls = p.floor.calls;
  p.device->start(p.floor);
  p.world.tick();
  CHECK(p.floor.calls == calls + 1);
  CHECK(p.floor.last.reset);
  CHECK(p.world.violations() == 0);
  CHECK(p.world.errors_left() == 0);
}

TEST_CASE("a stylus that is not in its inkwell is waited for, and the loop can be stopped meanwhile",
          "[hdapi]") {
  Uncalibrated p(Code::calibration_inkwell, Code::calibration_needs_manual_input);
  p.device->start(p.floor);
  p.world.run(3000);
  CHECK(p.device->status() == DeviceStatus::calibrating);
  p.device->stop();
  CHECK(p.device->status() == DeviceStatus::stopped);
  CHECK_FALSE(p.phantom.enabled);
  p.device->start(p.floor);
  p.world.run(3000);
  CHECK(p.floor.calls == 0);
  CHECK(p.device->counts().ticks == 0);
  p.phantom.calibration = Code::calibration_needs_update;  // the stylus is put in
  CHECK(p.ticks_in_silence() <= 2 * interval);
  p.check_comes_back();
  CHECK(p.phantom.updates == 1);
  CHECK(p.device->counts().missed_ticks == 0);
  CHECK(p.world.violations() == 0);
}

TEST_CASE("a calibration that is lost in mid-press takes the force away until it is found again", "[hdapi]") {
  const unsigned lost =
      GENERATE(as<unsigned>(), Code::calibration_needs_update, Code::calibration_needs_manual_input);
  Uncalibrated p(Code::calibration_auto, Code::calibration_needs_update);
  p.device->start(p.floor);
  p.world.run(ticks_to_rest);
  const double steady = p.world.motors(p.phantom).y();
  REQUIRE(steady > 5);
  for (int round = 0; round < 3; ++round) {
    const std::uint64_t resets = p.floor.resets;
    p.lose(lost);
    int unnoticed = 0;
    while (p.device->status() == DeviceStatus::running && unnoticed <= interval) p.world.tick(), ++unnoticed;
    CHECK(unnoticed <= interval);
    if (lost == Code::calibration_needs_manual_input) {
      p.world.run(500);
      p.phantom.calibration = Code::calibration_needs_update;  // the arm has been moved about
    }
    CHECK(p.ticks_in_silence() <= 2 * interval);
    p.check_comes_back();
    CHECK(p.floor.resets == resets + 1);
    p.world.run(ticks_to_rest);
    // Friction leaves the arm within f / (k + k_hand) of where it was.
    CHECK(std::abs(p.world.motors(p.phantom).y() - steady) <= 1000 * 2 * 0.2 / 1500);
  }
  CHECK(p.phantom.updates == 4);
  CHECK(p.device->counts().missed_ticks == 0);
  CHECK(p.world.violations() == 0);
}

TEST_CASE("motors that were warm before a calibration are warm after it", "[hdapi]") {
  Uncalibrated p(Code::calibration_auto, Code::calibration_needs_update);
  p.phantom.has_sensor = false;
  p.device = nullptr;
  p.device = std::make_unique<LockStepHdapi>();
  p.device->start(p.floor);
  p.world.run(ticks_to_rest);
  p.world.raise(Code::warm_motors, &p.phantom);
  p.world.run(10);
  CHECK(p.device->status() == DeviceStatus::warm);
  p.lose(Code::calibration_needs_update);
  p.world.run(2 * interval);
  CHECK(p.device->status() == DeviceStatus::warm);
  p.world.run(5000);
  CHECK(p.world.motors(p.phantom) == zero);
}

TEST_CASE("a calibration that only a person can make ends the loop where it is lost", "[hdapi]") {
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  Floor floor;
  LockStepHdapi device;
  device.start(floor);
  world.run(ticks_to_rest);
  REQUIRE(world.motors(phantom).y() > 5);
  phantom.calibration = Code::calibration_needs_manual_input;
  world.run(interval);
  CHECK(device.status() == DeviceStatus::calibration_needed);
  CHECK_FALSE(device.running());
  CHECK(world.motors(phantom) == zero);
  CHECK_FALSE(phantom.enabled);
  CHECK_THROWS_AS(device.start(floor), DeviceError);
  device.calibrate();
  device.start(floor);
  world.run(ticks_to_rest);
  CHECK(world.motors(phantom).y() > 5);
  CHECK(phantom.resets == 1);
  CHECK(world.violations() == 0);
}

TEST_CASE("a device that waits for its inkwell leaves another alone", "[hdapi]") {
  HdWorld world;
  auto& left = world.plug("left", press_and_hold());
  auto& right = world.plug("right", press_and_hold());
  left.styles = Code::calibration_inkwell;
  left.calibration = Code::calibration_needs_manual_input;
  Floor left_floor, right_floor;  // pressed until the devices are gone
  HdapiOptions named;
  named.device = "left";
  LockStepHdapi on_left(named);
  named.device = "right";
  LockStepHdapi on_right(named);
  on_left.start(left_floor);
  on_right.start(right_floor);
  world.run(ticks_to_rest);
  CHECK(on_left.status() == DeviceStatus::calibrating);
  CHECK(world.motors(left) == zero);
  CHECK(world.motors(right).y() > 5);
  left.calibration = Code::calibration_needs_update;
  world.run(ticks_to_rest);
  CHECK(world.motors(left).y() > 5);
  CHECK(right_floor.resets == 1);
  CHECK(world.violations() == 0);
}
