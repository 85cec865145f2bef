// Descent: from anywhere down to an equilibrium that stays.
#include "support/arch.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/path.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/solver/load_path.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

Beam strip(Support end) {
  Beam beam(1, 1e5, 1, 0.01, end, end);
  return beam.place({}, {-0.05, 0, 0});
}

/// A smooth crooked shape between the ends where they are, strained by a few percent.
template <class Sys>
void crumple(Sys& system, Random& random, double size) {
  const ContactMesh<double> mesh(system.elements(), system.length());
  typename Sys::State state(system.elements());
  const double a[3] = {random(size), random(size), random(size)};
  for (int i = 0; i <= system.elements(); ++i) {
    const double t = mesh.position(i) / system.length();
    double w = 0, theta = 0;
    for (int k = 1; k <= 3; ++k) {
      const double x = 3.14159265358979 * k * t;
      w += a[k - 1] * std::sin(x) * std::sin(x);
      theta -= a[k - 1] * 3.14159265358979 * k * std::sin(2 * x);
    }
    state.nodes[i] = {mesh.position(i), -0.05 * t, w, theta};
  }
  system.set_state(state);
  system.find_tensions();
  system.set_goal();
}

}  // namespace

TEST_CASE("descent ends in a stable equilibrium of lower potential, from wherever it was let go",
          "[descent]") {
  Random random(6);
  for (const Support end : {Support::pinned, Support::clamped})
    for (int trial = 0; trial < 40; ++trial) {
      System<> system(strip(end), 12);
      crumple(system, random, 0.08);
      Descent descent;
      descent.max_solves = 2000;
      int solves = 0;
      system.set_target(1);
      REQUIRE(system.factor(1e6) == Status::ok);
      const double before = system.potential();
      const bool found = descent.solve(system, solves);
      CAPTURE(name(end), trial, solves, before);
      REQUIRE(found);
      CHECK(solves <= 400);
      // Near: a few of Newton's steps bring what is left to nothing.
      for (int k = 0; k < 4; ++k) {
        REQUIRE(system.factor(0) == Status::ok);
        CHECK(system.negative_pivots() == 0);
        system.advance();
      }
      REQUIRE(system.factor(0) == Status::ok);
      CHECK(system.negative_pivots() == 0);
      CHECK(system.increment() <= 1e-6 * system.unit());
      CHECK(system.potential() < before);
      // A strip has two shapes at rest, and their energy.
      const FemModel<Corotational<>> rest(strip(end), 12);
      CHECK(relative_error(system.potential(), rest.strain_energy()) <= 1e-6);
    }
}

// What is kept, a state to go back to, is never higher than what was kept before.  The first two come before the ends are in
// their places.
TEST_CASE("no step of a descent raises the potential, and some are taken back for that", "[descent]") {
  struct Watched : System<> {
    using System<>::System;
    std::vector<double> kept;
    int taken_back = 0;
    void save() noexcept {
      kept.push_back(potential());
      System<>::save();
    }
    void restore() noexcept {
      ++taken_back;
      System<>::restore();
    }
  };
  Random random(8);
  int taken_back = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Watched system(strip(Support::clamped), 12);
    crumple(system, random, 0.12);
    Descent descent;
    descent.max_solves = 2000;
    int solves = 0, found = descent.solve(system, solves);
    CAPTURE(trial, found);
    taken_back += system.taken_back;
    for (std::size_t k = 3; k < system.kept.size(); ++k)
      CHECK(system.kept[k] <= system.kept[k - 1] * (1 + 1e-12) + 1e-10);  // what round-off may be, EI/L = 1
  }
  CHECK(taken_back > 10);  // the guard has something to do
}

TEST_CASE("a budget that ends leaves the descent on its way, and it goes on from there", "[descent]") {
  for (const int budget : {12, 48}) {
    System<> system(strip(Support::clamped), 12);
    Random random(9);
    crumple(system, random, 0.08);
    Descent descent;
    descent.max_solves = budget;
    int calls = 0, solves = 0;
    double last = 1e300;
    bool found = false;
    while (!found && ++calls < 200) {
      int used = 0;
      found = descent.solve(system, used);
      CHECK(used <= budget);
      solves += used;
      REQUIRE(system.factor(1e6) == Status::ok);
      if (calls > 1) CHECK(system.potential() <= last * (1 + 1e-10));
      last = system.potential();
    }
    CAPTURE(budget, calls, solves);
    CHECK(found);
  }
}

// On the ridge, straight under 1.8 times Euler's load, there is no way down; a nudge makes one.
TEST_CASE("a descent from a ridge needs a nudge, and goes to the side to which it was nudged", "[descent]") {
  const double EA = 1e5, shortening = 7e-4, euler = 39.478417604357434;
  for (const double size : {0.0, 1e-3, -1e-3}) {
    Beam beam(1, EA, 1, 0.01, Support::clamped, Support::clamped);
    System<> system(beam.place({}, {-shortening, 0, 0}), 12);
    const ContactMesh<double> mesh(12, 1.0);
    System<>::State state(12);
    for (int i = 0; i <= 12; ++i) state.nodes[i] = {mesh.position(i), -shortening * mesh.position(i), 0, 0};
    system.set_state(state);
    system.find_tensions();
    system.set_goal();
    system.set_target(1);
    REQUIRE(system.factor(0) == Status::ok);
    CHECK(system.negative_pivots() == 1);
    if (size != 0) system.nudge(size);
    Descent descent;
    descent.max_solves = 2000;
    int solves = 0;
    const bool found = descent.solve(system, solves);
    const double w = system.centreline().at(0.5).w,
                 mode = 2 / 3.14159265358979 * std::sqrt(shortening - euler / EA);
    CAPTURE(size, found, w, mode);
    if (size == 0) {
      CHECK(std::abs(w) <= 1e-12);
    } else {
      CHECK(found);
      CHECK(w * size > 0);
      CHECK(relative_error(std::abs(w), mode) <= 1e-2);  // a mode's shape to (a/L)², N to 1e-4
    }
  }
}
