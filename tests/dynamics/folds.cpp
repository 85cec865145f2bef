// No step folds an element: a shape that is held by its stiffness along itself alone is none of the rod.
#include <algorithm>

#include "once_world.hpp"
#include "support/catch.hpp"
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using Point = VectorOf<double, 3>;

namespace {

RodMaterial nylon() {
  RodMaterial material = RodMaterial::isotropic(3e9, 0.3);
  material.density = 1000;
  return material;
}
/// The least cosine between tangents of nodes that follow each other.
double sharpest_turn(const Centreline<double, 3>& line) {
  double least = 1;
  for (int i = 0; i < line.segments(); ++i)
    least = std::min(least, line[i].tangent.normalized().dot(line[i + 1].tangent.normalized()));
  return least;
}

}  // namespace

// Elements are turned by their axial stiffness alone as soon as r' is reversed between two nodes: energy from nothing, a thousand times the hand's.
TEST_CASE("a wire that a hand drags along in leaps is folded in no step", "[dynamics][rod]") {
  int steps = 0;
  for (const int elements : {4, 8})
    for (const double diameter : {1e-4, 2e-4})
      for (const double leap : {1e-3, 3e-3, 6e-3})
        for (const double x : {0.02, 0.045, 0.07}) {
          const Rod wire(0.11, RodSection::circle(diameter), nylon(), RodSupport::clamped,
                         RodSupport::hinged);
          DynamicModel<RoundRod> model(wire, elements, 8);
          Touch<DynamicModel<RoundRod>> touch(model, 0.002);
          for (int k = 0; k < 60; ++k) {
            (void)touch.tick(Point(x, -0.05, leap * k - 0.0022), 1e-3, 7, 0.01, Point(0, 0.1, 0));
            REQUIRE(sharpest_turn(model.shape()) > -0.5);
            ++steps;
          }
        }
  CHECK(steps == 36 * 60);
}

// Where it may fold, the thicker one stays so after 24 ms, ok, and takes forty times the energy.
TEST_CASE("a wire of a World whose end a hand rushes past the other end is folded in no step",
          "[dynamics][world]") {
  int steps = 0;
  for (const int elements : {4, 8})
    for (const double diameter : {4e-4, 1e-3}) {
      const Rod wire(0.11, RodSection::circle(diameter), nylon(), RodSupport::clamped, RodSupport::clamped);
      World<RoundRod> world({{wire, elements}});
      for (int k = 0; k < 60; ++k) {
        REQUIRE(world.hold(0, RodSide::right, {{0.11 - 3e-3 * k, 0, 1.5e-3 * k}, {1, 0, 0}, {0, 1, 0}}) ==
                Status::ok);
        (void)world.step(1e-3);
        REQUIRE(sharpest_turn(world.shape(0)) > -0.5);
        ++steps;
      }
    }
  CHECK(steps == 4 * 60);
}

// A light wire that a hand presses beside its end may snap to where its last element doubles back: 1.7 J of the hand's 0.03, ok from then on.
TEST_CASE("a light wire that is pressed beside an end that is held is squeezed together in no step",
          "[dynamics][rod]") {
  int answers = 0;
  for (const double density : {20, 200})
    for (const int elements : {4, 8})
      for (const double place : {0.985, 0.99}) {
        RodMaterial light = RodMaterial::isotropic(6e8, 0.3);
        light.density = density;
        const Rod wire(0.125, RodSection::circle(0.00225), light, RodSupport::clamped, RodSupport::hinged);
        DynamicModel<RoundRod> model(wire, elements, 2);
        Touch<DynamicModel<RoundRod>> touch(model, 0.0034);
        for (int k = 0; k < 300; ++k) {
          const double z = 0.0046 - 1e-4 * std::min(k, 130) + 2e-4 * std::max(k - 200, 0);
          if (touch.tick(Point(place * 0.125, 0, z), 2e-3, 8000, 0).status != Status::ok) continue;
          const auto line = model.shape();
          for (int i = 0; i < line.size(); ++i) REQUIRE(line[i].tangent.norm() > 0.7);
          ++answers;
        }
      }
  CHECK(answers > 0);
}
