// Naturally bent beams: free of stress between their natural ends, however they are laid, and with the energy of bending
// where they are held straight.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/pi.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/natural_shape.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = 1.5, EA = 1e5, EI = 2;
using Turning = FemModel<Corotational<>>;

/// A beam between the ends of its natural shape, turned by phi about the left one.
Beam arch(const std::vector<Arc>& arcs, Support left, Support right, double phi = 0) {
  Beam beam(L, EA, EI, 0.01, left, right);
  const Displacement<double> end = NaturalShape<double>(beam.naturally(arcs)).at(L);
  const double c = std::cos(phi), s = std::sin(phi), x = L + end.u;
  return beam.place({0, 0, phi}, {c * x + s * end.w - L, c * end.w - s * x, end.theta + phi});
}

/// Largest distance of a model's nodes from its natural shape, turned by phi.
double distance(const Turning& model, const Beam& beam, double phi) {
  const NaturalShape<double> natural(beam);
  const double c = std::cos(phi), s = std::sin(phi);
  double worst = 0;
  for (const auto& node : model.shape()) {
    const Displacement<double> at = natural.at(node.s);
    const double x = node.s + at.u;
    worst = std::max(worst, std::hypot(c * x + s * at.w - node.s - node.u, c * at.w - s * x - node.w));
  }
  return worst;
}

}  // namespace

// On the natural nodes each element is strained by x⁴/120 = (κl)⁴/1920, and by nothing else.  Equilibrium has less energy
// than that, and where an end is free, none.
TEST_CASE("an arch between its natural ends is free of stress, to the fourth power of its elements' angle",
          "[arch]") {
  for (const auto& [left, right] :
       {std::pair{Support::pinned, Support::pinned}, std::pair{Support::clamped, Support::clamped},
        std::pair{Support::clamped, Support::free}, std::pair{Support::free, Support::clamped}})
    for (const double angle : {0.3, -1.5, 3.0, 6.0})
      for (const double phi : {0.0, -angle / 2, 2.5}) {
        double off[3];
        for (int k = 0; k < 3; ++k) {
          const int n = 8 << k;
          const Beam beam = arch({{L, angle / L}}, left, right, phi);
          const Turning model(beam, n, patient_solver());
          REQUIRE(model.rest().status == Status::ok);
          const double strain = std::pow(angle / n, 4) / 1920, energy = EA * L * strain * strain / 2;
          off[k] = distance(model, beam, phi);
          CAPTURE(name(left), name(right), angle, phi, n, model.strain_energy(), energy, off[k]);
          // Round-off: strains of 16 eps.
          CHECK(model.strain_energy() <= energy + EA * L * std::pow(16 * 2.2e-16, 2));
          CHECK(off[k] <= strain * 16 * L + 1e-11);  // ∫ε ds, x⁴/120, at most
        }
        if (off[2] > 1e-10) {
          CHECK(observed_order(off[0], off[1]) >= 3.8);
          CHECK(observed_order(off[1], off[2]) >= 3.8);
        }
      }
}

// A corner or a change of curvature inside an element: it bends by its mean and its slope alone, so what is left is the
// rest of the curve within the element, of second order in its length.
TEST_CASE("a beam of several arcs lies near its natural shape, wherever its nodes are", "[arch]") {
  const std::vector<Arc> arcs{{0.21 * L, 1 / L}, {0.55 * L, -2 / L}, {0.8 * L, 3 / L}};
  double off[3];
  for (int k = 0; k < 3; ++k) {
    const int n = 16 << (2 * k);
    const Beam beam = arch(arcs, Support::clamped, Support::free);
    const Turning model(beam, n, patient_solver());
    REQUIRE(model.rest().status == Status::ok);
    off[k] = distance(model, beam, 0);
    const double l = L / n;
    CAPTURE(n, off[k]);
    // A jump of curvature Δκ <= 5/L leaves a kink of Δκ l/8 at most, over the rest of the beam: three of them.
    CHECK(off[k] <= 3 * 5 / L * l * l / 8);
    // Its turn is exact.
    CHECK(std::abs(model.shape()[n].theta - (0.21 - 0.68 + 0.75)) <= 1e-9);
  }
  CHECK(off[2] < off[1]);
  CHECK(off[1] < off[0]);
}

// Held straight, ends fixed, it is bent by κ everywhere: θ' = 0 in every element, so no element is approximate.
TEST_CASE("a naturally bent strip that is held straight stores EI κ² L/2 and pulls at neither end",
          "[arch]") {
  const double k = 0.8 / L;
  Beam beam(L, EA, EI, 0.01, Support::clamped, Support::clamped);
  const Turning model(beam.naturally({{L, k}}), 8, patient_solver());
  REQUIRE(model.rest().status == Status::ok);
  for (const auto& node : model.shape()) {
    CHECK(std::abs(node.u) <= 1e-12);
    CHECK(std::abs(node.w) <= 1e-12);
    CHECK(std::abs(node.theta) <= 1e-11);
  }
  CHECK(relative_error(model.strain_energy(), EI * k * k * L / 2) <= 1e-12);
}

// On a roller nothing but the force stands against bending it straight: a moment EI κ at the ends does.
TEST_CASE("moments of EI κ bend a natural arc straight, and twice as much to its mirror image", "[arch]") {
  const double k = 1.2 / L;
  for (const double factor : {1., 2.}) {
    Beam beam = arch({{L, k}}, Support::clamped, Support::free);
    beam.add({L, 0, 0, -factor * EI * k});
    const Turning model(beam, 16, patient_solver());
    REQUIRE(model.rest().status == Status::ok);
    const auto& tip = model.shape()[16];
    const double left = k * (1 - factor), x = 1.2 / 32;
    CAPTURE(factor, tip.u, tip.w, tip.theta);
    CHECK(std::abs(tip.theta - left * L) <= 1e-8);
    const double w = left == 0 ? 0 : (std::cos(left * L) - 1) / left,
                 u = left == 0 ? 0 : std::sin(left * L) / left - L;
    CHECK(std::hypot(tip.w - w, tip.u - u) <= std::pow(x, 4) / 120 * L + 1e-8);
  }
}

// Objectivity of an arch: laid at any angle and pushed along the normal that turns along.
TEST_CASE("a turned arch takes the force of the one that was not turned", "[arch]") {
  const double angle = 1.0;
  const Beam level = arch({{L, angle / L}}, Support::pinned, Support::clamped, -angle / 2);
  for (const double turn : {0.7, -2.0, pi}) {
    const Beam slope = arch({{L, angle / L}}, Support::pinned, Support::clamped, turn - angle / 2);
    Turning one(level, 8, patient_solver()), turned(slope, 8, patient_solver());
    const double s = 0.4 * L, c = std::cos(turn), sine = std::sin(turn);
    const auto rest = [s](const Turning& model, const Vector2<double>& n) {
      const Displacement<double> at = model.shape().at(s);
      return n.x() * at.u + n.y() * at.w;
    };
    const Vector2<double> up(0, 1), normal(sine, c);
    const double here = rest(one, up), there = rest(turned, normal);
    for (const double d : {-1e-3, 4e-3, -0.03}) {
      const Response<double> expected = one.push({s, here + d, up}),
                             response = turned.push({s, there + d, normal});
      CAPTURE(turn, d, expected.force);
      CHECK(expected.status == Status::ok);
      CHECK(response.status == Status::ok);
      CHECK(relative_error(response.force, expected.force) <= 1e-9);
    }
  }
}
