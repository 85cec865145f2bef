// Force and torque together: what the guard lets through, and what the monitor counts.
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>
#include <hapbeam/haptics/stability/energy_monitor.hpp>
#include <hapbeam/haptics/stability/force_guard.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

DeviceInfo six_axes() {
  VirtualPhantomOptions options;
  options.gimbal.present = true;
  return VirtualPhantom<>(HandPath({0, 0}), options).info();
}
Eigen::Vector3d any(Random& random, double size) { return {random(size), random(size), random(size)}; }

}  // namespace

TEST_CASE("whatever is wanted, force and torque are finite, limited and slewed, each by its own",
          "[guard][torque]") {
  const DeviceInfo device = six_axes();
  const ForceGuardOptions options = ForceGuard::for_device(device);
  ForceGuard guard(options);
  Random random(4);
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                        1e308};
  Wrench last;
  double time = 0, hottest = 0;
  for (int i = 0; i < 200000; ++i) {
    Wrench wanted{any(random, std::pow(10, random(-3, 3))), any(random, std::pow(10, random(-4, 2)))};
    if (random(0, 1) < 0.01) wanted.force[random.integer(0, 2)] = bad[random.integer(0, 2)];
    if (random(0, 1) < 0.01) wanted.torque[random.integer(0, 2)] = bad[random.integer(0, 2)];
    time += random(0, 1) < 0.01 ? random(-1, 0) : 1e-3;  // a clock that runs backwards
    const bool safe = random(0, 1) > 0.002;
    const GuardedForce sent = guard.limit(wanted, time, safe);
    REQUIRE(sent.force.norm() <= device.peak_force * (1 + 1e-12));
    REQUIRE(sent.torque.norm() <= device.gimbal.peak_torque * (1 + 1e-12));
    // No farther from the way between the last one and zero than two periods allow.
    REQUIRE(sent.torque.norm() <= last.torque.norm() + options.torque_slew_rate * 2e-3 * (1 + 1e-9));
    REQUIRE(sent.force.norm() <= last.force.norm() + options.slew_rate * 2e-3 * (1 + 1e-9));
    if (!safe || !wanted.force.allFinite() || !wanted.torque.allFinite())
      REQUIRE((sent.force.isZero(0) && sent.torque.isZero(0)));
    last = {sent.force, sent.torque};
    hottest = std::max(hottest, guard.heat());
  }
  CHECK(hottest <= 1 + 1e-9);
}

TEST_CASE("torque that lasts falls to what its motors bear, while the force stays", "[guard][torque]") {
  const DeviceInfo device = six_axes();
  ForceGuard guard(ForceGuard::for_device(device));
  const Wrench wanted{{0, 2, 0}, {0, 0, 1}};
  GuardedForce sent{};
  for (int i = 1; i <= 100000; ++i) sent = guard.limit(wanted, 1e-3 * i, true);
  CHECK(sent.torque.norm() == Approx(device.gimbal.continuous_torque).epsilon(1e-2));
  CHECK(sent.force == wanted.force);
}

TEST_CASE("a force alone is guarded as it was, and a wrench without a torque is that force",
          "[guard][torque]") {
  DeviceInfo three = six_axes();
  three.gimbal = {};
  ForceGuard alone(ForceGuard::for_device(three)), both(ForceGuard::for_device(three)),
      six(ForceGuard::for_device(six_axes()));
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d force = any(random, 60), torque = any(random, 1);
    const double time = 1e-3 * i;
    const GuardedForce a = alone.limit(force, time, true), b = six.limit(force, time, true);
    const GuardedForce c = both.limit(Wrench{force, torque}, time, true);
    REQUIRE(a.force == b.force);
    REQUIRE(a.force == c.force);
    REQUIRE(a.limited == c.limited);
    REQUIRE(c.torque.isZero(0));  // the device renders none
  }
  ForceGuardOptions bad = ForceGuard::for_device(six_axes());
  bad.continuous_torque = 1;
  CHECK_THROWS_WITH(ForceGuard(bad), ContainsSubstring("continuous_torque = 1 N"));
  bad = ForceGuard::for_device(six_axes());
  bad.torque_slew_rate = 0;
  CHECK_THROWS_WITH(ForceGuard(bad), ContainsSubstring("torque_slew_rate"));
}

TEST_CASE("the monitor counts the work of torque: a spring that turns gives back what it took",
          "[energy][torque]") {
  // A conservative torque -k q about one axis, sampled: its account closes as the path does, to the sampling.
  DeviceInfo device = six_axes();
  device.gimbal.damping = device.gimbal.friction = 0, device.gimbal.peak_torque = 1;
  device.damping = device.friction = 0;
  Random random(6);
  for (const double sign : {1.0, -1.0}) {
    EnergyMonitor monitor(device);
    const double k = 0.4, amplitude = 2;
    double work = 0, before = 0, torque = 0;
    for (int i = 0; i <= 2000; ++i) {
      const double q = amplitude * std::sin(2 * 3.141592653589793 * i / 2000);
      work += torque * (q - before), before = q;
      monitor.observe({0, 0, 0}, gimbal_orientation({0, 0, q}), {{0, 0, 0}, {0, 0, torque}}, 1e-3);
      // Held over the period: midway between here and there for the sum to be exact.
      torque = -k * (q + amplitude * std::sin(2 * 3.141592653589793 * (i + 1) / 2000)) / 2 * sign;
      CHECK(std::abs(monitor.net() - work) <= 1e-12);
    }
    CHECK(std::abs(monitor.net()) <= 1e-9);
  }
  // One that pushes along generates what it gives.
  EnergyMonitor monitor(device);
  monitor.observe({0, 0, 0}, gimbal_orientation({0, 0, 0}), {{0, 0, 0}, {0, 0, 0}}, 1e-3);
  monitor.observe({0, 0, 0}, gimbal_orientation({0.2, 0, 0}), {{0, 0, 0}, {0, 0.1, 0}}, 1e-3);
  CHECK(monitor.generated() == Approx(0.02));
  // A reading that is no number is no way.
  Eigen::Matrix3d bad = Eigen::Matrix3d::Identity();
  bad(1, 2) = std::numeric_limits<double>::quiet_NaN();
  monitor.observe({0, 0, 0}, bad, {{0, 0, 0}, {0, 0.1, 0}}, 1e-3);
  CHECK(monitor.generated() == Approx(0.02));
}

TEST_CASE("couplings that turn take no more of the damping than those that do not", "[coupling][torque]") {
  Random random(8);
  for (int i = 0; i < 300; ++i) {
    DeviceInfo device = six_axes();
    device.damping = random(0.5, 10), device.gimbal.damping = random(2e-4, 1e-2);
    device.period = random(2e-4, 2e-3);
    const int delay = random.integer(0, 4);
    const CouplingFigures turning = safe_turning_coupling(device, delay);
    const double late = device.period * (0.5 + delay);
    CHECK(turning.stiffness * late + turning.damping <= 0.75 * device.gimbal.damping * (1 + 1e-12));
    CHECK(turning.stiffness <= device.gimbal.friction / device.gimbal.resolution * (1 + 1e-12));
    // In series at any lever, what both take of b and b_r is at most the larger share.
    const CouplingFigures straight = safe_coupling(device, delay);
    const double lever = random(0, 0.3), given = 1 / device.damping + lever * lever / device.gimbal.damping;
    const double k = 1 / (1 / straight.stiffness + lever * lever / turning.stiffness);
    CHECK(k * late * given <= 0.4 * (1 + 1e-12));
  }
  DeviceInfo unknown = six_axes();
  unknown.gimbal.damping = 0, unknown.gimbal.friction = 0;
  CHECK(safe_turning_coupling(unknown).stiffness == Approx(0.4 * 0.5 * 9e-4 / 5e-4));
  unknown.gimbal.max_stiffness = 0.1;
  CHECK(safe_turning_coupling(unknown).stiffness == 0.1);
  unknown.gimbal.damping = -1;
  CHECK_THROWS_WITH(safe_turning_coupling(unknown), ContainsSubstring("gimbal damping = -1"));
  DeviceInfo three = six_axes();
  three.gimbal.peak_torque = 0;
  CHECK(VirtualCoupling::for_device(three).turning().stiffness == 0);
}
