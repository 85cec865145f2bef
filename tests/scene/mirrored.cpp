// Half of a beam says what the whole one does.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/scene/build.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEMPLATE_TEST_CASE("force and shape are those of the whole beam, with half of the elements", "[scene]",
                   VonKarman<>, Corotational<>) {
  const double apart = GENERATE(0.0, 1e-3);
  const Support end = GENERATE(Support::pinned, Support::clamped);
  const Beam beam = stretched(thesis_beam(end, end), apart);
  const double middle = thesis_length / 2;
  FemModel<TestType> whole(beam, 16);
  Mirrored<FemModel<TestType>> half(FemModel<TestType>(half_of(beam), 8), apart);
  for (const double d : {1e-3, -0.02, 0.1}) {
    const Response<double> a = whole.press({middle, d}), b = half.press({middle, d});
    REQUIRE(a.status == Status::ok);
    REQUIRE(b.status == Status::ok);
    // The solver's own tolerance, 1e-8 of √2V twice over.
    CHECK(relative_error(b.force, a.force) < 1e-7);
    const auto nodes = mesh_nodes(whole);
    REQUIRE(nodes.size() == 17);
    for (const auto& node : nodes) {
      const auto& same = half.shape()[half.shape().node_near(node.s)];
      CHECK(same.s == Approx(node.s).margin(1e-12));
      CHECK(std::abs(same.u - node.u) < 1e-8 * (std::abs(d) + apart));
      CHECK(std::abs(same.w - node.w) < 1e-8 * std::abs(d));
      CHECK(std::abs(same.theta - node.theta) < 1e-8);
    }
  }
}

TEST_CASE("beside the middle a mirrored beam is out of range", "[scene]") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  Mirrored<FemModel<>> half(FemModel<>(half_of(beam), 4));
  const double force = half.press({thesis_length / 2, 0.01}).force;
  const Response<double> beside = half.press({0.6 * thesis_length, 0.01});
  CHECK(beside.status == Status::out_of_range);
  CHECK(beside.force == Approx(force).epsilon(1e-7));
  CHECK(half.press({1.1 * thesis_length, 0.01}).status == Status::invalid_request);
}
