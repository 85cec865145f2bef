// What holds whatever the discretisation: frames, names, energy, and that what nothing touches is left alone.
#include <array>
#include <cmath>
#include <vector>

#include "crossed.hpp"
#include "once_world.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// A rotation and then a displacement.
struct Motion {
  Point axis;
  double angle;
  Point by;

  Point turn(const Point& x) const { return turned({x, x, x}, axis, angle).along; }
  RodPose operator()(const RodPose& pose) const {
    return {turn(pose.at) + by, turn(pose.along), turn(pose.director)};
  }
};

/// The tool and the wire of crossed.hpp, moved, either of them first, the tool from either of its ends on.
struct Names {
  Motion motion{{0, 0, 1}, 0, {0, 0, 0}};
  bool wire_first = false, reversed = false;
  Friction friction = {};  // of the tool
};

/// Force and moment on the hand and the place on the tool after a path, as in the scene that is not moved.
template <class Element>
std::array<Point, 3> led(const Names& names) {
  const RodSupport clamped = RodSupport::clamped, free = RodSupport::free;
  Rod tool(0.2, RodSection::circle(0.002), spring_steel, names.reversed ? free : clamped,
           names.reversed ? clamped : free);
  Rod wire(0.25, RodSection::circle(0.0015), spring_steel, clamped, free);
  wire.place_left(names.motion({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  const auto pose = [&](const Crossing& at) {
    RodPose hand = at.pose();
    if (names.reversed) hand.along = -hand.along;
    return names.motion(hand);
  };
  Crossing at;
  at.angle = 1.2, at.off = {0, 0, 1e-4};
  if (names.reversed) {
    RodPose tip = pose(at);
    tip.at -= 0.2 * tip.along;
    tool.place_left(tip).place_right(pose(at));
  } else {
    tool.place_left(pose(at));
  }
  const int hand = names.wire_first ? 1 : 0;
  const WorldRod first{tool, 8, names.friction}, second{wire, 11};
  World<Element> world(names.wire_first ? std::vector<WorldRod>{second, first}
                                        : std::vector<WorldRod>{first, second});
  const RodSide side = names.reversed ? RodSide::right : RodSide::left;
  for (int k = 1; k <= 30; ++k) {
    at.off = {1e-4 * k, -2e-4 * k, 1e-4 - 5e-4 * k}, at.tilt = 0.002 * k;
    REQUIRE(world.hold(hand, side, pose(at)) == Status::ok);
    REQUIRE(world.tick() == Status::ok);
  }
  REQUIRE(world.contacts() == 1);
  const HeldEnd<double> held = world.held(hand, side);
  const double s = world.contact(0).s[static_cast<std::size_t>(hand)];
  const Motion back{names.motion.axis, -names.motion.angle, {0, 0, 0}};
  return {back.turn(held.force), back.turn(held.moment), Point(names.reversed ? 0.2 - s : s, 0, 0)};
}

template <class Element>
void check_same(const Names& names) {
  Names plain;
  plain.friction = names.friction;
  const std::array<Point, 3> one = led<Element>(plain), other = led<Element>(names);
  for (std::size_t k = 0; k < 3; ++k) CHECK((one[k] - other[k]).norm() < 1e-11 * one[k].norm());
}

}  // namespace

TEST_CASE("forces turn with the scene", "[world]") {
  const Motion motion{detail::unit(Point(1, -2, 0.5)), 2.1, {0.3, -0.2, 0.1}};
  check_same<RoundRod>({motion});
  check_same<RoundRod>({motion, false, false, 0.3});
  check_same<TwistedRod>({motion});
}

TEST_CASE("it does not matter which rod is first, nor which end is left", "[world]") {
  check_same<RoundRod>({{{0, 0, 1}, 0, {0, 0, 0}}, true, false});
  check_same<RoundRod>({{{0, 0, 1}, 0, {0, 0, 0}}, true, true});
  check_same<RoundRod>({{{0, 0, 1}, 0, {0, 0, 0}}, true, true, 0.3});
  check_same<TwistedRod>({{{0, 0, 1}, 0, {0, 0, 0}}, true, true});
}

namespace {

/// The work of a hand along a closed path in three directions, by the trapezoid, of what it has stored [-].
template <class Element>
double closed_work(int ticks, const RodSupport& end) {
  Crossing at;
  at.off = {0, 0, 1e-4};
  World<Element> world = crossed_rods<Element>(at, 8, end);
  Crossing deep = at;
  deep.off = {0, 0, -0.008};
  REQUIRE(lead(world, at, deep, 20) == Status::ok);
  const std::array<Point, 4> corners{Point(0, 0, -0.008), Point(0.025, 0.01, -0.008),
                                     Point(0.03, 0.03, -0.013), Point(-0.01, 0.02, -0.011)};
  double work = 0, most = 0;
  for (std::size_t side = 0; side < 4; ++side) {
    const Point from = corners[side], to = corners[(side + 1) % 4];
    for (int k = 1; k <= ticks; ++k) {
      const Point before = world.held(0, RodSide::left).force;
      deep.off = from + double(k) / ticks * (to - from);
      REQUIRE(lead(world, deep) == Status::ok);
      work += (before + world.held(0, RodSide::left).force).dot(to - from) / (2 * ticks);
      most = std::max(most, std::abs(work));
    }
  }
  return std::abs(work) / most;
}

template <class Element>
void check_closed_work(const RodSupport& end) {
  const double coarse = closed_work<Element>(50, end), fine = closed_work<Element>(200, end);
  INFO("50 ticks a side leave " << coarse << " of the work, 200 " << fine);
  CHECK(coarse / fine == Approx(16).epsilon(0.05));
  CHECK(fine < 4e-6);
}

}  // namespace

// The contact passes nodes of both rods.  The trapezoid is of second order: what is left is its own error, and none of the contact's.
TEST_CASE("a closed path without friction returns its work", "[world]") {
  check_closed_work<RoundRod>(RodSupport::free);
  check_closed_work<RoundRod>(RodSupport::clamped);
  check_closed_work<TwistedRod>(RodSupport::free);
}

TEST_CASE("a hand that goes on is followed in about one solve a tick", "[world]") {
  for (const RodSupport& end : {RodSupport::free, RodSupport::clamped})
    for (const Point& way : {Point(25e-6, 0, 0), Point(0, 25e-6, 0), Point(0, 0, -25e-6)}) {
      Crossing at;
      at.off = {0, 0, 1e-4};
      World<RoundRod> world = crossed_rods<RoundRod>(at, 16, end);
      Crossing deep = at;
      deep.off = {0, 0, -0.01};
      REQUIRE(lead(world, at, deep, 50) == Status::ok);
      int solves = 0;
      constexpr int ticks = 400;
      for (int k = 0; k < ticks; ++k) {
        deep.off += way;
        REQUIRE(lead(world, deep) == Status::ok);
        solves += world.solves();
      }
      CAPTURE(way.transpose());
      CHECK(solves <= 1.2 * ticks);
    }
}

TEST_CASE("a rod that nothing touches is not solved", "[world]") {
  Crossing at;
  at.off = {0, 0, 0.05};
  World<RoundRod> world = crossed_rods<RoundRod>(at, 8);
  CHECK(world.tick() == Status::ok);
  // Nothing has moved since.
  CHECK(world.tick() == Status::ok);
  CHECK(world.solves() == 0);
  const Point tip = world.shape(1).at(0.25).r;
  Crossing aside = at;
  aside.off += Point(0.01, 0.02, 0);
  CHECK(lead(world, at, aside, 5) == Status::ok);
  CHECK(world.contacts() == 0);
  CHECK((world.shape(1).at(0.25).r - tip).norm() == 0);
  CHECK(world.held(0, RodSide::left).force.norm() < 1e-9);
  // It comes to rest where it began.
  Crossing down = at;
  down.off = {0, 0, -0.01};
  CHECK(lead(world, aside, down, 100) == Status::ok);
  CHECK(world.contacts() == 1);
  CHECK((world.shape(1).at(0.25).r - tip).norm() > 0.001);
  CHECK(lead(world, down, at, 100) == Status::ok);
  CHECK(world.contacts() == 0);
  CHECK((world.shape(1).at(0.25).r - tip).norm() < 1e-9);
}

TEST_CASE("a world that is reset is as a new one", "[world]") {
  Crossing at;
  at.off = {0, 0, 1e-4};
  World<RoundRod> world = crossed_rods<RoundRod>(at, 8);
  Crossing down = at;
  down.off = {0, 0, -0.01};
  REQUIRE(lead(world, at, down, 50) == Status::ok);
  REQUIRE(world.contacts() == 1);
  world.reset();
  // No hand has said anything since.
  REQUIRE(world.tick() == Status::ok);
  CHECK(world.contacts() == 0);
  CHECK((world.shape(0)[0].r - at.pose().at).norm() == 0);
  const World<RoundRod> other = crossed_rods<RoundRod>(at, 8);
  for (const int rod : {0, 1})
    CHECK((world.shape(rod).at(0.2).r - other.shape(rod).at(0.2).r).norm() < 1e-12);
}
