// No step folds an element: a shape that is held by its stiffness along itself alone is none of the rod.
#include "support/catch.hpp"
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;

// Elements are turned by their axial stiffness alone as soon as r' is reversed between two nodes: energy from nothing, a thousand times the hand's.
TEST_CASE("a wire that a hand drags along in leaps is folded in no step", "[dynamics][rod]") {
  using Point = VectorOf<double, 3>;
  RodMaterial nylon = RodMaterial::isotropic(3e9, 0.3);
  nylon.density = 1000;
  int steps = 0;
  for (const int elements : {4, 8})
    for (const double diameter : {1e-4, 2e-4})
      for (const double leap : {1e-3, 3e-3, 6e-3})
        for (const double x : {0.02, 0.045, 0.07}) {
          const Rod wire(0.11, RodSection::circle(diameter), nylon, RodSupport::clamped, RodSupport::hinged);
          DynamicModel<RoundRod> model(wire, elements, 8);
          Touch<DynamicModel<RoundRod>> touch(model, 0.002);
          for (int k = 0; k < 60; ++k) {
            (void)touch.tick(Point(x, -0.05, leap * k - 0.0022), 1e-3, 7, 0.01, Point(0, 0.1, 0));
            const auto line = model.shape();
            for (int i = 0; i < line.segments(); ++i)
              REQUIRE(line[i].tangent.normalized().dot(line[i + 1].tangent.normalized()) > -0.5);
            ++steps;
          }
        }
  CHECK(steps == 36 * 60);
}
