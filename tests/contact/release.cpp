// What a touch remembers ends with its release: rulers that slip off, arches that snap, hands that are elsewhere at once.
#include <cmath>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include "support/status.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Turning = FemModel<Corotational<>>;
constexpr double length = ruler_length, radius = 0.005;

struct Count {
  int begun = 0, ended = 0, refused = 0;
  double largest = 0;  // [N]
  bool pressing = false;
  void add(const TouchResult<double>& r) {
    begun += r.pressing && !pressing;
    ended += pressing && !r.pressing;
    pressing = r.pressing;
    refused += !is_answer(r.status);
    largest = std::max(largest, r.force.norm());
  }
};

}  // namespace

// Strength of materials: a clamped ruler is never pressed harder than EI π²/(2 s)², and 24 N at half of its length.
TEST_CASE("a hand led straight past the tip of a ruler touches it once, at any speed", "[push]") {
  Turning model(steel_ruler(), 16);
  for (const double x : {0.15, 0.20, 0.22, 0.24, 0.25, 0.26, 0.28, 0.29})
    for (const double step : {1e-4, 2e-4, 4e-4, 5e-4, 1e-3}) {
      Touch<Turning> touch(model, radius);
      Count count;
      for (double w = 0.02; w > -0.35; w -= step) count.add(touch.tick({x, w}));
      CAPTURE(x, step, count.refused);
      CHECK((count.begun == 1 && count.ended == 1));
      CHECK(count.largest < 25);
      CHECK(count.refused <= 4);  // at the tip itself, where a fall may take more solves than a tick has
      CHECK(model.shape()[16].w == 0);
      // Back up, through the ruler: from below, and once more.
      for (double w = -0.35; w < 0.35; w += 4e-4) count.add(touch.tick({x, w}));
      CHECK((count.begun == 2 && count.ended == 2));
    }
}

// A roller is rigid across the beam and free along it: where a press beside it draws it from under the hand, the hand has slipped
// off, and has the beam again only after it has left it.
TEST_CASE("a hand led down beside an end that holds w, or past it, touches it once", "[push]") {
  const auto strokes = [](auto& model) {
    using Model = std::decay_t<decltype(model)>;
    for (const double r : {0.0, 0.001, 0.005, 0.02})
      for (const double beyond : {-0.05, -0.02, -0.01, -0.005, -0.002, 0.0, 0.005, 0.012})
        for (const double step : {5e-5, 3e-4}) {
          const double reach = r + ruler_thickness / 2, x = length * (1 + beyond);
          if (beyond * length > 0.98 * reach) continue;
          Touch<Model> touch(model, r);
          Count count;
          for (double w = 1.1 * reach; w > -2.2 * reach - 0.01; w -= step) count.add(touch.tick({x, w}));
          CAPTURE(r, beyond, step, count.begun, count.ended);
          CHECK((count.begun == 1 && count.ended <= 1));
        }
  };
  for (const auto& [left, right] : {std::pair{Support::pinned, Support::roller},
                                    {Support::pinned, Support::pinned},
                                    {Support::clamped, Support::clamped},
                                    {Support::free, Support::clamped},
                                    {Support::clamped, Support::guided}}) {
    CAPTURE(name(left), name(right));
    FemModel<> moderate(steel_ruler(left, right), 16);
    strokes(moderate);
    Turning turning(steel_ruler(left, right), 16);
    strokes(turning);
  }
}

TEST_CASE("large and small circles that slip off a ruler askew touch it once", "[push]") {
  Turning turning(steel_ruler(), 16);
  FemModel<> moderate(steel_ruler(), 16);
  Random random(3);
  const auto strokes = [&](auto& model) {
    for (int k = 0; k < 60; ++k) {
      const double r = length * std::pow(10, random(-3.0, -0.8)), x = length * random(0.5, 1.1),
                   angle = random(0.6);
      const double step = length * std::pow(10, random(-3.0, -2.0));
      Touch<std::decay_t<decltype(model)>> touch(model, r);
      Count count;
      const Vector way(std::sin(angle), -std::cos(angle));
      for (Vector hand(x - 1.5 * r * way.x(), 1.5 * r); hand.y() > -length; hand += step * way)
        count.add(touch.tick(hand));
      CAPTURE(k, r, x, angle, step);
      CHECK(count.begun <= 1);
    }
  };
  strokes(turning);
  strokes(moderate);
}

TEST_CASE("an arch that snaps away is let go once, and pressed again where it lies", "[push]") {
  const Beam beam = arch(0.5, 0.02, Section::rectangle(0.02, 5e-4), Material{200e9}, Support::pinned);
  Turning model(beam, 16);
  const double top = model.shape().at(beam.length() / 2).w, reach = radius + model.thickness() / 2;
  REQUIRE(top > 0.015);
  Touch<Turning> touch(model, radius);
  Count count;
  bool snapped = false;
  double w = top + reach + 2e-3;
  for (; w > -0.5 * top; w -= 1e-4) {
    const auto r = touch.tick({0.25, w});
    count.add(r);
    snapped = snapped || r.status == Status::snapped;
  }
  CHECK(snapped);
  CHECK((count.begun == 1 && count.ended == 1));
  const double low = model.shape().at(beam.length() / 2).w;
  REQUIRE(low < -0.8 * top);
  for (; w > low + reach + 2e-4; w -= 1e-4) count.add(touch.tick({0.25, w}));
  CHECK(count.begun == 1);
  for (; w > low; w -= 1e-4) count.add(touch.tick({0.25, w}));
  CHECK((count.begun == 2 && count.ended == 1));
}

TEST_CASE("a hand that is lengths away at once holds a beam for a few ticks at the most", "[push]") {
  for (const Support right : {Support::free, Support::roller, Support::pinned}) {
    Turning model(steel_ruler(right == Support::free ? Support::clamped : Support::pinned, right), 16);
    for (const double far : {5.0, 7.0, 20.0, 1e3}) {
      Touch<Turning> touch(model, radius);
      (void)touch.tick({0.2, 0.02});
      Count count;
      int pressing = 0;
      for (int tick = 0; tick < 80; ++tick) {
        count.add(touch.tick({0.2, -far * length}));
        pressing += count.pressing;
      }
      CAPTURE(name(right), far, pressing);
      CHECK(pressing <= 2 * Touch<Turning>::patience);
      CHECK((count.begun <= 1 && !count.pressing));
    }
  }
}

TEST_CASE("two touches of one model in turn, and of two shapes, know nothing of each other") {
  Turning straight(steel_ruler(), 8), finer(steel_ruler(), 24);
  for (Turning* model : {&straight, &finer, &straight}) {
    Touch<Turning> touch(*model, radius);
    (void)touch.tick({0.2, 0.02});
    const auto pressed = touch.tick({0.2, -0.01});
    CHECK(pressed.force.y() > 0);
    touch.reset();
    CHECK_FALSE(touch.tick({0.2, -0.01}).pressing);
    CHECK(touch.tick({0.2, -0.001}).force.y() < 0);  // from below
  }
}

// Eight elements: one of them has all of the corner.
TEST_CASE("an L that is pressed softly and let go has not snapped, however tight its corner", "[release]") {
  for (const double corner : {1.6, 2.0, 2.2})
    for (const int elements : {8, 16}) {
      constexpr double whole = 0.2, h = 2.7e-4, EA = 2e11 * 0.02 * h;
      Beam beam(whole, EA, EA * h * h / 12, h, Support::clamped, Support::free);
      beam.naturally({{0.12, 0}, {0.14, corner / 0.02}, {whole, 0}});
      FemModel<Corotational<>> model(beam, elements);
      Touch<FemModel<Corotational<>>> touch(model, 0.002);
      const auto place = [&](double s) {
        const auto moved = model.shape().at(s);
        return Vector2<double>(s + moved.u, moved.w);
      };
      const Vector2<double> on = place(0.16), along = (place(0.161) - on).normalized(),
                            to(along.y(), -along.x());
      int pressed = 0;
      for (int k = 0; k <= 60; ++k) {
        const double way = 1e-5 * (k <= 30 ? k : 60 - k);
        const auto felt = touch.tick(on + to * (way - 0.002 - h / 2 - 1e-5));
        CAPTURE(corner, elements, k);
        CHECK(felt.status == Status::ok);
        pressed += felt.pressing;
      }
      CHECK(pressed > 40);
      CHECK_FALSE(touch.pressing());
    }
}
