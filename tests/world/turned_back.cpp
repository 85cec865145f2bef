// A rough ball that a hand leads to and fro beside a rod: two ways to find what it feels, as one avatar and as a body of a World.
#include <algorithm>
#include <cmath>

#include "once_world.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// How much both forces differ at most, of a stroke that begins above the rod and turns 20 times.
double differ(unsigned seed, const Friction& friction) {
  Random random(seed);
  const double length = random(0.15, 0.35), thickness = random(0.0008, 0.002), radius = random(0.002, 0.01);
  const Rod rod(length, RodSection::circle(thickness), spring_steel, RodSupport::clamped, RodSupport::free);
  const Point start(length * random(0.3, 0.6), 0, radius + thickness / 2 + 1e-4);
  FemModel<RoundRod> model(rod, 16);
  Touch<FemModel<RoundRod>> touch(model, radius, friction);
  World<RoundRod> world({{rod, 16}}, {RigidBody::sphere(start, radius, friction)});
  const Point least(0.25 * length, -0.3 * radius, -0.1 * length),
      most(0.7 * length, 0.3 * radius, radius + 2 * thickness);
  double worst = 0;
  Point at = start, by(0, 0, -2e-5);
  for (int tick = 0; tick < 1000; ++tick) {
    if (tick >= 100 && tick % 50 == 0) by = 4e-5 * Point(random(1.0), random(0.3), random(1.0));
    for (int c = 0; c < 3; ++c)
      by[c] = at[c] < least[c] ? std::abs(by[c]) : at[c] > most[c] ? -std::abs(by[c]) : by[c];
    at += by;
    INFO("seed " << seed << ", friction " << friction.sliding << ", tick " << tick);
    const auto felt = touch.tick(at);
    REQUIRE(world.place(0, {at - start, {1, 0, 0}, {0, 1, 0}}) == Status::ok);
    REQUIRE(felt.status == Status::ok);
    REQUIRE(world.tick() == Status::ok);
    REQUIRE(world.contacts() == (felt.pressing ? 1 : 0));
    if (!felt.pressing) continue;
    const Point force = -world.contact(0).force;
    // In the first ticks of a touch the skins differ.
    if (tick > 20) worst = std::max(worst, (felt.force - force).norm() / force.norm());
  }
  return worst;
}

}  // namespace

// Friction holds the rod up beside its top: where the hand turns back along it that turns round, and is far stiffer along the rod than across.
TEST_CASE("a rough ball that turns back beside a rod feels as one avatar does", "[world][friction]") {
  for (const unsigned seed : {504u, 506u, 509u}) {
    for (const double mu : {0.0, 0.1, 0.3}) {
      const double off = differ(seed, mu);
      INFO("off by " << off);
      CHECK(off < (mu > 0 ? 1e-3 : 2e-6));
    }
  }
}
