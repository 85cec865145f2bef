// What a touch owes to the hand, whichever model it presses: what it remembers ends with the release.
//
//   check_touch<Model>(make, tolerance);      within a SECTION of force_model_suite.cpp, so over every ForceModel
//   check_friction(make, radius);             of a model by its own type, which says whether it takes friction
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/status.hpp"
#include <hapbeam/contact/touch.hpp>

namespace hapbeam::testing {

/// A hand on one beam, and how often it has touched it.
template <class Model>
struct Stroke {
  using Scalar = typename Model::Scalar;
  using Vector = Vector2<Scalar>;

  Touch<Model> touch;
  Vector hand;
  int begun = 0, ended = 0, ticks = 0;
  bool pressing = false;
  std::vector<Vector> forces;  ///< of every tick [N]

  Stroke(Model& model, Scalar radius, const Vector& from) : touch(model, radius), hand(from) {
    move(from, 1);
  }

  void move(const Vector& to, int steps) {
    const Vector from = hand;
    for (int k = 1; k <= steps; ++k) {
      hand = from + (to - from) * (Scalar(k) / Scalar(steps));
      const TouchResult<Scalar> result = touch.tick(hand);
      begun += result.pressing && !pressing;
      ended += pressing && !result.pressing;
      pressing = result.pressing;
      ++ticks;
      forces.push_back(result.force);
      INFO("tick " << ticks << ", hand at " << hand.x() << ", " << hand.y() << " m: " << name(result.status));
      REQUIRE(result.force.allFinite());
      if (!pressing) REQUIRE(result.force.isZero(0));
    }
  }
};

/// Straight down, over both ends and past them, from both sides: one beginning, and one end at the most.  Past an end that holds w
/// the disc slides round a fixed point.  Its force then changes in a tick by no more than stiffness and direction explain: the force
/// grows with no more than the cube of the depth, and turns with the way from the end to the disc.
template <class Make, typename Scalar>
void check_touch_at_ends(Make make, Scalar radius) {
  using Model = decltype(make());
  Model model = make();
  const Range<Scalar> range = model.range();
  const Scalar length = model.shape().length(), reach = radius + model.thickness() / 2;
  const int steps = 400;
  for (const bool right : {false, true}) {
    const Scalar edge = right ? range.s_max : range.s_min, deep = range.depth_at(edge);
    const bool held = std::isfinite(right ? range.right_support : range.left_support);
    Model fresh = make();
    const Scalar stiffness = std::abs(fresh.press({edge, -deep}).force) / deep;
    for (const Scalar beyond :
         {-length / 100, -length / 500, Scalar(0), reach * Scalar(0.3), reach * Scalar(0.7)})
      for (const Scalar side : {Scalar(1), Scalar(-1)}) {
        const Scalar x = right ? length + beyond : -beyond, high = side * Scalar(1.1) * reach;
        Stroke<Model> stroke(model, radius, {x, high});
        stroke.move({x, -high}, steps);
        INFO("led down at " << x << " m from side " << side << ": " << stroke.begun << " beginnings, "
                            << stroke.ended << " ends");
        CHECK((stroke.begun == 1 && stroke.ended <= 1));
        if (!held || beyond <= 0) continue;
        CHECK(stroke.ended == 1);
        Scalar largest = 0, change = 0;
        for (std::size_t k = 0; k < stroke.forces.size(); ++k) {
          largest = std::max(largest, stroke.forces[k].norm());
          if (k > 0) change = std::max(change, (stroke.forces[k] - stroke.forces[k - 1]).norm());
        }
        const Scalar step = 2 * std::abs(high) / Scalar(steps);
        CHECK(largest > 0);
        CHECK(change <= step * (3 * std::max(stiffness, largest / reach) + largest / beyond) * Scalar(1.1));
      }
  }
}

/// Coulomb's law, as far as one tick shows it, of a model that takes friction: never a pull, the share of the normal force, energy that only
/// grows; and without coefficients the touch without friction, to the last bit.
template <class Make, typename Scalar>
void check_friction(Make make, Scalar radius) {
  using Model = decltype(make());
  using Vector = Vector2<Scalar>;
  const Friction friction(0.5, 0.3);
  Model model = make();
  if constexpr (!takes_push<Model>) {
    CHECK_THROWS_AS(Touch<Model>(model, radius, friction), std::invalid_argument);
  } else {
    Model smooth = make(), smoother = make();
    Touch<Model> touch(model, radius, friction), none(smooth, radius), zero(smoother, radius, Friction(0));
    const Range<Scalar> range = model.range();
    const Scalar length = model.shape().length(), middle = (range.s_min + range.s_max) / 2;
    const double share = 1 + 8 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
    Scalar dissipated = 0;
    int sliding = 0, sticking = 0;
    bool pressing = false;
    for (int k = 0; k <= 1200; ++k) {
      const double turn = k / 100.0;
      const Vector hand(middle + length * static_cast<Scalar>(0.04 * std::sin(turn)),
                        radius - length * static_cast<Scalar>(0.02 - 0.022 * std::cos(0.7 * turn)));
      const auto r = touch.tick(hand);
      const Vector across = r.force - r.friction;
      const double normal = static_cast<double>(across.norm());
      REQUIRE(r.force.allFinite());
      REQUIRE(across.dot(r.contact.normal) >= 0);
      REQUIRE(static_cast<double>(r.friction.norm()) <= friction.sticking * normal * share);
      if (!r.pressing) REQUIRE(r.force.isZero(0));
      if (r.pressing && pressing) REQUIRE(r.dissipated >= dissipated);
      dissipated = r.dissipated;
      pressing = r.pressing;
      sliding += r.sliding;
      sticking += r.pressing && !r.sliding;
      REQUIRE(none.tick(hand).force == zero.tick(hand).force);
    }
    CHECK(sliding > 100);
    CHECK(sticking > 0);

    // Around a closed path friction takes what the hand gives, to round-off of the energy.
    constexpr int lap = 300;
    const auto at = [&](int k) {
      const double turn = 2 * pi * k / lap;
      return Vector(middle + length * static_cast<Scalar>(0.02 * std::sin(turn)),
                    radius - length * static_cast<Scalar>(0.02 - 0.004 * std::cos(turn)));
    };
    touch.reset();
    for (int k = 0; k < 100; ++k)
      (void)touch.tick(at(0) + Vector(0, length * static_cast<Scalar>(0.03 - 0.0003 * k)));
    auto before = touch.tick(at(0));
    double given = 0, taken = 0;
    bool one = true;
    for (int k = 1; k <= 2 * lap; ++k) {
      const auto r = touch.tick(at(k));
      one = one && r.pressing && r.status == Status::ok;
      if (k > lap) {
        given -= static_cast<double>((r.force + before.force).dot(at(k) - at(k - 1))) / 2;
        taken += static_cast<double>(r.dissipated - before.dissipated);
      }
      before = r;
    }
    CAPTURE(given, taken);
    CHECK(one);
    CHECK(given > 0);
    CHECK(std::abs(given - taken) <=
          1e6 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()) * taken);
  }
}

/// @param tolerance  of two forces of the same press, relative to the larger
template <class Model>
void check_touch(const std::function<Model()>& make, typename Model::Scalar tolerance) {
  using Scalar = typename Model::Scalar;
  using Vector = Vector2<Scalar>;
  Model model = make();
  const Range<Scalar> range = model.range();
  const Scalar length = model.shape().length(), radius = length / 200, reach = radius + model.thickness() / 2;
  const Scalar middle = (range.s_min + range.s_max) / 2, deep = range.depth_at(middle) / 2;

  // Down, and up again: one beginning and one end, and the field after the release is that of a first contact.
  for (const Scalar side : {Scalar(1), Scalar(-1)}) {
    const Vector above(middle, side * 2 * reach), below(middle, side * (reach - deep));
    const auto press = [&](Stroke<Model>& stroke) {
      stroke.forces.clear();
      stroke.move(below, 60);
      stroke.move(above, 60);
    };
    Stroke<Model> again(model, radius, above);
    press(again);
    CHECK((again.begun == 1 && again.ended == 1));
    again.move({middle, -above.y()}, 1);  // a step through the beam takes it along
    CHECK(again.pressing);
    again.move(above, 1);
    CHECK_FALSE(again.pressing);
    again.move({length + 4 * reach, above.y()}, 20);  // round its end, and back
    again.move({length + 4 * reach, -above.y()}, 20);
    again.move({middle, -above.y()}, 20);
    CHECK(again.begun == 2);
    again.move({length + 4 * reach, -above.y()}, 20);
    again.move({length + 4 * reach, above.y()}, 20);
    again.move(above, 20);
    CHECK(again.begun == 2);
    press(again);
    CHECK((again.begun == 3 && again.ended == 3));
    Model fresh = make();
    Stroke<Model> first(fresh, radius, above);
    press(first);
    Scalar largest = 0, apart = 0;
    for (std::size_t k = 0; k < first.forces.size(); ++k) {
      largest = std::max(largest, first.forces[k].norm());
      apart = std::max(apart, (first.forces[k] - again.forces[k]).norm());
    }
    CHECK(largest > 0);
    CHECK(apart <= tolerance * largest);
  }

  // Slid off an end while it is bent: whoever comes back below it, however fast, is below a new beam.
  for (const Scalar beyond : {Scalar(-4 * reach), length + 4 * reach}) {
    Stroke<Model> stroke(model, radius, {middle, 2 * reach});
    const Scalar low = -std::max(deep, 3 * reach);
    stroke.move({middle, low}, 60);
    CHECK(stroke.begun == 1);
    stroke.move({beyond, low}, 200);
    CHECK((stroke.begun == 1 && stroke.ended <= 1));
    if (stroke.pressing) continue;  // pulled along round its support
    stroke.move({middle, low}, 1);
    CHECK(stroke.begun == 1);
    stroke.move({middle, -reach / 2}, 60);
    CHECK(stroke.begun == 2);
    CHECK(stroke.forces.back().y() < 0);
    stroke.touch.reset();  // forgets the side as well
    CHECK_FALSE(stroke.touch.pressing());
    stroke.pressing = false;
    stroke.move({middle, low}, 1);
    CHECK_FALSE(stroke.pressing);
  }

  // Led straight down past an end, as a hand slips off a ruler: at the most once, and then nothing more.
  for (const Scalar x : {Scalar(0.12) * length, Scalar(0.9) * length}) {
    Stroke<Model> stroke(model, radius, {x, 2 * reach});
    stroke.move({x, -Scalar(0.7) * length}, 500);
    INFO("led down at " << x << " m");
    CHECK(stroke.begun == 1);
    CHECK(stroke.ended <= 1);
  }
  check_touch_at_ends(make, radius);
}

}  // namespace hapbeam::testing
