// Models in space as ForceModels: pushed along one direction each keeps the contract of a planar one.
#include "conformance/force_model_suite.hpp"
#include "once_training.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/pushed_along.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

const Point across{0, 0.6, 0.8};

Rod straight(const RodSupport& left, const RodSupport& right) {
  return {0.5, RodSection::circle(0.005), spring_steel, left, right};
}

template <class Model>
void check(const Model& model, const Point& normal = across) {
  check_force_model([&] { return PushedAlong<Model>(model, normal); });
}

}  // namespace

TEST_CASE("a rod keeps the contract of a ForceModel", "[contract][rod]") {
  const RodSupport c = RodSupport::clamped, f = RodSupport::free, h = RodSupport::hinged;
  SECTION("without twist, as a cantilever") { check(FemModel<RoundRod>(straight(c, f), 8)); }
  SECTION("without twist, between hinges") { check(FemModel<RoundRod>(straight(h, h), 8)); }
  SECTION("with twist, between clamps") { check(FemModel<TwistedRod>(straight(c, c), 8)); }
  SECTION("with twist, as a cantilever") { check(FemModel<TwistedRod>(straight(c, f), 8)); }
  SECTION("with twist, flat and pushed askew") {
    check(FemModel<TwistedRod>(Rod(0.5, RodSection::rectangle(0.01, 0.005), spring_steel, c, c), 8));
  }
}

TEST_CASE("a rod that is bent, tapered, loaded or laid in a bed keeps the contract of a ForceModel",
          "[contract][rod]") {
  const RodSupport c = RodSupport::clamped, f = RodSupport::free;
  SECTION("a hook, out of its plane") { check(FemModel<TwistedRod>(pressed_rod("hook").rod, 16), {0, 0, 1}); }
  SECTION("a strip that is twisted by nature") {
    Rod strip(0.5, RodSection::rectangle(0.01, 0.005), spring_steel, c, c);
    strip.naturally({{0.5, 0, 0, 3}});
    check(FemModel<TwistedRod>(strip, 16));
  }
  SECTION("a taper") {
    Rod rod = straight(c, f);
    rod.section([](double s) { return RodSection::circle(0.006 - 0.008 * s); });
    check(FemModel<RoundRod>(rod, 16));
  }
  SECTION("under its weight") {
    Rod rod = straight(c, c);
    rod.weight(7850, {0, -9.81, 0});
    check(FemModel<RoundRod>(rod, 16));
  }
}
