// Welds and hinges of rods: branches and frames against one bent rod and against solutions of their own, laws, and what cannot be welded.
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include <hapbeam/world/world.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

const NewtonRaphson exact = [] {
  NewtonRaphson solver;
  solver.relative_tolerance = 1e-11;
  return solver;
}();
const RodSection flat = RodSection::rectangle(0.004, 0.002), wire = RodSection::circle(0.002);

RodPose pose(const Point& at, const Point& along, const Point& director) { return {at, along, director}; }

}  // namespace

TEST_CASE("a rod in two pieces that are welded is one rod", "[world][weld]") {
  // Bent, twisted and drawn by hands at both ends; and pieces that only welds hold.
  const double length = 0.3;
  const auto felt = [&](int pieces) {
    std::vector<WorldRod> rods;
    std::vector<Joint> joints;
    for (int k = 0; k < pieces; ++k) {
      Rod rod(length / pieces, flat, spring_steel, k == 0 ? RodSupport::clamped : RodSupport::free,
              k == pieces - 1 ? RodSupport::clamped : RodSupport::free);
      rod.place_left(pose({length / pieces * k, 0, 0}, {1, 0, 0}, {0, 1, 0}));
      rods.push_back({rod, 24 / pieces});
      if (k > 0) joints.push_back({{k, k - 1}, {0, length / pieces}, JointKind::weld});
    }
    World<TwistedRod> world(rods, {}, joints, exact);
    int solves = 0;
    for (int k = 1; k <= 40; ++k) {
      const double a = 0.03 * k, x = 0.004 * k;
      CHECK(world.hold(pieces - 1, RodSide::right,
                       pose({length - 0.6 * x, 0.4 * x, 0.3 * x}, {std::cos(a), std::sin(a) * 0.6, std::sin(a) * 0.8},
                            {0, 0.8, -0.6})) == Status::ok);
      CHECK(world.tick() == Status::ok);
      solves += world.solves();
    }
    CHECK(solves < 40 * 4);
    const HeldEnd<double> held = world.held(pieces - 1, RodSide::right), other = world.held(0, RodSide::left);
    CHECK((held.force + other.force).norm() <= 1e-10 * held.force.norm());
    return std::array<Point, 2>{held.force, held.moment};
  };
  const auto one = felt(1);
  for (const int pieces : {2, 3}) {
    const auto welded = felt(pieces);
    CAPTURE(pieces, one[0].transpose(), welded[0].transpose(), one[1].transpose(), welded[1].transpose());
    CHECK((welded[0] - one[0]).norm() <= 1e-8 * one[0].norm());
    CHECK((welded[1] - one[1]).norm() <= 1e-8 * one[1].norm());
  }
}
