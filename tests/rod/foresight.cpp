// A hand that goes on finds a rod where it was foreseen: fewer linear solves, the same force.
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/push_round.hpp"
#include <hapbeam/contact/touch.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// A hand that goes in and out twice in a thousand ticks, while it leans from side to side.
Point hand(int tick, double top) {
  const double depth = 0.004 + 0.012 * (1 - std::cos(4e-3 * pi * tick)) / 2,
               lean = 0.2 * std::sin(4e-3 * pi * tick);
  return {0.15 + 0.02 * std::sin(2e-3 * pi * tick), (top - depth) * std::cos(lean),
          (top - depth) * std::sin(lean)};
}

template <class Element>
void check_stroke(const Rod& rod) {
  const double radius = 0.03, top = radius + rod.thickness() / 2;
  FemModel<Element> model(rod, 8), other(rod, 8);
  Touch<FemModel<Element>> touch(model, radius);
  for (int k = 0; k <= 40; ++k) (void)touch.tick(Point(0.15, top + 1e-4 - 1e-4 * k, 0));
  int solves = 0;
  for (int k = 0; k < 500; ++k) {
    const auto felt = touch.tick(hand(k, top));
    REQUIRE(felt.pressing);
    REQUIRE(felt.status == Status::ok);
    solves += model.report().solves;
    if (k % 50 != 49) continue;
    // The same press, from rest.
    other.reset();
    const auto pressed =
        PushRound(other)({felt.contact.s, {hand(k, top), Point(0, 0, 0)}, top, felt.contact.normal});
    REQUIRE(pressed.status == Status::ok);
    CHECK(felt.force.norm() == Approx(-pressed.force).epsilon(5e-6));
  }
  CAPTURE(solves);
  CHECK(solves <= 2.3 * 500);
}

}  // namespace

TEST_CASE("a hand that goes on takes two linear solves a tick, and feels what it would from rest", "[rod]") {
  const auto rod = [](const RodSection& section) {
    return Rod(0.3, section, spring_steel, RodSupport::clamped, RodSupport::free);
  };
  SECTION("without twist") { check_stroke<RoundRod>(rod(RodSection::circle(0.0015))); }
  SECTION("with twist") { check_stroke<TwistedRod>(rod(RodSection::circle(0.0015))); }
}
