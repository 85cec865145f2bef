// A hand on a beam with mass: a loop of a thousand ticks a second gains no energy, whatever the hand, the beam and the parts of a tick.
#include <algorithm>
#include <array>
#include <cmath>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

enum class Motion { presses, swings, taps, leaves };

/// An arm of a device with the hand that holds it: a mass on a spring and a damper to where the hand wants it to be.
struct Hand {
  double mass, spring, damper, arm = 5;  // [kg], [N/m], [N·s/m] of the hand, and of the arm
  double x, v = 0;                       // [m], [m/s]

  /// Moves for a tick under a force that stays.   @return what it was given, less what the arm has taken [J]
  template <class Want>
  double tick(double from, double force, Want&& want) {
    const double begin = x;
    double taken = 0;
    constexpr int parts = 50;
    for (int k = 0; k < parts; ++k) {
      constexpr double dt = 1e-3 / parts;
      const double a = (force + spring * (want(from + k * dt) - x) - (damper + arm) * v) / mass,
                   mean = v + dt * a / 2;
      x += dt * mean, v += dt * a;
      taken += arm * mean * mean * dt;
    }
    return force * (x - begin) - taken;
  }
};

}  // namespace

TEST_CASE("a hand that presses, swings, taps and leaves gains nothing from a beam with mass", "[dynamics]") {
  for (const int parts : {1, 4}) {
    Random random(11);
    for (int loop = 0; loop < 36; ++loop) {
      const int which = loop % 3;
      const Material material = which == 0   ? Material{200e9, 7850}
                                : which == 1 ? Material{3e9, 1200}
                                             : Material{5e6, 1100};
      const double height = which == 0   ? random(0.0005, 0.003)
                            : which == 1 ? random(0.001, 0.006)
                                         : random(0.005, 0.02);
      const double length = random(0.1, 0.5);
      const Support right = loop / 3 % 3 == 0   ? Support::free
                            : loop / 3 % 3 == 1 ? Support::pinned
                                                : Support::clamped;
      const Beam beam(length, Section::rectangle(random(0.005, 0.03), height), material,
                      right == Support::pinned ? Support::pinned : Support::clamped, right);
      DynamicModel<> model(beam, 8, parts);
      const bool usual = loop % 2 == 1;
      const double radius = 0.005, s = length * random(0.2, 0.95), depth = random(0.001, 0.02),
                   rate = 2 * pi * random(1, 12);
      Hand hand{usual ? 0.41 : random(0.05, 0.41), usual ? 500 : random(0, 1000), usual ? 1.3 : random(0, 2),
                5, radius + 0.001};
      const auto how = static_cast<Motion>(loop % 4);
      const auto want = [&](double t) {
        switch (how) {
          case Motion::presses: return radius + 0.001 - depth * std::min(t / 0.3, 1.0);
          case Motion::swings: return radius + depth * std::cos(rate * t);
          case Motion::taps: return radius + 0.001 - depth * std::exp(-t) * std::abs(std::sin(rate * t));
          case Motion::leaves: break;
        }
        return t < 0.3 ? radius - depth : radius + 0.02;
      };
      double force = 0, given = 0, most = 0;
      for (int k = 0; k < 600; ++k) {
        given += hand.tick(k * 1e-3, force, want);
        most = std::max(most, given);
        const auto felt = model.step(1e-3, {{s, {s, hand.x}, radius, 1}, 3500, 2});
        REQUIRE(felt.status == Status::ok);
        REQUIRE(felt.force <= 0);
        force = -felt.force * felt.normal.y();
      }
      CAPTURE(parts, loop);
      CHECK(most <= 1e-9);
    }
  }
}

TEST_CASE(
    "a late loop gains nothing from a beam with mass, of a gram or a kilogram, by the coupling of its delay",
    "[dynamics]") {
  const DeviceInfo device{"arm", Eigen::Vector3d::Ones(), 100, 100, 1e4, 0, 0, 1e-3, 5, 0.2};
  for (const int parts : {1, 4})
    for (int delay = 0; delay <= 3; ++delay) {
      Random random(21);
      for (int loop = 0; loop < 12; ++loop) {
        const double length = random(0.1, 0.5), width = random(0.005, 0.03), height = random(0.0005, 0.006),
                     mass = std::pow(10, random(-3, 0));
        const bool free = loop % 3 == 0;
        const Support left = loop % 3 == 1 ? Support::pinned : Support::clamped;
        // 100 N/m to 1e5 N/m of a cantilever
        const double young = std::pow(10, random(2, 5)) * 4 * std::pow(length / height, 3) / width;
        const Beam beam(length, Section::rectangle(width, height),
                        Material{young, mass / (length * width * height)}, left, free ? Support::free : left);
        DynamicModel<> model(beam, 8, parts);
        const double radius = 0.005, s = length * random(0.2, 0.95), depth = random(0.001, 0.02),
                     rate = 2 * pi * random(1, 12), top = radius + height / 2;
        Touch<DynamicModel<>> touch(model, radius);
        auto coupling = VirtualCoupling::for_device(device, delay);
        // Half of them are a hand on an arm of 410 g.
        Hand hand = loop % 2 == 1
                        ? Hand{0.41, 500, 1.3, 5, top + 0.001}
                        : Hand{std::pow(10, random(-3, 0)), random(0, 1000), random(0, 2), 5, top + 0.001};
        const auto how = static_cast<Motion>(loop % 4);
        const auto want = [&](double t) {
          switch (how) {
            case Motion::presses: return top + 0.001 - depth * std::min(t / 0.1, 1.0);
            case Motion::swings: return top + depth * std::cos(rate * t);
            case Motion::taps: return top + 0.001 - depth * std::exp(-t) * std::abs(std::sin(rate * t));
            case Motion::leaves: break;
          }
          return t < 0.3 ? top - depth : top + 0.02;
        };
        std::array<double, 4> sent{};
        double given = 0, most = 0, before = 0, jump = 0;
        int still = 0;  // ticks in which the hand has rested
        for (int k = 0; k < 600; ++k) {
          const double from = hand.x;
          given += hand.tick(k * 1e-3, sent[static_cast<std::size_t>(delay)], want);
          most = std::max(most, given);
          const auto felt = coupling.tick(touch, Vector2<double>(s, hand.x), 1e-3);
          REQUIRE(felt.touch.status == Status::ok);
          still = std::abs(hand.x - from) < 1e-7 ? still + 1 : 0;
          if (still > 20) jump = std::max(jump, std::abs(felt.force.y() - before));
          before = felt.force.y();
          for (std::size_t i = 3; i > 0; --i) sent[i] = sent[i - 1];
          sent[0] = before;
        }
        CAPTURE(parts, delay, loop);
        CHECK(most <= 1e-9);
        CHECK(jump < 1e-2);
      }
    }
}
