// No rod passes another: random hands press one across another, slip off its tip, and lead it where there is no place.
#include <algorithm>
#include <cmath>
#include <vector>

#include "crossed.hpp"
#include "once_world.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Line = Centreline<double, 3>;

/// Whether one has passed below the other: seen from above, crossings count by which way they lead over it, and those below add up to one.  A curve that
/// goes below another and comes back has none in sum, and so has one that has left over an end.
bool has_passed(const Line& a, const Line& b) {
  constexpr int parts = 100;
  const auto points = [](const Line& line) {
    std::vector<Point> all;
    for (int i = 0; i <= parts; ++i) all.push_back(line.at(i * line[line.segments()].s / parts).r);
    return all;
  };
  const std::vector<Point> p = points(a), q = points(b);
  int all = 0, below = 0;
  for (std::size_t i = 0; i < parts; ++i)
    for (std::size_t j = 0; j < parts; ++j) {
      const Point d = p[i + 1] - p[i], e = q[j + 1] - q[j], w = q[j] - p[i];
      const double det = d.x() * e.y() - d.y() * e.x(), t = (w.x() * e.y() - w.y() * e.x()) / det,
                   u = (w.x() * d.y() - w.y() * d.x()) / det;
      if (!(t >= 0 && t < 1 && u >= 0 && u < 1)) continue;
      const int way = det > 0 ? 1 : -1;
      all += way;
      if (t * d.z() < w.z() + u * e.z()) below += way;
    }
  return all != 0 && below != 0;
}

struct Passed {
  int ticks = 0, answered = 0, snapped = 0, wrong = 0, not_finite = 0;
};

void press_across(Random& random, const Friction& friction, Passed& passed) {
  const double da = random(0.001, 0.003), db = random(0.0008, 0.003), reach = (da + db) / 2;
  const auto stiff = [&] {
    const double young = std::pow(10, random(8, 11.3));
    return RodMaterial{young, young / 2.6};
  };
  Crossing at;
  at.angle = random(0.25, pi / 2);
  const Point way = at.way(), base = Point(random(0.05, 0.2), 0, 1.2 * reach) - random(0.05, 0.15) * way;
  Rod top(0.2, RodSection::circle(da), stiff(), RodSupport::clamped, RodSupport::free);
  top.place_left({base, way, {0, 0, 1}});
  const Rod wire(0.25, RodSection::circle(db), stiff(), RodSupport::clamped,
                 random(1.0) > 0 ? RodSupport::clamped : RodSupport::free);
  World<RoundRod> world({{top, random.integer(6, 20), friction}, {wire, random.integer(6, 20)}});
  const double step = reach * std::pow(10, random(-1, 0.903)), depth = random(0.01, 0.12),
               tilt = random(0.3) / depth;
  const Point onward(random(0.5), random(0.5), -1);
  for (double z = step; z < depth; z += step) {
    at.tilt = tilt * z;
    RodPose pose = at.pose();
    pose.at = base + z * onward;
    REQUIRE(world.hold(0, RodSide::left, pose) == Status::ok);
    const Status status = world.tick();
    ++passed.ticks;
    for (const int rod : {0, 1})
      for (const auto& node : world.shape(rod)) passed.not_finite += !is_finite(node);
    passed.not_finite += !world.held(0, RodSide::left).force.allFinite();
    // From where it has fallen to, it may go below.
    if (status == Status::snapped) return void(++passed.snapped);
    if (status != Status::ok) continue;
    ++passed.answered;
    passed.wrong += has_passed(world.shape(0), world.shape(1));
  }
}

}  // namespace

TEST_CASE("rods that are pressed across each other stay on their sides", "[world]") {
  Random random(44);
  Passed passed;
  for (int k = 0; k < 60; ++k) press_across(random, k % 3 == 0 ? Friction(0.3) : Friction(), passed);
  INFO(passed.ticks << " ticks, " << passed.answered << " answered, " << passed.snapped << " snapped");
  CHECK(passed.wrong == 0);
  CHECK(passed.not_finite == 0);
  CHECK(passed.answered > passed.ticks * 8 / 10);
  CHECK(passed.snapped > 5);
}

TEST_CASE("a rod that is drawn over another slips off with its tip", "[world]") {
  Crossing at;
  at.off = {0, 0, 1e-4};
  World<RoundRod> world = crossed_rods<RoundRod>(at, 16);
  Crossing down = at;
  down.off = {0, 0, -0.01};
  REQUIRE(lead(world, at, down, 20) == Status::ok);
  Status last = Status::ok;
  int snaps = 0;
  double reached = 0;
  for (int k = 1; k <= 160; ++k) {
    Crossing back = down;
    back.off -= 5e-4 * k * at.way();
    last = lead(world, back);
    snaps += last == Status::snapped;
    if (world.contacts() > 0) reached = std::max(reached, world.contact(0).s[0]);
  }
  CHECK(snaps == 1);
  CHECK(reached == Approx(0.2));
  CHECK(last == Status::ok);
  CHECK(world.contacts() == 0);
  CHECK(world.held(0, RodSide::left).force.norm() < 1e-9);
}

namespace {

Rod held_rod(double length, double thickness, const RodPose& pose,
             const RodSupport& right = RodSupport::free) {
  Rod rod(length, RodSection::circle(thickness), spring_steel, RodSupport::clamped, right);
  rod.place_left(pose);
  return rod;
}

/// Leads the first rod's clamp along a way.   @return whether all is finite all along
template <class Element>
bool stays_finite(World<Element>& world, const RodPose& from, const Point& way, int ticks) {
  bool finite = true;
  for (int k = 1; k <= ticks; ++k) {
    RodPose pose = from;
    pose.at += double(k) / ticks * way;
    REQUIRE(world.hold(0, RodSide::left, pose) == Status::ok);
    (void)world.tick();
    finite = finite && world.held(0, RodSide::left).force.allFinite() &&
             world.held(0, RodSide::left).moment.allFinite();
    for (int rod = 0; rod < world.rods(); ++rod)
      for (const auto& node : world.shape(rod)) finite = finite && is_finite(node);
    for (int c = 0; c < world.contacts(); ++c) finite = finite && world.contact(c).force.allFinite();
  }
  return finite;
}

}  // namespace

TEST_CASE("rods that lie against each other in odd ways have a status", "[world]") {
  const RodPose along{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  const auto run = [](const RodPose& pose, const Point& way, const RodPose& other, double thickness,
                      const RodSupport& right = RodSupport::free) {
    INFO("from " << pose.at.transpose() << " by " << way.transpose());
    World<RoundRod> round({{held_rod(0.1, thickness, pose), 8}, {held_rod(0.1, thickness, other, right), 8}});
    CHECK(stays_finite(round, pose, way, 40));
    World<TwistedRod> twisted(
        {{held_rod(0.1, thickness, pose), 8}, {held_rod(0.1, thickness, other, right), 8}});
    CHECK(stays_finite(twisted, pose, way, 40));
  };
  // Parallel, side by side and the other way round.
  run({{0, 0, 0.0021}, {1, 0, 0}, {0, 0, 1}}, {0, 0, -0.005}, along, 0.002);
  run({{0.1, 0, 0.0021}, {-1, 0, 0}, {0, 0, 1}}, {0, 0, -0.005}, along, 0.002);
  run({{0, 0, 0.0021}, {1, 0, 0}, {0, 0, 1}}, {0, 0, -0.005}, along, 0.002, RodSupport::clamped);
  // On one axis, tip on tip; past it; tip on clamp.
  run({{0.2022, 0, 0}, {-1, 0, 0}, {0, 0, 1}}, {-0.01, 0, 0}, along, 0.002);
  run({{0.2022, 0, 0.001}, {-1, 0, 0}, {0, 0, 1}}, {-0.01, 0, 0}, along, 0.002);
  run({{-0.1022, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {0.01, 0, 0}, along, 0.002);
  // Tips across each other, on a node, and on the clamp.
  run({{0.1, -0.1, 0.0021}, {0, 1, 0}, {0, 0, 1}}, {0, 0, -0.01}, along, 0.002);
  run({{0.05, -0.05, 0.0021}, {0, 1, 0}, {0, 0, 1}}, {0, 0, -0.01}, along, 0.002);
  run({{0, -0.05, 0.0021}, {0, 1, 0}, {0, 0, 1}}, {0, 0, -0.01}, along, 0.002);
  // So thin that every step is too long.
  run({{0.05, -0.05, 1e-8}, {0, 1, 0}, {0, 0, 1}}, {0, 0, -0.01}, along, 1e-9);
}

TEST_CASE("where no way leads to where a hand waits, rods begin anew at rest", "[world]") {
  // A clamp that is led through another one.
  const RodPose above{{0, 0, 0.0021}, {1, 0, 0}, {0, 0, 1}}, along{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  const RodPose across{{0.08, -0.05, 0.0043}, {0, 1, 0}, {0, 0, 1}};
  World<RoundRod> world({{held_rod(0.1, 0.002, above), 8},
                         {held_rod(0.1, 0.002, along), 8},
                         {held_rod(0.1, 0.002, across, RodSupport::clamped), 8}});
  const Point tip = world.shape(0).at(0.1).r;
  // From where its tip presses a third one.
  RodPose within = turned(above, Point(0, 1, 0), -0.03);
  REQUIRE(world.hold(0, RodSide::left, within) == Status::ok);
  REQUIRE(world.tick() == Status::ok);
  REQUIRE(world.contacts() > 0);
  within.at.z() = 0.001;
  REQUIRE(world.hold(0, RodSide::left, within) == Status::ok);
  int begun = 0;
  for (int tick = 0; tick < 100; ++tick) {
    CHECK(!is_answer(world.tick()));
    begun += world.contacts() == 0 && (world.shape(0).at(0.1).r - tip).norm() == 0;
  }
  CHECK(begun > 0);
  REQUIRE(world.hold(0, RodSide::left, above) == Status::ok);
  Status status = world.tick();
  for (int tick = 0; tick < 40 && status != Status::ok; ++tick) status = world.tick();
  CHECK(status == Status::ok);
  CHECK(world.contacts() == 0);
}

TEST_CASE("a rod may lie on more others than there is room for", "[world]") {
  constexpr int wires = 20;
  const RodPose pose{{-0.01, 0, 0.00201}, {1, 0, 0}, {0, 0, 1}};
  std::vector<WorldRod> rods{{held_rod(0.1, 0.002, pose), 4}};
  for (int k = 0; k < wires; ++k)
    rods.push_back(
        {held_rod(0.04, 0.002, {{0.004 * k, -0.02, 0}, {0, 1, 0}, {0, 0, 1}}, RodSupport::clamped), 4});
  World<RoundRod> world(rods);
  CHECK(stays_finite(world, pose, {0, 0, -0.003}, 30));
  CHECK(world.contacts() > 1);
  CHECK(world.contacts() <= World<RoundRod>::most_contacts);
}

TEST_CASE("a world rejects rods that lie in each other", "[world]") {
  const RodPose along{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, across{{0.05, -0.05, 0.0009}, {0, 1, 0}, {0, 0, 1}};
  CHECK_THROWS_WITH(World<RoundRod>({{held_rod(0.1, 0.002, along), 8}, {held_rod(0.1, 0.002, across), 8}}),
                    Catch::Matchers::ContainsSubstring("rod 0 and rod 1 = 0.45"));
  CHECK_THROWS_WITH(World<RoundRod>(std::vector<WorldRod>{}), Catch::Matchers::ContainsSubstring("rods = 0"));
}

TEST_CASE("a world takes poses of ends that can be placed alone", "[world]") {
  World<RoundRod> world({{held_rod(0.1, 0.002, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}), 8}});
  CHECK(world.hold(0, RodSide::right, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}) == Status::invalid_request);
  for (const int none : {-1, world.rods(), 1000000})
    CHECK(world.hold(none, RodSide::left, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}) == Status::invalid_request);
  for (const double far_away : {double(NAN), 1e80, 1e8})
    CHECK(world.hold(0, RodSide::left, {{0, far_away, 0}, {1, 0, 0}, {0, 0, 1}}) == Status::invalid_request);
  for (const double size : {1e300, 1e-300, 0.0}) {
    CHECK(world.hold(0, RodSide::left, {{0, 0, 0}, {size, 0, 0}, {0, 0, 1}}) == Status::invalid_request);
    CHECK(world.hold(0, RodSide::left, {{0, 0, 0}, {1, 0, 0}, {0, size, size}}) == Status::invalid_request);
  }
  CHECK(world.tick() == Status::ok);
  CHECK(world.held(0, RodSide::left).force.norm() == 0);
}

TEST_CASE("a strip that a needle draws too taut edgewise for its elements says so", "[world]") {
  const double length = 0.2, width = 0.001, height = 0.0005;
  const auto pressed = [&](int elements, double depth) {
    Rod strip(length, RodSection::rectangle(width, height), spring_steel, RodSupport::clamped,
              RodSupport::clamped);
    Rod tool(0.1, RodSection::circle(0.004), spring_steel, RodSupport::clamped, RodSupport::free);
    const Point across = strip.left_pose().director;
    const Point aside = detail::cross3<double>(Point(1, 0, 0), across);
    RodPose above{Point(0.09, 0, 0) + 0.00226 * across - 0.05 * aside, aside, Point(1, 0, 0)};
    tool.place_left(above);
    World<TwistedRod> world({{tool, 6}, {strip, elements}});
    Status status = Status::ok;
    for (int k = 1; k <= 100; ++k) {
      RodPose hand = above;
      hand.at -= depth * k / 100 * across;
      CHECK(world.hold(0, RodSide::left, hand) == Status::ok);
      status = world.tick();
    }
    CHECK(world.contacts() >= 1);
    return status;
  };
  CHECK(pressed(8, 0.0005) == Status::ok);
  CHECK(pressed(8, 0.002) == Status::out_of_range);
}

// While they fall the hand goes on by several reaches a tick.
TEST_CASE("what a hand tears off in haste is at rest once the hand is", "[world]") {
  for (const double deep : {0.004, 0.01, 0.02})
    for (const double speed : {3, 4, 6, 8})
      for (const Point& way : {Point(0, -1, 0), Point(1, 0, 0), Point(0, 0, 1)}) {
        Rod tool(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
        const Rod wire(0.25, RodSection::circle(0.0015), spring_steel, RodSupport::clamped,
                       RodSupport::clamped);
        RodPose hand{{0.18, -0.15, 0.00185}, {0, 1, 0}, {0, 0, 1}};
        tool.place_left(hand);
        World<RoundRod> world({{tool, 8}, {wire, 8}});
        const auto move = [&](const Point& by) {
          hand.at += by;
          REQUIRE(world.hold(0, RodSide::left, hand) == Status::ok);
          return world.tick();
        };
        for (int k = 0; k < 100; ++k) REQUIRE(is_answer(move({0, 0, -deep / 100})));
        for (int k = 0; k < 30; ++k) (void)move(speed * crossed_reach * way);
        for (int k = 0; k < 3; ++k) (void)world.tick();
        CAPTURE(deep, speed, way.transpose());
        CHECK(world.tick() == Status::ok);
        CHECK(world.contacts() == 0);
        CHECK(world.held(0, RodSide::left).force.norm() < 1e-9);
      }
}
