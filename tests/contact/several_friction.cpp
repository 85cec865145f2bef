// Friction at several contacts of a beam: each keeps its own cone, and together they take what the hands give.
#include <algorithm>
#include <cmath>

#include "realtime/counting_element.hpp"
#include "support/catch.hpp"
#include "support/check_cone.hpp"
#include "support/pi.hpp"
#include "support/ruler.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Model = FemModel<Several<Corotational<>, 2>>;
using Touching = TouchSeveral<Model>;
using Place = TouchPlace<double>;

}  // namespace

TEST_CASE("one avatar of several rubs as it does alone", "[friction][several]") {
  const Friction friction(0.4, 0.3);
  FemModel<Corotational<>> one(steel_ruler(), 16);
  Model many(steel_ruler(), 16);
  Touch alone(one, 0.005, friction);
  Touching touch(many, {finger(friction)});
  double largest = 0;
  int sliding = 0;
  for (int k = 0; k < 3000; ++k) {
    const double a = 2 * pi * k / 1500;
    const Vector hand(0.2 + 0.01 * std::sin(2 * a), 0.0056 - 0.03 * (1 - std::cos(a)));
    const auto r = alone.tick(hand);
    const auto felt = touch.tick(hand);
    const Place& place = felt.places[0];
    check_cone(place, friction);
    largest = std::max(largest, r.force.norm());
    REQUIRE((place.force - r.force).norm() <= 1e-7 * largest);
    REQUIRE(place.sliding == r.sliding);
    REQUIRE(std::abs(place.dissipated - r.dissipated) <= 1e-7 * largest * 0.04);
    sliding += r.sliding;
  }
  CHECK(largest > 5);
  CHECK(sliding > 1000);
}

// The string lies under a peg, and a hand that lifts it beside the peg draws it over.  The law of the ratio stands at the test of one contact.
TEST_CASE("a string that a hand draws over a rough peg is held by it as by a capstan",
          "[friction][several]") {
  const Beam string(1, Section::rectangle(0.004, 0.01), Material{200e9}, Support::pinned, Support::pinned);
  const auto slope = [](const auto& line, double s) {
    const auto a = line.at(s - 1e-4), b = line.at(s + 1e-4);
    return std::atan2(b.w - a.w, 2e-4 + b.u - a.u);
  };
  for (const double mu : {0.3, 0.6}) {
    Model model(string, 64);
    Touching touch(model, {0.005}, {Prop<>::peg({0.6, 0.0102}, 0.005).rough(mu)});
    const auto lift = [&](double from, double to, int ticks) {
      TouchSeveralResult<double, 2, 2> felt;
      for (int k = 1; k <= ticks; ++k) {
        felt = touch.tick(Vector(0.3, -0.0102 + from + (to - from) * k / ticks));
        REQUIRE(felt.status == Status::ok);
      }
      return felt;
    };
    const auto tension = [&](double s) {
      const auto carried = model.internal_forces(s);
      return std::hypot(carried.normal, carried.shear);
    };
    for (const double high : {0.1, 0.15}) {
      const auto felt = lift(high == 0.1 ? 0 : 0.1, high, 60);
      const Place& peg = felt.places[1];
      REQUIRE((peg.touching && peg.sliding));
      CHECK(felt.friction(0).isZero(0));
      CHECK(felt.friction(1).x() < 0);  // the string goes to the hand, and takes the peg along
      const auto line = model.shape();
      const double left = peg.s - 0.15, right = peg.s + 0.15, angle = slope(line, right) - slope(line, left),
                   ratio = tension(left) / tension(right),
                   off = std::atan(mu) - std::asin(std::sin(std::atan(mu)) * std::cos(angle / 2)),
                   law = std::pow(std::sin(angle / 4 + off / 2) / std::sin(angle / 4 - off / 2), 2);
      CAPTURE(mu, high, angle, ratio, law);
      CHECK(angle > 0.2);
      CHECK(std::abs(ratio / law - 1) <= 3e-3);
    }
    // On the way back the peg holds what it had let by.
    const auto felt = lift(0.15, 0.149, 2);
    CHECK((felt.places[1].touching && !felt.places[1].sliding));
  }
}

// Work, not time: elements asked for their tangents.
TEST_CASE("two contacts with friction take hardly more linear solves than without", "[friction][several]") {
  using Element = CountingElement<Corotational<>>;
  using Counted = FemModel<Several<Element, 2>>;
  const auto count = [](double mu, double sideways, double skin) {
    Counted model(steel_ruler(), 16);
    TouchSeveral<Counted> touch(model, {finger(mu), finger(mu)});
    touch.soften(0, skin, 0), touch.soften(1, skin, 0);
    const Vector left(0.11, -0.0075), right(0.22, -0.0145);  // held from below, and pressed
    for (int k = 0; k <= 200; ++k) {
      const Vector above(0, 0.02 * (1 - k / 200.0));
      (void)touch.tick(left, Vector(right + above));
    }
    Element::tangents = 0;
    int slides = 0;
    constexpr int ticks = 2000;
    for (int k = 0; k < ticks; ++k) {
      const double a = 2 * pi * k / 500;
      const Vector way(sideways * std::sin(a), 1e-4 * std::sin(2 * a));
      const auto felt = touch.tick(Vector(left + way), Vector(right + way));
      REQUIRE(felt.status == Status::ok);
      REQUIRE((felt.places[0].touching && felt.places[1].touching));
      slides += felt.places[0].sliding + felt.places[1].sliding;
    }
    struct {
      double solves, sliding;
    } const result{double(Element::tangents) / 16 / ticks, double(slides) / (2 * ticks)};
    return result;
  };
  const auto smooth = count(0, 0.02, 1e9), slides = count(0.3, 0.02, 1e9);
  CAPTURE(smooth.solves, slides.solves, slides.sliding);
  CHECK(slides.sliding > 0.7);
  CHECK(slides.solves <= 2 * smooth.solves);
  const auto quiet = count(0, 2e-4, 1e3), sticks = count(1, 2e-4, 1e3);
  CAPTURE(quiet.solves, sticks.solves, sticks.sliding);
  CHECK(sticks.sliding < 0.05);
  CHECK(sticks.solves <= 1.3 * quiet.solves);
}

TEST_CASE("of several contacts round ones may have friction", "[friction][several]") {
  Model model(steel_ruler(), 16);
  CHECK_THROWS_WITH(Touching(model, {finger(-0.1)}), "friction sticking = -0.1: must be 0 to 2");
  CHECK_THROWS_WITH(Touching(model, {0.005}, {Prop<>::peg({0.1, -0.1}, 0.01).rough({0.3, 0.4})}),
                    "friction sliding = 0.4: must be 0 to that of sticking");
  CHECK_THROWS_WITH(Touching(model, {0.005}, {Prop<>::stop(0.1, -0.1, {0, 1}).rough(0.3)}),
                    "friction = 0.3: must be 0 for a stop or a support");
}

TEST_CASE("what a contact has dissipated ends with it, wherever the next one begins", "[friction][several]") {
  Model model(steel_ruler(), 16);
  Touching touch(model, {finger(0.4), 0.005});
  const Vector away(0.25, -0.05);
  const auto slide = [&] {
    double dissipated = 0;
    for (int k = 0; k <= 400; ++k)
      dissipated = touch.tick(Vector(0.15 + 1e-4 * k, 0.007 - 5e-5 * k), away).places[0].dissipated;
    CHECK(dissipated > 0.01);
    for (int k = 0; k <= 400; ++k) (void)touch.tick(Vector(0.19, -0.013 + 1e-4 * k), away);
  };
  // The hand rests above the ruler, and the other one lifts it to the hand.
  const auto lift = [&] {
    const Vector above(0.1, 0.007);
    for (int k = 0; k < 50; ++k) (void)touch.tick(above, away);
    for (int k = 0; k < 1000; ++k) {
      const auto felt = touch.tick(above, Vector(0.25, -0.01 + 2e-5 * k));
      if (felt.places[0].touching) return felt.places[0].dissipated;
    }
    return -1.0;
  };
  CHECK(lift() == 0);
  slide();
  CHECK(lift() == 0);
  slide();
  touch.reset();
  CHECK(lift() == 0);

  // A peg is met within the push.
  Model pegged(steel_ruler(), 16);
  Touching onto(pegged, {0.005}, {Prop<>::peg({0.15, -0.0085}, 0.005).rough(0.2)});
  for (int stroke = 0; stroke < 3; ++stroke) {
    if (stroke == 2) onto.reset();
    double first = -1, last = 0;
    for (int k = 0; k < 300; ++k) {
      const auto felt = onto.tick(Vector(0.25, 0.0056 - 1e-4 * k));
      if (felt.places[1].touching && first < 0) first = felt.places[1].dissipated;
      last = std::max(last, felt.places[1].dissipated);
    }
    CHECK(first == 0);
    CHECK(last > 0);
    for (int k = 0; k < 50; ++k) (void)onto.tick(Vector(0.25, 0.05));
  }
}

// A way that was gone without friction would be a slip as friction comes back.
TEST_CASE("a contact whose friction is taken off and put on again begins anew", "[friction][several]") {
  Model model(steel_ruler(), 16);
  Touching touch(model, {finger(0.4), 0.005});
  const Vector away(0.25, -0.05);
  double x = 0.15;
  const auto draw = [&](double to) {
    double dissipated = 0;
    for (; x < to - 5e-5; x += 1e-4) dissipated = touch.tick(Vector(x, -0.01), away).places[0].dissipated;
    return dissipated;
  };
  for (int k = 0; k <= 100; ++k) (void)touch.tick(Vector(x, 0.006 - 1.6e-4 * k), away);
  const double taken = draw(0.17);
  touch.set_friction(0, 0);
  (void)draw(0.2);
  touch.set_friction(0, 0.4);
  CHECK(taken > 1e-3);
  CHECK(draw(0.2001) <= taken * (1 + 1e-12));
  CHECK(draw(0.205) > taken);
}
