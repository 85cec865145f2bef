// The laws of an element of any rotation: its states are turned by up to four turns, and shifted.
//
// Energies are no polynomials here.  With steps of 1e-3 of a radian and of the length the five-point rule leaves
// 1e-12/30 of the fifth derivative, EA 5! over the chord's fourth power, which is down to 0.6 of the length: 3e-11 of EA;
// and round-off of eps over the step, 1e-12.
#include <array>
#include <limits>

#include "element/elements.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include <hapbeam/element/pack.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double eps = 2.2e-16;
constexpr double four_turns = 8 * pi;

Vector6<double> shifted(Vector6<double> d, double u, double w) {
  d[0] += u, d[3] += u;
  d[1] += w, d[4] += w;
  return d;
}

/// Displacements in units in which a force times its displacement is a work.
Vector6<double> units(double length) {
  Vector6<double> scale;
  scale << length, length, 1, length, length, 1;
  return scale;
}

template <class Element>
Vector6<double> residual(const ElementProperties<double>& p, const Vector6<double>& d) {
  Vector6<double> r;
  Element::residual(p, d, r);
  return r;
}

/// A naturally bent element, too.
ElementProperties<double> random_bent(Random& random) {
  ElementProperties<double> p = random_properties(random);
  p.natural_a = random(0.2) * p.length;
  p.natural_b = random(0.2) * p.length;
  p.natural_stretch = random(0.02) * p.length;
  return p;
}

}  // namespace

TEMPLATE_TEST_CASE("any rotation: the residual is the gradient of the energy", "[element][rotation]",
                   TurningLinear, TurningFull, TurningReduced, Turning) {
  Random random(61);
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p = random_bent(random);
    const Vector6<double> d = turned(random(four_turns), random_state(random, p.length), p.length),
                          scale = units(p.length), r = residual<TestType>(p, d);
    Vector6<double> expected;
    for (int i = 0; i < 6; ++i)
      expected[i] = derivative([&](const auto& x) { return TestType::energy(p, x); }, d, i, 1e-3 * scale[i]);
    worst = std::max(worst, scale.cwiseProduct(r - expected).norm() / (p.axial_stiffness * p.length));
  }
  INFO("largest difference over EA " << worst);
  CHECK(worst <= 1e-10);
}

TEMPLATE_TEST_CASE("any rotation: the tangent is the gradient of the residual, and symmetric",
                   "[element][rotation]", TurningLinear, TurningFull, TurningReduced, Turning) {
  Random random(62);
  double worst = 0, asymmetry = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p = random_bent(random);
    const Vector6<double> d = turned(random(four_turns), random_state(random, p.length), p.length),
                          scale = units(p.length);
    Vector6<double> r;
    Matrix6<double> K, expected;
    const double energy = TestType::tangent(p, d, r, K);
    REQUIRE((r - residual<TestType>(p, d)).norm() == 0);
    REQUIRE(energy == TestType::energy(p, d));
    for (int i = 0; i < 6; ++i)
      expected.col(i) =
          derivative([&](const auto& x) { return residual<TestType>(p, x); }, d, i, 1e-3 * scale[i]);
    const Matrix6<double> work = scale.asDiagonal() * K * scale.asDiagonal();
    const Matrix6<double> difference = scale.asDiagonal() * (K - expected) * scale.asDiagonal();
    worst = std::max(worst, difference.norm() / work.norm());
    asymmetry = std::max(asymmetry, (work - work.transpose()).norm() / work.norm());
  }
  INFO("largest relative difference " << worst << ", asymmetry " << asymmetry);
  CHECK(worst <= 1e-9);
  CHECK(asymmetry <= 4 * eps);
}

// Turning rounds each displacement to eps of the length, and θ and the chord's angle to eps of four turns: 25 eps.  What
// that strains is 100 eps of EA, and of the moments it turns; states are strained by about 5 %.
TEMPLATE_TEST_CASE("objective: turned and shifted, the energy stays and the forces turn along",
                   "[element][rotation]", TurningLinear, TurningFull, TurningReduced, Turning) {
  Random random(63);
  double worst = 0, worst_energy = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p = random_bent(random);
    const Vector6<double> d = random_state(random, p.length);
    const double phi = random(four_turns), c = std::cos(phi), s = std::sin(phi), u = random(p.length);
    const Vector6<double> moved = shifted(turned(phi, d, p.length), u, -u);
    Vector6<double> expected = residual<TestType>(p, d);
    for (const int node : {0, 3}) {
      const double along = expected[node], across = expected[node + 1];
      expected[node] = c * along + s * across;
      expected[node + 1] = c * across - s * along;
    }
    const Vector6<double> scale = units(p.length);
    const double size = scale.cwiseProduct(expected).norm() + 1e-2 * p.axial_stiffness * p.length;
    worst = std::max(worst, scale.cwiseProduct(residual<TestType>(p, moved) - expected).norm() / size);
    const double energy = TestType::energy(p, d);
    worst_energy = std::max(worst_energy, std::abs(TestType::energy(p, moved) - energy) /
                                              (energy + 1e-4 * p.axial_stiffness * p.length));
  }
  INFO("forces off by " << worst << ", energies by " << worst_energy);
  CHECK(worst <= 1e-12);
  CHECK(worst_energy <= 1e-12);
}

/// Forces of a rigid rotation by phi, over what round-off makes of it: displacements of up to twice the length are
/// rounded to 2 eps l, four of them to a strain of 8 eps; angles to eps (|phi| + π), of θ and of the chord.
template <class Element, typename Scalar>
double force_of_turning(const ElementProperties<double>& properties, double phi) {
  const double EI = properties.bending_per_length3 * std::pow(properties.length, 3);
  const ElementProperties<Scalar> p(static_cast<Scalar>(properties.length),
                                    static_cast<Scalar>(properties.axial_stiffness), static_cast<Scalar>(EI));
  const double l = static_cast<double>(p.length), rounded = static_cast<double>(static_cast<Scalar>(phi));
  const Vector6<Scalar> d = turned(rounded, Vector6<double>::Zero(), l).template cast<Scalar>();
  Vector6<Scalar> r;
  Element::residual(p, d, r);
  const double unit = std::numeric_limits<Scalar>::epsilon();
  const double axial = 8 * unit * properties.axial_stiffness, bending = 2 * unit * (std::abs(phi) + pi) * EI;
  const Vector6<double> force = r.template cast<double>();
  double worst = 0;
  for (const int node : {0, 3}) {
    worst = std::max(worst, force.template segment<2>(node).norm() / (axial + 12 * bending / (l * l)));
    worst = std::max(worst, std::abs(force[node + 2]) / (axial * unit * l + 6 * bending / l));
  }
  return worst;
}

TEMPLATE_TEST_CASE("a rigid rotation by any angle, ten turns included, takes no force", "[element][rotation]",
                   TurningLinear, TurningFull, TurningReduced, Turning) {
  Random random(64);
  double worst = 0, worst_float = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    // Quarters of a turn, small angles, where the chord's angle is found another way, and any.
    const double phi = trial < 81 ? (trial - 40) * pi / 2 : trial < 500 ? random(0.3) : random(20 * pi);
    worst = std::max(worst, force_of_turning<TestType, double>(p, phi));
    worst_float = std::max(worst_float, force_of_turning<TestType, float>(p, phi));
  }
  INFO("forces over their round-off: " << worst << ", in float " << worst_float);
  CHECK(worst <= 1);
  CHECK(worst_float <= 1);
}

// Each end may turn by up to half a turn against the chord, whatever the chord has turned by: there the energy is the
// local element's, which sees no rise.  Angles are rounded to eps of 4 turns.  Assumed sees that the chord is drawn: dynamics/modes.
TEMPLATE_TEST_CASE(
    "seen from its chord the turning element is its local element, up to half a turn at either end",
    "[element][rotation]", Linear, Full, Reduced) {
  Random random(67);
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    Vector6<double> d = Vector6<double>::Zero();
    d[2] = random(3.1);
    d[3] = random(0.05) * p.length;
    d[5] = random(3.1);
    const double energy = TestType::energy(p, d),
                 seen = Corotational<TestType>::energy(p, turned(random(four_turns), d, p.length));
    worst = std::max(worst, std::abs(seen - energy) / (energy + 1e-4 * p.axial_stiffness * p.length));
  }
  INFO("energies off by " << worst);
  CHECK(worst <= 1e-12);
}

// A chord's length less the element's has lost what a small strain is made of; nothing but the strain's own eps may go.
TEMPLATE_TEST_CASE("a strain of 1e-10 keeps its digits", "[element][rotation]", TurningLinear, TurningFull,
                   TurningReduced, Turning) {
  const ElementProperties<double> p(0.7, 1e6, 10);
  Vector6<double> d = Vector6<double>::Zero();
  d[3] = 1e-10 * p.length;
  CHECK(std::abs(residual<TestType>(p, d)[3] - 1e-4) <= 8 * eps * 1e-4);
}

// Invariance under rotation, said as forces: they balance about any point of the deformed element.
TEMPLATE_TEST_CASE("any rotation: forces and moments are in balance on the deformed element",
                   "[element][rotation]", TurningLinear, TurningFull, TurningReduced, Turning) {
  Random random(65);
  for (int trial = 0; trial < 500; ++trial) {
    const ElementProperties<double> p = random_bent(random);
    const Vector6<double> d = turned(random(four_turns), random_state(random, p.length), p.length),
                          r = residual<TestType>(p, d);
    REQUIRE(r[0] + r[3] == 0);
    REQUIRE(r[1] + r[4] == 0);
    const double x = p.length + d[3] - d[0], y = d[4] - d[1];
    const double moment = r[4] * x - r[3] * y - r[2] - r[5];
    const double scale = std::abs(r[4] * x) + std::abs(r[3] * y) + std::abs(r[2]) + std::abs(r[5]);
    REQUIRE(std::abs(moment) <= 32 * eps * scale);
  }
}

// With slopes of δ and axial displacements of δ² both energies are of the order EA δ⁴ + EI δ², and differ by relative δ²:
// the chord is l (1 + ½δ² - ⅛δ⁴) long and its angle δ - ⅓δ³.
TEST_CASE("small rotations: the energy is that of von Kármán's element, to the square of the slope",
          "[element][rotation]") {
  const auto difference = [](double size) {
    Random random(66);
    double worst = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const ElementProperties<double> p = random_properties(random);
      Vector6<double> d = random_state(random, p.length);
      const double stretch = d[3] - d[0];
      d *= size;
      d[3] = d[0] + size * size * stretch;
      worst = std::max(worst, relative_error(Turning::energy(p, d), Assumed::energy(p, d)));
    }
    return worst;
  };
  const double large = difference(0.2), small = difference(0.1);
  INFO("relative differences " << large << ' ' << small);
  CHECK(large <= 0.2 * 0.2);
  CHECK(observed_order(large, small) >= 1.8);
}

namespace {

/// In units of EA and of the length 1.
template <typename S>
std::array<S, 15> numbers(const CoreResponse<S>& c, const S& force, const S& length) {
  const S energy = 1 / (force * length), stiffness = length / force;
  std::array<S, 15> all{c.energy, c.s,    c.r,    c.t1,   c.t2,    c.k.ss,  c.k.sr, c.k.s1,
                        c.k.s2,   c.k.rr, c.k.r1, c.k.r2, c.k.t11, c.k.t12, c.k.t22};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] *= i == 0 ? energy : i < 5 ? 1 / force : stiffness;
  return all;
}

}  // namespace

TEMPLATE_TEST_CASE("elements side by side answer as each of them alone", "[element][rotation]", double,
                   float) {
  using Wide = detail::Pack<TestType>;
  using Narrow = ElementProperties<TestType>;
  using Properties = ElementProperties<Wide>;
  Random random(67);
  double worst = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Narrow alone[Wide::size];
    Vector6<TestType> states[Wide::size];
    Properties p;
    Vector6<Wide> d = Vector6<Wide>::Zero();
    // In every other trial all angles are small; else each lane takes its own way.
    const double turn = trial % 2 == 0 ? 0.5 : four_turns;
    for (int k = 0; k < Wide::size; ++k) {
      const ElementProperties<double> q = random_bent(random);
      const double phi = random(turn);
      states[k] = turned(phi, random_state(random, q.length), q.length).template cast<TestType>();
      const auto put = [&](auto narrow, auto wide, double value) {
        alone[k].*narrow = static_cast<TestType>(value);
        (p.*wide).set(k, alone[k].*narrow);
      };
      put(&Narrow::length, &Properties::length, q.length);
      put(&Narrow::inverse_length, &Properties::inverse_length, q.inverse_length);
      put(&Narrow::axial_stiffness, &Properties::axial_stiffness, q.axial_stiffness);
      put(&Narrow::axial_per_length, &Properties::axial_per_length, q.axial_per_length);
      put(&Narrow::bending_per_length3, &Properties::bending_per_length3, q.bending_per_length3);
      put(&Narrow::natural_a, &Properties::natural_a, q.natural_a);
      put(&Narrow::natural_b, &Properties::natural_b, q.natural_b);
      put(&Narrow::natural_stretch, &Properties::natural_stretch, q.natural_stretch);
      for (int i = 0; i < 6; ++i) d[i].set(k, states[k][i]);
    }
    const auto abreast = numbers(Turning::core(p, d), p.axial_stiffness, p.length);
    for (int k = 0; k < Wide::size; ++k) {
      const auto one = numbers(Turning::core(alone[k], states[k]), alone[k].axial_stiffness, alone[k].length);
      for (std::size_t i = 0; i < one.size(); ++i)
        worst = std::max(worst, static_cast<double>(std::abs(abreast[i][k] - one[i])));
    }
  }
  // A few operations of round-off on angles of up to four turns, 25 rad.
  CHECK(worst < 100 * static_cast<double>(std::numeric_limits<TestType>::epsilon()));
}

TEST_CASE("an element of one's own that changes a turning one is not computed side by side",
          "[element][rotation]") {
  struct Own : Turning {};
  STATIC_REQUIRE(goes_abreast<Turning>);
  STATIC_REQUIRE(goes_abreast<Several<Turning, 2>>);
  STATIC_REQUIRE_FALSE(goes_abreast<Own>);
  STATIC_REQUIRE_FALSE(goes_abreast<Several<Own, 2>>);
  STATIC_REQUIRE_FALSE(goes_abreast<TurningLinear>);
}
