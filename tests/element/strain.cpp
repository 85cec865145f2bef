// Which strain each element computes: exact integrals of its interpolation, and rotations that should not
// strain it.
#include "element/elements.hpp"
#include "support/catch.hpp"
#include <hapbeam/element/hermite.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Gauss points and weights on [0, 1]; n points are exact to degree 2n - 1.
struct Rule {
  std::vector<double> points, weights;
};
const Rule one{{0.5}, {1}};
const Rule two{{0.5 - std::sqrt(1. / 12), 0.5 + std::sqrt(1. / 12)}, {0.5, 0.5}};
const Rule three{{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)}, {5. / 18, 8. / 18, 5. / 18}};

double slope(const ElementProperties<double>& p, const Vector6<double>& d, double t) {
  const Eigen::Vector4d bending(d[1], d[2], d[4], d[5]);
  return -ShapeFunctions<double>(t, p.length).theta.dot(bending);
}

/// ½ EI ∫w''² dx; w' is quadratic, so its central difference is exact and w'' linear.
double bending_energy(const ElementProperties<double>& p, const Vector6<double>& d) {
  const double EI = p.bending_per_length3 * p.length * p.length * p.length;
  double sum = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double t = two.points[k];
    const double curvature = (slope(p, d, t + 0.25) - slope(p, d, t - 0.25)) / (0.5 * p.length);
    sum += two.weights[k] * p.length * EI * curvature * curvature / 2;
  }
  return sum;
}

double strain(const ElementProperties<double>& p, const Vector6<double>& d, double t) {
  const double rotation = slope(p, d, t);
  return (d[3] - d[0]) / p.length + rotation * rotation / 2;
}

/// Sum over the rule of f(strain).
template <class F>
double integral(const Rule& rule, const ElementProperties<double>& p, const Vector6<double>& d, F&& f) {
  double sum = 0;
  for (std::size_t k = 0; k < rule.points.size(); ++k)
    sum += rule.weights[k] * f(strain(p, d, rule.points[k]));
  return sum;
}

double squared(double x) { return x * x; }

/// The element's energy against membrane(p, d) [strain²] and exact bending, over random states.
template <class Element, class Membrane>
void check_energy(Membrane&& membrane) {
  Random random(31);
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const Vector6<double> d = random_state(random, p.length);
    const double EAl = p.axial_stiffness * p.length;
    const double expected = EAl / 2 * membrane(p, d) + bending_energy(p, d);
    // What cancels in a strain of 1e-3 are terms of 0.1.
    worst = std::max(worst, std::abs(Element::energy(p, d) - expected) / (expected + EAl * 1e-4));
  }
  INFO("largest relative difference " << worst);
  CHECK(worst <= 1e-12);
}

using Residual = void (*)(const ElementProperties<double>&, const Vector6<double>&,
                          Vector6<double>&) noexcept;
constexpr Residual von_karman_residuals[] = {&Full::residual<double>, &Reduced::residual<double>,
                                             &Assumed::residual<double>};

/// A rotation by phi of an element on the x axis about node 1, as a rigid body moves.
Vector6<double> rotated(double phi, double length) {
  Vector6<double> d;
  d << 0, 0, std::sin(phi), (std::cos(phi) - 1) * length, -std::sin(phi) * length, std::sin(phi);
  return d;
}

}  // namespace

TEST_CASE("assumed strain: the energy is that of the exact mean of u' + w'²/2", "[element]") {
  check_energy<Assumed>([](const auto& p, const auto& d) {
    return squared(integral(three, p, d, [](double e) { return e; }));
  });
}

TEST_CASE("reduced integration: the energy is that of the strain in the middle", "[element]") {
  check_energy<Reduced>([](const auto& p, const auto& d) { return integral(one, p, d, squared); });
}

TEST_CASE("full integration: the energy is the two-point integral of the squared strain", "[element]") {
  check_energy<Full>([](const auto& p, const auto& d) { return integral(two, p, d, squared); });
}

TEST_CASE("linear: the energy knows no product of slopes", "[element]") {
  check_energy<Linear>([](const auto& p, const auto& d) { return squared((d[3] - d[0]) / p.length); });
}

TEST_CASE("a small rigid rotation, w = -phi x, does not bend any element and does not strain the linear one",
          "[element]") {
  const ElementProperties<double> p(0.5, 1e6, 1e2);
  const double phi = 0.25;
  Vector6<double> d, r;
  d << 0, 0, phi, 0, -phi * p.length, phi;
  Linear::residual(p, d, r);
  CHECK(r.norm() == 0);
  // With the shortening that von Kármán's strain asks for, -phi²/2, neither does it strain the others.
  d[3] = -phi * phi / 2 * p.length;
  for (const Residual residual : von_karman_residuals) {
    residual(p, d, r);
    CHECK(r.norm() <= 16 * 2.2e-16 * p.axial_stiffness * phi * phi);
  }
}

// cos phi - 1 + sin² phi / 2 = -(1 - cos phi)² / 2: the error of moderate rotation, -phi⁴/8 for small phi.
TEST_CASE("a true rigid rotation strains a von Kármán element by -(1 - cos phi)² / 2", "[element]") {
  const ElementProperties<double> p(0.5, 1e6, 1e2);
  for (const double phi : {0.01, 0.1, 0.3, -0.3, 1.0}) {
    const Vector6<double> d = rotated(phi, p.length);
    const double expected = -squared(1 - std::cos(phi)) / 2 * p.axial_stiffness;
    Vector6<double> r;
    for (const Residual residual : von_karman_residuals) {
      residual(p, d, r);
      CHECK(std::abs(r[3] - expected) <= 4 * 2.2e-16 * p.axial_stiffness);
    }
    Linear::residual(p, d, r);
    CHECK(std::abs(r[3] - (std::cos(phi) - 1) * p.axial_stiffness) <= 4 * 2.2e-16 * p.axial_stiffness);
  }
}
