// Rods tied in an overhand knot, and how a test sees that they still are.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "body_scenes.hpp"
#include <hapbeam/shapes.hpp>
#include <hapbeam/world/world.hpp>

namespace hapbeam::testing {

/// A rod in an overhand knot, and two hands that hold its ends.
template <class Element>
class KnottedRod {
 public:
  KnottedRod(double l, double d, double young, double R, int elements, const Friction& friction = {})
      : KnottedRod(l, d, young, overhand_knot(l, d, R), elements, friction) {}

  /// Both hands go from each other.   @param by  each of them [m]
  Status pull(double by) { return move({-by, 0, 0}, {by, 0, 0}); }
  Status move(const Point& left_by, const Point& right_by) {
    left.at += left_by, right.at += right_by;
    const Status one = world.hold(0, RodSide::left, left), other = world.hold(0, RodSide::right, right);
    return one == Status::ok && other == Status::ok ? world.tick() : Status::invalid_request;
  }
  double tension() const { return world.held(0, RodSide::right).force.x(); }
  /// Of a circle of as much rod as the hands are nearer to each other than it is long.
  double radius() const { return (length - (right.at - left.at).norm()) / (2 * pi); }
  /// Least distance of two points that are farther apart along the rod [thicknesses].
  double closest(double apart) const {
    const auto points = line(800);
    const std::size_t skip = static_cast<std::size_t>(apart / length * 800);
    double least = length * length;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + skip; j < points.size(); ++j)
        least = std::min(least, (points[i] - points[j]).squaredNorm());
    return std::sqrt(least) / thickness;
  }
  /// |det| of its colouring equations, its ends joined far away: 1 of what is not knotted, 3 of a trefoil.
  int determinant() const {
    std::vector<Point> p = line(240);
    const double far_off = 10 * length;
    p.insert(p.begin(), Point(left.at.x() - far_off, left.at.y(), left.at.z()));
    p.push_back(Point(right.at.x() + far_off, right.at.y(), right.at.z()));
    p.push_back(Point(right.at.x() + far_off, -far_off, 0)),
        p.push_back(Point(left.at.x() - far_off, -far_off, 0));
    // Seen from a direction in which no two pieces lie above each other for long.
    const Motion view{detail::unit(Point(0.3, -0.5, 0.8)), 0.1};
    for (Point& x : p) x = view(x);
    struct Crossing {
      double under, over;
    };
    std::vector<Crossing> crossings;
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j) {
        if (i == 0 && j == n - 1) continue;
        const Point a = p[(i + 1) % n] - p[i], b = p[(j + 1) % n] - p[j], off = p[j] - p[i];
        const double d = a.x() * b.y() - a.y() * b.x(), t = (off.x() * b.y() - off.y() * b.x()) / d,
                     u = (off.x() * a.y() - off.y() * a.x()) / d;
        if (!(t >= 0 && t < 1 && u >= 0 && u < 1)) continue;
        const bool first_above = p[i].z() + t * a.z() > p[j].z() + u * b.z();
        const double at_i = double(i) + t, at_j = double(j) + u;
        crossings.push_back(first_above ? Crossing{at_j, at_i} : Crossing{at_i, at_j});
      }
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.under < b.under; });
    // An arc leads from one place below to the next; 2 over = before + after, without the last arc and crossing.
    const std::size_t m = crossings.size();
    if (m < 3) return 1;
    const auto arc = [&](double s) {
      std::size_t k = 0;
      while (k < m && crossings[k].under < s) ++k;
      return k % m;
    };
    std::vector<std::vector<double>> A(m - 1, std::vector<double>(m - 1, 0.0));
    for (std::size_t k = 0; k + 1 < m; ++k) {
      const auto add = [&](std::size_t at, double x) {
        if (at + 1 < m) A[k][at] += x;
      };
      add(arc(crossings[k].over), 2), add(k, -1), add((k + 1) % m, -1);
    }
    double det = 1;
    for (std::size_t c = 0; c + 1 < m; ++c) {
      std::size_t best = c;
      for (std::size_t r = c; r + 1 < m; ++r)
        if (std::abs(A[r][c]) > std::abs(A[best][c])) best = r;
      std::swap(A[c], A[best]);
      det *= A[c][c];
      if (A[c][c] == 0) return 0;
      for (std::size_t r = c + 1; r + 1 < m; ++r) {
        const double f = A[r][c] / A[c][c];
        for (std::size_t q = c; q + 1 < m; ++q) A[r][q] -= f * A[c][q];
      }
    }
    return static_cast<int>(std::lround(std::abs(det)));
  }
  bool finite() const {
    const HeldEnd<double> a = world.held(0, RodSide::left), b = world.held(0, RodSide::right);
    return a.force.allFinite() && a.moment.allFinite() && b.force.allFinite() && line(20).back().allFinite();
  }
  std::vector<Point> line(int pieces) const {
    const Centreline<double, 3> shape = world.shape(0);
    std::vector<Point> points;
    for (int i = 0; i <= pieces; ++i) points.push_back(shape.at(length * i / pieces).r);
    return points;
  }

  double length, thickness, stiffness;  ///< EI last
  RodPose left, right;
  World<Element> world;

 private:
  KnottedRod(double l, double d, double young, const std::vector<Point>& points, int elements,
             const Friction& friction)
      : length(l),
        thickness(d),
        stiffness(young * pi * std::pow(d, 4) / 64),
        left{points.front(), {1, 0, 0}, {0, 1, 0}},
        right{points.back(), {1, 0, 0}, {0, 1, 0}},
        world({{rod(young), elements, friction, points}}) {}
  Rod rod(double young) const {
    Rod rod(length, RodSection::circle(thickness), RodMaterial::isotropic(young, 0.3), RodSupport::clamped,
            RodSupport::clamped);
    return rod.place_left(left).place_right(right);
  }
};

}  // namespace hapbeam::testing
