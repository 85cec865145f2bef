// Contacts that share an element: each yields where the others push, as in a mesh that has them apart.
#include <algorithm>
#include <cmath>
#include <vector>

#include "body_scenes.hpp"
#include "once_world.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double radius = 0.001, length = 0.2, bar = 0.005;

enum class Bars { pinch, carry };

/// A rod whose ends a hand leads down over two bars across it, or which lies between one bar below and one that comes down.
template <class Element>
World<Element> scene(Bars bars, double apart, double friction, int elements) {
  const bool flat = Element::unknowns == 7;
  const RodSection section =
      flat ? RodSection::rectangle(2 * radius, radius) : RodSection::circle(2 * radius);
  const Rod rod(length, section, RodMaterial{70e9, 26e9}, RodSupport::clamped, RodSupport::clamped);
  const double off = bar + 0.55 * rod.thickness(), at = bars == Bars::pinch ? 0.112 : 0.1001 - apart / 2;
  const auto across = [&](double x, double z) {
    return RigidBody::capsule({x, -0.05, z}, {x, 0.05, z}, bar);
  };
  return World<Element>({{rod, elements, {friction, friction}}},
                        {across(at, -off), across(at + apart, bars == Bars::pinch ? off : -off)});
}

RodPose down(double x, double by) { return {{x, 0, -by}, {1, 0, 0}, {0, 1, 0}}; }
template <class Element>
Status lower(World<Element>& world, Bars bars, double by) {
  if (bars == Bars::pinch) {
    REQUIRE(world.place(1, down(0, by)) == Status::ok);
  } else {
    REQUIRE(world.hold(0, RodSide::left, down(0, by)) == Status::ok);
    REQUIRE(world.hold(0, RodSide::right, down(length, by)) == Status::ok);
  }
  return world.tick();
}

struct Agreement {
  int compared = 0, unlike = 0;
  double worst = 0;  // of forces, over the largest
};
/// Of few elements with 128, all but the first touch of which are apart.
template <class Element>
Agreement compare(Bars bars, double friction, double deepest) {
  Agreement sum;
  for (const double apart : {0.003, 0.006, 0.012})
    for (const int elements : {9, 15}) {
      World<Element> coarse = scene<Element>(bars, apart, friction, elements),
                     fine = scene<Element>(bars, apart, friction, 128);
      for (double by = 0; by < deepest; by += 2e-5) {
        const Status is = lower(coarse, bars, by), should_be = lower(fine, bars, by);
        sum.unlike += is != should_be || coarse.contacts() != fine.contacts();
        if (is != Status::ok || should_be != Status::ok || fine.contacts() < 2 || coarse.contacts() < 2)
          continue;
        ++sum.compared;
        const bool turned = coarse.contact(0).rod != fine.contact(0).rod;
        const auto force = [](const World<Element>& of, int k) { return Point(of.contact(k).force); };
        const double most = std::max(force(fine, 0).norm(), force(fine, 1).norm());
        for (int k = 0; k < 2; ++k)
          sum.worst = std::max(sum.worst, (force(coarse, k) - force(fine, turned ? 1 - k : k)).norm() / most);
      }
    }
  return sum;
}

}  // namespace

TEMPLATE_TEST_CASE("contacts that share an element push as in a finer mesh", "[world]", RoundRod,
                   TwistedRod) {
  for (const Bars bars : {Bars::pinch, Bars::carry}) {
    const double deepest = bars == Bars::pinch ? 2.6e-4 : 6e-4;
    const Agreement smooth = compare<TestType>(bars, 0, deepest),
                    rough = compare<TestType>(bars, 0.3, deepest);
    INFO((bars == Bars::pinch ? "pinch" : "carry")
         << ": " << smooth.compared << ", worst " << smooth.worst << ", unlike " << smooth.unlike
         << "; rough " << rough.compared << ", worst " << rough.worst << ", unlike " << rough.unlike);
    CHECK(smooth.compared > 15);
    CHECK(smooth.unlike == 0);
    CHECK(smooth.worst < 2e-4);
    CHECK(rough.compared > 15);
    // One tick sooner or later.
    CHECK(rough.unlike <= 2);
    // Along itself an element stretches evenly, on either side of what sticks.
    CHECK(rough.worst < 3e-2);
  }
}

// Trapezoids of twice as many ticks are off by a quarter.
TEMPLATE_TEST_CASE("a hand's work is what contacts that share an element store", "[world]", RoundRod,
                   TwistedRod) {
  const auto lack = [](int ticks) {
    World<TestType> world = scene<TestType>(Bars::carry, 0.006, 0, 9);
    constexpr double touched = 3e-4, deepest = 6e-4;
    for (double by = 0; by < touched; by += 2e-5) REQUIRE(lower(world, Bars::carry, by) == Status::ok);
    REQUIRE(lower(world, Bars::carry, touched) == Status::ok);
    REQUIRE(world.contacts() == 2);
    const auto pull = [&] {
      return world.held(0, RodSide::left).force.z() + world.held(0, RodSide::right).force.z();
    };
    const double stored = world.strain_energy(), step = (deepest - touched) / ticks;
    double work = 0, before = pull();
    for (int k = 1; k <= ticks; ++k) {
      REQUIRE(lower(world, Bars::carry, touched + k * step) == Status::ok);
      CHECK(world.solves() <= 4);
      work -= step * (before + pull()) / 2, before = pull();
    }
    return work / (world.strain_energy() - stored) - 1;
  };
  const double coarse = lack(20), fine = lack(40);
  CHECK(std::abs(coarse) < 1e-3);
  CHECK(std::abs((4 * fine - coarse) / 3) < 1e-8);
}

// As the caps of a chain of capsules do.
TEST_CASE("two bodies at one place share what one would bear", "[world]") {
  for (const double friction : {0.0, 0.3}) {
    World<RoundRod> two = scene<RoundRod>(Bars::carry, 0, friction, 9),
                    one = scene<RoundRod>(Bars::carry, 0, friction, 9);
    REQUIRE(one.place(1, {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}) == Status::ok);
    for (double by = 0; by < 6e-4; by += 2e-5) {
      REQUIRE(lower(two, Bars::carry, by) == Status::ok);
      REQUIRE(lower(one, Bars::carry, by) == Status::ok);
      if (one.contacts() == 0) continue;
      REQUIRE(two.contacts() == 2);
      const Point force = one.contact(0).force, first = two.contact(0).force, second = two.contact(1).force;
      CHECK((first + second - force).norm() <= 1e-4 * force.norm());
      CHECK((first - second).norm() <= 1e-2 * force.norm());
    }
  }
}
