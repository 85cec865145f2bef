// Several contacts on one rod in space: the forces of the reference, and shafts across a plane are as circles in it.
#include <cmath>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/status.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// The bar and the ruler of contacts.csv, bent across their flat side: along z.
Rod flat_rod(bool ruler) {
  return ruler ? Rod(0.3, RodSection::rectangle(0.025, 0.001), spring_steel, RodSupport::clamped,
                     RodSupport::free)
               : Rod(1, RodSection::rectangle(0.02, 0.01), spring_steel, RodSupport::cardan,
                     RodSupport::hinged);
}

Obstacle<double, 3> stop(double s, double d) {
  const double n = d < 0 ? 1 : -1;
  Obstacle<double, 3> obstacle;
  obstacle.kind = ObstacleKind::stop;
  obstacle.place = {s, n * d, {0, 0, n}};
  obstacle.valid = obstacle.touching = true;
  return obstacle;
}

}  // namespace

// The bar that is bent two ways by 12 mm within 150 mm is the stiffest: 8.3e-4 with 16 elements, three of them between the contacts.
TEST_CASE("two contacts on a rod take the forces of the reference", "[several]") {
  const Csv table("contacts.csv");
  for (std::size_t row = 2; row < table.rows(); ++row) {
    const std::string name = table.text(row, "case");
    const bool ruler = name == "ruler_s_bend";
    const double s1 = ruler                     ? 0.15
                      : name == "bar_same_side" ? 0.3
                      : name == "bar_opposite"  ? 0.35
                                                : 0.48,
                 s2 = ruler                     ? 0.28
                      : name == "bar_same_side" ? 0.6
                      : name == "bar_opposite"  ? 0.5
                                                : 0.52;
    INFO(name << " " << table.text(row, "depth1"));
    double error[2] = {0, 0};
    for (const int fine : {0, 1}) {
      FemModel<Several<TwistedRod, 2>> model(flat_rod(ruler), fine ? 32 : 16);
      Obstacle<double, 3> both[2] = {stop(s1, table.number(row, "depth1")),
                                     stop(s2, table.number(row, "depth2"))};
      REQUIRE(model.push(both, 2) == Status::ok);
      const double f[2] = {table.number(row, "force1"), table.number(row, "force2")};
      for (int k = 0; k < 2; ++k)
        error[fine] = std::max(error[fine], std::abs(-both[k].pushed.force / std::abs(f[k]) - 1));
    }
    CHECK(error[0] <= 1e-3);
    CHECK(error[1] <= 1e-4);
    CHECK(error[1] <= std::max(error[0] / 8, 1e-6));
  }
}

TEST_CASE("shafts and spheres on one side of a rod pass each other, and one of them always holds it",
          "[several]") {
  const Rod needle(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  for (const bool sphere : {false, true})
    for (const double depth : {0.003, 0.008})
      for (const double deeper : {-1e-4, -2e-5, 0.0, 2e-5, 1e-4}) {
        CAPTURE(sphere, depth, deeper);
        const double radius = sphere ? 0.01 : 0.005, surface = radius + 0.001, z = sphere ? 0 : -0.02;
        const Vector3<double> shafts[2] = {{0, 0, sphere ? 0 : 0.04}, {0, 0, sphere ? 0 : 0.04}};
        FemModel<Several<RoundRod, 2>> model(needle, 8);
        TouchSeveral touch(model, {radius, radius});
        int failures = 0;
        double force = 0;
        const auto go = [&](double left, double right, double down) {
          const Vector3<double> at[2] = {{left, surface - down, z}, {right, surface - down - deeper, z}};
          const auto felt = touch.tick(at, shafts, 2);
          failures += !is_answer(felt.status);
          force = felt.force(0).norm() + felt.force(1).norm();
        };
        for (int k = 0; k <= 200; ++k) go(0.09, 0.15, depth * k / 200);
        for (int k = 0; k <= 250; ++k) go(0.09 + 2.4e-4 * k, 0.15 - 2.4e-4 * k, depth);
        CHECK(failures == 0);
        CHECK(force > 0.1);
      }
}

TEST_CASE("two shafts and a bar across a rod are two circles and a peg on a beam", "[several]") {
  const double d = 0.006, radius = 0.01, reach = radius + d / 2;
  const Beam bar(1, Section::circle(d), Material{200e9}, Support::clamped, Support::clamped);
  const Rod rod(1, RodSection::circle(d), spring_steel, RodSupport::clamped, RodSupport::clamped);
  FemModel<Several<Corotational<>, 4>> in_plane(bar, 24);
  FemModel<Several<RoundRod, 4>> in_space(rod, 24);
  TouchSeveral flat(in_plane, {radius, radius}, {Prop<>::peg({0.5, -reach - 0.001}, radius)});
  TouchSeveral round(in_space, {radius, radius},
                     {Prop<3>::bar({0.5, -reach - 0.001, -0.1}, {0.5, -reach - 0.001, 0.1}, radius)});
  bool peg = false;
  for (int t = 0; t < 120; ++t) {
    const double a = reach - 5e-5 * t, b = reach - 2e-5 * t;
    const auto two = flat.tick(Vector2<double>(0.3, a), Vector2<double>(0.7, b));
    const Point tips[2] = {{0.3, a, -0.1}, {0.7, b, -0.1}}, shafts[2] = {{0, 0, 0.2}, {0, 0, 0.2}};
    const auto three = round.tick(tips, shafts, 2);
    REQUIRE(two.status == Status::ok);
    REQUIRE(three.status == Status::ok);
    for (int body = 0; body < 3; ++body) {
      const Vector2<double> planar = two.force(body);
      const Point felt = three.force(body);
      REQUIRE((felt - Point(planar.x(), planar.y(), 0)).norm() <= 2e-3 * two.force(0).norm() + 1e-6);
    }
    peg = peg || two.touching(2);
  }
  CHECK(peg);
}

// The shaft leans, so that it presses the rod down and aside.
TEST_CASE(
    "a rod that is pressed onto a bar by a leaning shaft slides along the bar, which pushes square to itself",
    "[several]") {
  const double d = 0.006, radius = 0.01, reach = radius + d / 2;
  const Rod rod(1, RodSection::circle(d), spring_steel, RodSupport::clamped, RodSupport::free);
  FemModel<Several<RoundRod, 2>> model(rod, 16);
  TouchSeveral touch(model, {radius},
                     {Prop<3>::bar({0.5, -reach - 0.001, -0.2}, {0.5, -reach - 0.001, 0.2}, radius)});
  double along = 0, aside = 0;
  const Point shaft(0, 0.05, 0.2);
  for (int t = 0; t < 150; ++t) {
    const Point tip(0.9, reach - 0.025 - 1e-4 * t, -0.1);
    const auto felt = touch.tick(&tip, &shaft, 1);
    REQUIRE(felt.status == Status::ok);
    if (felt.touching(1)) along = std::max(along, std::abs(felt.force(1).z()) / felt.force(1).norm());
    if (t > 100) CHECK(felt.touching(1));
    aside = std::abs(model.shape().at(0.5).r.z());
  }
  CHECK(along <= 1e-9);
  CHECK(aside > 1e-4);
  const Point away(0.9, 1, 0);
  CHECK_FALSE(touch.tick(&away, &shaft, 1).touching(1));
}

// A sphere is pressed to a tenth of its reach past the end, at it, and beside it.
TEST_CASE("beside and past a held end of a rod several contacts feel what one feels", "[several]") {
  const double d = 0.006, radius = 0.01, reach = radius + d / 2;
  const Rod rod(1, RodSection::circle(d), spring_steel, RodSupport::clamped, RodSupport::clamped);
  for (const double s : {-0.004, 0.0, 5e-4, 2e-3, 5e-3, 0.995, 1.0, 1.004}) {
    FemModel<TwistedRod> alone(rod, 16);
    FemModel<Several<TwistedRod, 2>> both(rod, 16);
    Touch one(alone, radius);
    TouchSeveral several(both, {radius, radius});
    double most = 0, off = 0;
    bool held = true;
    for (int k = 0; k <= 200; ++k) {
      const double depth = 0.1 * reach * k / 200;
      const Vector3<double> at(s, 0, reach - depth), middle(0.5, 0, reach - 0.005 * std::min(1.0, 0.02 * k));
      const auto wanted = one.tick(at);
      const auto felt = several.tick(at, middle);
      if (wanted.pressing) held = held && felt.touching(0);
      most = std::max(most, wanted.force.norm());
      off = std::max(off, (felt.force(0) - wanted.force).norm());
    }
    INFO("at " << s << ": " << most << " N");
    CHECK(held);
    CHECK(most > 10);
    CHECK(off <= 0.05 * most);
  }
}

// A string that one hand holds down is straight on both sides of it, where a cubic between a clamp and the next node is not.
TEST_CASE("a second hand meets a string that a first one holds where it is", "[several]") {
  const double length = 0.648, diameter = 0.254e-3, tension = 72, depth = 0.008, held = 0.31, radius = 0.005,
               reach = radius + diameter / 2,
               longer = 1 + tension / (spring_steel.young * pi / 4 * diameter * diameter);
  Rod rod(length, RodSection::circle(diameter), spring_steel, RodSupport::clamped, RodSupport::clamped);
  rod.place_right({{length * longer, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Beam beam(length, Section::circle(diameter), Material{spring_steel.young}, Support::clamped,
            Support::clamped);
  beam.place({}, {length * (longer - 1), 0, 0});
  for (const double second : {0.045, 0.1}) {
    FemModel<Several<RoundRod, 2>> in_space(rod, 8);
    FemModel<Several<Corotational<>, 2>> in_plane(beam, 8);
    TouchSeveral<FemModel<Several<RoundRod, 2>>> capsules(in_space, {radius, radius});
    TouchSeveral<FemModel<Several<Corotational<>, 2>>> circles(in_plane, {radius, radius});
    const double x[2] = {held * length * longer, second * length * longer};
    double before = 0;
    const auto tick = [&](double y0, double y1) {
      const Point tips[2] = {{x[0], y0, -0.5}, {x[1], y1, -0.5}}, shafts[2] = {{0, 0, 1}, {0, 0, 1}};
      const Vector2<double> centres[2] = {{x[0], y0}, {x[1], y1}};
      const auto felt = capsules.tick(tips, shafts, 2);
      const auto flat = circles.tick(centres, 2);
      CAPTURE(second, y0, y1);
      REQUIRE(felt.status == Status::ok);
      REQUIRE(flat.status == Status::ok);
      for (int k = 0; k < 2; ++k) REQUIRE(felt.force(k).y() == Approx(flat.force(k).y()).margin(0.02));
      // Of 2.5 µm.
      REQUIRE(std::abs(felt.force(1).norm() - before) <= 0.02);
      before = felt.force(1).norm();
      return felt;
    };
    for (int k = 0; k <= 100; ++k) (void)tick(reach - depth * k / 100, 0.05);
    // Its layers at the clamp and under the hand are 0.75 mm long.
    const double straight = -depth * second / held;
    for (int k = 0; k <= 800; ++k) {
      const double above = 0.001 - 2.5e-6 * k;
      const auto felt = tick(reach - depth, reach + straight + above);
      if (above > 0.05e-3) REQUIRE(before == 0);
      if (above < -0.05e-3) REQUIRE(before > 0);
      REQUIRE(felt.force(0).y() > 0);
    }
  }
}

TEST_CASE("where no shafts are given spheres touch", "[several]") {
  FemModel<Several<RoundRod, 2>> model(
      Rod(0.3, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free), 8);
  TouchSeveral<FemModel<Several<RoundRod, 2>>> touch(model, {0.005});
  Point beside(0.2, 0.0065, -0.1);
  const Point along(0, 0, 0.2);
  bool touches = false;
  for (int k = 0; k < 20; ++k) beside.y() -= 1e-4, touches = touch.tick(&beside, &along, 1).touching(0);
  CHECK(touches);
  CHECK(!touch.tick(beside).touching(0));
}
