// Rods that twist, in float: each push is answered, and its force has the digits that limits.md states.
#include "rod/float.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

// The bound is that of round rods.
TEST_CASE("a rod in float that twists answers each push, to 100 eps n² of the force", "[rod]") {
  for (const int n : {8, 16}) {
    const double bound = 100 * 1.2e-7 * n * n;
    CAPTURE(n, bound);
    CHECK(error_in_float<TwistedRod>(pressed_rod("bar_two_ways"), n, 0.018) <= bound);
    CHECK(error_in_float<TwistedRod>(pressed_rod("hook"), n, 0.04) <= bound);
  }
}

// Places are rounded by eps L, here 4e-5 of the least depth, which the strip's bending out of its flat plane magnifies.  Deeper, a
// push from rest may end with iteration_limit: docs/limits.md.
TEST_CASE("a thin strip in float answers each push up to a tenth of its length, to half a percent", "[rod]") {
  CHECK(error_in_float<TwistedRod>(pressed_rod("strip_askew"), 8, 0.02) <= 5e-3);
}
