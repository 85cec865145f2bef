// Dead loads of the linear beam against closed forms.  Cubics are exact at their nodes for any load that is
// given as consistent nodal forces, so every bound is round-off: eps = 2.2e-16, amplified by the condition of
// n elements in bending, of which n² reaches the displacements.  The weight of a beam that bends far is compared with that of a rod.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = thesis_length, EA = thesis_EA, EI = thesis_EI, pi = 3.14159265358979323846;
constexpr double eps = 2.2e-16;

/// Every node of the beam at rest against displacements as functions of x, relative to the largest of each on
/// the beam.
template <class U, class W>
void check_rest(const Beam& beam, U&& u, W&& w, double quadrature = 0) {
  for (const int elements : {2, 3, 8, 32}) {
    const FemModel<Linear> model(beam, elements);
    REQUIRE(model.rest().status == Status::ok);
    double largest_u = 0, largest_w = 0, error_u = 0, error_w = 0;
    for (int i = 0; i <= 64; ++i) {
      largest_u = std::max(largest_u, std::abs(u(i * L / 64)));
      largest_w = std::max(largest_w, std::abs(w(i * L / 64)));
    }
    for (const auto& node : mesh_nodes(model)) {
      error_u = std::max(error_u, std::abs(node.u - u(node.s)));
      error_w = std::max(error_w, std::abs(node.w - w(node.s)));
    }
    const double tolerance = 16 * eps * elements * elements + quadrature;
    INFO(elements << " elements: errors " << error_u << " of " << largest_u << " m, " << error_w << " of "
                  << largest_w << " m");
    CHECK(error_u <= tolerance * largest_u);
    CHECK(error_w <= tolerance * largest_w);
  }
}

double zero(double) { return 0; }

/// Deflection at x of a simply supported beam under a unit force at a.
double influence(double x, double a) {
  if (x > a) return influence(a, x);
  const double b = L - a;
  return b * x * (L * L - b * b - x * x) / (6 * L * EI);
}

}  // namespace

TEST_CASE("cantilever under a tip force: w = P x² (3L - x) / 6EI", "[load]") {
  const double P = -100;
  Beam beam = thesis_beam(Support::clamped, Support::free);
  beam.add({L, 0, P, 0});
  check_rest(beam, zero, [&](double x) { return P * x * x * (3 * L - x) / (6 * EI); });
}

TEST_CASE("cantilever under a tip moment, which works on theta = -w': w = -M x² / 2EI", "[load]") {
  const double M = 200;
  Beam beam = thesis_beam(Support::clamped, Support::free);
  beam.add({L, 0, 0, M});
  check_rest(beam, zero, [&](double x) { return -M * x * x / (2 * EI); });
}

TEST_CASE("a point force anywhere on a simply supported beam, at a node or inside an element", "[load]") {
  for (const double a : {0.5 * L, 0.3 * L, 0.0137 * L}) {
    Beam beam = thesis_beam(Support::pinned, Support::roller);
    beam.add({a, 0, 50, 0});
    check_rest(beam, zero, [&](double x) { return 50 * influence(x, a); });
  }
}

// A moment is two opposite forces: w = -M ∂G(x, a)/∂a.
TEST_CASE("a point moment anywhere on a simply supported beam", "[load]") {
  const double M = 30;
  for (const double a : {0.5 * L, 0.3 * L, 0.0137 * L}) {
    Beam beam = thesis_beam(Support::pinned, Support::roller);
    beam.add({a, 0, 0, M});
    check_rest(beam, zero, [&](double x) {
      const double b = L - a, y = L - x;
      return x <= a ? M * x * (L * L - 3 * b * b - x * x) / (6 * L * EI)
                    : -M * y * (L * L - 3 * a * a - y * y) / (6 * L * EI);
    });
  }
}

TEST_CASE("a triangular load q = q0 x/L on a simply supported beam", "[load]") {
  const double q0 = 700;
  Beam beam = thesis_beam(Support::pinned, Support::roller);
  beam.transverse([&](double x) { return q0 * x / L; });
  check_rest(beam, zero, [&](double x) {
    return q0 * x * (7 * L * L * L * L - 10 * L * L * x * x + 3 * x * x * x * x) / (360 * L * EI);
  });
}

// The five-point rule leaves 5!⁴/(11 · 10!³) = 4e-13 of the tenth derivative of sine times cubic; in two
// elements, κ = π/2, that derivative is below κ^10 + 15κ^9 + 270κ^8 + 1440κ^7 = 4.5e4.
TEST_CASE("a load of half a sine wave on a simply supported beam: w = q0 (L/π)⁴ sin(πx/L) / EI", "[load]") {
  const double q0 = 700, k = pi / L;
  Beam beam = thesis_beam(Support::pinned, Support::roller);
  beam.transverse([&](double x) { return q0 * std::sin(k * x); });
  check_rest(
      beam, zero, [&](double x) { return q0 * std::sin(k * x) / (k * k * k * k * EI); }, 2e-8);
}

TEST_CASE("a cantilever under its own weight sags by ρAg L⁴/8EI, and an upright one is ρg L²/2E shorter",
          "[load]") {
  const Section section = Section::rectangle(0.03, 0.02);
  const double E = 70e9, density = 2700, g = 9.81;
  const Beam cantilever(L, section, Material{E}, Support::clamped, Support::free);
  const double q = density * section.area * g;
  check_rest(Beam(cantilever).weight(density, {0, -g}), zero, [&](double x) {
    return -q * x * x * (6 * L * L - 4 * L * x + x * x) / (24 * E * section.inertia);
  });
  check_rest(
      Beam(cantilever).weight(density, {-g, 0}),
      [&](double x) { return -density * g * x * (2 * L - x) / (2 * E); }, zero);
}

TEST_CASE("a beam and a rod of one section sag alike by their weight, in gravity from any side", "[load]") {
  const double length = 0.8, diameter = 0.002, density = 7850;
  for (const Vector2<double>& gravity : {Vector2<double>(3, -9.81), Vector2<double>(-6, 7)}) {
    Beam beam(length, Section::circle(diameter), Material{200e9}, Support::clamped, Support::free);
    Rod rod(length, RodSection::circle(diameter), RodMaterial::isotropic(200e9, 0.3), RodSupport::clamped,
            RodSupport::free);
    beam.weight(density, gravity), rod.weight(density, {gravity.x(), gravity.y(), 0});
    const auto difference = [&](int elements) {
      const FemModel<Corotational<>> planar(beam, elements);
      const FemModel<RoundRod> in_space(rod, elements);
      double largest = 0;
      for (double s = 0; s <= length; s += length / 10) {
        const VectorOf<double, 3> there = in_space.shape().position(s);
        CHECK(std::abs(there.z()) <= 1e-15);
        largest = std::max(largest, (planar.shape().position(s) - there.head<2>()).norm());
      }
      return largest / length;
    };
    // Both have errors of fourth order.
    const double e8 = difference(8), e16 = difference(16);
    INFO("differences " << e8 << ", " << e16);
    CHECK(e16 <= 1e-7);
    CHECK(observed_order(e8, e16) >= 3.5);
  }
}

TEST_CASE("an axial load f = f0 x/L on a bar held at the left: EA u'' = -f", "[load]") {
  const double f0 = 1e6;
  Beam beam = thesis_beam(Support::pinned, Support::roller);
  beam.axial([&](double x) { return f0 * x / L; });
  check_rest(
      beam, [&](double x) { return f0 * (L * L * x - x * x * x / 3) / (2 * L * EA); }, zero);
}

TEST_CASE("an axial point force inside an element stretches what lies between it and the support", "[load]") {
  const double F = 1e5, a = 0.3 * L;
  Beam beam = thesis_beam(Support::clamped, Support::free);
  beam.add({a, F, 0, 0});
  // Inside the element that holds the force u is linear, so only its nodes are exact; that is what is
  // compared.
  check_rest(
      beam, [&](double x) { return F * std::min(x, a) / EA; }, zero);
}

// The consistent loads of the uniform mesh stay where they are when the mesh follows the contact.  They are
// exact at the uniform nodes; in between the beam of an element clamped at both ends is missing, q l⁴ / 384
// EI at most.
TEST_CASE("a press under a uniform load is their superposition, to q l⁴/384EI where the mesh has moved",
          "[load]") {
  const double q = -300;
  const auto deflection = [&](double x) {
    return q * x * (L * L * L - 2 * L * x * x + x * x * x) / (24 * EI);
  };
  Beam beam = thesis_beam(Support::pinned, Support::roller);
  beam.transverse(q);
  for (const int elements : {4, 8, 16}) {
    FemModel<Linear> model(beam, elements);
    const double l = L / elements, missing = std::abs(q) * l * l * l * l / (384 * EI);
    for (int k = 1; k < 4 * elements; ++k)
      for (const double d : {-8e-3, 0.0, 5e-3}) {
        const double s = k * l / 4, stiffness = 1 / influence(s, s);
        const Response<double> response = model.press({s, d});
        REQUIRE(response.status == Status::ok);
        const double round_off = 64 * eps * elements * elements * (std::abs(d) + std::abs(deflection(s)));
        INFO(elements << " elements, s " << s << " m, d " << d << " m");
        CHECK(std::abs(response.force - (d - deflection(s)) * stiffness) <=
              (round_off + (k % 4 == 0 ? 0 : missing)) * stiffness);
      }
  }
}

TEST_CASE("a point load where the hand presses adds to what the hand feels", "[load]") {
  const double s = 0.3 * L, P = -40;
  Beam loaded = thesis_beam(Support::clamped, Support::pinned);
  FemModel<Linear> alone(loaded, 8);
  loaded.add({s, 0, P, 0});
  FemModel<Linear> model(loaded, 8);
  for (const double d : {-4e-3, 0.0, 4e-3})
    CHECK(std::abs(model.press({s, d}).force - (alone.press({s, d}).force - P)) <= 1e-10 * std::abs(P));
}
