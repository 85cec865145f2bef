// A step of a beam with mass: no heap, and a bounded number of linear solves, whatever the hand does.
#include <limits>
#include <realtime/heap_watch.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/fem/dynamic_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEST_CASE("a step of a beam with mass allocates nothing and is bounded", "[dynamics]") {
  const Beam beam(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850}, Support::clamped,
                  Support::free);
  DynamicModel<> model(beam, 8, 2);
  // Each of two parts may be halved three times, and each piece has two stages of up to four solutions.
  constexpr int most = 2 * 15 * 2 * 4 * 48;
  Random random(5);
  int failed = 0;
  const auto step = [&](double x, double y, double dt) {
    Pushed<double> felt{0, Status::ok};
    CHECK(heap_use([&] { felt = model.step(dt, {{0.2, {x, y}, 0.005, 1}, 3500, 2}); }) == HeapUse{});
    CHECK(std::isfinite(felt.force));
    CHECK(model.solves() <= most);
    for (int i = 0; i < model.shape().size(); ++i) REQUIRE(is_finite(model.shape()[i]));
    failed += felt.status == Status::iteration_limit;
  };
  for (int k = 0; k < 300; ++k) step(0.2, 0.006 - 1e-4 * k, 1e-3);
  CHECK(failed == 0);
  // One that jumps to places where no step of it has a solution, and past the ends.
  for (int k = 0; k < 300; ++k) step(random(-0.1, 0.5), random(0.3), random(0, 3e-3));
  step(0.2, std::numeric_limits<double>::quiet_NaN(), 1e-3);
  model.reset();
  CHECK(heap_use([&] { (void)model.step(1e-3), model.reset(), (void)model.energy(); }) == HeapUse{});
  step(0.2, 0.0049, 1e-3);
}
