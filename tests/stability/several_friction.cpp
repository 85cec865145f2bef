// Friction at several contacts on long ways: hands that go round closed paths, and hands that do what they like.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/check_cone.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include "support/rubbing.hpp"
#include "support/ruler.hpp"
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

template <class AnyModel>
Rubbing rubbing(const AnyModel& model, const Place& place) {
  return {place.s, place.normal, place.friction, stretch_at(model.shape(), place.s)};
}

}  // namespace

// Both hands go round closed paths of their own, either way about.  What they give is what friction took, whatever the step; ∫ T · dslip by trapezoids is as far
// from that as a tick is long.
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
          const double a = 2 * pi * t;
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
      double given = 0, taken = 0, felt = 0;
      Rubbing last[2];
      for (int k = 1; k <= 2 * ticks; ++k) {
        const Hands from = path(double(k - 1) / ticks), to = path(double(k) / ticks);
        const auto now = touch.tick(to.data(), 2);
        REQUIRE(now.status == Status::ok);
        for (int i = 0; i < 2; ++i) {
          const Place &a = before.places[std::size_t(i)], &b = now.places[std::size_t(i)];
          CAPTURE(n, k, i);
          REQUIRE(b.touching);
          check_cone(b, friction[i]);
          REQUIRE(b.dissipated >= a.dissipated);
          if (k <= ticks) {
            last[i] = rubbing(model, b);
            continue;
          }
          given -= (a.force + b.force).dot(to[std::size_t(i)] - from[std::size_t(i)]) / 2;
          taken += b.dissipated - a.dissipated;
          const Rubbing here = rubbing(model, b);
          felt += rubbed(last[i], here, reach);
          last[i] = here;
        }
        before = now;
      }
      CAPTURE(n, given, taken);
      CHECK(given > 0);
      CHECK(std::abs(given - taken) <= 1e-9 * taken);
      largest = std::max(largest, std::abs(felt - taken) / taken);
    }
    return largest;
  };
  const Beam bar(1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, Support::pinned);
  CHECK(worst(steel_ruler(), 0.0005, 0.03, 4, 6000) <= 1e-6);
  CHECK(worst(bar, 0.005, 0.008, 4, 6000) <= 1e-6);
  CHECK(worst(steel_ruler(), 0.0005, 0.03, 4, 6000, 32, 0.7) <= 1e-5);
  CHECK(worst(bar, 0.005, 0.008, 4, 6000, 16, 0.7) <= 3e-7);
  CHECK(worst(steel_ruler(), 0.0005, 0.03, 50, 300) <= 1e-3);
  CHECK(worst(bar, 0.005, 0.008, 50, 300) <= 1e-3);
}

// Nodes follow three contacts, whose parts of the ruler are short, and would pass from one part to another on this path: ∫ T · dslip then is 1.9e-4 off.
TEST_CASE("two hands that press a ruler onto a rough peg give what friction takes with 16 elements",
          "[friction][several]") {
  FemModel<Several<Corotational<>, 4>> model(steel_ruler(), 16);
  const Friction friction[3] = {0.0756, 0.6833, 0.282};
  TouchSeveral touch(model, {finger(friction[0]), finger(friction[1])},
                     {Prop<>::peg({0.16245, -0.006984}, 0.005).rough(friction[2])});
  const auto path = [](double t) {
    const double a = 2 * pi * t, up = 1 - std::cos(a);
    return Hands{
        Vector(0.12183 + 0.004153 * (std::sin(a + 0.2888) - std::sin(0.2888)), 0.001436 * up - 0.002002),
        Vector(0.19869 + 8e-4 * (std::sin(a + 0.2076) - std::sin(0.2076)), 0.001303 * up - 0.011172)};
  };
  for (int k = 0; k <= 200; ++k) {
    Hands at = path(0);
    for (Vector& hand : at) hand.y() += (0.00551 - hand.y()) * (1 - k / 200.0);
    (void)touch.tick(at.data(), 2);
  }
  constexpr int ticks = 6000;
  auto before = touch.tick(path(0).data(), 2);
  double given = 0, taken = 0, felt = 0, stored = 0;
  Rubbing last[3];
  for (int k = 1; k <= 2 * ticks; ++k) {
    const Hands from = path(double(k - 1) / ticks), to = path(double(k) / ticks);
    const auto now = touch.tick(to.data(), 2);
    REQUIRE(now.status == Status::ok);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &a = before.places[i], &b = now.places[i];
      REQUIRE(b.touching);
      check_cone(b, friction[i]);
      REQUIRE(b.dissipated >= a.dissipated);
      if (i < 2) given -= (a.force + b.force).dot(to[i] - from[i]) / 2;
      taken += b.dissipated - a.dissipated;
      const Rubbing here = rubbing(model, b);
      felt += rubbed(last[i], here, 0.0055);
      last[i] = here;
    }
    before = now;
    if (k == ticks) given = taken = felt = 0, stored = model.strain_energy();
  }
  CAPTURE(given, taken, felt, stored, model.strain_energy());
  CHECK(taken > 1);
  CHECK(std::abs(given - taken - (model.strain_energy() - stored)) <= 1e-9 * taken);
  CHECK(std::abs(felt - taken) <= 2.2e-6 * taken);
}

// Two hands and a peg, each with coefficients of its own; ways at the speed of a hand, jumps, and places that are none.
TEST_CASE("friction at several contacts keeps its cones whatever the hands do", "[friction][several]") {
  const Beam bar(1, Section::rectangle(0.02, 0.01), Material{200e9}, Support::pinned, Support::pinned);
  Random random(11);
  for (const bool ruler : {true, false}) {
    const Beam& beam = ruler ? steel_ruler() : bar;
    const double L = beam.length(), deep = ruler ? 0.1 : 0.02;
    const Friction friction[3] = {{0.8, 0.5}, 0.3, {1.2, 1.0}};
    FemModel<Several<Corotational<>, 4>> model(beam, 16);
    int rubbing = 0, unanswered = 0, ticks = 0;
    // Where a jump leads past the beam it is felt no more: they begin again above it.
    for (int begun = 0; begun < 30; ++begun) {
      model.reset();
      TouchSeveral touch(model, {finger(friction[0]), finger(friction[1])},
                         {Prop<>::peg({0.5 * L, -0.02 * L}, 0.01 * L).rough(friction[2])});
      Hands at{Vector(0.3 * L, 0.05 * L), Vector(0.7 * L, 0.05 * L)};
      std::array<double, 3> dissipated{};
      bool answered = true;
      const auto tick = [&] {
        const auto felt = touch.tick(at.data(), 2);
        int now = 0;
        for (const auto& place : felt) {
          const auto i = std::size_t(place.body);
          check_cone(place, friction[i]);
          // It falls where a touch has ended alone, which may be in ticks without an answer.
          if (place.touching && place.dissipated < dissipated[i] && answered)
            REQUIRE(place.dissipated <= 1e-3 * L);
          dissipated[i] = place.dissipated;
          now += place.friction.norm() > 0;
        }
        answered = is_answer(felt.status);
        rubbing += now > 1, unanswered += !answered, ++ticks;
      };
      for (int way = 0; way < 10; ++way) {
        const Hands from = at;
        const Hands to{Vector(random(-0.05, 0.6) * L, random(deep) * L),
                       Vector(random(0.4, 1.05) * L, random(deep) * L)};
        const int steps = way == 5 ? 1 : 60;
        for (int k = 1; k <= steps; ++k) {
          for (std::size_t i : {0u, 1u}) at[i] = from[i] + (to[i] - from[i]) * (double(k) / steps);
          tick();
        }
        if (way != 5) continue;
        const Vector before = at[1];
        at[1].x() = std::numeric_limits<double>::quiet_NaN();
        REQUIRE(touch.tick(at.data(), 2).status == Status::invalid_request);
        at[1] = before;
      }
      at = {Vector(0.3 * L, L), Vector(0.7 * L, L)};
      for (int k = 0; k < 30; ++k) (void)touch.tick(at.data(), 2);
      const auto felt = touch.tick(at.data(), 2);
      CHECK(is_answer(felt.status));
      CHECK((felt.force(0).isZero(0) && felt.friction(1).isZero(0)));
    }
    CAPTURE(ruler, rubbing, unanswered, ticks);
    CHECK(rubbing > ticks / 20);
    CHECK(unanswered <= rubbing / 8);  // a hand jams the ruler onto the peg: one in nine
  }
}
