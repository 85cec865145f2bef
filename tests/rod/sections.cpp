// Sections that change along a rod, and foundations, against closed forms of small displacements.
#include <functional>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double length = 0.2;

Rod cantilever() {
  return Rod(length, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
}
/// Half as thick at its tip.
double diameter(double s) { return 0.002 * (1 - s / (2 * length)); }
Rod tapered() {
  return cantilever().section([](double s) { return RodSection::circle(diameter(s)); });
}

/// Tip's displacement by a force of 1 N: ∫ (L - s)²/EI ds, by Simpson's rule.
double compliance(const std::function<double(double)>& bending) {
  double sum = 0;
  const int n = 2000;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < 3; ++j) {
      // Within the interval: a step stands where two of them meet.
      const double s = length * (k + std::min(std::max(0.5 * j, 1e-9), 1 - 1e-9)) / n;
      sum += (j == 1 ? 4 : 1) * (length - s) * (length - s) / bending(s);
    }
  return sum * length / (6 * n);
}

/// Relative error of the force at the tip, pushed by so little that rotations are nothing.
template <class Element>
double tip_error(const Rod& rod, int elements, double expected) {
  FemModel<Element> model(rod, elements);
  const double d = 1e-5 * length;
  const auto response = model.push({length, d, {0, 0, 1}});
  REQUIRE(response.status == Status::ok);
  return std::abs(response.force * expected / d - 1);
}

}  // namespace

TEST_CASE("a tapered cantilever bends by the integral of its compliance, to fourth order", "[rod]") {
  const double expected = compliance([](double s) { return 200e9 * pi * std::pow(diameter(s), 4) / 64; });
  const double coarse = tip_error<TwistedRod>(tapered(), 8, expected),
               fine = tip_error<TwistedRod>(tapered(), 16, expected);
  INFO(coarse << ", " << fine);
  CHECK(coarse <= 1e-4);
  CHECK(std::log2(coarse / fine) >= 3.8);
  CHECK(tip_error<RoundRod>(tapered(), 8, expected) <= 1e-4);
}

// The middle third is thinner.  Each step has a node.
TEMPLATE_TEST_CASE("a stepped cantilever bends by the integral of its compliance on any mesh", "[rod]",
                   RoundRod, TwistedRod) {
  const double a = length / 3, b = 0.73 * length;
  for (const double softer : {2.0, 10.0, 100.0}) {
    const RodSection thick = RodSection::circle(0.002),
                     thin = RodSection::circle(0.002 / std::pow(softer, 0.25));
    Rod stepped = cantilever();
    stepped.sections({{a, thick}, {b, thin}, {length, thick}});
    const auto cube = [](double x) { return x * x * x; };
    const double c1 = length - a, c2 = length - b;
    const double expected =
        (cube(length) - cube(c1) + softer * (cube(c1) - cube(c2)) + cube(c2)) / (3 * 200e9 * thick.inertia1);
    // Rotations of 1e-5 cost their square.
    for (const int elements : {3, 8, 13}) CHECK(tip_error<TestType>(stepped, elements, expected) <= 1e-9);
  }
}

TEST_CASE("a tapered and stepped shaft twists and stretches by the integral of its compliance", "[rod]") {
  Rod shaft(length, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::clamped);
  shaft.sections({{0.53 * length, RodSection::circle(0.002)}, {length, RodSection::circle(0.0015)}});
  FemModel<TwistedRod> model(shaft, 8);
  const auto sum = [&](auto&& stiffness) {
    return 0.53 * length / stiffness(RodSection::circle(0.002)) +
           0.47 * length / stiffness(RodSection::circle(0.0015));
  };
  const auto twisted =
      model.hold(RodSide::right, {{length, 0, 0}, {1, 0, 0}, {0, std::cos(0.1), std::sin(0.1)}});
  CHECK(twisted.moment.x() * sum([](const RodSection& s) { return 77e9 * s.torsion; }) / 0.1 ==
        Approx(1).epsilon(1e-9));
  // At the step both elements have one stretch, where the thin one is strained by more: of first order, with a small factor.
  const double d = 1e-4 * length;
  const auto pulled = model.hold(RodSide::right, {{length + d, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(pulled.force.x() * sum([](const RodSection& s) { return 200e9 * s.area; }) / d ==
        Approx(1).epsilon(2.5e-3));
}

TEST_CASE("a section that is the same function everywhere is the same section", "[rod]") {
  Rod same = cantilever();
  same.section([](double) { return RodSection::circle(0.002); });
  FemModel<TwistedRod> a(cantilever(), 8), b(same, 8);
  for (const double d : {0.01, 0.05, 0.1})
    CHECK(a.push({0.15, d, {0, 0.6, 0.8}}).force ==
          Approx(b.push({0.15, d, {0, 0.6, 0.8}}).force).epsilon(1e-12));
}

TEST_CASE("a rod of two materials bends, twists and weighs as its parts do", "[rod]") {
  // A soft tip of 0.4 of the length.
  const RodSection section = RodSection::circle(0.002);
  const RodMaterial soft{2e9, 0.5e9, 1100};
  Rod rod(length, section, {200e9, 77e9, 7850}, RodSupport::clamped, RodSupport::clamped);
  rod.sections({{0.6 * length, section}, {length, section, soft}});
  CHECK(rod.mass_per_length(0.3 * length) == Approx(7850 * section.area).epsilon(1e-12));
  CHECK(rod.mass_per_length(0.9 * length) == Approx(1100 * section.area).epsilon(1e-12));
  CHECK(rod.spin_per_length(0.9 * length) == Approx(1100 * 2 * section.inertia1).epsilon(1e-12));
  FemModel<TwistedRod> model(rod, 10);
  const double angle = 1e-3,
               gives = 0.6 * length / (77e9 * section.torsion) + 0.4 * length / (0.5e9 * section.torsion);
  const auto held =
      model.hold(RodSide::right, {{length, 0, 0}, {1, 0, 0}, {0, std::cos(angle), std::sin(angle)}});
  CHECK(held.moment.x() == Approx(angle / gives).epsilon(1e-6));
  Rod tip(length, section, {200e9, 77e9}, RodSupport::clamped, RodSupport::free);
  tip.sections({{0.6 * length, section}, {length, section, soft}});
  const double expected =
      compliance([](double s) { return (s < 0.6 * length ? 200e9 : 2e9) * pi * 1.6e-11 / 64; });
  CHECK(tip_error<TwistedRod>(tip, 10, expected) <= 1e-6);
  CHECK(tip_error<RoundRod>(tip, 10, expected) <= 1e-6);
  CHECK_THROWS_WITH(FemModel<RoundRod>(Rod(tip).sections({{length, section, RodMaterial{-1, 1}}}), 8),
                    Catch::Matchers::ContainsSubstring("young"));
  CHECK_THROWS_WITH(Rod(tip).sections({{length, section, RodMaterial{1, 1, -1}}}),
                    Catch::Matchers::ContainsSubstring("part density"));
}

TEST_CASE("a tapered rod weighs what its sections weigh", "[rod]") {
  // Moment at the clamp: ∫ ρgA s ds with A = A0 (1 - s/2L)²: A0 L² (1/2 - 1/3 + 1/16)
  Rod rod = cantilever();
  rod.section([](double s) { return RodSection::circle(diameter(s)); }).weight(7850, {0, -9.81, 0});
  FemModel<TwistedRod> model(rod, 8);
  const auto held = model.hold(RodSide::left, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const double area = pi * 1e-6;
  CHECK(held.force.y() == Approx(7850 * 9.81 * area * length * (1 - 0.5 + 1.0 / 12)).epsilon(1e-6));
  CHECK(held.moment.z() ==
        Approx(7850 * 9.81 * area * length * length * (0.5 - 1.0 / 3 + 1.0 / 16)).epsilon(1e-3));
}

// Hetényi, Beams on Elastic Foundation, 1946: an infinite beam takes 8 EI β³ d, β⁴ = k/4EI.
TEST_CASE("a rod in an elastic foundation is as stiff as Hetényi's beam", "[rod]") {
  const double EI = 200e9 * pi * 1.6e-11 / 64, beta = 8 / (0.4 * length), k = 4 * EI * std::pow(beta, 4);
  Rod needle = cantilever();
  needle.add(RodFoundation{0, length, k, 0});  // 8 characteristic lengths on either side
  const double d = 1e-6;
  const auto error = [&](int elements) {
    FemModel<TwistedRod> model(needle, elements);
    return std::abs(model.push({length / 2, d, {0, 0.8, 0.6}}).force / (8 * EI * std::pow(beta, 3) * d) - 1);
  };
  INFO(error(16) << ", " << error(32) << ", " << error(64));
  CHECK(error(64) <= 1e-4);
  CHECK(error(32) <= error(16) / 8);
}

TEST_CASE("a foundation along the rod holds it as a rod that is pulled out", "[rod]") {
  // EA u'' = k u over L from a free end: F = d √(EA k) tanh L√(k/EA).
  Rod rod(length, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  const double EA = rod.stiffness().axial, k = 4 * EA / (length * length);
  rod.add(RodFoundation{0, length, 0, k});
  FemModel<TwistedRod> model(rod, 16);
  const double d = 1e-4 * length;
  const auto held = model.hold(RodSide::left, {{-d, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(-held.force.x() / (d * std::sqrt(EA * k) * std::tanh(2.0)) == Approx(1).epsilon(1e-4));
}
