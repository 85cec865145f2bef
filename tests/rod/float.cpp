// Round rods in float: each push is answered, and its force has the digits that limits.md states.
#include "rod/float.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

// The bound of planar beams, 100 eps n²: that of a bending stiffness whose condition grows with n⁴.
TEST_CASE("a round rod in float answers each push, to 100 eps n² of the force", "[rod]") {
  for (const int n : {8, 16}) {
    const double bound = 100 * 1.2e-7 * n * n;
    CAPTURE(n, bound);
    CHECK(error_in_float<RoundRod>(pressed_rod("wire_under_load"), n, 0.08) <= bound);
  }
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
