// Where digits end: on fine meshes, and in float.  tests/stability/ends.cpp has the shortest element.
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/closed_form.hpp"
#include "support/condition.hpp"
#include "support/error.hpp"
#include "support/naive_newton.hpp"
#include "support/path.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double s = 0.25 * thesis_length, d = 5e-3;

double exact() { return PinnedPress(thesis_length, thesis_EA, thesis_EI)(s, d); }

/// The reaction is the difference of two shears of 12EI/l³ times displacements that are rounded to eps/2 each; against
/// 3EI L/s²(L - s)² of the beam that is a third of eps n³, with half as much for what the solver's own rounding adds.
template <typename Scalar>
double round_off(int n) {
  return static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * std::pow(n, 3) / 2;
}
/// Of the elements, fourth order: 3.1e-5 at 4 of them.
double discretisation(int n) { return 4e-5 * std::pow(4.0 / n, 4); }

/// A press from rest, by Newton's method as it is first written.
template <typename Scalar, class Criterion>
NaiveSolve naive_press(int n, int most, Criterion&& done) {
  BeamSystem<VonKarman<>, Scalar, Eigen::Dynamic, Eigen::Dynamic> system(pinned(), n);
  system.set_goal(Push<Scalar>{Scalar(s), Scalar(d), {0, 1}});
  return naive_newton(system, 1, most, done(n / 4));
}

}  // namespace

TEST_CASE("the condition of the bending stiffness grows with the fourth power of the elements",
          "[round-off]") {
  for (const int n : {8, 16})
    CHECK(std::abs(std::log2(bending_condition(2 * n) / bending_condition(n)) - 4) <= 0.2);
}

// The residual of a node is the round-off of 12EI/l³ times its displacement: it never gets small against the load.
TEST_CASE("on a fine mesh a small residual never comes; a small increment does, and the force is right",
          "[round-off]") {
  const auto residual = [](int node) { return RelativeResidual<VonKarman<>>{thesis_EA, thesis_EI, node}; };
  CHECK(naive_press<double>(64, 50, residual).converged);
  for (const int n : {1024, 4096, 16384}) {
    CAPTURE(n);
    CHECK_FALSE(naive_press<double>(n, 50, residual).converged);
    FemModel<> model(pinned(), n);
    const Response<double> response = model.press({s, d});
    CHECK(response.status == Status::ok);
    CHECK(model.report().solves <= 6);
    CHECK(relative_error(response.force, exact()) <= discretisation(n) + round_off<double>(n));
  }
}

// 1e-8 is below the last place of a float.
TEST_CASE("in float a tolerance of 1e-8 is never met; the library ends where increments are round-off",
          "[round-off][float]") {
  const auto increment = [](int) { return RelativeEnergy{}; };
  for (const int n : {8, 16, 32, 64, 128}) {
    CAPTURE(n);
    CHECK_FALSE(naive_press<float>(n, 100, increment).converged);
    FemModel<VonKarman<>, float> model(pinned(), n);
    const Response<float> response = model.press({float(s), float(d)});
    CHECK(response.status == Status::ok);
    CHECK(model.report().solves <= 6);
    // The force is that of the linear equations: rounded nodes leave nothing in it but what they leave of the tangent.
    CHECK(relative_error(response.force, exact()) <= discretisation(n) + round_off<float>(n) / n);
  }
}

// What is accepted is right, whatever the way there.  In float the tangent of a slender free end has lost its softest digits:
// Newton's method then wanders, blows up and comes back, and must not be believed on the way.
TEMPLATE_TEST_CASE("in float no press that is ok has an error above 100 eps n²", "[round-off][float]",
                   VonKarman<>, Corotational<>) {
  const Beam ruler(0.3, Section::rectangle(0.025, 1e-3), Material{2e11}, Support::clamped, Support::free);
  Random random(3);
  for (const int n : {8, 16, 32, 48, 64}) {
    const double allowed = 100.0 * std::numeric_limits<float>::epsilon() * n * n;
    FemModel<TestType, float> single(ruler, n);
    FemModel<TestType> exact(ruler, n);
    int compared = 0, ticks = 0;
    double worst = 0;
    for (int press = 0; press < 1600 / n + 20; ++press) {
      // Nearer than 3 % to the tip, float presses the tip's node instead.
      const float place = static_cast<float>(random(0.02, 0.96) * 0.3);
      const double depth = random(0.03);
      single.reset();
      exact.reset();
      for (int k = 1; k <= 40; ++k, ++ticks) {
        const Press<float> asked{place, static_cast<float>(depth * k / 40)};
        const Response<float> got = single.press(asked);
        const Response<double> want = exact.press({asked.s, asked.d});
        REQUIRE(std::isfinite(got.force));
        if (got.status != Status::ok || want.status != Status::ok) continue;
        ++compared;
        worst = std::max(worst, relative_error(got.force, want.force));
      }
    }
    CAPTURE(n, ticks, compared, worst);
    CHECK(worst <= allowed);
    CHECK(compared >= ticks * 8 / 10);
  }
}

// Metres of stretching weigh EA/l, radians of bending EI/l: their quotient is a strip's thickness over its element, squared,
// and in float 0.1 mm of 0.3 m has lost it against the largest pivot.
TEST_CASE("a pivot judged by the largest would refuse every thin strip in float; by its own diagonal none",
          "[round-off][float]") {
  const Beam strip(0.3, Section::rectangle(0.02, 1e-4), Material{2e11}, Support::pinned, Support::roller);
  const double l = 0.3 / 8, largest = strip.axial_stiffness() / l, bending = strip.bending_stiffness() / l;
  CHECK(bending < static_cast<double>(std::numeric_limits<float>::epsilon()) * largest);
  FemModel<VonKarman<>, float> model(strip, 8);
  const Response<float> response = model.press({0.15f, 1e-3f});
  CHECK(response.status == Status::ok);
  CHECK(relative_error(response.force, 48 * strip.bending_stiffness() * 1e-3 / std::pow(0.3, 3)) <= 1e-3);
}
