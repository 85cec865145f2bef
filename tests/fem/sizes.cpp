// The number of elements: fixed, bounded or free, checked where it enters, and no part of the answer.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

using Fixed = FemModel<VonKarman<>, double, 8>;
using Bounded = FemModel<VonKarman<>, double, Eigen::Dynamic, 16>;
using Free = FemModel<>;

}  // namespace

TEST_CASE("a number of elements that does not fit the type is refused by name and with what is allowed",
          "[size]") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  CHECK_THROWS_AS(Free(beam, 1), std::invalid_argument);
  CHECK_THROWS_WITH(Free(beam, 1), ContainsSubstring("elements = 1") && ContainsSubstring("2 or more"));
  CHECK_THROWS_WITH(Free(beam, -3), ContainsSubstring("elements = -3"));
  CHECK_THROWS_WITH(Fixed(beam, 7), ContainsSubstring("elements = 7") && ContainsSubstring("must be 8"));
  CHECK_THROWS_WITH(Bounded(beam, 17), ContainsSubstring("elements = 17") && ContainsSubstring("2 to 16"));
  CHECK_THROWS_WITH(Bounded(beam, 1), ContainsSubstring("elements = 1"));
}

TEST_CASE("fixed, bounded and free sizes give the same force", "[size]") {
  const Beam beam = thesis_beam(Support::clamped, Support::pinned);
  Fixed fixed(beam, 8);
  Bounded bounded(beam, 8);
  Free dynamic(beam, 8);
  for (int k = 1; k < 20; ++k) {
    const Press<double> press{k * thesis_length / 20, 1e-3 * k};
    const double force = dynamic.press(press).force;
    // The compiler may unroll and fuse differently.
    CHECK(relative_error(fixed.press(press).force, force) <= 1e-12);
    CHECK(relative_error(bounded.press(press).force, force) <= 1e-12);
  }
}

TEST_CASE("a copy is a beam of its own", "[size]") {
  Free one(thesis_beam(Support::pinned, Support::pinned), 8);
  const double force = one.press({1.0, 3e-3}).force;
  Free other = one;
  other.press({0.5, -8e-3});
  CHECK(one.shape()[4].w > 0);
  CHECK(other.shape()[4].w < 0);
  CHECK(one.press({1.0, 3e-3}).force == Approx(force).epsilon(1e-9));
}
