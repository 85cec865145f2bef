// Beams whose ends are held elsewhere than in the straight beam: inclined, stretched, shortened, bent round.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = 1, EI = 1;
using Turning = FemModel<Corotational<>>;

/// Where the ends of a beam go that is turned by phi about its left end, clockwise as θ is.
Beam& incline(Beam& beam, double phi) {
  return beam.place({0, 0, phi}, {-2 * L * std::pow(std::sin(phi / 2), 2), -L * std::sin(phi), phi});
}

/// A point load that is turned along.
PointLoad inclined(const PointLoad& load, double phi) {
  const double c = std::cos(phi), s = std::sin(phi);
  return {load.s, c * load.axial + s * load.transverse, c * load.transverse - s * load.axial, load.moment};
}

/// Largest distance of the nodes of one shape from those of the other, which is turned by phi.  Between hinges nobody
/// counts whole turns.
double distance(const Centreline<double>& one, const Centreline<double>& turned, double phi) {
  const double c = std::cos(phi), s = std::sin(phi);
  double worst = 0;
  for (int i = 0; i < one.size(); ++i) {
    const double x = one[i].s + one[i].u, y = one[i].w;
    worst = std::max({worst, std::abs(c * x + s * y - turned[i].s - turned[i].u),
                      std::abs(c * y - s * x - turned[i].w),
                      std::abs(std::remainder(one[i].theta + phi - turned[i].theta, 2 * pi))});
  }
  return worst;
}

/// Force that moves the middle of a hinged beam under tension N by 1: w = F L/4N (1 - tanh λ/λ), λ = L/2 √(N/EI); under
/// compression tan.  Source: Timoshenko and Gere, Theory of Elastic Stability, 1.2 and 1.11.
double midspan_stiffness(double N) {
  const double a = std::abs(N), lambda = L / 2 * std::sqrt(a / EI);
  return 4 * a / L / (N > 0 ? 1 - std::tanh(lambda) / lambda : std::tan(lambda) / lambda - 1);
}

}  // namespace

// Round-off of the positions, eps, strains by as much; what EA eps does across a bent beam is EA eps L²/EI = 2e-12 of its
// length and a tenth of that for its bend.
TEST_CASE("an inclined beam under loads that are turned along answers as the horizontal one", "[placed]") {
  for (const auto& [left, right] :
       {std::pair{Support::clamped, Support::free}, std::pair{Support::pinned, Support::pinned},
        std::pair{Support::clamped, Support::pinned}})
    for (const double phi : {0.3, -1.2, 2.5, pi, 7.0, -20.0}) {
      Beam level(L, 1e4, EI, 0.01, left, right), slope = level;
      const PointLoad load{0.625 * L, 0.5, -2, 0.3}, other{0.5 * L, 0, 5, 0};
      level.add(load).add(other);
      incline(slope, phi).add(inclined(load, phi)).add(inclined(other, phi));
      const Turning one(level, 8, patient_solver()), turned(slope, 8, patient_solver());
      REQUIRE(one.rest().status == Status::ok);
      REQUIRE(turned.rest().status == Status::ok);
      const double off = distance(one.shape(), turned.shape(), phi);
      CAPTURE(name(left), name(right), phi, off, mesh_node(one, 4).w);
      CHECK(off <= 1e-12);
      CHECK(relative_error(turned.strain_energy(), one.strain_energy()) <= 1e-11);
    }
}

TEST_CASE("a uniform load may be inclined, too, and its arms turn along", "[placed]") {
  const double q = 20;
  for (const double phi : {0.3, -1.2, 2.5}) {
    Beam level(L, 1e4, EI, 0.01, Support::clamped, Support::free), slope = level;
    level.transverse(q);
    incline(slope, phi).transverse(q * std::cos(phi)).axial(q * std::sin(phi));
    const Turning one(level, 8, patient_solver()), turned(slope, 8, patient_solver());
    REQUIRE(one.rest().status == Status::ok);
    REQUIRE(turned.rest().status == Status::ok);
    const double off = distance(one.shape(), turned.shape(), phi);
    CAPTURE(phi, off, mesh_node(one, 8).w);
    CHECK(off <= 1e-12);
  }
}

// Displacements are those from the straight beam on the x axis: n·(u, w) of the point at rest comes first.
TEST_CASE("pushed along its own normal an inclined beam takes the force of the horizontal one", "[placed]") {
  for (const double phi : {0.4, -2.0, 3.0})
    for (const double s : {0.23 * L, 0.5 * L}) {
      Beam level(L, 1e4, EI, 0.01, Support::pinned, Support::clamped), slope = level;
      incline(slope, phi);
      Turning one(level, 8, patient_solver()), turned(slope, 8, patient_solver());
      const Vector2<double> normal(std::sin(phi), std::cos(phi));
      const Displacement<double> at = turned.shape().at(s);
      const double rest = normal.x() * at.u + normal.y() * at.w;
      for (const double d : {1e-3, -0.02, 0.05}) {
        const Response<double> expected = one.press({s, d}), response = turned.push({s, rest + d, normal});
        CAPTURE(phi, s, d, expected.force);
        CHECK(expected.status == Status::ok);
        CHECK(response.status == Status::ok);
        CHECK(relative_error(response.force, expected.force) <= 1e-11);
      }
    }
}

// Shortened by far more than Euler's load allows it stands aside, on the upper side as it is turned.  What is left of the
// way to equilibrium is soft, so that round-off is larger by the 1e4 of EA L²/EI.
TEST_CASE("an inclined strip buckles as the level one does, to its own upper side", "[placed]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const double phi : {0.6, -1.1, 2.0}) {
      const double closer = 0.05 * L, c = std::cos(phi), s = std::sin(phi);
      Beam level(L, 1e4, EI, 0.01, end, end), slope = level;
      level.place({}, {-closer, 0, 0});
      slope.place({0, 0, phi}, {c * (L - closer) - L, -s * (L - closer), phi});
      const Turning one(level, 16, patient_solver()), turned(slope, 16, patient_solver());
      REQUIRE(one.rest().status == Status::ok);
      REQUIRE(turned.rest().status == Status::ok);
      const double off = distance(one.shape(), turned.shape(), phi);
      CAPTURE(name(end), phi, off, mesh_node(one, 8).w);
      CHECK(mesh_node(one, 8).w > 0.1 * L);
      CHECK(off <= 1e-10);
    }
}

// F/d = N / (ab/L - sinh ka sinh kb / (k sinh kL)), k² = N/EI, a and b from the hand to the
// hinges; tension makes the beam longer by 1e-5 of itself, which is what the formula leaves out.
TEMPLATE_TEST_CASE("shallow presses of a tensioned beam are met where elements resolve its boundary layer",
                   "[placed]", VonKarman<>, Corotational<>) {
  struct Row {
    double euler_loads, error[4];
    int enough;
  };
  for (const Row& row :
       {Row{1, {3.2e-5, 2e-5, 2e-5, 2e-5}, 4}, Row{10, {1.4e-3, 1.3e-4, 2e-5, 2e-5}, 9},
        Row{100, {0.018, 3.6e-3, 2.6e-4, 2.2e-5}, 27}, Row{1000, {0.048, 0.019, 3.5e-3, 4.8e-4}, 51},
        Row{10000, {0.07, 0.045, 0.015, 4.4e-3}, 112}}) {
    const double N = row.euler_loads * pi * pi * EI, EA = 1e5 * N, k = std::sqrt(N / EI);
    const auto worst = [&](int elements) {
      Beam beam(L, EA, EI, 0.01, Support::pinned, Support::pinned);
      FemModel<TestType> model(tensioned(beam, N), elements);
      double error = 0;
      for (int i = 0; i <= 900; ++i) {
        const double a = 0.05 + 0.001 * i, b = L - a, d = 1e-6;
        const double bent =
            (1 - std::exp(-2 * k * a)) * (1 - std::exp(-2 * k * b)) / (1 - std::exp(-2 * k * L)) / 2;
        const Response<double> response = model.press({a, d});
        REQUIRE(response.status == Status::ok);
        error = std::max(error, relative_error(response.force, d * N / (a * b / L - bent / k)));
      }
      return error;
    };
    for (int j = 0; j < 4; ++j) {
      CAPTURE(row.euler_loads, 8 << j);
      CHECK(worst(8 << j) <= row.error[j]);
    }
    CHECK(worst(row.enough) <= 1e-3);
  }
}

// The ends move while the nodes between them follow: where the strain of all elements together is more than one element is
// long, n δ/L > 1, ends that come after would turn the last element inside out.
TEMPLATE_TEST_CASE("stretched as far as it likes a beam rests straight and even, whatever its mesh",
                   "[placed]", double, float) {
  Random random(11);
  for (int trial = 0; trial < 600; ++trial) {
    const double stretch = 0.002 * std::pow(500, random(0, 1)), height = std::pow(10, random(-3, -1));
    const int elements = trial == 0   ? 24
                         : trial == 1 ? 48
                                      : static_cast<int>(4 * std::pow(128, random(0, 1)));
    const Support left = random.integer(0, 1) ? Support::pinned : Support::clamped,
                  right = random.integer(0, 1) ? Support::pinned : Support::clamped;
    const Beam beam(L, Section::rectangle(height, height), Material{2e11}, left, right);
    // In float the tangent of many slender elements has no digits left, and the model says so.
    if (std::is_same_v<TestType, float> && elements > 32) continue;
    const FemModel<Corotational<>, TestType> model(stretched(beam, stretch), elements);
    CAPTURE(stretch, height, elements, name(left), name(right));
    REQUIRE(model.rest().status == Status::ok);
    CHECK(model.rest().solves <= 4);
    const double round_off = 16 * static_cast<double>(std::numeric_limits<TestType>::epsilon());
    double off = 0;
    for (const auto& node : mesh_nodes(model))
      off = std::max({off, std::abs(node.u - stretch * static_cast<double>(node.s)),
                      std::abs(static_cast<double>(node.w)), std::abs(static_cast<double>(node.theta))});
    CHECK(off <= round_off * (1 + elements * stretch));
  }
}

// A plain steel string of a guitar, the low e' of 0.27 mm: 84 N of tension, 0.7 % of strain.
TEST_CASE("a guitar string finds its rest with any number of elements, and is pressed", "[placed]") {
  for (const double scale : {0.3, 0.65, 1.0})
    for (const int elements : {8, 64, 256, 512}) {
      const Beam string(scale, Section::circle(0.27e-3), Material{2e11}, Support::pinned, Support::pinned);
      Turning model(tensioned(string, 84), elements);
      CAPTURE(scale, elements);
      CHECK(model.rest().status == Status::ok);
      const Response<double> response = model.press({scale / 2, 1e-3});
      CHECK(response.status == Status::ok);
      // 4 N d/L of a string, and the tension that the press adds, EA 2 (d/L)²; bending adds √(EI/N)/L of
      // itself at the hand, and elements of 100 times that, as 8 are, stretch in the bend that they cannot have.
      const double N = 84 + string.axial_stiffness() * 2e-6 / (scale * scale);
      CHECK(relative_error(response.force, 4 * N * 1e-3 / scale) <= (elements == 8 ? 0.03 : 0.01));
    }
}

TEST_CASE("stretched between its ends a beam has N = EA δ/L and is straight", "[placed]") {
  const double EA = 1e6;
  for (const double stretch : {1e-6, 1e-4, 1e-2, -5e-6})  // the last one short of Euler's load, 10 EI/L²
    for (const Support end : {Support::pinned, Support::clamped}) {
      Beam beam(L, EA, EI, 0.01, end, end);
      const auto energy = [&](double delta) {
        const Turning model(beam.place({}, {delta, 0, 0}), 8, patient_solver());
        REQUIRE(model.rest().status == Status::ok);
        for (const auto& node : mesh_nodes(model)) {
          // Shortened, it comes from the buckled side, to what the solver leaves.
          const double left_over = delta > 0 ? 4 * 2.2e-16 : 1e-12;
          CHECK(std::abs(node.u - delta * node.s / L) <= left_over);
          CHECK(std::abs(node.w) <= left_over);
          CHECK(std::abs(node.theta) <= left_over);
        }
        return model.strain_energy();
      };
      // V is a square: its central difference is N, but for round-off of positions, eps EA/N.
      const double h = stretch / 8, N = (energy(stretch + h) - energy(stretch - h)) / (2 * h);
      CAPTURE(stretch, N);
      CHECK(relative_error(N, EA * stretch / L) <= 1e-9 + 64 * 2.2e-16 / std::abs(stretch));
      CHECK(relative_error(energy(stretch), EA * stretch * stretch / (2 * L)) <=
            64 * 2.2e-16 / std::abs(stretch));
    }
}

// A press by d changes N by EA 2(d/L)², 2e-6 of the smallest N here, and the beam is longer by N/EA <= 1e-4.  64 elements
// are 5 in the boundary layer √(EI/N) of the tightest string: (l √(N/EI))⁴/720 = 1e-5 beside the hand.
TEST_CASE(
    "a tensioned beam is as stiff as its closed form says, from beam to string, and soft under compression",
    "[placed]") {
  const double EA = 1e7, d = 1e-6;
  for (const double N : {-8.0, -3.0, 0.5, 10.0, 100.0, 1000.0}) {
    Beam beam(L, EA, EI, 0.01, Support::pinned, Support::pinned);
    Turning model(beam.place({}, {N * L / EA, 0, 0}), 64, patient_solver());
    const Response<double> response = model.press({L / 2, d});
    const double expected = midspan_stiffness(N);
    CAPTURE(N, response.force / d, expected, 4 * N / L);
    CHECK(response.status == Status::ok);
    CHECK(relative_error(response.force / d, expected) <= 1.5e-4);
    if (N == 1000) CHECK(relative_error(response.force / d, 4 * N / L) <= 0.07);  // 1/λ: nearly a string
  }
}

// Both ends on a circle of angle φ, along it: M = EI φ/L, N = 0.  The elements' energy is off by the fourth power of their
// angle: they bend the same, and are strained by (κl)⁴/1920.
TEST_CASE("a beam whose ends are put onto a circle, along it, becomes the arc", "[placed]") {
  for (const double angle : {0.5, 2.0, -3.0}) {
    double error[3];
    for (int k = 0; k < 3; ++k) {
      const int n = 8 << k;
      const double radius = L / angle, EA = 1e3;
      Beam beam(L, EA, EI, 0.01, Support::clamped, Support::clamped);
      beam.place({}, {radius * std::sin(angle) - L, radius * (std::cos(angle) - 1), angle});
      const Turning model(beam, n, patient_solver());
      REQUIRE(model.rest().status == Status::ok);
      error[k] = relative_error(model.strain_energy(), EI * angle * angle / (2 * L));
      const double strain = std::pow(angle / n, 4) / 1920, x = angle / n;
      CAPTURE(angle, n, error[k]);
      // ½ EA ε² L, and what ε saves in bending, angle times the chord's excess: both below ε.
      CHECK(error[k] <= (EA * L * strain * strain / 2) / (EI * angle * angle / 2) + 2 * strain + 1e-11);
      for (const auto& node : mesh_nodes(model)) {
        const double place = std::hypot(node.s + node.u - radius * std::sin(node.s / radius),
                                        node.w - radius * (std::cos(node.s / radius) - 1));
        CHECK(place <= std::pow(x, 4) / 120 * L + 1e-11);
        CHECK(std::abs(node.theta - node.s / radius) <= std::pow(x, 4) / 120 + 1e-10);
      }
    }
  }
}
