// What a touch of a rod remembers ends with the release: the next one is that of a new rod, from whichever side it comes.
#include <algorithm>

#include "rod/touching.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

TEMPLATE_TEST_CASE("a rod that was touched and let go is touched as a new one", "[rod][contract]", RoundRod,
                   TwistedRod) {
  using Model = FemModel<TestType>;
  const double radius = 0.005, reach = radius + 0.0005;
  const Point home(0.14, 0, 0), end(0.2 + 4 * reach, 0, 0);
  const auto nothing = [](const Point&, const Felt& r) { check_law(r); };
  const auto stroke = [&](Touch<Model>& touch, const Point& n) {
    std::vector<double> forces;
    int begins = 0, ends = 0;
    bool before = false;
    const auto look = [&](const Point&, const Felt& r) {
      check_law(r);
      begins += r.pressing && !before, ends += before && !r.pressing;
      before = r.pressing;
      forces.push_back(r.force.dot(n));
    };
    const Point above = home + 2 * reach * n, below = home + (reach - 0.004) * n;
    move(touch, above, below, Point::Zero(), 60, look);
    move(touch, below, above, Point::Zero(), 60, look);
    CHECK((begins == 1 && ends == 1));
    return forces;
  };
  Model model(wire(), 8);
  Touch<Model> touch(model, radius);
  Point hand = end;
  for (const Point& n : {Point(0, 0, 1), Point(0, 0, -1), Point(0, 0.6, 0.8)}) {
    const Point above = home + 2 * reach * n;
    // Past the end, so that the way does not cross the rod.
    move(touch, hand, end + 2 * reach * n, Point::Zero(), 20, nothing);
    move(touch, end + 2 * reach * n, above, Point::Zero(), 20, nothing);
    const auto again = stroke(touch, n);
    Model fresh(wire(), 8);
    Touch<Model> first(fresh, radius);
    const auto expected = stroke(first, n);
    const double largest = *std::max_element(expected.begin(), expected.end());
    CHECK(largest > 0.03);
    // The solver stops at 1e-6 of the force.
    for (std::size_t k = 0; k < expected.size(); ++k)
      CHECK(std::abs(again[k] - expected[k]) <= 1e-6 * largest);
    // Round its end to the other side, and a step through it, which takes it along.
    move(touch, above, end + 2 * reach * n, Point::Zero(), 20, nothing);
    move(touch, end + 2 * reach * n, end - 2 * reach * n, Point::Zero(), 20, nothing);
    move(touch, end - 2 * reach * n, home - 2 * reach * n, Point::Zero(), 20, nothing);
    CHECK_FALSE(touch.pressing());
    CHECK(touch.tick(home + 1.5 * reach * n).force.dot(n) < 0);
    move(touch, home + 1.5 * reach * n, home - 2 * reach * n, Point::Zero(), 20, nothing);
    CHECK_FALSE(touch.pressing());
    CHECK(model.strain_energy() == 0);
    hand = end - 2 * reach * n;
    move(touch, home - 2 * reach * n, hand, Point::Zero(), 20, nothing);
  }
}

// Whichever coil it presses yields, so that the other one is nearer in the next tick.
TEST_CASE("a ball that rests between two coils of a spring keeps to one of them", "[rod][contact]") {
  const PressedRod spring = pressed_rod("spring");
  int touched = 0;
  for (const double radius : {0.003, 0.005, 0.008})
    for (const double around : {0.0, 2.0, 4.0})
      for (const double height : {0.003, 0.006, 0.009, 0.012})
        for (const double inside : {0.0005, 0.002}) {
          FemModel<TwistedRod> model(spring.rod, 24);
          Touch<FemModel<TwistedRod>> touch(model, radius);
          const auto at = [&](double in) {
            const double r = 0.0105 + radius - in;
            return Point(r * std::cos(around), r * std::sin(around), height);
          };
          for (int k = 0; k <= 200; ++k) (void)touch.tick(at(-0.001 + (0.001 + inside) * k / 200));
          auto felt = touch.tick(at(inside));
          for (int k = 0; k < 60; ++k) felt = touch.tick(at(inside));
          touched += felt.pressing;
          double apart = 0;
          for (int k = 0; k < 10; ++k) {
            const auto next = touch.tick(at(inside));
            apart = std::max(apart, (next.force - felt.force).norm());
            felt = next;
          }
          INFO("radius " << radius << ", around " << around << ", height " << height << ", inside "
                         << inside);
          CHECK(apart <= 1e-6 * (felt.force.norm() + 1e-3));
        }
  CHECK(touched > 40);
}
