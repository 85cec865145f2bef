// The hierarchy changes the cost of a query and nothing else.
#include <limits>

#include "../support/catch.hpp"
#include "curves.hpp"
#include <hapbeam/contact/bounding_volumes.hpp>

using namespace hapbeam;

namespace {

template <typename Scalar>
NearestPoint<Scalar> nearest_of_all(const Centreline<Scalar>& line, const Vector2<Scalar>& q) {
  NearestPoint<Scalar> best;
  for (int i = 0; i < line.segments(); ++i) {
    const auto candidate = closest_point(line.segment(i), q);
    if (candidate.distance_squared < best.at.distance_squared) best = {i, candidate, line.segment(i)};
  }
  return best;
}

template <typename Scalar>
void check_same(const BoundingVolumes<Scalar>& volumes, const Centreline<Scalar>& line,
                const Vector2<Scalar>& q) {
  const auto found = volumes.nearest(line, q), expected = nearest_of_all(line, q);
  REQUIRE(found.segment == expected.segment);
  REQUIRE(found.at.t == expected.at.t);
  REQUIRE(found.at.offset == expected.at.offset);
  REQUIRE(found.at.distance_squared == expected.at.distance_squared);
}

}  // namespace

TEMPLATE_TEST_CASE("nearest is that of the exhaustive search, bit by bit", "", double, float) {
  using Scalar = TestType;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along(-0.3, 1.3), across(-0.6, 0.6), close(-1e-2, 1e-2);
  for (const int segments : {1, 2, 3, 4, 5, 7, 8, 16, 100, 1023, 1024}) {
    BoundingVolumes<Scalar> volumes(segments);
    for (const Shape shape : all_shapes) {
      const auto curve = random_curve<Scalar>(shape, segments, random);
      const auto line = curve.line();
      volumes.refit(line);
      for (int i = 0; i < (segments > 100 ? 10 : 200); ++i) {
        check_same(volumes, line, Vector2<Scalar>(Scalar(along(random)), Scalar(across(random))));
        const auto& node = curve.nodes[static_cast<std::size_t>(i % (segments + 1))];  // where pieces compete
        check_same(volumes, line, Vector2<Scalar>(node.s + node.u, node.w));
        check_same(volumes, line, Vector2<Scalar>(node.s + node.u, node.w + Scalar(close(random))));
        check_same(volumes, line, Vector2<Scalar>(node.s + node.u + Scalar(close(random)), node.w));
      }
    }
  }
}

TEST_CASE("crossings are those of the exhaustive search, and a node that is hit counts once") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> along(-0.2, 1.2), across(-0.6, 0.6);
  for (const int segments : {1, 2, 3, 4, 5, 16, 1023, 1024}) {
    BoundingVolumes<double> volumes(segments);
    for (const Shape shape : all_shapes) {
      const auto curve = random_curve<double>(shape, segments, random);
      const auto line = curve.line();
      volumes.refit(line);
      for (int i = 0; i < 100; ++i) {
        const Vector2<double> p0(along(random), across(random)), p1(along(random), across(random));
        Crossings expected;
        for (int k = 0; k < segments; ++k) expected += crossings(line.segment(k), p0, p1);
        const Crossings found = volumes.crossings(line, p0, p1);
        REQUIRE(found.count == expected.count);
        REQUIRE(found.net == expected.net);
      }
      for (int i = 1; i < segments; ++i) {
        const auto& node = curve.nodes[static_cast<std::size_t>(i)];
        const double x = node.s + node.u;
        if (shape == Shape::ragged) continue;  // may fold back
        const Crossings down = volumes.crossings(line, {x, node.w + 1}, {x, node.w - 1});
        REQUIRE(down.count == 1);
        REQUIRE(down.net == 1);
        REQUIRE(volumes.crossings(line, {x, node.w - 1}, {x, node.w + 1}).net == -1);
      }
    }
  }
}

TEST_CASE("the same volumes serve centrelines with fewer and with more pieces than planned") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(-0.3, 1.3), across(-0.6, 0.6);
  BoundingVolumes<double> volumes(8);
  for (const int segments : {8, 3, 1, 100, 9, 1024, 8}) {
    const auto curve = random_curve<double>(Shape::wavy, segments, random);
    volumes.refit(curve.line());
    for (int i = 0; i < 100; ++i) check_same<double>(volumes, curve.line(), {along(random), across(random)});
  }
  // Nothing is left of a larger tree.
  const auto straight = straight_curve<double>(3, 1);
  volumes.refit(straight.line());
  CHECK(volumes.distance_squared({0.5, 0.25}) == 0.0625);
  CHECK(volumes.distance_squared({1.25, 0}) == 0.0625);
}

TEST_CASE("no piece is nearest to a query, or on a curve, that is not finite") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::mt19937 random(8);
  auto curve = random_curve<double>(Shape::wavy, 5, random);
  BoundingVolumes<double> volumes(5);
  volumes.refit(curve.line());
  CHECK(volumes.nearest(curve.line(), {nan, 0}).segment == -1);
  CHECK(volumes.nearest(curve.line(), {0, 1e200}).segment == -1);
  for (auto& node : curve.nodes) node.w = nan;
  volumes.refit(curve.line());
  CHECK(volumes.nearest(curve.line(), {0.5, 0}).segment == -1);
  CHECK(volumes.crossings(curve.line(), {0.5, 1}, {0.5, -1}).count == 0);
}
