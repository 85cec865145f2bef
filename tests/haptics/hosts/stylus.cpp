// A stylus in a host's hands: its force is that of Touch, and force and torque do the work that the rod keeps.
#include <cmath>
#include <limits>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include <hapbeam/haptics/device/arm.hpp>
#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/hosts/placed_touch.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity(), radius = 0.003;
constexpr StylusOptions stylus{0.2, 0.12};

Rod needle() {
  return Rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
}
Point product(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

TEST_CASE("a placed stylus feels what Touch feels, bit by bit, and the torque of that force",
          "[hosts][torque]") {
  const Friction friction = GENERATE(Friction(), Friction(0.4, 0.3));
  FemModel<RoundRod> model(needle(), 8), other(needle(), 8);
  PlacedTouch<FemModel<RoundRod>> placed(model, radius, x_toward_user({0, 0}), stylus, friction);
  Touch<FemModel<RoundRod>> alone(other, radius, friction);
  // Across the rod: the axis of the stylus is the host's x or so.
  Eigen::Matrix3d across;
  across << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  int pressed = 0, slid = 0, differ = 0, not_finite = 0, turned = 0;
  for (int k = 0; k < 6000; ++k) {
    // The scene's (x, y, z) are the host's (y, z, x).
    const double t = 1e-3 * k;
    HandPose hand{{0.03 * std::sin(2 * t), 0.13 + 0.03 * std::cos(t), 0.004 + 0.01 * std::cos(3 * t)},
                  gimbal_orientation({0.2 * std::sin(t), 0.2 * std::cos(2 * t), 0})};
    hand.turn = (across * hand.turn).eval();
    if (k % 499 == 498) hand.place[k % 3] = infinite;
    if (k % 701 == 700) hand.turn(1, 2) = std::numeric_limits<double>::quiet_NaN();
    if (k % 997 == 996) hand.turn *= 1e200;
    const Point along(hand.turn(1, 2), hand.turn(2, 2), hand.turn(0, 2)),
        place(hand.place[1], hand.place[2], hand.place[0]);
    const Wrench felt = placed.tick(hand);
    const auto same = alone.tick(Point(place - stylus.ahead * along), Point(stylus.length * along));
    const Point force = is_answer(same.status) ? Point(same.force) : Point(0, 0, 0),
                torque = product(same.contact.foot - place, force);
    pressed += same.pressing && force.norm() > 0;
    turned += felt.torque.norm() > 1e-3;
    const ServoRecord& record = placed.picture().record;
    slid += record.sliding;
    differ += record.sliding != same.sliding || record.friction != same.friction ||
              record.dissipated != same.dissipated;
    differ += felt.force != Point(force[2], force[0], force[1]);
    if (force.norm() > 0)
      differ += (felt.torque - Point(torque[2], torque[0], torque[1])).norm() > 1e-15 * torque.norm() + 1e-18;
    not_finite += !felt.force.allFinite() || !felt.torque.allFinite();
    if (force.norm() == 0) differ += !felt.torque.isZero(0);
  }
  CHECK(pressed > 1000);
  CHECK(pressed < 5000);
  CHECK(turned > 1000);
  CHECK((slid > 500) == !friction.none());
  CHECK(differ == 0);
  CHECK(not_finite == 0);
}

// A trapezoid of n steps errs by 1/n² of the work: halving them leaves a quarter of the error.
TEST_CASE("force and torque on a stylus do the work that the rod stores, in a host of any scale",
          "[hosts][torque]") {
  for (const double scale : {1.0, 1e-3, 3.0}) {
    const Eigen::Matrix3d axes = gimbal_orientation({0.3, -0.5, 1.1});
    const Placement placement(axes, {0.12, 0.004, 0.01}, scale);
    double left[2];
    for (int fine = 0; fine < 2; ++fine) {
      FemModel<RoundRod> model(needle(), 16);
      PlacedTouch<FemModel<RoundRod>> placed(model, radius, placement, stylus);
      const int steps = fine ? 400 : 200;
      double work = 0;
      Wrench before;
      HandPose last;
      for (int k = 0; k <= steps; ++k) {
        // In the scene: down, along and about all three axes, with the contact off the hand.
        const double t = static_cast<double>(k) / steps;
        const Point at(0.12 + 0.01 * t, 0.004 - 0.012 * t, 0.03 - 0.02 * t);
        HandPose hand{placement.device_position(at),
                      axes.transpose() * gimbal_orientation({0.2 * t, 0.1 * t * t, -0.15 * t})};
        const Wrench felt = placed.tick(hand);
        if (k > 0) {
          const Eigen::Matrix3d R = hand.turn * last.turn.transpose();
          const Point turn(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
          work -= (felt.force + before.force).dot(hand.place - last.place) / 2 +
                  (felt.torque + before.torque).dot(turn) / 4;
        }
        before = felt, last = hand;
      }
      const double stored = model.strain_energy() / scale;
      CAPTURE(scale, steps, work, stored, before.force.transpose(), before.torque.transpose());
      CHECK(before.torque.norm() * scale > 0.01 * before.force.norm());
      left[fine] = std::abs(work / stored - 1);
      CHECK(left[fine] < (fine ? 1e-3 : 4e-3));
    }
    CAPTURE(left[0], left[1]);
    CHECK(left[1] < 0.5 * left[0] + 1e-6);
  }
}

TEST_CASE("a placed rod without a pose is touched by a sphere, and a planar beam takes no stylus",
          "[hosts][torque]") {
  FemModel<RoundRod> model(needle(), 8), other(needle(), 8);
  PlacedTouch<FemModel<RoundRod>> placed(model, radius, {}, stylus);
  Touch<FemModel<RoundRod>> alone(other, radius);
  for (int k = 0; k < 30; ++k) {
    const Point at(0.15, 0.005 - 1e-4 * k, 0);
    CHECK(placed.tick(at) == alone.tick(at).force);
  }
  CHECK(placed.felt().pressing);
  CHECK(placed.picture().record.shaft.isZero(0));
  CHECK(placed.picture().record.torque.isZero(0));

  const Beam beam(0.3, Section::rectangle(0.02, 0.001), Material{200e9}, Support::clamped, Support::free);
  FemModel<> plane(beam, 8);
  using Planar = PlacedTouch<FemModel<>>;
  CHECK_THROWS_WITH(Planar(plane, radius, {}, stylus), ContainsSubstring("stylus length = 0.2 m"));
  using Spatial = PlacedTouch<FemModel<RoundRod>>;
  CHECK_THROWS_WITH(Spatial(model, radius, {}, {-1, 0}), ContainsSubstring("stylus length = -1 m"));
  CHECK_THROWS_WITH(Spatial(model, radius, {}, {1, infinite}), ContainsSubstring("stylus ahead = inf m"));
}
