// Near an end: the shortest element, what is rounded there, and what a rigid support refuses.
#include <limits>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEST_CASE("the range keeps the shortest element from a rigid support and reaches a yielding end", "[ends]") {
  const double shortest = ContactMesh<double>::shortest(thesis_length);
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
    const Scalar length = static_cast<Scalar>(thesis_length), l = ContactMesh<Scalar>::shortest(length);
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

TEST_CASE("closer to a free end than the shortest element a press is rounded to it or to that distance",
          "[ends]") {
  const Beam beam = thesis_beam(Support::clamped, Support::free);
  const double shortest = ContactMesh<double>::shortest(thesis_length), d = 10e-3;
  FemModel<> model(beam, 8);
  const auto force_at = [&](double from_end) {
    const Response<double> response = model.press({thesis_length - from_end, d});
    CHECK(response.status == Status::ok);
    return response.force;
  };
  const double at_end = force_at(0), beside = force_at(shortest), round_off = 9e-7;
  // A press is stiffer by 3 δs/s where it is nearer to the clamp, which tells the two places apart.
  CHECK(std::abs(beside / at_end - 1 - 3 * shortest / thesis_length) <= 0.01 * 3 * shortest / thesis_length);
  for (const double part : {0.1, 0.49}) CHECK(relative_error(force_at(part * shortest), at_end) <= round_off);
  for (const double part : {0.51, 0.9}) CHECK(relative_error(force_at(part * shortest), beside) <= round_off);
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
