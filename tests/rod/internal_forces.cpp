// What a section of a rod carries: free bodies in space, torsion, and the planar answers in a plane.
#include <algorithm>
#include <vector>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/element/corotational.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Pressed as deep as a tenth of its length.
template <class Element>
FemModel<Element> pressed(const PressedRod& rod, int elements, double depth = 0.1) {
  FemModel<Element> model(rod.rod, elements);
  const double home = rod.normal.dot(model.shape().at(rod.s).r);
  for (const double share : {0.5, 1.0})
    REQUIRE(model.push({rod.s, home + share * depth * rod.rod.length(), rod.normal}).status == Status::ok);
  return model;
}

/// Of unit vectors along the axes of the section at the root of a rod that leaves its left end along x.
Point moment(const InternalForces<double, 3>& cut) { return {cut.torsion, cut.moment1, cut.moment2}; }
Point force(const InternalForces<double, 3>& cut) { return {cut.normal, cut.shear1, cut.shear2}; }

double apart(const FemModel<TwistedRod>& model, const FemModel<TwistedRod>& reference, double length) {
  double most = 0, largest = 0;
  for (int k = 0; k < 60; ++k) {
    const double s = length * (k + 0.37) / 60;
    const auto a = model.internal_forces(s), b = reference.internal_forces(s);
    most = std::max(most, std::abs(moment(a).norm() - moment(b).norm()));
    largest = std::max(largest, moment(b).norm());
  }
  return most / largest;
}

}  // namespace

TEST_CASE("the clamp of a rod carries what pushes it", "[rod][internal]") {
  for (const char* name : {"strip_askew", "hook"}) {
    PressedRod rod = pressed_rod(name);
    FemModel<TwistedRod> model(rod.rod, 9);
    const double home = rod.normal.dot(model.shape().at(rod.s).r);
    Response<double> response{};
    for (const double share : {0.04, 0.08})
      response = model.push({rod.s, home + share * rod.rod.length(), rod.normal});
    REQUIRE(response.status == Status::ok);
    const Point push = response.force * rod.normal, lever = model.shape().at(rod.s).r - model.shape()[0].r;
    const auto cut = model.internal_forces(0);
    INFO(name);
    // The rod leaves along x, with d1 along y.
    CHECK((force(cut) - push).norm() <= 1e-7 * push.norm());
    CHECK((moment(cut) - detail::cross3<double>(lever, push)).norm() <= 1e-7 * push.norm() * lever.norm());
    // Nothing beyond the contact, where there is a beyond.
    if (rod.s < rod.rod.length()) CHECK(model.internal_forces(rod.rod.length()).surface_strain < 1e-9);
  }
}

TEST_CASE("moments of rods converge with the fourth power of the elements", "[rod][internal]") {
  for (const char* name : {"strip_askew", "hook"}) {
    const PressedRod rod = pressed_rod(name);
    const double length = rod.rod.length();
    const auto reference = pressed<TwistedRod>(rod, 128, 0.05);
    const double coarse = apart(pressed<TwistedRod>(rod, 12, 0.05), reference, length),
                 fine = apart(pressed<TwistedRod>(rod, 24, 0.05), reference, length);
    INFO(name << ": " << coarse << ", " << fine);
    CHECK(coarse < 2e-4);
    CHECK(std::log2(coarse / fine) > 3.3);
  }
}

TEST_CASE("a rod that is turned at its end carries GJ times its twist", "[rod][internal]") {
  const double length = 0.2, angle = 0.3;
  const Rod rod(length, RodSection::rectangle(0.01, 0.002), spring_steel, RodSupport::clamped,
                RodSupport::clamped);
  FemModel<TwistedRod> model(rod, 6);
  const RodPose pose{{length, 0, 0}, {1, 0, 0}, {0, std::cos(angle), std::sin(angle)}};
  REQUIRE(is_answer(model.hold(RodSide::right, pose).status));
  for (const double s : {0.0, 0.07, 0.2}) {
    const auto cut = model.internal_forces(s);
    CHECK(cut.torsion == Approx(rod.stiffness().torsion * angle / length).epsilon(1e-9));
    CHECK(std::hypot(cut.moment1, cut.moment2) < 1e-9);
    CHECK(cut.surface_strain < 1e-9);  // fibres: shear is not in it
  }
}

TEST_CASE("a natural shape carries nothing, a weight what hangs beyond", "[rod][internal]") {
  const PressedRod spring = pressed_rod("spring");
  CHECK(peak_strain(FemModel<TwistedRod>(spring.rod, 24)).strain < 1e-8);

  const double weight = 7850 * 9.81 * pi * 1e-6 / 4;
  Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
  wire.weight(7850, {0, -9.81, 0});
  const auto check = [&](const auto& model) {
    for (const double s : {0.0, 0.013, 0.1, 0.19}) {
      const auto cut = model.internal_forces(s);
      CHECK(std::hypot(cut.normal, cut.shear1, cut.shear2) == Approx(weight * (0.2 - s)).epsilon(1e-6));
      // Small: q (L - s)²/2; the mean arm beyond s is shortened by the squared slope.
      CHECK(std::hypot(cut.moment1, cut.moment2) == Approx(weight * (0.2 - s) * (0.2 - s) / 2).epsilon(1e-3));
    }
  };
  check(FemModel<RoundRod>(wire, 7));
  check(FemModel<TwistedRod>(wire, 7));
}

TEST_CASE("a foundation takes of the force what it is pressed by", "[rod][internal]") {
  const double k = 3000;
  Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
  wire.add(RodFoundation{0.05, 0.13, k, 0});
  const auto model = pressed<RoundRod>({wire, 0.18, {0, 0.6, 0.8}, 1}, 10, 0.02);
  const auto line = model.shape();
  // ∫ k r⊥ ds by Simpson's rule, up to a place inside of it.
  const auto taken = [&](double to) {
    Point sum(0, 0, 0);
    for (int i = 0; i <= 400; ++i) {
      Point r = line.at(0.05 + (to - 0.05) * i / 400).r;
      r[0] = 0;
      sum += (i == 0 || i == 400 ? 1 : i % 2 ? 4 : 2) * r;
    }
    return Point(-k * (to - 0.05) / 1200 * sum);
  };
  const auto in_space = [&](double s) {
    const auto cut = model.internal_forces(s);
    return std::hypot(cut.normal, cut.shear1, cut.shear2);
  };
  const auto root = model.internal_forces(0);
  const Point at_root = force(root);
  for (const double s : {0.02, 0.06, 0.099, 0.13, 0.17})
    CHECK(in_space(s) ==
          Approx((at_root - (s > 0.05 ? taken(std::min(s, 0.13)) : Point(0, 0, 0))).norm()).epsilon(1e-4));
}

TEST_CASE("in a plane a rod carries what the planar beam does", "[rod][internal]") {
  const Rod wire(0.3, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  const double a = 0.7;
  const PressedRod rod{wire, 0.25, {0, std::cos(a), std::sin(a)}, 1};
  const auto round = pressed<RoundRod>(rod, 32);
  const auto twisted = pressed<TwistedRod>(rod, 32);
  FemModel<Corotational<>> planar(
      Beam(0.3, Section::circle(0.002), Material{spring_steel.young}, Support::clamped, Support::free), 32);
  REQUIRE(planar.push({rod.s, 0.1 * 0.3, {0, 1}}).status == Status::ok);
  for (const double s : {0.0, 0.1, 0.21, 0.24}) {
    const auto expected = planar.internal_forces(s);
    for (const auto& cut : {round.internal_forces(s), twisted.internal_forces(s)}) {
      CHECK(cut.normal == Approx(expected.normal).epsilon(2e-5).margin(1e-7));
      CHECK(std::hypot(cut.shear1, cut.shear2) == Approx(std::abs(expected.shear)).epsilon(2e-5));
      CHECK(std::hypot(cut.moment1, cut.moment2) == Approx(std::abs(expected.moment)).epsilon(2e-5));
      CHECK(cut.surface_strain == Approx(expected.surface_strain).epsilon(2e-5));
      CHECK(std::abs(cut.torsion) < 1e-12);
    }
  }
}

TEST_CASE("cuts do not depend on how a rod stands in space", "[rod][internal]") {
  Random random(44);
  const auto cut = [](const RodPose& pose, const Point& n) {
    Rod rod(0.3, RodSection::rectangle(0.012, 0.002), spring_steel, RodSupport::clamped, RodSupport::free);
    rod.naturally({{0.1, 1, 3, 2}, {0.3, -2, 1, 4}}).place_left(pose);
    FemModel<TwistedRod> model(rod, 8);
    const double home = n.dot(model.shape().at(0.25).r);
    REQUIRE(model.push({0.25, home + 0.03, n}).status == Status::ok);
    return model.internal_forces(0.13);
  };
  const Point n(0.36, 0.48, 0.8);
  const auto here = cut({}, n);
  for (int trial = 0; trial < 4; ++trial) {
    const Point axis = detail::unit(Point(random(1.0), random(1.0), random(1.0)));
    const double angle = random(20.0);
    const auto turn = [&](const Point& x) -> Point {
      return std::cos(angle) * x + std::sin(angle) * detail::cross3<double>(axis, x) +
             (1 - std::cos(angle)) * axis.dot(x) * axis;
    };
    const auto there = cut({{1, 2, 3}, turn({1, 0, 0}), turn({0, 1, 0})}, turn(n));
    CHECK((moment(there) - moment(here)).norm() <= 1e-9 * moment(here).norm());
    CHECK((force(there) - force(here)).norm() <= 1e-8 * force(here).norm());
  }
}

TEST_CASE("a surface is strained where it is farthest from the axis", "[rod][internal]") {
  // Bent about both axes at once, by nothing but a push askew: the corner has both.
  const Rod strip(0.2, RodSection::rectangle(0.010, 0.002), spring_steel, RodSupport::clamped,
                  RodSupport::free);
  const auto root = [](const Rod& rod) {
    return pressed<TwistedRod>({rod, 0.18, {0, 0.6, 0.8}, 1}, 8, 0.01).internal_forces(0);
  };
  const auto cut = root(strip);
  const double bent = std::abs(cut.moment1) / strip.stiffness().bending1 * 0.001 +
                      std::abs(cut.moment2) / strip.stiffness().bending2 * 0.005;
  CHECK(cut.surface_strain == Approx(std::abs(cut.axial_strain) + bent).epsilon(1e-9));
  const Rod oval(0.2, RodSection::ellipse(0.010, 0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  const auto smooth = root(oval);
  CHECK(smooth.surface_strain ==
        Approx(std::abs(smooth.axial_strain) + std::hypot(smooth.moment1 / oval.stiffness().bending1 * 0.001,
                                                          smooth.moment2 / oval.stiffness().bending2 * 0.005))
            .epsilon(1e-9));
  // A taper: the section of the place.
  Rod cane(0.2, RodSection::circle(0.003), spring_steel, RodSupport::clamped, RodSupport::free);
  cane.section([](double s) { return RodSection::circle(0.003 - 0.01 * s); });
  const auto tapered = pressed<RoundRod>({cane, 0.18, {0, 0.6, 0.8}, 1}, 8, 0.01);
  const auto middle = tapered.internal_forces(0.1);
  const double diameter = 0.002;
  CHECK(middle.surface_strain ==
        Approx(std::abs(middle.axial_strain) +
               std::hypot(middle.moment1, middle.moment2) / (200e9 * pi * std::pow(diameter, 3) / 32))
            .epsilon(1e-5));
}

TEST_CASE("cuts beside a contact at a node of a rod between clamps are those of the planar beam",
          "[rod][internal]") {
  constexpr int elements = 8;
  const Rod rod(1, RodSection::circle(0.01), spring_steel, RodSupport::clamped, RodSupport::clamped);
  const Beam beam(1, Section::circle(0.01), Material{spring_steel.young}, Support::clamped, Support::clamped);
  for (const double beside : {-5e-3, -5e-6, 0., 5e-6, 5e-3}) {
    FemModel<RoundRod> model(rod, elements);
    FemModel<> planar(beam, elements);
    const double s = 1. / elements + beside;
    const double force = model.push({s, 0.002, {0, 1, 0}}).force;
    REQUIRE(planar.press({s, 0.002}).status == Status::ok);
    for (int k = 0; k <= 100; ++k) {
      const double at = (k + 0.37) / 101;
      const auto cut = model.internal_forces(at);
      const auto expected = planar.internal_forces(at);
      CAPTURE(beside, at);
      CHECK(std::hypot(cut.moment1, cut.moment2) ==
            Approx(std::abs(expected.moment)).margin(2e-3 * force * s));
      CHECK(std::hypot(cut.shear1, cut.shear2) == Approx(std::abs(expected.shear)).margin(5e-3 * force));
    }
  }
}
