// Elements that bend against a natural shape: free of force where they have it, and the exact bending energy elsewhere.
#include "element/elements.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include <hapbeam/fem/natural_shape.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// The end displacements of an element of the natural curve from s on, which begins at the origin along x.
Vector6<double> natural_state(const NaturalShape<double>& shape, double s, double length) {
  const Displacement<double> a = shape.at(s), b = shape.at(s + length);
  Vector6<double> d;
  d << a.u, a.w, a.theta, b.u, b.w, b.theta;
  return d;
}

NaturalShape<double> circle(double length, double curvature) {
  return NaturalShape<double>(
      Beam(length, 1, 1, 0.1, Support::clamped, Support::free).naturally({{length, curvature}}));
}

}  // namespace

// With x = κl/2 the chord of an arc is l sin x/x = l (1 - x²/6 + x⁴/120 - …).  AssumedStrain knows the first term,
// 5 (κl²/2)²/30l², so that x⁴/120 = (κl)⁴/1920 is left, by next terms of x²/42; Linear knows none.
TEST_CASE("at its natural arc an element is strained by the fourth power of its angle",
          "[element][natural]") {
  for (const double angle : {0.05, 0.2, -0.5, 1.0})
    for (const double start :
         {0.0, 3.0, 20.0}) {  // turned by where it is on the circle, twenty radians included
      const double length = 0.3, k = angle / length, x = angle / 2;
      const NaturalShape<double> shape = circle(100, k);
      ElementProperties<double> p(length, 1e6, 10);
      shape.apply(start * length, p);
      const Vector6<double> d = natural_state(shape, start * length, length);
      Vector6<double> r;
      Turning::residual(p, d, r);
      const double left = p.axial_stiffness * std::pow(x, 4) / 120;
      // Positions up to 20 l are rounded to 20 eps l.
      const double round_off = 1e2 * 2.2e-16 * p.axial_stiffness;
      INFO("angle " << angle << " from " << start << ": " << r.transpose());
      CHECK(std::abs(r.segment<2>(3).norm() - left) <= left * x * x / 20 + round_off);
      // Its moment is that of N on the bow: N l θ'/6 with θ' = x.
      CHECK(std::abs(r[5]) <= left * length * std::abs(x) / 6 * (1 + x * x / 20) + round_off * length);
      TurningLinear::residual(p, d, r);
      const double textbook = p.axial_stiffness * x * x / 6;
      CHECK(std::abs(r.segment<2>(3).norm() - textbook) <= textbook * x * x / 10 + round_off);
    }
}

// Forces are the bending moment EI (κ - κ0) taken by the curvatures of the cubic, ∂κ/∂θ1 = -(4 - 6t)/l and
// ∂κ/∂θ2 = (6t - 2)/l, integrated piece by piece: exact where a corner, an arc shorter than the element, lies in it.
TEMPLATE_TEST_CASE("an element bends against its natural curvature as the integral over the beam says",
                   "[element][natural]", Linear, TurningLinear) {
  const double length = 0.7, EI = 3;
  const std::vector<Arc> arcs{{0.1, 2}, {0.31, -1}, {0.32, 40}, {0.9, 0.5}, {1.5, 0}, {1.6, -7}};
  const NaturalShape<double> shape(Beam(2, 1, 1, 0.1, Support::clamped, Support::free).naturally(arcs));
  Random random(71);
  for (int trial = 0; trial < 200; ++trial) {
    const double s = random(0, 1.3);
    ElementProperties<double> p(length, 1e3, EI);
    shape.apply(s, p);
    const double a = random(0.3), b = random(0.3);
    double m1 = EI * (4 * a + 2 * b) / length, m2 = EI * (2 * a + 4 * b) / length, from = 0;
    for (const Arc& arc : arcs) {
      const double low = std::max(from, s), high = std::min(arc.end, s + length);
      from = arc.end;
      if (!(low < high)) continue;
      const double t = ((low + high) / 2 - s) / length;  // the middle is exact for linear functions
      m1 += EI * arc.curvature * (high - low) * (4 - 6 * t) / length;
      m2 -= EI * arc.curvature * (high - low) * (6 * t - 2) / length;
    }
    Vector6<double> d, r;
    d << 0, 0, a, 0, 0, b;
    TestType::residual(p, d, r);
    CHECK(std::abs(r[2] - m1) <= 1e-13 * EI);
    CHECK(std::abs(r[5] - m2) <= 1e-13 * EI);
  }
}

TEST_CASE("at rest on its natural rotations every element is free of moment, and has no energy of bending",
          "[element][natural]") {
  Random random(72);
  for (int trial = 0; trial < 100; ++trial) {
    ElementProperties<double> p = random_properties(random);
    p.natural_a = random(0.3) * p.length;
    p.natural_b = random(0.3) * p.length;
    Vector6<double> d = Vector6<double>::Zero(), r;
    d[2] = p.natural_a / p.length;
    d[5] = p.natural_b / p.length;
    const double EI = p.bending_per_length3 * std::pow(p.length, 3);
    Linear::residual(p, d, r);
    CHECK(r.norm() <= 64 * 2.2e-16 * EI / (p.length * p.length) * (1 + p.length));
    CHECK(Linear::energy(p, d) <= 1e-28 * EI / p.length);
    TurningLinear::residual(p, d, r);
    CHECK(r.norm() <= 64 * 2.2e-16 * EI / (p.length * p.length) * (1 + p.length));
  }
}
