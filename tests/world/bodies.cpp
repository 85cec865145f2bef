// Rods that touch planes, spheres, capsules and tubes: against a reference, and what holds whatever the discretisation.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "body_scenes.hpp"
#include "once_world.hpp"
#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/random.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

struct Bound {
  int elements;
  double tip, line;
};

template <class Element>
void check_plane(const Bound& bound, double mu) {
  constexpr double length = 0.2, radius = 0.0005;
  const Csv reference("rod_on_plane.csv");
  double tip = 0, line = 0, place = 0, across = 0;
  for (const double degrees : {30.0, 60.0, 80.0}) {
    const double angle = degrees * pi / 180;
    const Point along(std::cos(angle), -std::sin(angle), 0), first(0, radius + length * std::sin(angle), 0);
    RodPose pose{first - 1e-5 * along, along, {0, 0, 1}};
    World<Element> world({{needle(length, 2 * radius, pose), bound.elements}},
                         {RigidBody::plane({0.3, 0, 0.1}, {0, 2, 0}, mu)});
    for (std::size_t row = 0; row < reference.rows(); ++row) {
      if (reference.number(row, "angle_deg") != degrees || reference.number(row, "mu") != mu) continue;
      const Point to = first + reference.number(row, "advance") * along;
      const int steps = 1 + static_cast<int>((to - pose.at).norm() / (mu > 0 ? 2e-4 : 1e-3));
      // With friction a steep one sticks first, and buckles.
      const bool buckles = mu > 0 && degrees == 80 && reference.number(row, "advance") < 0.003;
      REQUIRE((lead(world, pose, to, steps) == Status::ok || buckles));
      pose.at = to;
      REQUIRE(world.contacts() == 1);
      const HeldEnd<double> hand = world.held(0, RodSide::left);
      const RodContact contact = world.contact(0);
      const Point pull(reference.number(row, "Fx"), reference.number(row, "Fy"), 0);
      const double F = pull.norm(), M = reference.number(row, "M");
      // Where the tip lies flat it is either.
      const bool on_tip =
          reference.text(row, "mode") == "tip" && reference.number(row, "tip_theta_deg") < -1e-3;
      double& error = on_tip ? tip : line;
      error = std::max({error, (hand.force + pull).norm() / F, std::abs((hand.moment.z() + M) / M)});
      place = std::max(place, std::abs(contact.s[0] - reference.number(row, "s_contact")) / length);
      across = std::max({across, std::abs(hand.force.x() + mu * hand.force.y()) / F,
                         (hand.force + contact.force).norm() / F});
      CHECK(contact.friction.norm() <= mu * normal_force(contact) * (1 + 1e-15));
    }
  }
  INFO(bound.elements << " elements: tip " << tip << ", line " << line << ", place " << place << ", across "
                      << across);
  CHECK(tip < bound.tip);
  CHECK(line < bound.line);
  CHECK(place < bound.line / 2);
  CHECK(across < (mu > 0 ? 1e-7 : 1e-12));
}

}  // namespace

// One contact at the lift-off is all that a rod has which lies flat beyond.
TEST_CASE("a needle on a plane is as exact as the elements, on its tip and lying flat",
          "[world][verification]") {
  for (const Bound& bound : {Bound{8, 1e-5, 2e-4}, Bound{16, 1e-6, 1.2e-5}, Bound{32, 1e-7, 8e-7}})
    check_plane<RoundRod>(bound, 0);
  check_plane<TwistedRod>({16, 1e-6, 1.2e-5}, 0);
}

// The tip slides from the start; what lies flat beyond the lift-off carries nothing.
TEST_CASE("a needle that slides over a plane with friction is as exact", "[world][friction][verification]") {
  for (const Bound& bound : {Bound{8, 1e-5, 2e-4}, Bound{16, 1e-6, 1.2e-5}, Bound{32, 1e-7, 8e-7}})
    check_plane<RoundRod>(bound, 0.2);
  check_plane<TwistedRod>({16, 1e-6, 1.2e-5}, 0.2);
}

namespace {

/// What a hand has felt at the end of its way, and the place, as in the scene that is not moved.
template <class Element>
std::vector<Point> felt(const Scene& scene, const Motion& motion) {
  INFO(scene.name);
  World<Element> world = world_of<Element>(scene, motion, 10);
  REQUIRE(lead(world, motion(RodPose{scene.start, start_along, {0, 1, 0}}), motion(scene.end), 60) ==
          Status::ok);
  REQUIRE(world.contacts() >= 1);
  const HeldEnd<double> hand = world.held(0, RodSide::left);
  Point sum = hand.force, moment = hand.moment;
  const Point at = motion(scene.end);
  for (int k = 0; k < world.contacts(); ++k) {
    const RodContact contact = world.contact(k);
    sum += contact.force;
    moment += detail::cross3<double>(contact.at[0] - at, contact.force);
  }
  CHECK(sum.norm() < 1e-12 * hand.force.norm());
  CHECK(moment.norm() < 1e-9 * hand.moment.norm());
  const Motion back{motion.axis, -motion.angle, {0, 0, 0}};
  return {back.turn(hand.force), back.turn(hand.moment),
          Point(world.contact(0).s[0], world.contact(0).s[1], 0)};
}

}  // namespace

TEST_CASE("forces of bodies turn with the scene, and are those of the hand", "[world]") {
  for (const Scene& scene : scenes) {
    check_same(scene, felt<RoundRod>(scene, {}), felt<RoundRod>(scene, elsewhere));
    check_same(scene, felt<TwistedRod>(scene, {}), felt<TwistedRod>(scene, elsewhere));
  }
}

namespace {

/// The work of a hand along a closed path, by the trapezoid, of the most that it was [-].
double closed_work(const Scene& scene, int ticks) {
  INFO(scene.name);
  RodPose pose{scene.start, start_along, {0, 1, 0}};
  NewtonRaphson exact;
  exact.relative_tolerance = 1e-10;
  World<RoundRod> world = world_of<RoundRod>(scene, {}, 8, {}, exact);
  REQUIRE(lead(world, pose, scene.end, 40) == Status::ok);
  pose.at = scene.end;
  const Point deep = (scene.end - scene.start) / 8;
  const std::vector<Point> corners{scene.end, scene.end + Point(0.02, 0, 0) + deep,
                                   scene.end + Point(0.01, 0.003, 0) + 2 * deep};
  double work = 0, most = 0;
  for (std::size_t side = 0; side < corners.size(); ++side) {
    const Point from = corners[side], to = corners[(side + 1) % corners.size()];
    for (int k = 1; k <= ticks; ++k) {
      const Point before = world.held(0, RodSide::left).force;
      CAPTURE(side, k);
      REQUIRE(lead(world, pose, from + double(k) / ticks * (to - from), 1) == Status::ok);
      pose.at = from + double(k) / ticks * (to - from);
      work += (before + world.held(0, RodSide::left).force).dot(to - from) / (2 * ticks);
      most = std::max(most, std::abs(work));
    }
  }
  return std::abs(work) / most;
}

}  // namespace

// The trapezoid is of second order: what is left is its own error, and none of the contact's.
TEST_CASE("a closed path over a body returns its work", "[world]") {
  for (const Scene& scene : scenes) {
    const double coarse = closed_work(scene, 100), fine = closed_work(scene, 400);
    INFO(scene.name << ": 100 ticks a side leave " << coarse << " of the work, 400 " << fine);
    // Where contacts come and go on the way, that is of lower order.
    CHECK(fine - coarse / 16 < (scene.name == "inside of a tube" ? 1e-7 : 1e-8));
    CHECK(fine < 1e-6);
  }
}

namespace {

struct Passed {
  int ticks = 0, answered = 0, wrong = 0, not_finite = 0;
};

/// How far a rod lies in a body at most [m], and whether all of it is on a side of the wall of a tube.
double depth_in(const Centreline<double, 3>& line, int kind, double radius, double rod) {
  constexpr int parts = 400;
  double deepest = 0;
  for (int i = 0; i <= parts; ++i) {
    const Point r = line.at(i * line[line.segments()].s / parts).r;
    const double aside = std::hypot(r.y(), r.z()), x = std::clamp(r.x(), -0.02, 0.02);
    if (kind == 0) deepest = std::max(deepest, rod - r.z());
    if (kind == 1) deepest = std::max(deepest, radius + rod - r.norm());
    if (kind == 2) deepest = std::max(deepest, radius + rod - std::hypot(aside, r.x() - x));
    if (kind == 3) deepest = std::max(deepest, rod - std::hypot(aside - radius, r.x() - x));
  }
  return deepest;
}

/// A needle from somewhere led somewhere, or what it meets led there.
void approach(Random& random, const Friction& friction, Passed& passed) {
  const int kind = random.integer(0, 3);
  const double thickness = random(0.001, 0.003),
               radius = kind == 3 ? random(0.004, 0.008) : random(0.0, 0.01);
  const std::vector<RigidBody> bodies{RigidBody::plane({0, 0, 0}, {0, 0, 1}),
                                      RigidBody::sphere({0, 0, 0}, radius),
                                      RigidBody::capsule({-0.02, 0, 0}, {0.02, 0, 0}, radius),
                                      RigidBody::tube({-0.02, 0, 0}, {0.02, 0, 0}, radius)};
  const double young = std::pow(10, random(8, 11.3));
  // Into the tube, down on all others.
  const Point along =
      kind == 3 ? Point(1, random(0.05), random(0.05)) : Point(random(1.0), random(1.0), random(-0.6, -0.1));
  const RodPose start{kind == 3 ? Point(-0.2 - thickness, 0, 0)
                                : Point(Point(random(0.01), random(0.01), 0.03) - 0.1 * detail::unit(along)),
                      along,
                      {0, 0.3, 1}};
  Rod rod(kind == 3 ? 0.16 : 0.1, RodSection::circle(thickness), RodMaterial{young, young / 2.6}, clamped,
          free_end);
  rod.place_left(start);
  World<RoundRod> world({{rod, random.integer(6, 20), friction}}, {bodies[static_cast<std::size_t>(kind)]});
  const double reach = thickness / 2 + (kind == 1 || kind == 2 ? radius : 0),
               step = reach * std::pow(10, random(-1, 0.903));
  const bool hand_leads = random(1.0) > 0;
  const Point way = kind == 3 ? Point(1, random(0.1), random(0.1)) : Point(random(0.3), random(0.3), -1);
  for (double z = step; z < 0.06; z += step) {
    RodPose pose = start, body;
    if (hand_leads) pose.at += z * way;
    else body.at -= z * way;
    REQUIRE(world.hold(0, RodSide::left, pose) == Status::ok);
    REQUIRE(world.place(0, body) == Status::ok);
    const Status status = world.tick();
    ++passed.ticks;
    for (const auto& node : world.shape(0)) passed.not_finite += !is_finite(node);
    passed.not_finite += !world.held(0, RodSide::left).force.allFinite();
    if (status == Status::snapped) return;
    if (status != Status::ok) continue;
    ++passed.answered;
    // As the body sees it.
    std::vector<RodNode<double>> nodes(world.shape(0).begin(), world.shape(0).end());
    for (auto& node : nodes) node.r -= body.at;
    // Half of its reach and what a coarse element bends beside a contact: beyond it has passed.
    passed.wrong +=
        depth_in({nodes.data(), static_cast<int>(nodes.size())}, kind, radius, thickness / 2) > 0.75 * reach;
  }
}

}  // namespace

TEST_CASE("no rod passes a body, whoever moves", "[world]") {
  for (const double mu : {0.0, 0.4}) {
    Random random(45);
    Passed passed;
    for (int k = 0; k < 150; ++k) approach(random, mu, passed);
    INFO("friction " << mu << ": " << passed.ticks << " ticks, " << passed.answered << " answered");
    CHECK(passed.wrong == 0);
    CHECK(passed.not_finite == 0);
    CHECK(passed.answered > passed.ticks / 2);
  }
}

TEST_CASE("rods that meet bodies in odd ways have a status", "[world]") {
  const auto run = [](const RigidBody& body, const RodPose& from, const Point& way) {
    for (const double mu : {0.0, 0.4}) {
      World<RoundRod> world({{needle(0.1, 0.002, from), 8, mu}}, {body});
      bool finite = true;
      for (int k = 1; k <= 40; ++k) {
        RodPose pose = from;
        pose.at += k / 40.0 * way;
        REQUIRE(world.hold(0, RodSide::left, pose) == Status::ok);
        (void)world.tick();
        finite = finite && world.held(0, RodSide::left).force.allFinite();
        for (const auto& node : world.shape(0)) finite = finite && is_finite(node);
      }
      CHECK(finite);
    }
  };
  const RodPose along{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  // Head on: a point, a sphere, a plane, the rim of a tube, the end of a capsule.
  run(RigidBody::sphere({0.102, 0, 0}, 0), along, {0.01, 0, 0});
  run(RigidBody::sphere({0.107, 0, 0}, 0.005), along, {0.01, 0, 0});
  run(RigidBody::plane({0.102, 0, 0}, {-1, 0, 0}), along, {0.01, 0, 0});
  run(RigidBody::tube({0.102, 0, 0.003}, {0.2, 0, 0.003}, 0.003), along, {0.01, 0, 0});
  run(RigidBody::capsule({0.104, 0, 0}, {0.2, 0, 0}, 0.002), along, {0.01, 0, 0});
  // Along the axis of a tube, and of one as thick as the rod; beside a capsule of the same direction; at a node, and at the clamp.
  run(RigidBody::tube({-0.1, 0, 0}, {0.2, 0, 0}, 0.003), along, {0.05, 0, 0});
  run(RigidBody::tube({0.102, 0, 0}, {0.2, 0, 0}, 0.001), along, {0.05, 0, 0});
  run(RigidBody::capsule({0, 0, -0.0031}, {0.1, 0, -0.0031}, 0.002), along, {0, 0, -0.004});
  run(RigidBody::sphere({0.05, 0, -0.0031}, 0.002), along, {0, 0, -0.01});
  run(RigidBody::sphere({0, 0, -0.0031}, 0.002), along, {0, 0, -0.01});
  run(RigidBody::plane({0, 0, -0.0011}, {0, 0, 1}), along, {0, 0, -0.01});
}

TEST_CASE("a world rejects bodies that make no sense, and rods that lie in them", "[world]") {
  using Catch::Matchers::ContainsSubstring;
  const RodPose along{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  const auto of = [&](const RigidBody& body) {
    return World<RoundRod>({{needle(0.1, 0.002, along), 8}}, {body});
  };
  CHECK_THROWS_WITH(of(RigidBody::sphere({0.05, 0, 0.0019}, 0.003)),
                    ContainsSubstring("rod 0 and body 0 = 0.47"));
  CHECK_THROWS_WITH(of(RigidBody::plane({0, 0, -0.0001}, {0, 0, 1})), ContainsSubstring("rod 0 and body 0"));
  CHECK_THROWS_WITH(of(RigidBody::tube({0.02, 0, 0}, {0.05, 0, 0}, 0.0002)),
                    ContainsSubstring("rod 0 and body 0"));
  CHECK_THROWS_WITH(of(RigidBody::sphere({1, 0, 0}, -1)), ContainsSubstring("body radius"));
  CHECK_THROWS_WITH(of(RigidBody::tube({1, 0, 0}, {1, 0, 0}, 0.1)), ContainsSubstring("tube length"));
  CHECK_THROWS_WITH(of(RigidBody::plane({0, 0, -1}, {0, 0, 0})), ContainsSubstring("plane normal"));
  CHECK_THROWS_WITH(of(RigidBody::plane({0, 0, -1}, {0, 0, 1}, 3)),
                    ContainsSubstring("friction sticking = 3"));
  World<RoundRod> world = of(RigidBody::sphere({0.05, 0, 0.1}, 0.003));
  CHECK(world.place(0, {{0, 0, 0}, {1, 0, NAN}, {0, 0, 1}}) == Status::invalid_request);
  for (const int none : {-1, 1000000})
    CHECK(world.place(none, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}) == Status::invalid_request);
}

TEST_CASE("a body that is moved presses as a hand that moves the other way", "[world]") {
  const Scene& scene = scenes[2];
  const Motion none{};
  World<RoundRod> led = world_of<RoundRod>(scene, none, 10), met = world_of<RoundRod>(scene, none, 10);
  const Point way = scene.end - scene.start;
  REQUIRE(lead(led, {scene.start, start_along, {0, 1, 0}}, scene.end, 60) == Status::ok);
  for (int k = 1; k <= 60; ++k) {
    RodPose body;
    body.at = -k / 60.0 * way;
    REQUIRE(met.place(0, body) == Status::ok);
    REQUIRE(met.tick() == Status::ok);
  }
  REQUIRE(met.contacts() == 1);
  const Point force = led.held(0, RodSide::left).force;
  CHECK((met.held(0, RodSide::left).force - force).norm() < 1e-9 * force.norm());
  // Away and turned, it leaves the rod as it was.
  for (const double x : {1.0, -1.0}) {
    Status status = met.place(0, {{0, 0, -0.1}, {x, 0, 0}, {0, 1, 0}});
    for (int k = 0; k < 40 && (k == 0 || status != Status::ok); ++k) status = met.tick();
    CHECK(status == Status::ok);
  }
  CHECK(met.contacts() == 0);
  CHECK(met.held(0, RodSide::left).force.norm() < 1e-9);
}
