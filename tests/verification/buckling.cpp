// Buckling: Euler's loads by the pivots' signs, and how far beams stand aside whose ends have been moved together.
#include "support/catch.hpp"
#include "support/elliptic.hpp"
#include "support/error.hpp"
#include "support/path.hpp"
#include "support/pi.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = 1, EI = 1;

/// Directions that give way, of a beam that is straight and compressed by the strain N/EA.
template <class Element>
int negative_pivots(Beam beam, int elements, double shortening) {
  System<Element> system(beam.place({}, {-shortening, 0, 0}), elements);
  const ContactMesh<double> mesh(elements, L);
  typename System<Element>::State state(elements);
  for (int i = 0; i <= elements; ++i)
    state.nodes[i] = {mesh.position(i), -shortening * mesh.position(i), 0, 0};
  system.set_state(state);
  system.find_tensions();
  system.set_goal();
  system.set_target(1);
  return system.factor(0) == Status::ok ? system.negative_pivots() : 1;  // singular: at the very load
}
/// The same under a dead load along the beam, at its right end.
template <class Element>
int negative_pivots_under(Beam beam, int elements, double load) {
  System<Element> system(beam.add({L, -load, 0, 0}), elements);
  system.set_load(1);
  for (int k = 0; k < 4; ++k) {  // on the ridge, from where nothing pushes it
    if (system.factor(0) != Status::ok) return 1;
    system.advance();
  }
  return system.factor(0) == Status::ok ? system.negative_pivots() : 1;
}

/// The same under a dead load along all of the beam, down on it.
template <class Element>
int negative_pivots_of_weight(Beam beam, int elements, double load) {
  System<Element> system(beam.axial(-load / L), elements);
  const ContactMesh<double> mesh(elements, L);
  typename System<Element>::State state(elements);
  for (int i = 0; i <= elements; ++i) state.nodes[i] = {mesh.position(i), 0, 0, 0};
  system.set_state(state);
  system.find_tensions();
  system.set_load(1);
  for (int k = 0; k < 4; ++k) {
    if (system.factor(0) != Status::ok) return 1;
    system.advance();
  }
  return system.factor(0) == Status::ok ? system.negative_pivots() : 1;
}

/// Where a count goes from 0 to 1, between low and high.
template <class Count>
double first_event(Count&& count, double low, double high) {
  REQUIRE(count(low) == 0);
  REQUIRE(count(high) == 1);
  for (int i = 0; i < 25; ++i) {
    const double middle = (low + high) / 2;
    (count(middle) > 0 ? high : low) = middle;
  }
  return low;
}

struct Column {
  Support left, right;
  double k;         // √(N/EI) of Euler's load [1/m]
  double of_whole;  // length of the beam over that of the model
};

}  // namespace

// Cubics leave (kl)⁴/720 of the load, and the strain N/EA <= 5e-6 some of itself.  The symmetric mode of a beam between clamps
// is that of its half: of 8 elements on the half are asked 1e-4, of 8 on the whole it is 5e-4.
TEMPLATE_TEST_CASE("Euler's load of columns whose ends are moved together", "[buckling]", Corotational<>,
                   VonKarman<>) {
  const double EA = 1e7;
  for (const Column& column :
       {Column{Support::pinned, Support::pinned, pi, 1}, Column{Support::clamped, Support::guided, pi, 2},
        Column{Support::clamped, Support::clamped, 2 * pi, 1},
        Column{Support::clamped, Support::pinned, 4.493409457909064, 1}})
    for (const int elements : {8, 16, 32}) {
      const Beam beam(L, EA, EI, 0.001, column.left, column.right);
      const double euler = EI * column.k * column.k, cubic = std::pow(column.k * L / elements, 4) / 720;
      const double load = EA / L *
                          first_event([&](double d) { return negative_pivots<TestType>(beam, elements, d); },
                                      0.9 * euler * L / EA, 1.1 * euler * L / EA);
      CAPTURE(name(column.left), name(column.right), elements, load, euler, cubic);
      CHECK(relative_error(load, euler) <= 1.05 * cubic + 2 * euler / EA);
      if (column.k == pi && elements == 8) CHECK(relative_error(load, euler) <= 1e-4);
    }
}

TEMPLATE_TEST_CASE("Euler's load of columns under a dead load", "[buckling]", Corotational<>, VonKarman<>) {
  const double EA = 1e7;
  for (const Column& column :
       {Column{Support::pinned, Support::roller, pi, 1}, Column{Support::clamped, Support::free, pi / 2, 1},
        Column{Support::clamped, Support::roller, 4.493409457909064, 1}})
    for (const int elements : {8, 16, 32}) {
      const Beam beam(L, EA, EI, 0.001, column.left, column.right);
      const double euler = EI * column.k * column.k, cubic = std::pow(column.k * L / elements, 4) / 720;
      const double load =
          first_event([&](double P) { return negative_pivots_under<TestType>(beam, elements, P); },
                      0.9 * euler, 1.1 * euler);
      CAPTURE(name(column.left), name(column.right), elements, load, euler);
      CHECK(relative_error(load, euler) <= 1.05 * cubic + 2 * euler / EA);
    }
}

// A mast under its own weight: J(-1/3) of 2/3 √(f L³/EI) is zero.  Source: Greenhill, Determination of the greatest height
// consistent with stability, Proc. Cambridge Phil. Soc. 4 (1881).
TEMPLATE_TEST_CASE("the weight that buckles a mast is met with fourth order", "[buckling]", Corotational<>,
                   VonKarman<AssumedStrain>) {
  const double exact = 7.837347439, EA = 1e8;
  const Beam mast(L, EA, EI, 0.001, Support::clamped, Support::free);
  for (const int elements : {4, 8, 16, 32}) {
    const double load =
        first_event([&](double f) { return negative_pivots_of_weight<TestType>(mast, elements, f); },
                    0.8 * exact, 1.2 * exact);
    CAPTURE(elements, load);
    CHECK(relative_error(load, exact) <= 0.105 * std::pow(L / elements, 4) + 2 * exact / EA);  // of 0.05
  }
}

// Each higher load of Euler's adds a direction: N = n² π² EI/L² between hinges.
TEST_CASE("a column between hinges gives way along n directions beyond its nth load", "[buckling]") {
  const Beam beam(L, 1e7, EI, 0.001, Support::pinned, Support::pinned);
  for (int n = 0; n <= 4; ++n) {
    const double load = pi * pi * (n * n + (n + 1.) * (n + 1.)) / 2;
    CHECK(negative_pivots<Corotational<>>(beam, 16, load / 1e7) == n);
  }
}

TEST_CASE("complete elliptic integrals", "[buckling]") {
  CHECK(relative_error(CompleteElliptic(0).K, pi / 2) <= 1e-15);
  CHECK(relative_error(CompleteElliptic(0).E, pi / 2) <= 1e-15);
  // k = sin 45°: Gauss' lemniscate, and Legendre's relation 2EK - K² = π/2.
  const CompleteElliptic half(std::sqrt(0.5));
  CHECK(relative_error(half.K, 1.854074677301371918) <= 1e-14);
  CHECK(relative_error(2 * half.E * half.K - half.K * half.K, pi / 2) <= 1e-14);
}

// Inextensible in the reference: N/EA <= 6e-7 of strain here, 6e-4 of the least shortening.
TEST_CASE("a buckled beam stands as far aside as the elastica, to 1e-3 at 8 elements", "[buckling]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const double shortening : {0.001, 0.01, 0.05, 0.1, 0.15, 0.2}) {
      const double EA = 1e8, euler = (end == Support::pinned ? 1 : 4) * pi * pi * EI;
      const BuckledElastica exact(shortening);
      double error[2];
      for (int k = 0; k < 2; ++k) {
        Beam beam(L, EA, EI, 0.001, end, end);
        const FemModel<Corotational<>> model(beam.place({}, {-shortening * L, 0, 0}), 8 << k,
                                             patient_solver());
        REQUIRE(model.rest().status == Status::ok);
        const double w = model.shape().at(L / 2).w;
        error[k] = relative_error(w, exact.middle * L);
        CAPTURE(name(end), shortening, 8 << k, w, exact.middle, error[k]);
        CHECK(w > 0);
        CHECK(error[k] <= (k == 0 ? 1e-3 : 1e-4) + euler * exact.load / EA / shortening);
      }
    }
}

// The ends' force, in closed form, is what the stored energy rises by as they come closer: V' = N.
TEST_CASE("a buckled beam's ends push with the elastica's load", "[buckling]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const double shortening : {0.02, 0.1, 0.2}) {
      const double euler = (end == Support::pinned ? 1 : 4) * pi * pi * EI;
      const auto energy = [&](double d) {
        Beam beam(L, 1e8, EI, 0.001, end, end);
        const FemModel<Corotational<>> model(beam.place({}, {-d * L, 0, 0}), 16, patient_solver());
        REQUIRE(model.rest().status == Status::ok);
        return model.strain_energy();
      };
      const double h = 1e-3, load = (energy(shortening + h) - energy(shortening - h)) / (2 * h * L);
      CAPTURE(name(end), shortening, load);
      CHECK(relative_error(load, euler * BuckledElastica(shortening).load) <= 1e-3);
    }
}

// Moderate rotation keeps Euler's load for any deflection: a² π²/4L = δ - N L/EA, in the shape of its mode.
TEST_CASE("a buckled beam of moderate rotation stands aside by 2/π √((δ - N L/EA) L)", "[buckling]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const double times : {1.01, 1.5, 4.0, 100.0}) {
      const double EA = 1e5, N = (end == Support::pinned ? 1 : 4) * pi * pi * EI, delta = times * N * L / EA;
      Beam beam(L, EA, EI, 0.001, end, end);
      const FemModel<> model(beam.place({}, {-delta, 0, 0}), 64, patient_solver());
      REQUIRE(model.rest().status == Status::ok);
      const double w = model.shape().at(L / 2).w, exact = 2 / pi * std::sqrt((delta - N * L / EA) * L);
      CAPTURE(name(end), times, w, exact);
      CHECK(w > 0);
      // N is off by (kl)⁴/720 = 1.3e-7, which near Euler's load is magnified by N/(2(times - 1)).
      CHECK(relative_error(w, exact) <= 1e-4);
    }
}

// Just short of Euler's load it stays straight, just beyond it stands on the upper side, for both elements.
TEMPLATE_TEST_CASE("the search for rest finds the buckled side, the upper one, and no other before its time",
                   "[buckling]", Corotational<>, VonKarman<>) {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const int elements : {8, 9, 16}) {
      const double EA = 1e5, N = (end == Support::pinned ? 1 : 4) * pi * pi * EI;
      for (const double times : {0.9, 0.99, 1.01, 1.1, 3.0, 30.0}) {
        Beam beam(L, EA, EI, 0.001, end, end);
        const FemModel<TestType> model(beam.place({}, {-times * N * L / EA, 0, 0}), elements,
                                       patient_solver());
        const double w = model.shape().at(L / 2).w;
        CAPTURE(name(end), elements, times, w);
        REQUIRE(model.rest().status == Status::ok);
        if (times < 1) CHECK(std::abs(w) <= 1e-9);
        else CHECK(w > 0.5 * 2 / pi * std::sqrt((times - 1) * N / EA));
      }
    }
}

// A strip of steel as thin as 1/2900 of its length has EA L²/EI = 12 (L/t)² = 1e8.  Newton's method alone loses its way.
TEST_CASE("slender strips are found at rest, too, whatever their ends, mesh and shortening", "[buckling]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const double EA : {1e6, 1e8})
      for (const double shortening : {0.01, 0.1, 0.2, 0.3})
        for (const int elements : {8, 16, 64}) {
          Beam beam(L, EA, EI, 0.001, end, end);
          const FemModel<Corotational<>> model(beam.place({}, {-shortening * L, 0, 0}), elements);
          const double w = model.shape().at(L / 2).w, euler = 40 * EI;
          CAPTURE(name(end), EA, shortening, elements, w, model.rest().solves);
          CHECK(model.rest().status == Status::ok);
          CHECK(relative_error(w, BuckledElastica(shortening).middle * L) <=
                1e-3 + 2 * euler / EA / shortening);
        }
}
