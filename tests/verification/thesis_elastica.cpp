// The load cases of the thesis' Table 3.1 against the beam that they mean: roller_uniform_load.csv, columns elastica_*,
// an inextensible beam on rollers under a dead uniform load, solved as a boundary-value problem.
//
// Half of the beam, symmetric at mid-span.  The bar stretches by up to N/EA with N <= qL/2, the load on one roller: 1.4e-4
// at 15 N/mm.  With EA a hundredfold 1.4e-6 of that is left.
#include <array>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/solver.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Relative errors of one row, and how much the beam is stretched at most.
struct Errors {
  double midspan, end_slope, end_slide, stretch, slide_by_stretch;
};

template <class Element = Corotational<>>
Errors errors(const Csv& table, std::size_t row, double stiffer, int elements) {
  const double q = 1e3 * table.number(row, "load_N_per_mm"), EA = stiffer * thesis_EA;
  Beam beam(thesis_length / 2, EA, thesis_EI, inch, Support::roller, Support::guided);
  const FemModel<Element> model(beam.transverse(q), elements, patient_solver());
  REQUIRE(model.rest().status == Status::ok);
  const auto end = model.shape()[0], middle = mesh_node(model, elements);
  const double slope = table.number(row, "elastica_end_slope_rad"),
               slide = 1e-3 * table.number(row, "elastica_end_slide_mm"),
               stretch = q * thesis_length / 2 / EA;
  return {relative_error(1e3 * middle.w, table.number(row, "elastica_midspan_mm")),
          relative_error(-end.theta, slope), relative_error(end.u, slide), stretch,
          stretch * slope * thesis_length / 2 / slide};
}

}  // namespace

TEST_CASE("all 12 load cases of the thesis: 8 elements meet the elastica to 1e-3, and to the bar's stretch",
          "[elastica][thesis]") {
  const Csv table("roller_uniform_load.csv");
  REQUIRE(table.rows() == 12);
  double worst = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Errors error = errors(table, row, 1, 8);
    CAPTURE(table.text(row, "load_N_per_mm"), error.midspan, error.end_slope, error.end_slide);
    worst = std::max(worst, error.midspan);
    CHECK(error.midspan <= 1e-3);
    CHECK(error.midspan <= error.stretch);
    CHECK(error.end_slope <= error.stretch);
  }
  CAPTURE(worst);
  CHECK(worst <= 1e-4);
}

// End slides go with the square of the deflection, and lose what the normal force, at most qL/2 times the end slope,
// stretches the half by.
TEST_CASE("with EA a hundredfold 32 elements meet all 12 load cases to 5e-5, and to the stretch that is left",
          "[elastica][thesis]") {
  const Csv table("roller_uniform_load.csv");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Errors error = errors(table, row, 100, 32);
    CAPTURE(table.text(row, "load_N_per_mm"), error.midspan, error.end_slope, error.end_slide, error.stretch);
    CHECK(error.midspan <= 5e-5);
    CHECK(error.midspan <= error.stretch);
    CHECK(error.end_slope <= error.stretch);
    CHECK(error.end_slide <= 4 * error.stretch + error.slide_by_stretch);
  }
}

// The loads' arms turn with the beam.  Held as moments they made this second order: 8e-4 at 8 elements and 15 N/mm.
TEST_CASE("under the uniform load the default element is of fourth order, the textbooks' of second",
          "[elastica][thesis]") {
  const Csv table("roller_uniform_load.csv");
  for (const std::size_t row : {std::size_t(9), std::size_t(10), std::size_t(11)}) {
    std::array<Errors, 3> fourth{}, second{};
    for (std::size_t k = 0; k < 3; ++k) {
      fourth[k] = errors(table, row, 1e5, 4 << k);
      second[k] = errors<Corotational<Linear>>(table, row, 1e5, 4 << k);
    }
    CAPTURE(table.text(row, "load_N_per_mm"), fourth[0].midspan, fourth[1].midspan, fourth[2].midspan,
            fourth[0].end_slope, fourth[1].end_slope, fourth[2].end_slope, second[0].midspan,
            second[1].midspan, second[2].midspan);
    CHECK(fourth[1].midspan <= 2e-6);
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(observed_order(fourth[k].midspan, fourth[k + 1].midspan) >= 3.8);
      CHECK(observed_order(fourth[k].end_slope, fourth[k + 1].end_slope) >= 3.8);
      CHECK(std::abs(observed_order(second[k].midspan, second[k + 1].midspan) - 2) <= 0.2);
    }
  }
}
