// The reference that the reduced models are held against agrees with independent numbers.
#include "support/closed_form.hpp"

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/error.hpp"
#include "support/thesis_beam.hpp"

using namespace hapbeam::testing;

TEST_CASE("the series of the pinned press gives the tabulated forces and tensions", "[press]") {
  const Csv table("von_karman_press_pinned.csv");
  REQUIRE(table.rows() == 35);
  PinnedPress closed_form(thesis_length, thesis_EA, thesis_EI);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double force = closed_form(table.number(row, "position_over_length") * thesis_length,
                                     1e-3 * table.number(row, "depth_mm"));
    // Printed with twelve digits, found with scipy's root finder.
    CHECK(relative_error(force, table.number(row, "force_N")) <= 1e-9);
    CHECK(relative_error(closed_form.tension(), table.number(row, "tension_N")) <= 1e-8);
  }
}
