// What a rod is made of is checked where it enters: field, value, unit and what is allowed.
#include <functional>
#include <limits>

#include "rod/rods.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

std::string rejection(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

Rod wire() {
  return Rod(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
}

}  // namespace

TEST_CASE("sections of a rod have the numbers of their closed forms", "[rod]") {
  const RodSection circle = RodSection::circle(0.002), ellipse = RodSection::ellipse(0.004, 0.002),
                   square = RodSection::rectangle(0.01, 0.01), strip = RodSection::rectangle(0.02, 0.001),
                   tube = RodSection::tube(0.003, 0.002);
  CHECK(circle.torsion == Approx(circle.inertia1 + circle.inertia2).epsilon(1e-14));
  CHECK(ellipse.inertia2 == Approx(4 * ellipse.inertia1).epsilon(1e-14));  // wide along d1: stiff about d2
  // J = π a³b³/(a² + b²)
  CHECK(ellipse.torsion == Approx(pi * std::pow(0.002 * 0.001, 3) / (4e-6 + 1e-6)).epsilon(1e-14));
  // Timoshenko and Goodier, table of 109: 0.1406 a⁴, and b³a/3 (1 - 0.63 b/a) for a narrow one
  CHECK(square.torsion == Approx(0.1406e-8).epsilon(5e-4));
  CHECK(strip.torsion == Approx(0.02 * 1e-9 / 3 * (1 - 0.63 / 20)).epsilon(1e-4));
  CHECK(RodSection::rectangle(0.001, 0.02).torsion == Approx(strip.torsion).epsilon(1e-14));
  CHECK(strip.inertia1 == Approx(0.02 * 1e-9 / 12).epsilon(1e-14));
  CHECK(strip.thickness == 0.001);
  CHECK(tube.torsion == Approx(2 * tube.inertia1).epsilon(1e-14));
  CHECK(RodMaterial::isotropic(200e9, 0.25).shear == Approx(80e9).epsilon(1e-14));
}

TEST_CASE("what makes no sense of a rod is rejected by name", "[rod]") {
  const RodSection round = RodSection::circle(0.001);
  const RodSupport c = RodSupport::clamped, f = RodSupport::free, h = RodSupport::hinged;
  CHECK(rejection([&] { Rod(-1, round, spring_steel, c, f); }) ==
        "length = -1 m: must be positive and finite");
  CHECK(rejection([&] {
          Rod(1, round, {no_number, 77e9}, c, f);
        }) == "young = nan Pa: must be positive and finite");
  CHECK(rejection([&] { Rod(1, round, {200e9, 0}, c, f); }) == "shear = 0 Pa: must be positive and finite");
  CHECK(rejection([&] {
          Rod(1, RodStiffness{1, 1, -2, 1}, 0.1, c, f);
        }) == "bending2 stiffness = -2 N·m²: must be positive and finite");
  CHECK(
      rejection([&] { Rod(1, round, spring_steel, h, f).check_held(); }) ==
      "supports = hinged, free: the rod is a mechanism, hold the direction of one end or the place of both");
  CHECK(rejection([&] { RodSection::rectangle(0.01, 0); }) ==
        "section height = 0 m: must be positive and finite");
  CHECK(rejection([&] { RodSection::tube(0.01, 0.02); }) ==
        "section inner_diameter = 0.02 m: must be less than outer_diameter");
  CHECK(rejection([&] { RodMaterial::isotropic(1, 0.6); }) ==
        "poisson = 0.6: must be more than -1 and at most 0.5");
  CHECK(rejection([&] {
          wire().naturally({{0.1, 0, 1, 0}, {0.05, 0, 1, 0}});
        }) == "arc end = 0.05 m: must be beyond the arc before it and on the rod");
  CHECK(rejection([&] {
          wire().naturally({{0.1, no_number, 1, 0}});
        }) == "arc curvature1 = nan 1/m: must be finite");
  CHECK(rejection([&] {
          wire().add({0.3, {0, 0, 1}});
        }) == "force s = 0.3 m: must be on the rod, 0 to its length");
  CHECK(rejection([&] { wire().load(Point(0, no_number, 0)); }) == "load = nan N/m: must be finite");
  CHECK(rejection([&] {
          wire().place_left({{0, 0, 0}, {0, 0, 0}, {0, 1, 0}});
        }) == "pose along = 0: must be positive and finite");
  CHECK(rejection([&] {
          wire().place_left({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
        }) == "pose director = 2: must be across along");
}

TEST_CASE("ends, sections and foundations that make no sense are rejected by name", "[rod]") {
  const RodSection round = RodSection::circle(0.001);
  CHECK(rejection([&] { RodSupport::elastic(1, -2, 0, 0, 0, 0); }) ==
        "support place2 = -2 N/m: must be 0 (free), positive, or infinity (held)");
  CHECK(rejection([&] { RodSupport::elastic(1, 1, 1, INFINITY, 0, 0); }) ==
        "support turn2 = 0 N·m/rad: must be held where turn1 is, and only there");
  CHECK(rejection([&] { Rod(1, round, spring_steel, RodSupport::sliding, RodSupport::free).check_held(); }) ==
        "supports = sliding, free: the rod is a mechanism, it slides along its axis; hold that at one end");
  CHECK(rejection([&] {
          wire().sections({{0.1, round}, {0.15, round}});
        }) == "part end = 0.15 m: must be the rod's length for the last part");
  CHECK(rejection([&] {
          wire().sections({{0.1, round}, {0.1, round}});
        }) == "part end = 0.1 m: must be beyond the part before it and on the rod");
  CHECK(rejection([&] {
          Rod(1, RodStiffness{1, 1, 1, 1}, 0.1, RodSupport::clamped, RodSupport::free).sections({{1, round}});
        }) == "young = 0 Pa: must be known for sections: build the rod of a section and a material");
  CHECK(rejection([&] {
          Rod thin = wire();
          FemModel<TwistedRod>(thin.section([](double s) { return RodSection::circle(0.001 - 0.01 * s); }),
                               8);
        }).find("section diameter = ") == 0);
  CHECK(rejection([&] {
          wire().add(RodFoundation{0.1, 0.3, 1, 1});
        }) == "foundation to = 0.3 m: must be beyond where it begins and on the rod");
  CHECK(rejection([&] {
          wire().add(RodFoundation{0, 0.1, -1, 1});
        }) == "foundation across = -1 N/m²: must be finite and not negative");
}

TEST_CASE("an element rejects the rods that it does not model", "[rod]") {
  Rod arc = wire(),
      flat(0.2, RodSection::rectangle(0.01, 0.001), spring_steel, RodSupport::clamped, RodSupport::free);
  arc.naturally({{0.2, 0, 3, 0}});
  const std::string round =
      "rod: RoundRod takes rods that are straight by nature, with one bending stiffness for all directions; "
      "take "
      "TwistedRod";
  CHECK(rejection([&] { FemModel<RoundRod>(arc, 8); }) == round);
  CHECK(rejection([&] { FemModel<RoundRod>(flat, 8); }) == round);
  const Rod loose(1, RodSection::circle(0.01), spring_steel, RodSupport::hinged, RodSupport::hinged);
  CHECK(rejection([&] { FemModel<TwistedRod>(loose, 8); }) ==
        "supports = hinged, hinged: TwistedRod turns about its axis, hold its twist at one end");
  Rod loaded = wire();
  loaded.load([](double s) { return Point(0, s < 0.1 ? 1 : no_number, 0); });
  CHECK(rejection([&] { FemModel<TwistedRod>(loaded, 8); }) == "load = nan N/m: must be finite");
}
