// A hand is never surprised: what reaches it after a start, a reset, a failure or a pause, and what the record then says.
#include "contact/closed_form_beam.hpp"
#include "support/catch.hpp"
#include "support/engagement.hpp"
#include "support/hostile_states.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

using Vector = Eigen::Vector3d;

DeviceInfo phantom() { return VirtualPhantom<>(HandPath({0, 0})).info(); }
Beam bar() { return thesis_beam(Support::pinned, Support::pinned); }

/// The device's origin where the avatar touches the bar; 12 mm deeper it is to press with more than the peak.
ServoOptions above_bar() {
  ServoOptions options;
  options.placement = Placement::in_plane({1.27, thesis_length / 200 + 5e-3});
  return options;
}
OrientedState at(double y, double time = 0) {
  OrientedState state;
  state.position = {0, y, 0}, state.time = time;
  return state;
}
const VirtualCoupling stiff({5000, 1});

}  // namespace

TEST_CASE("a clock tells what has passed, what may be divided by, and what was a pause", "[servo][pause]") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity(),
               T = 1e-3;
  LoopClock clock(T);
  const auto passed = [&](double time, double dt, double step, bool pause) {
    const LoopClock::Passed is = clock.passed(time);
    CAPTURE(time);
    CHECK(is.dt == Approx(dt).epsilon(1e-9));
    CHECK(is.step == Approx(step).epsilon(1e-9));
    CHECK(is.pause == pause);
  };
  passed(1, 1, T, true);
  passed(1.0013, 1.3e-3, 1.3e-3, false);
  passed(1.0014, 1e-4, T / 2, false);
  for (const double wrong : {1.0014, 1.0, nan, inf, -inf}) passed(wrong, 0, T, false);
  passed(1.002, 2e-3, 2e-3, false);  // since 1.0
  passed(1.1, 0.098, 0.098, false);
  passed(0.5, 0, T, true);
  passed(-1e308, 0, T, true);
  CHECK(clock.passed(1.7e308).pause);
  CHECK_THROWS_WITH(LoopClock(0), ContainsSubstring("period = 0 s"));
  CHECK_THROWS_WITH(LoopClock(1e-3, -1), ContainsSubstring("longest_pause = -1 s"));
  // Ticks that are a tenth of a second apart, or more, are no pauses of such a loop.
  LoopClock slow(0.2);
  (void)slow.passed(1);
  CHECK_FALSE(slow.passed(1.2).pause);
  CHECK(slow.passed(1.7).pause);
}

TEST_CASE("n ticks after start, reset, failure or pause at most n T / 0.2 s of the force", "[servo][pause]") {
  const DeviceInfo device = phantom();
  Random random(40);
  const auto sweep = [&](auto& servo, double y) {
    const long ticks = pause_ticks(6000);
    CHECK(surprises(servo, device, at(y, 1000), ticks, random) == 0);
    servo.reset();
    CHECK(surprises_of_host(servo, device, {0, y, 0}, ticks, random) == 0);
    double force = 0;
    for (int tick = 0; tick < 300; ++tick) force = servo.tick({0, y, 0}, Vector(0, 0, 0), 1e-3).norm();
    CHECK(force >= device.continuous_force);
  };
  FemModel<> coupled(bar(), 8), pressed(bar(), 8);
  Servo<FemModel<>> servo(coupled, device, above_bar(), stiff);
  sweep(servo, -0.012);
  Servo<FemModel<>, Direct> direct(pressed, device, above_bar());
  sweep(direct, -0.012);
}

TEST_CASE("a model that fails, and a late tick after it", "[servo][pause]") {
  const DeviceInfo device = phantom();
  ClosedFormBeam<double> beam{Ends::simply_supported};
  ServoOptions options;
  options.placement = Placement::in_plane({0.5, 6e-3});
  for (const double late : {1e-3, 0.02, 0.09, 0.101, 0.25, 10.0}) {
    Servo<ClosedFormBeam<double>> servo(beam, device, options, VirtualCoupling({2e4, 0}));
    double time = 1000;
    const auto tick = [&](double y, double dt) { return servo.tick(at(y, time += dt)).norm(); };
    for (int i = 0; i < 400; ++i) (void)tick(-1e-3 * i, 1e-3);
    const double whole = servo.record().force.norm();
    REQUIRE(whole > 4);
    beam.fail_with = Status::singular;
    CHECK(tick(-0.4, 1e-3) == 0);
    beam.fail_with = Status::ok;
    for (int n = 1; n <= 3; ++n) CHECK(tick(-0.4, n == 1 ? late : 1e-3) <= n / 200.0 * whole * (1 + 1e-9));
  }
}

// As after DeviceState::reset: it may be on the other side by now.
TEST_CASE("a hand that comes back after a pause touches anew, from where it is", "[servo][pause]") {
  ClosedFormBeam<double> beam{Ends::simply_supported};
  ServoOptions options;
  options.placement = Placement::in_plane({0.5, 6e-3});
  Servo<ClosedFormBeam<double>> servo(beam, phantom(), options, VirtualCoupling({200, 0}));
  double time = 0;
  for (int i = 0; i < 400; ++i) (void)servo.tick(at(i < 10 ? 0.01 : -0.02, time += 1e-3));
  REQUIRE(servo.record().status == LoopStatus::touching);
  time += 5;
  for (int i = 0; i < 400; ++i) CHECK(servo.tick(at(-0.1, time += 1e-3)).isZero(0));
  CHECK(servo.record().status == LoopStatus::free);
  CHECK(servo.record().energy_generated == 0);
}

// The arm takes nothing here, so that each joule is counted; the sample-and-hold gives K δ² N, K the series.
TEST_CASE("a force that comes in anew after a pause has lent what it returns, and generated none",
          "[servo][pause]") {
  DeviceInfo lossless = phantom();
  lossless.damping = lossless.friction = lossless.position_resolution = 0;
  for (const double pause : {0.11, 0.2, 3.0}) {
    FemModel<> model(bar(), 16);
    Servo<FemModel<>> servo(model, lossless, above_bar(), VirtualCoupling({1000, 1}));
    const double depth = 0.004, K = 1 / (1 / 1000.0 + 1 / 21e3), step = depth / 200;
    double time = 0;
    const auto to = [&](double y, double dt) { (void)servo.tick(at(y, time += dt)); };
    for (int i = 0; i < 300; ++i) to(0.001, 1e-3);
    to(-depth, pause);  // it went there meanwhile
    for (int i = 0; i < 100; ++i) to(-depth, 1e-3);
    for (int i = 0; i <= 250; ++i) to(-depth + step * i, 1e-3);  // pushed out, while still more comes in
    CAPTURE(pause);
    CHECK(servo.record().status == LoopStatus::free);
    CHECK(servo.record().max_force > 1);
    CHECK(servo.record().energy_generated <= K * step * depth);
  }
}

TEST_CASE("the record of any finite state is finite in all of its fields", "[servo][pause]") {
  const DeviceInfo device = phantom();
  Random random(11);
  const auto sweep = [&](auto& servo) {
    OrientedState hand;
    for (long tick = 0; tick < pause_ticks(5000); ++tick) {
      hand.time += 1e-3, hand.position = Vector(random(0.01), random(0.02), random(0.01));
      const OrientedState state = hostile_state(hand, random);
      const Vector force = servo.tick(static_cast<const DeviceState&>(state));
      const char* const field = not_finite(servo.record());
      INFO("field: " << (field ? field : "none") << ", tick " << tick);
      REQUIRE(field == nullptr);
      REQUIRE(force.allFinite());
      if (random.integer(0, 99) == 0) {
        (void)servo.tick(state.position, state.velocity, hostile_number(random));
        REQUIRE(not_finite(servo.record()) == nullptr);
      }
    }
    CHECK(servo.record().contact_ticks > 100);
  };
  for (const double scale : {1.0, 1e6}) {
    ServoOptions options = above_bar();
    options.placement = Placement::in_plane({1.27, thesis_length / 200 + 5e-3}, scale);
    options.dissipate = true;
    FemModel<> model(bar(), 8);
    FemModel<VonKarman<>, float> single(bar(), 8);
    Servo<FemModel<>> servo(model, device, options);
    Servo<FemModel<VonKarman<>, float>, Direct> direct(single, device, options);
    if (scale == 1) sweep(servo), sweep(direct);
    else {
      (void)servo.tick(at(1e300)), (void)direct.tick(at(1e9));
      CHECK(not_finite(servo.record()) == nullptr);
      CHECK(not_finite(direct.record()) == nullptr);
    }
  }
}

TEST_CASE("a reading that is no place: no force, and the record has the last one that was",
          "[servo][pause]") {
  FemModel<> model(bar(), 8);
  Servo<FemModel<>> servo(model, phantom(), above_bar());
  double time = 0;
  for (int i = 0; i < 300; ++i) (void)servo.tick(at(-0.002, time += 1e-3));
  REQUIRE(servo.record().force.norm() > 5);
  for (const double y : {1e300, -1e10, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(servo.tick(at(y, time += 1e-3)).isZero(0));
    CHECK(servo.record().status == LoopStatus::no_answer);
    CHECK(servo.record().model == Status::invalid_request);
    CHECK(servo.record().position.y() == -0.002);
    CHECK(servo.tick(at(-0.002, time += 1e-3)).norm() <= 37.5 / 200 * (1 + 1e-9));
  }
  CHECK(servo.record().contact_ticks == 303);
  // Many of them are a pause: the hand may be on the other side by now.
  for (int i = 0; i < 110; ++i) CHECK(servo.tick(at(1e300, time += 1e-3)).isZero(0));
  CHECK(servo.tick(at(-0.1, time += 1e-3)).isZero(0));
  CHECK(servo.record().status == LoopStatus::free);
  CHECK(servo.tick(at(-1e9, time += 1e-3)).isZero(0));  // far, and nothing there
  CHECK(servo.record().status == LoopStatus::free);
}
