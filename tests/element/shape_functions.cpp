// The laws of the interpolation: values at the nodes, partition of unity, cubics reproduced, slope, and work.
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/element/hermite.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Vector4 = Eigen::Vector4d;

namespace {

constexpr double eps = 2.2e-16;

}  // namespace

TEST_CASE("at a node the shape functions give its own displacements", "[shape]") {
  const ShapeFunctions<double> left(0, 0.7), right(1, 0.7);
  CHECK((left.u1 == 1 && left.u2 == 0 && right.u1 == 0 && right.u2 == 1));
  CHECK((left.w - Vector4(1, 0, 0, 0)).norm() == 0);
  CHECK((right.w - Vector4(0, 0, 1, 0)).norm() == 0);
  CHECK((left.theta - Vector4(0, 1, 0, 0)).norm() <= eps);
  CHECK((right.theta - Vector4(0, 0, 0, 1)).norm() <= eps);
}

TEST_CASE("every linear u and every cubic w is reproduced, rigid motions among them", "[shape]") {
  Random random(41);
  for (int trial = 0; trial < 500; ++trial) {
    const double l = random(0.1, 2), t = random(0, 1), x = t * l;
    const double c[] = {random(1), random(1), random(1), random(1)};
    const auto w = [&](double at) { return c[0] + at * (c[1] + at * (c[2] + at * c[3])); };
    const auto theta = [&](double at) { return -(c[1] + at * (2 * c[2] + at * 3 * c[3])); };
    const ShapeFunctions<double> shape(t, l);
    const Vector4 nodal(w(0), theta(0), w(l), theta(l));
    REQUIRE(std::abs(shape.u1 + shape.u2 - 1) <= eps);
    REQUIRE(std::abs(shape.w[0] + shape.w[2] - 1) <= 4 * eps);
    REQUIRE(std::abs(shape.w.dot(nodal) - w(x)) <= 64 * eps);
    REQUIRE(std::abs(shape.theta.dot(nodal) - theta(x)) <= 64 * eps / 0.1 * 6);  // theta divides by l >= 0.1
  }
}

// The five-point rule is exact for cubics; steps of l/8 keep round-off at 8 eps / l.
TEST_CASE("theta is -dw/dx", "[shape]") {
  Random random(42);
  for (int trial = 0; trial < 200; ++trial) {
    const double l = random(0.1, 2), t = random(0.3, 0.7), h = 0.125;
    const auto w = [l](double at) { return ShapeFunctions<double>(at, l).w; };
    const Vector4 slope = (8 * (w(t + h) - w(t - h)) - (w(t + 2 * h) - w(t - 2 * h))) / (12 * h * l);
    REQUIRE((ShapeFunctions<double>(t, l).theta + slope).norm() <= 64 * eps / l);
  }
}

TEST_CASE("nodal forces do the work of the force and moment that they stand for", "[shape]") {
  Random random(43);
  for (int trial = 0; trial < 500; ++trial) {
    const double l = random(0.1, 2), axial = random(1), transverse = random(1), moment = random(1);
    const ShapeFunctions<double> shape(random(0, 1), l);
    Vector6<double> d;
    for (int i = 0; i < 6; ++i) d[i] = random(1);
    const Vector4 bending(d[1], d[2], d[4], d[5]);
    const double work = axial * (shape.u1 * d[0] + shape.u2 * d[3]) + transverse * shape.w.dot(bending) +
                        moment * shape.theta.dot(bending);
    REQUIRE(std::abs(shape.nodal_forces(axial, transverse, moment).dot(d) - work) <= 64 * eps / l);
  }
}
