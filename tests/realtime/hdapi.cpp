// A tick behind HDAPI: no heap, no exception, when all is well and in the ticks in which something breaks.
#include <realtime/heap_watch.hpp>

#include "haptics/hdapi/hdapi_support.hpp"
#include "support/catch.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/servo/exchange.hpp>
#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/haptics/servo/tick_times.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Placement, contact, beam, times, and the newest state for a picture.
struct Servo {
  explicit Servo(FemModel<>& model) : touch(model, 0.01) {}
  Touch<FemModel<>> touch;
  Placement placement = Placement::in_plane({1.27, 0});
  TickTimes times{1e-3};
  Exchange<DeviceState> newest{DeviceState{}};
  int pressing = 0;
  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    times.begin();
    if (state.reset) touch.reset();
    const auto felt = touch.tick(placement.beam_position(state.position));
    pressing += felt.pressing;
    newest.publish(state);
    times.end();
    return placement.device_force_of_beam(felt.force * 0.1);
  }
};

}  // namespace

TEST_CASE("a tick behind HDAPI: no heap, faults and the end included") {
  HdWorld world;
  auto& phantom = world.plug("one", HandPath({0, 0.03}).press(0.025, 0.2).rest(10));
  LockStepHdapi device;
  FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 16);
  Servo servo(model);
  device.start(servo);
  CHECK(heap_use([&] {
          world.run(600);
          world.raise(HdCode::exceeded_max_force, &phantom);
          world.run(100);
          phantom.temperature = 0.9;
          world.run(100);
          world.be_late(3);
          world.tick();
          for (int i = 0; i < 50; ++i) world.raise(HdCode::warm_motors, &phantom);
          world.run(3);
          world.unplug(phantom);
          world.run(3);
        }) == HeapUse{});
  CHECK(servo.pressing > 500);
  CHECK(device.status() == DeviceStatus::communication_lost);
  CHECK(world.violations() == 0);
  CHECK(heap_use([&] {
          servo.newest.update();
          keep(servo.newest.value());
          keep(servo.times.compute().summary());
          keep(device.counts());
        }) == HeapUse{});
}

TEST_CASE("a device that calibrates itself behind HDAPI: no heap, before it has and when it must again") {
  HdWorld world;
  auto& phantom = world.plug("one", HandPath({0, 0.03}).press(0.025, 0.2).rest(10));
  phantom.styles = HdCode::calibration_inkwell;
  phantom.calibration = HdCode::calibration_needs_manual_input;
  LockStepHdapi device;
  FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 16);
  Servo servo(model);
  device.start(servo);
  CHECK(heap_use([&] {
          world.run(300);
          phantom.calibration = HdCode::calibration_needs_update;
          world.run(900);
          phantom.calibration = HdCode::calibration_needs_update;
          world.run(300);
        }) == HeapUse{});
  CHECK(phantom.updates == 2);
  CHECK(servo.pressing > 500);
  CHECK(world.violations() == 0);
}

TEST_CASE("heap watch: what a servo allocates is seen through the C callback") {
  HdWorld world;
  world.plug("one", press_and_hold());
  LockStepHdapi device;
  struct {
    Eigen::Vector3d operator()(const DeviceState& state) noexcept {
      auto* copy = new DeviceState(state);
      keep(copy);
      delete copy;
      return Eigen::Vector3d::Zero();
    }
  } servo;
  device.start(servo);
  CHECK(heap_use([&] { world.run(5); }) == HeapUse{5, 5});
}
