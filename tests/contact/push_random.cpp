// 10⁵ ticks of a hand that keeps to no rule: slides, jumps, goes through the ruler and round its ends and into its clamp.
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include "support/status.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Turning = FemModel<Corotational<>>;
constexpr double length = ruler_length, thickness = ruler_thickness;

/// Largest distance by which the centreline lies within `reach` of a point, at samples [m]; it misses their
/// distance squared over 8 reach, and half of that more where the ruler bends away.
double penetration(const Centreline<double>& line, const Vector& point, double reach, int samples) {
  double nearest = 1e9;
  for (int i = 0; i <= samples; ++i) {
    const double s = line.length() * i / samples;
    const Displacement<double> at = line.at(s);
    nearest = std::min(nearest, (Vector(s + at.u, at.w) - point).norm());
  }
  return reach - nearest;
}

struct Tally {
  int ticks = 0, pressing = 0, refused = 0, missed = 0, missed_again = 0;
  double deepest = 0, widest = 0;  ///< of a contact that is ok: penetration and gap [m]
};

/// The laws that no tick may break, and a tally of what happened.
void count(Tally& tally, const TouchResult<double>& r, const Turning& model, const Vector& hand,
           double reach) {
  ++tally.ticks;
  REQUIRE(r.force.allFinite());
  REQUIRE(r.force.dot(r.contact.normal) >= 0);
  REQUIRE(std::abs(cross<double>(r.force, r.contact.normal)) <= 1e-12 * r.force.norm());
  REQUIRE((is_answer(r.status) || r.status == Status::iteration_limit));
  if (!r.pressing) REQUIRE(r.force.isZero(0));
  for (const auto& node : model.shape())
    REQUIRE((std::isfinite(node.u) && std::isfinite(node.w) && std::isfinite(node.theta)));
  tally.pressing += r.pressing;
  tally.refused += !is_answer(r.status);
  const bool ok = r.status == Status::ok;
  const int samples = 300;
  const double inside = ok && (r.pressing || tally.ticks % 7 == 0 || tally.missed > 0 || r.contact.touching)
                            ? penetration(model.shape(), hand, reach, samples)
                            : 0;
  if (ok && r.pressing) {
    tally.deepest = std::max(tally.deepest, inside);
    tally.widest = std::max(tally.widest, -inside);
  }
  static thread_local bool before = false;
  const bool missed = ok && !r.pressing && inside > 1e-5;
  tally.missed += missed;
  tally.missed_again += missed && before;
  before = missed;
}

void check(const Tally& tally, double reach) {
  CAPTURE(tally.ticks, tally.pressing, tally.refused, tally.missed, tally.missed_again, tally.deepest,
          tally.widest);
  const double sample = length / 300;
  // Where pieces that turn by more than a radian push along the beam, by up to a twentieth of the contact's force, its place is off by that angle.
  const double askew = 0.05;
  CHECK(tally.deepest <= 1e-6 + reach * askew * askew / 2);
  // Between two samples the circle goes away from a chord, and the beam, which is bent to half of the circle's radius at most, the other way.
  CHECK(tally.widest <= 1e-6 + 3 * sample * sample / (8 * reach));
  // A beam that springs back may come to lie where the hand is by then: found the tick after, and never later.
  CHECK(tally.missed_again == 0);
  CHECK(tally.missed <= tally.ticks / 1000);
  CHECK(tally.pressing >= tally.ticks / 10);
}

}  // namespace

TEST_CASE("random ticks with jumps: never NaN, never a pull, never a miss that is not said", "[push]") {
  for (const double radius : {0.002, 0.005, 0.02}) {
    Turning model(steel_ruler(), 8);
    Touch<Turning> touch(model, radius);
    Random random(7);
    Tally tally;
    Vector hand(0.2, 0.05), speed(0, 0);
    for (int k = 0; k < 34000; ++k) {
      if (k % 200 == 0) hand = {random(-0.05, 0.35), random(0.2)};
      if (k % 50 == 0) speed = {random(0.001), random(0.001)};
      hand += speed;
      if (hand.x() < -0.05 || hand.x() > 0.36) speed.x() = -speed.x();
      if (std::abs(hand.y()) > 0.28) speed.y() = -speed.y();
      count(tally, touch.tick(hand), model, hand, radius + thickness / 2);
    }
    CAPTURE(radius);
    check(tally, radius + thickness / 2);
    CHECK(tally.refused <= tally.ticks * 4 / 100);  // jumps to where the ruler cannot be
  }
}

// What a hand can do: 0.2 m/s at 1 kHz, from place to place, on both sides and round the tip.
TEST_CASE("random ways at the speed of a hand are followed without a refusal", "[push]") {
  Turning model(steel_ruler(), 8);
  Touch<Turning> touch(model, 0.005);
  Random random(7);
  Tally tally;
  Vector hand(0.2, 0.05), target(0.2, -0.05);
  for (int k = 0; k < 20000; ++k) {
    const Vector way = target - hand;
    if (way.norm() < 4e-4) target = {random(0, 0.32), random(0.15)};
    else hand += way.normalized() * 2e-4;
    count(tally, touch.tick(hand), model, hand, 0.0055);
  }
  check(tally, 0.0055);
  CHECK(tally.refused == 0);
}

// From one side to the other in one tick: the ruler goes along, and comes back when the hand does.
TEST_CASE("a step through the ruler takes it along", "[push]") {
  Random random(11);
  for (int trial = 0; trial < 300; ++trial) {
    Turning model(steel_ruler(), 8);
    Touch<Turning> touch(model, 0.005);
    const int side = trial % 2 ? 1 : -1;
    const double x = random(0.05, 0.29), far = x * random(0.05, 0.4);
    (void)touch.tick({x, side * 0.02});
    TouchResult<double> r;
    int ticks = 0;
    do r = touch.tick({x, -side * far});
    while (r.status == Status::iteration_limit && ++ticks < 20);
    CAPTURE(trial, x, far, ticks, name(r.status));
    REQUIRE(ticks < 20);
    for (int k = 0; k < 5; ++k) r = touch.tick({x, -side * far});
    if (r.pressing) {  // else it has slipped off the tip
      CHECK(side * r.force.y() > 0);
      CHECK(std::abs(penetration(model.shape(), {x, -side * far}, 0.0055, 3000)) <= 2e-6);
    } else {
      CHECK(x > 0.2);
      continue;
    }
    r = touch.tick({x, side * 0.02});
    CHECK_FALSE(r.pressing);
    CHECK(model.shape()[8].w == 0);
  }
}
