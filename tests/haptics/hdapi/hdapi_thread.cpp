// The adapter in real time: the servo on the scheduler's thread, everything else on others.
#include <chrono>
#include <thread>

#include "haptics/hdapi/hdapi_support.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

/// Until a condition holds, ten seconds at most: by the clock, for half a millisecond of sleep is none on Windows.
template <typename Condition>
bool wait_for(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  return false;
}

HdapiOptions named(const char* name) {
  HdapiOptions options;
  options.device = name;
  options.ramp_time = 0.02;
  return options;
}

}  // namespace

TEST_CASE("it starts and stops again and again while others watch", "[hdapi][thread]") {
  HdWorld world(HdWorld::Time::real);
  auto& phantom = world.plug("one", HandPath({0, -0.01}).rest(1000));
  RealTimeHdapi device(named("one"));
  std::atomic<bool> done{false};
  std::uint64_t seen = 0;
  std::thread watcher([&] {
    while (!done) {
      seen += device.running() + device.counts().ticks + device.counts().missed_ticks;
      static_cast<void>(name(device.status()));
      std::this_thread::yield();
    }
  });
  for (int round = 0; round < 20; ++round) {
    Floor floor;
    device.start(floor);
    CHECK(wait_for([&] { return device.counts().ticks >= 3; }));
    device.stop();
    CHECK(floor.calls == device.counts().ticks);
    CHECK(floor.resets == 1);
    CHECK(world.motors(phantom) == Eigen::Vector3d::Zero());
    CHECK(device.status() == DeviceStatus::stopped);
  }
  done = true;
  watcher.join();
  CHECK(world.violations() == 0);
  CHECK(world.last_violation().empty());
  CHECK(seen > 0);
}

TEST_CASE("faults from anywhere end or ease a loop that runs, and it runs again", "[hdapi][thread]") {
  HdWorld world(HdWorld::Time::real);
  auto& left = world.plug("left", HandPath({0, -0.01}).rest(1000));
  auto& right = world.plug("right", HandPath({0, -0.01}).rest(1000));
  RealTimeHdapi on_left(named("left")), on_right(named("right"));
  for (int round = 0; round < 5; ++round) {
    Floor first, second;
    on_left.start(first);
    on_right.start(second);
    CHECK(wait_for([&] { return world.motors(left).y() > 1 && world.motors(right).y() > 1; }));
    CHECK(wait_for([&] { return on_right.counts().ticks > 30; }));
    const std::uint64_t cut = on_right.counts().force_cut_ticks;
    world.raise(HdCode::exceeded_max_force_impulse, &right);
    CHECK(wait_for([&] { return on_right.counts().force_cut_ticks > cut; }));
    world.unplug(left);
    CHECK(wait_for([&] { return on_left.status() == DeviceStatus::communication_lost; }));
    CHECK(world.motors(left) == Eigen::Vector3d::Zero());
    CHECK(on_right.running());
    on_left.stop();
    sleep_ms(2);
    CHECK(on_right.running());
    on_right.stop();
    CHECK(second.resets == 2);
    CHECK(first.resets == 1);
    world.plug(left);
  }
  CHECK(world.violations() == 0);
}

TEST_CASE("a second device comes and goes beside one that runs", "[hdapi][thread]") {
  HdWorld world(HdWorld::Time::real);
  world.plug("left", HandPath({0, -0.01}).rest(1000));
  auto& right = world.plug("right", HandPath({0, -0.01}).rest(1000));
  RealTimeHdapi on_left(named("left")), on_right(named("right"));
  Floor first;
  on_left.start(first);
  for (int round = 0; round < 20; ++round) {
    Floor second;
    on_right.start(second);
    CHECK(wait_for([&] { return on_right.counts().ticks >= 2; }));
    on_right.stop();
    CHECK(second.calls == on_right.counts().ticks);
    CHECK(world.motors(right) == Eigen::Vector3d::Zero());
  }
  CHECK(on_left.running());
  on_left.stop();
  CHECK(first.calls == on_left.counts().ticks);
  CHECK(first.resets == 1);
  CHECK(world.violations() == 0);
  CHECK(world.last_violation().empty());
}

TEST_CASE("a device that calibrates itself is stopped while it waits, and felt once it knows",
          "[hdapi][thread]") {
  HdWorld world(HdWorld::Time::real);
  auto& waits = world.plug("waits", HandPath({0, -0.01}).rest(1000));
  auto& moves = world.plug("moves", HandPath({0, -0.01}).rest(1000));
  waits.styles = HdCode::calibration_inkwell;
  waits.calibration = HdCode::calibration_needs_manual_input;
  moves.styles = HdCode::calibration_auto;
  moves.calibration = HdCode::calibration_needs_update;
  RealTimeHdapi on_waits(named("waits")), on_moves(named("moves"));
  Floor first, second;
  on_moves.start(second);
  for (int round = 0; round < 10; ++round) {
    on_waits.start(first);
    CHECK(on_waits.status() == DeviceStatus::calibrating);
    sleep_ms(2);
    on_waits.stop();
    CHECK(on_waits.status() == DeviceStatus::stopped);
  }
  CHECK(first.calls == 0);
  CHECK(wait_for([&] { return on_moves.status() == DeviceStatus::running && world.motors(moves).y() > 1; }));
  on_moves.stop();
  CHECK(second.resets == 1);
  CHECK(moves.updates == 1);
  CHECK(world.violations() == 0);
  CHECK(world.last_violation().empty());
}
