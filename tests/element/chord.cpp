// How a turning element takes an increment that may be large: by its angle, and without a normal force that was not foreseen.
#include "element/elements.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

Vector2<double> chord(const Vector6<double>& d, double length) { return {length + d[3] - d[0], d[4] - d[1]}; }

/// What a Newton step says of a rotation by phi: each point moves along its tangent, as far as the arc is long.
Vector6<double> tangent_of_turning(double phi, const Vector6<double>& d, double length) {
  const Vector2<double> c = chord(d, length);
  Vector6<double> x = Vector6<double>::Zero();
  x[2] = x[5] = phi;
  x[3] = phi * c.y();
  x[4] = -phi * c.x();
  return x;
}

}  // namespace

// Positions of a few lengths are rounded to eps of them.
TEMPLATE_TEST_CASE("an increment that turns the element turns its chord, by any angle and no longer",
                   "[element][rotation]", TurningLinear, TurningFull, TurningReduced, Turning) {
  Random random(101);
  for (int trial = 0; trial < 300; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const Vector6<double> d = turned(random(8 * pi), random_state(random, p.length), p.length);
    const double phi = random(3);
    const Vector2<double> change = TestType::chord_change(p, d, tangent_of_turning(phi, d, p.length));
    const Vector2<double> expected = chord(turned(phi, d, p.length), p.length) - chord(d, p.length);
    CHECK((change - expected).norm() <= 1e-13 * p.length);
  }
}

// However far the ends turn against each other: the chord's length is where the local element answers as its tangent
// foresees, K x along the chord.  V is at most quadratic in the stretch, so one step of Newton finds it.
TEMPLATE_TEST_CASE("after an increment the normal force is the one that the tangent foresees",
                   "[element][rotation]", TurningLinear, TurningReduced, Turning) {
  Random random(102);
  double worst = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const Vector6<double> d = random_state(random, p.length);
    Vector6<double> x = Vector6<double>::Zero();
    x[2] = random(1), x[5] = random(1);
    Vector6<double> r, after;
    Matrix6<double> K;
    TestType::tangent(p, d, r, K);
    const Vector2<double> before = chord(d, p.length), change = TestType::chord_change(p, d, x);
    Vector6<double> moved = d + x;
    moved[3] += change.x();
    moved[4] += change.y();
    TestType::residual(p, moved, after);
    // Nothing but rotations: the chord keeps its angle, and forces along it compare.
    const Vector2<double> along = before.normalized();
    const Vector6<double> foreseen = r + K * x;
    worst = std::max(worst,
                     std::abs(along.dot(after.segment<2>(3) - foreseen.segment<2>(3))) / p.axial_stiffness);
  }
  INFO("normal forces off by EA times " << worst);
  CHECK(worst <= 1e-13);
}

TEMPLATE_TEST_CASE("a small increment is the change of the chord, and keeps its digits",
                   "[element][rotation]", TurningLinear, TurningFull, TurningReduced, Turning) {
  Random random(103);
  for (int trial = 0; trial < 300; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const Vector6<double> d = turned(random(8 * pi), Vector6<double>::Zero(), p.length);
    Vector6<double> x;
    for (int i = 0; i < 6; ++i) x[i] = 1e-12 * random(1) * (i % 3 == 2 ? 1 : p.length);
    const Vector2<double> change = TestType::chord_change(p, d, x), expected(x[3] - x[0], x[4] - x[1]);
    // Second order in x, 1e-12 of it, and 16 eps; where d is rounded the element is strained by eps, and so is its answer.
    CHECK((change - expected).norm() <=
          1e-10 * expected.norm() + 64 * 2.2e-16 * 1e-12 * p.length + 16 * 2.2e-16 * p.length * 1e-3);
    CHECK(TestType::chord_change(p, d, Vector6<double>::Zero().eval()).norm() <= 1e-300);
  }
}
