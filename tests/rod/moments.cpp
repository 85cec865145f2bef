// Moments on rods: the derivatives of a work, arcs and twists of closed forms, where those fall aside, the planar beam, what sections and ends carry,
// mass, and what is rejected.
#include <cmath>
#include <string>

#include "rod/elements.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/dynamic_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double length = 0.3;
const RodSection wire = RodSection::circle(0.001), strip = RodSection::rectangle(0.01, 0.001);

/// A cantilever along x with a moment at its tip.
Rod cantilever(const RodSection& section, const Point& moment) {
  Rod rod(length, section, RodMaterial{200e9, 77e9, 7850}, RodSupport::clamped, RodSupport::free);
  return rod.add({length, {0, 0, 0}, moment});
}
/// About d1, y, so that it bends into an arc of so many turns.
Rod arc(const RodSection& section, double turns) {
  const double EI = cantilever(section, {0, 0, 0}).stiffness().bending1;
  return cantilever(section, {0, 2 * pi * turns * EI / length, 0});
}
Point on_arc(double turns, double s) {
  const double k = 2 * pi * turns / length;
  return {std::sin(k * s) / k, 0, (std::cos(k * s) - 1) / k};
}
template <class Element>
double off_arc(const FemModel<Element>& model, double turns) {
  return (model.shape().at(length).r - on_arc(turns, length)).norm() / length;
}

/// An equilibrium near the arc, stable or not.
template <class Element>
RodSystem<Element, double, Eigen::Dynamic, Eigen::Dynamic> near_arc(const RodSection& section, double turns,
                                                                    int elements) {
  RodSystem<Element, double, Eigen::Dynamic, Eigen::Dynamic> system(arc(section, turns), elements);
  const double k = 2 * pi * turns / length;
  system.place([&](int i) {
    auto node = system.node(i);
    node.r = on_arc(turns, node.s), node.tangent = {std::cos(k * node.s), 0, -std::sin(k * node.s)};
    return node;
  });
  system.set_goal(), system.set_target(1);
  for (int iteration = 0; iteration < 8; ++iteration) REQUIRE(system.iterate().status == Status::ok);
  REQUIRE(system.increment() <= 1e-11 * system.unit());
  REQUIRE(system.factor(0) == Status::ok);
  return system;
}
template <class Element>
double off_circle(int elements) {
  return near_arc<Element>(wire, 1, elements).node(elements).r.norm() / length;
}

}  // namespace

TEST_CASE("a moment's residual and tangent are the derivatives of its work", "[rod][moment]") {
  // Central differences of long double: h² beside fourth derivatives of order 100, and round-off of 1e-19/h².
  const Long h = 1e-4L;
  Random random(61);
  for (int trial = 0; trial < 30; ++trial) {
    Rod rod(1, RodStiffness{1, 1, 1, 1}, 0.01, RodSupport::clamped, RodSupport::free);
    rod.naturally({{1, random(2), random(2), random(2)}});
    rod.add({1, {0, 0, 0}, {random(1), random(1), random(1)}});
    const NaturalRod<Long> natural(rod);
    detail::PerNode<RodNode<Long>, Eigen::Dynamic, Eigen::Dynamic> nodes(2);
    for (int i = 0; i <= 2; ++i) nodes[i] = natural.at(i / 2.0L);
    const detail::RodMoments<Long> moments(rod, 7, natural, nodes);
    Long x[7];
    for (Long& each : x) each = 0.6L * random(1.0);
    nodes[2].tangent *= 1.1L;
    const RodNode<Long> at = moved(nodes[2], x, true);
    const auto work = [&](int i, Long s, int j, Long t) {
      Long y[7] = {};
      y[i] += s, y[j] += t;
      nodes[2] = moved(at, y, true);
      return moments.visit<7>(0.7L, nodes, [](auto&&...) {});
    };
    VectorOf<Long, 7> r, gradient;
    Eigen::Matrix<Long, 7, 7> K, hessian;
    const Long here = work(0, 0, 0, 0);
    (void)moments.visit<7>(0.7L, nodes, [&](int node, const auto& its_K, const auto& its_r) {
      CHECK(node == 2);
      K = its_K, r = its_r;
    });
    for (int i = 0; i < 7; ++i) {
      gradient[i] = -(work(i, h, i, 0) - work(i, -h, i, 0)) / (2 * h);
      for (int j = 0; j <= i; ++j)
        hessian(i, j) = hessian(j, i) =
            i == j ? -(work(i, h, i, 0) - 2 * here + work(i, -h, i, 0)) / (h * h)
                   : -(work(i, h, j, h) - work(i, h, j, -h) - work(i, -h, j, h) + work(i, -h, j, -h)) /
                         (4 * h * h);
    }
    CHECK((r - gradient).norm() <= 1e-6L * gradient.norm());
    CHECK((K - hessian).norm() <= 1e-6L * hessian.norm() + 1e-9L);
    CHECK((K - K.transpose()).norm() <= 1e-18L);
  }
}

TEST_CASE("the work of a moment counts turns", "[rod][moment]") {
  Rod rod(1, RodStiffness{1, 1, 1, 1}, 0.01, RodSupport::clamped, RodSupport::free);
  rod.add({1, {0, 0, 0}, {0, 0, 2}}).add({1, {0, 0, 0}, {3, 0, 0}});
  const NaturalRod<double> natural(rod);
  detail::PerNode<RodNode<double>, Eigen::Dynamic, Eigen::Dynamic> nodes(2);
  for (int i = 0; i <= 2; ++i) nodes[i] = natural.at(i / 2.0);
  const auto work = [&](int turns, const Point& axis) {
    detail::RodMoments<double> moments(rod, 7, natural, nodes);
    auto turned = nodes;
    for (int k = 1; k <= 4 * turns; ++k)
      turned[2] = rotated<double>(nodes[2], axis, k * pi / 2 + 0.1, {0, 0, 0}), moments.turn(turned);
    return moments.visit<7>(1.0, turned, [](auto&&...) {});
  };
  // About the tangent alone T works.
  CHECK(work(3, {1, 0, 0}) == Approx(3 * (6 * pi + 0.1)).epsilon(1e-12));
  rod = Rod(1, RodStiffness{1, 1, 1, 1}, 0.01, RodSupport::clamped, RodSupport::free);
  rod.add({1, {0, 0, 0}, {0, 0, 2}});
  CHECK(work(5, {0, 0, 1}) == Approx(2 * (10 * pi + 0.1)).epsilon(1e-12));
}

// What a cubic leaves of an arc of the angle α = 2π turns/n is of fourth order: to 1e-9 where that is 0.02.
TEST_CASE("a moment at the tip bends a cantilever into an arc", "[rod][moment]") {
  CHECK(off_arc(FemModel<RoundRod>(arc(wire, 0.1), 32), 0.1) <= 1e-9);
  CHECK(off_arc(FemModel<TwistedRod>(arc(wire, 0.1), 32), 0.1) <= 1e-9);
  CHECK(off_arc(FemModel<TwistedRod>(arc(strip, 0.1), 32), 0.1) <= 1e-9);
  const FemModel<RoundRod> coarse(arc(wire, 0.24), 8), fine(arc(wire, 0.24), 16);
  REQUIRE(fine.rest().status == Status::ok);
  CHECK(observed_order(off_arc(coarse, 0.24), off_arc(fine, 0.24)) >= 3.8);
  const FemModel<TwistedRod> half(arc(strip, 0.5), 8), finer(arc(strip, 0.5), 16);
  REQUIRE(finer.rest().status == Status::ok);
  CHECK(observed_order(off_arc(half, 0.5), off_arc(finer, 0.5)) >= 3.8);
}

TEST_CASE("2 pi EI/L closes a circle, which falls aside", "[rod][moment]") {
  INFO(off_circle<RoundRod>(32));
  CHECK(off_circle<RoundRod>(64) <= 1e-6);
  CHECK(observed_order(off_circle<RoundRod>(16), off_circle<RoundRod>(32)) >= 3.8);
  CHECK(observed_order(off_circle<TwistedRod>(16), off_circle<TwistedRod>(32)) >= 3.8);
  CHECK(near_arc<RoundRod>(wire, 1, 32).negative_pivots() == 2);
  CHECK(FemModel<RoundRod>(arc(wire, 1), 32).rest().status == Status::iteration_limit);
}

// Beside the arc the elevation z of the tangent has ½ EI ∫ z'² - κ² z² ds, free at the tip: stable up to κL = π/2.  Between that and 3π/2 one mode is not.
TEST_CASE("an arc in a plane is stable up to a quarter of a turn", "[rod][moment]") {
  for (const int elements : {8, 32}) {
    CHECK(near_arc<RoundRod>(wire, 0.249, elements).negative_pivots() == 0);
    CHECK(near_arc<RoundRod>(wire, 0.251, elements).negative_pivots() == 1);
    CHECK(near_arc<TwistedRod>(wire, 0.249, elements).negative_pivots() == 0);
    CHECK(near_arc<TwistedRod>(wire, 0.251, elements).negative_pivots() == 1);
    CHECK(near_arc<TwistedRod>(strip, 0.52, elements).negative_pivots() == 0);  // as docs/limits.md says
    CHECK(near_arc<TwistedRod>(strip, 0.54, elements).negative_pivots() == 1);
    CHECK(FemModel<RoundRod>(arc(wire, 0.249), elements).rest().status == Status::ok);
    CHECK(FemModel<RoundRod>(arc(wire, 0.251), elements).rest().status != Status::ok);
  }
}

// Under the torque T, half of it fixed in space and half of it along the tangent, w = w1 + i w2 has EI w' ± ½ i T w = 0 at the tip: stable up to TL/EI = π,
// where two modes give way.
TEST_CASE("a torque twists a cantilever by TL/GJ, up to pi EI/L", "[rod][moment]") {
  const RodStiffness k = cantilever(wire, {0, 0, 0}).stiffness();
  for (const double angle : {0.5, 2.0, -3.5}) {
    const FemModel<TwistedRod> model(cantilever(wire, {angle * k.torsion / length, 0, 0}), 8);
    REQUIRE(model.rest().status == Status::ok);
    const Point d1 = model.shape()[model.shape().segments()].director;
    CHECK((d1 - Point(0, std::cos(angle), std::sin(angle))).norm() <= 1e-12);
    CHECK(model.internal_forces(0.1).torsion == Approx(angle * k.torsion / length).epsilon(1e-9));
  }
  const auto negative = [&](double share) {
    RodSystem<TwistedRod, double, Eigen::Dynamic, Eigen::Dynamic> system(
        cantilever(wire, {share * pi * k.bending1 / length, 0, 0}), 32);
    system.set_goal(), system.set_target(1);
    for (int iteration = 0; iteration < 4; ++iteration) REQUIRE(system.iterate().status == Status::ok);
    REQUIRE(system.factor(0) == Status::ok);
    return system.negative_pivots();
  };
  CHECK(negative(0.999) == 0);
  CHECK(negative(1.001) == 2);
}

TEST_CASE("a moment amid a rod between clamps is that of the planar beam", "[rod][moment]") {
  const double s = 0.12;
  const auto apart = [&](int elements, double size) {
    const double EI = cantilever(wire, {0, 0, 0}).stiffness().bending1, moment = size * EI / length;
    Beam beam(length, Section::circle(0.001), Material{200e9}, Support::clamped, Support::clamped);
    beam.add({s, 0, 0, -moment});  // θ is clockwise
    Rod rod(length, wire, RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::clamped);
    rod.add({s, {0, 0, 0}, {0, 0, moment}});
    const FemModel<Corotational<>> plane(beam, elements);
    const FemModel<RoundRod> model(rod, elements);
    REQUIRE(plane.rest().status == Status::ok);
    REQUIRE(model.rest().status == Status::ok);
    double off = 0, most = 0;
    for (int k = 1; k < 30; ++k) {
      const Point at = model.shape().at(length * k / 30).r;
      const auto beside = plane.shape().position(length * k / 30);
      off = std::max({off, std::hypot(at.x() - beside.x(), at.y() - beside.y()), std::abs(at.z())});
      most = std::max(most, std::abs(at.y()));
    }
    return off / most;
  };
  // Linear: exact cubics.  Farther both have errors of fourth order.
  CHECK(apart(8, 1e-4) <= 1e-6);
  CHECK(apart(64, 3) <= 1e-5);
}

TEST_CASE("sections carry a moment as far as it acts, and the clamp takes it", "[rod][moment]") {
  const Point moment(0.004, 0.01, 0.03);
  Rod rod(length, strip, RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::free);
  rod.add({0.2, {0, 0, 0}, moment}).add({length, {0, 0, 0}, {0, 0, -0.01}});
  FemModel<TwistedRod> model(rod, 9);
  REQUIRE(model.rest().status == Status::ok);
  // On what has turned by α a part of it is along other axes by α.
  const double turned = 0.02;
  const auto carried = [&](double s) {
    const auto cut = model.internal_forces(s);
    return Point(cut.torsion, cut.moment1, cut.moment2);
  };
  const Point all = moment + Point(0, 0, -0.01);
  CHECK((carried(0) - all).norm() <= turned * all.norm());
  CHECK((carried(0.19) - all).norm() <= turned * all.norm());
  CHECK((carried(0.21) - Point(0, 0, -0.01)).norm() <= turned * 0.01);
  const auto held = model.hold(RodSide::left, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK((held.moment + all).norm() <= turned * all.norm());
}

TEST_CASE("a rod with mass swings about its shape under a moment, and keeps its energy", "[rod][moment]") {
  const Rod bent = arc(wire, 0.2);
  DynamicModel<RoundRod> still(bent, 8);
  const Point tip = FemModel<RoundRod>(bent, 8).shape().at(length).r;
  for (int k = 0; k < 50; ++k) REQUIRE(still.step(0.001) == Status::ok);
  CHECK((still.shape().at(length).r - tip).norm() <= 1e-6 * length);
  DynamicModel<RoundRod> model(bent, 8);
  model.let_go_from(FemModel<RoundRod>(arc(wire, 0.1), 8).shape());
  const double first = model.energy().sum(), strain = model.energy().strain;
  double farthest = 0, least = first, largest = first;
  for (int k = 0; k < 200; ++k) {
    REQUIRE(model.step(0.0005) == Status::ok);
    farthest = std::max(farthest, (model.shape().at(length).r - tip).norm());
    least = std::min(least, model.energy().sum()), largest = std::max(largest, model.energy().sum());
  }
  INFO("of " << strain << ": " << least - first << " to " << largest - first);
  CHECK(farthest > 0.05 * length);
  // The moment gives and takes ten times as much.  Steps of 0.5 ms lose what they cannot follow, and gain nothing.
  CHECK(largest <= first + 1e-5 * strain);
  CHECK(least >= first - 0.1 * strain);
}

TEST_CASE("moments that make no sense are rejected by name", "[rod][moment]") {
  const auto rejection = [](const Rod& rod, int elements) -> std::string {
    try {
      const FemModel<RoundRod> model(rod, elements);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(rejection(cantilever(wire, {0.01, 0.01, 0}), 8),
             ContainsSubstring("moment along the rod = 0.01 N·m: must be 0 of a RoundRod"));
  CHECK_THAT(rejection(cantilever(wire, {0, 0, 1e20}), 8), ContainsSubstring("moment = 1e+20 N·m"));
  Rod two = cantilever(wire, {0, 0, 0});
  two.add({0.1, {0, 0, 0}, {0, 0.01, 0}}).add({0.15, {0, 0, 0}, {0, 0.01, 0}});
  CHECK_THAT(rejection(two, 2), ContainsSubstring("elements = 2: must be enough for a node at each moment"));
  CHECK(rejection(two, 3).empty());
  CHECK_THROWS_WITH(cantilever(wire, {0, 0, std::nan("")}), ContainsSubstring("moment = nan N·m"));
}
