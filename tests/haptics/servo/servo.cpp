// The tick as a whole: what is sent, what is said about it, and how it begins anew after whatever went wrong.
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "contact/closed_form_beam.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

template <>
struct Catch::StringMaker<LoopStatus> {
  static std::string convert(LoopStatus status) { return name(status); }
};

namespace {

using Vector = Eigen::Vector3d;

static_assert(is_servo<Servo<FemModel<>>>);
static_assert(is_servo<Servo<FemModel<VonKarman<>, float>, Direct>>);
static_assert(noexcept(std::declval<Servo<FemModel<>>&>().reset()));
static_assert(noexcept(std::declval<Servo<FemModel<>>&>().picture()));

DeviceInfo phantom() { return VirtualPhantom<>(HandPath({0, 0})).info(); }

/// The device's origin where the avatar touches the middle of the beam.
ServoOptions above(double x, double reach, double scale = 1) {
  ServoOptions options;
  options.placement = Placement::in_plane({x, reach}, scale);
  return options;
}

DeviceState state(double y, int tick) {
  return {Vector(0, y, 0), Vector::Zero(),        1e-3 * tick, ForceCut::none,
          Vector::Zero(),  DeviceStatus::running, tick == 0};
}

/// A closed-form beam of 1 m, EI = 1 Nm²: 48 N/m at its middle.
struct Closed {
  ClosedFormBeam<double> beam{Ends::simply_supported};
  Servo<ClosedFormBeam<double>> servo{beam, phantom(), above(0.5, 6e-3), VirtualCoupling({200, 0})};
  int tick = 0;

  Closed() { press(-0.01, 10); }  // from above: where the hand begins is the side that it touches
  double press(double depth, int ticks) {
    double force = 0;
    for (int i = 0; i < ticks; ++i) force = servo.tick(state(-depth, tick++)).y();
    return force;
  }
  const ServoRecord& record() { return servo.picture().record; }
};

}  // namespace

TEST_CASE("a host that hands over time steps feels what a device with a clock feels", "[servo]") {
  Closed device, host, broken;
  Random random(1);
  double time = 1e-3 * device.tick;
  for (int tick = 0; tick < 2000; ++tick) {
    const double dt = 1e-3 * random(0.7, 1.3), y = 5e-3 * std::sin(tick * 0.01);
    DeviceState now = state(y, 1);
    now.time = time += dt;
    const Vector felt = device.servo.tick(now);
    REQUIRE((felt - host.servo.tick(now.position, now.velocity, dt)).norm() <= 1e-12);
    const double wrong[] = {std::numeric_limits<double>::quiet_NaN(), -dt, 0, 1e300};
    REQUIRE(broken.servo.tick(now.position, now.velocity, wrong[tick % 4]).allFinite());
  }
  CHECK(device.record().contact_ticks > 500);
}

TEST_CASE("free, touching, free again: the record says so and counts", "[servo]") {
  Closed c;
  CHECK(c.press(-0.01, 300) == 0);
  CHECK(c.record().status == LoopStatus::free);
  CHECK(c.record().ticks == 310);
  const double force = c.press(0.02, 300);
  CHECK(force == Approx(0.02 / (1 / 200.0 + 1 / 48.0)).epsilon(1e-3));
  const ServoRecord pressed = c.record();
  CHECK(pressed.status == LoopStatus::touching);
  CHECK(pressed.model == Status::ok);
  CHECK(pressed.pressing);
  CHECK(pressed.force.y() == force);
  CHECK(pressed.contact_ticks == 300);
  CHECK(pressed.touches == 1);
  CHECK(pressed.press.s == Approx(0.5));
  CHECK(pressed.press.d == Approx(-force / 48).epsilon(1e-3));
  CHECK(pressed.hand.y() == Approx(6e-3 - 0.02));
  CHECK(pressed.avatar.y() - pressed.hand.y() == Approx(force / 200).epsilon(1e-3));
  CHECK(pressed.max_press >= -pressed.press.d);
  CHECK(c.press(-0.01, 1) == 0);
  c.press(-0.01, 100);
  CHECK(c.record().status == LoopStatus::free);
  CHECK(c.record().max_force == pressed.max_force);
  c.servo.reset();
  CHECK(c.record().ticks == 0);
  CHECK(c.record().max_force == 0);
}

TEST_CASE("the picture has the shape of its own tick", "[servo]") {
  Closed c;
  c.press(0.02, 400);
  const auto& picture = c.servo.picture();
  REQUIRE(picture.shape().size() == c.beam.shape().size());
  for (int i = 0; i < picture.shape().size(); ++i) CHECK(picture.shape()[i].w == c.beam.shape()[i].w);
  CHECK(picture.shape()[1].w == picture.record.press.d);
}

// A quarter of a turn within a few elements: what moderate rotation draws between their nodes is far beside it.
TEST_CASE("the picture draws a beam of any rotation as its model does", "[servo]") {
  using Turning = FemModel<Corotational<>>;
  Turning ruler(
      Beam(0.3, Section::rectangle(0.025, 0.0005), Material{200e9}, Support::clamped, Support::free), 4);
  Servo<Turning> servo(ruler, phantom(), above(0.15, 5.25e-3, 3), VirtualCoupling({2000, 0}));
  for (int tick = 0; tick < 1000; ++tick) {
    DeviceState now = state(0.001 - 5e-5 * tick, tick);
    (void)servo.tick(now);
  }
  REQUIRE(ruler.shape()[ruler.shape().segments()].theta > 0.7);
  for (int k = 0; k <= 50; ++k) {
    const double s = 0.006 * k;
    const Displacement<double> own = ruler.shape().at(s), drawn = servo.picture().shape().at(s);
    CHECK(drawn.u == own.u);
    CHECK(drawn.w == own.w);
  }
}

TEST_CASE("a model that fails: no force in the same tick, and gently back", "[servo]") {
  Closed c;
  const double force = c.press(0.02, 400);
  for (const Status failure : {Status::invalid_request, Status::singular, Status::non_finite}) {
    c.beam.fail_with = failure;
    const auto failed = c.record().failed_ticks;
    CHECK(c.press(0.02, 1) == 0);
    CHECK(c.record().status == LoopStatus::no_answer);
    CHECK(c.record().model == failure);
    CHECK(c.record().failed_ticks == failed + 1);
    c.beam.fail_with = Status::ok;
    const double first = c.press(0.02, 1);
    CHECK(first <= 0.02 * force);  // a period of 0.2 s
    CHECK(c.record().status == LoopStatus::engaging);
    CHECK(c.press(0.02, 400) == Approx(force).epsilon(1e-3));
    CHECK(c.record().status == LoopStatus::touching);
  }
  CHECK(c.record().worst == Status::non_finite);
}

TEST_CASE("a model out of its budget: the force goes on, and ends when nothing comes", "[servo]") {
  Closed c;
  const double force = c.press(0.02, 400);
  c.beam.fail_with = Status::iteration_limit;
  CHECK(c.press(0.02, LastResponse::max_continued) == Approx(force).epsilon(1e-6));
  CHECK(c.record().status == LoopStatus::continued);
  CHECK(c.record().continued_ticks == LastResponse::max_continued);
  CHECK(c.press(0.02, 1) == 0);
  CHECK(c.record().status == LoopStatus::no_answer);
  CHECK(c.record().worst == Status::iteration_limit);
}

TEST_CASE("a device that asks to begin anew, or is in trouble", "[servo]") {
  // No deeper than the avatar's radius: the side from which it touches is forgotten as well.
  Closed c;
  const double force = c.press(0.004, 400);
  DeviceState anew = state(-0.004, c.tick++);
  anew.reset = true;
  CHECK(c.servo.tick(anew).norm() <= 0.02 * force);
  CHECK(c.record().status == LoopStatus::device);
  CHECK(c.record().touches == 1);
  CHECK(c.press(0.004, 1) <= 0.02 * force);
  CHECK(c.press(0.004, 400) == Approx(force).epsilon(1e-3));
  DeviceState warm = state(-0.004, c.tick++);
  warm.status = DeviceStatus::warm;
  CHECK(c.servo.tick(warm).y() == Approx(force).epsilon(1e-3));  // the device itself sends less
  CHECK(c.record().status == LoopStatus::device);
  DeviceState cut = state(-0.004, c.tick++);
  cut.cut = ForceCut::peak;
  (void)c.servo.tick(cut);
  CHECK(c.record().status == LoopStatus::limited);
  CHECK(c.record().saturated_ticks == 1);
}

TEST_CASE("states that no device should give: finite, within the peak, and over with them", "[servo]") {
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                        1e300};
  Random random(7);
  for (const bool dissipate : {false, true}) {
    FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 8);
    ServoOptions options = above(0.3, thesis_length / 200 + 5e-3);
    options.dissipate = dissipate;
    Servo<FemModel<>> servo(model, phantom(), options);
    for (int tick = 0; tick < 20000; ++tick) {
      DeviceState s = state(random(0.01), tick);
      s.velocity = Vector(random(3), random(3), random(3));
      if (random(0, 1) < 0.05) s.position[random.integer(0, 2)] = bad[random.integer(0, 2)];
      if (random(0, 1) < 0.05) s.velocity[random.integer(0, 2)] = bad[random.integer(0, 2)];
      if (random(0, 1) < 0.05) s.time = bad[random.integer(0, 2)];
      if (random(0, 1) < 0.05) s.time = random(30);
      if (random(0, 1) < 0.01) s.reset = true;
      s.cut = random(0, 1) < 0.1 ? ForceCut::peak : ForceCut::none;
      s.sent = Vector(bad[random.integer(0, 2)], 1, 1);
      const Vector force = servo.tick(s);
      REQUIRE(force.allFinite());
      REQUIRE(force.norm() <= 37.5 * (1 + 1e-12));
    }
    // z is across the plane of the beam: a reading of it alone changes nothing.
    double last = 0;
    for (int tick = 0; tick < 1000; ++tick) last = servo.tick(state(-2e-3, 50000 + tick)).y();
    CHECK(last == Approx(2e-3 / (1 / 3500.0 + 1 / 1.2e5)).epsilon(0.05));
    CHECK(std::isfinite(servo.picture().record.energy_generated));
  }
}

// A coupled hand led past the tip of a ruler, and then in and out at random.
TEST_CASE("where the record says free nothing is sent, and a ruler that slips off was touched once",
          "[servo]") {
  using Turning = FemModel<Corotational<>>;
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{206.84e9}, Support::clamped,
                   Support::free);
  for (const double x : {0.15, 0.18, 0.2, 0.22, 0.24, 0.25, 0.26, 0.27, 0.28, 0.285, 0.29}) {
    Turning model(ruler, 16);
    ServoOptions options;
    Servo<Turning> servo(model, phantom(), options);
    int tick = 0;
    const auto to = [&](double along, double y) {
      DeviceState now = state(y, tick++);
      now.position.x() = along;
      const Vector force = servo.tick(now);
      CAPTURE(x, y, name(servo.record().status));
      if (servo.record().status == LoopStatus::free) REQUIRE(force.isZero(0));
      if (!servo.record().pressing) REQUIRE(force.isZero(0));
    };
    for (int i = 0; i < 210; ++i) to(x, 0.02);
    for (double y = 0.02; y > -0.35; y -= 2e-4) to(x, y);
    CHECK(servo.record().touches == 1);
    CHECK(servo.record().max_force > 5);
    CHECK_FALSE(servo.record().pressing);
    Random random(5);
    double along = x, y = -0.35;
    for (int way = 0; way < 10; ++way) {
      const double next_along = random(0.05, 0.33), next_y = random(0.1);
      for (int i = 1; i <= 100; ++i) to(along + (next_along - along) * i / 100, y + (next_y - y) * i / 100);
      along = next_along, y = next_y;
    }
  }
}

// The arm takes nothing here, so that each joule is counted; the sample-and-hold gives K δ² N, K the series.
TEST_CASE("pressing while the force comes in lends energy, and the record counts none as generated",
          "[servo]") {
  DeviceInfo lossless = phantom();
  lossless.damping = lossless.friction = lossless.position_resolution = 0;
  const auto press = [&](auto& servo, int ticks, double depth) {
    int tick = 0;
    for (; tick <= ticks; ++tick) (void)servo.tick(state(0.001 - (depth + 0.001) * tick / ticks, tick));
    for (int i = 0; i < 300; ++i) (void)servo.tick(state(-depth, tick++));
    for (int i = 0; i <= 200; ++i) (void)servo.tick(state(-depth + (depth + 0.001) * i / 200, tick++));
    return servo.record();
  };
  const double reach = 5e-3 + thesis_length / 200;
  for (const double scale : {1.0, 4.0})
    for (const int ticks : {50, 150}) {
      FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 16);
      Servo<FemModel<>> servo(model, lossless, above(1.27, reach, scale), VirtualCoupling({1000, 1}));
      const double depth = 0.005, K = 1 / (1 / 1000.0 + 1 / (21e3 * scale)),
                   step = depth / std::min(ticks, 200);
      const ServoRecord record = press(servo, ticks, depth);
      CAPTURE(scale, ticks);
      CHECK(record.status == LoopStatus::free);
      CHECK(record.max_force > 1);
      CHECK(record.energy_generated <= K * step * depth);
    }
}

TEST_CASE("a servo that is reset has generated nothing, now and in its next tick", "[servo]") {
  Closed c;
  c.press(0.02, 400);
  for (int i = 1; i <= 30; ++i) {  // the device pushes the hand out, harder than it was asked to
    DeviceState pushed = state(-0.02 + 1e-3 * i, c.tick++);
    pushed.cut = ForceCut::peak, pushed.sent = Vector(0, i < 20 ? 37 : 0, 0);
    (void)c.servo.tick(pushed);
  }
  c.press(-0.01, 2);
  REQUIRE(c.record().energy_generated > 0);
  c.servo.reset();
  CHECK(c.record().energy_generated == 0);
  c.press(-0.01, 5);
  CHECK(c.record().energy_generated == 0);
}

TEST_CASE("in a scene of another scale the hand feels the coupling that its device can render", "[servo]") {
  // A beam that is rigid against the coupling: what is felt is the coupling, device force over device metres.
  for (const double scale : {0.5, 1.0, 5.0}) {
    FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 8);
    Servo<FemModel<>> servo(model, phantom(), above(0.02, thesis_length / 200 + 5e-3, scale),
                            VirtualCoupling({1000, 0}));
    double force = 0;
    for (int tick = 0; tick < 500; ++tick) force = servo.tick(state(-3e-3, tick)).y();
    CHECK(force == Approx(3.0).epsilon(1e-3));
  }
}

TEST_CASE("a budget of three solves a tick: the loop goes on, and says when it had to", "[servo]") {
  NewtonRaphson short_of_time;
  short_of_time.max_solves = 3;
  const Beam strip(0.5, Section::rectangle(0.02, 1e-4), Material{thesis_young}, Support::pinned,
                   Support::pinned);
  FemModel<VonKarman<FullIntegration>> model(strip, 16,
                                             short_of_time);  // one unknown would be solved for in three
  VirtualPhantom<> device(HandPath({0, 0.01}).press(0.03, 0.3).slide(0.05, 0.3).release(0.03, 0.2));
  ServoLoop loop(device, model, above(0.25, 5e-3));
  device.run(loop.servo(), 1.5);
  const ServoRecord& record = loop.picture().record;
  CHECK(record.worst == Status::iteration_limit);
  CHECK(record.continued_ticks > 0);
  CHECK(record.contact_ticks > 400);
  CHECK(record.status == LoopStatus::free);
}

TEST_CASE("a loop runs, stops, and runs again from the beginning", "[servo][thread]") {
  FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 8);
  VirtualPhantom<> device(HandPath({0, 0.01}).press(0.015, 0.05));
  ServoLoop loop(device, model, above(1.27, thesis_length / 200 + 5e-3));
  for (int round = 0; round < 2; ++round) {
    CHECK_FALSE(loop.running());
    loop.start();
    CHECK(loop.running());
    CHECK_THROWS_AS(loop.start(), std::logic_error);
    while (loop.picture().record.contact_ticks == 0) std::this_thread::yield();
    loop.stop();
    CHECK_FALSE(loop.running());
    const auto ticks = loop.picture().record.ticks;
    CHECK(ticks == device.counts().ticks);
    CHECK(loop.times().compute().count() >= ticks);
  }
  CHECK(loop.picture().record.touches >= 1);
}

TEST_CASE("an impossible servo is refused", "[servo]") {
  FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 8);
  ServoOptions options;
  options.avatar_radius = -1;
  CHECK_THROWS_WITH((Servo<FemModel<>>(model, phantom(), options)), ContainsSubstring("avatar_radius"));
  options = {};
  options.delay_ticks = 17;
  CHECK_THROWS_WITH((Servo<FemModel<>>(model, phantom(), options)), ContainsSubstring("delay_ticks = 17"));
  DeviceInfo unknown = phantom();
  unknown.damping = -1;
  CHECK_THROWS_WITH((Servo<FemModel<>>(model, unknown)), ContainsSubstring("device damping = -1 N·s/m"));
  unknown.damping = 0;
  CHECK_NOTHROW(Servo<FemModel<>>(model, unknown));
  CHECK_NOTHROW(Servo<FemModel<>, Direct>(model, unknown));
}
