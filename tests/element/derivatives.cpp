// Residual and tangent as derivatives of the energy, and what does no work: the laws of every element.
//
// Elements of any rotation have files of their own (corotational.cpp); of the others
// V is a polynomial of degree four in the nodal displacements and the residual one of degree three, so the
// five-point rule is exact with steps as large as the state and only round-off is left: eps times the largest
// term over the step, which the membrane of a slender element makes EA/(EI/l²) <= 1e6 times the bending part.
#include "element/elements.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

TEMPLATE_TEST_CASE("the residual is the gradient of the energy", "[element]", Linear, Full, Reduced,
                   Assumed) {
  Random random(21);
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const Vector6<double> d = random_state(random, p.length);
    Vector6<double> r, expected, scale;
    TestType::residual(p, d, r);
    const auto energy = [&](const Vector6<double>& x) { return TestType::energy(p, x); };
    for (int i = 0; i < 6; ++i) {
      expected[i] = derivative(energy, d, i, step(i, p.length));
      scale[i] = 1 / step(i, p.length);  // a force times its step is a work
    }
    worst = std::max(worst, (r - expected).cwiseQuotient(scale).norm() / r.cwiseQuotient(scale).norm());
  }
  INFO("largest relative difference " << worst);
  CHECK(worst <= 1e-11);
}

TEMPLATE_TEST_CASE("the tangent is the gradient of the residual, and symmetric", "[element]", Linear, Full,
                   Reduced, Assumed) {
  Random random(22);
  double worst = 0, asymmetry = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const Vector6<double> d = random_state(random, p.length);
    Vector6<double> r, same, scale;
    Matrix6<double> K, expected;
    const double energy = TestType::tangent(p, d, r, K);
    TestType::residual(p, d, same);
    REQUIRE((r - same).norm() == 0);
    REQUIRE(energy == TestType::energy(p, d));
    const auto residual = [&](const Vector6<double>& x) {
      Vector6<double> f;
      TestType::residual(p, x, f);
      return f;
    };
    for (int i = 0; i < 6; ++i) {
      expected.col(i) = derivative(residual, d, i, step(i, p.length));
      scale[i] = step(i, p.length);
    }
    const Matrix6<double> work = scale.asDiagonal() * K * scale.asDiagonal();
    const Matrix6<double> difference = scale.asDiagonal() * (K - expected) * scale.asDiagonal();
    worst = std::max(worst, difference.norm() / work.norm());
    asymmetry = std::max(asymmetry, (work - work.transpose()).norm() / work.norm());
  }
  INFO("largest relative difference " << worst << ", asymmetry " << asymmetry);
  CHECK(worst <= 1e-11);
  CHECK(asymmetry <= 4 * 2.2e-16);
}

// The state is a float, so that both scalars see the same one; 6 eps bounds the differences of displacements
// that a float must take, relative to the largest term.
TEMPLATE_TEST_CASE("in float residual and tangent are those of double to round-off", "[element][float]",
                   Linear, Full, Reduced, Assumed, TurningLinear, TurningFull, TurningReduced, Turning) {
  Random random(23);
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const ElementProperties<float> pf(
        static_cast<float>(p.length), static_cast<float>(p.axial_stiffness),
        static_cast<float>(p.bending_per_length3 * p.length * p.length * p.length));
    const Vector6<float> df = random_state(random, p.length).cast<float>();
    const Vector6<double> d = df.cast<double>();
    Vector6<float> rf;
    Matrix6<float> Kf;
    Vector6<double> r, scale;
    Matrix6<double> K;
    TestType::tangent(pf, df, rf, Kf);
    TestType::tangent(p, d, r, K);
    for (int i = 0; i < 6; ++i) scale[i] = i % 3 == 2 ? 1 : p.length;
    const Matrix6<double> work = scale.asDiagonal() * K * scale.asDiagonal();
    const Matrix6<double> difference = scale.asDiagonal() * (Kf.cast<double>() - K) * scale.asDiagonal();
    worst = std::max(worst, difference.norm() / work.norm());
    // |r| can be small by cancellation; K times the displacement differences cannot.
    worst = std::max(worst, scale.cwiseProduct(rf.cast<double>() - r).norm() / work.norm());
  }
  INFO("largest relative difference " << worst);
  CHECK(worst <= 16 * 1.2e-7);
}

TEMPLATE_TEST_CASE("a rigid translation takes exactly no force and no energy", "[element]", Linear, Full,
                   Reduced, Assumed, TurningLinear, TurningFull, TurningReduced, Turning) {
  Random random(24);
  for (int trial = 0; trial < 100; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const double u = random(10), w = random(10);
    Vector6<double> d, r;
    d << u, w, 0, u, w, 0;
    TestType::residual(p, d, r);
    REQUIRE(r.norm() == 0);
    REQUIRE(TestType::energy(p, d) == 0);
  }
}

// Turning the element by a small angle changes its strain by w' less the slope of its chord, whose mean is
// zero.  Sampled in points it is not: full and reduced integration leave a moment.
TEMPLATE_TEST_CASE("forces and moments on an element are in balance", "[element]", Linear, Assumed) {
  Random random(25);
  for (int trial = 0; trial < 200; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const Vector6<double> d = random_state(random, p.length);
    Vector6<double> r;
    TestType::residual(p, d, r);
    REQUIRE(r[0] + r[3] == 0);
    REQUIRE(r[1] + r[4] == 0);
    // About node 1: the transverse force at arm l, moments that work on theta = -w', and the axial force at
    // arm w2 - w1. Linear balances on the undeformed element.
    const double axial = std::is_same_v<TestType, Linear> ? 0 : r[3] * (d[4] - d[1]);
    const double moment = r[4] * p.length - axial - r[2] - r[5];
    const double scale = std::abs(r[4] * p.length) + std::abs(axial) + std::abs(r[2]) + std::abs(r[5]);
    REQUIRE(std::abs(moment) <= 16 * 2.2e-16 * scale);
  }
}
