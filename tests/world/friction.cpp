// Friction of rods that touch: Coulomb's cone, the balance of energy, steady sliding against shooting, and a capstan.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "crossed.hpp"
#include "once_world.hpp"
#include "sliding_reference.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double mu = 0.3;

/// The rods of crossed.hpp with friction, pressed against each other.
template <class Element>
World<Element> pressed(const Friction& friction, const RodSection& section, Crossing& at,
                       const NewtonRaphson& solver = {}) {
  Rod top(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  const Rod wire(0.25, section, spring_steel, RodSupport::clamped, RodSupport::free);
  at.angle = 1.2;
  at.off = {0, 0, 2e-4};
  top.place_left(at.pose());
  World<Element> world({{top, 8, friction}, {wire, 8}}, {}, {}, solver);
  Crossing deep = at;
  deep.off = {0, 0, -0.008};
  REQUIRE(lead(world, at, deep, 100) == Status::ok);
  REQUIRE(world.contacts() == 1);
  at = deep;
  return world;
}

/// Of RodContact::force.
double normal_force(const RodContact& contact) { return (contact.force - contact.friction).norm(); }

/// What is missing of the work of a hand that slides on along a curve [-].
template <class Element>
double missing_work(int ticks, const RodSection& section, double tolerance) {
  Crossing at;
  NewtonRaphson solver;
  solver.relative_tolerance = tolerance;
  World<Element> world = pressed<Element>(mu, section, at, solver);
  const Point start = at.off;
  double work = 0, stored = 0, dissipated = 0;
  for (int k = 1; k <= ticks; ++k) {
    const double t = double(k) / ticks;
    Crossing to = at;
    to.off = start + Point(0.02 * t, 0.012 * t + 0.003 * t * t, -0.002 * t);
    const Point before = world.held(0, RodSide::left).force;
    REQUIRE(lead(world, to) == Status::ok);
    REQUIRE(world.contact(0).friction.norm() <= mu * normal_force(world.contact(0)) * (1 + 1e-15));
    if (k == ticks / 4) stored = world.strain_energy(), dissipated = world.dissipated();
    if (k > ticks / 4) work += (before + world.held(0, RodSide::left).force).dot(to.off - at.off) / 2;
    at = to;
  }
  REQUIRE(world.contact(0).sliding);
  CHECK(world.dissipated() - dissipated > work / 2);
  return (work - (world.strain_energy() - stored) - (world.dissipated() - dissipated)) / work;
}

template <class Element>
void check_balance(const RodSection& section) {
  // The trapezoid is of second order.  A force that is exact to 1e-8 leaves as much.
  const double coarse = missing_work<Element>(100, section, 1e-12),
               fine = missing_work<Element>(400, section, 1e-12),
               usual = missing_work<Element>(800, section, 1e-8);
  INFO("100 ticks leave " << coarse << ", 400 " << fine << ", 800 " << usual << " of the work");
  CHECK(coarse / fine == Approx(16).epsilon(0.1));
  CHECK(std::abs(fine) < 1e-8);
  CHECK(std::abs(usual) < 1e-8);
}

}  // namespace

TEST_CASE("what a hand gives is stored, or friction has taken it", "[world][friction]") {
  check_balance<RoundRod>(RodSection::circle(0.0015));
  check_balance<TwistedRod>(RodSection::circle(0.0015));
  check_balance<TwistedRod>(RodSection::rectangle(0.0015, 0.0012));
}

namespace {

/// The cantilever under a rigid rod that is drawn along itself, against Rubbed.   @return relative error of force, and of place
template <class Element>
std::array<double, 2> rubbing_error(int elements) {
  const double length = 0.25, stiff = 1e5;
  const RodSection section = RodSection::circle(0.0015);
  const Rod wire(length, section, spring_steel, RodSupport::clamped, RodSupport::free);
  Rod tool(0.2, RodStiffness{1e9, stiff, stiff, stiff}, 0.002, RodSupport::clamped, RodSupport::free);
  const Point along = detail::unit(Point(0.3, 1, -0.1));
  const auto pose = [&](double depth, double drawn) {
    const Point at = Point(0.18, 0, crossed_reach + 2e-4 - depth) + (drawn - 0.08) * along;
    return RodPose{at, along, Point(1, 0, 0)};
  };
  tool.place_left(pose(0, 0));
  World<Element> world({{tool, 2, mu}, {wire, elements}});
  const auto move = [&](double depth, double drawn) {
    REQUIRE(world.hold(0, RodSide::left, pose(depth, drawn)) == Status::ok);
    REQUIRE(world.tick() == Status::ok);
  };
  for (int k = 1; k <= 100; ++k) move(1e-4 * k, 0);
  for (int k = 1; k <= 400; ++k) move(0.01, 1e-4 * k);
  REQUIRE(world.contacts() == 1);
  const RodContact contact = world.contact(0);
  Rubbed rubbed{
      wire.stiffness().axial, wire.stiffness().bending1, along, pose(0.01, 0).at, crossed_reach, mu};
  rubbed.solve(normal_force(contact), contact.s[1]);
  const Point held = world.held(1, RodSide::left).force;
  return {(held + rubbed.pull).norm() / rubbed.pull.norm(), std::abs(contact.s[1] - rubbed.place) / length};
}

}  // namespace

TEST_CASE("sliding rods are as exact as the elements", "[world][friction][verification]") {
  const auto check = [](int elements, double force, double place) {
    for (const auto& error : {rubbing_error<RoundRod>(elements), rubbing_error<TwistedRod>(elements)}) {
      INFO(elements << " elements: force " << error[0] << ", place " << error[1]);
      CHECK(error[0] < force);
      CHECK(error[1] < place);
    }
  };
  check(8, 2e-6, 3e-7);
  check(16, 2e-7, 1e-7);
  // The tool yields by 1e-8 of what the wire does.
  check(32, 3e-8, 1e-8);
}

TEST_CASE("what one rod rubs off another it feels itself", "[world][friction]") {
  Crossing at;
  // What the last increment leaves of moments is its square.
  NewtonRaphson exact;
  exact.relative_tolerance = 1e-13;
  World<RoundRod> world = pressed<RoundRod>(mu, RodSection::circle(0.0015), at, exact);
  double balance = 0, turning = 0;
  for (int k = 1; k <= 100; ++k) {
    at.off += Point(1e-4, 5e-5, 0);
    REQUIRE(lead(world, at) == Status::ok);
    const RodContact contact = world.contact(0);
    const HeldEnd<double> hand = world.held(0, RodSide::left), clamp = world.held(1, RodSide::left);
    const Point about = hand.moment + clamp.moment + detail::cross3(at.pose().at, hand.force),
                // Friction acts at both centrelines.
        couple = detail::cross3(Point(contact.at[0] - contact.at[1]), hand.force);
    balance = std::max(balance, (hand.force + clamp.force).norm() / hand.force.norm());
    turning = std::max(turning, (about - couple).norm() / hand.moment.norm());
    CHECK((hand.force + contact.force).norm() < 1e-7 * hand.force.norm());
  }
  INFO("sum of forces " << balance << ", of moments " << turning);
  CHECK(world.contact(0).sliding);
  CHECK(balance < 1e-12);
  CHECK(turning < 1e-12);
}

TEST_CASE("rods stick until friction can hold no more", "[world][friction]") {
  Crossing at;
  World<RoundRod> world = pressed<RoundRod>({0.5, 0.3}, RodSection::circle(0.0015), at);
  // What has rubbed while they were pressed against each other turns back first.
  for (int k = 0; k < 20; ++k) {
    at.off.x() += 1e-5;
    REQUIRE(lead(world, at) == Status::ok);
  }
  double held = 0;
  bool slid = false;
  for (int k = 0; k < 400 && !slid; ++k) {
    at.off.x() += 1e-5;
    REQUIRE(lead(world, at) == Status::ok);
    const RodContact contact = world.contact(0);
    slid = contact.sliding;
    if (!slid) held = contact.friction.norm() / normal_force(contact);
  }
  // One more tick would have passed 0.5; then it is that of sliding.
  REQUIRE(slid);
  CHECK(held == Approx(0.5).margin(0.02));
  CHECK(world.contact(0).friction.norm() == Approx(0.3 * normal_force(world.contact(0))));
}

// A skin that sticks is so stiff that the tolerance of places is 1e-5 of its force, and more between three rods.
TEST_CASE("what sticks is held by as much as it holds", "[world][friction]") {
  for (const double step : {2e-4, 4e-4}) {
    Rod tool(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
    const Rod wire(0.25, RodSection::circle(0.0015), spring_steel, RodSupport::clamped, RodSupport::free);
    RodPose hand{{0.15, -0.09, 0.00185}, {0.2, 1, 0}, {0, 0, 1}};
    tool.place_left(hand);
    World<RoundRod> world({{tool, 8, 2}, {wire, 8}});
    double off = 0;
    for (int k = 1; k <= 60; ++k) {
      hand.at.z() -= step;
      REQUIRE(world.hold(0, RodSide::left, hand) == Status::ok);
      REQUIRE(world.tick() == Status::ok);
      if (world.contacts() == 0) continue;
      const Point force = world.held(0, RodSide::left).force;
      off = std::max(off, (force + world.contact(0).force).norm() / force.norm());
    }
    INFO(step << ": " << off << " of the force");
    CHECK_FALSE(world.contact(0).sliding);
    CHECK(off < 1e-6);
  }
}

TEST_CASE("what sticks takes nothing", "[world][friction]") {
  Crossing at;
  World<RoundRod> world = pressed<RoundRod>(1, RodSection::circle(0.0015), at);
  const double dissipated = world.dissipated();
  const Point force = world.held(0, RodSide::left).force;
  Crossing aside = at;
  aside.off += Point(0, 2e-4, 1e-4);
  CHECK(lead(world, at, aside, 10) == Status::ok);
  CHECK((world.held(0, RodSide::left).force - force).norm() > 1e-3 * force.norm());
  CHECK_FALSE(world.contact(0).sliding);
  CHECK(lead(world, aside, at, 10) == Status::ok);
  CHECK(world.dissipated() == dissipated);
  CHECK((world.held(0, RodSide::left).force - force).norm() < 1e-6 * force.norm());
}

TEST_CASE("friction takes whatever way a hand goes, and no more than its cone", "[world][friction]") {
  Random random(9);
  int snapped = 0;
  for (int path = 0; path < 8; ++path) {
    Crossing at;
    // What holds more than it slides with leaps as it begins to.
    const double sliding = random(0.1, 0.6);
    const Friction friction(path < 4 ? sliding : 3 * sliding, sliding);
    World<RoundRod> world = pressed<RoundRod>(friction, RodSection::circle(0.0015), at);
    double work = 0, before = world.dissipated();
    const double stored = world.strain_energy(), taken = before;
    Point way(0, 0, 0);
    for (int k = 0; k < 400; ++k) {
      if (k % 40 == 0) way = 5e-5 * Point(random(1.0), random(1.0), random(0.3));
      if (at.off.z() > -0.005) way.z() = -std::abs(way.z());
      const Point force = world.held(0, RodSide::left).force;
      at.off += way;
      const Status status = lead(world, at);
      snapped += status == Status::snapped;
      CHECK((status == Status::ok || path >= 4));
      work += (force + world.held(0, RodSide::left).force).dot(way) / 2;
      REQUIRE(world.contacts() == 1);
      const RodContact contact = world.contact(0);
      CHECK(contact.friction.norm() <= friction.sticking * normal_force(contact) * (1 + 1e-15));
      CHECK(world.dissipated() >= before);
      before = world.dissipated();
    }
    // Where a hand turns back its force leaps within a tick, ten times a path.
    INFO("work " << work << ", dissipated " << before - taken);
    if (path < 4) CHECK(work - (world.strain_energy() - stored) == Approx(before - taken).epsilon(1e-2));
  }
  CHECK(snapped > 0);
}

namespace {

/// A string over a drum, pressed by so much and drawn until it slides.   @return ratio of both forces, angle between them [rad]
std::array<double, 2> capstan(double angle, int elements) {
  const double radius = 0.01, thin = 0.0003, reach = radius + thin, half = 0.2, EA = 1e4, EI = 1e-3;
  Rod drum(0.1, RodStiffness{1e9, 1e4, 1e4, 1e4}, 2 * radius, RodSupport::clamped, RodSupport::clamped);
  drum.place_left({{0, -0.05, 0}, {0, 1, 0}, {0, 0, 1}});
  Rod string(2 * half, RodStiffness{EA, EI, EI, EI}, 2 * thin, RodSupport::clamped, RodSupport::clamped);
  const auto end = [&](double side, double slope, double from_top) {
    const Point along(std::cos(slope), 0, -side * std::sin(slope));
    return RodPose{Point(0, 0, reach + 2e-4) + side * from_top * along, along, {0, 1, 0}};
  };
  string.place_left(end(-1, 0, half)).place_right(end(1, 0, half));
  World<RoundRod> world({{string, elements, mu}, {drum, 4}});
  const auto move = [&](double slope, double drawn) {
    REQUIRE(world.hold(0, RodSide::left, end(-1, slope, half + drawn)) == Status::ok);
    REQUIRE(world.hold(0, RodSide::right, end(1, slope, half - drawn)) == Status::ok);
    REQUIRE(world.tick() == Status::ok);
  };
  for (int k = 1; k <= 100; ++k) move(angle / 2 * k / 100, 0);
  for (int k = 1; k <= 60; ++k) move(angle / 2, 1e-4 * k);
  REQUIRE(world.contacts() == 1);
  REQUIRE(world.contact(0).sliding);
  const Point taut = world.held(0, RodSide::left).force, slack = world.held(0, RodSide::right).force;
  return {taut.norm() / slack.norm(), std::acos(-taut.dot(slack) / taut.norm() / slack.norm())};
}

/// The same of a long one with some bending stiffness: t² κ²/2 is the same on both sides of the place where it touches.
///
///   F₁ (1 - cos φ₁) = F₂ (1 - cos φ₂),   F₁ - F₂ = μ (F₁ sin φ₁ + F₂ sin φ₂),   φ₁ + φ₂ = φ
double capstan_of_one_place(double angle) {
  double low = 0, high = angle;
  const auto ratio = [&](double first) { return (1 - std::cos(angle - first)) / (1 - std::cos(first)); };
  for (int k = 0; k < 100; ++k) {
    const double first = (low + high) / 2, F = ratio(first);
    const bool slides = F - 1 > mu * (F * std::sin(first) + std::sin(angle - first));
    (slides ? low : high) = first;
  }
  return ratio(low);
}

}  // namespace

// The rest is of bending between places that the mesh has.
TEST_CASE("a rod that is drawn round a rod is a capstan", "[world][friction][verification]") {
  for (const double angle : {0.3, 0.6, 0.8}) {
    const auto [ratio, wrapped] = capstan(angle, 32);
    INFO("angle " << wrapped << ": " << ratio << ", of one place " << capstan_of_one_place(wrapped));
    CHECK(std::abs(ratio / capstan_of_one_place(wrapped) - 1) < 4e-3 * angle * angle);
    CHECK(std::abs(ratio / std::exp(mu * wrapped) - 1) < 0.01);
  }
}

// A rod on a rod on a wire, which stick and slide on each other as two hands press and turn back.
TEST_CASE("three rods that stick and slide have an answer", "[world][friction]") {
  const Rod wire(0.25, RodSection::circle(0.0015), spring_steel, RodSupport::clamped, RodSupport::clamped);
  const std::array<RodPose, 2> start{{{{0.02, -0.06, 0.0042}, detail::unit(Point(1, 0.55, 0)), {0, 0, 1}},
                                      {{0.12, -0.12, 0.0021}, {0, 1, 0}, {0, 0, 1}}}};
  int ticks = 0, unanswered = 0, most = 0;
  for (int seed = 0; seed < 10; ++seed) {
    Random random(static_cast<std::uint64_t>(110 + seed));
    const Friction friction = random(0.2, 0.6);
    std::vector<WorldRod> rods;
    for (RodPose pose : start) {
      Rod rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
      rods.push_back({rod.place_left(pose), 8, friction});
    }
    rods.push_back({wire, 8, friction});
    World<RoundRod> world(rods);
    std::array<Point, 2> off{Point(0, 0, 0), Point(0, 0, 0)}, way = off;
    int row = 0;
    for (int k = 0; k < 1000; ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        if (k % 40 == 0) way[i] = 5e-5 * Point(random(1.0), random(1.0), random(1.0));
        if (k < 100) way[i].z() = i == 0 ? -5e-5 : -2.5e-5;
        for (int c = 0; c < 2; ++c)
          if (std::abs(off[i][c]) > 0.03) way[i][c] = -std::copysign(way[i][c], off[i][c]);
        const double high = i == 0 ? -0.003 : -0.002, low = i == 0 ? -0.014 : -0.01;
        if (off[i].z() > high || off[i].z() < low)
          way[i].z() = std::copysign(way[i].z(), off[i].z() > high ? -1.0 : 1.0);
        off[i] += way[i];
        RodPose pose = start[i];
        pose.at += off[i];
        REQUIRE(world.hold(int(i), RodSide::left, pose) == Status::ok);
      }
      const bool found = is_answer(world.tick());
      ++ticks, unanswered += !found, row = found ? 0 : row + 1, most = std::max(most, row);
    }
  }
  INFO(unanswered << " of " << ticks << " unanswered, " << most << " in a row");
  CHECK(unanswered <= 0.0006 * ticks);
  CHECK(most <= 2);
}

TEST_CASE("the rougher of two rods decides, and a world rejects what is no friction", "[world][friction]") {
  const auto make = [](const Friction& first, const Friction& second) {
    Crossing at;
    at.off = {0, 0, 2e-4};
    Rod top(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
    const Rod wire(0.25, RodSection::circle(0.0015), spring_steel, RodSupport::clamped, RodSupport::clamped);
    top.place_left(at.pose());
    World<RoundRod> world({{top, 8, first}, {wire, 8, second}});
    Crossing down = at, aside = at;
    down.off = {0, 0, -0.003}, aside.off = {0.003, 0.003, -0.003};
    REQUIRE(lead(world, at, down, 20) == Status::ok);
    REQUIRE(lead(world, down, aside, 60) == Status::ok);
    REQUIRE(world.contacts() == 1);
    const RodContact contact = world.contact(0);
    return contact.friction.norm() / normal_force(contact);
  };
  CHECK(make(0.1, {}) == Approx(0.1));
  CHECK(make(0.1, {0.4, 0.2}) == Approx(0.2));
  CHECK(make({}, {}) == 0);
  CHECK_THROWS_WITH(make(3, {}), Catch::Matchers::ContainsSubstring("friction sticking = 3"));
}
