// The script of a hand: the law of a minimum-jerk reach, and what a script may not say.
#include <limits>

#include "support/catch.hpp"
#include <hapbeam/haptics/device/hand_path.hpp>

using namespace hapbeam;
using Catch::Matchers::ContainsSubstring;

namespace {
const HandPath script = HandPath({0.01, 0.02}).press(0.03, 1).rest(0.5).slide(-0.1, 2).release(0.04, 0.25);
}

TEST_CASE("a script leads through its way-points", "[hand]") {
  CHECK(script.duration() == 3.75);
  REQUIRE(script.points().size() == 5);
  const Eigen::Vector3d places[] = {
      {0.01, 0.02, 0}, {0.01, -0.01, 0}, {0.01, -0.01, 0}, {-0.09, -0.01, 0}, {-0.09, 0.03, 0}};
  for (int i = 0; i < 5; ++i) {
    const HandTarget target = script(script.points()[static_cast<std::size_t>(i)].time);
    CHECK((target.position - places[i]).norm() <= 1e-16);
    CHECK(target.velocity.norm() == 0);
  }
  CHECK(script(-1).position == places[0]);
  CHECK(script(1e9).position == script(3.75).position);
  CHECK(script(1e9).velocity.norm() == 0);
}

TEST_CASE("a reach is half way at half time, fastest there, at 15/8 of its mean speed", "[hand]") {
  const HandTarget middle = script(0.5);
  CHECK(middle.position.y() == Approx(0.005).epsilon(1e-14));
  CHECK(middle.velocity.y() == Approx(-0.03 * 15 / 8).epsilon(1e-14));
  for (double t = 0; t <= 1; t += 0.01)
    CHECK(std::abs(script(t).velocity.y()) <= std::abs(middle.velocity.y()));
}

TEST_CASE("the velocity is the derivative of the position, across way-points too", "[hand]") {
  const double h = 1e-4;
  for (double t = -0.1; t < 4; t += 0.00173) {
    const Eigen::Vector3d difference = (script(t + h).position - script(t - h).position) / (2 * h);
    // h²/6 of the largest jerk, 60 d/T³ at 0.04 m in 0.25 s; one step of it at a way-point: as much again.
    CHECK((difference - script(t).velocity).norm() <= h * h / 3 * 60 * 0.04 / (0.25 * 0.25 * 0.25));
  }
}

TEST_CASE("way-points and builders say the same", "[hand]") {
  const HandPath given(std::vector<HandPath::WayPoint>{{0, {0, 0.25}}, {1, {0, -0.25}}});
  const HandPath built = HandPath({0, 0.25}).press(0.5, 1);
  for (double t = 0; t < 1.1; t += 0.07) CHECK(given(t).position == built(t).position);
}

TEST_CASE("a script that cannot be followed is refused by name, value and unit", "[hand]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  HandPath path({0, 0});
  CHECK_THROWS_WITH(HandPath({nan, 0}), ContainsSubstring("place") && ContainsSubstring("nan m"));
  CHECK_THROWS_WITH(path.press(-0.01, 1),
                    ContainsSubstring("depth = -0.01") && ContainsSubstring("m: must be positive"));
  CHECK_THROWS_WITH(path.press(0.01, 0), ContainsSubstring("duration = 0 s"));
  CHECK_THROWS_AS(path.release(0, 1), std::invalid_argument);
  CHECK_THROWS_AS(path.slide(nan, 1), std::invalid_argument);
  CHECK_THROWS_AS(path.rest(-1), std::invalid_argument);
  CHECK_THROWS_AS(path.move_to({0, 0}, nan), std::invalid_argument);
  CHECK_THROWS_WITH(path.slide(1e308, 1e-3), ContainsSubstring("speed = inf m/s: must be at most 1e9"));
  CHECK_THROWS_WITH(path.slide(0.1, 1e-300), ContainsSubstring("speed"));
  CHECK(path.points().size() == 1);

  using Points = std::vector<HandPath::WayPoint>;
  CHECK_THROWS_AS(HandPath(Points{}), std::invalid_argument);
  CHECK_THROWS_WITH(HandPath(Points{{1, {0, 0}}}), ContainsSubstring("first time = 1 s"));
  CHECK_THROWS_WITH(HandPath(Points{{0, {0, 0}}, {1, {0, 0}}, {1, {0, 0}}}),
                    ContainsSubstring("after the one before"));
  CHECK_THROWS_AS(HandPath(Points{{0, {0, 0}}, {1, {0, nan}}}), std::invalid_argument);
}
