// Friction of rods on rigid bodies: the balance of energy, Coulomb's law, bodies that move, and a capstan.
#include <algorithm>
#include <cmath>
#include <vector>

#include "body_scenes.hpp"
#include "once_world.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double mu = 0.3;

/// The hand of a scene.
RodPose hand_at(const Point& at) { return {at, start_along, {0, 1, 0}}; }

/// The scene where its hand has come, which has pressed the needle there.
template <class Element>
World<Element> pressed(const Scene& scene, const Friction& friction, const NewtonRaphson& solver = {}) {
  World<Element> world = world_of<Element>(scene, {}, 10, friction, solver);
  REQUIRE(lead(world, hand_at(scene.start), scene.end, 60) == Status::ok);
  REQUIRE(world.contacts() >= 1);
  return world;
}

/// What is missing of the work of a hand that slides on along a curve [-].
template <class Element>
double missing_work(const Scene& scene, int ticks) {
  NewtonRaphson exact;
  exact.relative_tolerance = 1e-12;
  World<Element> world = pressed<Element>(scene, mu, exact);
  const Point deep = (scene.end - scene.start) / 20;
  Point at = scene.end;
  double work = 0, stored = 0, dissipated = 0;
  for (int k = 1; k <= ticks; ++k) {
    const double t = double(k) / ticks;
    const Point to = scene.end + t * (deep + Point(0.005, 0.0015, 0)) + t * t * Point(0, 5e-4, 0),
                before = world.held(0, RodSide::left).force;
    REQUIRE(lead(world, hand_at(at), to, 1) == Status::ok);
    for (int c = 0; c < world.contacts(); ++c)
      REQUIRE(world.contact(c).friction.norm() <= mu * normal_force(world.contact(c)) * (1 + 1e-15));
    if (k == ticks / 4) stored = world.strain_energy(), dissipated = world.dissipated();
    if (k > ticks / 4) work += (before + world.held(0, RodSide::left).force).dot(to - at) / 2;
    at = to;
  }
  REQUIRE(world.contact(0).sliding);
  CHECK(world.dissipated() > dissipated);
  return (work - (world.strain_energy() - stored) - (world.dissipated() - dissipated)) / work;
}

template <class Element>
void check_balance(const Scene& scene) {
  // The trapezoid is of second order.
  const double coarse = missing_work<Element>(scene, 200), fine = missing_work<Element>(scene, 800);
  INFO(scene.name << ": 200 ticks leave " << coarse << ", 800 " << fine << " of the work");
  CHECK(coarse / fine == Approx(16).epsilon(0.1));
  CHECK(std::abs(16 * fine - coarse) / 15 < 5e-9);
}

}  // namespace

TEST_CASE("what a hand gives over a body is stored, or friction has taken it", "[world][friction]") {
  for (const Scene& scene : scenes) {
    check_balance<RoundRod>(scene);
    check_balance<TwistedRod>(scene);
  }
}

namespace {

/// Force on the hand at the end of a way over a body, as in the scene that is not moved, and where it is touched.
template <class Element>
std::vector<Point> felt(const Scene& scene, const Motion& motion) {
  World<Element> world = world_of<Element>(scene, motion, 10, mu);
  REQUIRE(lead(world, motion(hand_at(scene.start)), motion(scene.end), 60) == Status::ok);
  REQUIRE(world.contact(0).sliding);
  const HeldEnd<double> hand = world.held(0, RodSide::left);
  Point sum = hand.force;
  for (int k = 0; k < world.contacts(); ++k) sum += world.contact(k).force;
  CHECK(sum.norm() < 1e-6 * hand.force.norm());
  const Motion back{motion.axis, -motion.angle, {0, 0, 0}};
  return {back.turn(hand.force), back.turn(hand.moment), back.turn(world.contact(0).friction),
          Point(world.contact(0).s[0], world.contact(0).s[1], 0)};
}

}  // namespace

TEST_CASE("friction turns with the scene", "[world][friction]") {
  for (const Scene& scene : scenes) {
    check_same(scene, felt<RoundRod>(scene, {}), felt<RoundRod>(scene, elsewhere));
    check_same(scene, felt<TwistedRod>(scene, {}), felt<TwistedRod>(scene, elsewhere));
  }
}

TEST_CASE("a hand and a body that move together feel nothing of it", "[world][friction]") {
  for (const Scene& scene : scenes) {
    INFO(scene.name);
    World<RoundRod> world = pressed<RoundRod>(scene, mu);
    Motion motion{detail::unit(Point(1, -2, 0.5)), 0, {0, 0, 0}};
    Point force(0, 0, 0), friction(0, 0, 0);
    double dissipated = 0;
    for (int k = 1; k <= 40; ++k) {
      motion.angle = 0.002 * k, motion.by = k * Point(2e-4, 1e-4, -3e-4);
      REQUIRE(world.hold(0, RodSide::left, motion(hand_at(scene.end))) == Status::ok);
      REQUIRE(world.place(0, motion(RodPose{})) == Status::ok);
      const Status status = world.tick();
      const Motion back{motion.axis, -motion.angle, {0, 0, 0}};
      const Point held = back.turn(world.held(0, RodSide::left).force),
                  rubs = back.turn(world.contact(0).friction);
      // What has slid sticks first.
      if (k == 5) force = held, friction = rubs, dissipated = world.dissipated();
      if (k < 5) continue;
      CHECK(status == Status::ok);
      CHECK_FALSE(world.contact(0).sliding);
      // The skin is so stiff that round-off of places is 1e-8 of its force.
      CHECK((held - force).norm() < 1e-6 * force.norm());
      CHECK((rubs - friction).norm() < 1e-6 * friction.norm());
      CHECK(world.dissipated() == Approx(dissipated).epsilon(1e-9));
    }
  }
}

TEST_CASE("a body that is moved drags a rod as a hand that moves the other way", "[world][friction]") {
  for (const Scene& scene : scenes) {
    INFO(scene.name);
    World<RoundRod> led = pressed<RoundRod>(scene, mu), met = pressed<RoundRod>(scene, mu);
    const Point way(0.01, 0.003, 0);
    for (int k = 1; k <= 60; ++k) {
      RodPose body;
      body.at = -k / 60.0 * way;
      REQUIRE(lead(led, hand_at(scene.end + (k - 1) / 60.0 * way), scene.end + k / 60.0 * way, 1) ==
              Status::ok);
      REQUIRE(met.place(0, body) == Status::ok);
      REQUIRE(met.tick() == Status::ok);
    }
    const Point force = led.held(0, RodSide::left).force;
    CHECK(led.contact(0).sliding);
    CHECK((met.held(0, RodSide::left).force - force).norm() < 1e-9 * force.norm());
  }
}

TEST_CASE("a body that spins about its own axis drags a rod that stays", "[world][friction]") {
  const RodPose pose{{-0.1, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  for (const RigidBody& body : {RigidBody::capsule({0, -0.05, -0.011}, {0, 0.05, -0.011}, 0.01, mu),
                                RigidBody::sphere({0, 0, -0.011}, 0.01, mu),
                                RigidBody::tube({0, -0.05, -0.011}, {0, 0.05, -0.011}, 0.01, mu)}) {
    World<RoundRod> world({{needle(0.2, 0.002, pose), 8}}, {body});
    REQUIRE(lead(world, pose, {-0.1, 0, -0.002}, 40) == Status::ok);
    REQUIRE(world.contacts() == 1);
    const double dissipated = world.dissipated();
    for (int k = 1; k <= 40; ++k) {
      // The top of the roller goes along x.
      const double angle = 0.002 * k;
      const Motion turn{{0, 1, 0}, angle, {0, 0, 0}};
      const Point axis(0, 0, -0.011);
      REQUIRE(world.place(0, {axis - turn.turn(axis), turn.turn(Point(1, 0, 0)),
                              turn.turn(Point(0, 1, 0))}) == Status::ok);
      REQUIRE(world.tick() == Status::ok);
    }
    const RodContact contact = world.contact(0);
    CHECK(contact.sliding);
    CHECK(contact.friction.norm() == Approx(mu * normal_force(contact)));
    CHECK(contact.friction.x() > 0.99 * contact.friction.norm());
    // The rod's section turns along.
    CHECK(world.dissipated() - dissipated == Approx(0.011 * 0.08 * contact.friction.norm()).epsilon(0.02));
  }
  // A table that turns under a tip.
  const RodPose above{{0, 0, 0.2}, detail::unit(Point(0.3, 0, -1)), {0, 1, 0}};
  World<RoundRod> world({{needle(0.2, 0.002, above), 8}}, {RigidBody::plane({0, 0, 0}, {0, 0, 1}, mu)});
  REQUIRE(lead(world, above, {0, 0, 0.185}, 100) == Status::ok);
  for (int k = 1; k <= 40; ++k) {
    const double angle = 0.02 * k;
    REQUIRE(world.place(0, {{0, 0, 0},
                            {std::cos(angle), std::sin(angle), 0},
                            {-std::sin(angle), std::cos(angle), 0}}) == Status::ok);
    REQUIRE(world.tick() == Status::ok);
  }
  const RodContact contact = world.contact(0);
  const Point way = detail::cross3(Point(0, 0, 1), contact.at[0]);
  CHECK(contact.sliding);
  CHECK(contact.friction.dot(way) == Approx(mu * normal_force(contact) * way.norm()).epsilon(0.01));
}

// The tolerance of places is up to all of the force of a skin that sticks.
TEST_CASE("what sticks to a body is held by as much as it holds", "[world][friction]") {
  for (const Scene& scene : scenes) {
    World<RoundRod> world = pressed<RoundRod>(scene, 2);
    double off = 0;
    int stuck = 0;
    for (int k = 1; k <= 60; ++k) {
      const double t = 0.5 * k;
      const Point at = scene.end + 2e-6 * Point(std::cos(t) - 1, 0.2 * std::sin(t), 0.2 * std::sin(t));
      REQUIRE(world.hold(0, RodSide::left, hand_at(at)) == Status::ok);
      if (world.tick() != Status::ok) continue;
      const Point force = world.held(0, RodSide::left).force;
      Point sum = force;
      bool slides = false;
      for (int c = 0; c < world.contacts(); ++c)
        sum += world.contact(c).force, slides = slides || world.contact(c).sliding;
      if (slides) continue;
      off = std::max(off, sum.norm() / force.norm()), ++stuck;
    }
    INFO(scene.name << ": " << off << " of the force in " << stuck << " ticks");
    CHECK(stuck >= 1);
    CHECK(off < 1e-8);
  }
}

TEST_CASE("a rod on a table sticks until friction can hold no more", "[world][friction]") {
  const double angle = 0.3, length = 0.2;
  const RodPose pose{
      {0, 0, 0.001 + length * std::sin(angle)}, {std::cos(angle), 0, -std::sin(angle)}, {0, 1, 0}};
  World<RoundRod> world({{needle(length, 0.002, pose), 12, {0.5, 0.3}}},
                        {RigidBody::plane({0, 0, 0}, {0, 0, 1})});
  Point at = pose.at - Point(0, 0, 0.05);
  REQUIRE(lead(world, pose, at, 200) == Status::ok);
  // It lies flat from where it lifts off.
  REQUIRE(world.contacts() == 1);
  REQUIRE(world.contact(0).s[0] < 0.9 * length);
  double held = 0;
  bool slid = false;
  for (int k = 0; k < 2000 && !slid; ++k) {
    const Point to = at + Point(0, 4e-6, 0);
    REQUIRE(lead(world, {at, pose.along, pose.director}, to, 1) == Status::ok);
    at = to;
    const RodContact contact = world.contact(0);
    slid = contact.sliding && k > 100;
    if (!slid && k > 100) held = contact.friction.norm() / normal_force(contact);
  }
  REQUIRE(slid);
  CHECK(held == Approx(0.5).margin(0.02));
  CHECK(world.contact(0).friction.norm() == Approx(0.3 * normal_force(world.contact(0))));
}

TEST_CASE("a tube holds a rod that is pushed into it back by what presses it there", "[world][friction]") {
  const Scene& scene = scenes[3];
  const auto push = [&](const Friction& friction) {
    World<RoundRod> world = pressed<RoundRod>(scene, friction);
    RodPose at = hand_at(scene.end);
    REQUIRE(lead(world, at, scene.end + Point(0.02, 0, 0), 100) == Status::ok);
    Point along(0, 0, 0);
    double normal = 0;
    for (int k = 0; k < world.contacts(); ++k)
      normal += normal_force(world.contact(k)), along += world.contact(k).friction;
    return along.x() / normal;
  };
  CHECK(push(mu) == Approx(-mu).epsilon(1e-2));
  CHECK(push({}) == 0);
}

namespace {

/// A string over a drum, pressed by so much and drawn until it slides.   @return ratio of both forces, angle between them [rad]
std::array<double, 2> capstan(const RigidBody& drum, double reach, double angle, int elements) {
  const double thin = 0.0003, half = 0.2, EA = 1e4, EI = 1e-3;
  Rod string(2 * half, RodStiffness{EA, EI, EI, EI}, 2 * thin, clamped, clamped);
  const auto end = [&](double side, double slope, double from_top) {
    const Point along(std::cos(slope), 0, -side * std::sin(slope));
    return RodPose{Point(0, 0, reach + thin + 2e-4) + side * from_top * along, along, {0, 1, 0}};
  };
  string.place_left(end(-1, 0, half)).place_right(end(1, 0, half));
  World<RoundRod> world({{string, elements}}, {drum});
  const auto move = [&](double slope, double drawn) {
    REQUIRE(world.hold(0, RodSide::left, end(-1, slope, half + drawn)) == Status::ok);
    REQUIRE(world.hold(0, RodSide::right, end(1, slope, half - drawn)) == Status::ok);
    REQUIRE(world.tick() == Status::ok);
  };
  for (int k = 1; k <= 100; ++k) move(angle / 2 * k / 100, 0);
  for (int k = 1; k <= 60; ++k) move(angle / 2, 1e-4 * k);
  REQUIRE(world.contact(0).sliding);
  const Point taut = world.held(0, RodSide::left).force, slack = world.held(0, RodSide::right).force;
  return {taut.norm() / slack.norm(), std::acos(-taut.dot(slack) / taut.norm() / slack.norm())};
}

}  // namespace

TEST_CASE("a rod that is drawn round a body is a capstan", "[world][friction][verification]") {
  for (const double angle : {0.3, 0.6, 0.8})
    for (const RigidBody& drum :
         {RigidBody::capsule({0, -0.05, 0}, {0, 0.05, 0}, 0.01, mu), RigidBody::sphere({0, 0, 0}, 0.01, mu),
          RigidBody::tube({0, -0.05, 0}, {0, 0.05, 0}, 0.01, mu)}) {
      const auto [ratio, wrapped] = capstan(drum, 0.01, angle, 32);
      INFO("angle " << wrapped << ": " << ratio);
      CHECK(std::abs(ratio / std::exp(mu * wrapped) - 1) < 0.01);
    }
}
