// Rods of which closed forms are known: twisted shafts that buckle, helices, a rod that is led around a loop.
#include <vector>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Torque of a shaft in EI/L at which it first gives way, between ends of one kind.
double critical_torque(const RodSupport& ends) {
  const double length = 1, EI = 2, GJ = 8;
  const auto stable = [&](double torque) {
    const double angle = torque * EI / GJ;
    Rod shaft(length, RodStiffness{1e7, EI, EI, GJ}, 0.01, ends, ends);
    shaft.place_right({{length, 0, 0}, {1, 0, 0}, {0, std::cos(angle), std::sin(angle)}});
    RodSystem<TwistedRod, double, Eigen::Dynamic, Eigen::Dynamic> system(shaft, 16);
    system.set_goal();
    REQUIRE(NewtonRaphson{}.solve(system).status == Status::ok);
    REQUIRE(system.factor(0) == Status::ok);
    return system.negative_pivots() == 0;
  };
  double low = 2, high = 11;
  while (high - low > 1e-4) {
    const double middle = (low + high) / 2;
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

// Greenhill 1883.  With w = y + iz and λ = M/EI the bent shaft has  w'' = iλ w' + p + q s.  Timoshenko and Gere, 2.21: tan λL/2 = λL/2
// between clamped ends.  At a cardan joint the couple stands between axis and tangent, half of M w' across: tan λL/2 = -λL/6, by the same
// equation.  (2π is for couples that stay axial, which no energy has: rod/tangent.cpp.)
TEST_CASE("a twisted shaft buckles at Greenhill's torque", "[rod]") {
  CHECK(critical_torque(RodSupport::clamped) == Approx(8.98682).epsilon(1e-3));
  CHECK(critical_torque(RodSupport::cardan) == Approx(4.91128).epsilon(1e-3));
}

// Love, Mathematical Theory of Elasticity, 270-271: what holds a helix of curvature κ, torsion and twist τ is a wrench about its axis, with
// the force Ω τ (GJ - EI), Ω² = κ² + τ².
TEST_CASE("a straight rod rolls up into a helix", "[rod]") {
  const double length = 0.5, EI = 2, GJ = 1.5, curvature = 1.8 * pi / length, torsion = 2 / length;
  const Rod rod(length, RodStiffness{1e6, EI, EI, GJ}, 0.01, RodSupport::clamped, RodSupport::clamped);
  FemModel<TwistedRod> model(rod, 16);
  HeldEnd<double> held{Point::Zero(), Point::Zero(), Status::ok};
  for (int k = 1; k <= 60; ++k) {
    Rod helix = rod;
    const double part = k / 60.0;
    helix.naturally({{length, 0, part * curvature, part * torsion}});
    const auto end = NaturalRod<double>(helix).at(length);
    held = model.hold(RodSide::right, {end.r, end.tangent, end.director});
    REQUIRE(is_answer(held.status));
  }
  // Ω d3 in the end's axes, from Ω = κ d2 + τ d3
  Rod helix = rod;
  helix.naturally({{length, 0, curvature, torsion}});
  const auto end = NaturalRod<double>(helix).at(length);
  const double rate = std::hypot(curvature, torsion);
  const Point d2 = detail::cross3(end.tangent, end.director),
              axis = (curvature * d2 + torsion * end.tangent) / rate;
  const Point force = rate * torsion * (GJ - EI) * axis,
              moment = EI * curvature * d2 + GJ * torsion * end.tangent;
  INFO((held.force - force).norm() / force.norm() << ", " << (held.moment - moment).norm() / moment.norm());
  CHECK(model.strain_energy() ==
        Approx(length / 2 * (EI * curvature * curvature + GJ * torsion * torsion)).epsilon(1e-3));
  CHECK((held.moment - moment).norm() <= 1e-3 * moment.norm());
  CHECK((held.force - force).norm() <= 5e-3 * moment.norm() * rate);
}

TEST_CASE("a rod that is led around a loop gives back the work that it took", "[rod]") {
  // Periodic and smooth: the trapezium rule leaves nothing.  Along a plane that turns, dW = F (dd - r·dn).
  Rod rod(0.3, RodSection::rectangle(0.003, 0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  rod.naturally({{0.3, 1, 2, 1}}).add(RodFoundation{0, 0.1, 500, 100});
  rod.section([](double s) { return RodSection::rectangle(0.003, 0.002 - 0.003 * s); });
  FemModel<TwistedRod> model(rod, 16);
  const int steps = 120;
  const double s = 0.21;
  const Point start = model.shape().at(s).r;
  double work = 0, way = 0;
  for (int k = -1; k < steps; ++k) {  // the first one leads there
    const double t = 2 * pi * k / steps, a = 0.5 * std::sin(t), b = 0.3 * std::cos(2 * t);
    const Point n(std::sin(a), std::cos(a) * std::cos(b), std::cos(a) * std::sin(b));
    const double da = 0.5 * std::cos(t), db = -0.6 * std::sin(2 * t);
    const Point dn = da * Point(std::cos(a), -std::sin(a) * std::cos(b), -std::sin(a) * std::sin(b)) +
                     db * Point(0, -std::cos(a) * std::sin(b), std::cos(a) * std::cos(b));
    const double depth = 0.03 + 0.02 * std::sin(t) + 0.01 * std::cos(t),
                 rate = 0.02 * std::cos(t) - 0.01 * std::sin(t);
    const auto response = model.push({s, n.dot(start) + depth, n});
    REQUIRE(response.status == Status::ok);
    if (k < 0) continue;
    const double power = response.force * (rate + start.dot(dn) - model.shape().at(s).r.dot(dn));
    work += power * 2 * pi / steps;
    way += std::abs(power) * 2 * pi / steps;
  }
  INFO(work / way);
  CHECK(std::abs(work) <= 1e-5 * way);
}

TEST_CASE("a rod goes through the points that it was given, without force", "[rod]") {
  std::vector<Point> points;
  for (int k = 0; k <= 12; ++k)
    points.push_back({0.1 * std::cos(0.3 * k), 0.1 * std::sin(0.3 * k), 0.01 * k});
  const Rod rod = rod_through(points, RodSection::circle(0.002), spring_steel, RodSupport::clamped,
                              RodSupport::free, {0, 0, 1});
  CHECK(rod.length() == Approx(std::hypot(0.1 * 0.3, 0.01) * 12).epsilon(2e-2));
  const NaturalRod<double> natural(rod);
  CHECK((natural.at(0).r - points.front()).norm() <= 1e-15);
  for (std::size_t k = 0; k < rod.arcs().size(); ++k)
    CHECK((natural.at(rod.arcs()[k].end).r - points[k + 1]).norm() <= 1e-14);
  FemModel<TwistedRod> model(rod, 24);
  CHECK(model.strain_energy() <= 1e-18);
  CHECK((model.shape().at(rod.length()).r - points.back()).norm() <= 1e-12);
  // Three points on a circle give that circle.
  const Rod arc = rod_through({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}}, RodSection::circle(0.01), spring_steel,
                              RodSupport::clamped, RodSupport::free, {0, 0, 1});
  CHECK(arc.length() == Approx(pi).epsilon(1e-14));
  CHECK_THROWS_WITH(rod_through({{0, 0, 0}, {0, 0, 0}}, RodSection::circle(0.01), spring_steel,
                                RodSupport::clamped, RodSupport::free),
                    "distance of two points = 0 m: must be positive and finite");
}
