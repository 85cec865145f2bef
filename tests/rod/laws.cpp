// Laws of a rod that a hand pushes: work, path, objectivity, and the planar answers in a plane.
#include <functional>
#include <vector>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// A curved flat rod under its weight, clamped as it lies.
Rod leaf() {
  Rod leaf(0.3, RodSection::rectangle(0.012, 0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  return leaf.naturally({{0.1, 1, 3, 2}, {0.3, -2, 1, 4}}).weight(7850, {0, -9.81, 0});
}

Point direction(double a, double b) {
  return {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)};
}

}  // namespace

TEST_CASE("the force on a rod is the derivative of its energy", "[rod]") {
  Rod rod(0.3, RodSection::rectangle(0.012, 0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  rod.naturally({{0.1, 1, 3, 2}, {0.3, -2, 1, 4}});
  FemModel<TwistedRod> model(rod, 8);
  const Point n = direction(1.2, -0.5);
  const double s = 0.23, home = n.dot(model.shape().at(s).r), h = 1e-4;
  for (const double depth : {0.005, 0.02, 0.05, 0.09}) {
    const auto energy = [&](double d) {
      REQUIRE(model.push({s, home + d, n}).status == Status::ok);
      return model.strain_energy();
    };
    const double slope =
        (8 * (energy(depth + h) - energy(depth - h)) - energy(depth + 2 * h) + energy(depth - 2 * h)) /
        (12 * h);
    CHECK(model.push({s, home + depth, n}).force == Approx(slope).epsilon(1e-6));
  }
}

TEST_CASE("a rod is where it was when the hand comes back, whatever way it came", "[rod]") {
  FemModel<TwistedRod> model(leaf(), 8);
  const Point n = direction(1.2, -0.5);
  const double home = n.dot(model.shape().at(0.25).r);
  // At one place the way back is the way there.
  std::vector<double> forces;
  for (const double d : {0.01, 0.02, 0.03, 0.04, 0.03, 0.02, 0.01})
    forces.push_back(model.push({0.25, home + d, n}).force);
  for (std::size_t k = 0; k < 3; ++k) CHECK(forces[k] == Approx(forces[6 - k]).epsilon(1e-8));
  // The state itself, by another way: deep, aside, and another place.
  const auto before = model.shape().at(0.3);
  (void)model.push({0.25, home - 0.05, n});
  (void)model.push({0.15, direction(2, 1).dot(model.shape().at(0.15).r) + 0.02, direction(2, 1)});
  CHECK(model.push({0.25, home + 0.01, n}).force == Approx(forces[0]).epsilon(1e-8));
  CHECK((model.shape().at(0.3).r - before.r).norm() <= 1e-8);
}

namespace {

template <class Element>
void check_objectivity(const RodSection& section, const std::vector<RodArc>& shape) {
  Random random(41);
  const Point n = direction(0.3, -0.5);
  const auto answers = [&](const RodPose& pose, const std::function<Point(const Point&)>& turn) {
    Rod rod(0.3, section, spring_steel, RodSupport::clamped, RodSupport::free);
    rod.naturally(shape).place_left(pose).add({0.2, turn({0, -1, 0.5})});
    FemModel<Element> model(rod, 8);
    const Point along = turn(n);
    const double home = along.dot(model.shape().at(0.25).r);
    std::vector<double> forces;
    for (const double d : {0.005, 0.02, 0.04}) forces.push_back(model.push({0.25, home + d, along}).force);
    return forces;
  };
  const auto here = answers({}, [](const Point& x) { return x; });
  for (int trial = 0; trial < 5; ++trial) {
    const Point axis = detail::unit(Point(random(1.0), random(1.0), random(1.0)));
    const double angle = random(20.0);  // three turns
    const auto turn = [&](const Point& x) -> Point {
      const Point along = axis.dot(x) * axis;
      return along + std::cos(angle) * (x - along) + std::sin(angle) * detail::cross3(axis, x);
    };
    const auto there =
        answers({{random(1.0), random(1.0), random(1.0)}, turn({1, 0, 0}), turn({0, 1, 0})}, turn);
    // Both take the same solves.  d is a place of a metre that rounds to 1e-16, of displacements of 5 mm and more.
    for (std::size_t k = 0; k < here.size(); ++k) CHECK(there[k] == Approx(here[k]).epsilon(1e-12));
  }
}

}  // namespace

TEST_CASE("a rod answers the same wherever it stands and however it is turned", "[rod]") {
  SECTION("straight and round") { check_objectivity<RoundRod>(RodSection::circle(0.002), {}); }
  SECTION("curved and flat") {
    check_objectivity<TwistedRod>(RodSection::rectangle(0.012, 0.002), {{0.1, 1, 3, 2}, {0.3, -2, 1, 4}});
  }
}

TEST_CASE("what bends in a plane gives the planar answers", "[rod]") {
  const double length = 0.3;
  const Beam beam(length, Section::rectangle(0.02, 0.001), Material{200e9}, Support::clamped, Support::free);
  FemModel<Corotational<>> planar(beam, 32);
  // Thin along d1, which is the plane's w.
  const Rod flat(length, RodSection::rectangle(0.001, 0.02), spring_steel, RodSupport::clamped,
                 RodSupport::free);
  FemModel<TwistedRod> rod(flat, 32);
  for (const double d : {0.01, 0.05, 0.1}) {
    const Vector2<double> n(0.1, std::sqrt(0.99));
    const auto expected = planar.push({0.25, d, n}),
               got = rod.push({0.25, 0.25 * 0.1 + d, {n.x(), n.y(), 0}});
    REQUIRE(expected.status == Status::ok);
    REQUIRE(got.status == Status::ok);
    CHECK(got.force == Approx(expected.force).epsilon(2e-6));
    CHECK(std::abs(rod.shape().at(length).r.z()) <= 1e-12);
  }
}

TEST_CASE("a rod that is let go comes to rest where it was", "[rod]") {
  FemModel<TwistedRod> model(leaf(), 12);
  REQUIRE(model.rest().status == Status::ok);
  const Point rest = model.shape().at(0.3).r, n = direction(1, 0.2);
  for (int k = 1; k <= 20; ++k)
    REQUIRE(is_answer(model.push({0.2, n.dot(model.shape().at(0.2).r) + 0.003, n}).status));
  CHECK((model.shape().at(0.3).r - rest).norm() > 0.03);
  Status status = Status::iteration_limit;
  for (int k = 0; k < 10 && status == Status::iteration_limit; ++k) status = model.release();
  CHECK(status == Status::ok);
  CHECK((model.shape().at(0.3).r - rest).norm() <= 1e-7);
}
