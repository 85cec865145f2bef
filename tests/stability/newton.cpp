// Where Newton's method fails as it is first written: far from the answer, beyond a limit point, on a ridge, at zero.
// benchmarks/where_methods_fail charts the same.
#include <limits>

#include "support/arch.hpp"
#include "support/catch.hpp"
#include "support/elliptic.hpp"
#include "support/error.hpp"
#include "support/naive_newton.hpp"
#include "support/path.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

// A cantilever of L = EI = 1 under a tip load of 10, which bends it by 0.81 of its length: the increments of a linear
// beam lengthen what turns, the more the finer the mesh.
TEST_CASE(
    "added as they are, Newton's increments need load steps by the hundred; laid as a chain, hardly any",
    "[newton]") {
  Beam beam(1, 1e4, 1, 0.01, Support::clamped, Support::free);
  beam.add({1, 0, 10, 0});
  const auto naive = [&](int elements, int steps) {
    System<> system(beam, elements);
    system.set_goal();
    return naive_newton(system, steps);
  };
  CHECK(naive(8, 4).converged);
  for (const int elements : {8, 64, 1024}) {
    CAPTURE(elements);
    CHECK_FALSE(naive(elements, 1).converged);
    const FemModel<Corotational<>> model(beam, elements);
    CHECK(model.rest().status == Status::ok);
    CHECK(model.rest().solves <= 30);  // 28, whatever the mesh
  }
  CHECK_FALSE(naive(64, 4).converged);
  CHECK_FALSE(naive(1024, 100).converged);
}

namespace {

constexpr double arch_length = 1, arch_angle = 0.2;

Beam shallow_arch() {
  return level_arch(arch_length, arch_angle, 20736, 1, 0.001, Support::pinned, Support::pinned);
}

}  // namespace

// tests/verification/continuation.cpp has its limit points by shooting: 2.161 where its middle has come down by 0.59 of
// its rise, and 0.294 at 1.55.  Between the two no load holds it, and on the falling branch only a hand does.
TEST_CASE("beyond a limit point a rising load loses an arch, or moves it unseen; a press goes all the way",
          "[newton]") {
  const double rise = level_arch_rise(arch_length, arch_angle);
  Beam loaded = shallow_arch();
  loaded.add({arch_length / 2, 0, -1, 0});
  for (const double increment : {0.02, 0.1, 0.5}) {
    System<> system(loaded, 16);
    double down = 0;
    for (double load = increment;; load += increment) {
      system.set_load(load);
      bool converged = false;
      for (int k = 0; k < 200 && !converged; ++k) {
        if (system.factor(0) != Status::ok) break;
        system.move([&](int i) { return system.increment(i); });
        system.find_tensions();
        converged = RelativeEnergy{}(system);
      }
      const double moved = rise - system.node(8).w - down;
      down += moved;
      CAPTURE(increment, load, converged, moved / rise);
      if (load < 2.161) {
        CHECK(converged);
        CHECK(down < 0.6 * rise);
      } else {
        CHECK((!converged || moved > rise));
        break;
      }
    }
  }

  FemModel<Corotational<>> model(shallow_arch(), 16);
  double before = 0, largest = 0, least = 0;
  for (int k = 1; k <= 250; ++k) {
    const Response<double> response = model.press({arch_length / 2, rise - 2.5 * rise * k / 250});
    REQUIRE(response.status == Status::ok);
    REQUIRE(model.report().solves <= 6);
    const double force = -response.force;
    if (k < 100) largest = std::max(largest, force);
    else if (k < 200) least = k == 100 ? force : std::min(least, force);
    CHECK(std::abs(force - before) <= 0.1 * 2.161);  // no jump anywhere
    before = force;
  }
  CHECK(relative_error(largest, 2.161) <= 1e-3);
  CHECK(relative_error(least, 0.2937) <= 1e-3);
}

// Ends moved together by ten times what Euler's load takes.  tests/verification/buckling.cpp and tests/stability/snap.cpp
// hold the library's shapes to the elastica, and what happens to them under a hand.
TEST_CASE("a compressed beam that is solved from straight stays straight, and pulls the hand that presses it",
          "[newton]") {
  const double EA = 1e6, pi = std::acos(-1.0), shortening = 10 * pi * pi / EA, push = 1e-4;
  Beam beam(1, EA, 1, 0.001, Support::pinned, Support::pinned);
  beam.place({}, {-shortening, 0, 0});
  System<> system(beam, 16);
  lay_straight(system, 1);
  system.set_goal();
  CHECK(naive_newton(system).converged);
  for (int i = 0; i <= 16; ++i) CHECK(system.node(i).w == 0);
  CHECK(system.negative_pivots() == 3);  // Euler's loads go with n²: 10 lies between the third and the fourth
  system.set_goal(Push<double>{0.5, push, {0, 1}});
  CHECK(naive_newton(system).converged);
  CHECK(system.rows().reaction(0) < 0);  // the hand, pressing, has to hold it back

  FemModel<Corotational<>> model(beam, 16);
  REQUIRE(model.rest().status == Status::ok);
  const double aside = model.shape().at(0.5).w, elastica = BuckledElastica(shortening).middle;
  // Inextensible in the reference: of the shortening N/EA, a tenth, is strain, and the deflection goes with its root.
  CHECK(relative_error(aside, elastica * std::sqrt(0.9)) <= 1e-3);
  const Response<double> response = model.press({0.5, aside - push});
  CHECK(response.status == Status::ok);
  CHECK(response.force < 0);  // pressed down, it pushes up
}

// To where it lies at rest, after any press: 0/0.
TEST_CASE("a relative criterion is never met at zero; the library's is absolute there", "[newton]") {
  const double s = 0.3 * thesis_length;
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  for (const double from : {1e-2, 1e-4, 0.0}) {
    System<VonKarman<>> system(beam, 16);
    FemModel<> model(beam, 16);
    if (from != 0) {
      system.set_goal(Push<double>{s, from, {0, 1}});
      REQUIRE(naive_newton(system, 1, 25, RelativeDisplacement{}).converged);
      REQUIRE(model.press({s, from}).status == Status::ok);
    }
    system.set_goal(Push<double>{s, 0, {0, 1}});
    CHECK_FALSE(naive_newton(system, 1, 100, RelativeDisplacement{}).converged);
    const Response<double> response = model.press({s, 0});
    CHECK(response.status == Status::ok);
    CHECK(response.force == 0);
    CHECK(model.report().solves <= 3);
  }
}

// |Δ(k+1)| = C|Δ(k)|² with one C, whatever the state.
TEST_CASE("what hardly moves says of what moves far that it is as curved, not that it is linear",
          "[newton]") {
  Curvature<double> known;
  const double C = 0.5, size = 0.6;  // [1/√J], of the state
  for (const double still : {1e-9, 1.0}) {
    known.measure(1, size, C * size * size * still, still);
    for (const double state : {1.0, 10.0}) CHECK(known.of(1, size, state) >= C * state);
  }
  CHECK(known.of(1, 2 * size, 1) == std::numeric_limits<double>::infinity());
}
