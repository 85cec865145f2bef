// Two hands that are ticked one by one, against one call of TouchSeveral and against one hand alone.
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/ruler.hpp"
#include <hapbeam/contact/two_hands.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using TwoTouched = FemModel<Several<Corotational<>, 2>>;
using Held = Touch<Hand<TwoTouched>>;
using Place = Vector2<double>;
constexpr double radius = 0.005, surface = radius + ruler_thickness / 2;

struct Scene {
  TwoTouched model{steel_ruler(), 16};
  TwoHands<TwoTouched> hands{model};
  Held left{hands[0], radius}, right{hands[1], radius};
};

/// Pressed in steps until both hands are where they go.
void lead(Scene& scene, const Place& left, const Place& right) {
  for (int k = 1; k <= 100; ++k) {
    REQUIRE(scene.left.tick({left.x(), surface + (left.y() - surface) * k / 100}).status == Status::ok);
    REQUIRE(scene.right.tick({right.x(), surface + (right.y() - surface) * k / 100}).status == Status::ok);
  }
}

double alone(const Place& at) {
  FemModel<Corotational<>> model(steel_ruler(), 16);
  Touch<FemModel<Corotational<>>> touch(model, radius);
  double force = 0;
  for (int k = 1; k <= 100; ++k)
    force = touch.tick({at.x(), surface + (at.y() - surface) * k / 100}).force.norm();
  return force;
}

}  // namespace

TEST_CASE("hands that are ticked in turn feel what both feel at once", "[two_hands]") {
  Scene scene;
  const Place left(0.12, -0.006), right(0.26, -0.03);
  lead(scene, left, right);
  const auto one = scene.left.tick(left), other = scene.right.tick(right);
  TwoTouched model(steel_ruler(), 16);
  TouchSeveral both(model, {radius, radius});
  TouchSeveral<TwoTouched>::Result felt;
  for (int k = 1; k <= 100; ++k)
    felt = both.tick(Place(left.x(), surface + (left.y() - surface) * k / 100),
                     Place(right.x(), surface + (right.y() - surface) * k / 100));
  REQUIRE(felt.status == Status::ok);
  REQUIRE((one.pressing && other.pressing));
  CHECK((one.force - felt.force(0)).norm() <= 1e-6 * felt.force(0).norm());
  CHECK((other.force - felt.force(1)).norm() <= 1e-6 * felt.force(1).norm());
  CHECK(scene.left.meanwhile() != nullptr);
  CHECK((*scene.left.meanwhile() - felt.force(0)).norm() <= 1e-6 * felt.force(0).norm());
  CHECK(one.contact.touching);
  CHECK((one.contact.foot - (left - one.contact.normal * surface)).norm() <= 1e-7);
}

TEST_CASE("a second hand matters only where it touches", "[two_hands]") {
  const Place at(0.2, -0.02);
  const double expected = alone(at);
  Scene scene;
  lead(scene, at, {0.1, surface});
  CHECK(scene.left.tick(at).force.norm() == Approx(expected).epsilon(1e-6));
  CHECK_FALSE(scene.right.pressing());
  // It stiffens the beam where it lies beneath it.
  for (int k = 0; k < 100; ++k) (void)scene.right.tick({0.28, -0.08 + 2e-4 * k});
  Scene propped;
  for (int k = 0; k < 100; ++k) {
    const double up = std::min(1.0, k / 50.0);
    (void)propped.right.tick({0.28, -surface});
    (void)propped.left.tick({at.x(), surface + (at.y() - surface) * up});
  }
  const auto stiff = propped.left.tick(at);
  CHECK(stiff.force.norm() > 2 * expected);
  CHECK(propped.right.tick({0.28, -surface}).force.y() < 0);
}

TEST_CASE("a hand that is gone leaves the beam to the other one", "[two_hands]") {
  const Place at(0.2, -0.02), other(0.1, -0.01);
  const double expected = alone(at);
  Scene scene;
  lead(scene, at, other);
  REQUIRE(std::abs(scene.left.tick(at).force.norm() - expected) > 0.05 * expected);
  SECTION("its loop was stopped") {
    for (int k = 0; k < TwoHands<TwoTouched>::patience + 1; ++k) (void)scene.left.tick(at);
    CHECK_FALSE(scene.right.pressing());
    CHECK(scene.left.tick(at).force.norm() == Approx(expected).epsilon(1e-6));
  }
  SECTION("it was reset") {
    scene.right.reset();
    CHECK(scene.right.meanwhile() == nullptr);
    (void)scene.left.tick(at);
    CHECK(scene.left.tick(at).force.norm() == Approx(expected).epsilon(1e-6));
  }
  SECTION("its place is none, for as long") {
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k < TwoHands<TwoTouched>::patience + 2; ++k) {
      const auto none = scene.right.tick({0.1, nowhere});
      REQUIRE(none.status == Status::invalid_request);
      REQUIRE((none.force.isZero(0) && !none.pressing));
      REQUIRE(scene.left.tick(at).status == Status::ok);
    }
    CHECK(scene.left.tick(at).force.norm() == Approx(expected).epsilon(1e-6));
  }
  SECTION("it drew back") {
    (void)scene.right.tick({0.1, 0.1});
    CHECK(scene.left.tick(at).force.norm() == Approx(expected).epsilon(1e-6));
  }
  // And it comes again, from its own side.
  const auto back = [&](double y) { return scene.right.tick({0.1, y}); };
  for (int k = 0; k < 50; ++k) (void)back(0.02 - 5e-4 * k), (void)scene.left.tick(at);
  CHECK(back(-0.01).force.y() > 0);
}

TEST_CASE("two hands go anywhere: finite, no pull, and free when they have gone", "[two_hands]") {
  Scene scene;
  Random random(31);
  Place at[2] = {{0.1, 0.02}, {0.2, 0.02}};
  int pulls = 0, wild = 0, both = 0, unanswered = 0;
  for (int way = 0; way < 150; ++way) {
    Place to[2];
    for (auto& place : to) {
      const double x = random(0.1, 1.02) * ruler_length, side = random.integer(0, 9) == 0 ? -1 : 1;
      const double w = side * random(-0.03, 0.01);
      place = {x, w};
    }
    const bool jump = random.integer(0, 9) == 0;
    const int steps = jump ? 1 : 40;
    const Place from[2] = {at[0], at[1]};
    for (int k = 1; k <= steps; ++k) {
      int pressing = 0;
      for (std::size_t h = 0; h < 2; ++h) {
        at[h] = from[h] + (to[h] - from[h]) * (double(k) / steps);
        const auto felt = h == 0 ? scene.left.tick(at[h]) : scene.right.tick(at[h]);
        wild += !felt.force.allFinite();
        pulls += felt.pressing && felt.force.dot(felt.contact.normal) < 0;
        pressing += felt.pressing;
        unanswered += !is_answer(felt.status);
      }
      both += pressing == 2;
    }
  }
  CHECK(wild == 0);
  CHECK(pulls == 0);
  CHECK(both > 300);
  INFO(unanswered);
  CHECK(unanswered < 300);  // of 11000: hands that pass through each other have no equilibrium
  for (int k = 0; k < 30; ++k) {
    CHECK(scene.left.tick({0.1, 0.5}).force.isZero(0));
    CHECK(scene.right.tick({0.2, 0.5}).force.isZero(0));
  }
  CHECK(std::abs(scene.model.shape()[16].w) <= 1e-9);
}

TEST_CASE("what makes no sense of two hands throws", "[two_hands]") {
  TwoTouched model(steel_ruler(), 16);
  TwoHands hands(model);
  CHECK_THROWS_AS(Held(hands[0], -1), std::invalid_argument);
  CHECK_THROWS_AS(Held(hands[0], 1e4), std::invalid_argument);
  CHECK_THROWS_AS((TwoHands<TwoTouched>(model, {Prop<>::peg({0.1, -0.02}, 0.005)})), std::invalid_argument);
}
