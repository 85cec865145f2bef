// Rods in space against the Kirchhoff rod by collocation (tests/data/rods_in_space.csv), and against published numbers.
#include <algorithm>
#include <map>
#include <vector>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

struct Errors {
  double force = 0, place = 0;  ///< relative, the place to the depth
};

/// Largest errors of the rows of a case, in the order in which a hand would press them.
template <class Element>
Errors errors(const std::string& name, int elements) {
  static const Csv table("rods_in_space.csv");
  const PressedRod pressed = pressed_rod(name);
  FemModel<Element> model(pressed.rod, elements * pressed.turns);
  REQUIRE(model.rest().status == Status::ok);
  const double home = pressed.normal.dot(model.shape().at(pressed.s).r);
  Errors worst;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "case") != name) continue;
    const double depth = table.number(row, "depth"), force = table.number(row, "force");
    const auto response = model.push({pressed.s, home + depth, pressed.normal});
    REQUIRE(response.status == Status::ok);
    const Point at(table.number(row, "x"), table.number(row, "y"), table.number(row, "z"));
    worst.force = std::max(worst.force, std::abs(response.force / force - 1));
    worst.place = std::max(worst.place, (model.shape().at(pressed.s).r - at).norm() / depth);
  }
  return worst;
}

/// Errors at n and 2n elements within bounds, places of the pressed point within those of the force, and the order from there.
template <class Element>
void check(const std::string& name, int n, double at_n, double at_2n, double place_2n, int from) {
  const Errors coarse = errors<Element>(name, n), fine = errors<Element>(name, 2 * n);
  INFO(name << ": " << coarse.force << ", " << fine.force << ", places " << coarse.place << ", "
            << fine.place);
  CHECK(coarse.force <= at_n);
  CHECK(fine.force <= at_2n);
  CHECK(coarse.place <= std::max(at_n, place_2n));
  CHECK(fine.place <= place_2n);
  const double order =
      std::log2(from == n ? coarse.force / fine.force
                          : errors<Element>(name, from).force / errors<Element>(name, 2 * from).force);
  INFO("order from " << from << ": " << order);
  CHECK(order >= 3.8);
}

}  // namespace

TEST_CASE("a wire that hangs one way and is pushed another", "[rod]") {
  // The largest rows, whose rod bends by a radian in three elements, are in the asymptotic range from 16 elements on.
  check<RoundRod>("wire_under_load", 8, 1e-4, 1e-5, 1e-5, 16);
  check<TwistedRod>("wire_under_load", 8, 1e-4, 1e-5, 1e-5, 16);
}
TEST_CASE("a bar between hinges that hangs one way and is pushed another", "[rod]") {
  check<RoundRod>("bar_two_ways", 16, 1e-5, 1e-6, 3e-5, 16);
  check<TwistedRod>("bar_two_ways", 16, 1e-5, 1e-6, 3e-5, 16);
}
TEST_CASE("a flat strip pushed askew bends and twists", "[rod]") {
  check<TwistedRod>("strip_askew", 8, 1.5e-3, 1e-4, 1e-5, 8);
}
// The reference's places are known to 2e-7 m, and the least depths are 0.5 and 1 mm: both meshes are as far from them.
TEST_CASE("a hook pushed out of its plane twists", "[rod]") {
  check<TwistedRod>("hook", 8, 2e-4, 1e-5, 2e-4, 8);
}
TEST_CASE("a spring compressed", "[rod]") { check<TwistedRod>("spring", 8, 2.5e-3, 2e-4, 4e-4, 8); }

// Bathe and Bolourchi, Large displacement analysis of three-dimensional beam structures, Int. J. Numer. Meth. Eng. 14 (1979): an
// arc of 45° under a force across its plane.  Tips by collocation of the same rod.
TEST_CASE("a 45-degree bend under a force across it", "[rod]") {
  const double length = 100 * pi / 4;
  const std::map<double, Point> tips = {{300, {58.7802, 22.2453, 40.1894}},
                                        {450, {52.2400, 18.5088, 48.5001}},
                                        {600, {47.1522, 15.6854, 53.4718}}};
  for (const auto& [force, tip] : tips) {
    Rod bend(length, RodStiffness{1e7, 1e7 / 12, 1e7 / 12, 5e6 / 6}, 1, RodSupport::clamped,
             RodSupport::free);
    bend.naturally({{length, 0, 0.01, 0}}).add({length, {0, 0, force}});
    const FemModel<TwistedRod> model(bend, 8);
    REQUIRE(model.rest().status == Status::ok);
    const Point start(100 * std::sin(pi / 4), 100 * (1 - std::cos(pi / 4)), 0),
        at = model.shape().at(length).r;
    INFO(force << ": " << (at - tip).norm() / (tip - start).norm());
    CHECK((at - tip).norm() <= 1e-4 * (tip - start).norm());
  }
}

namespace {

using System = RodSystem<TwistedRod, double, Eigen::Dynamic, Eigen::Dynamic>;

/// Where the tangent of an equilibrium first has a negative pivot.  @param stable  x -> whether it has none
template <class Stable>
double critical(double low, double high, Stable&& stable) {
  while (high - low > 1e-5 * high) {
    const double middle = (low + high) / 2;
    (stable(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

bool is_stable(System& system) {
  system.set_goal();
  REQUIRE(NewtonRaphson{}.solve(system).status == Status::ok);
  // A ring may roll about the line between its ends: the pivot of that is round-off of either sign.
  REQUIRE(system.factor(System::neutral()) == Status::ok);
  return system.negative_pivots() == 0;
}

}  // namespace

// Prandtl 1899: Timoshenko and Gere, Theory of Elastic Stability, 6.3.  High strips: EI2/EI1 bends them down by nothing.
TEST_CASE("a narrow cantilever buckles sideways under its tip load", "[rod]") {
  const double narrow = 2, torsion = 3, length = 1.5;
  const auto stable = [&](double load) {
    Rod strip(length, RodStiffness{1e9, narrow, 1e7, torsion}, 0.01, RodSupport::clamped, RodSupport::free);
    // Down is d1, about whose axis the strip is weak.
    strip.add({length, {0, -load, 0}});
    System system(strip, 16);
    return is_stable(system);
  };
  const double scale = std::sqrt(narrow * torsion) / (length * length);
  CHECK(critical(2 * scale, 6 * scale, stable) / scale == Approx(4.0126).epsilon(1e-3));
}

namespace {

/// A rod that is straight by nature, bent into a closed ring, its ends turned against each other.
struct Ring {
  static constexpr double length = 1, bending = 2, torsion = 1.5;
  RodPose pose;
  System system;

  Ring(int elements, double turned)
      : system(Rod(length, RodStiffness{1e7, bending, bending, torsion}, 0.01, RodSupport::clamped,
                   RodSupport::clamped),
               elements) {
    Rod bent(length, RodStiffness{1e7, bending, bending, torsion}, 0.01, RodSupport::clamped,
             RodSupport::clamped);
    bent.naturally({{length, 0, 2 * pi / length, 0}});
    const NaturalRod<double> natural(bent);
    System::State state(elements);
    system.keep(state);
    for (int i = 0; i <= elements; ++i) {
      state.nodes[i] = natural.at(length * i / elements);
      state.nodes[i].director =
          detail::turn(state.nodes[i].director, state.nodes[i].tangent, turned * i / elements);
    }
    system.set_state(state);
    system.chain().place_end(1, {{0, 0, 0}, {1, 0, 0}, {0, std::cos(turned), std::sin(turned)}});
  }
};

}  // namespace

// Michell 1889; Zajac, Stability of two planar loop elasticas, J. Appl. Mech. 29 (1962).
TEST_CASE("a ring buckles when its ends are turned by √3 EI/GJ turns", "[rod]") {
  const auto stable = [](double turns) {
    Ring ring(32, 2 * pi * turns);
    return is_stable(ring.system);
  };
  const double turns = std::sqrt(3) * Ring::bending / Ring::torsion;
  CHECK(critical(0.5 * turns, 1.5 * turns, stable) == Approx(turns).epsilon(1e-3));
}

TEST_CASE("a ring turned inside out keeps its energy", "[rod]") {
  Ring ring(12, 0);
  const double energy = ring.system.strain_energy();
  CHECK(energy == Approx(2 * pi * pi * Ring::bending / Ring::length).epsilon(1e-3));
  System::State state(12), turned(12);
  ring.system.keep(state);
  for (double angle = 0; angle < 7; angle += 0.7) {
    ring.system.keep(turned);
    for (int i = 0; i <= 12; ++i)
      turned.nodes[i].director =
          detail::turn(state.nodes[i].director, detail::unit(state.nodes[i].tangent), angle);
    ring.system.set_state(turned);
    CHECK(std::abs(ring.system.strain_energy() - energy) <= 1e-12 * energy);
  }
}
