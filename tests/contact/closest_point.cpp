// Nearest point and crossings of one plane cubic: against sampling and against shapes that are known.
#include <algorithm>
#include <cmath>
#include <random>

#include "../support/catch.hpp"
#include <hapbeam/contact/closest_point.hpp>

using hapbeam::CubicSegment;
using Vector = hapbeam::Vector2<double>;

namespace {

Vector point_at(const CubicSegment<double>& b, double t) {
  const double r = 1 - t;
  return r * r * r * b.col(0) + 3 * r * r * t * b.col(1) + 3 * r * t * t * b.col(2) + t * t * t * b.col(3);
}

// A cubic in plain numbers, by its powers of t: independent of the code under test, and quick unoptimised.
class Sampled {
 public:
  explicit Sampled(const CubicSegment<double>& b) {
    for (int k = 0; k < 2; ++k) {
      c_[k][0] = b(k, 0);
      c_[k][1] = 3 * (b(k, 1) - b(k, 0));
      c_[k][2] = 3 * (b(k, 2) - 2 * b(k, 1) + b(k, 0));
      c_[k][3] = b(k, 3) - b(k, 0) + 3 * (b(k, 1) - b(k, 2));
    }
    for (int i = 0; i <= samples; ++i) x_[i] = x(double(i) / samples), y_[i] = y(double(i) / samples);
  }

  // Nearest sample, then golden sections around each sampled minimum.
  double distance(const Vector& q) const {
    const double qx = q.x(), qy = q.y();
    double d[samples + 1];
    for (int i = 0; i <= samples; ++i) d[i] = std::hypot(x_[i] - qx, y_[i] - qy);
    const auto exact = [&](double t) { return std::hypot(x(t) - qx, y(t) - qy); };
    double best = std::min(d[0], d[samples]);
    for (int i = 0; i <= samples; ++i) {
      if ((i > 0 && d[i - 1] < d[i]) || (i < samples && d[i + 1] < d[i])) continue;
      double low = std::max(0, i - 1) / double(samples), high = std::min(samples, i + 1) / double(samples);
      for (int k = 0; k < 70; ++k) {
        const double a = low + 0.381966 * (high - low), b = high - 0.381966 * (high - low);
        if (exact(a) < exact(b)) high = b;
        else low = a;
      }
      best = std::min(best, exact((low + high) / 2));
    }
    return best;
  }

  static constexpr int samples = 400;
  double x(double t) const { return value(0, t); }
  double y(double t) const { return value(1, t); }

 private:
  double value(int k, double t) const { return c_[k][0] + t * (c_[k][1] + t * (c_[k][2] + t * c_[k][3])); }

  double c_[2][4];
  double x_[samples + 1], y_[samples + 1];
};

CubicSegment<double> random_cubic(std::mt19937& random) {
  std::uniform_real_distribution<double> both(-1, 1);
  CubicSegment<double> b;
  for (int k = 0; k < 8; ++k) b(k) = both(random);
  return b;
}

}  // namespace

TEST_CASE("closest_point is the global minimum, on cubics with loops, cusps and S-bends") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> both(-1.5, 1.5);
  double worst = 0;
  for (int i = 0; i < 1500; ++i) {
    CubicSegment<double> b = random_cubic(random);
    if (i % 10 == 1) b.col(1) = b.col(0);                       // a cusp at the start
    if (i % 10 == 2) b.col(2) = b.col(1) = b.col(0);            // and a sharper one
    if (i % 10 == 3) b.col(2) = b.col(0), b.col(1) = b.col(3);  // there and back
    if (i % 10 == 4) b.row(1).setZero();                        // flat, and folded back on itself
    if (i % 10 == 5) b.colwise() = Vector(b.col(0));            // a point
    const Sampled sampled(b);
    for (int k = 0; k < 5; ++k) {
      const Vector q(both(random), both(random));
      const auto found = hapbeam::closest_point(b, q);
      REQUIRE((found.t >= 0 && found.t <= 1));
      REQUIRE((point_at(b, found.t) + found.offset - q).norm() < 1e-14);
      if (i % 10 > 5 && found.t > 0 && found.t < 1) {
        const Vector along = hapbeam::tangent(b, found.t);
        REQUIRE(std::abs(found.offset.dot(along)) < 1e-10 * along.norm());
      }
      worst = std::max(worst, std::abs(std::sqrt(found.distance_squared) - sampled.distance(q)));
    }
  }
  CHECK(worst < 1e-9);
}

TEST_CASE("closest_point finds a point of the cubic itself at distance zero") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const CubicSegment<double> b = random_cubic(random);
    CHECK(std::sqrt(hapbeam::closest_point(b, point_at(b, unit(random))).distance_squared) < 1e-12);
  }
}

TEST_CASE("closest_point at an end is exact, and prefers the start") {
  CubicSegment<double> b;
  b << 0, 1, 2, 3, 0, 0, 0, 0;
  CHECK(hapbeam::closest_point(b, Vector(-1, 1)).t == 0);
  CHECK(hapbeam::closest_point(b, Vector(0, 1)).t == 0);
  CHECK(hapbeam::closest_point(b, Vector(4, 1)).t == 1);
  CHECK(hapbeam::closest_point(b, Vector(3, 1)).t == 1);
  CHECK(hapbeam::closest_point(b, Vector(1.2, 1)).t == Approx(0.4).epsilon(1e-15));
  b << 0, 1, 1, 0, 0, 0, 1, 1;  // symmetric about y = 1/2
  CHECK(hapbeam::closest_point(b, Vector(-5, 0.5)).t == 0);
}

TEST_CASE("closest_point where all points are about equally near: the centre of a circular arc") {
  const double k = 4.0 / 3 * (std::sqrt(2.0) - 1);  // quarter circle, radius 1 + 2.7e-4 at most
  CubicSegment<double> b;
  b << 1, 1, k, 0, 0, k, 1, 1;
  for (const double off : {0.0, 1e-16, 1e-12, 1e-8, 1e-4}) {
    const Vector q(off, -off / 3);
    CHECK(std::abs(std::sqrt(hapbeam::closest_point(b, q).distance_squared) - Sampled(b).distance(q)) <
          1e-12);
  }
}

TEST_CASE("closest_point in float") {
  std::mt19937 random(3);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const CubicSegment<float> b = random_cubic(random).cast<float>();
    const hapbeam::Vector2<float> q = Vector(random_cubic(random).col(0)).cast<float>();
    const double reference = Sampled(b.cast<double>()).distance(q.cast<double>());
    worst = std::max(worst,
                     std::abs(std::sqrt(double(hapbeam::closest_point(b, q).distance_squared)) - reference));
  }
  CHECK(worst < 2e-5);
}

TEST_CASE("a path crosses a cubic as often, and in the same sense, as its sampled polygon") {
  std::mt19937 random(4);
  int crossed = 0;
  for (int i = 0; i < 3000; ++i) {
    const CubicSegment<double> b = random_cubic(random);
    const Vector p0 = random_cubic(random).col(0), p1 = random_cubic(random).col(0), path = p1 - p0;
    int count = 0, net = 0;
    bool unclear = false;
    const Sampled curve(b);
    const double length_squared = path.squaredNorm();
    double last_x = b(0, 0) - p0.x(), last_y = b(1, 0) - p0.y();
    double last_side = path.x() * last_y - path.y() * last_x;
    constexpr int samples = 2000;
    for (int k = 1; k <= samples; ++k) {
      const double x = curve.x(double(k) / samples) - p0.x(), y = curve.y(double(k) / samples) - p0.y();
      const double side = path.x() * y - path.y() * x;
      if ((last_side < 0) != (side < 0)) {
        const double f = last_side / (last_side - side);
        const double along =
            (path.x() * (last_x + f * (x - last_x)) + path.y() * (last_y + f * (y - last_y))) /
            length_squared;
        unclear |= std::abs(along) < 1e-3 || std::abs(along - 1) < 1e-3;
        if (along >= 0 && along <= 1) {
          ++count;
          net += last_side < 0 ? 1 : -1;
        }
      }
      unclear |= std::abs(side) < 1e-6;  // touches the line, perhaps
      last_x = x, last_y = y, last_side = side;
    }
    if (unclear) continue;
    const hapbeam::Crossings found = hapbeam::crossings(b, p0, p1);
    REQUIRE(found.count == count);
    REQUIRE(found.net == net);
    crossed += count > 0;
  }
  CHECK(crossed > 300);
}
