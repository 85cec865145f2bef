// A beam with mass in the loop: what is felt, what goes on moving, and what stops it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double radius = 0.005, half = 0.0005;

Beam ruler(double height = 2 * half) {
  return {0.3, Section::rectangle(0.025, height), Material{200e9, 7850}, Support::clamped, Support::free};
}
ServoOptions at_the_beam() {
  ServoOptions options;
  options.placement = Placement::in_plane({0, 0});
  options.avatar_radius = radius;
  return options;
}

/// A loop whose hand is put where one likes.
struct Loop {
  explicit Loop(int substeps = 4, const Beam& beam = ruler()) : model(beam, 8, substeps) {}
  const ServoRecord& hold(double x, double y, int ticks, double dt = 1e-3) {
    for (int k = 0; k < ticks; ++k) force = servo.tick({x, y, 0}, {0, 0, 0}, dt);
    return servo.record();
  }
  const ServoRecord& move(double x, double y, double to_x, double to_y, int ticks) {
    for (int k = 1; k <= ticks; ++k) hold(x + (to_x - x) * k / ticks, y + (to_y - y) * k / ticks, 1);
    return servo.record();
  }
  double tip() const { return model.shape().at(0.3).w; }

  DynamicModel<> model;
  DeviceInfo info = VirtualPhantom<>(HandPath({0, 0})).info();
  Servo<DynamicModel<>> servo{model, info, at_the_beam()};
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

}  // namespace

TEST_CASE("a beam with mass is felt as the same beam without, where it rests", "[dynamics]") {
  Loop loop;
  FemModel<Corotational<>> still(ruler(), 8);
  Servo<FemModel<Corotational<>>> servo(still, loop.info, at_the_beam());
  loop.hold(0.2, 0.01, 300);
  loop.move(0.2, 0.01, 0.2, -0.005, 2000);
  const ServoRecord& felt = loop.hold(0.2, -0.005, 2000);
  for (int k = 0; k < 300; ++k) (void)servo.tick({0.2, 0.01, 0}, {0, 0, 0}, 1e-3);
  for (int k = 0; k < 600; ++k) (void)servo.tick({0.2, -0.005, 0}, {0, 0, 0}, 1e-3);
  CHECK(felt.status == LoopStatus::touching);
  CHECK(felt.failed_ticks == 0);
  // The coupling's damper has stopped it, and both have the mesh of 8 elements.
  CHECK(std::abs(felt.force.y() - servo.record().force.y()) <= 1e-3 * servo.record().force.y());
  CHECK(std::abs(felt.avatar.y() - servo.record().avatar.y()) <= 1e-5);
}

TEST_CASE("what is let go in the loop swings on, gives nothing that it has not got, and reset stops it",
          "[dynamics]") {
  Loop loop;
  const double rest = loop.model.energy().sum();
  loop.hold(0.25, 0.01, 300);
  loop.move(0.25, 0.01, 0.25, -0.01, 300);
  loop.hold(0.25, -0.01, 200);
  const double stored = loop.model.energy().sum() - rest;
  CHECK(stored > 1e-3);
  loop.hold(0.25, 0.05, 1);
  double highest = -1, lowest = 1;
  for (int k = 0; k < 200; ++k) {
    const ServoRecord& record = loop.hold(0.25, 0.05, 1);
    CHECK(record.status == LoopStatus::free);
    CHECK(loop.force.isZero(0));
    highest = std::max(highest, loop.tip()), lowest = std::min(lowest, loop.tip());
  }
  CHECK(highest > 0.01);
  CHECK(lowest < -0.01);
  const double left = loop.model.energy().sum() - rest;
  CHECK(left <= stored);
  CHECK(left > 0.9 * stored);
  // The hand comes down on it and is thrown back: it takes what the beam has, which the loop has not generated.
  for (int k = 0; k < 400; ++k) loop.hold(0.25, std::max(0.012, 0.05 - 4e-4 * k) + 4e-4 * (k % 8), 1);
  CHECK(loop.servo.record().touches >= 2);
  CHECK(loop.servo.record().energy_generated <= 1e-9);
  loop.servo.reset();
  CHECK(loop.model.energy().sum() == rest);
  CHECK(loop.model.velocity(0.3).isZero(0));
  CHECK(loop.hold(0.25, 0.05, 10).status == LoopStatus::free);
  CHECK(std::abs(loop.tip()) < 1e-12);
}

TEST_CASE("a late tick of a beam with mass goes on by 2 ms", "[dynamics]") {
  Loop late, even;
  for (Loop* loop : {&late, &even}) {
    loop->hold(0.25, 0.01, 300);
    loop->move(0.25, 0.01, 0.25, -0.01, 300);
    loop->hold(0.25, 0.05, 1);
  }
  late.hold(0.25, 0.05, 5, 0.009);
  even.hold(0.25, 0.05, 5, 0.002);
  CHECK(late.tip() == even.tip());
  CHECK(std::abs(late.tip()) > 1e-3);
}

TEST_CASE("a fast hand does not pass a beam with mass, and one that has gone round its end is behind it",
          "[dynamics]") {
  Loop loop;
  loop.hold(0.25, 0.01, 300);
  const ServoRecord& felt = loop.hold(0.25, -0.02, 1);
  CHECK(felt.pressing);
  CHECK(loop.force.y() > 0);

  // Off the tip, while it is pressed: from there on it is free.
  Loop end;
  end.hold(0.29, 0.01, 300);
  end.move(0.29, 0.01, 0.29, -0.005, 200);
  REQUIRE(end.servo.record().pressing);
  end.move(0.29, -0.005, 0.32, -0.005, 100);
  CHECK(end.servo.record().status == LoopStatus::free);
  CHECK(end.servo.record().failed_ticks == 0);
  // A hand that is beyond the centreline of a bar goes off its end.
  Loop bar(4, ruler(0.01));
  bar.hold(0.29, 0.02, 300);
  bar.move(0.29, 0.02, 0.29, -0.002, 200);
  REQUIRE(bar.servo.record().pressing);
  bar.move(0.29, -0.002, 0.33, -0.002, 100);
  CHECK(bar.servo.record().status == LoopStatus::free);
  // Around it, and up from below.
  end.move(0.32, -0.005, 0.32, -0.06, 100);
  end.move(0.32, -0.06, 0.2, -0.06, 100);
  CHECK(end.servo.record().status == LoopStatus::free);
  end.move(0.2, -0.06, 0.2, 0.01, 100);
  double down = 0;
  for (int k = 0; k < 100; ++k) {
    end.hold(0.2, 0.01, 1);
    CHECK(end.force.y() <= 0);
    down = std::min(down, end.force.y());
  }
  CHECK(down < -1);
}

TEST_CASE("a step of a beam with mass that fails is told, and its force comes in slowly again",
          "[dynamics]") {
  Loop loop(1);
  loop.hold(0.25, 0.01, 300);
  Random random(5);
  int failed = 0, moved = 0;
  bool moves = false;
  for (int k = 0; k < 2000 && failed < 10; ++k) {
    const ServoRecord& record = loop.hold(random(-0.1, 0.5), random(0.3), 1);
    REQUIRE(loop.force.allFinite());
    REQUIRE(loop.force.norm() <= loop.info.peak_force * (1 + 1e-12));
    if (record.status != LoopStatus::no_answer) {
      moves = loop.model.velocity(0.3).norm() > 1e-3;
      continue;
    }
    moved += moves;
    ++failed;
    CHECK(record.model == Status::iteration_limit);
    CHECK(loop.force.isZero(0));
    CHECK(loop.model.velocity(0.3).isZero(0));
    // A period in 0.2 s of what is allowed, each.
    for (int n = 1; n <= 5; ++n) {
      loop.hold(0.2, -0.03, 1);
      CHECK(loop.force.norm() <= loop.info.peak_force * n / 200 * (1 + 1e-12));
    }
  }
  CHECK(moved > 0);
}
