// A hand that holds an end of a rod through the loop: force and torque, whole strokes, faults, and whether it comes to rest.
#include <cmath>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/turning_response.hpp"
#include <hapbeam/haptics/held/grip.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

using Model = FemModel<TwistedRod>;
constexpr RodMaterial plastic{3e9, 1.1e9};

VirtualPhantomOptions six_axes() {
  VirtualPhantomOptions options;
  options.gimbal.present = true;
  return options;
}
DeviceInfo phantom() { return VirtualPhantom<>(HandPath({0, 0}), six_axes()).info(); }

/// From the hand along -z, away from the user, to a clamp.
Rod away(double length, double diameter, const RodSupport& held, const RodMaterial& material = plastic,
         const RodSupport& far = RodSupport::clamped) {
  Rod rod(length, RodSection::circle(diameter), material, held, far);
  return rod.place_left({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}});
}
OrientedState state_at(int tick, const Point& position, const Eigen::Vector3d& angles) {
  OrientedState state;
  state.position = position, state.time = 1e-3 * tick, state.reset = tick == 0;
  state.orientation = gimbal_orientation(angles);
  return state;
}

}  // namespace

TEST_CASE("an end on springs that is held elsewhere is the series of springs and rod", "[rod][grip]") {
  const double k = 400, t = 0.05, length = 0.3;
  const Rod rod = away(length, 0.004, RodSupport::elastic(k, k, k, t, t, t));
  Model model(rod, 8);
  // Pulled along itself, and twisted: EA/L and GJ/L in series with the springs.
  const double axial = rod.stiffness().axial / length, torsion = rod.stiffness().torsion / length;
  HeldEnd<double> held = model.hold(RodSide::left, {{0, 0, 0.002}, {0, 0, -1}, {0, 1, 0}});
  REQUIRE(held.status == Status::ok);
  CHECK(held.force.z() == Approx(0.002 * k * axial / (k + axial)).epsilon(1e-4));
  held = model.hold(RodSide::left, {{0, 0, 0}, {0, 0, -1}, {std::sin(0.3), std::cos(0.3), 0}});
  REQUIRE(held.status == Status::ok);
  CHECK(held.moment.z() == Approx(-0.3 * t * torsion / (t + torsion)).epsilon(1e-6));
  CHECK(model.hold(RodSide::left, {{0, 0, NAN}, {0, 0, -1}, {0, 1, 0}}).status == Status::invalid_request);
  Model clampless(away(length, 0.004, RodSupport::elastic(k, k, k, 0, 0, t)), 8);
  CHECK(clampless.hold(RodSide::left, {}).status == Status::invalid_request);
}

TEST_CASE("steady, what the hand feels is the coupling in series with the rod", "[rod][grip]") {
  const GripCoupling coupling = GripCoupling::for_device(phantom());
  for (const double diameter : {0.004, 0.02}) {
    const Rod rod = away(0.3, diameter, coupling.support());
    Model model(rod, 8);
    Grip<Model> grip(model, RodSide::left);
    Servo<Grip<Model>> servo(grip, phantom());
    Wrench felt;
    for (int tick = 0; tick < 800; ++tick)
      felt = servo.tick(state_at(tick, {0, 0, 0.0005 * std::min(1.0, tick / 300.0)},
                                 {0, 0, 0.1 * std::min(1.0, tick / 300.0)}));
    const auto series = [](double a, double b) { return a * b / (a + b); };
    const double k = series(coupling.place().stiffness, rod.stiffness().axial / 0.3),
                 t = series(coupling.turning().stiffness, rod.stiffness().torsion / 0.3);
    CAPTURE(diameter);
    CHECK(felt.force.z() == Approx(-0.0005 * k).epsilon(2e-3));
    CHECK(felt.torque.z() == Approx(-0.1 * t).epsilon(2e-3));
    CHECK(servo.record().status == LoopStatus::touching);
  }
}

TEST_CASE("a rod is taken, bent, twisted by three turns and brought back", "[rod][grip]") {
  const GripCoupling coupling = GripCoupling::for_device(phantom());
  Model model(away(0.4, 0.002, coupling.support()), 12);
  Grip<Model> grip(model, RodSide::left);
  VirtualPhantom<> device(HandPath({0, 0})
                              .rest(0.3)
                              .press(0.03, 0.5)
                              .turn({0, 0, 6 * pi}, 1.5)
                              .rest(0.2)
                              .turn({0.1, 0.2, 0}, 0.3)
                              .turn({-0.1, -0.2, -6 * pi}, 1.5)
                              .release(0.03, 0.5)
                              .rest(0.5),
                          six_axes());
  Servo<Grip<Model>> servo(grip, device.info());
  device.run(servo, 2.6);
  const ServoRecord twisted = servo.record();
  CHECK(device.gimbal().angles()[2] == Approx(6 * pi).epsilon(0.02));
  // GJ/L for each radian; bent by a tenth of its length it twists the same to first order.
  const Rod rod = away(0.4, 0.002, coupling.support());
  const double torsion = rod.stiffness().torsion / 0.4;
  const double k = coupling.turning().stiffness * torsion / (coupling.turning().stiffness + torsion);
  CHECK(twisted.torque.norm() == Approx(6 * pi * k).epsilon(0.1));
  device.run(servo, 3);
  const ServoRecord& back = servo.record();
  CHECK(back.torque.norm() <= 0.02 * twisted.torque.norm());
  CHECK(back.failed_ticks == 0);
  CHECK(back.touches == 1);
  CHECK(back.worst == Status::ok);
  CHECK(back.energy_generated <= 1e-6);
  CHECK(back.max_torque <= device.info().gimbal.peak_torque);
  CHECK(model.report().solves <= 6);
}

TEST_CASE("a wrist lets go and takes again, and nothing jumps", "[rod][grip]") {
  const GripCoupling coupling = GripCoupling::for_device(phantom());
  Model model(away(0.4, 0.002, coupling.support()), 12);
  Grip<Model> grip(model, RodSide::left);
  Servo<Grip<Model>> servo(grip, phantom());
  int tick = 0;
  double twist = 0, most = 0;
  Wrench last;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 600; ++i, ++tick) {  // half a turn, held
      const double q = pi * std::min(1.0, i / 500.0);
      const Wrench felt = servo.tick(state_at(tick, {0, 0, 0}, {0, 0, q}));
      most = std::max(most, (felt.torque - last.torque).norm());
      last = felt;
    }
    CHECK(std::abs(last.torque.z()) > twist + 0.01);
    twist = std::abs(last.torque.z());
    grip.let_go();
    for (int i = 0; i < 600; ++i, ++tick) {  // back, in the air
      const Wrench felt = servo.tick(state_at(tick, {0, 0, 0}, {0, 0, pi * std::max(0.0, 1 - i / 500.0)}));
      REQUIRE((felt.force.isZero(0) && felt.torque.isZero(0)));
      REQUIRE(servo.record().status == LoopStatus::free);
    }
    last = {};
    grip.take();
  }
  // Comes in over 0.2 s, and never faster than the guard permits.
  CHECK(most <= 2 * twist / 200);
  CHECK(servo.record().energy_generated <= 1e-9);
}

TEST_CASE("a loop of the held end that closes takes no work", "[rod][grip]") {
  // Springs alone: with a damper it would take some.
  const GripCoupling coupling({500, 0}, {0.5, 0}, 1e-3);
  Model model(away(0.3, 0.004, coupling.support()), 8);
  Grip<Model> grip(model, RodSide::left);
  Servo<Grip<Model>> servo(grip, phantom(), {}, coupling);
  const int steps = 3000, start = 400;
  Wrench last;
  Point before = Point::Zero();
  Eigen::Matrix3d old = Eigen::Matrix3d::Identity();
  double work = 0, way = 0;
  for (int tick = 0; tick <= start + 2 * steps; ++tick) {
    const double a = 2 * pi * std::max(0, tick - start) / steps;
    const Point place(0.01 * std::sin(a), 0.015 * (1 - std::cos(a)), -0.002 * std::sin(2 * a));
    const OrientedState state =
        state_at(tick, place, {0.1 * std::sin(2 * a), 0.15 * std::sin(a), 0.5 * (1 - std::cos(a))});
    const Wrench felt = servo.tick(state);
    if (tick > start + steps) {
      const Eigen::Matrix3d by = state.orientation * old.transpose();
      const Point turned(by(2, 1) - by(1, 2), by(0, 2) - by(2, 0), by(1, 0) - by(0, 1));
      const double step =
          (felt.force + last.force).dot(place - before) / 2 + (felt.torque + last.torque).dot(turned) / 4;
      work += step, way += std::abs(step);
    }
    last = felt, before = place, old = state.orientation;
  }
  INFO(work << " of " << way);
  REQUIRE(way > 1e-3);
  CHECK(std::abs(work) <= 1e-5 * way);
}

TEST_CASE("a hand that leans and twists on an end that it holds comes to rest", "[rod][grip]") {
  Random random(31);
  for (int i = 0; i < 16; ++i) {
    VirtualPhantomOptions who = six_axes();
    who.hand = {random(300, 1000), random(0, 2), random(0.05, 0.4)};
    const double square = grip_lever * grip_lever;
    who.gimbal.hand_stiffness = random(300, 1000) * square, who.gimbal.hand_damping = random(0, 2) * square;
    who.gimbal.grip_inertia = random(0.05, 0.4) * square;
    who.gimbal.damping = random(1e-3, 5e-3), who.gimbal.friction = random(1e-3, 5e-3);
    who.gimbal.resolution = random(3e-5, 2e-4);
    who.arm.period = random(0.5e-3, 2e-3), who.arm.delay_ticks = random.integer(0, 3);
    ServoOptions options;
    options.delay_ticks = who.arm.delay_ticks;
    const DeviceInfo device = VirtualPhantom<Turning>(Turning{}, who).info();
    const bool stiff = i % 2 == 0;
    Model model(
        away(0.3, stiff ? 0.006 : 0.002, GripCoupling::for_device(device, options.delay_ticks).support(),
             stiff ? spring_steel : plastic),
        8);
    Grip<Model> grip(model, RodSide::left);
    Turning hand;
    for (int k = 0; k < 3; ++k) hand.push[k] = random(2.), hand.twist[k] = random(0.05);
    const TurningResponse r = turning_response(grip, hand, who, options, 0.7, 0.9);
    CAPTURE(i, who.arm.period, who.arm.delay_ticks, who.gimbal.damping, who.gimbal.hand_stiffness, stiff);
    CHECK(r.speed <= 1e-3);
    CHECK(r.rate <= 0.03);
    CHECK(r.least_energy >= -1e-9);
    CHECK(r.generated <= r.max_torque * who.gimbal.resolution + r.max_force * who.arm.resolution);
    CHECK(r.record.failed_ticks == 0);
  }
}

TEST_CASE("turned, moved and scaled with its scene, a held end feels the same", "[rod][grip]") {
  const Eigen::Matrix3d turn = (Eigen::Matrix3d() << 0, -1, 0, 0, 0, 1, -1, 0, 0).finished();
  const double scale = 2;
  const GripCoupling scene({400, 1}, {0.4, 1e-4}, 1e-3), device({800, 2}, {0.2, 5e-5}, 1e-3);
  const Rod rod = away(0.3, 0.003, scene.support());
  Model one(rod, 8), other(rod, 8);
  Grip<Model> first(one, RodSide::left), second(other, RodSide::left);
  ServoOptions options;
  Servo<Grip<Model>> plain(first, phantom(), options, scene);
  options.placement = Placement(turn, {0.1, -0.02, 0.03}, scale);
  Servo<Grip<Model>> placed(second, phantom(), options, device);
  for (int tick = 0; tick < 500; ++tick) {
    OrientedState state = state_at(tick, {0.01 * std::sin(0.01 * tick), 1e-5 * tick, 0},
                                   {0.001 * tick, 0.2 * std::sin(0.01 * tick), 0.002 * tick});
    const Wrench a = plain.tick(state);
    state.position = options.placement.device_position(state.position);
    state.orientation = turn.transpose() * state.orientation;
    const Wrench b = placed.tick(state);
    CAPTURE(tick);
    REQUIRE((turn * b.force - a.force).norm() <= 1e-6 * (1e-3 + a.force.norm()));
    REQUIRE((turn * b.torque * scale - a.torque).norm() <= 1e-6 * (1e-4 + a.torque.norm()));
  }
}

TEST_CASE("a device of three axes holds an end as it is turned, and a clamped end is felt without a coupling",
          "[rod][grip]") {
  DeviceInfo three = VirtualPhantom<>(HandPath({0, 0})).info();
  Model model(away(0.4, 0.003, RodSupport::clamped), 8), same(away(0.4, 0.003, RodSupport::clamped), 8);
  Grip<Model> grip(model, RodSide::left);
  Servo<Grip<Model>> servo(grip, three);
  VirtualPhantom<> device(HandPath({0, 0}).rest(0.3).press(0.02, 0.5).rest(0.2));
  device.run(servo, 1);
  const Point at = servo.record().hand;
  const HeldEnd<double> held = same.hold(RodSide::left, {at, {0, 0, -1}, {0, 1, 0}});
  CHECK((servo.record().force + held.force).norm() <= 1e-6 * held.force.norm());
  CHECK(servo.record().force.y() > 0.01);
  CHECK(servo.record().torque.isZero(0));
}

TEST_CASE(
    "jumps, readings that are no numbers and resets leave force and torque finite, and the end is found "
    "again",
    "[rod][grip]") {
  const GripCoupling coupling = GripCoupling::for_device(phantom());
  Model model(away(0.3, 0.003, coupling.support()), 8);
  Grip<Model> grip(model, RodSide::left);
  Servo<Grip<Model>> servo(grip, phantom());
  Random random(9);
  const double bad[] = {std::nan(""), double(INFINITY), 1e300};
  for (int tick = 0; tick < 1500; ++tick) {
    OrientedState state =
        state_at(tick, {random(0.1), random(0.1), random(0.1)}, {random(3.), random(3.), random(3.)});
    if (random(0, 1) < 0.05) state.position[random.integer(0, 2)] = bad[random.integer(0, 2)];
    if (random(0, 1) < 0.05)
      state.orientation(random.integer(0, 2), random.integer(0, 2)) = bad[random.integer(0, 2)];
    state.reset |= random(0, 1) < 0.02;
    if (random(0, 1) < 0.02) random(0, 1) < 0.5 ? grip.let_go() : grip.take();
    const Wrench felt = servo.tick(state);
    REQUIRE((felt.force.allFinite() && felt.torque.allFinite()));
    REQUIRE(felt.force.norm() <= phantom().peak_force * (1 + 1e-12));
    REQUIRE(felt.torque.norm() <= phantom().gimbal.peak_torque * (1 + 1e-12));
    REQUIRE(model.report().solves <= 48 + 2);
  }
  grip.take();
  Wrench felt;
  for (int tick = 1500; tick < 2100; ++tick) {
    OrientedState state = state_at(tick, {0, 0, 0.001 * std::min(1.0, (tick - 1500) / 300.0)}, {0, 0, 0});
    state.reset = tick == 1500;
    felt = servo.tick(state);
  }
  CHECK(felt.force.z() < -0.5);
  CHECK(servo.record().status == LoopStatus::touching);
  CHECK_THROWS_WITH(GripCoupling({-1, 0}, {1, 0}, 1e-3), ContainsSubstring("grip stiffness = -1 N/m"));
  CHECK_THROWS_WITH(GripCoupling({1, 0}, {1, -1}, 1e-3), ContainsSubstring("grip turning damping = -1"));
}

TEST_CASE("an orientation that is no rotation is no reading, and the hand goes on after it", "[rod][grip]") {
  const GripCoupling coupling = GripCoupling::for_device(phantom());
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(2, 2) = -1;
  for (const Eigen::Matrix3d& by :
       {mirror, Eigen::Matrix3d(-Eigen::Matrix3d::Identity()),
        Eigen::Matrix3d(1.5 * Eigen::Matrix3d::Identity()), Eigen::Matrix3d(Eigen::Matrix3d::Zero())}) {
    Model model(away(0.3, 0.003, coupling.support()), 8);
    Grip<Model> grip(model, RodSide::left);
    Servo<Grip<Model>> servo(grip, phantom());
    Wrench before, felt;
    for (int tick = 0; tick < 1000; ++tick) {
      OrientedState state = state_at(tick, {0, 0.002 * std::min(1.0, tick / 300.0), 0},
                                     {0, 0, 0.2 * std::min(1.0, tick / 300.0)});
      if (tick == 600) before = felt, state.orientation = by * state.orientation;
      felt = servo.tick(state);
      CAPTURE(tick, by);
      if (tick == 600) {
        REQUIRE(servo.record().model == Status::invalid_request);
        REQUIRE((felt.force.isZero(0) && felt.torque.isZero(0)));
      } else {
        REQUIRE(servo.record().model == Status::ok);
      }
    }
    CHECK(before.force.norm() > 0.02);
    CHECK((felt.force - before.force).norm() <= 1e-3 * before.force.norm());
    CHECK((felt.torque - before.torque).norm() <= 1e-3 * before.torque.norm());
  }
}

TEST_CASE("a hand that has leapt to where no answer is found takes the end anew", "[rod][grip]") {
  const GripCoupling coupling = GripCoupling::for_device(phantom());
  Model model(away(0.3, 0.006, coupling.support()), 8);
  Grip<Model> grip(model, RodSide::left);
  Servo<Grip<Model>> servo(grip, phantom());
  // Half a turn across the rod, from one tick to the next.
  Eigen::Matrix3d half = -Eigen::Matrix3d::Identity();
  half(0, 0) = 1;
  long lost = 0, late = 0;
  Wrench last;
  for (int tick = 0; tick < 1200; ++tick) {
    OrientedState state = state_at(tick, {0, 0, 0}, {0, 0, 0});
    if (tick >= 300) state.orientation = half;
    // And leads it on.
    state.position.y() = 1e-5 * std::max(0, tick - 700);
    const Wrench felt = servo.tick(state);
    const bool none = servo.record().status == LoopStatus::no_answer;
    lost += none, late += none && tick > 600;
    const double most = phantom().peak_force / 200;
    if (servo.record().status == LoopStatus::engaging) CHECK(felt.force.norm() - last.force.norm() <= most);
    last = felt;
  }
  CHECK(lost >= 1);
  CHECK(late == 0);
  CHECK(servo.record().status == LoopStatus::touching);
  CHECK(last.force.y() < -0.01);
}
