// A hand on many beams feels the sum of what each does alone; each is touched once a stroke, and nothing of it is kept.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

#include "many/rows.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/many/touch_many.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Full = FemModel<>;
using Turning = FemModel<Corotational<>>;
using Catch::Matchers::ContainsSubstring;
using Path = std::vector<Vector>;

constexpr double radius = 0.004;

/// Tick by tick against one Touch a beam.   @return beams that were touched, counted once a touch
template <typename Model>
int same_as_one_by_one(const BeamArray<Model>& array, const Path& path, double avatar = radius) {
  Touch<BeamArray<Model>> touch(array, avatar);
  OneByOne<Model> alone(array, avatar);
  std::vector<bool> pressed(static_cast<std::size_t>(array.size()));
  double largest = 0, worst = 0;
  int touches = 0, wrong = 0;
  for (const Vector& hand : path) {
    const auto felt = touch.tick(hand);
    Vector sum(0, 0);
    double sizes = 0;
    Status status = Status::ok;
    std::size_t pressing = 0;
    for (int i = 0; i < array.size(); ++i) {
      const TouchResult<double> one = alone.tick(i, hand);
      sum += array.frame(i).turned(one.force);
      sizes += one.force.norm();
      if (worse(one.status, status)) status = one.status;
      pressing += one.pressing;
      touches += one.pressing && !pressed[static_cast<std::size_t>(i)];
      pressed[static_cast<std::size_t>(i)] = one.pressing;
    }
    wrong += felt.status != status || felt.pressing != (pressing > 0) || !felt.complete ||
             touch.touches().size() != pressing;
    largest = std::max(largest, sizes);
    worst = std::max(worst, (felt.force - sum).norm());
  }
  CAPTURE(largest, worst, touches);
  CHECK(wrong == 0);
  // They are summed in another order.
  CHECK(worst <= 64 * std::numeric_limits<double>::epsilon() * largest);
  return touches;
}

PodModel<> trained_wire() {
  TrainingPlan plan = TrainingPlan::anywhere(wire(), 0.007);
  plan.positions = 8;
  return PodModel<>(train_pod(take_snapshots(wire(), full_model(wire(), 32), plan)));
}

static_assert(std::is_same_v<decltype(BeamArray(std::declval<const Full&>(), std::vector<BeamPlace>())),
                             BeamArray<Full>>);
static_assert(std::is_same_v<decltype(Touch(std::declval<BeamArray<Full>&>(), 1.0)), Touch<BeamArray<Full>>>);
static_assert(
    std::is_same_v<decltype(Touch(std::declval<const BeamArray<Full>&>(), 1.0)), Touch<BeamArray<Full>>>);

Path stroke(const Vector& from, const Vector& to, int ticks) {
  Path path;
  for (int k = 0; k <= ticks; ++k) path.emplace_back(from + (to - from) * (double(k) / ticks));
  return path;
}
void go_on(Path& path, const Path& more) { path.insert(path.end(), more.begin(), more.end()); }

}  // namespace

TEST_CASE("an array's force is the sum over its beams: strokes over tips of three lengths, to and fro") {
  const std::vector<Full> kinds{Full(bristle(), 8), Full(bristle(0.0601), 6), Full(bristle(0.05995), 4)};
  const BeamArray<Full> array(kinds, row(60, 0.002, 3));
  Path path = stroke({-0.02, 0.0648}, {0.14, 0.06475}, 1600);
  go_on(path, stroke({0.14, 0.06475}, {-0.02, 0.0648}, 900));
  CHECK(same_as_one_by_one(array, path) >= 100);
}

TEST_CASE("an array's force is the sum over its beams: elements of any rotation that bend and slip off") {
  const BeamArray<Turning> array(Turning(bristle(), 8), row(12, 0.006));
  Path path = stroke({-0.02, 0.0615}, {0.1, 0.0622}, 600);
  go_on(path, stroke({0.1, 0.0622}, {-0.02, 0.0615}, 300));
  CHECK(same_as_one_by_one(array, path) >= 24);
}

TEST_CASE("an array's force is the sum over its beams: trained strings in any place, hands that jump") {
  const PodModel<> trained = trained_wire();
  Random random(5);
  std::vector<BeamPlace> places;
  for (int i = 0; i < 40; ++i)
    places.push_back({{random(0.5), random(0.5)}, random(3.2), 0});  // they cross: beams do not touch beams
  const BeamArray<PodModel<>> array(trained, places);
  Path path;
  Vector hand(0, 0);
  for (int k = 0; k < 3000; ++k) {
    if (k % 100 == 0) hand = {random(0.8), random(0.8)};
    hand += Vector(random(0.002), random(0.002));
    path.push_back(hand);
  }
  go_on(path, stroke({-0.9, -0.1}, {0.9, 0.2}, 200));  // 9 mm a tick, through what lies in the way
  CHECK(same_as_one_by_one(array, path) >= 40);
}

TEST_CASE("each bristle is touched once a pass and let go once") {
  const BeamArray<Turning> array(Turning(bristle(), 8), row(15, 0.005));
  Touch<BeamArray<Turning>> touch(array, radius);
  std::vector<int> begun(15), ended(15);
  std::vector<bool> pressed(15);
  const auto pass = [&](const Path& path) {
    for (const Vector& hand : path) {
      (void)touch.tick(hand);
      std::vector<bool> now(15);
      for (const auto& touched : touch.touches()) now[static_cast<std::size_t>(touched.beam)] = true;
      for (std::size_t i = 0; i < 15; ++i)
        begun[i] += now[i] && !pressed[i], ended[i] += pressed[i] && !now[i];
      pressed = now;
    }
  };
  for (int passes = 1; passes <= 4; ++passes) {
    pass(passes % 2 ? stroke({-0.03, 0.0625}, {0.1, 0.0625}, 400 * passes)
                    : stroke({0.1, 0.0615}, {-0.03, 0.0615}, 300 * passes));
    CHECK(begun == std::vector<int>(15, passes));
    CHECK(ended == std::vector<int>(15, passes));
  }
  CHECK_FALSE(touch.pressing());
  for (int i = 0; i < 15; ++i) CHECK(touch.shape(i)[8].w == 0);
}

TEST_CASE("contact and press are those of the beam that pushes hardest, in the array's axes") {
  const BeamArray<Full> array(Full(bristle(), 8), row(2, 0.01));
  Touch<BeamArray<Full>> touch(array, radius);
  // From the left onto the first: 5 mm to the left of its axis the surfaces meet.
  (void)touch.tick({-0.0055, 0.04});
  const auto felt = touch.tick({-0.0045, 0.04});
  REQUIRE(felt.pressing);
  CHECK(felt.beam == 0);
  CHECK(felt.force.x() < 0);
  CHECK(std::abs(felt.force.y()) < 1e-9);
  CHECK(felt.contact.normal.x() == Approx(-1));
  CHECK(felt.contact.foot.x() == Approx(0).margin(1e-12));
  CHECK(felt.contact.foot.y() == Approx(0.04));
  CHECK(felt.contact.depth == Approx(0.0005));
  CHECK(felt.press.s == Approx(0.04));
  CHECK(touch.touches().front().force == felt.force);
  const auto deeper = touch.contact_at({-0.004, 0.04});  // of the beam as it is pressed
  CHECK(deeper.depth == Approx(0.0005).epsilon(0.005));
  CHECK(deeper.normal.x() == Approx(-1).epsilon(1e-3));
  CHECK(deeper.foot.x() == Approx(0.0005).epsilon(0.005));
  // Squeezed between both from the start: the nearer one pushes harder.
  Touch<BeamArray<Full>> wide(array, 0.005);
  const auto between = wide.tick({0.0055, 0.04});
  CHECK(wide.touches().size() == 2);
  CHECK(between.beam == 1);
  CHECK(between.contact.normal.x() == Approx(-1));
  CHECK(between.force.x() < 0);
  CHECK_FALSE(touch.contact_at({-0.05, 0.04}).touching);
}

TEST_CASE("of more beams than the pool holds the deepest are taken, and the status says so") {
  const BeamArray<Full> array(Full(bristle(), 4), row(100, 0.0005), 8);
  Touch<BeamArray<Full>> touch(array, 0.01);
  CHECK(touch.tick({0.025, 0.08}).complete);
  const auto felt = touch.tick({0.025, 0.0702});  // over the tips, whose highest points are the nearest
  CHECK_FALSE(felt.complete);
  CHECK(felt.status == Status::out_of_range);
  CHECK(felt.force.allFinite());
  REQUIRE(touch.touches().size() == 8);
  for (const auto& touched : touch.touches()) CHECK(std::abs(touched.beam - 50) <= 5);
  // Those that were left out are not met until the avatar has left them.
  for (int k = 0; k < 10; ++k) {
    CHECK_FALSE(touch.tick({0.025, 0.0702}).complete);
    CHECK(touch.touches().size() == 8);
  }
  CHECK(touch.tick({0.025, 0.08}).complete);
  CHECK_FALSE(touch.pressing());
  CHECK(touch.tick({-0.0115, 0.0599}).complete);
  const auto beside = touch.tick({-0.0108, 0.0599});
  CHECK((beside.complete && beside.beam == 0));
}

TEST_CASE("what a hand without a place may ask: the force is finite, and a reset forgets") {
  const BeamArray<Full> array(Full(bristle(), 4), row(30, 0.003), 4);
  Touch<BeamArray<Full>> touch(array, radius);
  Random random(9);
  using Limits = std::numeric_limits<double>;
  const double wild[] = {Limits::quiet_NaN(),
                         Limits::infinity(),
                         -Limits::infinity(),
                         Limits::max(),
                         Limits::lowest(),
                         1e160,
                         -1e100,
                         1e9,
                         0.06,
                         0.0639,
                         0,
                         Limits::denorm_min()};
  const auto pick = [&] { return wild[random.integer(0, 11)]; };
  int pressing = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vector hand(random.integer(0, 2) ? random(0.1) : pick(), random.integer(0, 2) ? 0.0639 : pick());
    const auto felt = touch.tick(hand);
    REQUIRE(felt.force.allFinite());
    REQUIRE(touch.touches().size() <= 4);
    REQUIRE((hand.allFinite() || felt.status == Status::invalid_request));
    pressing += felt.pressing;
    (void)touch.contact_at({pick(), pick()});
  }
  CHECK(pressing > 100);
  touch.reset();
  CHECK_FALSE(touch.pressing());
  CHECK(touch.touches().empty());
  // The hand is elsewhere at once, and has crossed nothing.
  CHECK_FALSE(touch.tick({-0.1, 0.03}).pressing);
  touch.reset();
  CHECK_FALSE(touch.tick({0.2, 0.03}).pressing);
}

TEST_CASE("a hand that is faster than a bristle is thick has not passed it") {
  const BeamArray<Full> array(Full(bristle(), 8), row(3, 0.02));
  Touch<BeamArray<Full>> touch(array, 0.0005);
  (void)touch.tick({-0.004, 0.03});
  const auto felt = touch.tick({0.004, 0.03});
  CHECK(felt.pressing);
  CHECK(felt.beam == 0);
  CHECK(felt.force.x() < 0);
}

TEST_CASE("a beam of an array takes less than 80 bytes, and a copy of a trained model no table") {
  const BeamArray<Full> array(Full(bristle(), 8), row(1000, 0.001));
  CHECK(array.bytes() <= 80u * 1000u);
  CHECK(array.size() == 1000);
  PodModel<> first = trained_wire();
  PodModel<> second = first;
  CHECK(&first.data() == &second.data());
  first.press({0.1, 0.005});
  CHECK(second.shape()[8].w == 0);
  CHECK(first.shape()[8].w != 0);
  const double before = second.press({0.2, 0.002}).force;
  first.press({0.05, -0.008});
  CHECK(second.press({0.2, 0.002}).force == before);
}

// FemModel's own bound in float: 100 eps n² of a force, here of each of the beams that are touched.
TEST_CASE("an array in float feels what one in double does") {
  using Single = FemModel<VonKarman<>, float>;
  const BeamArray<Full> array(Full(bristle(), 8), row(40, 0.002));
  const BeamArray<Single> single(Single(bristle(), 8), row(40, 0.002));
  Touch touch(array, radius);
  Touch float_touch(single, static_cast<float>(radius));
  double worst = 0, largest = 0;
  int pressing = 0;
  for (const Vector& hand : stroke({0.03, 0.07}, {0.0305, 0.0645}, 500)) {
    const auto felt = touch.tick(hand);
    const auto in_float = float_touch.tick(hand.cast<float>());
    double sizes = 0;
    for (const auto& touched : touch.touches()) sizes += touched.force.norm();
    worst = std::max(worst, (felt.force - in_float.force.cast<double>()).norm());
    largest = std::max(largest, sizes);
    pressing += felt.pressing;
  }
  CHECK(pressing > 20);
  // The hand's own place is rounded, too: eps of 60 mm over a depth of half a millimetre.
  const double eps = std::numeric_limits<float>::epsilon();
  CHECK(worst <= (100 * eps * 64 + 120 * eps) * largest);
}

TEST_CASE("an array that makes no sense is rejected by name") {
  const Full model(bristle(), 4);
  using Array = BeamArray<Full>;
  CHECK_THROWS_WITH(Array(model, {}), ContainsSubstring("places = 0"));
  CHECK_THROWS_WITH(Array(std::vector<Full>{}, row(1, 1)), ContainsSubstring("kinds = 0"));
  CHECK_THROWS_WITH(Array(model, row(2, 1), 0), ContainsSubstring("most_touched = 0"));
  CHECK_THROWS_WITH(Array(model, row(2, 1), 5000), ContainsSubstring("most_touched = 5000"));
  CHECK_THROWS_WITH(Array(model, row(2, 1, 2)), ContainsSubstring("place kind = 1"));
  CHECK_THROWS_WITH(Array(model, {{{std::nan(""), 0}, 0, 0}}), ContainsSubstring("place origin = nan m"));
  CHECK_THROWS_WITH(Array(model, {{{0, 0}, std::nan(""), 0}}), ContainsSubstring("place angle = nan rad"));
  const Array array(model, row(2, 1));
  CHECK_THROWS_WITH((Touch<Array>(array, -1)), ContainsSubstring("avatar_radius = -1 m"));
}
