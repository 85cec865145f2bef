// The natural shape as a curve and as what elements bend against: exact for arcs of any length.
#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/body/natural_shape.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double eps = 2.2e-16;

template <typename Scalar = double>
NaturalShape<Scalar> natural(double length, std::vector<Arc> arcs) {
  return NaturalShape<Scalar>(
      Beam(length, 1, 1, 0.1, Support::clamped, Support::free).naturally(std::move(arcs)));
}

/// Curvature of a chain of arcs at s.
double curvature(const std::vector<Arc>& arcs, double s) {
  for (const Arc& arc : arcs)
    if (s < arc.end) return arc.curvature;
  return 0;
}

}  // namespace

TEST_CASE("an arc runs along its circle: x = sin(κs)/κ, w = (cos(κs) - 1)/κ, θ = κs", "[natural]") {
  for (const double k : {0.7, -3.0, 50.0, 1e-3}) {
    const NaturalShape<double> shape = natural(2, {{2, k}});
    for (const double s : {0.0, 0.1, 0.5, 1.3, 2.0}) {
      const Displacement<double> at = shape.at(s);
      INFO("curvature " << k << " at " << s);
      CHECK(std::abs(s + at.u - std::sin(k * s) / k) <= 4 * eps * (2 + 1 / std::abs(k)));
      CHECK(std::abs(at.w + 2 * std::pow(std::sin(k * s / 2), 2) / k) <= 4 * eps * 2);
      CHECK(std::abs(at.theta - k * s) <= 2 * eps * std::abs(k * s));
    }
  }
}

// An arc whose curvature vanishes is a straight piece, without a division by zero or a loss of digits on the way.
TEST_CASE("weak curvatures go over into the straight beam", "[natural]") {
  for (const double k : {0.0, 1e-300, -1e-20, 1e-9}) {
    const Displacement<double> at = natural(2, {{2, k}}).at(1.5);
    CHECK(std::abs(at.w + k * 1.5 * 1.5 / 2) <= 2 * eps * std::abs(k));
    CHECK(std::abs(at.u) <= k * k + 2 * eps);
    CHECK(at.theta == k * 1.5);
  }
}

// Where a curve has arcs and corners, its ends follow from θ(s) = ∫κ alone, here by the midpoint rule in 2¹⁶ pieces: h²/24
// of the second derivative, κ² <= 9, but a piece that holds a jump of κ is off by h² Δκ.
TEST_CASE("a chain of arcs is the integral of its curvature", "[natural]") {
  const std::vector<Arc> arcs{{0.25, 1.5}, {0.75, -3}, {0.875, 0}, {1.5, 2}};
  const NaturalShape<double> shape = natural(2, arcs);
  const int pieces = 1 << 16;
  const double h = 2.0 / pieces;
  double x = 0, w = 0, theta = 0;
  for (int i = 0; i < pieces; ++i) {
    const double k = curvature(arcs, (i + 0.5) * h), middle = theta + k * h / 2;
    x += h * std::cos(middle);
    w -= h * std::sin(middle);
    theta += k * h;
    if ((i + 1) % (pieces / 8) != 0) continue;
    const double s = (i + 1) * h;
    const Displacement<double> at = shape.at(s);
    CHECK(std::abs(s + at.u - x) <= 2 * 9 * h * h);
    CHECK(std::abs(at.w - w) <= 2 * 9 * h * h);
    CHECK(std::abs(at.theta - theta) <= 1e-11);
  }
}

TEST_CASE("a full circle comes home, having turned once", "[natural]") {
  const double length = 3;
  const Displacement<double> end = natural(length, {{length, 2 * pi / length}}).at(length);
  CHECK(std::abs(length + end.u) <= 4 * eps * length);
  CHECK(std::abs(end.w) <= 4 * eps * length);
  CHECK(std::abs(end.theta - 2 * pi) <= 8 * eps);
}

TEST_CASE("a beam without arcs is naturally straight", "[natural]") {
  const NaturalShape<double> shape = natural(2, {});
  CHECK(shape.straight());
  CHECK_FALSE(natural(2, {{1, 0.5}}).straight());
  ElementProperties<double> p(0.3, 1, 1);
  shape.apply(0.4, p);
  CHECK((p.natural_a == 0 && p.natural_b == 0 && p.natural_stretch == 0));
  const Displacement<double> at = shape.at(1.7);
  CHECK((at.u == 0 && at.w == 0 && at.theta == 0));
}

// On one arc the ends turn by half of its angle against the chord, wherever the element lies.
TEST_CASE("an element on one arc gets half of its angle at either end", "[natural]") {
  const double k = -1.3;
  const NaturalShape<double> shape = natural(2, {{2, k}});
  for (const double length : {0.01, 0.3, 1.0})
    for (const double s : {0.0, 0.4, 1.0}) {
      ElementProperties<double> p(length, 1, 1);
      shape.apply(s, p);
      CHECK(std::abs(p.natural_a + k * length * length / 2) <= 4 * eps * length);
      CHECK(std::abs(p.natural_b - k * length * length / 2) <= 4 * eps * length);
    }
}

// Where its ends stand: the chord from one to the other, and the curve's directions there against it.
TEST_CASE(
    "an element over arcs, corners and the straight rest takes the chord and the end rotations of its piece",
    "[natural]") {
  Random random(81);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Arc> arcs;
    double end = 0;
    for (int k = 0; k < 6; ++k) {
      end += random(0, 1) < 0.3 ? 1e-3 : random(0.05, 0.4);
      arcs.push_back({end, random(5)});
    }
    const NaturalShape<double> shape = natural(3, arcs);
    const double length = random(0.05, 1), s = trial % 5 == 0 ? arcs[1].end : random(0, 3 - length);
    const Displacement<double> a = shape.at(s), b = shape.at(s + length);
    const double x = length + b.u - a.u, y = b.w - a.w, chord = std::hypot(x, y);
    ElementProperties<double> p(length, 1, 1);
    shape.apply(s, p);
    INFO("from " << s << " over " << length);
    CHECK(std::abs(p.natural_stretch - (chord - length)) <= 64 * eps);
    CHECK(std::abs((p.natural_b - p.natural_a) / length - (b.theta - a.theta)) <= 64 * eps * 5);
    // The angle of the chord, counted against θ, is that of (x, y).
    const double angle = p.natural_a / length - a.theta;
    CHECK(std::abs(std::cos(angle) - x / chord) <= 64 * eps / chord);
    CHECK(std::abs(std::sin(angle) - y / chord) <= 64 * eps / chord);
  }
}

// The same arcs, in a float's last place: 2^-24 a step, of which a position takes about ten.
TEST_CASE("in float the natural shape is that of double to round-off", "[natural][float]") {
  const std::vector<Arc> arcs{{0.25, 1.5}, {0.75, -3}, {0.875, 0}, {1.5, 2}};
  const NaturalShape<double> shape = natural(2, arcs);
  const NaturalShape<float> rounded = natural<float>(2, arcs);
  for (int k = 0; k <= 64; ++k) {
    const double s = k / 32.0;
    const Displacement<double> at = shape.at(s);
    const Displacement<float> same = rounded.at(static_cast<float>(s));
    CHECK(std::abs(at.u - static_cast<double>(same.u)) <= 1e-6);
    CHECK(std::abs(at.w - static_cast<double>(same.w)) <= 1e-6);
    CHECK(std::abs(at.theta - static_cast<double>(same.theta)) <= 1e-6);
  }
}
