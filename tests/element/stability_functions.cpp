// The element that is exact under its own tension: its functions, its energy, and what it is the limit of.
#include <limits>
#include <vector>

#include "element/elements.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include <hapbeam/element/tensioned_curve.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Exact = VonKarman<StabilityFunctions>;

/// A(q) as textbooks write it.
long double textbook_A(long double q) {
  const long double z = std::sqrt(std::abs(q));
  return q > 0 ? z / std::tanh(z / 2) : z / std::tan(z / 2);
}
long double textbook_B(long double q) { return q / (textbook_A(q) - 2); }

/// First and second differences, of fourth order.
template <class F>
long double slope(F&& f, long double x, long double h) {
  return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
}

/// States of elements under tension and compression down to -12 EI/l², which bend by what they stretch.
template <class Use>
void each_state(int seed, Use&& use) {
  Random random(static_cast<unsigned>(seed));
  for (int trial = 0; trial < 300; ++trial) {
    const ElementProperties<double> p = random_properties(random);
    const double q = trial % 3 == 0 ? random(-12.0, 0.0) : std::pow(10, random(-3, 4));
    const double slope =
        std::sqrt(p.bending_per_length3 * p.length / p.axial_stiffness);  // of a radius of gyration
    Vector6<double> d;
    d << random(0.1) * p.length, random(0.1) * p.length, random(3.0) * slope, 0, 0, random(3.0) * slope;
    d[4] = d[1] + random(3.0) * slope * p.length;
    const double wanted = q * p.bending_per_length3 * p.length / p.axial_per_length;
    d[3] = d[0] + wanted - (d[4] - d[1]) * (d[4] - d[1]) / (2 * p.length);
    use(p, d);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("the functions are those of textbooks, in tension, compression and none",
                   "[element][float]", double, float) {
  const TestType eps = std::numeric_limits<TestType>::epsilon();
  const auto error = [eps](TestType value, long double exact) {
    return static_cast<double>(std::abs(static_cast<long double>(value) / exact - 1) / eps);
  };
  for (const double at : {-15.0, -9.0, -3.0, -0.5, 0.3, 1.0, 4.0, 9.0, 15.9, 16.1, 40.0, 300.0, 1e4, 1e6}) {
    const TestType q = static_cast<TestType>(at);
    const auto k = detail::tension_stiffness(q);
    const long double x = q, h = 1e-3L * (1 + std::abs(x));
    CAPTURE(at);
    CHECK(error(k.A(), textbook_A(x)) <= 4);
    CHECK(error(k.B(), textbook_B(x)) <= 4);
    // The difference's error is h⁴, 1e-12 of a function that changes over its own argument.
    CHECK(error(k.a1, slope(textbook_A, x, h)) <= 16 + 1e-11 / eps);
    CHECK(error(k.b1, slope(textbook_B, x, h)) <= 16 + 1e-10 / eps);
  }
  const auto none = detail::tension_stiffness(TestType(0));
  CHECK(none.A() == 2);
  CHECK(none.B() == 6);
  CHECK(error(none.a1, 1.0L / 6) <= 2);
  CHECK(error(none.b1, 1.0L / 10) <= 2);
  CHECK(error(none.a2, -1.0L / 180) <= 4);
  CHECK(error(none.b2, -1.0L / 700) <= 8);
}

TEST_CASE("second derivatives of the functions are those of their first", "[element]") {
  for (const double q : {-100.0, -17.0, -15.0, -2.0, 0.0, 1.0, 10.0, 15.0, 17.0, 100.0, 1e5}) {
    const auto a1 = [](long double x) -> long double { return detail::tension_stiffness(x).a1; };
    const auto b1 = [](long double x) -> long double { return detail::tension_stiffness(x).b1; };
    const auto k = detail::tension_stiffness(q);
    const long double h = 1e-3L * (1 + std::abs(static_cast<long double>(q)));
    CAPTURE(q);
    if (std::abs(std::abs(q) - 16) > 4 * h) {
      CHECK(relative_error(k.a2, static_cast<double>(slope(a1, q, h))) <= 1e-9);
      CHECK(relative_error(k.b2, static_cast<double>(slope(b1, q, h))) <= 1e-9);
    }
  }
}

// Steps of a thousandth leave 1e-12 of a function that is smooth over the state, and eps over the step of round-off.
TEST_CASE("residual and tangent of the exact element are the derivatives of its energy", "[element]") {
  double worst_residual = 0, worst_tangent = 0, asymmetry = 0;
  each_state(51, [&](const ElementProperties<double>& p, const Vector6<double>& d) {
    Vector6<double> r, expected, scale;
    Matrix6<double> K, differences;
    const double energy = Exact::tangent(p, d, r, K);
    REQUIRE(energy == Exact::energy(p, d));
    const double slope = std::sqrt(p.bending_per_length3 * p.length / p.axial_stiffness);
    for (int i = 0; i < 6; ++i) {
      scale[i] = slope * (i % 3 == 0 ? slope * p.length : i % 3 == 1 ? p.length : 1);
      const auto forces = [&](const Vector6<double>& x) {
        Vector6<double> f;
        Exact::residual(p, x, f);
        return f;
      };
      expected[i] =
          derivative([&](const Vector6<double>& x) { return Exact::energy(p, x); }, d, i, 0.01 * scale[i]);
      differences.col(i) = derivative(forces, d, i, 0.01 * scale[i]);
    }
    const Vector6<double> work = r.cwiseProduct(scale), want = expected.cwiseProduct(scale);
    const Matrix6<double> stiff = scale.asDiagonal() * K * scale.asDiagonal();
    worst_residual = std::max(worst_residual, (work - want).norm() / work.norm());
    worst_tangent = std::max(
        worst_tangent, (scale.asDiagonal() * (K - differences) * scale.asDiagonal()).norm() / stiff.norm());
    asymmetry = std::max(asymmetry, (stiff - stiff.transpose()).norm() / stiff.norm());
  });
  INFO(worst_residual << " " << worst_tangent << " " << asymmetry);
  CHECK(worst_residual <= 1e-8);
  CHECK(worst_tangent <= 1e-8);
  CHECK(asymmetry <= 4 * 2.2e-16);
}

// Of Π, which is what is left of the energy without what is missing.
TEMPLATE_TEST_CASE("what an element answers with its tension as an unknown are the derivatives of one energy",
                   "[element]", Exact, Corotational<>) {
  double worst_tension = 0, worst_residual = 0, worst_row = 0, worst_stiffness = 0, worst_energy = 0;
  Random random(57);
  each_state(58, [&](const ElementProperties<double>& p, const Vector6<double>& d) {
    const auto of = [&](const Vector6<double>& x, double normal, OwnTension<double>& tension) {
      tension.normal = normal;
      return TestType::core(p, x, tension);
    };
    const auto residual = [&](const CoreResponse<double>& c) {
      Vector6<double> r;
      detail::expand(p, c.s, c.r, c.t1, c.t2, r);
      return r;
    };
    const auto free = [&](const Vector6<double>& x, double normal) {
      OwnTension<double> tension;
      const double energy = of(x, normal, tension).energy;
      return energy - tension.missing * tension.lack / 2;
    };
    const auto lack = [&](const Vector6<double>& x, double normal) {
      OwnTension<double> tension;
      (void)of(x, normal, tension);
      return tension.lack;
    };
    const double unit = p.bending_per_length3 * p.length, l = p.length;
    OwnTension<double> tension;
    // From half to twice what the nodes say, and as much as bends the element.
    of(d, 0, tension);
    double balance = 0;
    for (int k = 0; k < 40; ++k) (void)of(d, balance, tension), balance += tension.missing;
    const double normal = balance * (1.25 + random(0.75)) + random(1.0) * unit,
                 h = 1e-3 * (unit + std::abs(normal));
    const CoreResponse<double> core = of(d, normal, tension);
    const auto by_tension = [&](auto&& f) {
      return (8 * (f(normal + h) - f(normal - h)) - (f(normal + 2 * h) - f(normal - 2 * h))) / (12 * h);
    };
    const double slope = by_tension([&](double n) { return free(d, n); }),
                 stiffness = by_tension([&](double n) { return lack(d, n); });
    const double work = std::abs(tension.lack) + std::abs(normal) * l / p.axial_stiffness;
    worst_tension = std::max(worst_tension, std::abs(slope - tension.lack) / work);
    worst_stiffness = std::max(worst_stiffness, relative_error(tension.missing, -tension.lack / stiffness));
    const double thin = std::sqrt(unit / p.axial_per_length);
    Vector6<double> want, row, expected, scale;
    for (int i = 0; i < 6; ++i) {
      scale[i] = thin * (i % 3 == 0 ? thin * l : i % 3 == 1 ? l : 1);
      want[i] = derivative([&](const Vector6<double>& x) { return free(x, normal); }, d, i, 0.01 * scale[i]);
      expected[i] =
          derivative([&](const Vector6<double>& x) { return lack(x, normal); }, d, i, 0.01 * scale[i]);
    }
    detail::expand(p, tension.s, tension.r, tension.t1, tension.t2, row);
    const double follow = -1 / stiffness;
    const Vector6<double> condensed = want + tension.missing * expected;
    worst_residual =
        std::max(worst_residual, scale.cwiseProduct(residual(core) - condensed).norm() /
                                     (scale.cwiseProduct(want).norm() +
                                      std::abs(tension.missing) * scale.cwiseProduct(expected).norm()));
    worst_row = std::max(worst_row, scale.cwiseProduct(row - follow * expected).norm() /
                                        (follow * scale.cwiseProduct(expected).norm()));
    // Where N is nearly in balance, V is that of the nodes.
    const double near = balance + 1e-3 * (unit + std::abs(balance));
    worst_energy =
        std::max(worst_energy, relative_error(of(d, near, tension).energy, TestType::energy(p, d)));
  });
  INFO(worst_tension << " " << worst_stiffness << " " << worst_residual << " " << worst_row << " "
                     << worst_energy);
  CHECK(worst_tension <= 1e-8);
  CHECK(worst_stiffness <= 1e-8);
  CHECK(worst_residual <= 1e-7);
  CHECK(worst_row <= 1e-7);
  CHECK(worst_energy <= 1e-8);
}

// N l/EA = e + ½ by how much the bending makes the piece longer, which the curve says by itself.
TEST_CASE("an element's tension is that of its curve, and its moments bend it", "[element]") {
  each_state(52, [&](const ElementProperties<double>& p, const Vector6<double>& d) {
    Vector6<double> r;
    Exact::residual(p, d, r);
    const Deformation<double> e(p, d);
    const double l = p.length, unit = p.bending_per_length3 * l, q = r[3] / unit;
    if (q < 0) return;
    const detail::TensionedCurve<double> curve(q, e.rise, (e.a - e.b) / 2, (e.a + e.b) / 2);
    CAPTURE(q);
    CHECK(std::abs(r[3] / p.axial_per_length - (e.stretch + curve.end().square / (2 * l))) <=
          1e-12 * std::abs(r[3] / p.axial_per_length) + 1e-13 * std::abs(e.stretch));
    const double scale = std::abs(r[2]) + std::abs(r[5]);
    CHECK(std::abs(r[2] - unit * curve.at(0).bend) <= 1e-11 * scale);
    CHECK(std::abs(r[5] + unit * curve.end().bend) <= 1e-11 * scale);
  });
}

// Half of an element of half the length, to either side of a free node.
TEST_CASE("two exact elements with a free node between them are one", "[element]") {
  each_state(53, [&](const ElementProperties<double>& p, const Vector6<double>& d) {
    Vector6<double> r, left, right;
    Exact::residual(p, d, r);
    const Deformation<double> e(p, d);
    const double q = r[3] / (p.bending_per_length3 * p.length);
    if (q < 0) return;
    const detail::TensionedCurve<double> curve(q, e.rise, (e.a - e.b) / 2, (e.a + e.b) / 2);
    const auto half = curve.middle();
    const double EI = p.bending_per_length3 * p.length * p.length * p.length, l = p.length;
    const double u = d[0] + r[3] / p.axial_stiffness * l / 2 - half.square / (2 * l), w = d[1] + half.rise,
                 theta = -half.slope / l;
    const ElementProperties<double> part(l / 2, p.axial_stiffness, EI);
    Exact::residual(part, Vector6<double>(d[0], d[1], d[2], u, w, theta), left);
    Exact::residual(part, Vector6<double>(u, w, theta, d[3], d[4], d[5]), right);
    CAPTURE(q);
    const double scale = r.cwiseAbs().maxCoeff();
    CHECK((left.head<3>() - r.head<3>()).norm() <= 1e-9 * scale);
    CHECK((right.tail<3>() - r.tail<3>()).norm() <= 1e-9 * scale);
    CHECK((left.tail<3>() + right.head<3>()).norm() <= 1e-9 * scale);
  });
}

TEST_CASE("under little tension the exact element is that of assumed strain, to a twentieth of q",
          "[element]") {
  Random random(54);
  for (const double size : {1e-2, 1e-3, 1e-4}) {
    const ElementProperties<double> p(1, 1e4, 1);
    Vector6<double> d, exact, assumed;
    d << 0, 0, random(1.0), 0, random(1.0), random(1.0);
    d *= size;
    Exact::residual(p, d, exact);
    Assumed::residual(p, d, assumed);
    const double q = std::abs(exact[3]);  // EI/l² is 1
    CHECK((exact - assumed).norm() <= q / 20 * exact.norm());
  }
}

TEST_CASE("in float the exact element answers as in double, to round-off", "[element][float]") {
  each_state(55, [&](const ElementProperties<double>& p, const Vector6<double>& d) {
    const ElementProperties<float> narrow(
        static_cast<float>(p.length), static_cast<float>(p.axial_stiffness),
        static_cast<float>(p.bending_per_length3 * p.length * p.length * p.length));
    const ElementProperties<double> wide(
        narrow.length, narrow.axial_stiffness,
        double(narrow.bending_per_length3) * narrow.length * narrow.length * narrow.length);
    const Vector6<float> state = d.cast<float>();
    Vector6<float> r;
    Vector6<double> want;
    Exact::residual(narrow, state, r);
    Exact::residual(wide, Vector6<double>(state.cast<double>()), want);
    // Displacements that are as large as the element lose what the chord takes off.
    const double lost = 1e-7 * (std::abs(d[3]) + std::abs(d[0])) * p.axial_per_length;
    CHECK((r.cast<double>() - want).norm() <= 1e-4 * want.norm() + 20 * lost);
  });
}

TEST_CASE("elements that are computed side by side answer as one alone", "[element]") {
  using Wide = detail::Pack<double>;
  std::vector<ElementProperties<double>> properties;
  std::vector<Vector6<double>> states;
  each_state(56, [&](const ElementProperties<double>& p, const Vector6<double>& d) {
    properties.push_back(p);
    states.push_back(d);
  });
  for (std::size_t first = 0; first + Wide::size <= states.size(); first += Wide::size) {
    const auto of = [&](auto&& number) {
      return Wide::of([&](int k) { return number(first + static_cast<std::size_t>(k)); });
    };
    ElementProperties<Wide> p;
    p.length = of([&](std::size_t i) { return properties[i].length; });
    p.inverse_length = of([&](std::size_t i) { return properties[i].inverse_length; });
    p.axial_stiffness = of([&](std::size_t i) { return properties[i].axial_stiffness; });
    p.axial_per_length = of([&](std::size_t i) { return properties[i].axial_per_length; });
    p.bending_per_length3 = of([&](std::size_t i) { return properties[i].bending_per_length3; });
    p.natural_a = p.natural_b = 0;
    Vector6<Wide> d;
    for (int k = 0; k < 6; ++k) d[k] = of([&](std::size_t i) { return states[i][k]; });
    const auto core = Exact::core(p, d);
    for (int k = 0; k < Wide::size; ++k) {
      const auto alone = Exact::core(properties[first + static_cast<std::size_t>(k)],
                                     states[first + static_cast<std::size_t>(k)]);
      CHECK(relative_error(core.s[k], alone.s) <= 1e-12);
      CHECK(relative_error(core.t1[k], alone.t1) <= 1e-9);
      CHECK(relative_error(core.k.rr[k], alone.k.rr) <= 1e-9);
      CHECK(relative_error(core.energy[k], alone.energy) <= 1e-9);
    }
  }
}
