// The law of a capsule on a curve, and a push by it: derivatives, and the same contact wherever it is sought.
#include "rod/touching.hpp"
#include "support/csv.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/capsule_on_curve.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Law = detail::CapsuleOnCurve<double>;
using Six = Vector6<double>;

Point random_point(Random& random, double size) { return {random(size), random(size), random(size)}; }

}  // namespace

// Central differences of step h leave h² of the third derivative, of order 1/D² over the third power of what holds σ: 1e-10 · 1e4.
TEST_CASE("distance of a capsule from a curve: its derivatives are those of its value", "[rod]") {
  int spheres = 0, shafts = 0, ends = 0, bounded = 0;
  double unsettled = 0, slope_error = 0, bend_error = 0, asymmetry = 0;
  for (std::uint64_t seed = 71; seed < 321; ++seed) {
    Random random(seed);
    for (int trial = 0; trial < 400; ++trial) {
      const Point tangent = (1 + random(0.1)) * detail::unit(random_point(random, 1));
      const RodNode<double> node{0, random_point(random, 1), tangent, Point::Zero()};
      const Point along = detail::unit(tangent), curvature = random_point(random, 0.7),
                  off = detail::across(random_point(random, 1), along) * random(0.3, 0.6);
      const int end = trial % 4 == 3 ? (trial % 8 == 3 ? 1 : -1) : 0;
      Shaft<double> axis{node.r + off + along * random(0.1), Point::Zero()};
      if (trial % 3 != 0) {
        axis.way = random_point(random, 1);
        if (trial % 3 == 1)
          axis.way -= off * (off.dot(axis.way) / off.squaredNorm()), axis.tip -= axis.way / 2;
      }
      const Law law(axis, node, curvature - along * along.dot(curvature), end);
      const auto at = [&](const Six& by) {
        RodNode<double> moved = node;
        moved.r += by.head<3>(), moved.tangent += by.tail<3>();
        return law.at(moved);
      };
      const auto gradient = [](const Law::View& view) {
        Six g;
        g << -view.normal, -view.arm;
        return g;
      };
      const auto view = law.at(node);
      // The projection has settled: both ways along which it can go are level.
      if (view.follows) unsettled = std::max(unsettled, std::abs(view.w.dot(view.t)) / view.distance);
      if (view.slides) unsettled = std::max(unsettled, std::abs(view.w.dot(axis.way)) / view.distance);
      bounded += !view.follows && view.lever != 0;

      const double held = view.t.squaredNorm() - view.w.dot(view.k) -
                          (view.slides ? std::pow(view.t.dot(axis.way), 2) / axis.way.squaredNorm() : 0);
      if (view.distance < 0.05 || (view.follows && held < 0.02)) continue;
      const double h = 1e-5;
      Six slope;
      Matrix6<double> bend;
      bool same = true;  // what touches
      for (int i = 0; i < 6; ++i) {
        const auto up = at(h * Six::Unit(i)), down = at(-h * Six::Unit(i));
        for (const auto& v : {up, down}) same = same && v.follows == view.follows && v.slides == view.slides;
        slope[i] = (up.distance - down.distance) / (2 * h);
        bend.col(i) = (gradient(up) - gradient(down)) / (2 * h);
      }
      if (!same) continue;
      const Matrix6<double> exact = law.bend(view);
      slope_error = std::max(slope_error, (slope - gradient(view)).norm());
      // That the smallest rotations around a loop add up to a spin is left out: what it would do is antisymmetric.
      bend_error = std::max(bend_error, (exact - (bend + bend.transpose()) / 2).norm() / exact.norm());
      asymmetry = std::max(asymmetry, (exact - exact.transpose()).norm() / exact.norm());
      ++(view.past_end ? ends : view.slides ? shafts : spheres);
    }
  }
  CAPTURE(spheres, shafts, ends, bounded);
  CHECK(unsettled <= 1e-10);
  CHECK(slope_error <= 1e-6);
  CHECK(bend_error <= 1e-5);
  CHECK(asymmetry <= 1e-12);
  CHECK(spheres > 40000);
  CHECK(shafts > 25000);
  CHECK(ends > 5000);
  CHECK(bounded > 1000);
}

TEST_CASE("where a rod touches a capsule does not depend on where that is sought", "[rod]") {
  FemModel<RoundRod> model(wire(), 16);
  for (const Point& way : {Point(0, 0.1, 0), Point(0.03, 0.1, 0.02), Point(0, 0, 0)})
    for (const double depth : {0.002, 0.004, 0.03}) {
      if (way.isZero(0) && depth > 0.005) continue;  // a sphere would be past the wire
      const auto from = [&](double s) {
        model.reset();
        Pushed<double, 3> pushed{};
        for (int tick = 1; tick <= 20; ++tick)
          pushed = model.push(Capsule<double>{
              s, {Point(0.14, 0, 0.0055 - depth * tick / 20) - way / 2, way}, 0.0055, {0, 0, 1}});
        return pushed;
      };
      const Shaft<double> axis{Point(0.14, 0, 0.0055 - depth) - way / 2, way};
      Pushed<double, 3> exact = from(0.14);
      for (int k = 0; k < 3; ++k) exact = model.push(Capsule<double>{exact.s, axis, 0.0055, exact.normal});
      REQUIRE(exact.status == Status::ok);
      CHECK(exact.miss == 0);
      CHECK(std::abs(penetration(model, axis, 0.0055)) <= 1e-9);
      for (const double away : {-0.01, -1e-3, -3e-5, 3e-5, 1e-3, 0.01}) {
        const Pushed<double, 3> pushed = from(exact.s + away);
        CAPTURE(way.x(), way.y(), depth, away, name(pushed.status), pushed.miss);
        CHECK(pushed.status == Status::ok);
        CHECK(pushed.miss == 0);
        CHECK(std::abs(pushed.force / exact.force - 1) <= 5e-6);
        CHECK(std::abs(pushed.s - exact.s) <= 1e-6 * 0.2);
        CHECK((pushed.normal - exact.normal).norm() <= 5e-6);
      }
    }
}

// Across the plane a capsule is a round finger: the elastica with the contact as boundary condition.
TEST_CASE("a stylus across a strip feels what a finger feels that is led down past it", "[rod]") {
  const Csv table("finger.csv");
  const double EA = 200e9 * 0.025 * 0.001, EI = EA * 1e-6 / 12;
  const Rod strip(0.3, RodStiffness{EA, EI, EI, EI}, 0.001, RodSupport::clamped, RodSupport::free);
  FemModel<RoundRod> model(strip, 16);
  Touch<FemModel<RoundRod>> touch(model, 0.005);
  const Point shaft(0, 0, 0.04);
  Point before(0, 0, 0);
  double worst = 0, place = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Point to(table.number(row, "x_c"), table.number(row, "y_c"), -0.02);
    if (to.x() != before.x()) touch.reset(), before = Point(to.x(), 0.006, -0.02);
    move(touch, before, to, shaft, 40, [](const Point&, const Felt& r) { check_law(r); });
    const Felt r = rest_at(touch, to, shaft);
    REQUIRE(r.status == Status::ok);
    const Point force(table.number(row, "force_x"), table.number(row, "force_y"), 0),
        foot(table.number(row, "foot_x"), table.number(row, "foot_y"), 0);
    worst = std::max(worst, (r.force - force).norm() / force.norm());
    place = std::max(place, (r.contact.foot - foot).head<2>().norm());
    CHECK(std::abs(r.contact.s - table.number(row, "s")) <= 2e-6);
    before = to;
  }
  CAPTURE(worst, place);
  CHECK(worst <= 1e-5);
  CHECK(place <= 1e-6);
}

// The planar beam has the fourth order of its own elements, and takes so many that nothing of it is left.
TEST_CASE("a wire pushed in a plane is the planar beam, to the fourth order of its elements", "[rod]") {
  const Beam beam(0.3, Section::circle(0.002), Material{200e9}, Support::clamped, Support::free);
  const Rod rod(0.3, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  double worst[2] = {0, 0};
  for (const int fine : {0, 1}) {
    FemModel<Corotational<>> in_plane(beam, 64);
    FemModel<RoundRod> in_space(rod, 8 << fine);
    Touch<FemModel<Corotational<>>> planar(in_plane, 0.005);
    Touch<FemModel<RoundRod>> touch(in_space, 0.005);
    for (int k = 0; k <= 1000; ++k) {
      const double t = k / 1000.0;
      const Vector2<double> hand(0.2 + 0.05 * std::sin(9 * t), 0.01 - 0.16 * std::sin(3.3 * t));
      const TouchResult<double> expected = planar.tick(hand);
      const Felt r = touch.tick({hand.x(), hand.y(), -0.02}, {0, 0, 0.05});
      check_law(r);
      REQUIRE(r.pressing == expected.pressing);
      REQUIRE(r.status == expected.status);
      if (expected.force.norm() > 0.01)
        worst[fine] =
            std::max(worst[fine], (r.force.head<2>() - expected.force).norm() / expected.force.norm());
      REQUIRE(std::abs(r.force.z()) <= 1e-9 * (1 + r.force.norm()));
    }
  }
  CAPTURE(worst[0], worst[1]);
  CHECK(worst[0] <= 1e-4);
  CHECK(worst[1] <= worst[0] / 10);
}
