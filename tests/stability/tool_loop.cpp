// A tool of a World in the hand, whatever it meets: the loop comes to rest and gives no energy.
#include <cmath>

#include "once_world.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/turning_scenes.hpp"
#include <hapbeam/world/world_tool.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

enum class Meets { wire, floor, vessel };

/// Along x, a little above a wire across it, on its way down to a floor, or in a vessel that bends on.
template <class Element>
World<Element> tool_that(Meets what, double friction, const RodSupport& hand, double thickness = 0.002) {
  const RodMaterial steel{200e9, 77e9};
  const double length = 0.2, apart = 2e-4;
  Rod tool(length, RodSection::circle(thickness), steel, hand, RodSupport::free);
  const Friction mu(friction, friction);
  if (what == Meets::wire) {
    Rod wire(0.25, RodSection::circle(0.0015), steel, RodSupport::clamped, RodSupport::clamped);
    wire.place_left({{0, 0, -0.125}, {0, 0, 1}, {1, 0, 0}});
    tool.place_left({{-0.12, thickness / 2 + 0.00075 + apart, 0.01}, {1, 0, 0}, {0, 1, 0}});
    return World<Element>({{tool, 8, mu}, {wire, 8, mu}});
  }
  if (what == Meets::floor) {
    const double slope = 0.5;
    tool.place_left({{0, length * std::sin(slope) + thickness / 2 + apart, 0},
                     {std::cos(slope), -std::sin(slope), 0},
                     {0, 0, 1}});
    return World<Element>({{tool, 8, mu}}, {RigidBody::plane({0, 0, 0}, {0, 1, 0}, friction)});
  }
  tool.place_left({{-0.1, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const ArcSpline axis = ArcSpline({0, 0, 0}, {1, 0, 0}).arc(0.12).arc(0.2, {0, 20, 0});
  return World<Element>({{tool, 8, mu}}, {RigidBody::tube(axis, 0.004, friction)});
}

/// Any hand of the region that docs/haptics.md states.
TurningSituation any_hand(Random& random) {
  const auto one_of = [&](double a, double b) { return random.integer(0, 1) ? a : b; };
  return {one_of(300, 1000),  one_of(0, 2),       one_of(0.05, 0.4),    one_of(4.5e-4, 5e-3),
          one_of(5e-4, 5e-3), one_of(3e-5, 2e-4), one_of(0.5e-3, 2e-3), random.integer(0, 3)};
}
/// It leans, twists and turns from one moment to the next; into a vessel it pushes.
Turning any_way(Random& random, Meets what, const TurningSituation& who) {
  const double by = who.hand_stiffness * random(0.004, 0.036);
  const auto any = [&](double size) { return Eigen::Vector3d(random(size), random(size), random(size)); };
  Turning hand;
  hand.push =
      what == Meets::vessel ? Eigen::Vector3d(by, -0.3 * by, 0) : Eigen::Vector3d(random(0.3) * by, -by, 0);
  hand.twist = any(0.004), hand.led = any(0.1);
  return hand;
}

template <class Element>
TurningResponse response(World<Element>& world, const Turning& hand, const TurningSituation& who,
                         const GripCoupling& coupling, double duration) {
  WorldTool<Element> tool(world, 0);
  Grip<WorldTool<Element>> grip(tool, RodSide::left);
  ServoOptions options;
  options.delay_ticks = who.delay;
  return turning_response(grip, hand, who.options(), options, coupling, 0.5, duration);
}

template <class Element>
void check_hands(Meets what, double friction, int hands) {
  constexpr double at_rest = 1e-3, turns_no_more = 0.03;  // [m/s], [rad/s]
  Random random(31);
  int touching = 0, failed = 0;
  for (int i = 0; i < hands; ++i) {
    const TurningSituation who = any_hand(random);
    const Turning hand = any_way(random, what, who);
    const GripCoupling coupling = GripCoupling::for_device(who.device(), who.delay);
    World<Element> world =
        tool_that<Element>(what, friction, coupling.support(), what == Meets::vessel ? 0.001 : 0.002);
    const TurningResponse r = response(world, hand, who, coupling, 4);
    CAPTURE(static_cast<int>(what), friction, i, who.hand_stiffness, who.hand_damping, who.grip_mass,
            who.gimbal_damping, who.gimbal_friction, who.period, who.delay);
    CHECK(r.last_speed <= at_rest);
    CHECK(r.last_rate <= turns_no_more);
    CHECK(r.least_energy >= -1e-9);
    CHECK(r.generated == 0);
    touching += world.contacts() > 0, failed += r.record.failed_ticks > 3;
  }
  CHECK(touching > 0.8 * hands);
  CHECK(failed == 0);
}

}  // namespace

TEST_CASE("a hand with a tool that meets a rod, a floor or a vessel comes to rest and gains nothing",
          "[world][grip][loop]") {
  for (const Meets what : {Meets::wire, Meets::floor, Meets::vessel})
    for (const double friction : {0.0, 0.3}) {
      check_hands<RoundRod>(what, friction, 8);
      check_hands<TwistedRod>(what, friction, 8);
    }
}

TEST_CASE(
    "the criterion can fail: sixteen times the springs without dampers, late by three ticks, give energy to "
    "the hand",
    "[world][grip][loop]") {
  const TurningSituation who{300, 0, 0.05, 4.5e-4, 5e-4, 3e-5, 2e-3, 3};
  const GripCoupling safe = GripCoupling::for_device(who.device(), who.delay),
                     stiff({16 * safe.place().stiffness, 0}, {16 * safe.turning().stiffness, 0}, who.period);
  Random random(32);
  World<TwistedRod> world = tool_that<TwistedRod>(Meets::wire, 0, stiff.support());
  const TurningResponse r = response(world, any_way(random, Meets::wire, who), who, stiff, 2);
  CHECK(r.least_energy < -1e-9);
  CHECK(r.generated > 0);
}
