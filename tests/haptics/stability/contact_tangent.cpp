// The tangent of the contact follows from the energy: on potentials in closed form, along any path.
#include <cmath>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/haptics/stability/contact_tangent.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;

/// V(x, y) = k(x) d^(q + 1)/(q + 1), d = -y: a beam on hinges at 0 and 1, pressed at x by d.
struct PowerLaw {
  double exponent;

  double stiffness(double x) const { return 1 / std::pow(x * (1 - x), 2); }
  double energy(const Vector& p) const {
    return stiffness(p.x()) * std::pow(-p.y(), exponent + 1) / (exponent + 1);
  }
  Vector force(const Vector& p) const {
    const double slope = -2 * (1 - 2 * p.x()) / (p.x() * (1 - p.x()));  // of ln k
    return {-slope * energy(p), stiffness(p.x()) * std::pow(-p.y(), exponent)};
  }
};

}  // namespace

TEST_CASE("nothing known, nothing forced", "[tangent]") {
  ContactTangent<2> tangent;
  CHECK_FALSE(tangent.known());
  CHECK(tangent.force_at({0.3, -5}) == 0);
  tangent.learn({0, -0.1}, {0, 3}, 0.1);
  CHECK(tangent.known());
  CHECK(tangent.normal() == Vector(0, 1));
  CHECK(tangent.force_at({0, -0.1}) == 3);
  CHECK(tangent.force_at({7, -0.1}) == 3);  // no friction: across the normal nothing changes
  CHECK(tangent.force_at({0, -0.2}) == Approx(3 + 0.1 * tangent.stiffness()));
  tangent.forget();
  CHECK(tangent.force_at({0, -0.1}) == 0);
}

// 1.25 f²/2U against the tangent of f = k y^q, q k y^(q - 1) = f²/2U · 2q/(q + 1).
TEST_CASE("pressed straight down, the stiffness is the tangent's within a fifth, linear to cubic",
          "[tangent]") {
  for (const double q : {1.0, 1.5, 2.0, 3.0}) {
    const PowerLaw beam{q};
    ContactTangent<2> tangent;
    double y = 1e-6;
    tangent.learn({0.5, -y}, beam.force({0.5, -y}), y);
    for (; y < 1; y *= 1.05) tangent.learn({0.5, -y}, beam.force({0.5, -y}), y);
    y /= 1.05;
    const double exact = q * beam.stiffness(0.5) * std::pow(y, q - 1);
    // A trapezoid over a step of 5 % is off by q(q - 1)/12 0.05² of the energy, once and not summed: 0.2 %.
    CHECK(tangent.stiffness() == Approx(exact * 1.25 * (q + 1) / (2 * q)).epsilon(2e-3));
    CHECK(tangent.stiffness() / exact >= 0.8);
    CHECK(tangent.stiffness() / exact <= 1.2501);
  }
}

TEST_CASE(
    "wherever the hand slides, the energy goes along: stiffness is right where it changes a hundredfold",
    "[tangent]") {
  Random random(5);
  for (const double q : {1.0, 3.0}) {
    const PowerLaw beam{q};
    for (int path = 0; path < 50; ++path) {
      Vector p(0.5, -1e-3);
      ContactTangent<2> tangent;
      tangent.learn(p, beam.force(p), 1e-3 * 2 / (q + 1));  // V = f y/(q + 1)
      double largest = beam.energy(p);
      for (int leg = 0; leg < 5; ++leg) {
        const Vector to(random(0.03, 0.97), -std::pow(10, random(-3, -2)));
        const Vector from = p;
        const int steps = 20000;
        for (int i = 1; i <= steps; ++i) {
          p = from + (to - from) * (double(i) / steps);
          tangent.learn(p, beam.force(p), 0);
          largest = std::max(largest, beam.energy(p));
        }
        // The sum of trapezoids, each off by h²/12 of its share, is right to 1e-6 of the largest energy on the way.
        const double f = beam.force(p).norm(), energy = 1.25 * f * f / (2 * tangent.stiffness());
        CHECK(std::abs(energy - beam.energy(p)) <= 1e-6 * largest);
      }
    }
  }
}

TEST_CASE("where the tangent was wrong, the response is believed", "[tangent]") {
  ContactTangent<2> tangent;
  tangent.learn({0, -1e-3}, {0, 1}, 1e-3);
  CHECK(tangent.stiffness() == Approx(1250));
  // Ten times as stiff as it seemed, at once: too soft overshoots.
  tangent.learn({0, -2e-3}, {0, 1 + 12.5}, 0);
  CHECK(tangent.stiffness() == Approx(1.25 * 12500));
  // Ten times as soft: by four a tick.
  tangent.learn({0, -3e-3}, {0, 13.5 + 1.5625}, 0);
  CHECK(tangent.stiffness() == Approx(1.25 * 12500 / 4));
  // Stiff without having been pressed deeper, as on the way to a support: by the force, at least.
  tangent.learn({0, -2.9e-3}, {0, 10 * 15.0625}, 0);
  CHECK(tangent.stiffness() == Approx(10 * 1.25 * 12500 / 4));
  // Nothing there: the force begins at the surface, as stiff as it was, and the next response goes on from there.
  const double stiffness = tangent.stiffness();
  tangent.begin_at({1e-3, -2.5e-3}, {0.6, 0.8});
  CHECK(tangent.stiffness() == stiffness);
  CHECK(tangent.energy() == 0);
  CHECK(tangent.force_at({1e-3, -2.5e-3}) == 0);
  CHECK(tangent.force_at(Vector(1e-3, -2.5e-3) - 1e-4 * Vector(0.6, 0.8)) == Approx(1e-4 * stiffness));
  tangent.learn(Vector(1e-3, -2.5e-3) - 1e-4 * Vector(0.6, 0.8), 1e-4 * stiffness * Vector(0.6, 0.8), 0);
  CHECK(tangent.stiffness() == Approx(stiffness));
}

TEST_CASE("no sequence of answers makes it anything but a finite number", "[tangent]") {
  Random random(9);
  ContactTangent<2> tangent;
  for (int i = 0; i < 200000; ++i) {
    const double size = std::pow(10, random(-9, 9)), scale = std::pow(10, random(-12, 1));
    Vector force(random(1), random(1));
    force *= size / force.norm();
    const Vector place(random(scale), random(scale));
    if (random(0, 1) < 0.05) tangent.forget();
    else if (tangent.known() && random(0, 1) < 0.2) tangent.begin_at(place, force / size);
    else tangent.learn(place, force, random(0, 1) < 0.1 ? 0 : random(scale));
    REQUIRE(std::isfinite(tangent.force_at(place)));
    REQUIRE((tangent.stiffness() >= 0 && tangent.stiffness() <= 1e12));
    REQUIRE((!tangent.known() || tangent.stiffness() > 0));
  }
}
