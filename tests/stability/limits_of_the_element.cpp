// Where the elements stop being true, as numbers: locking, large rotation, a load inside an element.
// Each is a documented limit.  A test that fails here says that a limit has moved, for better or worse.
#include <algorithm>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/solver.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

template <class Element>
double midspan_on_rollers(double load, int elements) {
  Beam beam = thesis_half(Support::roller);
  beam.transverse(load);
  const FemModel<Element> model(beam, elements);
  REQUIRE(model.rest().status == Status::ok);
  return mesh_node(model, elements).w;
}

}  // namespace

// Rollers slide, so nothing should be stretched.  A strain that varies within the element cannot vanish.
TEST_CASE("full integration locks: 3.2051 in where the beam bends by 5.2083 in", "[locking]") {
  const double load = 10 * lbf / inch;
  CHECK(std::abs(midspan_on_rollers<VonKarman<FullIntegration>>(load, 4) / inch - 3.2051) <= 0.5e-4);
  CHECK(std::abs(midspan_on_rollers<VonKarman<AssumedStrain>>(load, 4) / inch - 5.2083) <= 0.5e-4);
  // Refinement is its only cure, and sets in late: order 2 once the strain that is left over is small against
  // bending's.
  std::vector<double> errors;
  for (const int elements : {4, 8, 16, 32, 64})
    errors.push_back(relative_error(midspan_on_rollers<VonKarman<FullIntegration>>(load, elements),
                                    midspan_on_rollers<Linear>(load, elements)));
  INFO(errors[0] << ' ' << errors[1] << ' ' << errors[2] << ' ' << errors[3] << ' ' << errors[4]);
  CHECK(std::is_sorted(errors.rbegin(), errors.rend()));
  CHECK(observed_order(errors[0], errors[1]) < 1);
  CHECK(observed_order(errors[3], errors[4]) > 1.8);
}

// roller_uniform_load.csv, elastica_midspan_mm: an inextensible beam of any rotation.
TEST_CASE("moderate rotation leaves the elastica: 0.2 % at 0.7 N/mm, 9 % at 4.7, 34 % at 10, 63 % at 15",
          "[rotation]") {
  const Csv table("roller_uniform_load.csv");
  int found = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double load = table.number(row, "load_N_per_mm");
    const double w = 1e3 * midspan_on_rollers<VonKarman<>>(1e3 * load, 4);
    CHECK(relative_error(w, table.number(row, "von_karman_midspan_mm")) <= 1e-8);
    const double error = w / table.number(row, "elastica_midspan_mm") - 1;
    CHECK(error > 0);  // too soft, always
    const auto printed = [&](double at, double percent, double half_unit) {
      if (load != at) return;
      ++found;
      INFO(load << " N/mm: " << 100 * error << " %");
      CHECK(std::abs(100 * error - percent) <= half_unit);
    };
    printed(0.7, 0.2, 0.05);
    printed(4.7, 9, 0.5);
    printed(10, 34, 0.5);
    printed(15, 63, 0.5);
  }
  CHECK(found == 4);
}

// w''' jumps under a point force and a cubic has no jump: inside an element the deflection there is short of
// that of the element clamped at both ends, P l³ / 192 EI in its middle.  At a node nothing is missing.  That
// is why a point load has one as long as there are elements.
TEST_CASE("a point force costs nothing at its node, and P l³ / 192 EI of deflection where it has none",
          "[point force]") {
  const double P = 100, L = thesis_length;
  for (const int elements : {2, 3, 4, 5, 8, 9, 16, 17}) {
    Beam beam = thesis_beam(Support::clamped, Support::clamped);
    const FemModel<Linear> model(beam.add({L / 2, 0, P, 0}), elements);
    CHECK(relative_error(model.shape().at(L / 2).w, P * L * L * L / (192 * thesis_EI)) <= 1e-12);
  }
  Beam three = thesis_beam(Support::clamped, Support::clamped);
  for (const double s : {L / 4, L / 2, 3 * L / 4}) three.add({s, 0, P, 0});
  const FemModel<Linear> coarse(three, 2), exact(three, 4);
  const double l = L / 2, missing = P * l * l * l / (192 * thesis_EI);
  for (const double s : {L / 4, 3 * L / 4})
    CHECK(relative_error(exact.shape().at(s).w - coarse.shape().at(s).w, missing) <= 1e-12);
}

// A contact within an element is as exact as a dead force at its node.
TEST_CASE("a hand feels the dead force that holds its place where it is", "[point force]") {
  const double s = 0.3 * thesis_length, depth = 5e-3, exact = 169.584954088;  // von_karman_press_pinned.csv
  FemModel<> pressed(thesis_beam(Support::pinned, Support::pinned), 8, tight_solver());
  CHECK(relative_error(pressed.press({s, depth}).force, exact) <= 1e-5);
  // A dead force that moves its own point by the same depth, found by secants.
  const auto reached = [&](double force) {
    Beam beam = thesis_beam(Support::pinned, Support::pinned);
    beam.add({s, 0, force, 0});
    return FemModel<>(beam, 8, tight_solver()).shape().at(s).w;
  };
  double a = 0.9 * exact, b = 1.1 * exact, wa = reached(a), wb = reached(b);
  for (int k = 0; k < 20 && std::abs(wb - depth) > 1e-12; ++k) {
    const double c = b + (depth - wb) * (b - a) / (wb - wa);
    a = b, wa = wb, b = c, wb = reached(c);
  }
  REQUIRE(std::abs(wb - depth) <= 1e-12);
  CHECK(relative_error(b, exact) <= 1e-5);
}
