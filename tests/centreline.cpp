// The centreline of any rotation: smooth where its pieces meet, fourth order, and an angle that counts its turns.
#include <vector>

#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/rod_centreline.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double eps = 2.2e-16;
using Nodes = std::vector<CentrelineNode<double>>;

Centreline<double> view(const Nodes& nodes, bool any_rotation = true) {
  return {nodes.data(), static_cast<int>(nodes.size()), any_rotation};
}

/// Nodes of a circle of curvature k that is gone round from the origin on, along x.
Nodes circle(int segments, double length, double k) {
  Nodes nodes;
  for (int i = 0; i <= segments; ++i) {
    const double s = length * i / segments;
    nodes.push_back({s, std::sin(k * s) / k - s, (std::cos(k * s) - 1) / k, k * s});
  }
  return nodes;
}

/// Nodes that have nothing to do with each other.
Nodes ragged(Random& random) {
  Nodes nodes;
  double s = 0;
  for (int i = 0; i < 8; ++i, s += random(0.2, 1)) nodes.push_back({s, random(1), random(1), random(20)});
  return nodes;
}

template <int D>
VectorOf<double, D> point(const CubicSegment<double, D>& b, double t) {
  const double r = 1 - t;
  return r * r * r * b.col(0) + 3 * r * r * t * b.col(1) + 3 * r * t * t * b.col(2) + t * t * t * b.col(3);
}

}  // namespace

TEST_CASE("pieces meet in the node, with its tangent and a third of how long they are now", "[centreline]") {
  Random random(91);
  for (int trial = 0; trial < 50; ++trial) {
    const Nodes nodes = ragged(random);
    const Centreline<double> line = view(nodes);
    for (int i = 0; i < line.segments(); ++i) {
      const CubicSegment<double> b = line.segment(i);
      const double third = (b.col(1) - b.col(0)).norm(), chord = (b.col(3) - b.col(0)).norm();
      const auto tangent = [](const CentrelineNode<double>& node) {
        return Vector2<double>(std::cos(node.theta), -std::sin(node.theta));
      };
      const auto place = [](const CentrelineNode<double>& node) {
        return Vector2<double>(node.s + node.u, node.w);
      };
      CHECK((b.col(0) - place(line[i])).norm() == 0);
      CHECK((b.col(3) - place(line[i + 1])).norm() == 0);
      CHECK(3 * third >= chord);
      CHECK((b.col(1) - b.col(0) - third * tangent(line[i])).norm() <= 16 * eps);
      CHECK((b.col(3) - b.col(2) - third * tangent(line[i + 1])).norm() <= 16 * eps);
    }
  }
}

// Up to 8 m of arc are taken off positions again: 8 eps.
TEST_CASE("displacements between nodes are those of the piece's cubic", "[centreline]") {
  Random random(92);
  for (int trial = 0; trial < 200; ++trial) {
    const Nodes nodes = ragged(random);
    const Centreline<double> line = view(nodes);
    const int i = random.integer(0, line.segments() - 1);
    const double t = random(0, 1), s = line[i].s + t * (line[i + 1].s - line[i].s);
    const Displacement<double> at = line.at(i, s);
    const Vector2<double> expected = point<2>(line.segment(i), t);
    CHECK(std::abs(s + at.u - expected.x()) <= 64 * eps);
    CHECK(std::abs(at.w - expected.y()) <= 64 * eps);
  }
}

template <int D>
void check_positions(const Centreline<double, D>& line) {
  line.visit_segments([&](int i, const CubicSegment<double, D>& piece) {
    const auto &a = line[i], &b = line[i + 1];
    CHECK(a.position() == piece.col(0));
    CHECK(b.position() == piece.col(3));
    for (const double t : {0.0, 0.3, 0.8}) {
      const VectorOf<double, D> on_curve = point<D>(piece, t);
      CHECK((line.position(a.s + t * (b.s - a.s)) - on_curve).norm() <= 64 * eps);
    }
  });
}

TEST_CASE("a position is a point of the curve, in the plane and in space", "[centreline]") {
  Random random(93);
  const Nodes nodes = ragged(random);
  check_positions(view(nodes));
  check_positions(view(nodes, false));
  std::vector<RodNode<double>> in_space;
  for (const auto& node : nodes)
    in_space.push_back(
        {node.s, {random(1), random(1), random(1)}, {random(1), random(1), random(1)}, {0, 1, 0}});
  check_positions(Centreline<double, 3>(in_space.data(), static_cast<int>(in_space.size())));
}

// A node belongs to the piece on its right, the last one to that on its left.
TEST_CASE("at a node the displacements are the node's, its turns included", "[centreline]") {
  for (const double turns : {0.3, 1.0, 4.6, -3.0}) {
    const Nodes nodes = circle(48, 2, turns * 2 * pi / 2);
    const Centreline<double> line = view(nodes);
    for (const auto& node : line) {
      const Displacement<double> at = line.at(node.s);
      CHECK(std::abs(at.u - node.u) <= 8 * eps);
      CHECK(std::abs(at.w - node.w) <= 8 * eps);
      CHECK(std::abs(at.theta - node.theta) <= 64 * eps * (1 + std::abs(node.theta)));
    }
  }
}

// Hermite's cubic is off by h⁴/384 of the fourth derivative, which is k³ on a circle, and its derivative by √3/216 h³ of
// it; the next terms are smaller by (kh)².
TEST_CASE("the error against a circle of three turns is k³h⁴/384 of the curve and k³h³√3/216 of its angle",
          "[centreline]") {
  const double length = 2, k = 3 * 2 * pi / length;
  std::vector<double> places;
  for (const int segments : {24, 48, 96}) {
    const Nodes nodes = circle(segments, length, k);
    const Centreline<double> line = view(nodes);
    const double h = length / segments;
    double place = 0, angle = 0;
    for (int j = 0; j <= 2000; ++j) {
      const double s = length * j / 2000;
      const Displacement<double> at = line.at(s);
      place = std::max(place, std::hypot(s + at.u - std::sin(k * s) / k, at.w - (std::cos(k * s) - 1) / k));
      angle = std::max(angle, std::abs(at.theta - k * s));
    }
    places.push_back(place);
    INFO(segments << " segments: place off by " << place << " m, angle by " << angle << " rad");
    CHECK(place <= std::pow(k, 3) * std::pow(h, 4) / 384 * (1 + k * h * k * h));
    CHECK(angle <= std::pow(k, 3) * std::pow(h, 3) * std::sqrt(3.) / 216 * (1 + k * h * k * h));
  }
  CHECK(observed_order(places[0], places[1]) >= 3.8);
  CHECK(observed_order(places[1], places[2]) >= 3.8);
}

// A circle that is stretched evenly is a larger one, whose points keep their arc positions.
TEST_CASE("the error of a stretched circle is of fourth order, too, and of a stretched straight line none",
          "[centreline]") {
  const double length = 2, k = 3 * 2 * pi / length;
  for (const double stretch : {-0.05, 0.002, 0.1, 0.5}) {
    std::vector<double> places;
    for (const int segments : {24, 48, 96}) {
      Nodes nodes = circle(segments, length, k);
      for (auto& node : nodes) node.u += stretch * (node.s + node.u), node.w *= 1 + stretch;
      const Centreline<double> line = view(nodes);
      double place = 0;
      for (int j = 0; j <= 2000; ++j) {
        const double s = length * j / 2000;
        const Displacement<double> at = line.at(s);
        place = std::max(place, std::hypot(s + at.u - (1 + stretch) * std::sin(k * s) / k,
                                           at.w - (1 + stretch) * (std::cos(k * s) - 1) / k));
      }
      places.push_back(place);
    }
    CAPTURE(stretch, places[0], places[1], places[2]);
    const double h = length / 24;
    CHECK(places[0] <= (1 + stretch) * std::pow(k, 3) * std::pow(h, 4) / 384 * (1 + k * h * k * h));
    CHECK(observed_order(places[0], places[1]) >= 3.8);
    CHECK(observed_order(places[1], places[2]) >= 3.8);

    const Nodes straight = {{0, 0, 0, 0}, {0.3, 0.3 * stretch, 0, 0}, {1, stretch, 0, 0}};
    for (double s = 0; s <= 1; s += 1. / 64) CHECK(std::abs(view(straight).at(s).u - stretch * s) <= 4 * eps);
  }
}

// The angle between nodes is that of the tangent; a finite difference of the curve knows it up to whole turns, with h²/6
// of the third derivative over the first.
// Where a beam is pressed its tension has a kink: the shear force, which changes it along a bend, jumps there.
TEST_CASE("the stretch at a node where its slope jumps is known to second order", "[centreline]") {
  constexpr double k = 0.5, middle = 0.4, there = 1.01, left = 0.02, right = -0.03, bow = 0.05;
  const auto nodes_of = [&](int fine, double bowed) {
    Nodes nodes;
    const auto add = [&](double s) {
      const double x = s - middle, slope = x < 0 ? left : right,
                   a = x * (there + x * (slope / 2 +
                                         x * bowed / 3));  // its arc from the middle: da/dx is the stretch
      nodes.push_back({s, middle + std::sin(k * a) / k - s, (std::cos(k * a) - 1) / k, k * a});
    };
    for (int i = 0; i < 2 * fine; ++i) add(middle * i / (2 * fine));
    for (int i = 0; i <= 3 * fine; ++i) add(middle + (1 - middle) * i / (3 * fine));
    return nodes;
  };
  for (const int fine : {1, 2, 4}) {
    const double h = 0.2 / fine;  // on either side
    const Nodes linear = nodes_of(fine, 0), bowed = nodes_of(fine, bow);
    CHECK(relative_error(view(linear).stretch(2 * fine) - there, (right - left) * h / 4) <= 1e-3);
    CHECK(std::abs(view(linear).extrapolated_stretch(2 * fine) - there) <=
          std::pow(k * h, 6) / 100 + 8 * eps / h);
    CHECK(relative_error(view(bowed).extrapolated_stretch(2 * fine) - there, -2 * bow * h * h / 3) <= 1e-3);
  }
  // A side of one piece has nothing to say of how the stretch changes.
  const Nodes all = nodes_of(1, 0), few(all.begin() + 1, all.begin() + 4);
  CHECK(relative_error(view(few).extrapolated_stretch(1), view(few).stretch(1)) <= 4 * eps);
}

TEST_CASE("the angle is that of the curve's tangent, and passes every turn without a jump", "[centreline]") {
  const double length = 2, k = -5 * 2 * pi / length;
  const Nodes nodes = circle(60, length, k);
  const Centreline<double> line = view(nodes);
  double before = 0;
  for (int j = 1; j < 5000; ++j) {
    const double s = length * j / 5000, h = 1e-5;
    const int piece = line.segment_at(s);
    const double theta = line.at(s).theta;
    REQUIRE(std::abs(theta - before) <= 2 * std::abs(k) * length / 5000);
    before = theta;
    if (s - h < line[piece].s || s + h > line[piece + 1].s) continue;
    const Displacement<double> a = line.at(piece, s - h), b = line.at(piece, s + h);
    const double angle = std::atan2(a.w - b.w, 2 * h + b.u - a.u);
    const double turns = (theta - angle) / (2 * pi);
    REQUIRE(std::abs(turns - std::nearbyint(turns)) <= k * k * h * h + 1e-9);
  }
}

// Where slopes are small, cos θ = 1 - δ²/2 and sin θ = θ - δ³/6: the two kinds of pieces draw the same.
TEST_CASE("for small slopes the curve is that of moderate rotation, to the square of the slope",
          "[centreline]") {
  const auto difference = [](double slope) {
    Nodes nodes;
    for (int i = 0; i <= 8; ++i) {
      const double s = i / 8.0;
      nodes.push_back({s, -slope * slope / 4 * s, slope / 3 * std::sin(3 * s), -slope * std::cos(3 * s)});
    }
    const Centreline<double> any = view(nodes), moderate = view(nodes, false);
    double worst = 0;
    for (double s = 0; s <= 1; s += 1. / 256) {
      const Displacement<double> a = any.at(s), b = moderate.at(s);
      worst = std::max({worst, std::abs(a.u - b.u), std::abs(a.w - b.w), std::abs(a.theta - b.theta) / 8});
    }
    return worst;
  };
  CHECK(difference(0.1) <= 0.1 * 0.1);
  CHECK(difference(0.05) <= 0.05 * 0.05);
  CHECK(observed_order(difference(0.02), difference(0.01)) >= 1.8);
}
