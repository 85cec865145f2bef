// A hand that goes on finds the beam where it was foreseen: in fewer linear solves, and the same as ever.
#include <cmath>

#include "realtime/counting_element.hpp"
#include "support/arch.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/push_round.hpp"
#include "support/ruler.hpp"
#include "support/status.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Element = CountingElement<Corotational<>>;
using Model = FemModel<Element>;

constexpr double radius = 0.005;
constexpr int elements = 8;

/// A beam and the circle that is led over it.
struct Hand {
  explicit Hand(const Beam& beam) : model(beam, elements), reach(radius + beam.thickness() / 2) {}
  Hand(const Hand&) = delete;

  TouchResult<double> push(const Vector& at) { return touch.tick(at); }
  /// Linear solves of the push; those who look twice are counted.
  int solves(const Vector& at) {
    Element::tangents = 0;
    (void)push(at);
    return static_cast<int>(Element::tangents) / elements;
  }

  Model model;
  Touch<Model> touch{model, radius};
  double reach;
};

Beam bow() { return level_arch(0.2, 0.5, 1e6, 0.02, 0.0005, Support::pinned, Support::pinned); }
const double rise = level_arch_rise(0.2, 0.5);

}  // namespace

TEST_CASE("a hand that goes on finds the beam where it was foreseen", "[push]") {
  Hand hand(steel_ruler());
  Vector at(0.11, hand.reach);
  for (int k = 0; k < 300; ++k) (void)hand.push(at -= Vector(0, 1e-4));
  int pressing = 0, sliding = 0;
  for (int k = 0; k < 200; ++k) pressing += hand.solves(at -= Vector(0, 1e-5));
  CHECK(pressing <= 220);  // one each, where two are taken from the last equilibrium
  for (int k = 0; k < 200; ++k) sliding += hand.solves(at += Vector(2e-4, 0));
  CHECK(sliding <= 440);
}

// Newton's method ends at 1e-6 of the force wherever it began.
TEST_CASE("the force of a foreseen shape is that of a hand which rests there", "[push]") {
  for (const bool arch : {false, true}) {
    Hand hand(arch ? bow() : steel_ruler());
    Vector at(arch ? 0.089 : 0.11, hand.reach + (arch ? rise : 0));
    for (int k = 0; k < 150; ++k) (void)hand.push(at -= Vector(0, arch ? 2e-5 : 3e-4));
    for (int k = 0; k < 300; ++k) {
      const double turn = 0.02 * k;
      at += (arch ? 5e-5 : 3e-4) * Vector(std::cos(turn), -std::sin(turn));
      const TouchResult<double> pushed = hand.push(at);
      REQUIRE(is_answer(pushed.status));
      Model rests = hand.model;
      Pushed<double> there{};
      PushRound push(rests);
      for (int again = 0; again < 3; ++again) there = push({pushed.contact.s, at, hand.reach, 1});
      REQUIRE(relative_error(pushed.force.norm(), -there.force) <= 1e-5);
      REQUIRE((pushed.contact.normal - there.normal).norm() <= 1e-5);
    }
  }
}

// In the middle it gives way to the side, and only a look at the tangent says so.  The first tick past that is within a step of it, and the fall ends
// with the third one.
TEST_CASE("an arch snaps at the same place however long the steps are", "[push]") {
  const double middle = 0.2 / 0.5 * std::sin(0.25);
  for (const double x : {0.0848, middle}) {
    const auto snaps_at = [&](double step) {
      Hand hand(bow());
      for (int k = 1; k * step < 4 * rise; ++k)
        if (hand.push({x, hand.reach + rise - k * step}).status == Status::snapped) return k * step;
      return 0.0;
    };
    const double exact = snaps_at(5e-6);
    REQUIRE(exact > 0);
    for (const double step : {1e-5, 3e-5, 1e-4, 2e-4, 4e-4}) {
      CAPTURE(x, step);
      const double at = snaps_at(step);
      CHECK(at > exact - 5e-6);
      CHECK(at < exact + 3.01 * step);
    }
  }
}

TEST_CASE("a hand that turns back, rests, or jumps has the answer of one that came slowly", "[push]") {
  Hand hand(steel_ruler()), slow(steel_ruler());
  const Vector begin(0.11, hand.reach - 0.02);
  for (Hand* const each : {&hand, &slow})
    for (int k = 1; k <= 100; ++k) (void)each->push({0.11, hand.reach - 2e-4 * k});
  Vector before = begin;
  const auto goes = [&](const Vector& to) {
    const TouchResult<double> at_once = hand.push(to);
    TouchResult<double> gradually{};
    for (int k = 1; k <= 40; ++k) gradually = slow.push(before + (to - before) * (k / 40.0));
    before = to;
    REQUIRE(is_answer(at_once.status));
    REQUIRE((at_once.force - gradually.force).norm() <= 1e-5 * gradually.force.norm());
  };
  const Vector step(3e-4, -3e-4);
  goes(begin + step);
  goes(begin + 2 * step);
  goes(begin + step);                     // back
  goes(begin + step);                     // rests
  goes(begin + step + Vector(0, 2e-4));   // from rest
  goes(begin - step);                     // faster
  goes(begin + Vector(0.02, -0.01));      // jumps
  goes(begin + Vector(0.0201, -0.0101));  // creeps on
}
