// Dead loads on an element that turns: forces as the gradient of their work, a symmetric load stiffness, and the work
// itself, which is that of the load on the curve.
#include "element/elements.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include <hapbeam/fem/beam_loads.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

PointForce<double> random_force(Random& random) {
  return {0, {random(1), random(1)}, {random(1), random(1)}, random(1)};
}

/// A state of random_state() turned by up to four turns.
Vector6<double> turned_state(Random& random, double length) {
  return turned(random(8 * pi), random_state(random, length), length);
}

/// How much further along the chord the point at t is where the cubic stretches evenly: ½ (t ∫w'² ds - ∫w'² ds to it).
double bow(double t, double l, const Eigen::Vector4d& bent) {
  const auto shortened = [&](double to) {
    double sum = 0;
    for (std::size_t k = 0; k < detail::gauss_points.size(); ++k) {
      const double slope = ShapeFunctions<double>(to * detail::gauss_points[k], l).theta.dot(bent);
      sum += to * l * detail::gauss_weights[k] * slope * slope / 2;
    }
    return sum;
  };
  return t * shortened(1) - shortened(t);
}

/// -∂W/∂d, one per unit of λ.
Vector6<double> residual(const PointForce<double>& load, double t, const ElementProperties<double>& p,
                         const Vector6<double>& d) {
  Vector6<double> r = Vector6<double>::Zero();
  subtract_load<double>(load, t, 1, p, d, r, nullptr);
  return r;
}

}  // namespace

// The five-point rule with a step of 1e-3 leaves 1e-12/30 of the fifth derivative, which for a chord of 0.3 is up to
// 5!/0.3⁵ = 5e4 times a load of 1 to 3, and round-off of 100 eps/1e-3: less than 1e-8.
TEST_CASE("the load stiffness is the gradient of the nodal forces, and symmetric", "[load]") {
  Random random(51);
  double worst = 0, asymmetry = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p(random(0.5, 2), 1, 1);
    const PointForce<double> load = random_force(random);
    const Vector6<double> d = turned_state(random, p.length);
    const double t = trial % 3 == 0 ? trial % 2 : random(0, 1), lambda = random(0.5, 1);
    Vector6<double> r = Vector6<double>::Zero();
    Matrix6<double> K = Matrix6<double>::Zero(), expected;
    subtract_load(load, t, lambda, p, d, r, &K);
    REQUIRE((r - lambda * residual(load, t, p, d)).norm() <= 1e-14 * (1 + r.norm()));
    for (int i = 0; i < 6; ++i)
      expected.col(i) =
          lambda * derivative([&](const auto& x) { return residual(load, t, p, x); }, d, i, 1e-3);
    worst = std::max(worst, (K - expected).norm());
    asymmetry = std::max(asymmetry, (K - K.transpose()).norm() / (1 + K.norm()));
  }
  INFO("largest difference " << worst << ", asymmetry " << asymmetry);
  CHECK(worst <= 1e-8);
  CHECK(asymmetry <= 1e-14);
}

// A symmetric load stiffness says that a work exists; this says which: force times the way of its point on the cubic about
// the chord, which stretches evenly, and moment times the angle there.
TEST_CASE("nodal forces do the work of the load on the element's own cubic", "[load]") {
  Random random(52);
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p(random(0.5, 2), 1, 1);
    const PointForce<double> load = random_force(random);
    const double t = random(0, 1), l = p.length, turn = random(8 * pi);
    const auto work = [&](const Vector6<double>& d) {
      // Seen from the frame that has turned along, where no angle is near half a turn.
      const Vector6<double> seen = turned(-turn, d, l);
      const double x = l + seen[3] - seen[0], rise = seen[4] - seen[1], angle = std::atan2(rise, x);
      const ShapeFunctions<double> shape(t, l);
      const Eigen::Vector4d local(0, seen[2] + angle, 0, seen[5] + angle);
      const double across = shape.w.dot(local), along = t * std::hypot(x, rise) + bow(t, l, local);
      const double theta = shape.theta.dot(local) - angle + turn;
      const double chord = angle - turn;  // up is positive
      const double u = along * std::cos(chord) - across * std::sin(chord) + d[0],
                   w = along * std::sin(chord) + across * std::cos(chord) + d[1];
      return load.force.x() * u + load.force.y() * w + load.moment * theta + load.arm.x() * std::cos(theta) -
             load.arm.y() * std::sin(theta);
    };
    const Vector6<double> d = turned(turn, random_state(random, l), l), r = residual(load, t, p, d);
    Vector6<double> ignored = Vector6<double>::Zero();
    const double answered = subtract_load<double>(load, t, 1, p, d, ignored, nullptr),
                 at_rest = load.force.x() * t * l + load.arm.x();
    worst = std::max(worst, std::abs(answered - (work(d) - at_rest)));
    for (int i = 0; i < 6; ++i) worst = std::max(worst, std::abs(r[i] + derivative(work, d, i, 1e-3)));
  }
  INFO("largest difference " << worst);
  CHECK(worst <= 1e-8);
}

// As above, of moderate rotation: u linear but for the even stretch, and θ as it is.
TEST_CASE("moderate rotation's nodal forces and stiffness are derivatives of the load's work", "[load]") {
  Random random(55);
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const ElementProperties<double> p(random(0.5, 2), 1, 1);
    const PointForce<double> load = random_force(random);
    const double t = trial % 3 == 0 ? trial % 2 : random(0, 1), l = p.length, lambda = random(0.5, 1);
    const auto work = [&](const Vector6<double>& d) {
      const ShapeFunctions<double> shape(t, l);
      const Eigen::Vector4d bent(d[1], d[2], d[4], d[5]);
      const double theta = shape.theta.dot(bent);
      return lambda * (load.force.x() * (shape.u1 * d[0] + shape.u2 * d[3] + bow(t, l, bent)) +
                       load.force.y() * shape.w.dot(bent) + (load.moment - load.arm.y()) * theta -
                       load.arm.x() * theta * theta / 2);
    };
    const auto residual = [&](const Vector6<double>& d) {
      Vector6<double> r = Vector6<double>::Zero();
      subtract_moderate_load<true>(load, t, lambda, p, d, r, static_cast<Matrix6<double>*>(nullptr));
      return r;
    };
    const Vector6<double> d = random_state(random, l);
    Vector6<double> r = Vector6<double>::Zero();
    Matrix6<double> K = Matrix6<double>::Zero();
    const double answered = subtract_moderate_load<true>(load, t, lambda, p, d, r, &K);
    worst =
        std::max({worst, std::abs(answered - work(d)), (r - residual(d)).norm(), (K - K.transpose()).norm()});
    for (int i = 0; i < 6; ++i) {
      worst = std::max(worst, std::abs(r[i] + derivative(work, d, i, 1e-3)));
      worst = std::max(worst, (K.col(i) - derivative(residual, d, i, 1e-3)).norm());
    }
  }
  INFO("largest difference " << worst);
  CHECK(worst <= 1e-9);
}

// Rotations of 1e-4 change arms by their squares, 1e-8, and moments of arms by 1e-4 of the first order in d; without
// displacements the two are the same formula.
TEST_CASE("on a beam that has not turned the load is that of moderate rotation", "[load]") {
  Random random(53);
  for (int trial = 0; trial < 300; ++trial) {
    const ElementProperties<double> p(random(0.5, 2), 1, 1);
    const PointForce<double> load = random_force(random);
    const double t = trial % 3 == 0 ? trial % 2 : random(0, 1);
    const Vector6<double> rest = Vector6<double>::Zero();
    Vector6<double> moderate = rest;
    subtract_moderate_load<true, double>(load, t, 1, p, rest, moderate, nullptr);
    CHECK((residual(load, t, p, rest) - moderate).norm() <= 1e-14);
  }
}

TEST_CASE("dead forces keep their resultant, however the element has turned", "[load]") {
  Random random(54);
  for (int trial = 0; trial < 300; ++trial) {
    const ElementProperties<double> p(random(0.5, 2), 1, 1);
    const PointForce<double> load = random_force(random);
    const Vector6<double> r = residual(load, random(0, 1), p, turned_state(random, p.length));
    CHECK(std::abs(r[0] + r[3] + load.force.x()) <= 1e-14 * (1 + r.norm()));
    CHECK(std::abs(r[1] + r[4] + load.force.y()) <= 1e-14 * (1 + r.norm()));
  }
}

// ∫(f u + q w) ds on a circle, θ = k s, by the forces and arms of a mesh: Euler and Maclaurin's remainder is
// l⁴/720 [w'''] <= l⁴/720 k³ (1 + ...), and a fourth of that again for an uneven load's slope.
TEST_CASE("the error of the work of an uneven load on a bent beam is of fourth order", "[load]") {
  const double length = 2, k = 1.7;
  Beam beam(length, 1, 1, 0.1, Support::clamped, Support::free);
  beam.transverse([](double s) { return 2 - s; }).axial([](double s) { return 1 + s * s; });
  const auto u = [&](double s) { return std::sin(k * s) / k - s; };
  const auto w = [&](double s) { return (std::cos(k * s) - 1) / k; };
  double exact = 0;
  for (int e = 0; e < 100; ++e)
    for (std::size_t g = 0; g < detail::gauss_points.size(); ++g) {
      const double s = length * (e + detail::gauss_points[g]) / 100;
      exact += length / 100 * detail::gauss_weights[g] * ((1 + s * s) * u(s) + (2 - s) * w(s));
    }
  double error[3];
  for (int j = 0; j < 3; ++j) {
    double work = 0;
    const DeadLoads<double> loads(beam, 4 << j);
    for (const PointForce<double>& f : loads.forces())
      work += f.force.x() * u(f.s) + f.force.y() * w(f.s) + f.arm.x() * (std::cos(k * f.s) - 1) -
              f.arm.y() * std::sin(k * f.s);
    error[j] = relative_error(work, exact);
  }
  INFO("errors " << error[0] << ' ' << error[1] << ' ' << error[2]);
  CHECK(error[0] <= 1e-3);
  CHECK(observed_order(error[0], error[1]) >= 3.8);
  CHECK(observed_order(error[1], error[2]) >= 3.8);
}
