// Where the workspace lies in the scene: laws of the mapping, and what it refuses.
#include <limits>

#include <Eigen/Geometry>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/haptics/servo/placement.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

Eigen::Vector3d vector(Random& random, double size) {
  return {random(-size, size), random(-size, size), random(-size, size)};
}

Placement somewhere(Random& random) {
  const Eigen::Quaterniond turn(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1));
  return Placement(turn.normalized().toRotationMatrix(), vector(random, 2), random(0.1, 10));
}

}  // namespace

TEST_CASE("a placement and its inverse leave a hand where it is", "[placement]") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Placement placement = somewhere(random);
    const Eigen::Vector3d hand = vector(random, 0.2);
    const Eigen::Vector3d back = placement.device_position(placement.scene_position(hand));
    // Some ten roundings of numbers as large as the origin, brought back to the device.
    REQUIRE((back - hand).norm() <= 20 * eps * (placement.origin().norm() / placement.scale() + 1));
  }
}

TEST_CASE("a velocity is the rate of a position", "[placement]") {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Placement placement = somewhere(random);
    const Eigen::Vector3d hand = vector(random, 0.2), velocity = vector(random, 1);
    // Positions are linear in the hand's, so any step gives the rate.
    const Eigen::Vector3d moved = placement.scene_position(hand + velocity) - placement.scene_position(hand);
    REQUIRE((moved - placement.scene_velocity(velocity)).norm() <= 1e-13);
  }
}

TEST_CASE("power in the hand is power in the scene over the scale, so passivity survives", "[placement]") {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Placement placement = somewhere(random);
    const Eigen::Vector3d velocity = vector(random, 1), force = vector(random, 30);
    const double in_hand = placement.device_force(force).dot(velocity);
    const double in_scene = force.dot(placement.scene_velocity(velocity));
    REQUIRE(std::abs(in_hand * placement.scale() - in_scene) <= 1e-12 * (1 + std::abs(in_scene)));
    REQUIRE(std::abs(placement.device_force(force).norm() - force.norm()) <= 40 * eps * force.norm());
  }
}

TEST_CASE("right, up and toward the user stay so under a placement in the plane", "[placement]") {
  const Placement placement = Placement::in_plane({1.27, 0.02}, 2);
  CHECK(placement.beam_position({0, 0, 0}) == Vector2<double>(1.27, 0.02));
  CHECK(placement.beam_position({0.5, -0.25, 0.1}) == Vector2<double>(2.27, -0.48));
  CHECK(placement.device_force_of_beam({3, 4}) == Eigen::Vector3d(3, 4, 0));
  CHECK(Placement().scene_position({1, 2, 3}) == Eigen::Vector3d(1, 2, 3));
}

TEST_CASE("a beam that lies along the user's depth is pressed from above", "[placement]") {
  // The scene's x, y, z are the device's -z (away from the user), y and x.
  Eigen::Matrix3d turn;
  turn << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  const Placement placement(turn, {1, 0, 0});
  CHECK(placement.beam_position({0.3, -0.01, -0.1}) == Vector2<double>(1.1, -0.01));
  CHECK(placement.device_force_of_beam({2, 5}) == Eigen::Vector3d(0, 5, -2));
}

TEST_CASE("what is no placement is refused by name", "[placement]") {
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double scale : {1e-300, 9e-7, 1.1e6, 1e200, -1.0})
    CHECK_THROWS_WITH(Placement(one, {0, 0, 0}, scale), ContainsSubstring("must be 1e-6 to 1e6"));
  CHECK_THROWS_WITH(Placement(one, {0, 0, 0}, 0), ContainsSubstring("placement scale = 0"));
  CHECK_THROWS_WITH(Placement(one, {0, nan, 0}), ContainsSubstring("placement origin = nan m"));
  CHECK_THROWS_WITH(Placement(1.001 * one, {0, 0, 0}), ContainsSubstring("placement rotation"));
  CHECK_THROWS_WITH(Placement(nan * one, {0, 0, 0}), ContainsSubstring("placement rotation"));
  const Eigen::Vector3d mirrored[] = {{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {-1, -1, -1}};
  for (const Eigen::Vector3d& axes : mirrored) {
    const Eigen::Matrix3d mirror = axes.asDiagonal();
    CHECK_THROWS_WITH(Placement(mirror, {0, 0, 0}), ContainsSubstring("right-handed"));
  }
}
