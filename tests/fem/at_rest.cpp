// Beams that are bent by nature, between the ends of their natural shape, however they are turned: nothing is stored, and a push that leaves
// them where they are takes no force and is ok.  A push moves the mesh, of which each has another natural shape of its elements.
#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include <hapbeam/body/natural_shape.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

enum class Kind { corner, arch, frame };

/// Legs of 50 to 300 mm, corners from a third of a millimetre to 30 mm, arcs of up to five radians.
std::vector<Arc> random_arcs(Random& random, Kind kind) {
  std::vector<Arc> arcs;
  double end = 0;
  const auto leg = [&] { arcs.push_back({end += random(0.05, 0.3), 0}); };
  const auto corner = [&](double angle) {
    const double radius = std::pow(10, random(-3.5, -1.5));
    arcs.push_back({end += radius * std::abs(angle), std::copysign(1 / radius, angle)});
  };
  if (kind == Kind::arch) {
    const double length = random(0.1, 0.5);
    arcs.push_back({length, random(5) / length});
    return arcs;
  }
  leg();
  corner(kind == Kind::frame ? pi / 2 : random(pi / 2));
  leg();
  if (kind == Kind::frame) corner(pi / 2), leg();
  return arcs;
}

}  // namespace

TEST_CASE("a beam in its natural shape stores nothing, and answers a push that leaves it there by nothing",
          "[natural]") {
  Random random(1);
  double most_energy = 0, most_force = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<Arc> arcs = random_arcs(random, static_cast<Kind>(trial % 3));
    const double L = arcs.back().end, h = L * std::pow(10, random(-3, -1.3)), phi = random(pi);
    const auto support = [&](bool may_be_free) {
      const Support all[] = {Support::clamped, Support::pinned, Support::free};
      return all[random.integer(0, may_be_free ? 2 : 1)];
    };
    const Support left = support(false), right = support(left == Support::clamped);
    Beam beam(L, Section::rectangle(0.02, h), Material{200e9}, left, right);
    const NaturalShape<double> natural(beam.naturally(arcs));
    const double c = std::cos(phi), sine = std::sin(phi);
    const auto place = [&](double s) {
      const Displacement<double> at = natural.at(s);
      const double x = s + at.u;
      return Displacement<double>{c * x + sine * at.w - s, c * at.w - sine * x, at.theta + phi};
    };
    const Displacement<double> end = place(L);
    beam.place({0, 0, phi}, {end.u, end.w, end.theta});
    const int n = random.integer(2, 64);
    const FemModel<Corotational<>> built(beam, n);
    CAPTURE(trial, n, L, h, phi, name(left), name(right));
    REQUIRE(built.rest().status == Status::ok);
    most_energy = std::max(most_energy, built.strain_energy() / (beam.axial_stiffness() * L));
    for (int k = 0; k < 4; ++k) {
      const double s = random(0.02, 0.98) * L;
      const Displacement<double> at = place(s);
      const double q = k < 2 ? pi / 2 - at.theta : random(pi);  // across, or anyhow
      const Vector2<double> normal(std::cos(q), std::sin(q));
      FemModel<Corotational<>> model = built;
      const auto response = model.push({s, normal.dot(Vector2<double>(at.u, at.w)), normal});
      CAPTURE(s, q, response.force, name(response.status));
      CHECK(response.status == Status::ok);
      most_force = std::max(most_force, std::abs(response.force) / beam.axial_stiffness());
    }
  }
  // Places are rounded to eps L, which stretches elements as short as L/1000 by a thousand times that at most.
  const double strain = 1e3 * 2.2e-16;
  CHECK(most_force <= strain);
  CHECK(most_energy <= strain * strain / 2);
}
