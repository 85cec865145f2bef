// Where contact fails as it is first written: at the nearest node, next to a support, past the end, and in between two ticks.
// limits_of_the_element.cpp has the force inside an element, ends.cpp the shortest element, tests/contact the rest.
#include <cmath>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/naive_contact.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = thesis_length;

/// A steel ruler of 300 × 30 × 1 mm, clamped at its left.
Beam ruler() {
  return Beam(0.3, Section::rectangle(0.03, 0.001), Material{thesis_young}, Support::clamped, Support::free);
}

}  // namespace

// Of the linear beam, k = 3EI L/s²(L - s)²: what half an element makes of it is geometry, and most half an element beyond
// the first node, (3·13/2·14)² = 1.94.
TEST_CASE("pressed at the nearest node a beam is up to 90 % too stiff, and rigid next to a support",
          "[contact]") {
  FemModel<Linear> model(thesis_beam(Support::pinned, Support::pinned), 8);
  const auto stiffness = [](double s) { return 3 * thesis_EI * L / (s * s * (L - s) * (L - s)); };
  const double d = 1e-5, half = L / 16;
  double worst = 0;
  for (int k = 1; k < 100; ++k) {
    const double s = L * k / 200, node = L / 8 * std::round(8 * s / L);
    const Response<double> response = model.press({s, d});
    REQUIRE(response.status == Status::ok);
    CHECK(relative_error(response.force, stiffness(s) * d) <= 1e-8);
    if (s > half) worst = std::max(worst, relative_error(stiffness(node), stiffness(s)));
    else CHECK(node == 0);  // a support is no spring
  }
  CHECK((worst >= 0.85 && worst <= 0.94));
}

// A tenth of the length, a thousandth of it from a hinge: a slope of a hundred, of which moderate rotation makes -½w'² of
// stretch.
TEST_CASE("next to a support a depth is a slope: the beam's other end would be a kilometre away",
          "[contact]") {
  const Beam beam = thesis_beam(Support::pinned, Support::roller);
  const Press<double> press{L / 1000, L / 10};
  BeamSystem<VonKarman<AssumedStrain>, double, Eigen::Dynamic, Eigen::Dynamic> system(beam, 8);
  system.set_goal(Push<double>{press.s, press.d, {0, 1}});
  CHECK(NewtonRaphson{}.solve(system).status == Status::ok);
  CHECK(system.node(8).u < -1000);

  FemModel<> model(beam, 8);
  const Response<double> response = model.press(press);
  CHECK(response.status == Status::out_of_range);
  CHECK(std::abs(model.shape().at(press.s).w) <= press.s / 2 * (1 + 1e-12));
  CHECK(std::abs(model.shape().at(L).u) <= L / 10);
}

// The hand is led along 10 mm below the ruler's rest, out over its end and on.
TEST_CASE("held to its end a beam presses a hand that has passed it; contact slips off a reach behind",
          "[contact]") {
  constexpr double radius = 0.005, reach = radius + 0.0005, depth = -0.01;
  const auto check = [&](auto model) {
    using Model = decltype(model);
    Model held(model);
    Touch<Model> touch(model, radius);
    for (int k = 0; k <= 100; ++k) (void)touch.tick({0.28, 0.02 + (depth - 0.02) * k / 100});
    double before = 0;
    for (int k = 0; k <= 600; ++k) {
      const double x = 0.28 + 1e-4 * k;
      const TouchResult<double> result = touch.tick({x, depth});
      CAPTURE(x, result.force.x(), result.force.y());
      CHECK(clamped_press(held, {x, depth}, reach) > 0.5);
      if (x < 0.3) CHECK(result.pressing);
      if (x > 0.3 + reach) CHECK((!result.pressing && result.force.isZero(0)));
      // What lifts the hand fades all the way.
      if (k > 0) CHECK(result.force.y() <= before);
      before = result.force.y();
    }
  };
  check(FemModel<>(ruler(), 16));
  check(FemModel<Corotational<>>(ruler(), 16));
}

// Half of its thickness in a tick is 0.5 m/s at 1 kHz: no more than a quick hand.
TEST_CASE("without a memory a point passes a ruler at 1.1 m/s; with one it is held at any speed",
          "[contact]") {
  const FemModel<Corotational<>> resting(ruler(), 16);
  const double reach = 0.0005;
  int wrong[2]{}, missed[2]{};
  for (int phase = 0; phase < 100; ++phase)
    for (const int quick : {0, 1}) {
      const double step = quick ? 1.1e-3 : 0.45e-3, begin = 0.02 + step * phase / 100;
      const Found found = fall_onto(resting, 0.15, begin, step, 0);
      wrong[quick] += found == Found::lower_side;
      missed[quick] += found == Found::nothing;
    }
  CHECK(wrong[0] + missed[0] == 0);
  CHECK(wrong[1] >=
        40);  // of 100: in all but 0.1 mm of each 1.1 the first place inside is beyond the middle, or none
  CHECK(missed[1] >= 5);
  for (const double speed : {0.5, 1.0, 5.0, 20.0})
    for (int phase = 0; phase < 10; ++phase) {
      FemModel<Corotational<>> model(ruler(), 16);
      Touch<FemModel<Corotational<>>> touch(model, 0);
      const double step = 1e-3 * speed;
      for (double y = 0.02 + step * phase / 10; y > -0.02; y -= step) {
        const TouchResult<double> result = touch.tick({0.15, y});
        CAPTURE(speed, phase, y, result.force.y());
        if (std::abs(y - reach) < 1e-12) continue;  // round-off says whether they touch
        CHECK(result.pressing == (y < reach));
        if (result.pressing) CHECK(result.force.y() > 0);
      }
    }
}
