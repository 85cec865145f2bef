// A hand on a beam with mass: a loop of a thousand ticks a second gains no energy, whatever the hand, the beam and the parts of a tick.
#include <algorithm>
#include <cmath>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/fem/dynamic_model.hpp>

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
