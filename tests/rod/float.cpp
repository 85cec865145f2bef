// Rods in float: each push is answered, and its force has the digits that limits.md states.
#include <algorithm>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// How far from double at most, of the force.   @param deepest [m]
template <class Element>
double worst(const PressedRod& pressed, int elements, double deepest) {
  FemModel<Element> model(pressed.rod, elements);
  FemModel<Element, float> rounded(pressed.rod, elements);
  Random random(3);
  double worst = 0;
  for (int k = 1; k <= 60; ++k) {
    model.reset(), rounded.reset();
    // In float a tip of 3 % of the length is straight.
    const double s = pressed.s * random(0.6, 0.95),
                 d = pressed.normal.dot(model.shape().at(s).r) + deepest * k / 60 * (k % 2 ? 1 : -1);
    const auto expected = model.push({s, d, pressed.normal});
    const auto got = rounded.push({float(s), float(d), pressed.normal.cast<float>()});
    if (expected.status != Status::ok) continue;
    INFO("s " << s << " m, d " << d << " m");
    CHECK(got.status == Status::ok);
    worst = std::max(worst, std::abs(double(got.force) / expected.force - 1));
  }
  return worst;
}

}  // namespace

// The bound of planar beams, 100 eps n²: that of a bending stiffness whose condition grows with n⁴.
TEST_CASE("a rod in float answers each push, to 100 eps n² of the force", "[rod]") {
  for (const int n : {8, 16}) {
    const double bound = 100 * 1.2e-7 * n * n;
    CAPTURE(n, bound);
    CHECK(worst<RoundRod>(pressed_rod("wire_under_load"), n, 0.08) <= bound);
    CHECK(worst<TwistedRod>(pressed_rod("bar_two_ways"), n, 0.018) <= bound);
    CHECK(worst<TwistedRod>(pressed_rod("hook"), n, 0.04) <= bound);
  }
}

// Places are rounded by eps L, here 4e-5 of the least depth, which the strip's bending out of its flat plane magnifies.  Deeper, a
// push from rest may end with iteration_limit: docs/limits.md.
TEST_CASE("a thin strip in float answers each push up to a tenth of its length, to half a percent", "[rod]") {
  CHECK(worst<TwistedRod>(pressed_rod("strip_askew"), 8, 0.02) <= 5e-3);
}

TEST_CASE("a rod in float that is hardly pressed is answered", "[rod]") {
  const PressedRod wire = pressed_rod("wire_under_load");
  FemModel<RoundRod> model(wire.rod, 8);
  FemModel<RoundRod, float> rounded(wire.rod, 8);
  const double stiffness = model.push({wire.s, 1e-4, wire.normal}).force / 1e-4;
  for (int k = 0; k <= 20; ++k) {
    const double d = 1e-6 * k;
    model.reset(), rounded.reset();
    const auto got = rounded.push({float(wire.s), float(d), wire.normal.cast<float>()});
    CHECK(got.status == Status::ok);
    CHECK(std::abs(double(got.force) - stiffness * d) <= 1.2e-7 * 10 * stiffness * wire.rod.length());
  }
}
