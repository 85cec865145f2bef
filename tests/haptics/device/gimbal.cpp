// The simulated gimbal, the hand that turns it, and what a device of six axes may send.
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

VirtualPhantomOptions six_axes() {
  VirtualPhantomOptions options;
  options.gimbal.present = true;
  return options;
}

/// Always the same, with an orientation and without.
struct Steady {
  Wrench wrench;
  OrientedState last{};
  int plain = 0, turned = 0;
  Eigen::Vector3d operator()(const DeviceState&) noexcept { return ++plain, wrench.force; }
  Wrench operator()(const OrientedState& state) noexcept { return last = state, ++turned, wrench; }
};
/// One that does not know of orientations.
struct ForceAlone {
  DeviceState last{};
  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    last = state;
    return {0, -200 * state.position.y(), 0.3};
  }
};
struct Both : ForceAlone {
  using ForceAlone::operator();
  Wrench operator()(const OrientedState& state) noexcept { return {ForceAlone::operator()(state)}; }
};
static_assert(takes_orientation<Steady> && takes_orientation<Both> && !takes_orientation<ForceAlone>);
static_assert(is_servo<Steady> && is_servo<Both>);

}  // namespace

TEST_CASE("a gimbal turns the stylus by a rotation, and a torque does the work of its axes", "[gimbal]") {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d q(random(3.), random(1.5), random(20.)), rate(random(1.), random(1.), random(1.)),
        torque(random(1.), random(1.), random(1.));
    const Eigen::Matrix3d R = gimbal_orientation(q);
    CHECK((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() <= 1e-14);
    CHECK(R(0, 0) * R(1, 1) - R(1, 0) * R(0, 1) == Approx(R(2, 2)).margin(1e-14));  // right-handed
    VirtualPhantomOptions options = six_axes();
    HandTarget target{};
    target.turn = q;
    Gimbal gimbal(options.gimbal, 100);
    gimbal.reset(target);
    // ω from R' Rᵀ, by differences of fourth order: h⁴ of rates of 1 is 1e-12, round-off 1e-13.
    const double h = 1e-3;
    const auto at = [&](double t) { return gimbal_orientation(q + t * rate); };
    const Eigen::Matrix3d spin = (8 * (at(h) - at(-h)) - at(2 * h) + at(-2 * h)) / (12 * h) * R.transpose();
    const Eigen::Vector3d omega(spin(2, 1), spin(0, 2), spin(1, 0));
    CHECK(gimbal.by_axes(torque).dot(rate) == Approx(torque.dot(omega)).margin(1e-9));
  }
}

TEST_CASE("a steady torque turns the stylus to where hand and friction hold it", "[gimbal]") {
  VirtualPhantomOptions options = six_axes();
  VirtualPhantom<> phantom(HandPath({0, 0}), options);
  Steady servo{{{0, 0, 0}, {0.02, -0.03, 0.01}}};
  phantom.run(servo, 2);
  const Eigen::Vector3d by_axes = phantom.gimbal().by_axes(servo.wrench.torque),
                        q = phantom.gimbal().angles();
  for (int i = 0; i < 3; ++i)
    CHECK(std::abs(options.gimbal.hand_stiffness * q[i] - by_axes[i]) <=
          options.gimbal.friction * (1 + 1e-6));
  CHECK(servo.last.sent_torque == servo.wrench.torque);
  CHECK((servo.last.orientation - gimbal_orientation(q)).norm() <= 2 * options.gimbal.resolution);
  CHECK(servo.plain == 0);
}

TEST_CASE("a hand leads the stylus through its turns, and they end where they should", "[gimbal][hand]") {
  const double turns = 6 * 3.141592653589793;
  const HandPath path = HandPath({0, 0}).turn({0.2, -0.1, turns}, 2).press(0.01, 0.5).turn({-0.2, 0.1, 0}, 1);
  CHECK(path(2).turn == Eigen::Vector3d(0.2, -0.1, turns));
  CHECK(path(2.5).turn == path(2).turn);
  CHECK((path(9).turn - Eigen::Vector3d(0, 0, turns)).norm() <= 1e-15);
  const double h = 1e-5;
  for (double t = 0.1; t < 4; t += 0.0917)
    CHECK((path(t + h).turn - path(t - h).turn - 2 * h * path(t).spin).norm() <= 1e-7);
  VirtualPhantom<> phantom(path, six_axes());
  Steady servo{};
  phantom.run(servo, 5);
  const GimbalOptions options;
  CHECK((phantom.gimbal().angles() - path(9).turn).cwiseAbs().maxCoeff() <=
        options.friction / options.hand_stiffness);
  CHECK_THROWS_WITH(HandPath({0, 0}).turn({not_a_number, 0, 0}, 1), ContainsSubstring("hand path turn"));
  CHECK_THROWS_WITH(HandPath({0, 0}).turn({0, 0, 1}, 0), ContainsSubstring("hand path duration = 0 s"));
}

TEST_CASE("a device of three axes moves as one of six that gives no torque, to the bit", "[gimbal]") {
  const HandPath path = HandPath({0, 0.02}).press(0.03, 0.3).slide(0.05, 0.3).release(0.02, 0.2);
  VirtualPhantom<> three(path), six(path, six_axes()), deaf(path, six_axes());
  ForceAlone plain, alone;
  Both both;
  for (int i = 0; i < 900; ++i) {
    three.step(plain), six.step(both), deaf.step(alone);
    REQUIRE(three.tip().position == six.tip().position);
    REQUIRE(three.tip().position == deaf.tip().position);
    REQUIRE(plain.last.velocity == both.last.velocity);
  }
  CHECK(three.info().gimbal.reads == false);
  CHECK(six.info().gimbal.reads);
}

TEST_CASE("no torque is sent beyond the peak, none that is no number, and none that is not rendered",
          "[gimbal]") {
  VirtualPhantomOptions options = six_axes();
  VirtualPhantom<> phantom(HandPath({0, 0}), options);
  Steady servo{{{0, 1, 0}, {3, -4, 0}}};
  phantom.step(servo), phantom.step(servo);
  CHECK(servo.last.cut == ForceCut::peak);
  CHECK((servo.last.sent_torque - Eigen::Vector3d(0.6, -0.8, 0) * options.gimbal.peak_torque).norm() <=
        1e-15);
  CHECK(servo.last.sent == Eigen::Vector3d(0, 1, 0));
  for (const Wrench& bad :
       {Wrench{{0, 1, 0}, {not_a_number, 0, 0}}, Wrench{{0, not_a_number, 0}, {0.01, 0, 0}}}) {
    servo.wrench = bad;
    phantom.step(servo), phantom.step(servo);
    CHECK(servo.last.cut == ForceCut::not_finite);
    CHECK(servo.last.sent.isZero(0));
    CHECK(servo.last.sent_torque.isZero(0));
  }
  options.gimbal.peak_torque = 0;
  VirtualPhantom<> reader(HandPath({0, 0}), options);
  servo.wrench = {{0, 1, 0}, {3, 0, 0}};
  reader.step(servo), reader.step(servo);
  CHECK(servo.last.cut == ForceCut::none);
  CHECK(servo.last.sent_torque.isZero(0));
}

TEST_CASE("a gimbal that cannot be is rejected by name", "[gimbal]") {
  VirtualPhantomOptions options = six_axes();
  options.gimbal.inertia = 0;
  CHECK_THROWS_WITH(VirtualPhantom<>(HandPath({0, 0}), options), ContainsSubstring("gimbal inertia = 0 kg"));
  options = six_axes();
  options.gimbal.damping = not_a_number;
  CHECK_THROWS_WITH(VirtualPhantom<>(HandPath({0, 0}), options), ContainsSubstring("gimbal damping"));
  options = six_axes();
  options.gimbal.inertia = options.gimbal.grip_inertia = 1e-9;
  CHECK_THROWS_WITH(VirtualPhantom<>(HandPath({0, 0}), options), ContainsSubstring("does not settle"));
}
