// A model that has been set back is a new model: nothing of what was asked of it is left, to the bit.
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEMPLATE_TEST_CASE(
    "set back or let go, a straight beam answers as a new one does, whatever it was asked before", "",
    VonKarman<>, Corotational<>, Linear, VonKarman<ReducedIntegration>) {
  using Model = FemModel<TestType>;
  Random random(17);
  int unfinished = 0;
  for (const auto& [left, right] : {std::pair{Support::clamped, Support::free},
                                    {Support::pinned, Support::pinned},
                                    {Support::clamped, Support::roller}}) {
    NewtonRaphson solver;
    solver.max_solves = 6;  // so that some presses end on the way, and leave the size of their next step
    const Model fresh(steel_ruler(left, right), 8, solver);
    Model used = fresh;
    for (int round = 0; round < 60; ++round) {
      for (int k = 0; k < 3; ++k)
        unfinished += used.press({random(0.01, 0.29), random(0.15)}).status == Status::iteration_limit;
      if (round % 2 == 0) used.reset();
      else CHECK(used.release() == Status::ok);
      Model next = fresh;
      for (int k = 0; k < 3; ++k) {
        const Press<double> press{random(0.01, 0.29), random(0.15)};
        const auto answer = used.press(press), expected = next.press(press);
        REQUIRE(answer.status == expected.status);
        REQUIRE(answer.force == expected.force);
        REQUIRE(used.report().solves == next.report().solves);
      }
    }
  }
  if constexpr (any_rotation<TestType>) CHECK(unfinished > 10);
}
