// Near an end: the shortest element, the straight tip that stands for shorter ones, and what a rigid support refuses.
#include <limits>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEST_CASE("the range keeps the shortest element from a rigid support and reaches a yielding end", "[ends]") {
  const double shortest = detail::shortest_element<double>(thesis_length);
  const FemModel<> pinned(thesis_beam(Support::pinned, Support::clamped), 8);
  CHECK(pinned.range().s_min == shortest);
  CHECK(pinned.range().s_max == thesis_length - shortest);
  const FemModel<> cantilever(thesis_beam(Support::clamped, Support::free), 8);
  CHECK(cantilever.range().s_min == shortest);
  CHECK(cantilever.range().s_max == thesis_length);
  const FemModel<> symmetric(thesis_beam(Support::guided, Support::roller), 8);
  CHECK(symmetric.range().s_min == 0);
  CHECK(symmetric.range().s_max == thesis_length - shortest);
}

// Against a unit clamped at its left: k = 3EI/s³ there, from which s follows to 1/3 of the force's error.
TEST_CASE("pressed at the shortest distance from a clamp the force is still 3EI d/s³, to its round-off",
          "[ends]") {
  const Beam beam = thesis_beam(Support::clamped, Support::free);
  const auto error = [&](auto model, int ratio) {
    using Scalar = typename decltype(model)::Scalar;
    const Scalar s = model.range().s_min * static_cast<Scalar>(ratio), d = model.range().depth_at(s) / 100;
    const Response<Scalar> response = model.press({s, d});
    REQUIRE(response.status == Status::ok);
    const double x = static_cast<double>(s);
    return relative_error(static_cast<double>(response.force),
                          3 * thesis_EI * static_cast<double>(d) / (x * x * x));
  };
  // shortest() keeps 12 eps (L/l)² below 1e-8 in double and 1e-4 in float.
  CHECK(error(FemModel<Linear>(beam, 8), 1) <= 1e-8);
  CHECK(error(FemModel<Linear>(beam, 8), 10) <= 1e-10);
  CHECK(error(FemModel<Linear, float>(beam, 8), 1) <= 1e-4);
  CHECK(error(FemModel<Linear, float>(beam, 8), 10) <= 1e-4);
}

// The short element beside a free end is far stiffer than the beam that it ends: 12EI/l³ against 3EI/L³, so
// that the last place of w, eps, becomes 4 eps (L/l)³ of the force: 9e-7 in double, 1.2e-2 in float.
TEST_CASE("beside a free end round-off of the force is at most 4 eps (L/l)³", "[ends]") {
  const Beam beam = thesis_beam(Support::clamped, Support::free);
  const auto worst = [&](auto model) {
    using Scalar = typename decltype(model)::Scalar;
    const Scalar length = static_cast<Scalar>(thesis_length), l = detail::shortest_element<Scalar>(length);
    double error = 0;
    for (int k = 1; k <= 50; ++k) {
      const Press<Scalar> press{length - l, static_cast<Scalar>(1e-3 * k)};
      const Response<Scalar> response = model.press(press);
      REQUIRE(response.status == Status::ok);
      const double s = static_cast<double>(press.s), d = static_cast<double>(press.d);
      error = std::max(error,
                       relative_error(static_cast<double>(response.force), 3 * thesis_EI * d / (s * s * s)));
    }
    return error /
           (4 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * std::pow(length / l, 3));
  };
  CHECK(worst(FemModel<Linear>(beam, 8)) <= 1);
  CHECK(worst(FemModel<Linear, float>(beam, 8)) <= 1);
}

// A clamped beam pressed at s is 3EI/s³ stiff, however close s is to the free end; across the border between the two ways
// of pressing there, too.  Linear, so that the closed form is exact; 4 eps (L/l)³ of round-off at the shortest element.
TEMPLATE_TEST_CASE("beside a free end the force is that of the place pressed, without a step", "[ends]",
                   double, float) {
  const TestType length = TestType(thesis_length), shortest = detail::shortest_element<TestType>(length);
  const TestType d = TestType(10e-3);
  const Beam beam = thesis_beam(Support::clamped, Support::free),
             mirrored = thesis_beam(Support::free, Support::clamped);
  FemModel<Linear, TestType> model(beam, 8), mirror(mirrored, 8);
  const double ratio = thesis_length / double(shortest);
  const double round_off = 4 * double(std::numeric_limits<TestType>::epsilon()) * ratio * ratio * ratio;
  const double straight_tip = 1 / (ratio * ratio * ratio);
  for (const double part : {0.0, 0.1, 0.5, 0.9, 0.999, 1.001, 1.1, 2.0}) {
    const TestType from_end = TestType(part) * shortest;
    const Response<TestType> right = model.press({length - from_end, d}), left = mirror.press({from_end, d});
    const double s = thesis_length - double(from_end);
    const double expected = 3 * beam.bending_stiffness() * double(d) / (s * s * s);
    INFO("at " << part << " of the shortest element from the end");
    CHECK((right.status == Status::ok && left.status == Status::ok));
    CHECK(relative_error(double(right.force), expected) <= round_off + straight_tip);
    CHECK(relative_error(double(left.force), expected) <= round_off + straight_tip);
  }
}

// Superposition: k = 3EI/s³ works on d less the sag, q s² (6L² - 4Ls + s²)/24EI.
TEST_CASE("a dead load beside a pressed free end is felt in full", "[ends]") {
  const double q = -200, d = 10e-3, length = thesis_length;
  Beam beam = thesis_beam(Support::clamped, Support::free);
  beam.transverse(q);
  FemModel<Linear> model(beam, 8);
  const double EI = beam.bending_stiffness(), shortest = detail::shortest_element<double>(length);
  for (const double part : {0.0, 0.3, 0.9}) {
    const double s = length - part * shortest, k = 3 * EI / (s * s * s);
    const double sag = q * s * s * (6 * length * length - 4 * length * s + s * s) / (24 * EI);
    const Response<double> response = model.press({s, d});
    REQUIRE(response.status == Status::ok);
    CHECK(relative_error(response.force, k * (d - sag)) <= 1e-8);  // (δ/L)³, and Newton's tolerance
  }
}

TEST_CASE("at or beside a rigid support a press is moved into range, and says so", "[ends]") {
  FemModel<> model(thesis_beam(Support::pinned, Support::clamped), 8);
  const Range<double> range = model.range();
  for (const double s : {0.0, range.s_min / 2, std::nextafter(range.s_min, 0.0), thesis_length,
                         std::nextafter(range.s_max, 3.0)}) {
    const Response<double> response = model.press({s, 1e-5});
    CHECK(response.status == Status::out_of_range);
    CHECK(std::isfinite(response.force));
  }
  CHECK(model.press({range.s_min, 1e-5}).status == Status::ok);
  CHECK(model.press({range.s_max, 1e-5}).status == Status::ok);
}
