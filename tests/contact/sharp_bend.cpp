// A circle in a bend that is about as sharp as itself: it may touch at two points, and one is all that is looked for.
#include <cmath>

#include "support/catch.hpp"
#include "support/status.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;

namespace {

using Vector = Vector2<double>;
using Turning = FemModel<Corotational<>>;

/// Largest change of the force in a tick, over the force [-].
struct Hand {
  Touch<Turning>& touch;
  Vector at;
  double step;
  Vector force = {0, 0};
  int ticks = 0, pressing = 0, lost = 0, pinched = 0;
  double go(const Vector& to) {
    const Vector from = at;
    const int steps = static_cast<int>(std::ceil((to - from).norm() / step));
    double largest = 0;
    for (int k = 1; k <= steps; ++k) {
      at = from + (to - from) * (double(k) / steps);
      const TouchResult<double> result = touch.tick(at);
      ++ticks, pressing += result.pressing, lost += result.status == Status::iteration_limit;
      pinched += result.status == Status::out_of_range;
      if (force.norm() > 0) largest = std::max(largest, (result.force - force).norm() / result.force.norm());
      force = result.force;
    }
    return largest;
  }
};

}  // namespace

// A beam between hinges stretches, so F goes with d³ at the most: a step δ explains a change of 3 δ/d, and what slides
// changes it less.  Twice that is allowed down; along the beam a mesh of 32 elements adds its own steps at the nodes.
TEST_CASE("the force stays continuous where a beam bends more sharply than the circle that presses it",
          "[push]") {
  const double length = 1, height = 0.01;
  const Beam beam(length, Section::rectangle(0.02, height), Material{200e9}, Support::pinned,
                  Support::pinned);
  for (const double radius : {0.005, 0.02, 0.05}) {
    Turning model(beam, 32);
    Touch<Turning> touch(model, radius);
    const double top = radius + height / 2, step = 4e-4;
    (void)touch.tick({0.5, top + 0.001});
    Hand hand{touch, {0.5, top + 0.001}, step};
    hand.go({0.5, top - 0.1});
    CAPTURE(radius);
    const int before = hand.ticks;
    CHECK(hand.go({0.5, top - 0.25}) <= 2 * 3 * step / 0.1);
    CHECK(hand.go({0.42, top - 0.25}) <= 0.01);
    CHECK(hand.go({0.45, top - 0.08}) <= 2 * 3 * step / 0.08);
    CHECK(hand.ticks - before > 900);
    CHECK(touch.pressing());
    CHECK(hand.ticks - hand.pressing <= 3);
    if (radius == 0.005) CHECK(hand.lost + hand.pinched <= 10);  // nowhere as sharp as that
    if (radius == 0.05) CHECK(hand.pinched > 10);
  }
}

TEST_CASE("a body that touches again is told of beside others, too", "[push][several]") {
  const double radius = 0.05, height = 0.01;
  const Beam beam(1, Section::rectangle(0.02, height), Material{200e9}, Support::pinned, Support::pinned);
  Turning one(beam, 32);
  Touch<Turning> touch(one, radius);
  FemModel<Several<Corotational<>, 2>> two(beam, 32);
  TouchSeveral several(two, {radius}, {Prop<>::peg({0.1, 0.2}, 0.01)});
  int again = 0, other = 0;
  for (int k = 0; k < 700; ++k) {
    const Vector at(0.5, radius + height / 2 - 4e-4 * k);
    const auto alone = touch.tick(at);
    const auto beside = several.tick(at);
    again += alone.status == Status::out_of_range;
    other += beside.status != alone.status;
    REQUIRE((beside.force(0) - alone.force).norm() <= 1e-6 * (1 + alone.force.norm()));
  }
  CHECK(again > 50);
  CHECK(other == 0);
}

TEST_CASE("a hand that a beam with mass touches again is told of it", "[push][dynamics]") {
  const double radius = 0.05, height = 0.01, reach = radius + height / 2;
  Material steel{200e9};
  steel.density = 7850, steel.damping.drag = 50;
  const Beam bar(1, Section::rectangle(0.02, height), steel, Support::pinned, Support::pinned);
  DynamicModel<Corotational<>> model(bar, 32, 4);
  int again = 0, wrong = 0;
  DynamicModel<Corotational<>>::Felt felt{0, Status::ok};
  for (int k = 0; k < 500; ++k) {
    const Vector hand(0.5, reach - 5e-4 * k);
    felt = model.step(1e-3, {{0.5, hand, reach, 1}, 1e8, 1e4});
    REQUIRE(is_answer(felt.status));
    if (!(felt.force < 0)) continue;
    // Where the avatar is, and how deep the beam lies in it beside where it touches.
    const Vector centre = felt.point + reach * felt.normal;
    double deep = 0;
    for (int i = 0; i <= 2000; ++i)
      deep = std::max(deep, reach - (model.shape().position(i / 2000.0) - centre).norm());
    again += felt.status == Status::out_of_range;
    wrong += felt.status == Status::out_of_range ? deep < 1e-7 : deep > 1e-5;
  }
  CHECK(again > 50);
  CHECK(wrong == 0);
  // No time has passed: it is told the same, whatever hand asks.
  const auto still = model.step(0, {{0.1, {0.1, 1}, reach, 1}, 1e8, 1e4});
  CHECK(still.status == felt.status);
  CHECK(still.force == felt.force);
}
