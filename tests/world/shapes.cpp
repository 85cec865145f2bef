// Bodies of any shape: tubes about lines and arcs, and signed distances of a user's own.
#include <algorithm>
#include <cmath>
#include <vector>

#include "body_scenes.hpp"
#include "once_world.hpp"
#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// A bend up and one aside.
ArcSpline vessel() {
  return ArcSpline({0, 0, 0}, {1, 0, 0}).arc(0.03).arc(0.06, {0, 20, 0}).arc(0.04, {0, 0, -15});
}

/// What a hand feels on its way against a body, with friction.
std::vector<Point> felt(const Scene& scene, const RigidBody& body) {
  NewtonRaphson exact;
  exact.relative_tolerance = 1e-10;
  RodPose pose{scene.start, start_along, {0, 1, 0}};
  World<RoundRod> world({{needle(0.2, 0.002, pose), 10, 0.2}}, {body}, {}, exact);
  std::vector<Point> forces;
  for (int k = 1; k <= 30; ++k) {
    pose.at = scene.start + k / 30.0 * (scene.end - scene.start);
    REQUIRE(world.hold(0, RodSide::left, pose) == Status::ok);
    REQUIRE(world.tick() == Status::ok);
    forces.push_back(world.held(0, RodSide::left).force);
  }
  REQUIRE(world.contacts() >= 1);
  return forces;
}

}  // namespace

TEST_CASE("a point is as far from a bent tube as from all points of its wall", "[world]") {
  const ArcSpline axis = vessel();
  const double radius = 0.006;
  const RigidBody tube = RigidBody::tube(axis, radius);
  // It goes on without a kink, and ends where it began to.
  const double step = 1e-6;
  for (double s = step; s < axis.length() - 2 * step; s += 0.0013) {
    const ArcSpline::Point a = axis.at(s), b = axis.at(s + step);
    CHECK(((b.r - a.r) / step - a.tangent).norm() < 1e-4);
    CHECK((axis.nearest(a.r + 0.004 * detail::beside(a.tangent)).r - a.r).norm() < 1e-12);
  }
  Random random(3);
  for (int k = 0; k < 60; ++k) {
    const ArcSpline::Point on = axis.at(random(0.0, axis.length()));
    const Point p = on.r + Point(random(0.009), random(0.009), random(0.009));
    double least = 1;
    for (int i = 0; i <= 800; ++i) {
      const ArcSpline::Point wall = axis.at(axis.length() * i / 800);
      const Point a = detail::beside(wall.tangent), b = detail::cross3(wall.tangent, a);
      for (int j = 0; j < 160; ++j)
        least = std::min(
            least,
            (wall.r + radius * (std::cos(2 * pi * j / 160) * a + std::sin(2 * pi * j / 160) * b) - p).norm());
    }
    const SurfaceDistance found = tube.from_core(p);
    // The points of the wall are 0.24 mm apart.
    CHECK(found.distance <= least + 1e-12);
    CHECK(found.distance >= least - std::hypot(0.00012, 1e-4));
    // The normal is the gradient.
    for (int c = 0; c < 3; ++c) {
      const Point by = 1e-7 * Point::Unit(c);
      const double slope = (tube.from_core(p + by).distance - tube.from_core(p - by).distance) / 2e-7;
      if (found.distance > 1e-4) CHECK(slope == Approx(found.normal[c]).margin(1e-5));
    }
  }
}

TEST_CASE("a signed distance of one's own is felt as the body that it is of", "[world][friction]") {
  const auto field = [](const RigidBody& body) {
    return RigidBody::field(
        [body](const Point& p) {
          SurfaceDistance found = body.from_core(p);
          found.distance -= body.depth();
          return found;
        },
        std::max(body.depth(), 0.003), 0.3);
  };
  for (const Scene& scene : {scenes[0], scenes[1], scenes[2]}) {
    const std::vector<Point> own = felt(scene, scene.body({})), as_field = felt(scene, field(scene.body({})));
    for (std::size_t k = 0; k < own.size(); ++k) {
      INFO(scene.name << " " << k);
      CHECK((own[k] - as_field[k]).norm() <= 1e-8 * own.back().norm());
    }
  }
}

TEST_CASE("a rod that is pushed into a bend is held back by what bends it", "[world]") {
  // Where the tube is narrow, each length that goes in takes EI/2R².
  const double bend = 0.08, thickness = 0.001, clearance = 1e-4,
               EI = spring_steel.young * pi * std::pow(thickness, 4) / 64;
  const RigidBody tube =
      RigidBody::tube(ArcSpline({0, 0, 0}, {1, 0, 0}).arc(0.03).arc(bend * pi / 2, {0, 1 / bend, 0}),
                      thickness / 2 + clearance);
  RodPose pose{{-0.15, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  Rod rod(0.18, RodSection::circle(thickness), spring_steel, clamped, free_end);
  rod.place_left(pose);
  World<RoundRod> world({{rod, 48}}, {tube});
  double work = 0, from = 0, stored = 0, before = 0;
  int answered = 0, ticks = 0;
  for (; pose.at.x() < -0.05; ++ticks) {
    pose.at.x() += 1e-4;
    REQUIRE(world.hold(0, RodSide::left, pose) == Status::ok);
    answered += is_answer(world.tick());
    const double now = world.held(0, RodSide::left).force.x();
    if (pose.at.x() < -0.09) from = pose.at.x(), stored = world.strain_energy(), work = 0;
    else work += (before + now) / 2 * 1e-4;
    before = now;
  }
  INFO(answered << " of " << ticks);
  CHECK(answered >= ticks - ticks / 20);
  const double way = pose.at.x() - from;
  CHECK(work / way == Approx(EI / (2 * bend * bend)).epsilon(0.03));
  CHECK(work == Approx(world.strain_energy() - stored).epsilon(0.02));
  // It goes along the tube.
  const RodNode<double> tip = world.shape(0)[48];
  const ArcSpline::Point beside = tube.axis().nearest(tip.r);
  CHECK((tip.r - beside.r).norm() < 1.1 * clearance);
  CHECK(tip.tangent.dot(beside.tangent) > 0.99 * tip.tangent.norm());
}

TEST_CASE("bodies that are none are refused by name", "[world]") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_THROWS_WITH(ArcSpline({0, 0, 0}, {0, 0, 0}), ContainsSubstring("axis place"));
  CHECK_THROWS_WITH(vessel().arc(0), ContainsSubstring("axis length = 0 m"));
  CHECK_THROWS_WITH(vessel().arc(0.1, {100, 100, 0}), ContainsSubstring("axis curvature"));
  CHECK_THROWS_WITH(RigidBody::field(nullptr, 0.1, 1), ContainsSubstring("body distance"));
  const auto plane = [](const Point& p) { return SurfaceDistance{p.z(), {0, 0, 1}}; };
  CHECK_THROWS_WITH(RigidBody::field(plane, -1, 1), ContainsSubstring("body depth = -1 m"));
  CHECK_THROWS_WITH(RigidBody::field(plane, 1, std::nan("")), ContainsSubstring("body size"));
}
