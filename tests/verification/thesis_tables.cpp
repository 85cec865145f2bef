// The thesis' printed numbers: Tables 3.1 and 3.2, four elements on half of the beam, guided at mid-span.
// A number agrees "to all printed digits" where it lies within half a unit of the last one; the round-off of
// a solve (1e-10 relative) is added because some printed numbers, such as 0.73125, are ties.
#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/mesh_nodes.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr int elements = 4;
constexpr double round_off = 1e-9;

}  // namespace

TEST_CASE("Table 3.1 of the thesis is met in all printed digits", "[thesis]") {
  const Csv table("thesis_table_3_1.csv");
  REQUIRE(table.rows() == 12);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Beam beam = thesis_half(Support::roller);
    beam.transverse(-1e3 * table.number(row, "load_N_per_mm"));
    const FemModel<> model(beam, elements);
    REQUIRE(model.rest().status == Status::ok);
    const double midspan = 1e3 * mesh_node(model, elements).w, printed = table.number(row, "midspan_mm");
    INFO("load " << table.text(row, "load_N_per_mm") << " N/mm: " << midspan << " mm, printed " << printed);
    CHECK(std::abs(midspan - printed) <= table.half_unit(row, "midspan_mm") + round_off);
  }
}

TEST_CASE("the FEM columns of Table 3.2 are met in all printed digits", "[thesis]") {
  const Csv table("thesis_table_3_2.csv");
  REQUIRE(table.rows() == 3 * (elements + 1));
  const Beam beam = thesis_half(Support::roller);
  const double half_unit = 0.5e-4;  // mm and rad, printed with four decimals
  for (const char* depth : {"0.5", "0.8", "4", "3.75", "8"}) {
    FemModel<> model(beam, elements);
    REQUIRE(model.press({beam.length(), -1e-3 * std::stod(depth)}).status == Status::ok);
    const std::string column = std::string("fem_") + depth;
    for (int i = 0; i <= elements; ++i) {
      const std::size_t first = 3 * static_cast<std::size_t>(i);  // u, w, theta
      const auto& node = model.shape()[i];
      INFO("pressed " << depth << " mm, node " << i << ": w " << 1e3 * node.w << " mm, theta " << node.theta);
      CHECK(std::abs(1e3 * node.w - table.number(first + 1, column)) <= half_unit + round_off);
      CHECK(std::abs(node.theta - table.number(first + 2, column)) <= half_unit + round_off);
    }
  }
}

// The printed axial displacements are 0.  That is the linear answer; the von Kármán beam slides over its
// roller by what its slope takes up, ½∫w'² = (3/5) d²/L of the half beam with w the cubic 3ξ - ξ³ of a load
// at mid-span: 0.030 mm at d = 8 mm.  Its membrane force is zero, which is why the other columns are those of
// the linear beam.
TEST_CASE("the axial displacements of Table 3.2 are zero in the linear beam and u' = -w'²/2 in von Kármán's",
          "[thesis]") {
  const Beam beam = thesis_half(Support::roller);
  for (const double depth : {0.5e-3, 0.8e-3, 4e-3, 3.75e-3, 8e-3}) {
    FemModel<Linear> linear(beam, elements);
    FemModel<> moderate(beam, elements);
    REQUIRE(linear.press({beam.length(), -depth}).status == Status::ok);
    REQUIRE(moderate.press({beam.length(), -depth}).status == Status::ok);
    for (const auto& node : linear.shape()) CHECK(node.u == 0);
    const double slide = 0.6 * depth * depth / beam.length();
    CHECK(std::abs(moderate.shape()[0].u - slide) <= 1e-8 * slide);  // the solver's tolerance
    CHECK(moderate.shape()[elements].u == 0);
  }
}
