// Two hands find the beam where it was foreseen: with the forces of hands that rest there, however they came.
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/arch.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Model = FemModel<Several<Corotational<>, 2>>;

/// Two hands that press a beam, and then slide along it at one speed each.
struct Way {
  Beam beam;
  double top;                          ///< [m] of the beam at rest, about
  Vector press[2];                     ///< [m] where to, and how deep
  Vector slide[2];                     ///< [m] in a tick
  static constexpr int pressed = 200;  ///< ticks

  Vector at(int hand, int tick) const {
    const double part = std::min(1.0, double(tick) / pressed), clear = top + radius + beam.thickness() / 2;
    return Vector(press[hand].x(), clear - part * press[hand].y()) +
           std::max(0, tick - pressed) * slide[hand];
  }
  static constexpr double radius = 0.005;
};

struct Felt {
  double force[2];
  bool ok;
};

/// What the hands feel at a tick of their way, and if they stop there `rests` ticks later.
Felt felt(const Way& way, int tick, int rests, bool in_turn) {
  Model model(way.beam, 16);
  TouchSeveral<Model> touch(model, {Way::radius, Way::radius});
  touch.lift(0), touch.lift(1);
  Felt last{};
  for (int t = 0; t <= tick + rests; ++t) {
    const Vector left = way.at(0, std::min(t, tick)), right = way.at(1, std::min(t, tick));
    if (in_turn) (void)touch.tick(0, left);
    const auto result = in_turn ? touch.tick(1, right) : touch.tick(left, right);
    last = {{result.force(0).norm(), result.force(1).norm()}, result.status == Status::ok};
  }
  return last;
}

}  // namespace

// Newton's method ends at 1e-6 of the force.  A node that is foreseen lies nearer to its contact than that costs.
TEST_CASE("the forces on two hands that go on are those of hands which rest there", "[several]") {
  const Beam bar(1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, Support::pinned),
      ruler(0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, Support::free),
      bow = level_arch(0.2, 0.5, 1e6, 0.02, 0.0005, Support::pinned, Support::pinned);
  const double rise = level_arch_rise(0.2, 0.5);
  const std::vector<Way> ways{
      {bar, 0, {{0.15, 0.04}, {0.55, 0.06}}, {{2e-3, 1e-4}, {3e-3, 1e-4}}},
      {ruler, 0, {{0.1, 0.02}, {0.25, 0.07}}, {{-1e-4, 0}, {-3e-4, 0}}},
      {bow, rise, {{0.06, 0.0025}, {0.14, 0.0025}}, {{2e-4, 1e-5}, {-1e-4, -1e-5}}},
  };
  for (std::size_t k = 0; k < ways.size(); ++k)
    for (const bool in_turn : {false, true})
      for (int tick = Way::pressed + 10; tick < Way::pressed + 80; tick += 9) {
        CAPTURE(k, in_turn, tick);
        const Felt moving = felt(ways[k], tick, 0, in_turn), resting = felt(ways[k], tick, 20, in_turn);
        REQUIRE((moving.ok && resting.ok));
        for (int hand = 0; hand < 2; ++hand) {
          REQUIRE(resting.force[hand] > 0);
          CHECK(relative_error(moving.force[hand], resting.force[hand]) <= 1e-6);
        }
      }
}
