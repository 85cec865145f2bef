// The laws of one axis of the arm against closed forms: ringing, friction, energy, and independence of the
// step.
#include <random>

#include "support/catch.hpp"
#include <hapbeam/haptics/device/arm_axis.hpp>

using namespace hapbeam;

namespace {

using Drive = ArmAxis::Drive;

constexpr double eps = 2.220446049250313e-16;

Drive constant(double force) { return {{force, 0, 0, 0}}; }

}  // namespace

TEST_CASE("without friction mass, spring and damper ring as the closed form says", "[arm]") {
  const double m = 0.41, k = 500, x0 = 0.01;
  for (const double b : {0.0, 1.3, 6.3, 28.0}) {  // critical: 28.6 N·s/m
    ArmAxis axis({m, b, k, 0});
    axis.place(x0);
    const double decay = b / (2 * m), omega = std::sqrt(k / m - decay * decay);
    for (int tick = 1; tick <= 2000; ++tick) {
      axis.advance(constant(0), 1e-3);
      const double t = tick * 1e-3, envelope = x0 * std::exp(-decay * t);
      REQUIRE(std::abs(axis.position() -
                       envelope * (std::cos(omega * t) + decay / omega * std::sin(omega * t))) <=
              tick * x0 * 8 * eps);
      REQUIRE(std::abs(axis.velocity() + envelope * k / (m * omega) * std::sin(omega * t)) <=
              tick * x0 * 200 * eps);
    }
  }
}

TEST_CASE("an overdamped arm is summed in pieces, and as exact", "[arm]") {
  const double m = 0.05, b = 400, v_end = 1.5 / 400;  // time constant 0.125 ms, eight within a period
  ArmAxis axis({m, b, 0, 0});
  CHECK(axis.longest_piece() < 1e-3);
  axis.advance(constant(1.5), 1e-3);
  const double decay = std::exp(-b / m * 1e-3);
  CHECK(axis.velocity() == Approx(v_end * (1 - decay)).epsilon(1e-14));
  CHECK(axis.position() == Approx(v_end * (1e-3 - m / b * (1 - decay))).epsilon(1e-13));

  ArmAxis pulled({m, b, 0, 0});  // by a force that grows at 2000 N/s
  pulled.advance({{0, 2000, 0, 0}}, 1e-3);
  CHECK(pulled.velocity() == Approx(2000 / b * (1e-3 - m / b * (1 - decay))).epsilon(1e-13));
}

TEST_CASE("the drive is hand and force on the cubic between two targets", "[arm]") {
  const ArmAxis axis({0.4, 6, 500, 0.2});
  const double h = 2e-3, c = 1.3, f = 3;
  const auto p = [](double t) { return 0.1 + 2 * t - 30 * t * t + 7000 * t * t * t; };
  const auto v = [](double t) { return 2 - 60 * t + 21000 * t * t; };
  const Drive drive = axis.drive(f, p(0), v(0), p(h), v(h), c, h);
  for (double t = 0; t <= h; t += h / 8) CHECK(drive(t) == Approx(f + 500 * p(t) + c * v(t)).epsilon(1e-13));
}

TEST_CASE("how an interval is cut does not change the motion", "[arm]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> force(-3, 3);
  ArmAxis whole({0.41, 6.3, 500, 0.2}), halves = whole, tenths = whole;
  for (int tick = 0; tick < 20000; ++tick) {
    // Small forces now and then, so that the arm sticks and breaks away within intervals.
    const double a = force(random) * (tick % 3 == 0 ? 1 : 0.1), b = force(random) * 300, h = 1e-3;
    const Drive drive{{a, b, 0, 0}};
    whole.advance(drive, h);
    for (int i = 0; i < 2; ++i) halves.advance({{drive(i * h / 2), b, 0, 0}}, h / 2);
    for (int i = 0; i < 10; ++i) tenths.advance({{drive(i * h / 10), b, 0, 0}}, h / 10);
    // The instants of stopping are round-off apart, and what follows damps the difference.
    REQUIRE(std::abs(whole.position() - halves.position()) <= 1e-13);
    REQUIRE(std::abs(whole.position() - tenths.position()) <= 1e-13);
    REQUIRE(std::abs(whole.velocity() - tenths.velocity()) <= 1e-11);
  }
}

TEST_CASE("friction holds what does not exceed it, for ever, and nothing more", "[arm]") {
  ArmAxis axis({0.41, 5, 0, 0.2});
  axis.place(0.03);
  for (const double held : {0.0, 0.199, 0.2, -0.2}) {
    for (int tick = 0; tick < 1000; ++tick) axis.advance(constant(held), 1e-3);
    CHECK(axis.position() == 0.03);
    CHECK(axis.velocity() == 0);
  }
  axis.advance(constant(0.2 * (1 + 4 * eps)), 1);
  CHECK(axis.velocity() > 0);
}

TEST_CASE("an arm slowed by friction alone stops at m v² / 2 f, at the time m v / f, and stays", "[arm]") {
  const double m = 0.41, f = 0.2, push = 10.2;
  ArmAxis axis({m, 0, 0, f});
  axis.advance(constant(push), 1e-3);
  const double v = axis.velocity(), x = axis.position();
  REQUIRE(v == Approx((push - f) / m * 1e-3).epsilon(1e-14));
  const double stop = m * v / f;
  axis.advance(constant(0), 0.99 * stop);
  CHECK(axis.velocity() == Approx(0.01 * v).epsilon(1e-12));
  axis.advance(constant(0), 1);
  CHECK(axis.velocity() == 0);
  CHECK(axis.position() == Approx(x + m * v * v / (2 * f)).epsilon(1e-13));
}

TEST_CASE("a growing pull breaks the arm away at the instant when it exceeds friction", "[arm]") {
  const double m = 0.41, f = 0.2, rate = 500, t = 1e-3, broken = f / rate;
  ArmAxis axis({m, 0, 0, f});
  axis.advance({{0, rate, 0, 0}}, t);
  CHECK(axis.position() == Approx(rate * std::pow(t - broken, 3) / (6 * m)).epsilon(1e-10));
  CHECK(axis.velocity() == Approx(rate * std::pow(t - broken, 2) / (2 * m)).epsilon(1e-10));
  // A pull that comes and goes within the interval is felt too: 8e-3 t - 8 t² peaks at 0.25 N half-way.
  ArmAxis pulse({m, 0, 0, f});
  pulse.advance({{0, 1000, -1e6, 0}}, t);
  CHECK(pulse.position() > 0);
}

TEST_CASE("an arm alone gives back no energy that was not put in", "[arm]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> force(-37.5, 37.5);
  for (const double friction : {0.0, 0.2, 5.0})
    for (const double damping : {0.0, 5.0})
      for (const double stiffness : {0.0, 500.0}) {
        const double m = 0.41;
        ArmAxis axis({m, damping, stiffness, friction});
        double work = 0, scale = 1e-3;
        for (int tick = 0; tick < 20000; ++tick) {
          const double f = force(random) * (tick % 7 == 0 ? 1 : 0.01), before = axis.position();
          axis.advance(constant(f), 1e-3);
          const double x = axis.position(), v = axis.velocity();
          work += f * (x - before);
          scale += std::abs(f * (x - before));
          const double stored = m * v * v / 2 + stiffness * x * x / 2;
          const double round_off = scale * 16 * eps * (1 + tick);
          REQUIRE(stored <= work + round_off);
          if (friction == 0 && damping == 0) REQUIRE(std::abs(stored - work) <= round_off);
        }
      }
}
