// Two crossed cantilevers against shooting, and Newton's third law.
#include <algorithm>
#include <vector>

#include "crossed.hpp"
#include "once_world.hpp"
#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/push_round.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

struct Bound {
  int elements;
  double force, place;
};

template <class Element>
void check_crossed(const Bound& bound) {
  const Csv reference("rods_in_contact.csv");
  Crossing at;
  at.off = {0, 0, 1e-4};
  World<Element> world = crossed_rods<Element>(at, bound.elements);
  double force = 0, moment = 0, place = 0, balance = 0, turning = 0;
  for (std::size_t row = 0; row < reference.rows(); ++row) {
    const auto vector = [&](const char* x, const char* y, const char* z) {
      return Point(reference.number(row, x), reference.number(row, y), reference.number(row, z));
    };
    Crossing to = at;
    to.off = {0, 0, -reference.number(row, "depth")};
    REQUIRE(lead(world, at, to, 1 + static_cast<int>((at.off - to.off).norm() / 1e-3)) == Status::ok);
    at = to;
    REQUIRE(world.contacts() == 1);
    const RodContact contact = world.contact(0);
    const HeldEnd<double> hand = world.held(0, RodSide::left), clamp = world.held(1, RodSide::left);
    const Point F = vector("Fx", "Fy", "Fz"), M = vector("Mx", "My", "Mz");
    force = std::max(force, (hand.force + F).norm() / F.norm());
    moment = std::max(moment, (hand.moment + M).norm() / M.norm());
    place = std::max({place, std::abs(contact.s[0] - reference.number(row, "sA")) / 0.2,
                      std::abs(contact.s[1] - reference.number(row, "sB")) / 0.25});
    balance = std::max(balance, (hand.force + clamp.force).norm() / F.norm());
    const Point about = hand.moment + clamp.moment + detail::cross3(to.pose().at, hand.force);
    turning = std::max(turning, about.norm() / M.norm());
  }
  INFO(bound.elements << " elements: force " << force << ", moment " << moment << ", place " << place
                      << ", sum of forces " << balance << ", of moments " << turning);
  CHECK(force < bound.force);
  CHECK(moment < bound.force);
  CHECK(place < bound.place);
  CHECK(balance < 1e-12);
  CHECK(turning < 1e-12);
}

}  // namespace

// What a cubic lacks at a place within an element is in its compliance: without it the error is 2e-4 with 8 elements.
TEST_CASE("crossed rods are as exact as the elements, wherever they touch", "[world][verification]") {
  for (const Bound& bound : {Bound{8, 2e-5, 1e-6}, Bound{16, 1e-6, 1e-7}, Bound{32, 1e-7, 1e-8}}) {
    check_crossed<RoundRod>(bound);
    check_crossed<TwistedRod>(bound);
  }
}

namespace {

/// A stiff rod across a rod that is held at both ends, by a World and as a capsule that presses that rod alone.   @return relative difference
template <class Element>
double against_capsule(const Rod& wire, int elements, const Point& down, double depth) {
  const double stiff = 1e5, radius = wire.thickness() / 2, s = 0.37 * wire.length();
  const Point across = detail::cross3(down, Point(1, 0, 0));
  const auto place = [&](double below) -> Point { return Point(s, 0, 0) - (2 * radius - below) * down; };
  Rod tool(wire.length(), RodStiffness{1e9, stiff, stiff, stiff}, 2 * radius, RodSupport::clamped,
           RodSupport::free);
  const auto pose = [&](double below) {
    return RodPose{place(below) - wire.length() / 10 * across, across, down};
  };
  tool.place_left(pose(0));
  World<Element> world({{wire, elements}, {tool, 2}});
  FemModel<Element> model(wire, elements);
  PushRound push(model);
  Capsule<double> capsule;
  capsule.reach = 2 * radius, capsule.normal = -down, capsule.s = s;
  capsule.axis.way = 0.2 * wire.length() * across;
  Pushed<double, 3> pushed{};
  for (int k = 1; k <= 20; ++k) {
    REQUIRE(world.hold(1, RodSide::left, pose(k * depth / 20)) == Status::ok);
    REQUIRE(world.tick() == Status::ok);
    capsule.axis.tip = place(k * depth / 20) - capsule.axis.way / 2;
    pushed = push(capsule);
    REQUIRE(is_answer(pushed.status));
  }
  REQUIRE(world.contacts() == 1);
  const Point force = world.contact(0).force;
  CHECK(world.contact(0).s[0] == Approx(pushed.s).margin(1e-5 * wire.length()));
  return std::abs(force.norm() - std::abs(pushed.force)) / force.norm();
}

}  // namespace

// The tool yields by (L/10)³/3EI, 1e-8 m/N; the rods by 1e-3 m/N and more.
TEST_CASE("a rod across a rod that is held at both ends presses it as a capsule does", "[world]") {
  const Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::clamped);
  CHECK(against_capsule<RoundRod>(wire, 8, {0, 0, -1}, 0.004) < 1e-5);
  CHECK(against_capsule<TwistedRod>(wire, 8, {0, 0, -1}, 0.004) < 1e-5);
  const Rod strip(0.2, RodSection::rectangle(0.003, 0.001), spring_steel, RodSupport::clamped,
                  RodSupport::free);
  CHECK(against_capsule<TwistedRod>(strip, 8, detail::unit(Point(0, 1, -1)), 0.004) < 1e-5);
}
