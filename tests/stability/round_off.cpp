// Where digits end: on fine meshes, and in float.  tests/stability/ends.cpp has the shortest element.
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/closed_form.hpp"
#include "support/condition.hpp"
#include "support/error.hpp"
#include "support/naive_newton.hpp"
#include "support/path.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double s = 0.3 * thesis_length, d = 5e-3;

Beam pinned() { return thesis_beam(Support::pinned, Support::pinned); }
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
  BeamSystem<VonKarman<>, Scalar, Eigen::Dynamic, Eigen::Dynamic, BlockTridiagonal> system(pinned(), n);
  const auto mesh = ContactMesh<Scalar>(n, Scalar(thesis_length)).at(Scalar(s));
  system.remesh(mesh);
  system.set_goal(mesh.node(), Scalar(d));
  return naive_newton(system, 1, most, done(mesh.node()));
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

// 1e-8 is below the last place of a float.  Of 256 elements float has no digits left: then the model says that it has not
// found its rest, and answers nothing.
TEST_CASE(
    "in float a tolerance of 1e-8 is never met; the library's grows with round-off, and its refusal too",
    "[round-off][float]") {
  const auto increment = [](int) { return RelativeEnergy{}; };
  for (const int n : {8, 16, 32, 64}) {
    CAPTURE(n);
    CHECK_FALSE(naive_press<float>(n, 100, increment).converged);
    FemModel<VonKarman<>, float> model(pinned(), n);
    const Response<float> response = model.press({float(s), float(d)});
    CHECK(response.status == Status::ok);
    CHECK(model.report().solves <= 6);
    CHECK(relative_error(response.force, exact()) <= discretisation(n) + round_off<float>(n));
  }
  FemModel<VonKarman<>, float> fine(pinned(), 256);
  const Response<float> response = fine.press({float(s), float(d)});
  CHECK_FALSE(is_answer(response.status));
  CHECK(response.force == 0);
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
