// A reset means the scene as it was built: whatever was pressed before, a stroke after it gives the forces of a new scene.
#include <atomic>
#include <thread>

#include "support/as_new.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;
using namespace hapbeam::testing::resets;

// Two hands, and long histories, are in tests/stability.
TEST_CASE("TouchSeveral is a new one after a reset, to the last bit", "[several][reset]") {
  check_several_as_new(2);
}

TEST_CASE("Touch is a new one after a reset, to the last bit", "[touch][reset]") {
  using One = FemModel<Corotational<>>;
  for (const double mu : {0.0, 0.3}) {
    One model(steel_ruler(), 16);
    Touch<One> used(model, radius, mu);
    int differ = 0, pressing = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
      Wander<2> before(i), after(500 + i);
      for (int k = 0; k < 100; ++k) (void)used.tick(before.step()[0]);
      used.reset();
      One other(steel_ruler(), 16);
      Touch<One> fresh(other, radius, mu);
      for (int k = 0; k < 100; ++k) {
        const Vector2<double> at = after.step()[0];
        const auto a = used.tick(at), b = fresh.tick(at);
        differ += a.force != b.force || a.status != b.status || a.dissipated != b.dissipated;
        pressing += b.pressing;
      }
    }
    CAPTURE(mu);
    CHECK(differ == 0);
    CHECK(pressing > 1000);
  }
}

// The ruler is lifted by the one hand, and that one is above it after its reset.
TEST_CASE("a hand that was reset does not meet the beam as it bent it", "[two_hands][reset]") {
  Pair<Ruler> pair({});
  const auto lift = [&](int hand) {
    for (int k = 0; k <= 100; ++k) (void)pair.tick(hand, {0.25, -surface + 4e-4 * k});
  };
  const auto above = [&](int hand) { return pair.tick(hand, {0.25, 0.02}); };
  SECTION("alone") {
    lift(0);
    pair.touch[0].reset();
    CHECK_FALSE(above(0).pressing);
  }
  SECTION("while the other one is in the air") {
    (void)pair.tick(1, {0.1, 0.1});
    lift(0);
    (void)pair.tick(1, {0.1, 0.1});
    pair.touch[0].reset();
    CHECK_FALSE(above(0).pressing);
  }
  SECTION("while the other one holds the beam: that one keeps it, and feels what it felt alone") {
    Pair<Ruler> alone({});
    for (int k = 0; k <= 100; ++k) {
      const double y = surface - 1e-4 * k;
      (void)pair.tick(1, {0.1, y}), (void)alone.tick(1, {0.1, y});
      (void)pair.tick(0, {0.25, -surface + (k < 50 ? 0 : 1e-3 * (k - 50))});
    }
    const double expected = alone.tick(1, {0.1, surface - 0.01}).force.norm();
    REQUIRE(pair.tick(0, {0.25, 0.05 - surface}).pressing);
    pair.touch[0].reset();
    CHECK_FALSE(above(0).pressing);
    const auto kept = pair.tick(1, {0.1, surface - 0.01});
    CHECK(kept.pressing);
    CHECK(kept.force.norm() == Approx(expected).epsilon(1e-6));
    CHECK_FALSE(above(0).pressing);
    // It comes down on the upper side.
    for (int k = 1; k <= 100; ++k)
      (void)pair.tick(0, {0.25, 0.02 - 5e-4 * k}), (void)pair.tick(1, {0.1, surface - 0.01});
    CHECK(pair.tick(0, {0.25, -0.03}).force.y() > 0);
  }
  SECTION("the loop of the one has stopped, and the other one was reset") {
    lift(0);
    pair.touch[1].reset();
    for (int k = 0; k < 2 * TwoHands<Ruler>::patience; ++k) REQUIRE_FALSE(above(1).pressing);
    for (int k = 1; k <= 100; ++k) (void)pair.tick(1, {0.25, 0.02 - 4e-4 * k});
    CHECK(pair.tick(1, {0.25, -0.02}).force.y() > 0);
  }
}

// Below the ruler at rest, or where it falls on the hand that stays.
TEST_CASE("a reset is to the other hand what drawing back is", "[two_hands][reset]") {
  const double y = GENERATE(-0.02, 0.02);
  CAPTURE(y);
  Pair<Ruler> reset({}), drawn({});
  for (Pair<Ruler>* const pair : {&reset, &drawn}) {
    for (int k = 0; k <= 100; ++k) (void)pair->tick(0, {0.25, -surface + 6e-4 * k});
    for (int k = 0; k <= 50; ++k) REQUIRE_FALSE(pair->tick(1, {0.2, -0.1 + (y + 0.1) * k / 50}).pressing);
    REQUIRE(pair->tick(0, {0.25, 0.06 - surface}).pressing);
  }
  reset.touch[0].reset();
  for (int k = 0; k < 5; ++k) {
    (void)drawn.tick(0, {0.25, -0.2}), (void)reset.tick(0, {0.25, -0.2});
    const auto felt = reset.tick(1, {0.2, y}), expected = drawn.tick(1, {0.2, y});
    CHECK(felt.pressing == (y > 0));
    CHECK((felt.force - expected.force).norm() <= 1e-6 * expected.force.norm());
  }
}

TEST_CASE("a beam that was thrown over a peg is back after a reset", "[two_hands][reset]") {
  Pair<Ruler> pair({Prop<>::peg({0.26, 0.02}, 0.004)});
  // Lifted far it slips round the peg, and rests on it.
  const auto lead = [&](double from, double to) {
    for (int k = 0; k <= 300; ++k) (void)pair.tick(0, {0.15, -surface + from + (to - from) * k / 300});
  };
  const auto tip = [&] { return pair.model.shape().at(ruler_length).w; };
  lead(0, 0.1), lead(0.1, -0.2);
  REQUIRE(tip() > 0.024);
  pair.touch[0].reset();
  (void)pair.tick(0, {0.15, -0.2});
  CHECK(tip() == 0);
  lead(-0.05, 0.01);
  CHECK(pair.model.shape().at(0.26).w < 0.02);
}

TEST_CASE("an unanswered tick after a reset has no force of before", "[two_hands][reset]") {
  Pair<Ruler> pair({Prop<>::peg({0.15, -0.006}, 0.005)});
  for (int k = 0; k <= 100; ++k) (void)pair.tick(0, {0.25, surface - 2e-4 * k});
  REQUIRE(pair.tick(0, {0.25, surface - 0.02}).pressing);
  // The other hand jams the beam on the peg.
  int jammed = 0;
  for (int k = 0; k < 400; ++k) {
    const auto felt = pair.tick(1, {0.15, surface - 2e-4 * k});
    if (is_answer(felt.status)) continue;
    pair.touch[0].reset();
    const auto after = pair.tick(0, {0.25, 0.1});
    if (is_answer(after.status)) continue;
    ++jammed;
    REQUIRE((after.force.isZero(0) && !after.pressing));
    break;
  }
  CHECK(jammed == 1);
}

// As a loop is started beside one that runs.
TEST_CASE("a hand is reset from another thread while the other one ticks", "[two_hands][reset]") {
  Pair<Ruler> pair({});
  std::atomic<bool> done{false};
  std::atomic<int> resets{0};
  std::thread other([&] {
    while (!done.load()) pair.touch[1].reset(), ++resets;
  });
  int wild = 0;
  for (int k = 0; k < 2000 || resets.load() == 0; ++k)
    wild += !pair.tick(0, {0.2, surface - 1e-5 * k}).force.allFinite();
  done = true;
  other.join();
  CHECK(wild == 0);
  CHECK(pair.tick(0, {0.2, surface - 0.02}).force.y() > 0);
}
