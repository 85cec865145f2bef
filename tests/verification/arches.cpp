// Naturally bent beams: free of stress between their natural ends, however they are laid, and with the energy of bending
// where they are held straight.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/pi.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

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
  for (const auto& node : mesh_nodes(model)) {
    const Displacement<double> at = natural.at(node.s);
    const double x = node.s + at.u;
    worst = std::max(worst, std::hypot(c * x + s * at.w - node.s - node.u, c * at.w - s * x - node.w));
  }
  return worst;
}

}  // namespace

TEST_CASE("an arch between its natural ends is free of stress, on every mesh", "[arch]") {
  for (const auto& [left, right] :
       {std::pair{Support::pinned, Support::pinned}, std::pair{Support::clamped, Support::clamped},
        std::pair{Support::clamped, Support::free}, std::pair{Support::free, Support::clamped}})
    for (const double angle : {0.3, -1.5, 3.0, 6.0})
      for (const double phi : {0.0, -angle / 2, 2.5})
        for (const int n : {3, 8, 16, 32}) {
          const Beam beam = arch({{L, angle / L}}, left, right, phi);
          const Turning model(beam, n, patient_solver());
          REQUIRE(model.rest().status == Status::ok);
          CAPTURE(name(left), name(right), angle, phi, n);
          // Round-off: strains of 16 eps an element.
          CHECK(model.strain_energy() <= EA * L * std::pow(16 * n * 2.2e-16, 2));
          CHECK(distance(model, beam, phi) <= 1e-11);
        }
}

// Corners and changes of curvature inside an element, too.
TEST_CASE("a beam of several arcs lies on its natural shape, wherever its nodes are", "[arch]") {
  const std::vector<Arc> arcs{{0.21 * L, 1 / L}, {0.55 * L, -2 / L}, {0.56 * L, 100 / L}, {0.8 * L, 3 / L}};
  for (const int n : {2, 5, 16, 64}) {
    const Beam beam = arch(arcs, Support::clamped, Support::free);
    const Turning model(beam, n, patient_solver());
    REQUIRE(model.rest().status == Status::ok);
    CAPTURE(n);
    CHECK(distance(model, beam, 0) <= 1e-11);
    CHECK(model.strain_energy() <= EA * L * std::pow(16 * n * 2.2e-16, 2));
  }
}

// Held straight, ends fixed, it is bent by κ everywhere: θ' = 0 in every element.  AssumedStrain knows the first term of an arc's
// chord l sin x/x, x = κl/2; x⁴/120 is left as its strain.
TEST_CASE("a naturally bent strip that is held straight stores EI κ² L/2", "[arch]") {
  const double k = 0.8 / L;
  Beam beam(L, EA, EI, 0.01, Support::clamped, Support::clamped);
  const Turning model(beam.naturally({{L, k}}), 8, patient_solver());
  REQUIRE(model.rest().status == Status::ok);
  for (const auto& node : mesh_nodes(model)) {
    CHECK(std::abs(node.u) <= 1e-12);
    CHECK(std::abs(node.w) <= 1e-12);
    CHECK(std::abs(node.theta) <= 1e-11);
  }
  const double strain = std::pow(0.8 / 16, 4) / 120;
  CHECK(relative_error(model.strain_energy(), (EI * k * k + EA * strain * strain) * L / 2) <= 1e-12);
}

// On a roller nothing but the force stands against bending it straight: a moment EI κ at the ends does.
TEST_CASE("moments of EI κ bend a natural arc straight, and twice as much to its mirror image", "[arch]") {
  const double k = 1.2 / L;
  for (const double factor : {1., 2.}) {
    Beam beam = arch({{L, k}}, Support::clamped, Support::free);
    beam.add({L, 0, 0, -factor * EI * k});
    const Turning model(beam, 16, patient_solver());
    REQUIRE(model.rest().status == Status::ok);
    const auto tip = mesh_node(model, 16);
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
