// Ticks of a hand that turns: no heap, no lock, no exception, faults included.
#include <limits>
#include <realtime/heap_watch.hpp>
#include <realtime/lock_watch.hpp>

#include "haptics/hdapi/hdapi_support.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/haptics/held/grip.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Round = FemModel<RoundRod>;
using Twisted = FemModel<TwistedRod>;
using Held = Grip<Twisted>;

template <class S>
constexpr bool ticks_noexcept =
    noexcept(std::declval<S&>().tick(std::declval<const OrientedState&>())) && noexcept(
        std::declval<S&>().tick(
            std::declval<const DeviceState&>())) && noexcept(std::declval<S&>().picture()) &&
    takes_orientation<S>&& is_servo<S>;
static_assert(ticks_noexcept<Servo<Round>> && ticks_noexcept<Servo<Round, Direct>> &&
              ticks_noexcept<Servo<Held>>);
static_assert(!takes_orientation<Servo<FemModel<>>>, "a beam in a plane has no use for one");
static_assert(noexcept(std::declval<Held&>().let_go()) && noexcept(std::declval<Held&>().take()));

VirtualPhantomOptions six_axes() {
  VirtualPhantomOptions options;
  options.gimbal.present = true;
  return options;
}
Rod held_rod() {
  const DeviceInfo device = VirtualPhantom<>(HandPath({0, 0}), six_axes()).info();
  Rod rod(0.4, RodSection::circle(0.002), RodMaterial{3e9, 1.1e9}, GripCoupling::for_device(device).support(),
          RodSupport::clamped);
  return rod.place_left({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}});
}

ServoOptions across() {
  ServoOptions options;
  options.dissipate = true;
  options.stylus.length = 0.2, options.stylus.ahead = 0.1;
  options.placement = Placement(Eigen::Matrix3d::Identity(), {0.15, 0.007, 0.04});
  return options;
}

/// A stroke, a graphics that looks, and then whatever no device should give.
template <class Body>
void check_loop(Body& body, const ServoOptions& options) {
  VirtualPhantom<> device(
      HandPath({0, 0.002}).press(0.006, 0.2).turn({0.05, 0.05, 3}, 0.3).slide(0.01, 0.2).release(0.01, 0.2),
      six_axes());
  ServoLoop<VirtualPhantom<>, Body> loop(device, body, options);
  Random random(1);
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                        1e300};
  int not_finite = 0;
  const auto run = [&] {
    for (int k = 0; k < 90; ++k) {
      device.run(loop.servo(), 0.01);
      (void)loop.picture();
    }
    for (int tick = 0; tick < 500; ++tick) {
      OrientedState state;
      state.position = {random(0.02), random(0.02), random(0.02)}, state.time = 1 + 1e-3 * tick;
      state.orientation = gimbal_orientation({random(3.), random(3.), random(3.)});
      if (random(0, 1) < 0.1) state.position[random.integer(0, 2)] = bad[random.integer(0, 2)];
      if (random(0, 1) < 0.1) state.orientation(random.integer(0, 2), 2) = bad[random.integer(0, 2)];
      if (random(0, 1) < 0.1) state.time = bad[random.integer(0, 2)];
      state.reset = random(0, 1) < 0.05;
      const Wrench felt = loop.servo().tick(state);
      not_finite += !felt.force.allFinite() || !felt.torque.allFinite();
    }
    loop.servo().reset();
  };
  long locks = -1;
  CHECK(heap_use([&] { locks = locks_taken(run); }) == HeapUse{});
  CHECK(locks == 0);
  CHECK(not_finite == 0);
}

}  // namespace

TEST_CASE("a stylus on a rod, and a hand that holds one: no heap, no lock", "[realtime][torque]") {
  Round needle(Rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free), 8);
  check_loop(needle, across());
  Twisted model(held_rod(), 8);
  Held grip(model, RodSide::left);
  check_loop(grip, {});
}

TEST_CASE("a rod that is held through HDAPI: no heap, faults and the end included", "[realtime][torque]") {
  HdWorld world;
  auto& phantom =
      world.plug_turning("one", HandPath({0, 0}).press(0.02, 0.2).turn({0, 0, 6}, 0.4).rest(10), 6);
  LockStepHdapi device;
  Twisted model(held_rod(), 8);
  Held grip(model, RodSide::left);
  Servo<Held> servo(grip, device.info());
  device.start(servo);
  double most = 0;
  CHECK(heap_use([&] {
          for (int i = 0; i < 900; ++i) world.tick(), most = std::max(most, world.torque(phantom).norm());
          world.raise(HdCode::exceeded_max_force, &phantom);
          world.run(50);
          grip.let_go();
          world.run(20);
          grip.take();
          world.be_late(3);
          world.run(50);
          phantom.transform_by = std::numeric_limits<double>::quiet_NaN();
          world.run(3);
        }) == HeapUse{});
  CHECK(most > 1e-3);
  CHECK(device.status() == DeviceStatus::device_fault);
  CHECK(world.torque(phantom).isZero(0));
  CHECK(world.motors(phantom).isZero(0));
  phantom.transform_by = 1;
  device.start(servo);
  CHECK(heap_use([&] {
          world.run(800);
          world.unplug(phantom);
          world.run(3);
        }) == HeapUse{});
  CHECK(device.status() == DeviceStatus::communication_lost);
  CHECK(world.torque(phantom).isZero(0));
  CHECK(world.violations() == 0);
}
