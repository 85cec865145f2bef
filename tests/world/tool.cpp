// A flexible tool in the hand that touches a wire: springs, energy, and the loop of a servo.
#include <cmath>

#include "crossed.hpp"
#include "once_world.hpp"
#include "support/catch.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/held/grip.hpp>
#include <hapbeam/world/world_tool.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// The tool of crossed.hpp on springs, above a wire that is held at both ends.
World<TwistedRod> tool_and_wire(const RodSupport& held, const Crossing& at) {
  Rod tool(0.2, RodSection::circle(0.002), spring_steel, held, RodSupport::free);
  tool.place_left(at.pose());
  const Rod wire(0.25, RodSection::circle(0.0015), spring_steel, RodSupport::clamped, RodSupport::clamped);
  return World<TwistedRod>({{tool, 8}, {wire, 8}});
}

}  // namespace

TEST_CASE("an end on springs is held by their force, and what a hand does is stored", "[world][grip]") {
  const double k = 1000, t = 2;
  Crossing at;
  World<TwistedRod> world = tool_and_wire(RodSupport::elastic(k, k, k, t, t, t), at);
  double work = 0;
  constexpr int ticks = 400;
  const Point step(5e-6, 1e-5, -2e-5);
  for (int i = 0; i < ticks; ++i) {
    const Point before = world.held(0, RodSide::left).force;
    at.off += step;
    REQUIRE(lead(world, at) == Status::ok);
    work += (before + world.held(0, RodSide::left).force).dot(step) / 2;
  }
  REQUIRE(world.contacts() == 1);
  const HeldEnd<double> held = world.held(0, RodSide::left);
  const RodNode<double> end = world.shape(0)[0];
  CHECK((held.force - k * (at.pose().at - end.r)).norm() < 1e-9 * held.force.norm());
  // The tool is in balance.
  const RodContact contact = world.contact(0);
  CHECK((held.force + contact.force).norm() < 1e-9 * held.force.norm());
  // The trapezoid's error is the third difference of the energy: of its relative part (1/400)² and a number.
  CHECK(world.strain_energy() == Approx(work).epsilon(1e-5));
}

TEST_CASE("a hand that leaps is followed in the ticks after", "[world][grip]") {
  const double k = 500;
  const RodSupport springs = RodSupport::elastic(k, k, k, 1, 1, 1);
  Crossing at, down;
  at.off = {0, 0, 1e-4};
  down.off = {0.002, 0.001, -0.03};
  World<TwistedRod> slow = tool_and_wire(springs, at), fast = tool_and_wire(springs, at);
  REQUIRE(lead(slow, at, down, 400) == Status::ok);
  // Seventeen reaches in a tick.
  Status status = lead(fast, down);
  CHECK(status == Status::iteration_limit);
  for (int tick = 0; tick < 20 && status != Status::ok; ++tick) status = lead(fast, down);
  CHECK(status == Status::ok);
  const Point force = slow.held(0, RodSide::left).force;
  CHECK((fast.held(0, RodSide::left).force - force).norm() < 1e-6 * force.norm());
}

TEST_CASE("a tick that ends on the way stands for a hand there", "[world][grip]") {
  const double k = 500;
  int ended = 0;
  for (int depth = 1; depth <= 12; ++depth) {
    Crossing at, down;
    at.off = {0, 0, 1e-4};
    down.off = {0.002, 0.001, -0.006 * depth};
    World<TwistedRod> world = tool_and_wire(RodSupport::elastic(k, k, k, 1, 1, 1), at);
    if (lead(world, down) != Status::iteration_limit) continue;
    ++ended;
    // All that is stored belongs to where that hand is.
    const double stored = world.strain_energy();
    down.off += world.shape(0)[0].r + world.held(0, RodSide::left).force / k - down.pose().at;
    CHECK(lead(world, down) == Status::ok);
    CHECK(world.strain_energy() == Approx(stored).epsilon(1e-7));
  }
  CHECK(ended > 5);
}

TEST_CASE("a hand feels through its coupling what a tool touches", "[world][grip]") {
  VirtualPhantomOptions options;
  options.gimbal.present = true;
  const DeviceInfo device = VirtualPhantom<>(HandPath({0, 0}), options).info();
  const GripCoupling coupling = GripCoupling::for_device(device);
  Crossing at;
  at.off = {0, 0, 1e-4};
  World<TwistedRod> world = tool_and_wire(coupling.support(), at);
  WorldTool<TwistedRod> tool(world, 0);
  Grip<WorldTool<TwistedRod>> grip(tool, RodSide::left);
  Servo<Grip<WorldTool<TwistedRod>>> servo(grip, device);
  Wrench felt;
  for (int tick = 0; tick < 1500; ++tick) {
    OrientedState state;
    state.position = {0, 0, -0.005 * std::min(1.0, tick / 500.0)};
    state.time = 1e-3 * tick, state.reset = tick == 0;
    felt = servo.tick(state);
    REQUIRE(felt.force.allFinite());
  }
  CHECK(servo.record().model == Status::ok);
  REQUIRE(world.contacts() == 1);
  // At rest the hand carries what the wire pushes up with.
  const Point push = world.contact(0).force;
  CHECK(push.z() > 0.05);
  CHECK((felt.force - push).norm() < 1e-3 * push.norm());
}
