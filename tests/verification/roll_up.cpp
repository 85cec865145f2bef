// A cantilever that an end moment rolls up: M = 2πEI/L closes it to a circle, 4πEI/L to two.
//
// Each element bends to the arc of its angle 2x, and its strain vanishes where its chord is l (1 - x²/6): the chords are
// those of an arc, (sin x)/x l, but for x⁴/120, and as all are alike the polygon closes exactly.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/mesh_nodes.hpp"
#include "support/pi.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = 2, EI = 3;

/// EA L²/EI = 1e6; nothing is stretched, so that it matters to the solver alone.
template <class Element = Corotational<>, typename Scalar = double>
FemModel<Element, Scalar> rolled(double turns, int elements) {
  Beam beam(L, 1e6 * EI / (L * L), EI, 0.01, Support::clamped, Support::free);
  beam.add({L, 0, 0, turns * 2 * pi * EI / L});
  return {beam, elements};
}

}  // namespace

TEST_CASE("end moments of 2π and 4π EI/L roll 8 elements up to one and two circles, in 48 solves at most",
          "[roll-up]") {
  for (const int turns : {1, 2, -1, -2}) {
    const auto model = rolled(turns, 8);
    const int solves = model.rest().solves, steps = model.rest().steps;
    const auto tip = mesh_node(model, 8);
    CAPTURE(turns, solves, steps, L + tip.u, tip.w, tip.theta - 2 * pi * turns);
    CHECK(model.rest().status == Status::ok);
    CHECK(solves <= 48);
    CHECK(std::hypot(L + tip.u, tip.w) <= 1e-6 * L);
    CHECK(std::abs(tip.theta - 2 * pi * turns) <= 1e-6);
  }
}

TEST_CASE("finer meshes and other local parts roll up as well, in 48 solves at most", "[roll-up]") {
  const auto check = [](const auto& model, const char* element, double turns) {
    const int last = model.elements(), solves = model.rest().solves, steps = model.rest().steps;
    const auto tip = mesh_node(model, last);
    CAPTURE(element, last, turns, solves, steps);
    CHECK(model.rest().status == Status::ok);
    CHECK(solves <= 48);
    CHECK(std::hypot(L + tip.u, tip.w) <= 1e-6 * L);
  };
  for (const double turns : {1., 2.}) {
    for (const int elements : {16, 32, 64}) check(rolled(turns, elements), "default", turns);
    check(rolled<Corotational<Linear>>(turns, 8), "linear", turns);
    check(rolled<Corotational<VonKarman<ReducedIntegration>>>(turns, 8), "reduced", turns);
  }
}

// A polygon of n sides l (1 - x²/6) is l (1 - x²/6)/sin x across where the circle is l/x, x = π/n: short by x⁴/120.  The
// solver leaves 1e-8.
TEST_CASE("the circle is round: half-way it is L/π across, to (π/n)⁴/120", "[roll-up]") {
  double error[3];
  for (int k = 0; k < 3; ++k) {
    const int n = 8 << k;
    const auto model = rolled(1, n);
    REQUIRE(model.rest().status == Status::ok);
    const auto half = mesh_node(model, n / 2);
    const double x = pi / n, expected = 1 - x * (1 - x * x / 6) / std::sin(x);
    error[k] = relative_error(-half.w, L / pi);
    CAPTURE(n, error[k], expected);
    CHECK(std::abs(error[k] - expected) <= 1e-8);
    CHECK(std::abs(L / 2 + half.u) <= 1e-6 * L);
    CHECK(std::abs(half.theta - pi) <= 1e-6);
  }
  CHECK(observed_order(error[0], error[1]) >= 3.8);
}

// Ten turns are past what the path's first step can see, and no trouble: angles are counted, not folded.
TEST_CASE("partial and many turns: every node lies on its circle, at its angle", "[roll-up]") {
  for (const double turns : {0.1, 0.75, 3.5, 5.0}) {
    const int n = 64;
    const auto model = rolled(turns, n);
    REQUIRE(model.rest().status == Status::ok);
    const double k = 2 * pi * turns / L, x = k * L / n / 2;
    for (const auto& node : mesh_nodes(model)) {
      CAPTURE(turns, node.s);
      CHECK(std::abs(node.theta - k * node.s) <= 1e-6);
      const double place =
          std::hypot(node.s + node.u - std::sin(k * node.s) / k, node.w - (std::cos(k * node.s) - 1) / k);
      CHECK(place <= 2 / k * (std::pow(x, 4) / 120 * 1.1 + 1e-6));
    }
  }
}

// In float the tip is told to 2^-24 of positions and of 2π: 1e-6 after sums over n elements.
TEST_CASE("in float the beam rolls up to a circle, to its round-off", "[roll-up][float]") {
  const auto model = rolled<Corotational<>, float>(1, 8);
  const auto tip = mesh_node(model, 8);
  CAPTURE(model.rest().solves, model.rest().steps);
  CHECK(model.rest().status == Status::ok);
  CHECK(std::hypot(L + static_cast<double>(tip.u), static_cast<double>(tip.w)) <= 64 * 6e-8 * L);
  CHECK(std::abs(static_cast<double>(tip.theta) - 2 * pi) <= 64 * 6e-8 * 2 * pi);
}
