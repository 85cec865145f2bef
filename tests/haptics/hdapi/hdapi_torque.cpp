// Devices of HDAPI that turn: what is read of their orientation, who gets torque, and how much of it.
#include <limits>

#include "haptics/hdapi/hdapi_support.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Turned {
  Wrench wrench{{0, 1, 0}, {0.01, 0.02, -0.03}};
  OrientedState last{};
  int plain = 0, turned = 0;
  Eigen::Vector3d operator()(const DeviceState&) noexcept { return ++plain, wrench.force; }
  Wrench operator()(const OrientedState& state) noexcept { return last = state, ++turned, wrench; }
};

HandPath turning() { return HandPath({0, 0}).turn({0.3, -0.4, 2}, 0.3).rest(1000); }

}  // namespace

TEST_CASE("orientation is read by columns, and torque is sent in the vendor's unit", "[hdapi][torque]") {
  HdWorld world;
  auto& phantom = world.plug_turning("one", turning(), 6);
  Turned servo;
  LockStepHdapi device(at_once());
  CHECK(device.info().gimbal.reads);
  CHECK(device.info().gimbal.peak_torque == Approx(0.17));
  CHECK(device.info().gimbal.continuous_torque == Approx(0.048));
  CHECK(device.info().gimbal.max_stiffness == Approx(0.5));
  device.start(servo);
  world.run(1500);
  CHECK(servo.plain == 0);
  CHECK((servo.last.orientation - phantom.orientation).norm() <= 1e-12);
  CHECK((servo.last.orientation - gimbal_orientation(phantom.arm.gimbal().angles())).norm() <= 1e-2);
  CHECK((world.torque(phantom) - servo.wrench.torque).norm() <= 1e-15);
  CHECK((phantom.committed_torque - 1e3 * servo.wrench.torque).norm() <= 1e-12);
  CHECK((servo.last.sent_torque - servo.wrench.torque).norm() <= 1e-15);
  device.stop();
  CHECK(world.torque(phantom).isZero(0));
  CHECK(phantom.committed_torque.isZero(0));
  CHECK(world.violations() == 0);
}

TEST_CASE("torque stays within what the device states and what the user allows", "[hdapi][torque]") {
  for (const double allowed : {1.0, 0.05, 0.0}) {
    HdWorld world;
    auto& phantom = world.plug_turning("one", turning(), 6);
    HdapiOptions options = at_once();
    options.torque_limit = allowed;
    LockStepHdapi device(options);
    Turned servo;
    servo.wrench.torque = {3, 0, -4};
    device.start(servo);
    world.run(10);
    const double peak = std::min(0.17, allowed);
    CHECK((world.torque(phantom) - Eigen::Vector3d(0.6, 0, -0.8) * peak).norm() <= 1e-12);
    CHECK((servo.last.cut == ForceCut::peak) == (peak > 0));
    CHECK(world.motors(phantom).y() == Approx(1));
    servo.wrench.torque[1] = not_a_number;
    world.run(2);
    CHECK(servo.last.cut == ForceCut::not_finite);
    CHECK(world.torque(phantom).isZero(0));
    CHECK(world.motors(phantom).isZero(0));
    CHECK(world.violations() == 0);
  }
}

TEST_CASE("torque ramps in with the force, and goes with warm motors", "[hdapi][torque]") {
  HdWorld world;
  auto& phantom = world.plug_turning("one", turning(), 6);
  LockStepHdapi device;
  Turned servo;
  device.start(servo);
  double last = 0;
  for (int i = 0; i < 600; ++i) {
    world.tick();
    const double now = world.torque(phantom).norm(), whole = servo.wrench.torque.norm();
    REQUIRE(now - last <= whole / 500 * (1 + 1e-9));
    REQUIRE(std::abs(now / whole - world.motors(phantom).y()) <= 1e-12);
    last = now;
  }
  CHECK(last == Approx(servo.wrench.torque.norm()));
  phantom.temperature = 0.9;
  world.run(600);
  CHECK(world.torque(phantom).isZero(0));
  phantom.temperature = 0.1;
  world.run(600);
  world.raise(HdCode::exceeded_max_force, &phantom);
  world.tick();
  CHECK(world.torque(phantom).isZero(0));
  CHECK(servo.last.reset);
}

TEST_CASE("torque goes to no device that renders none, and to a deaf servo's device goes zero",
          "[hdapi][torque]") {
  HdWorld world;
  auto& reads = world.plug_turning("reads", turning(), 3);
  auto& three = world.plug("three", turning());
  auto& mute = world.plug_turning("mute", turning(), 6);
  auto& limitless = world.plug_turning("limitless", turning(), 6);
  auto& deaf = world.plug_turning("deaf", turning(), 6);
  mute.tells_axes = false;
  limitless.peak_torque = 0;
  Turned one, two, other, zero;
  Floor floor;
  HdapiOptions options = at_once();
  const auto device = [&](const char* name) {
    options.device = name;
    return options;
  };
  LockStepHdapi a(device("reads")), b(device("three")), c(device("mute")), d(device("limitless")),
      e(device("deaf"));
  a.start(one), b.start(two), c.start(other), d.start(zero), e.start(floor);
  world.run(50);
  CHECK((one.turned > 0 && one.plain == 0));
  CHECK((two.plain > 0 && two.turned == 0));
  CHECK((other.plain > 0 && other.turned == 0));
  CHECK((zero.turned > 0 && d.info().gimbal.peak_torque == 0));
  CHECK((reads.torques == 0 && three.torques == 0 && mute.torques == 0));
  CHECK((limitless.torques > 0 && limitless.committed_torque.isZero(0)));
  CHECK((deaf.torques > 0 && deaf.committed_torque.isZero(0)));
  CHECK(one.last.cut == ForceCut::none);
  CHECK(world.motors(reads).y() == Approx(1));
  CHECK(world.violations() == 0);
}

TEST_CASE("a transform that is no rotation ends the loop without a force or a torque", "[hdapi][torque]") {
  for (const double by : {not_a_number, 0.0, 1.2, -1.0, std::numeric_limits<double>::infinity()}) {
    HdWorld world;
    auto& phantom = world.plug_turning("one", turning(), 6);
    LockStepHdapi device(at_once());
    Turned servo;
    device.start(servo);
    world.run(20);
    CHECK(world.torque(phantom).norm() > 0);
    const int asked = servo.turned;
    phantom.transform_by = by;
    world.run(2);
    CHECK(device.status() == DeviceStatus::device_fault);
    CHECK(servo.turned == asked);
    CHECK(world.torque(phantom).isZero(0));
    CHECK(world.motors(phantom).isZero(0));
    phantom.transform_by = 1 + 1e-7;  // last digits of a vendor's float
    device.start(servo);
    world.run(20);
    CHECK(device.running());
    CHECK(
        (servo.last.orientation.transpose() * servo.last.orientation - Eigen::Matrix3d::Identity()).norm() <=
        1e-14);
  }
}

TEST_CASE("unplugged, or while it calibrates, a device gets no torque", "[hdapi][torque]") {
  HdWorld world;
  auto& phantom = world.plug_turning("one", turning(), 6);
  phantom.styles = HdCode::calibration_inkwell;
  phantom.calibration = HdCode::calibration_needs_manual_input;
  LockStepHdapi device(at_once());
  Turned servo;
  device.start(servo);
  world.run(200);
  CHECK(servo.turned == 0);
  CHECK((phantom.torques > 0 && phantom.committed_torque.isZero(0)));
  phantom.calibration = HdCode::calibration_needs_update;
  world.run(400);
  CHECK(world.torque(phantom).norm() > 0);
  world.unplug(phantom);
  world.run(3);
  CHECK(device.status() == DeviceStatus::communication_lost);
  CHECK(world.torque(phantom).isZero(0));
  world.plug(phantom);
  device.start(servo);
  world.run(400);
  CHECK(world.torque(phantom).norm() > 0);
  device.stop();
  CHECK(world.violations() == 0);
}
