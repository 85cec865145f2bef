// What the force of a rod's contact is beside the gradient of the energy that the rod stores, as the hand sees it.
//
// The mesh stays, and what is condensed of a contact is where the energy is stationary: the force is that gradient with any number of elements.
#include <algorithm>
#include <cmath>

#include "support/catch.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;

namespace {

using Vector = VectorOf<double, 3>;
using Model = FemModel<TwistedRod>;
constexpr double pi = 3.14159265358979324;

/// The hook of the benchmarks: half a circle of 100 mm, clamped at one end.
Rod hook() {
  const double half = pi * 0.05;
  Rod rod(half, RodSection::circle(0.002), RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::free);
  return rod.naturally({{half, 0, 1 / 0.05, 0}});
}

/// A ball of 20 mm that comes down on the hook across its plane, and then moves over it in contact.
class Hand {
 public:
  explicit Hand(int elements) : model_(hook(), elements, tight()), touch_(model_, radius) {}

  /// Where the ball is at t, which has the period 2π: between 0.25 and 0.95 of the length, 1 to 9 mm deep.
  static Vector place(double t) {
    const double angle = pi * (0.6 + 0.35 * std::sin(t)), depth = 0.005 + 0.004 * std::cos(t + 0.3);
    return {0.05 * std::sin(angle), 0.05 * (1 - std::cos(angle)), radius + 0.001 - depth};
  }
  /// Touches it there from above, in steps.
  void come_down(const Vector& to) {
    for (int k = 0; k <= 20; ++k) (void)go(to + Vector(0, 0, 0.01 * (20 - k) / 20));
  }
  /// @return the force on the hand [N]
  Vector go(const Vector& to) {
    TouchResult<double, 3> felt;
    for (int k = 0; k < 4; ++k) felt = touch_.tick(to);  // until it rests
    REQUIRE(felt.status == Status::ok);
    return felt.force;
  }
  double energy() const { return model_.strain_energy(); }

 private:
  static constexpr double radius = 0.02;
  static NewtonRaphson tight() {
    NewtonRaphson solver;
    solver.relative_tolerance = 1e-11;
    return solver;
  }
  Model model_;
  Touch<Model> touch_;
};

/// Largest |F + ∇V|/|F| over the path, ∇V by differences.
double off_gradient(int elements) {
  constexpr int places = 24;
  const double step = 2e-5;
  Hand hand(elements);
  hand.come_down(Hand::place(0));
  double worst = 0;
  for (int k = 0; k < 4 * places; ++k) {
    const Vector at = Hand::place(2 * pi * k / (4 * places));
    (void)hand.go(at);
    if (k % 4 != 0) continue;
    Vector gradient;
    for (int i = 0; i < 3; ++i) {
      const Vector way = step * Vector::Unit(i);
      (void)hand.go(at + way);
      const double more = hand.energy();
      (void)hand.go(at - way);
      gradient[i] = (more - hand.energy()) / (2 * step);
    }
    const Vector force = hand.go(at);
    worst = std::max(worst, (force + gradient).norm() / force.norm());
  }
  return worst;
}

/// Work of the hand around the path, over the range of what is stored on the way.
double gain(int elements) {
  constexpr int steps = 400;
  Hand hand(elements);
  hand.come_down(Hand::place(0));
  double work = 0, least = 1e9, most = 0;
  for (int k = 0; k < steps; ++k) {
    const double t = 2 * pi * k / steps, e = 1e-4;
    work -= hand.go(Hand::place(t)).dot(Hand::place(t + e) - Hand::place(t - e)) / (2 * e) * 2 * pi / steps;
    least = std::min(least, hand.energy()), most = std::max(most, hand.energy());
  }
  return std::abs(work) / (most - least);
}

}  // namespace

// What central differences of 20 µm leave of a force that changes within millimetres: 7e-7, with 16 elements as with 8.
TEST_CASE("a rod's contact force is the gradient of the energy it stores, whatever its mesh", "[rod]") {
  for (const int elements : {8, 16}) {
    const double off = off_gradient(elements);
    INFO(elements << ": " << off);
    CHECK(off <= 1e-6);
  }
}

// Solves stop at 1e-9 of a force.
TEST_CASE("around a closed path a rod gives back what it stores, whatever its mesh", "[rod]") {
  for (const int elements : {8, 16}) {
    const double off = gain(elements);
    INFO(elements << ": " << off);
    CHECK(off <= 1e-7);
  }
}
