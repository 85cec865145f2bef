// The shape at rest is that which the beam reaches when its loads rise from nothing, whatever other shapes there are.
#include "support/arch.hpp"
#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/elliptic.hpp"
#include "support/error.hpp"
#include "support/path.hpp"
#include "support/pi.hpp"
#include "support/status.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

Beam cantilever(double alpha, double EA) {
  Beam beam(1, EA, 1, 0.01, Support::clamped, Support::free);
  return beam.add({1, 0, alpha, 0});
}

/// Under a load at the middle, down.
Beam pressed_arch(double load) {
  Beam beam = arch(1, 0.1, Section{1e5, 1, 0.01}, Material{1}, Support::pinned);
  return beam.add({beam.length() * 0.5, 0, -load, 0});
}

}  // namespace

TEST_CASE("the slope of a cantilever's tip by elliptic integrals is that of the table", "[load-path]") {
  const Csv table("elastica_cantilever_tip_load.csv");
  for (std::size_t row = 0; row < table.rows(); ++row)
    CHECK(relative_error(cantilever_tip_slope(table.number(row, "alpha")),
                         table.number(row, "tip_slope_rad")) <= 1e-11);
}

// From α = 10.4 on there are shapes whose tip has turned the other way round; the nearest of them is more than 4 rad away.  On the
// branch what is left is the mesh's: fourth order in l √(P/EI), the bend beside the clamp.
TEMPLATE_TEST_CASE(
    "a cantilever under a tip load up to α = 40 is on the branch that begins without load, for any mesh",
    "[load-path]", double, float) {
  int cases = 0;
  for (int k = 1; k <= 80; ++k) {
    const double alpha = 0.5 * k, slope = cantilever_tip_slope(alpha);
    for (const int elements : {4, 5, 6, 8, 10, 12, 16, 23, 24, 31, 32, 48, 64}) {
      const double EA = elements % 2 ? 1e4 : 1e6;
      const FemModel<Corotational<>, TestType> model(cantilever(alpha, EA), elements);
      const double layer = std::sqrt(alpha) / elements,
                   tip = -double(model.shape()[model.shape().segments()].theta);
      ++cases;
      CAPTURE(alpha, elements, EA, tip, slope, model.rest().solves);
      CHECK(model.rest().status == Status::ok);
      CHECK(model.rest().solves <= 40);
      CHECK(std::abs(tip - slope) <= 0.01 * std::pow(layer, 4) + 2 * alpha / EA + 1e-6);
    }
  }
  CHECK(cases >= 1000);
}

TEST_CASE("a beam that hardly turns finds its rest in a few solves", "[load-path]") {
  for (const auto& [left, right] :
       {std::pair{Support::clamped, Support::free}, std::pair{Support::pinned, Support::roller},
        std::pair{Support::pinned, Support::pinned}, std::pair{Support::clamped, Support::clamped}})
    for (const double load : {0.0, 1e-3, 0.1}) {
      Beam beam(1, 1e4, 1, 0.03, left, right);
      beam.add({0.6, 0, load, 0});
      CAPTURE(name(left), name(right), load);
      CHECK(FemModel<Corotational<>>(beam, 16).rest().solves <= 6);
      CHECK(FemModel<>(beam, 16).rest().solves <= 6);
    }
}

// Where the arch gives way, by tilting, is known to another method: ArcLength goes on on the ridge and counts pivots.
TEST_CASE("an arch under more than it bears rests inverted, and says that it has snapped", "[load-path]") {
  System<Corotational<>> system(pressed_arch(1), 16);
  system.set_goal();
  double limit = 0;
  ArcLength arc;
  arc.first_step = arc.largest_step = 1e-3;
  const Status traced = arc.solve(system, [&](const auto&, const PathPoint& at) {
    limit = at.load;
    return at.negative_pivots == 0;
  });
  REQUIRE(traced == Status::ok);
  for (const double times : {0.1, 0.5, 0.9, 0.98, 1.02, 1.1, 1.5, 3.0}) {
    FemModel<Corotational<>> model(pressed_arch(times * limit), 16);
    const double middle = model.shape().at(model.shape().length() / 2).w;
    CAPTURE(limit, times, middle, model.rest().solves);
    CHECK(model.rest().status == (times < 1 ? Status::ok : Status::snapped));
    CHECK((times < 1 ? middle > 0.03 : middle < -0.08));
    // What it has fallen to is a shape to press.
    const double s = 0.4 * model.shape().length();
    CHECK(model.press({s, model.shape().at(s).w - 1e-3}).status == Status::ok);
  }
}

// Beyond Euler's load the straight column gives way, and the buckled one begins where it does: no jump.
TEST_CASE("a column under more than Euler's load stands aside as the elastica, and has not snapped",
          "[load-path]") {
  for (const double shortening : {0.01, 0.1, 0.2, 0.4}) {
    const BuckledElastica exact(shortening);
    Beam beam(1, 1e7, 1, 0.001, Support::pinned, Support::roller);
    beam.add({1, -exact.load * pi * pi, 0, 0});
    const FemModel<Corotational<>> model(beam, 16);
    const double middle = model.shape().at(0.5).w;
    CAPTURE(shortening, exact.load, middle, exact.middle, model.rest().solves);
    CHECK(model.rest().status == Status::ok);
    CHECK(relative_error(middle, exact.middle) <= 1e-3);
  }
}
