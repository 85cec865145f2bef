// The monitor against closed forms: a sampled spring generates what Colgate and Schenkel say, to the joule.
#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/haptics/stability/energy_monitor.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

using Vector = Eigen::Vector3d;

constexpr double period = 1e-3;  // [s]

DeviceInfo device(double damping, double friction = 0, double resolution = 0) {
  DeviceInfo info{};
  info.peak_force = info.continuous_force = 1e4, info.max_stiffness = 1e4;
  info.period = period;
  info.damping = damping;
  info.friction = friction;
  info.position_resolution = resolution;
  return info;
}

/// N steps into a spring and N out of it, its force held over the period and late by `delay` more.
double through_a_spring(const DeviceInfo& info, double stiffness, double step, int steps, int delay) {
  EnergyMonitor monitor(info, delay);
  int depth = 0;
  monitor.observe(Vector::Zero(), Vector::Zero(), period);
  for (int tick = 0; tick < 2 * steps + delay + 2; ++tick) {
    const double force = stiffness * step * depth;
    depth += tick < steps ? 1 : tick < 2 * steps ? -1 : 0;
    monitor.observe(Vector(0, -step * depth, 0), Vector(0, force, 0), period);
  }
  CHECK(monitor.net() == 0);  // the contact has ended
  return monitor.generated();
}

}  // namespace

// In, the force held is that of the step before, out it is more than it should be: K δ² N in all; n periods later
// K δ² N (2n + 1), less the corner of n (n + 1).  Damping takes b δ²/T in each of the periods under force.
TEST_CASE("a sampled spring generates energy just where K T (1/2 + n) > b", "[energy]") {
  const double K = 1000, T = 1e-3, step = 1e-4;
  const int N = 1000;
  CHECK(through_a_spring(device(0), K, step, N, 0) == Approx(K * step * step * N).epsilon(1e-12));
  for (const int delay : {0, 1, 2, 3}) {
    const double border = K * T * (0.5 + delay);
    // The corner, and the periods in which the arm stands, are less than 2n in N.
    CHECK(through_a_spring(device(border * 1.01), K, step, N, delay) == 0);
    CHECK(through_a_spring(device(border * 0.98), K, step, N, delay) > 0);
    CHECK(through_a_spring(device(border / 2), K, step, N, delay) ==
          Approx(K * step * step * N * (0.5 + delay)).epsilon(0.01));
  }
}

TEST_CASE("friction takes f |Δx|, and both count only what was surely travelled", "[energy]") {
  const double K = 1000, step = 1e-4;
  const int N = 100;
  // A step of the grid is not known to have been travelled: what is left of the way is half of it.
  const auto generated = [&](double friction, double resolution) {
    return through_a_spring(device(0, friction, resolution), K, step, N, 0);
  };
  const double spring = K * step * step * N;
  // Under force for 2 N - 1 periods: the first into the wall has none.
  CHECK(generated(1e-3, 0) == Approx(spring - 1e-3 * step * (2 * N - 1)).epsilon(1e-9));
  CHECK(generated(1e-3, step / 2) == Approx(spring - 1e-3 * step / 2 * (2 * N - 1)).epsilon(1e-9));
  CHECK(generated(1e-3, step) == Approx(spring).epsilon(1e-9));
}

TEST_CASE("each contact is judged by itself: what one took the next has not earned", "[energy]") {
  EnergyMonitor monitor(device(0));
  const auto move = [&](double force, double to) {
    monitor.observe(Vector(0, to, 0), Vector(0, force, 0), period);
  };
  move(0, 0);
  move(2, -0.01);  // takes 20 mJ
  CHECK(monitor.net() == Approx(-0.02));
  CHECK(monitor.generated() == 0);
  move(0, -0.01);
  CHECK(monitor.net() == 0);
  move(3, -0.005);  // gives 15 mJ
  CHECK(monitor.generated() == Approx(0.015));
  move(0, 0);
  move(1, 0.002);
  CHECK(monitor.generated() == Approx(0.017));
  monitor.reset();
  CHECK(monitor.generated() == Approx(0.015));  // an unfinished contact is not judged
  move(5, 1);                                   // nor is the way to where it begins anew
  CHECK(monitor.net() == 0);
}

TEST_CASE("the controller brakes while energy is owed, never pushes, and no more than the arm's own damping",
          "[energy]") {
  Random random(3);
  EnergyMonitor monitor(device(5));
  const Vector v(0.1, -0.2, 0.3);
  CHECK(monitor.dissipation(v).isZero(0));
  monitor.observe(Vector::Zero(), Vector::Zero(), period);
  monitor.observe(Vector(0, 1e-6, 0), Vector(0, 10, 0), period);
  REQUIRE(monitor.net() > 0);
  for (int i = 0; i < 10000; ++i) {
    const Vector velocity = Vector(random(1), random(1), random(1)) * std::pow(10, random(-6, 2));
    const Vector brake = monitor.dissipation(velocity);
    REQUIRE(brake.dot(velocity) <= 0);
    REQUIRE(brake.norm() <= 5 * velocity.norm() * (1 + 1e-12));
    // Within a period at this speed: what is owed, or less.
    REQUIRE(-brake.dot(velocity) * 1e-3 <= monitor.net() * (1 + 1e-12));
  }
  CHECK(-monitor.dissipation(v).dot(v) * 1e-3 == Approx(std::min(monitor.net(), 5 * v.squaredNorm() * 1e-3)));
  CHECK(monitor.dissipation(Vector(NAN, 0, 0)).isZero(0));
  CHECK(monitor.dissipation(Vector::Zero()).isZero(0));
}

TEST_CASE("readings and forces that are no numbers leave the account as it is", "[energy]") {
  EnergyMonitor monitor(device(5));
  monitor.observe(Vector::Zero(), Vector::Zero(), period);
  monitor.observe(Vector(0, 1e-3, 0), Vector(0, 10, 0), period);
  const double net = monitor.net();
  monitor.observe(Vector(0, NAN, 0), Vector(0, 10, 0), period);
  monitor.observe(Vector(0, 1e-3, 0), Vector(0, INFINITY, 0), period);
  CHECK(std::isfinite(monitor.net()));
  CHECK(monitor.net() == net);
}

TEST_CASE("a monitor of a device that cannot be is refused", "[energy]") {
  CHECK_THROWS_WITH(EnergyMonitor(device(NAN)), ContainsSubstring("device damping = nan N·s/m"));
  CHECK_THROWS_WITH(EnergyMonitor(device(5), 17), ContainsSubstring("delay_ticks = 17: must be 0 to 16"));
  CHECK_THROWS_WITH(EnergyMonitor(device(5), -1), ContainsSubstring("delay_ticks"));
}

TEST_CASE("positions and forces that no device has leave the account finite and as it was", "[energy]") {
  EnergyMonitor monitor(device(5));
  monitor.observe(Vector::Zero(), Vector::Zero(), period);
  monitor.observe(Vector(0, 1e-3, 0), Vector(0, 10, 0), period);
  const double net = monitor.net();
  for (const double garbage : {1e300, -1e300, 1e160, 20.0}) {
    monitor.observe(Vector(0, garbage, 0), Vector(0, 10, 0), period);
    monitor.observe(Vector(0, 1e-3, 0), Vector(0, 10, 0), period);
    CHECK(monitor.net() == net);
  }
  for (int i = 0; i < 1000; ++i) monitor.observe(Vector(0, i % 2 * 5.0, 0), Vector(0, 1.7e308, 0), period);
  monitor.observe(Vector::Zero(), Vector::Zero(), period);
  CHECK(std::isfinite(monitor.generated()));
}

// W - ∫U de = -e U for a force -e dU/dx: what the rising share lends is all that comes back.
TEST_CASE("a spring whose force comes in while it is pressed has lent its energy and generated none",
          "[energy]") {
  const double K = 1000, depth = 0.02;
  const int ticks = 20000;
  for (const bool counted : {false, true}) {
    EnergyMonitor monitor(device(0));
    double force = 0, share = 0;
    for (int i = 0; i <= 2 * ticks; ++i) {
      const double x = depth * std::min(i, 2 * ticks - i) / ticks;
      monitor.observe(Vector(0, -x, 0), Vector(0, force, 0), period);
      const double before = share;
      share = std::min(1.0, i / (0.7 * ticks));
      force = share * K * x;
      if (counted) monitor.lend((share - before) * K * x * x / 2);
    }
    // ∫U de = K depth²/6 · 0.7² of the way; what is left is the sampling's, K δ² N.
    const double lent = K * depth * depth / 6 * 0.7 * 0.7, held = K * depth * depth / ticks;
    if (counted) CHECK(monitor.generated() <= 2 * held);
    else CHECK(monitor.generated() == Approx(lent).epsilon(0.01));
  }
  EnergyMonitor monitor(device(0));
  monitor.lend(-1);
  CHECK(monitor.net() == 0);
}
