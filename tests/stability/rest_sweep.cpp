// Any beam finds its rest: random sections, ends, prestress, natural arcs and dead loads, 4 to 512 elements, moderate and
// any rotation.
#include <optional>
#include <stdexcept>
#include <string>

#include "support/catch.hpp"
#include "support/random_beam.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEMPLATE_TEST_CASE("two thousand random beams find their rest", "[rest]", VonKarman<>, Corotational<>) {
  Random random(2026);
  int snapped = 0, most = 0, refused = 0;
  long solves = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Beam beam = any_beam(random);
    const int elements = static_cast<int>(log_even(random, 4, 512));
    const FemModel<TestType> model(beam, elements);
    CAPTURE(trial, elements, name(beam.left()), name(beam.right()), beam.length() / beam.thickness());
    CHECK(is_answer(model.rest().status));
    snapped += model.rest().status == Status::snapped;
    solves += model.rest().solves;
    most = std::max(most, model.rest().solves);
    if (elements > 32) continue;
    // In float it is the same shape, or the model is refused because its tangent has no digits left.
    std::optional<FemModel<TestType, float>> made;
    try {
      made.emplace(beam, elements);
    } catch (const std::invalid_argument& error) {
      CHECK(std::string(error.what()).find("too many for this beam") != std::string::npos);
      ++refused;
      continue;
    }
    const FemModel<TestType, float>& rounded = *made;
    CHECK(rounded.rest().status == model.rest().status);
    const double eps = 1.2e-7, L = beam.length();
    double off = 0;
    for (int i = 0; i <= elements; ++i)
      off = std::max(off, std::abs(static_cast<double>(rounded.shape()[i].w) - model.shape()[i].w) / L);
    CHECK(off <= 4 * eps);
  }
  CAPTURE(solves / 2000, most, snapped, refused);
  CHECK(snapped <= 40);  // few: arcs that prestress or loads turn inside out
  CHECK(solves <= 2000 * 80);
  CHECK(refused <= 10);  // of some 850 with 32 elements or fewer
}

// The loads choose the side: nothing snaps on the way.  Before, each strip bowed up first, and fell when its weight had grown.
TEST_CASE("a catenary hangs to where its weight pushes it, and nothing has snapped", "[rest]") {
  for (const int elements : {8, 9, 15, 16, 33, 64})
    for (const double slack : {0.001, 0.01, 0.05, 0.2, 0.5})
      for (const double load : {0.01, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5})
        for (const Support end : {Support::pinned, Support::clamped}) {
          const auto hang = [&](double weight) {
            Beam beam(1, Section::rectangle(0.01, 0.001), Material{2e9}, end, end);
            beam.place({}, {-slack, 0, 0}).transverse(weight * beam.bending_stiffness());
            return FemModel<Corotational<>>(beam, elements);
          };
          const FemModel<Corotational<>> down = hang(-load), up = hang(load);
          CAPTURE(elements, slack, load, name(end), down.rest().solves);
          CHECK(down.rest().status == Status::ok);
          CHECK(up.rest().status == Status::ok);
          CHECK(down.shape().at(0.5).w < 0);
          CHECK(std::abs(down.shape().at(0.5).w + up.shape().at(0.5).w) <= 1e-9);
        }
}
