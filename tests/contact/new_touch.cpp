// A touch after others is that of a new hand on a new beam, to the bit: nothing that was learnt before is left.
#include <cmath>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

// Strokes from anywhere to anywhere, over the ends and past them, each as a new touch of an old beam and of a new one.
TEMPLATE_TEST_CASE("strokes on a beam that has been touched before are those on a new one", "", VonKarman<>,
                   Corotational<>) {
  using Model = FemModel<TestType>;
  using Vector = Vector2<double>;
  Random random(23);
  int strokes = 0;
  for (const auto& [left, right] : {std::pair{Support::free, Support::clamped},
                                    {Support::clamped, Support::pinned},
                                    {Support::pinned, Support::roller}}) {
    const Model fresh(steel_ruler(left, right), 8);
    Model used = fresh;
    for (const double radius : {0.0, 0.004, 0.02}) {
      Touch<Model> again(used, radius);
      for (int stroke = 0; stroke < 60; ++stroke) {
        Model next = fresh;
        Touch<Model> anew(next, radius);
        again.reset();
        Vector hand(random(-0.01, 0.31), random(0.002, 0.03) + radius);
        Vector step(random(0.0015), -random(0.0002, 0.002));
        if (stroke % 2 != 0) {  // begun past an end, and on through the beam in a tick
          const double reach = radius + ruler_thickness / 2, beyond = random(0, reach);
          const bool at_right = stroke % 4 == 1;
          hand = {at_right ? ruler_length + beyond : -beyond, random(0, reach)};
          step = {random(0, 2 * reach) * (at_right ? -1 : 1), -random(reach, 3 * reach)};
        }
        bool touched = false;
        for (int tick = 0; tick < (stroke % 2 != 0 ? 8 : 80); ++tick, hand += step) {
          const auto felt = again.tick(hand), expected = anew.tick(hand);
          CAPTURE(radius, stroke, tick);
          REQUIRE(felt.pressing == expected.pressing);
          REQUIRE(felt.status == expected.status);
          REQUIRE(felt.force == expected.force);
          touched = touched || felt.pressing;
        }
        strokes += touched;
      }
    }
  }
  CHECK(strokes > 200);
}

// Whichever arm it presses yields, so that the other one is nearer in the next tick.
TEST_CASE("a disc that rests in the mouth of a hairpin keeps to one of its arms", "[contact]") {
  const double arm = 0.1, bend = 0.01, half_round = std::acos(-1.0) * bend;
  Beam hairpin(2 * arm + half_round, Section::rectangle(0.01, 0.0005), Material{200e9}, Support::clamped,
               Support::free);
  hairpin.naturally({{arm, 0}, {arm + half_round, 1 / bend}, {2 * arm + half_round, 0}});
  for (const double radius : {0.0098, 0.0105, 0.012})
    for (const double x : {0.03, 0.07})
      for (const double off : {-0.0005, 0.0, 0.0005}) {
        FemModel<Corotational<>> model(hairpin, 24);
        Touch<FemModel<Corotational<>>> touch(model, radius);
        for (int k = 0; k <= 300; ++k) (void)touch.tick({-0.02 + (x + 0.02) * k / 300, -bend + off});
        auto felt = touch.tick({x, -bend + off});
        for (int k = 0; k < 60; ++k) felt = touch.tick({x, -bend + off});
        double apart = 0;
        for (int k = 0; k < 10; ++k) {
          const auto next = touch.tick({x, -bend + off});
          apart = std::max(apart, (next.force - felt.force).norm());
          felt = next;
        }
        INFO("radius " << radius << ", x " << x << ", off " << off);
        CHECK(apart <= 1e-6 * (felt.force.norm() + 1e-3));
      }
}

// The centre of a small avatar passes the beam by many radii in a tick.  Where it touches is no unknown before it is on its side again.
TEMPLATE_TEST_CASE("a hand that falls on a ruler by millimetres a tick is pushed back in every tick", "",
                   Corotational<>, Corotational<VonKarman<AssumedStrain>>, (Several<Corotational<>, 2>)) {
  using Model = FemModel<TestType>;
  const Model resting(steel_ruler(Support::clamped, Support::free), 17);
  int ticks = 0, refused = 0, through = 0;
  long solves = 0;
  for (const double radius : {0.0, 0.001, 0.005})
    for (const double step : {0.002, 0.0041, 0.0065, 0.0089, 0.013, 0.02})
      for (const double s : {0.1499, 0.1571, 0.2})
        for (int phase = 0; phase < 10; ++phase) {
          Model model(resting);
          Touch<Model> touch(model, radius);
          for (double y = 0.02 + step * phase / 10; y > -0.02; y -= step) {
            const TouchResult<double> felt = touch.tick({s, y + radius});
            refused += felt.status != Status::ok;
            if (!(y < 0.0005)) continue;
            ++ticks, solves += model.report().solves;
            through += !(felt.force.y() > 0);
          }
        }
  CHECK(ticks > 2000);
  CHECK(refused == 0);
  CHECK(through == 0);
  CHECK(solves < 6 * ticks);  // of 48 that a tick may take
}
