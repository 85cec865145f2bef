// A hand on a rod in space: a sphere and a stylus, from all sides, around the rod, through it, and off its end.
#include <numeric>

#include "rod/touching.hpp"
#include "support/random.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Wire = FemModel<RoundRod>;
constexpr double radius = 0.005, reach = 0.0055;

Point across(double angle) { return {0, std::cos(angle), std::sin(angle)}; }

}  // namespace

TEST_CASE("a wire feels the same from all sides, and a stroke has one beginning and one end", "[rod]") {
  std::vector<double> expected;
  for (int side = 0; side < 12; ++side) {
    Wire model(wire(), 8);
    Touch<Wire> touch(model, radius);
    const Point n = across(0.1 + side * pi / 6);
    std::vector<double> felt;
    int begins = 0, ends = 0;
    bool before = false;
    const auto look = [&](const Point&, const Felt& r) {
      check_law(r);
      REQUIRE(r.status == Status::ok);
      begins += r.pressing && !before, ends += before && !r.pressing;
      before = r.pressing;
      felt.push_back(r.force.dot(n));
    };
    const Point home(0.14, 0, 0);
    move(touch, home + 0.01 * n, home + 0.002 * n, Point::Zero(), 80, look);  // 3.5 of 5.5 mm deep
    move(touch, home + 0.002 * n, home + 0.01 * n, Point::Zero(), 80, look);
    CHECK(begins == 1);
    CHECK(ends == 1);
    CHECK(*std::max_element(felt.begin(), felt.end()) > 0.03);
    CHECK(model.strain_energy() == 0);
    if (side == 0) expected = felt;
    // The solver stops at 1e-6 of the force.
    for (std::size_t k = 0; k < felt.size(); ++k)
      CHECK(std::abs(felt[k] - expected[k]) <= 1e-6 * (1e-3 + expected[k]));
  }
}

TEST_CASE("a hand goes around a wire and stays in touch, without work", "[rod]") {
  Wire model(wire(), 8);
  Touch<Wire> touch(model, radius);
  const double depth = 0.002, distance = reach - depth;
  const auto at = [&](double angle) { return Point(Point(0.14, 0, 0) + distance * across(angle)); };
  move(touch, Point(0.14, 0.01, 0), at(0), Point::Zero(), 80, [](auto&&...) {});
  const double force = rest_at(touch, at(0), Point::Zero()).force.norm();
  for (int k = 1; k <= 1000; ++k) {  // three times
    const double angle = 6 * pi * k / 1000;
    const Felt r = touch.tick(at(angle));
    check_law(r);
    REQUIRE(r.status == Status::ok);
    REQUIRE(r.pressing);
    REQUIRE(r.force.norm() == Approx(force).epsilon(1e-6));
    REQUIRE(std::abs(detail::cross3<double>(across(angle), r.force).x()) <=
            1e-5 * force);  // no force along the way
  }
}

// Its centre misses the axis by 1 mm: the wire gives way sideways and passes, as the mirror image of how it came.
TEST_CASE("a sphere that is pushed past a wire is let by, without a jump", "[rod]") {
  Wire model(wire(), 8);
  Touch<Wire> touch(model, radius);
  std::vector<Point> forces;
  move(touch, Point(0.14, 0.001, 0.01), Point(0.14, 0.001, -0.01), Point::Zero(), 400,
       [&](const Point&, const Felt& r) {
         check_law(r);
         REQUIRE(r.status == Status::ok);
         if (!forces.empty()) REQUIRE((r.force - forces.back()).norm() <= 0.003);
         forces.push_back(r.force);
       });
  CHECK(forces[199].norm() > 0.045);
  // The ticks k and 398 - k are at the same distance before and behind the axis.
  for (std::size_t k = 0; k < 199; ++k) {
    CHECK(forces[k].z() == Approx(-forces[398 - k].z()).margin(1e-6));
    CHECK(forces[k].y() == Approx(forces[398 - k].y()).margin(1e-6));
  }
  CHECK(model.strain_energy() == 0);
}

TEST_CASE("straight over the axis a wire slips around a sphere and is found behind it", "[rod]") {
  Wire model(wire(), 8);
  Touch<Wire> touch(model, radius);
  int refused = 0;
  Felt last;
  move(touch, Point(0.14, 0, 0.01), Point(0.14, 0, -0.003), Point::Zero(), 260,
       [&](const Point&, const Felt& r) {
         check_law(r);
         refused += !is_answer(r.status);
         last = r;
       });
  CHECK(refused <= Touch<Wire>::patience);  // on its way
  CHECK(last.status == Status::ok);
  CHECK(last.force.z() < 0);  // it pushes the hand on
  CHECK(std::abs(penetration(model, {Point(0.14, 0, -0.003), Point::Zero()}, reach)) <= 1e-7);
}

// Up to four diameters of rod and avatar in one tick, from anywhere to anywhere through the axis.
TEST_CASE("no hand is so fast that it passes through a wire unfelt", "[rod]") {
  Random random(81);
  for (const double speed : {0.5, 0.99, 1.5, 3.9})
    for (int trial = 0; trial < 40; ++trial) {
      Wire model(wire(), 8);
      Touch<Wire> touch(model, radius);
      const bool stylus = trial % 2 != 0;
      Point way = detail::unit(Point(random(0.5), random(1.0), random(1.0)));
      if (std::abs(way.x()) > 0.8) way = {0, 1, 0};
      Point shaft = Point::Zero();
      if (stylus) shaft = 0.1 * detail::unit(detail::cross3<double>(way, {1, 0, 0}));
      const Point through(random(0.06, 0.19), 0, 0);
      const double step = speed * 2 * reach, begin = -0.05 - random(0.0, 1.0) * step;
      bool felt = false;
      for (int k = 0; begin + k * step < 0.05 + step && !felt; ++k) {
        const Felt r = touch.tick(through + (begin + k * step) * way - shaft / 2, shaft);
        check_law(r);
        felt = r.pressing;
        // Whatever its speed a stylus is held up, by a wire that it takes along.
        if (felt && stylus && is_answer(r.status)) CHECK(r.force.dot(way) < 0);
      }
      CAPTURE(speed, trial);
      CHECK(felt);
    }
}

TEST_CASE("a stylus bends a wire as far as it goes, and slips off past its tip", "[rod]") {
  for (const double slant : {0.0, 0.3, -0.5}) {
    Wire model(wire(), 8);
    Touch<Wire> touch(model, radius);
    const Point shaft = 0.1 * Point(0.2 * slant, std::cos(slant), std::sin(slant));
    int begins = 0, ends = 0, refused = 0;
    bool before = false;
    double deepest = 0, worst = 0;
    move(touch, Point(0.16, 0, 0.02) - shaft / 2, Point(0.16, 0, -0.16) - shaft / 2, shaft, 900,
         [&](const Point& at, const Felt& r) {
           check_law(r);
           refused += !is_answer(r.status);
           begins += r.pressing && !before, ends += before && !r.pressing;
           before = r.pressing;
           if (!r.pressing || r.status != Status::ok) return;
           deepest = std::max(deepest, -model.shape().at(0.2).r.z());
           worst = std::max(worst, std::abs(penetration(model, {at, shaft}, reach)));
         });
    CAPTURE(slant, refused, deepest, worst);
    CHECK(begins == 1);
    CHECK(ends == 1);
    CHECK(refused <= 5);
    CHECK(deepest > 0.07);
    CHECK(worst <= 1e-7);
    CHECK(model.strain_energy() == 0);
  }
}

// What is let go is a new rod: who stands in it has to leave before touching it again.
TEST_CASE("the memory of a contact ends with its release", "[rod]") {
  Wire model(wire(), 8), fresh(wire(), 8);
  Touch<Wire> touch(model, radius), other(fresh, radius);
  const Point shaft(0, 0.1, 0);
  move(touch, Point(0.16, -0.05, 0.02), Point(0.16, -0.05, -0.16), shaft, 900, [](auto&&...) {});
  REQUIRE_FALSE(touch.pressing());
  // From below now.
  const auto stroke = [&](Touch<Wire>& hand) {
    std::vector<Felt> felt;
    move(hand, Point(0.15, -0.05, -0.05), Point(0.15, -0.05, 0.01), shaft, 300,
         [&](const Point&, const Felt& r) { felt.push_back(r); });
    return felt;
  };
  const auto again = stroke(touch), first = stroke(other);
  for (std::size_t k = 0; k < first.size(); ++k) {
    REQUIRE(again[k].pressing == first[k].pressing);
    REQUIRE((again[k].force - first[k].force).norm() <= 1e-5 * (1e-3 + first[k].force.norm()));
  }
  CHECK(first.back().force.z() < 0);
}

// The end does not yield, and is gone around.
TEST_CASE("a hand that goes around a clamp meets what does not move", "[rod]") {
  Wire model(wire(), 8);
  Touch<Wire> touch(model, radius);
  std::vector<Point> way{{0.02, 0, 0.01},      {0.001, 0, 0.0053},  {-0.002, 0, 0.0048}, {-0.0052, 0, 0},
                         {-0.002, 0, -0.0048}, {0.001, 0, -0.0053}, {0.02, 0, -0.01}};
  int pressing = 0, refused = 0;
  for (std::size_t k = 1; k < way.size(); ++k)
    move(touch, way[k - 1], way[k], Point::Zero(), 100, [&](const Point& at, const Felt& r) {
      check_law(r);
      pressing += r.pressing;
      refused += !is_answer(r.status);
      if (!r.pressing || at.x() > 0) return;
      CHECK(r.status == Status::out_of_range);
      CHECK(r.force.dot(at) > 0.9999 * r.force.norm() * at.norm());  // away from the end
    });
  CHECK(pressing > 300);
  CHECK(refused <= 2);
  CHECK_FALSE(touch.pressing());
  CHECK(model.strain_energy() == 0);
}

// The hand's work is integrated by Simpson's rule over three ticks: h⁴ of its way.
TEST_CASE("closed paths of a sphere and of a stylus on a wire take no work", "[rod]") {
  for (const int elements : {8, 16})
    for (int path = 0; path < 4; ++path) {
      Wire model(wire(), elements, tight_solver());
      const bool stylus = path % 2 != 0;
      Touch<Wire> touch(model, stylus ? radius : 0.02);
      const Point shaft = stylus ? Point(0.02, 0.1, 0.01) : Point(0, 0, 0),
                  centre = stylus ? Point(0.12, -0.05, -0.04) : Point(0.12, 0, 0.008),
                  size = stylus ? Point(0.02, 0.01, 0.012) : Point(0.02, 0.004, 0.004);
      const auto at = [&](double t) -> Point {
        const double a = 2 * pi * t;
        return centre + Point(size.x() * std::sin(2 * a + path), size.y() * std::sin(a + 2.0 * path),
                              size.z() * std::sin(a + 1));
      };
      move(touch, at(0) + Point(0, 0, 0.06), at(0), shaft, 300, [](auto&&...) {});
      Point force = rest_at(touch, at(0), shaft).force;
      const int steps = 1000;
      double work = 0, peak = model.strain_energy();
      int not_ok = 0;
      for (int k = 0; k < steps; ++k) {
        const double h = 1.0 / steps, t = k * h;
        Point forces[2];
        for (int half = 0; half < 2; ++half) {
          const Felt r = touch.tick(at(t + (half + 1) * h / 2), shaft);
          check_law(r);
          not_ok += r.status != Status::ok || !r.pressing;
          forces[half] = r.force;
        }
        const auto speed = [&](double u) { return Point((at(u + 1e-5) - at(u - 1e-5)) / 2e-5); };
        work -=
            h / 6 * (force.dot(speed(t)) + 4 * forces[0].dot(speed(t + h / 2)) + forces[1].dot(speed(t + h)));
        force = forces[1];
        peak = std::max(peak, model.strain_energy());
      }
      CAPTURE(elements, path, work, peak, not_ok);
      CHECK(not_ok == 0);
      CHECK(std::abs(work) <= (elements == 8 ? 1e-5 : 1e-6) * peak);
    }
}

// Central differences of the stored energy with h = 1e-5 m leave (h/reach)² and 1e-9 of round-off; what 16 elements miss of a
// potential, because their nodes follow the contact, is 1e-6.
TEST_CASE("the force on a hand is the gradient of the stored energy, in space", "[rod]") {
  const auto check = [](auto& model, double of, const Point& from, const Point& at, const Point& shaft) {
    Touch<std::decay_t<decltype(model)>> touch(model, of);
    move(touch, from, at, shaft, 300, [](auto&&...) {});
    const Felt r = rest_at(touch, at, shaft);
    REQUIRE(r.status == Status::ok);
    REQUIRE(r.pressing);
    const double h = 1e-5;
    Point slope;
    for (int axis = 0; axis < 3; ++axis) {
      double energy[2];
      for (int k = 0; k < 2; ++k) {
        (void)rest_at(touch, at + (k == 0 ? -h : h) * Point::Unit(axis), shaft);
        energy[k] = model.strain_energy();
      }
      slope[axis] = (energy[1] - energy[0]) / (2 * h);
    }
    CAPTURE(r.force.norm(), (slope + r.force).norm());
    CHECK((slope + r.force).norm() <= 1e-5 * r.force.norm());
  };
  Wire model(wire(), 16, tight_solver());
  check(model, 0.02, {0.12, 0.003, 0.03}, {0.12, 0.003, 0.01}, {0, 0, 0});
  check(model, radius, {0.13, -0.05, 0.02}, {0.13, -0.05, -0.04}, {0, 0.1, 0});
  check(model, radius, {0.13, -0.05, 0.02}, {0.13, -0.05, -0.04}, {0.03, 0.1, 0.01});
  const Rod strip(0.2, RodSection::rectangle(0.010, 0.0005), spring_steel, RodSupport::clamped,
                  RodSupport::free);
  FemModel<TwistedRod> twisted(strip, 16, tight_solver());
  check(twisted, 0.02, {0.13, 0.004, 0.03}, {0.13, 0.004, 0.012}, {0, 0, 0});
}

TEST_CASE("an avatar that is none is rejected, and a hand that is nowhere", "[rod]") {
  Wire model(wire(), 8);
  CHECK_THROWS_AS(Touch<Wire>(model, -1.0), std::invalid_argument);
  CHECK_THROWS_AS(Touch<Wire>(model, 1e9), std::invalid_argument);
  Touch<Wire> touch(model, radius);
  (void)touch.tick({0.14, 0, 0.003});
  REQUIRE(touch.pressing());
  for (const Point& at : {Point(std::nan(""), 0, 0), Point(0, INFINITY, 0), Point(0, 0, 1e300)}) {
    const Felt r = touch.tick(at);
    CHECK(r.status == Status::invalid_request);
    CHECK(r.force.isZero(0));
  }
  CHECK(touch.tick({0.14, 0, 0.003}).status == Status::ok);
}

// Its shaft goes down to the hinge as far as to the wire.  A place of contact that runs to the hinge finds a million newtons there, or nothing.
TEST_CASE("a stylus that leans over a hinge is held by the wire beside it", "[rod]") {
  const Rod wire(0.3, RodSection::circle(0.001), spring_steel, RodSupport::hinged, RodSupport::clamped);
  FemModel<RoundRod> model(wire, 8);
  Touch<FemModel<RoundRod>> touch(model, 0.01);
  const double lean = 5 * pi / 180;
  const Point shaft = 0.2 * Point(-std::cos(lean), std::sin(lean), 0);
  for (int k = 4; k <= 60; ++k) {
    const Felt felt = touch.tick(Point(0.015, 0.0105 - 1e-4 * k, 0), shaft);
    CAPTURE(k, name(felt.status), felt.force.norm());
    CHECK(felt.pressing);
    CHECK(felt.force.norm() <= 100);
  }
}
