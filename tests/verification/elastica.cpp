// A cantilever under a dead tip load against the elastica, and how fast elements of any rotation come to it.
//
// elastica_cantilever_tip_load.csv is the closed form in elliptic integrals of an inextensible beam, with
// α = PL²/EI.  A beam that stretches is off by about P/EA: EA L²/EI = 1e8 leaves 1e-7, which the bounds at 8 elements do
// not see, and 1e10 leaves 1e-9, a hundredth of what 32 elements leave.
#include <array>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// L = EI = 1, so that the tip load is α.
Beam cantilever(double alpha, double EA) {
  Beam beam(1, EA, 1, 0.01, Support::clamped, Support::free);
  return beam.add({1, 0, alpha, 0});
}

/// Relative errors of the tip.
struct Errors {
  double across, along, slope;
};

template <class Element>
Errors tip_errors(const Csv& table, std::size_t row, int elements, double EA) {
  const Beam beam = cantilever(table.number(row, "alpha"), EA);
  const FemModel<Element> model(beam, elements, patient_solver());
  REQUIRE(model.rest().status == Status::ok);
  const auto tip = mesh_node(model, elements);
  return {relative_error(tip.w, table.number(row, "transverse_over_length")),
          relative_error(-tip.u, table.number(row, "shortening_over_length")),
          relative_error(-tip.theta, table.number(row, "tip_slope_rad"))};
}

}  // namespace

TEST_CASE("elastica: 8 elements meet the tip of the cantilever to 2e-5 up to α = 5 and to 5e-5 at 10",
          "[elastica]") {
  const Csv table("elastica_cantilever_tip_load.csv");
  REQUIRE(table.rows() == 7);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double alpha = table.number(row, "alpha"), bound = alpha <= 5 ? 2e-5 : 5e-5;
    const Errors error = tip_errors<Corotational<>>(table, row, 8, 1e8);
    CAPTURE(alpha, error.across, error.along, error.slope);
    CHECK(error.across <= bound);
    CHECK(error.along <= bound);
    CHECK(error.slope <= bound);
  }
}

TEST_CASE("elastica: the default element is of fourth order, 8 to 16 to 32 elements", "[elastica]") {
  const Csv table("elastica_cantilever_tip_load.csv");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double alpha = table.number(row, "alpha");
    if (alpha < 1) continue;  // 1e-9 of stretch shows in shortenings of 1e-2
    std::array<Errors, 3> error{};
    for (std::size_t k = 0; k < 3; ++k) error[k] = tip_errors<Corotational<>>(table, row, 8 << k, 1e10);
    for (std::size_t k = 0; k < 2; ++k) {
      const double across = observed_order(error[k].across, error[k + 1].across),
                   along = observed_order(error[k].along, error[k + 1].along),
                   slope = observed_order(error[k].slope, error[k + 1].slope);
      CAPTURE(alpha, 8 << k, across, along, slope, error[2].across, error[2].along, error[2].slope);
      CHECK(across >= 3.8);
      CHECK(along >= 3.8);
      CHECK(slope >= 3.8);
    }
  }
}

// Linear in its own frame an element takes its chord for its length.  (The shortening's error changes sign near α = 10 and
// shows no order.)
TEST_CASE("elastica: with the textbooks' linear local part the order is two, and 8 elements leave 2.3e-3",
          "[elastica]") {
  const Csv table("elastica_cantilever_tip_load.csv");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double alpha = table.number(row, "alpha");
    std::array<Errors, 3> error{};
    for (std::size_t k = 0; k < 3; ++k) error[k] = tip_errors<Corotational<Linear>>(table, row, 8 << k, 1e10);
    CAPTURE(alpha, error[0].across, error[1].across, error[2].across);
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(std::abs(observed_order(error[k].across, error[k + 1].across) - 2) <= 0.1);
      CHECK(std::abs(observed_order(error[k].slope, error[k + 1].slope) - 2) <= 0.1);
    }
    if (alpha == 10) CHECK(std::abs(error[0].across - 2.3e-3) <= 0.05e-3);
  }
}

// Sampled in the middle, where a bent element has no slope against its chord, the membrane strain misses as much.
TEST_CASE("elastica: with a reduced local part the order is two as well", "[elastica]") {
  const Csv table("elastica_cantilever_tip_load.csv");
  const std::size_t row = table.rows() - 1;
  REQUIRE(table.number(row, "alpha") == 10);
  const double at_8 = tip_errors<Corotational<VonKarman<ReducedIntegration>>>(table, row, 8, 1e8).across,
               at_16 = tip_errors<Corotational<VonKarman<ReducedIntegration>>>(table, row, 16, 1e8).across;
  CHECK(std::abs(observed_order(at_8, at_16) - 2) <= 0.1);
}

// A fine mesh is the hard one: its elements are stiff against each other, and the whole way is one load.
TEST_CASE("elastica: 1024 elements get from rest to α = 5 and 10 in at most 60 linear solves", "[elastica]") {
  const Csv table("elastica_cantilever_tip_load.csv");
  for (std::size_t row = table.rows() - 2; row < table.rows(); ++row)
    for (const double EA : {1e6, 1e8}) {
      const double alpha = table.number(row, "alpha");
      const FemModel<Corotational<>> model(cantilever(alpha, EA), 1024);
      const int solves = model.rest().solves, steps = model.rest().steps;
      const double across =
          relative_error(mesh_node(model, 1024).w, table.number(row, "transverse_over_length"));
      CAPTURE(alpha, EA, solves, steps, across);
      CHECK(model.rest().status == Status::ok);
      CHECK(solves <= 60);
      // The stretch, α/EA, and round-off of eps n² = 2e-10 in the solver's tolerance.
      CHECK(across <= alpha / EA + 1e-8);
    }
}
