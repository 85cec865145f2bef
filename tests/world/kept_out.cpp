// Ends that a hand leads where a body keeps them out, and contacts close beside them: no force that no rod has is ok.
#include <algorithm>
#include <cmath>
#include <vector>

#include "body_scenes.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double radius = 0.001;
const RodPose lying{{0, 0, 1.5 * radius}, {1, 0, 0}, {0, 1, 0}};

RodPose at_height(double z) {
  RodPose pose = lying;
  pose.at.z() = z;
  return pose;
}

/// Its tip pressed on a floor, its end led down to that, into it and up again.
template <class Element>
void check_floor(const RigidBody& floor) {
  for (const double deep : {1e-3, 0.01, 0.5, 0.9, 3.0}) {
    World<Element> world({{needle(0.2, 2 * radius, lying), 8}}, {floor});
    const auto tick_at = [&](double z, double tilt) {
      REQUIRE(world.hold(0, RodSide::left, turned(at_height(z), Point(0, 1, 0), tilt)) == Status::ok);
      return world.tick();
    };
    for (int k = 0; k < 40; ++k) REQUIRE(tick_at(1.5 * radius, 5e-4 * k) == Status::ok);
    for (int k = 0; k < 40; ++k) REQUIRE(tick_at((1.5 - 0.01 * k) * radius, 0.02) == Status::ok);
    const Point force = world.held(0, RodSide::left).force;
    REQUIRE(world.contacts() > 0);
    for (int k = 0; k < 5; ++k) {
      CHECK(tick_at((1 - deep) * radius, 0.02) == Status::out_of_range);
      CHECK(world.held(0, RodSide::left).force == force);
      CHECK(world.solves() == 0);
    }
    // And back.
    for (int k = 0; k < 20; ++k) REQUIRE(tick_at((1.11 + 0.01 * k) * radius, 0.02) == Status::ok);
    CHECK(world.held(0, RodSide::left).force.norm() < force.norm());
  }
}

}  // namespace

TEST_CASE("an end that is led into a body stays where it was", "[world]") {
  check_floor<RoundRod>(RigidBody::plane({0, 0, 0}, {0, 0, 1}));
  check_floor<TwistedRod>(RigidBody::plane({0, 0, 0}, {0, 0, 1}));
  // Its core is a tenth of a metre below.
  check_floor<RoundRod>(RigidBody::field(
      [](const Point& p) {
        return SurfaceDistance{p.z(), {0, 0, 1}};
      },
      0.1, 1));
}

TEST_CASE("a body that is led onto an end that does not move stays there, too", "[world]") {
  World<RoundRod> world({{needle(0.2, 2 * radius, lying), 8}},
                        {RigidBody::sphere({0, 0, lying.at.z() + 5 * radius}, 3 * radius)});
  const auto tick_at = [&](double z) {
    REQUIRE(world.place(0, {{0, 0, z}, {1, 0, 0}, {0, 1, 0}}) == Status::ok);
    return world.tick();
  };
  CHECK(tick_at(-0.9 * radius) == Status::ok);
  CHECK(tick_at(-1.1 * radius) == Status::out_of_range);
  CHECK(world.held(0, RodSide::left).force.norm() < 1e-9);
  CHECK(tick_at(-0.9 * radius) == Status::ok);
}

// Both are clamped where they would touch: nothing gives way there.
TEST_CASE("two ends that are led into each other stay apart", "[world]") {
  World<RoundRod> world({{needle(0.2, 2 * radius, at_height(3 * radius)), 8},
                         {needle(0.2, 2 * radius, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 8}});
  double largest = 0;
  int answered = 0;
  for (int k = 1; k <= 100; ++k) {
    REQUIRE(world.hold(0, RodSide::left, at_height((3 - 0.02 * k) * radius)) == Status::ok);
    const Status status = world.tick();
    answered += status == Status::ok;
    largest = std::max(largest, world.held(0, RodSide::left).force.norm());
  }
  // They touch after 50.
  CHECK(answered >= 48);
  CHECK(answered <= 50);
  CHECK(largest < 1e-6);
}

// It stops where it touches, as exactly as steps of time tell who does.
TEST_CASE("a step of time takes no end into a body", "[world][mass]") {
  RodMaterial steel = spring_steel;
  steel.density = 7850;
  Rod rod(0.2, RodSection::circle(2 * radius), steel, clamped, free_end);
  rod.place_left(lying);
  World<RoundRod> world({{rod, 8}}, {RigidBody::plane({0, 0, 0}, {0, 0, 1})});
  double largest = 0, lowest = 1;
  for (int k = 0; k < 200; ++k) {
    REQUIRE(world.hold(0, RodSide::left, at_height((1.5 - 0.01 * k) * radius)) == Status::ok);
    const Status status = world.step(1e-3);
    CHECK((k > 50 || status == Status::ok));
    CHECK((k < 56 || status == Status::out_of_range));
    largest = std::max(largest, world.held(0, RodSide::left).force.norm());
    lowest = std::min(lowest, world.shape(0).at(0).r.z() / radius);
  }
  CHECK(lowest > 0.95);
  CHECK(largest < 1);
}

// A sphere comes down beside the clamp.  What is said to be in range is as exact as the pages say, from 8 elements to a mesh of 256.
TEST_CASE("a contact close beside a clamp is in range where its force is right", "[world]") {
  double worst = 0;
  int in_range = 0, beyond = 0;
  for (const double x : {0.003, 0.005, 0.0075, 0.01})
    for (const double size : {2 * radius, 10 * radius}) {
      const Rod rod = needle(0.2, 2 * radius, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
      const RigidBody sphere = RigidBody::sphere({x, 0, size + radius}, size);
      World<RoundRod> coarse({{rod, 8}}, {sphere}), fine({{rod, 256}}, {sphere});
      for (int k = 1; k <= 60; ++k) {
        const RodPose down{{0, 0, -2e-5 * k}, {1, 0, 0}, {0, 1, 0}};
        REQUIRE(coarse.place(0, down) == Status::ok);
        REQUIRE(fine.place(0, down) == Status::ok);
        const Status status = coarse.tick();
        beyond += status == Status::out_of_range;
        if (fine.tick() != Status::ok || status != Status::ok || fine.contacts() != 1) continue;
        ++in_range;
        const double force = normal_force(fine.contact(0));
        worst = std::max(worst, std::abs(normal_force(coarse.contact(0)) / force - 1));
      }
    }
  INFO(in_range << " in range, " << beyond << " beyond, worst " << worst);
  CHECK(in_range > 200);
  CHECK(beyond > 50);
  CHECK(worst < 0.08);
}
