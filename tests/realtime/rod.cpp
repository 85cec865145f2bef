// push(), release() and reset() of rods in space: no heap, finite, and a bounded number of linear solves.
#include <cmath>
#include <realtime/heap_watch.hpp>
#include <vector>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/touch.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// A hand that goes around a rod, slides, jumps, lets go, and asks for what is none.
std::vector<Push<double, 3>> pushes(double length, unsigned seed) {
  Random random(seed);
  std::vector<Push<double, 3>> path;
  for (int k = 0; k < 300; ++k) {
    const double a = 0.05 * k;
    path.push_back(
        {length * (0.3 + 0.002 * k), 0.05 * length * std::sin(0.2 * a), {0, std::cos(a), std::sin(a)}});
  }
  for (int k = 0; k < 60; ++k) {
    const Point n = detail::unit(Point(random(1.0), random(1.0), random(1.0)));
    path.push_back({random(-0.1, 1.1) * length, random(length), n});
  }
  for (const double bad : {std::nan(""), double(INFINITY), 1e300})
    for (const Push<double, 3>& p : {Push<double, 3>{bad, 0, {0, 1, 0}},
                                     {length / 2, bad, {0, 1, 0}},
                                     {length / 2, 0, {0, bad, 0}},
                                     {length / 2, 0.001, {0, 1, 0}}})
      path.push_back(p);
  return path;
}

template <class Element>
void check_servo(const char* name, const Point& moment = {0, 0, 0}) {
  PressedRod pressed = pressed_rod(name);
  if (!moment.isZero(0)) pressed.rod.add({pressed.rod.length(), {0, 0, 0}, moment});
  FemModel<Element> model(pressed.rod, 8 * pressed.turns);
  const auto path = pushes(pressed.rod.length(), 51);
  int answered = 0, not_finite = 0, most = 0, taken = 0;
  const HeapUse use = heap_use([&]() noexcept {
    int k = 0;
    for (const auto& push : path) {
      const auto response = model.push(push);
      answered += is_answer(response.status);
      taken += std::abs(push.normal.norm() - 1) > 0.1 && response.status != Status::invalid_request;
      not_finite += !std::isfinite(response.force);
      most = std::max(most, model.report().solves);
      for (const auto& node : model.shape()) not_finite += !is_finite(node);
      not_finite += !std::isfinite(peak_strain(model).strain);
      if (++k % 50 == 0) (void)model.release();
    }
    model.reset();
  });
  INFO(name << ": " << answered << " of " << path.size() << " answered, at most " << most << " solves");
  CHECK(use == HeapUse{});
  CHECK(not_finite == 0);
  CHECK(taken == 0);  // a normal that is none
  CHECK(most <= 48 + 2);
  CHECK(answered > 200);  // most jumps lead beyond the rod's length
  // Recovered.
  const double home = pressed.normal.dot(model.shape().at(pressed.s).r);
  CHECK(model.push({pressed.s, home + 0.001, pressed.normal}).status == Status::ok);
}

}  // namespace

TEST_CASE("a rod that is pushed takes nothing from the heap", "[realtime][rod]") {
  check_servo<RoundRod>("wire_under_load");
  check_servo<TwistedRod>("wire_under_load");
  check_servo<TwistedRod>("bar_two_ways");
  check_servo<TwistedRod>("strip_askew");
  check_servo<TwistedRod>("strip_askew", {0.002, 0.02, 0.01});
  check_servo<TwistedRod>("hook");
  check_servo<TwistedRod>("spring");
}

namespace {

/// A sphere and a stylus: around the rod, through it, off its end, into its clamp, elsewhere, nowhere.
template <class Model>
void check_touch(Model& model, double radius) {
  const double length = model.shape().length();
  Touch<Model> touch(model, radius);
  Random random(52);
  std::vector<Shaft<double>> path;
  for (int k = 0; k < 400; ++k) {
    const double a = 0.05 * k;
    path.push_back(
        {length * Point(0.3 + 0.002 * k, 0.03 * std::sin(a), 0.05 * std::cos(0.37 * a)), {0, 0, 0}});
  }
  for (int k = 0; k < 400; ++k) {
    const double a = 0.05 * k;
    path.push_back(
        {length * Point(0.9 - 0.003 * k, -0.2, 0.3 * std::cos(0.2 * a)), length * Point(0, 0.5, 0.1)});
  }
  for (int k = 0; k < 200; ++k)
    path.push_back({length * Point(random(-0.2, 1.2), random(0.3), random(0.3)),
                    (k % 2) * length * Point(random(0.3), random(0.3), random(0.3))});
  path.push_back({{std::nan(""), 0, 0}, {0, 0, 0}});
  path.push_back({{0, 0, 0}, {INFINITY, 0, 0}});
  path.push_back({{1e300, 0, 0}, {0, 0, 0}});
  path.push_back({length * Point(0.7, 0, 0.005), {0, 0, 0}});
  int pressing = 0, not_finite = 0, most = 0;
  const HeapUse use = heap_use([&]() noexcept {
    for (const auto& axis : path) {
      const auto felt = touch.tick(axis.tip, axis.way);
      (void)touch.contact_at(axis.tip);
      pressing += felt.pressing;
      not_finite += !felt.force.allFinite();
      most = std::max(most, model.report().solves);
      for (const auto& node : model.shape()) not_finite += !is_finite(node);
    }
    touch.reset();
  });
  INFO(pressing << " of " << path.size() << " pressing, at most " << most << " solves");
  CHECK(use == HeapUse{});
  CHECK(not_finite == 0);
  CHECK(most <= 48 + 2 * 4);
  CHECK(pressing > 150);
  STATIC_REQUIRE(noexcept(touch.tick(std::declval<const Point&>())));
  STATIC_REQUIRE(noexcept(touch.tick(std::declval<const Point&>(), std::declval<const Point&>())));
}

}  // namespace

TEST_CASE("a rod that is touched takes nothing from the heap", "[realtime][rod]") {
  const Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
  FemModel<RoundRod> round(wire, 8);
  check_touch(round, 0.005);
  FemModel<TwistedRod> twisted(pressed_rod("wire_under_load").rod, 8);
  check_touch(twisted, 0.005);
}

TEST_CASE("models of rods promise what a force model has to", "[realtime][rod]") {
  STATIC_REQUIRE(is_force_model<FemModel<RoundRod>>);
  STATIC_REQUIRE(is_force_model<FemModel<TwistedRod>>);
  STATIC_REQUIRE(takes_push<FemModel<TwistedRod>>);
  STATIC_REQUIRE(FemModel<TwistedRod>::dimension == 3);
}
