// The number of elements: fixed, bounded or free, checked where it enters, and no part of the answer.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
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

// The condition of the bending stiffness is the fourth power of the elements: tests/stability/round_off.cpp.
TEST_CASE("more elements than round-off allows are refused with how many it allows, and that many answer",
          "[size]") {
  using Single = FemModel<VonKarman<>, float>;
  for (const auto& [left, right] :
       {std::pair(Support::pinned, Support::pinned), std::pair(Support::clamped, Support::roller),
        std::pair(Support::clamped, Support::free)}) {
    const Beam beam = thesis_beam(left, right);
    CAPTURE(name(left), name(right));
    CHECK_THROWS_WITH(Free(beam, 65536),
                      ContainsSubstring("elements = 65536") &&
                          ContainsSubstring("at most " + std::to_string(Free::most_elements(beam))));
    CHECK_THROWS_AS(Single(beam, Single::most_elements(beam) + 1), std::invalid_argument);
    Free reference(beam, 64), finest(beam, Free::most_elements(beam));
    Single single(beam, Single::most_elements(beam));
    const Press<double> press{1.0, 5e-3};
    const double force = reference.press(press).force;
    const Response<double> fine = finest.press(press);
    const Response<float> coarse = single.press({1.0f, 5e-3f});
    CHECK(fine.status == Status::ok);
    CHECK(relative_error(fine.force, force) <= 1e-4);
    CHECK(coarse.status == Status::ok);
    CHECK(relative_error(coarse.force, force) <= 1e-2);
  }
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

// Sizes that are finite one by one and leave nothing to compute with.
TEST_CASE("a beam whose length or shape at rest the scalar does not hold is refused", "[fem]") {
  const auto beam = [](double length) {
    return Beam(length, 5e6, 0.4, 1e-3, Support::clamped, Support::pinned);
  };
  const Beam placed = beam(0.3).place({}, {1e40, 0, 0});
  CHECK_THROWS_AS((FemModel<Corotational<>, float>(placed, 8)), std::invalid_argument);
  CHECK_THROWS_AS((FemModel<VonKarman<>, float>(beam(1e308), 8)), std::invalid_argument);
  CHECK_THROWS_AS(FemModel<>(beam(1e308), 8), std::invalid_argument);
  CHECK_THROWS_AS((FemModel<Corotational<>, float>(beam(1e-200), 8)), std::invalid_argument);
  CHECK_NOTHROW(FemModel<Corotational<>, float>(beam(0.3), 8));
}
