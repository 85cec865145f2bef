// The hand slides along the beam: nodes follow it, the mesh changes every tick, and the force must not know
// how it came.
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/solver.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

// At the same (s, d) the mesh is the same whatever came before, and so is the discrete beam: what is left is
// the solver's tolerance, 1e-13 of the state, and round-off of n = 32 nodes, eps n² = 2e-13, both amplified
// by what a clamped end concentrates, F / (dF/dx L) < 1e3.
TEST_CASE("sliding or fresh the force at one place and depth is the same to 1e-9", "[sliding]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const int elements : {4, 8, 32})
      for (const double depth : {0.5e-3, 5e-3, -20e-3}) {
        FemModel<> slid(thesis_beam(end, end), elements, tight_solver()), fresh = slid;
        double worst = 0;
        bool answered = true;
        int tick = 0;
        for (double s = 0.05; s <= 0.95; s += 1e-4, ++tick) {  // 250 mm/s at 1 kHz
          const Response<double> response = slid.press({s * thesis_length, depth});
          answered = answered && response.status == Status::ok;
          if (tick % 16 != 0) continue;
          fresh.reset();
          worst =
              std::max(worst, relative_error(response.force, fresh.press({s * thesis_length, depth}).force));
        }
        INFO(name(end) << ", " << elements << " elements, " << depth << " m: force off by " << worst);
        CHECK(answered);
        CHECK(worst <= 1e-9);
      }
}

TEST_CASE("sliding at 250 mm/s takes at most 6 linear solves a tick", "[sliding]") {
  for (const Support end : {Support::pinned, Support::clamped})
    for (const int elements : {4, 8, 64})
      for (const double depth : {0.5e-3, 5e-3, -50e-3}) {
        FemModel<> model(thesis_beam(end, end), elements);
        REQUIRE(model.press({0.1 * thesis_length, depth}).status == Status::ok);
        int most = 0;
        bool answered = true;
        for (double s = 0.1; s <= 0.9; s += 1e-4) {
          answered = answered && model.press({s * thesis_length, depth}).status == Status::ok;
          most = std::max(most, model.report().solves);
        }
        INFO(name(end) << ", " << elements << " elements, " << depth << " m: " << most << " solves");
        CHECK(answered);
        CHECK(most <= 6);
      }
}

// Half-way between two nodes of the uniform mesh another node takes over, and the two meshes on either side
// have other errors.  The bounds are those of the press against its closed form on either side: 2 · 3e-5 and
// 2 · 1e-3; the beam itself changes by less than 4 · 2 nm / 0.1 L.
TEST_CASE("where another node takes over the force jumps by no more than the elements' error", "[sliding]") {
  const auto jump = [](int elements, double depth) {
    FemModel<> model(thesis_beam(Support::pinned, Support::pinned), elements, tight_solver());
    double worst = 0;
    int switches = 0;
    for (int k = 1; k + 1 < elements; ++k) {
      const double s = (k + 0.5) / elements * thesis_length;
      if (s < 0.1 * thesis_length || s > 0.9 * thesis_length) continue;
      const double before = model.press({s - 1e-9, depth}).force,
                   after = model.press({s + 1e-9, depth}).force;
      worst = std::max(worst, relative_error(after, before));
      ++switches;
    }
    REQUIRE(switches >= elements / 2);
    return worst;
  };
  CHECK(jump(8, 5e-3) <= 2 * 3e-5);
  CHECK(jump(16, 50e-3) <= 2 * 1e-3);
  CHECK(jump(32, 50e-3) <= 2 * 1e-4);
}
