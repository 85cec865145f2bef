// A circle on a curve: distance, normal and lever against a curve whose distance is known, derivatives against differences.
#include <cmath>

#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/fem/circle_on_curve.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Vector = Vector2<double>;
using Circle = detail::CircleOnCurve<double>;

/// A node on a curve that is a circle of this curvature to the left, or a line, and a centre beside it.
struct Case {
  CentrelineNode<double> node;
  double curvature, side;
  Vector centre;
};
Case random_case(Random& random) {
  const double side = random(1) > 0 ? 1 : -1, theta = random(3), curvature = random(5);
  const Vector along(std::cos(theta), -std::sin(theta)), left(-along.y(), along.x());
  const CentrelineNode<double> node{random(0, 1), random(0.3), random(0.3), theta};
  const Vector at(node.s + node.u, node.w);
  return {node, curvature, side, at + random(0.03) * along + side * random(0.001, 0.05) * left};
}

}  // namespace

TEST_CASE("the distance of a centre from a circle of curvature is that of their geometry", "[push]") {
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const Case c = random_case(random);
    const auto view = Circle(c.centre, c.side, c.curvature, 0).at(c.node);
    const Vector left(std::sin(c.node.theta), std::cos(c.node.theta)), at(c.node.s + c.node.u, c.node.w);
    const Vector of_curvature = at + left / c.curvature;
    const double radius = 1 / std::abs(c.curvature),
                 inside = c.side * c.curvature > 0 ? 1 : -1;  // the centre is on the hollow side
    CAPTURE(c.curvature, c.side);
    CHECK(view.distance ==
          Approx(inside * (radius - (c.centre - of_curvature).norm())).epsilon(1e-9).margin(1e-13 * radius));
    // The foot lies on the curve, a lever along from the node.
    const Vector foot = c.centre - view.distance * view.normal;
    CHECK((foot - of_curvature).norm() == Approx(radius).epsilon(1e-12));
    CHECK(view.normal.norm() == Approx(1).epsilon(1e-12));
    CHECK(
        view.lever ==
        Approx(view.normal.y() * (foot - at).x() - view.normal.x() * (foot - at).y()).margin(1e-13 * radius));
  }
}

// Central differences of step h have an error of h² times a third derivative of order 1/D², and round-off of eps/h² in the second.
TEST_CASE("first and second derivatives of the distance are those that the tangent is made of", "[push]") {
  Random random(5);
  for (const int end : {0, 1})
    for (int k = 0; k < 300; ++k) {
      Case c = random_case(random);
      const Vector along(std::cos(c.node.theta), -std::sin(c.node.theta));
      if (end == 1) c.centre += 0.05 * along;
      const Circle circle(c.centre, c.side, c.curvature, end);
      const auto view = circle.at(c.node);
      const Vector n = view.normal, p(n.y(), -n.x());
      const auto distance = [&](double dp, double dq, double theta) {
        CentrelineNode<double> moved = c.node;
        moved.u += dp * p.x() + dq * n.x();
        moved.w += dp * p.y() + dq * n.y();
        moved.theta += theta;
        return circle.at(moved).distance;
      };
      const double h = 1e-4 * view.height, b = view.bend, m = 1 + b * view.height, scale = 1 / view.height;
      CAPTURE(end, view.height, view.lever, b);
      CHECK((distance(h, 0, 0) - distance(-h, 0, 0)) / (2 * h) == Approx(0).margin(1e-6));
      CHECK((distance(0, h, 0) - distance(0, -h, 0)) / (2 * h) == Approx(-1).epsilon(1e-6));
      CHECK((distance(0, 0, 1e-4) - distance(0, 0, -1e-4)) / 2e-4 ==
            Approx(view.lever).margin(1e-6 * view.height));
      const double pp = (distance(h, 0, 0) - 2 * view.distance + distance(-h, 0, 0)) / (h * h),
                   tt = (distance(0, 0, 1e-4) - 2 * view.distance + distance(0, 0, -1e-4)) / 1e-8,
                   pt = (distance(h, 0, 1e-4) - distance(h, 0, -1e-4) - distance(-h, 0, 1e-4) +
                         distance(-h, 0, -1e-4)) /
                        (4e-4 * h);
      CHECK(pp == Approx(-b).margin(1e-5 * scale));
      CHECK(pt == Approx(-m).margin(1e-5));
      CHECK(tt == Approx(-view.height * m).margin(1e-5 * view.height));
    }
}
