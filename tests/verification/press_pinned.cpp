// The reaction of a prescribed displacement between immovable hinges against the closed form, at five
// positions and seven depths up to twice the beam's thickness.
#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/error.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Largest relative force error over the rows of von_karman_press_pinned.csv with a depth up to the given
/// [mm], pressed from rest, both ways.
template <class Element, typename Scalar = double>
double worst_error(int elements, double deepest) {
  const Csv table("von_karman_press_pinned.csv");
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  FemModel<Element, Scalar> model(beam, elements);
  double worst = 0;
  std::size_t rows = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double depth = table.number(row, "depth_mm"), force = table.number(row, "force_N");
    if (depth > deepest) continue;
    ++rows;
    for (const double side : {1.0, -1.0}) {
      const Press<Scalar> press{
          static_cast<Scalar>(table.number(row, "position_over_length") * thesis_length),
          static_cast<Scalar>(side * 1e-3 * depth)};
      model.reset();
      const Response<Scalar> response = model.press(press);
      REQUIRE(response.status == Status::ok);
      worst = std::max(worst, relative_error(static_cast<double>(response.force), side * force));
    }
  }
  REQUIRE(rows == (deepest < 50 ? 20 : 35));
  return worst;
}

using Cubic = VonKarman<AssumedStrain>;

}  // namespace

// The table has twelve digits, and a press the solver's tolerance.
TEST_CASE("any number of segments presses to 50 mm as the closed form does", "[press][float]") {
  for (const int segments : {2, 8, 32}) CHECK(worst_error<VonKarman<>>(segments, 50) <= 1e-9);
  CHECK(worst_error<VonKarman<>, float>(8, 50) <= 32 * 1.2e-7);
}

TEST_CASE("8 cubic elements press to 5 mm within 3e-5 of the closed form", "[press]") {
  CHECK(worst_error<Cubic>(8, 5) <= 3e-5);
}

TEST_CASE("16 cubic elements press to 50 mm within 1e-3 of the closed form", "[press]") {
  CHECK(worst_error<Cubic>(16, 50) <= 1e-3);
}

TEST_CASE("32 cubic elements press to 50 mm within 1e-4 of the closed form", "[press]") {
  CHECK(worst_error<Cubic>(32, 50) <= 1e-4);
}

// At 50 mm the boundary layer, √(EI/N) = 0.15 m, is as long as two elements of 32: there the order begins to
// show.
TEST_CASE("the error of a press falls with the fourth power of the element", "[press]") {
  CHECK(observed_order(worst_error<Cubic>(32, 50), worst_error<Cubic>(64, 50)) >= 3.8);
}

// 3e-5 of the elements, and round-off of at most 4 eps (L/l)³ = 4.8e-4 where the shortest element is 0.1 L:
// less than 1e-3.
TEST_CASE("in float 8 cubic elements press to 5 mm within 1e-3 of the closed form", "[press][float]") {
  CHECK(worst_error<Cubic, float>(8, 5) <= 3e-5 + 4.8e-4);
}
