// What the guard promises, for any input: properties over random and adversarial sequences, and its closed forms.
#include <cmath>
#include <cstdlib>
#include <limits>

#include "support/catch.hpp"
#include "support/engagement.hpp"
#include "support/random.hpp"
#include <hapbeam/haptics/stability/force_guard.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

using Vector = Eigen::Vector3d;

constexpr double T = 1e-3, eps = std::numeric_limits<double>::epsilon();

ForceGuardOptions options() {
  ForceGuardOptions o{37.5, 6.2, T};
  o.engage_time = 0;
  return o;
}

/// |F| of the nearest point to F on the way from `last` to zero.
double beyond(const Vector& force, const Vector& last) {
  const double size = last.squaredNorm();
  const double along = size > 0 ? std::clamp(force.dot(last) / size, 0.0, 1.0) : 0;
  return (force - along * last).norm();
}

double wild(Random& random) {
  switch (random.integer(0, 9)) {
    case 0: return std::numeric_limits<double>::quiet_NaN();
    case 1: return std::numeric_limits<double>::infinity();
    case 2: return -std::numeric_limits<double>::infinity();
    case 3: return std::numeric_limits<double>::max();
    case 4: return 0;
    case 5: return std::numeric_limits<double>::denorm_min();
    default: return random(std::pow(10, random(-3, 9)));
  }
}

/// How many inputs: 1e6, or what HAPBEAM_GUARD_INPUTS says.
long inputs() {
  const char* text = std::getenv("HAPBEAM_GUARD_INPUTS");
  return text ? std::atol(text) : 1000000;
}

}  // namespace

TEST_CASE("whatever comes in: finite, within the peak, no faster than the slew rate, zero on failure",
          "[guard]") {
  Random random(1);
  const long all = inputs();
  for (long done = 0; done < all;) {
    ForceGuardOptions o = options();
    o.engage_time = random(0, 1) < 0.5 ? 0 : random(0, 0.1);
    o.thermal_time = std::pow(10, random(-4, 2));
    o.slew_rate = std::pow(10, random(1, 6));
    o.longest_pause = random(0, 0.2);
    ForceGuard guard(o);
    double time = 0;
    const bool tame = random(0, 1) < 0.3;
    for (int tick = 0; tick < 1000 && done < all; ++tick, ++done) {
      Vector wanted(random(60), random(60), random(60));
      if (!tame && random(0, 1) < 0.2)
        for (int i = 0; i < 3; ++i) wanted[i] = wild(random);
      const double before = time;
      time += T;
      if (!tame) {
        if (random(0, 1) < 0.1) time = before;                      // stands
        if (random(0, 1) < 0.1) time = before - random(0, 1);       // runs backwards
        if (random(0, 1) < 0.1) time = before + random(0, 10 * T);  // late
        if (random(0, 1) < 0.02) time = before + random(0, 1e3);
      }
      const double told = !tame && random(0, 1) < 0.05 ? wild(random) : time;
      const bool safe = tame || random(0, 1) < 0.97;
      const Vector last = guard.force();
      const GuardedForce out = guard.limit(wanted, told, safe);
      time = std::isfinite(told) ? told : before;
      REQUIRE(out.force.allFinite());
      REQUIRE(out.force == guard.force());
      REQUIRE(out.force.norm() <= 37.5 * (1 + 4 * eps));
      REQUIRE(beyond(out.force, last) <= o.slew_rate * 2 * T + 37.5 * 16 * eps);
      if (!safe || !wanted.allFinite()) REQUIRE(out.force.isZero(0));
      // A clock that does not go on lets nothing grow.
      if (!(told > before)) REQUIRE(out.force.norm() <= last.norm() * (1 + 4 * eps));
      REQUIRE(std::isfinite(guard.heat()));
      if (tame) REQUIRE(guard.heat() <= 1 + 1e-12);
      // It adds nothing: no longer than what was wanted, unless the slew rate keeps it on the way there.
      if (wanted.allFinite())
        REQUIRE(out.force.norm() <= std::max(wanted.norm(), last.norm()) * (1 + 8 * eps));
    }
  }
}

TEST_CASE("what is within all limits passes to the bit", "[guard]") {
  ForceGuard guard(options());
  double time = 0;
  for (int tick = 0; tick < 5000; ++tick) {
    const Vector wanted(std::sin(0.1 * tick), 2 * std::cos(0.03 * tick), 0.5);
    const GuardedForce out = guard.limit(wanted, time += T, true);
    REQUIRE(out.force == wanted);
    REQUIRE_FALSE(out.limited);
    REQUIRE_FALSE(out.engaging);
  }
}

TEST_CASE("a demand for more than the continuous force is met, fades, and ends at the continuous force",
          "[guard]") {
  for (const double demand : {8.0, 15.0, 37.5, 1e9}) {
    ForceGuard guard(options());
    double time = 0, sum = 0, last = 1e9;
    int rising = 0;
    for (int tick = 0; tick < 200000; ++tick) {
      const double force = guard.limit(Vector(0, demand, 0), time += T, true).force.norm();
      sum += force * force * T;
      REQUIRE(guard.heat() <= 1 + 1e-12);
      if (tick > 10) rising += force > last * (1 + 1e-12);
      if (tick == 10) CHECK(force == Approx(std::min(demand, 37.5)));
      last = force;
    }
    CHECK(rising == 0);
    CHECK(last == Approx(6.2).epsilon(1e-3));
    // q' = (F²/Fc² - q)/τ from 0 to at most 1: the heat let in over the time t is at most Fc² (t + τ).
    CHECK(sum <= 6.2 * 6.2 * (time + options().thermal_time) * (1 + 1e-9));
    // And it recovers: e-fold in τ.
    const double warm = guard.heat();
    for (int tick = 0; tick < 10000; ++tick) guard.limit(Vector::Zero(), time += T, true);
    CHECK(guard.heat() == Approx(warm * std::exp(-1.0)).epsilon(1e-3));
  }
}

TEST_CASE("a clock that stands does not cool the motors: the force fades as if each tick were a period",
          "[guard]") {
  ForceGuard standing(options());
  double time = 0;
  for (int tick = 0; tick < 10; ++tick) (void)standing.limit(Vector(0, 20, 0), time += T, true);
  for (int tick = 0; tick < 20000; ++tick) {
    (void)standing.limit(Vector(0, 20, 0), time, true);
    REQUIRE(standing.heat() <= 1 + 1e-12);
  }
  CHECK(standing.heat() > 0.9);
  CHECK(standing.force().norm() < 0.6 * 20);
}

TEST_CASE("up to the continuous force nothing is ever taken away", "[guard]") {
  ForceGuard guard(options());
  double time = 0;
  for (int tick = 0; tick < 200000; ++tick)
    REQUIRE(guard.limit(Vector(0, 6.2, 0), time += T, true).force.y() == 6.2);
}

TEST_CASE("after start, failure, reset and pause the force comes in linearly", "[guard]") {
  ForceGuardOptions o = options();
  o.engage_time = 0.2;
  ForceGuard guard(o);
  double time = 0;
  const Vector wanted(0, 5, 0);
  const auto ramp = [&] {
    for (int tick = 1; tick <= 300; ++tick) {
      const GuardedForce out = guard.limit(wanted, time += T, true);
      REQUIRE(out.force.y() == Approx(5 * std::min(1.0, tick * T / 0.2)).margin(1e-9));
      if (std::abs(tick * T / 0.2 - 1) > 1e-9) REQUIRE(out.engaging == (tick * T < 0.2));
    }
  };
  ramp();
  CHECK(guard.limit(wanted, time += T, false).force.isZero(0));
  ramp();
  CHECK(guard.limit(Vector(0, std::nan(""), 0), time += T, true).force.isZero(0));
  ramp();
  guard.reset();
  ramp();
  time += o.longest_pause;  // and a period
  ramp();
  time = -7;  // a clock that begins anew
  CHECK(guard.limit(wanted, time, true).force.isZero(0));
  ramp();
}

// Whatever is wanted, more than the peak too; engaged is a share of what may be sent.
TEST_CASE("n ticks after a start, failure, reset or pause at most n T / 0.2 s of what may be sent",
          "[guard][pause]") {
  Random random(40);
  const DeviceInfo device{"", {0.4, 0.3, 0.2}, 37.5, 6.2, 3500, 7e-6, 0.2, T, 5, 0.2, {true, 0.2, 0.1}};
  const long all = inputs();
  long wrong = 0, soft = 0;
  for (long done = 0; done < all;) {
    ForceGuard guard(ForceGuard::for_device(device));
    Engagement engagement(device);
    double time = random.integer(0, 1) ? 0 : random(1e6), begun = 0;
    bool honest = false;  // the clock has only gone on since the force began to come in
    const Wrench wanted{random.integer(0, 3) ? Vector(0, 30, 0) : Vector(1e9, 0, 0),
                        random.integer(0, 3) ? Vector(0, 0.1, 0) : Vector(0, 0, 1e300)};
    const double most = std::min(wanted.force.norm(), device.peak_force);
    for (int tick = 0; tick < 1000 && done < all; ++tick, ++done) {
      bool safe = true, begins = tick == 0;
      time += random(0.7, 1.3) * T;
      switch (random.integer(0, 700)) {
        case 0: safe = false; break;
        case 1: guard.reset(), begins = true; break;
        case 2: time += random(0.1, 0.3), begins = true; break;
        case 3: time += std::pow(10, random(-0.9, 6)), begins = true; break;
        case 4: time -= random(0.11, 1e6), begins = true; break;
        case 5: time += random(0, 0.09); break;
        case 6: time -= random(0, 0.05), honest = false; break;
        case 7: safe = false, time += random(0, 1); break;
        default: break;
      }
      if (begins) engagement.begins(), begun = time, honest = true;
      const GuardedForce sent = guard.limit(wanted, time, safe);
      wrong += !engagement.allows({sent.force, sent.torque});
      wrong += honest && sent.force.norm() > (time - begun + T) / 0.2 * most * (1 + 1e-9);
      wrong += !safe && !(sent.force.isZero(0) && sent.torque.isZero(0));
      soft += sent.engaging;
      if (!safe) engagement.begins(), honest = false;
    }
  }
  CHECK(wrong == 0);
  CHECK(soft > all / 10);
  CHECK(soft < all);
}

TEST_CASE("what a pause leaves is told: all that came in, in the tick in which it does", "[guard][pause]") {
  ForceGuardOptions o = options();
  o.engage_time = 0.2;
  ForceGuard guard(o);
  double time = 0;
  const auto tick = [&](double dt, bool safe = true) {
    (void)guard.limit(Vector(0, 5, 0), time += dt, safe);
    return guard.came_in();
  };
  double sum = 0;
  for (int i = 0; i < 300; ++i) sum += tick(T);
  CHECK(sum == Approx(1));
  for (const double pause : {0.11, 1.0, 100.0}) {
    sum = tick(pause);
    CHECK(sum == Approx(T / 0.2));
    for (int i = 0; i < 300; ++i) sum += tick(T);
    CHECK(sum == Approx(1));
  }
  CHECK(tick(T, false) == 0);
  CHECK(tick(T) == Approx(T / 0.2));
}

// The motors hold the last force through it.
TEST_CASE("a pause under force heats the motors", "[guard][pause]") {
  ForceGuard guard(options());
  double time = 0;
  for (int i = 0; i < 10; ++i) (void)guard.limit(Vector(0, 6.2, 0), time += T, true);
  (void)guard.limit(Vector(0, 6.2, 0), time += 10, true);
  CHECK(guard.heat() == Approx(1 - std::exp(-1.0)).epsilon(1e-2));
}

TEST_CASE("a loop whose ticks are farther apart than the longest pause has a force", "[guard][pause]") {
  ForceGuardOptions o = options();
  o.period = 0.15, o.engage_time = 0.6;
  ForceGuard guard(o);
  for (int n = 1; n <= 8; ++n) {
    (void)guard.limit(Vector(0, 4, 0), 1000 + 0.15 * n, true);
    CHECK(guard.force().y() == Approx(std::min(n / 4.0, 1.0) * 4));
  }
}

TEST_CASE("to fall it may at once, to rise by the slew rate, along a turn by both", "[guard]") {
  ForceGuardOptions o = options();
  o.slew_rate = 1000;
  ForceGuard guard(o);
  double time = 0;
  for (int tick = 1; tick <= 5; ++tick) {
    const GuardedForce out = guard.limit(Vector(5, 0, 0), time += T, true);
    CHECK(out.force.x() == Approx(tick));
    CHECK(out.limited == (tick < 5));
  }
  CHECK((guard.limit(Vector(2, 0, 0), time += T, true).force == Vector(2, 0, 0)));
  CHECK((guard.limit(Vector(2, 4, 0), time += T, true).force - Vector(2, 1, 0)).norm() <= 1e-12);
  CHECK((guard.limit(Vector(-5, -2.5, 0), time += T, true).force - Vector(-2, -1, 0) / std::sqrt(5)).norm() <=
        1e-12);
}

TEST_CASE("the limits are the device's own, one that was told to be weaker included", "[guard]") {
  DeviceInfo device{};
  device.peak_force = 37.5, device.continuous_force = 6.2, device.max_stiffness = 3500, device.period = T;
  CHECK(ForceGuard::for_device(device).peak_force == 37.5);
  CHECK(ForceGuard::for_device(device).continuous_force == 6.2);
  device.peak_force = 1;
  CHECK(ForceGuard::for_device(device).continuous_force == 1);
  ForceGuard guard(ForceGuard::for_device(device));
  double time = 0;
  for (int tick = 0; tick < 1000; ++tick) (void)guard.limit(Vector(0, 5, 0), time += T, true);
  CHECK(guard.force().norm() == Approx(1));
}

TEST_CASE("a guard that cannot guard is refused by name, value and unit", "[guard]") {
  const auto with = [](auto change) {
    ForceGuardOptions o = options();
    change(o);
    return [o] { ForceGuard guard(o); };
  };
  CHECK_THROWS_WITH(with([](auto& o) { o.peak_force = 0; })(), ContainsSubstring("peak_force = 0 N"));
  CHECK_THROWS_WITH(with([](auto& o) { o.continuous_force = 40; })(), ContainsSubstring("at most the peak"));
  CHECK_THROWS_WITH(with([](auto& o) { o.continuous_force = 0; })(),
                    ContainsSubstring("continuous_force = 0 N"));
  CHECK_THROWS_WITH(with([](auto& o) { o.period = -1; })(), ContainsSubstring("period = -1 s"));
  CHECK_THROWS_WITH(with([](auto& o) { o.slew_rate = 0; })(), ContainsSubstring("slew_rate = 0 N/s"));
  CHECK_THROWS_WITH(with([](auto& o) { o.thermal_time = 0; })(), ContainsSubstring("thermal_time = 0 s"));
  CHECK_THROWS_WITH(with([](auto& o) { o.engage_time = -1; })(), ContainsSubstring("engage_time = -1 s"));
  CHECK_THROWS_WITH(with([](auto& o) { o.longest_pause = std::nan(""); })(),
                    ContainsSubstring("longest_pause = nan s"));
}
