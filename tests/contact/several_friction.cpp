// Friction at several contacts of a beam: each keeps its own cone, and together they take what the hands give.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "realtime/counting_element.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
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
using Hands = std::array<Vector, 2>;

/// What a contact must say whatever the hands do.
template <class Place>
void check_law(const Place& place, const Friction& friction) {
  const double normal = (place.force - place.friction).norm();
  REQUIRE(place.force.allFinite());
  REQUIRE((place.force - place.friction).dot(place.normal) >= 0);
  REQUIRE(place.friction.norm() <= friction.sticking * normal * (1 + 1e-14));
  // In a bend as sharp as the circle a plane stands for it, whose place is found to a hundredth of the reach.
  if (is_answer(place.status)) REQUIRE(std::abs(place.friction.dot(place.normal)) <= 1e-2 * normal);
  if (place.sliding) REQUIRE(place.friction.norm() <= friction.sliding * normal * (1 + 1e-14));
  if (!place.touching) REQUIRE((place.force.isZero(0) && place.dissipated == 0));
}

RoundAvatar finger(const Friction& friction) { return {0.005, 1, friction}; }

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
    const double a = 2 * 3.14159265358979323846 * k / 1500;
    const Vector hand(0.2 + 0.01 * std::sin(2 * a), 0.0056 - 0.03 * (1 - std::cos(a)));
    const auto r = alone.tick(hand);
    const auto felt = touch.tick(hand);
    const Place& place = felt.places[0];
    check_law(place, friction);
    largest = std::max(largest, r.force.norm());
    REQUIRE((place.force - r.force).norm() <= 1e-7 * largest);
    REQUIRE(place.sliding == r.sliding);
    REQUIRE(std::abs(place.dissipated - r.dissipated) <= 1e-7 * largest * 0.04);
    sliding += r.sliding;
  }
  CHECK(largest > 5);
  CHECK(sliding > 1000);
}

// Both hands go round closed paths of their own, either way about.
TEST_CASE("work of two hands round closed paths is what friction takes at both", "[friction][several]") {
  // @param less  the coefficient of sliding, in units of the other one
  const auto worst = [](const Beam& beam, double half, double most, int paths, int ticks, int elements = 16,
                        double less = 1) {
    Random random(7);
    Model model(beam, elements);
    double largest = 0;
    for (int n = 0; n < paths; ++n) {
      const double L = beam.length(), reach = 0.005 + half, deep = most * random(0.5, 1.0);
      const double left = random(0.05, 1.2), right = random(0.05, 1.2);
      const Friction friction[2] = {{left, less * left}, {right, less * right}};
      Vector home[2];
      double wide[2], high[2], way[2], phase[2];
      for (int k = 0; k < 2; ++k) {
        const double side = k == 0 ? -1 : 1;  // the left one lifts the beam, the right one presses it
        home[k] = {L * (k == 0 ? random(0.3, 0.45) : random(0.65, 0.8)),
                   side * (reach - deep * (1 + side) / 3)};
        wide[k] = L * random(0.002, 0.02), high[k] = 0.2 * deep * random(0.01, 1.0);
        way[k] = random.integer(0, 1) == 0 ? 1 : -1, phase[k] = random(6.283);
      }
      const auto path = [&](double t) {
        Hands at;
        for (int k = 0; k < 2; ++k) {
          const double a = 2 * 3.14159265358979323846 * t;
          at[std::size_t(k)] =
              home[k] + Vector(wide[k] * (std::sin(way[k] * a + phase[k]) - std::sin(phase[k])),
                               high[k] * (1 - std::cos(a)));
        }
        return at;
      };
      model.reset();
      Touching touch(model, {finger(friction[0]), finger(friction[1])});
      for (int k = 0; k <= 40; ++k) {
        Hands at = path(0);
        for (int i : {0, 1}) {
          double& y = at[std::size_t(i)].y();
          y += ((i == 0 ? -1 : 1) * (reach + 1e-5) - y) * (1 - k / 40.0);
        }
        (void)touch.tick(at.data(), 2);
      }
      auto before = touch.tick(path(0).data(), 2);
      double given = 0, taken = 0;
      for (int k = 1; k <= 2 * ticks; ++k) {
        const Hands from = path(double(k - 1) / ticks), to = path(double(k) / ticks);
        const auto now = touch.tick(to.data(), 2);
        REQUIRE(now.status == Status::ok);
        for (int i = 0; i < 2; ++i) {
          const Place &a = before.places[std::size_t(i)], &b = now.places[std::size_t(i)];
          CAPTURE(n, k, i);
          REQUIRE(b.touching);
          check_law(b, friction[i]);
          REQUIRE(b.dissipated >= a.dissipated);
          if (k <= ticks) continue;
          given -= (a.force + b.force).dot(to[std::size_t(i)] - from[std::size_t(i)]) / 2;
          taken += b.dissipated - a.dissipated;
        }
        before = now;
      }
      CAPTURE(n, given, taken);
      CHECK(given > 0);
      largest = std::max(largest, std::abs(given - taken) / taken);
    }
    return largest;
  };
  const Beam bar(1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, Support::pinned);
  CHECK(worst(steel_ruler(), 0.0005, 0.03, 4, 6000) <= 1e-6);
  CHECK(worst(bar, 0.005, 0.008, 4, 6000) <= 1e-6);
  CHECK(worst(steel_ruler(), 0.0005, 0.03, 4, 6000, 32, 0.7) <= 3e-7);
  CHECK(worst(bar, 0.005, 0.008, 4, 6000, 16, 0.7) <= 3e-7);
  CHECK(worst(steel_ruler(), 0.0005, 0.03, 50, 300) <= 1e-3);
  CHECK(worst(bar, 0.005, 0.008, 50, 300) <= 1e-3);
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

// Two hands and a peg, each with coefficients of its own; ways at the speed of a hand, jumps, and places that are none.
TEST_CASE("friction at several contacts keeps its cones whatever the hands do", "[friction][several]") {
  using Three = FemModel<Several<Corotational<>, 3>>;
  const Beam bar(1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, Support::pinned);
  Random random(11);
  for (const bool ruler : {true, false}) {
    const Beam& beam = ruler ? steel_ruler() : bar;
    const double L = beam.length(), deep = ruler ? 0.1 : 0.02;
    const Friction friction[3] = {{0.8, 0.5}, 0.3, {1.2, 1.0}};
    Three model(beam, 16);
    TouchSeveral touch(model, {finger(friction[0]), finger(friction[1])},
                       {Prop<>::peg({0.5 * L, -0.02 * L}, 0.01 * L).rough(friction[2])});
    Hands at{Vector(0.3 * L, 0.05 * L), Vector(0.7 * L, 0.05 * L)};
    int rubbing = 0, unanswered = 0, ticks = 0;
    std::array<double, 3> dissipated{};
    bool answered = true;
    const auto tick = [&] {
      const auto felt = touch.tick(at.data(), 2);
      int now = 0;
      for (const auto& place : felt) {
        const auto i = std::size_t(place.body);
        check_law(place, friction[i]);
        // It falls where a touch has ended alone, which may be in ticks without an answer.
        if (place.touching && place.dissipated < dissipated[i] && answered)
          REQUIRE(place.dissipated <= 1e-3 * L);
        dissipated[i] = place.dissipated;
        now += place.friction.norm() > 0;
      }
      answered = is_answer(felt.status);
      rubbing += now > 1, unanswered += !answered, ++ticks;
    };
    for (int way = 0; way < 150; ++way) {
      const Hands from = at;
      const Hands to{Vector(random(-0.05, 0.6) * L, random(deep) * L),
                     Vector(random(0.4, 1.05) * L, random(deep) * L)};
      const int steps = way % 10 == 0 ? 1 : 60;
      for (int k = 1; k <= steps; ++k) {
        for (std::size_t i : {0u, 1u}) at[i] = from[i] + (to[i] - from[i]) * (double(k) / steps);
        tick();
      }
      if (way % 20 != 0) continue;
      const Vector before = at[1];
      at[1].x() = std::numeric_limits<double>::quiet_NaN();
      REQUIRE(touch.tick(at.data(), 2).status == Status::invalid_request);
      at[1] = before;
    }
    CAPTURE(ruler, rubbing, unanswered, ticks);
    CHECK(rubbing > ticks / 20);
    CHECK(unanswered <= ticks / 20);  // a hand jams the ruler onto the peg
    at = {Vector(0.3 * L, L), Vector(0.7 * L, L)};
    for (int k = 0; k < 30; ++k) (void)touch.tick(at.data(), 2);
    const auto felt = touch.tick(at.data(), 2);
    CHECK(is_answer(felt.status));
    CHECK((felt.force(0).isZero(0) && felt.friction(1).isZero(0)));
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
      const double a = 2 * 3.14159265358979323846 * k / 500;
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
