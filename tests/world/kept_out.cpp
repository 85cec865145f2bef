// Ends that a hand leads where a body keeps them out, and contacts close beside them: no force that no rod has is ok.
#include <algorithm>
#include <cmath>
#include <vector>

#include "body_scenes.hpp"
#include "once_world.hpp"
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

// Down beside a sphere, which the rod touches before its end would.
TEST_CASE("a step of time takes no end past what the rod beside it bends round", "[world][mass]") {
  RodMaterial steel = spring_steel;
  steel.density = 7850;
  for (const int parts : {4, 16}) {
    Rod rod(0.2, RodSection::circle(2 * radius), steel, clamped, free_end);
    rod.place_left({{0, 0, 3 * radius}, {1, 0, 0}, {0, 1, 0}});
    World<RoundRod> world({{rod, 16}}, {RigidBody::sphere({0.002, 0, -0.005}, 0.005)});
    int refused = 0;
    for (int k = 0; k < 60; ++k) {
      const Point at(0, 0, 3 * radius - 5e-5 * k);
      REQUIRE(world.hold(0, RodSide::left, {at, {1, 0, 0}, {0, 1, 0}}) == Status::ok);
      const Status status = world.step(1e-3, parts);
      const bool inside = (at - Point(0.002, 0, -0.005)).norm() < 0.005 + radius;
      CHECK((!inside || status == Status::out_of_range));
      CHECK((world.shape(0).at(0).r - Point(0.002, 0, -0.005)).norm() > 0.005 + 0.95 * radius);
      refused += inside;
    }
    CHECK(refused > 10);
  }
}

TEST_CASE("a joint that something else holds apart has no answer", "[world][joints]") {
  const auto wire = [](const RodPose& pose) { return WorldRod{needle(0.2, 2 * radius, pose), 16}; };
  const RodPose across{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, along{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto ball = [](double x) { return RigidBody::sphere({x, 0, 0}, radius / 2); };
  std::vector<World<RoundRod>> worlds;
  worlds.emplace_back(std::vector<WorldRod>{wire(along)}, std::vector<RigidBody>{ball(0)},
                      std::vector<Joint>{{{0, 1}, {0, 0}}});
  worlds.emplace_back(std::vector<WorldRod>{wire(along)}, std::vector<RigidBody>{ball(0.1), ball(0.1)},
                      std::vector<Joint>{{{0, 1}, {0.1, 0}}, {{0, 2}, {0.1, 0}}});
  worlds.emplace_back(std::vector<WorldRod>{wire(along), wire(across)}, std::vector<RigidBody>{},
                      std::vector<Joint>{{{0, 1}, {0, 0}}});
  for (World<RoundRod>& world : worlds) {
    CHECK(world.tick() == Status::ok);
    for (int k = 1; k <= 20; ++k) {
      RodPose away{{0, 0, 1e-3 * k}, {1, 0, 0}, {0, 1, 0}};
      if (world.place(0, away) != Status::ok) REQUIRE(world.hold(0, RodSide::left, away) == Status::ok);
      CHECK_FALSE(is_answer(world.tick()));
    }
  }
}

// Beside a clamp, as a sphere comes down or the clamp does.  What is said to be in range is as exact as the pages say.
TEST_CASE("a contact close beside a clamp is in range where its force is right", "[world]") {
  double worst = 0;
  int in_range = 0, beyond = 0;
  for (const int elements : {8, 32})
    for (const double x : {0.002, 0.003, 0.005, 0.01})
      for (const double size : {2 * radius, 10 * radius}) {
        const Rod rod = needle(0.2, 2 * radius, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        const RigidBody sphere = RigidBody::sphere({x, 0, size + radius}, size);
        World<RoundRod> coarse({{rod, elements}}, {sphere}), fine({{rod, 256}}, {sphere});
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
  CHECK(in_range > 300);
  CHECK(beyond > 500);
  CHECK(worst < 0.015);
}
