// Elements that bend against a natural shape: free of force where they have it, and the exact bending energy elsewhere.
#include "element/elements.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/element/tapered.hpp>

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

// Chains of arcs and corners of up to a right angle, turned by where they are on the beam, several turns included.
TEMPLATE_TEST_CASE("at its natural shape an element of any rotation has neither force nor energy",
                   "[element][natural]", TurningLinear, TurningFull, TurningReduced, Turning,
                   Corotational<VonKarman<StabilityFunctions>>, Corotational<Tapered<Linear>>) {
  Random random(73);
  double force = 0, energy = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<Arc> arcs;
    double end = 0;
    while (end < 4) {
      const bool corner = random(0.0, 1.0) < 0.3;
      const double length = corner ? 1e-3 : random(0.05, 0.6);
      arcs.push_back({end += length, corner ? random(pi / 2) / length : random(2.0)});
    }
    const NaturalShape<double> shape(Beam(5, 1, 1, 0.1, Support::clamped, Support::free).naturally(arcs));
    const double length = random(0.01, 0.3), s = random(0.0, 4.0);
    ElementProperties<double> p(length, 1e6, 10);
    shape.apply(s, p);
    const Vector6<double> d = natural_state(shape, s, length);
    Vector6<double> r;
    TestType::residual(p, d, r);
    force = std::max(force, r.norm() * length / p.axial_stiffness);
    energy = std::max(energy, TestType::energy(p, d) * length / p.axial_stiffness);
  }
  // Positions up to 5 are rounded to eps of them, elements as short as 1/100.
  const double round_off = 5 * 64 * 2.2e-16;
  CHECK(force <= round_off);
  CHECK(energy <= round_off * round_off / 2);
}

// With sin x/x of half of the angle the chord of an arc, as far as the digits go.
TEST_CASE("the natural chord of an arc has all digits, however flat it is", "[element][natural]") {
  for (const double angle : {1e-9, 1e-3, 0.4, -1.9, 2.1, 6.0}) {
    const double length = 0.3;
    ElementProperties<double> p(length, 1, 1);
    circle(1, angle / length).apply(0.2, p);
    const long double x = std::abs(angle) / 2, q = x * x;
    const long double excess = x < 1e-2L ? -q / 6 * (1 - q / 20 * (1 - q / 42)) : (std::sin(x) - x) / x;
    CHECK(relative_error(p.natural_stretch, static_cast<double>(length * excess)) <= 8 * 2.2e-16);
  }
}

// Forces are the bending moment EI (κ - κ0) taken by the curvatures of the cubic, ∂κ/∂θ1 = -(4 - 6t)/l and
// ∂κ/∂θ2 = (6t - 2)/l, integrated piece by piece: exact to the first order of the arcs' angles, where a corner, an arc shorter than the element, lies in it, too.
TEMPLATE_TEST_CASE("an element bends against its natural curvature as the integral over the beam says",
                   "[element][natural]", Linear, TurningLinear) {
  const double length = 0.7, EI = 3;
  std::vector<Arc> arcs{{0.1, 2}, {0.31, -1}, {0.32, 40}, {0.9, 0.5}, {1.5, 0}, {1.6, -7}};
  for (Arc& arc : arcs) arc.curvature *= 1e-5;  // the next order is the third
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

TEMPLATE_TEST_CASE("at its natural stretch and rotations every element is free of force and energy",
                   "[element][natural]", Linear, Full, Reduced, Assumed, VonKarman<StabilityFunctions>) {
  Random random(72);
  for (int trial = 0; trial < 100; ++trial) {
    ElementProperties<double> p = random_properties(random);
    p.natural_a = random(0.3) * p.length;
    p.natural_b = random(0.3) * p.length;
    // Against the chord's own length, and by no more than the policy's own mean of the slopes' squares.
    p.natural_stretch = random(0.02) * p.length;
    Vector6<double> d = Vector6<double>::Zero(), r;
    d[2] = p.natural_a / p.length;
    d[3] = p.natural_stretch;
    d[5] = p.natural_b / p.length;
    TestType::residual(p, d, r);
    const double round_off = 64 * 2.2e-16;
    CHECK(r.norm() <= round_off * p.axial_stiffness);
    CHECK(TestType::energy(p, d) <= round_off * round_off * p.axial_stiffness * p.length);
  }
}
