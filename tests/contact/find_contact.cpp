// Contact of a disc with a deformed beam: the depth against sampling, the side against what a hand would say.
#include <algorithm>
#include <cmath>
#include <limits>

#include "../support/catch.hpp"
#include "curves.hpp"
#include <hapbeam/contact/find_contact.hpp>

using namespace hapbeam;

namespace {

using Vector = Vector2<double>;
constexpr double thickness = 2e-3, radius = 5e-3, reach = radius + thickness / 2;

/// A beam and one avatar with its memory.
template <typename Scalar>
struct Scene {
  Curve<Scalar> curve;
  BoundingVolumes<Scalar> volumes;
  ContactMemory<Scalar> memory{};

  explicit Scene(Curve<Scalar> c) : curve(std::move(c)), volumes(curve.line().segments()) {
    volumes.refit(curve.line());
  }
  Contact<Scalar> move_to(Scalar x, Scalar w) {
    return find_contact<Scalar>({{x, w}, Scalar(radius)}, curve.line(), volumes, Scalar(thickness), memory);
  }
};

/// Distance to the curve by sampling Centreline::at, then by golden sections around each sampled minimum.
class SampledCurve {
 public:
  explicit SampledCurve(const Centreline<double>& line) : line_(line) {
    for (int i = 0; i < line.segments(); ++i)
      for (int k = 0; k < per_piece; ++k) add(line[i].s + (line[i + 1].s - line[i].s) * k / per_piece);
    add(line.length());
  }

  double distance(const Vector& q) const {
    std::vector<double> d(x_.size());
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = std::hypot(x_[i] - q.x(), y_[i] - q.y());
    double best = *std::min_element(d.begin(), d.end());
    const double worth = best + coarse_;
    for (std::size_t i = 0; i < d.size(); ++i) {
      const bool first = i == 0, last = i + 1 == d.size();
      if (d[i] > worth || (!first && d[i - 1] < d[i]) || (!last && d[i + 1] < d[i])) continue;
      if (!first)
        best = std::min(best, least(s_[i - 1], s_[i], q));  // apart, because the sample may be a node
      if (!last) best = std::min(best, least(s_[i], s_[i + 1], q));
    }
    return best;
  }

 private:
  static constexpr int per_piece = 64;

  void add(double s) {
    const auto d = line_.at(s);
    s_.push_back(s), x_.push_back(s + d.u), y_.push_back(d.w);
    if (s_.size() > 1)
      coarse_ = std::max(coarse_, std::hypot(x_.back() - x_[x_.size() - 2], y_.back() - y_[y_.size() - 2]));
  }
  double least(double low, double high, const Vector& q) const {
    while (high - low > 1e-12 * line_.length()) {
      const double a = low + 0.381966 * (high - low), b = high - 0.381966 * (high - low);
      if (exact(a, q) < exact(b, q)) high = b;
      else low = a;
    }
    return exact((low + high) / 2, q);
  }
  double exact(double s, const Vector& q) const {
    const auto d = line_.at(s);
    return std::hypot(s + d.u - q.x(), d.w - q.y());
  }

  Centreline<double> line_;
  std::vector<double> s_, x_, y_;
  double coarse_ = 0;
};

double worst_depth_error(int avatars, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(-0.2, 1.2), across(-0.5, 0.5), close(-3 * reach, 3 * reach);
  std::uniform_int_distribution<int> pieces(1, 12);
  double worst = 0;
  for (int i = 0; i < avatars; i += 250) {
    const Shape shape = all_shapes[(i / 250) % 5];
    Scene<double> scene(random_curve<double>(shape, pieces(random), random));
    const auto line = scene.curve.line();
    const SampledCurve sampled(line);
    for (int k = 0; k < 250; ++k) {
      Vector q(along(random), across(random));
      if (k % 2) {  // beside the beam
        const double s = std::clamp(q.x(), 0.0, 1.0);
        const auto d = line.at(s);
        q = Vector(s + d.u + close(random), d.w + close(random));
      }
      scene.memory = {};
      const auto contact = scene.move_to(q.x(), q.y());
      worst = std::max(worst, std::abs(contact.depth - (reach - sampled.distance(q))));

      REQUIRE(contact.touching == (contact.depth > 0));
      const auto d = line.at(contact.segment, contact.s);
      REQUIRE((contact.foot - Vector(contact.s + d.u, d.w)).norm() < 1e-13);
      REQUIRE((contact.foot + contact.normal * thickness / 2 - contact.point).norm() < 1e-15);
      REQUIRE(std::abs(contact.normal.norm() - 1) < 1e-14);
      // The normal leads from the foot to the centre, or the pieces' tangents jump there.
      REQUIRE((q - contact.foot - contact.normal * (reach - contact.depth)).norm() < 1e-8);
      // Above and below mean what they say wherever the beam is a graph over x.
      const double start = line[0].u, end = line.length() + line[line.segments()].u;
      if (shape != Shape::ragged && !contact.past_end && q.x() > start && q.x() < end) {
        const double height = q.y() - scene.curve.line().at((q.x() - start) / (end - start)).w;
        if (std::abs(height) > 1e-9) REQUIRE(contact.side == (height > 0 ? 1 : -1));
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("depth of 100000 avatars at straight, bent and ragged beams equals sampling") {
  CHECK(worst_depth_error(100000, 11) < 1e-9);
}

TEST_CASE("depth in float is within round-off of a metre") {
  std::mt19937 random(12);
  std::uniform_real_distribution<float> along(-0.2f, 1.2f), across(-0.5f, 0.5f);
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    Scene<float> scene(random_curve<float>(all_shapes[i % 5], 1 + i % 9, random));
    Curve<double> same;
    for (const auto& n : scene.curve.nodes) same.nodes.push_back({n.s, n.u, n.w, n.theta});
    Scene<double> reference(std::move(same));
    const float x = along(random), w = across(random);
    worst = std::max(worst, std::abs(double(scene.move_to(x, w).depth) - reference.move_to(x, w).depth));
  }
  CHECK(worst < 20 * std::numeric_limits<float>::epsilon());
}

TEST_CASE("the beam's thickness and the avatar's radius add up, from both sides and at round ends") {
  Scene<double> scene(straight_curve<double>(4, 1));
  const auto above = scene.move_to(0.3, reach - 1e-4);
  CHECK(above.touching);
  CHECK(above.depth == Approx(1e-4).epsilon(1e-9));
  CHECK(above.s == Approx(0.3));
  CHECK(above.segment == 1);
  CHECK(above.side == 1);
  CHECK((above.point - Vector(0.3, thickness / 2)).norm() < 1e-15);
  CHECK((above.normal - Vector(0, 1)).norm() < 1e-15);

  scene.memory = {};
  const auto below = scene.move_to(0.5, -reach - 1e-4);
  CHECK_FALSE(below.touching);
  CHECK(below.depth == Approx(-1e-4).epsilon(1e-9));
  CHECK(below.side == -1);
  CHECK((below.normal - Vector(0, -1)).norm() < 1e-15);

  scene.memory = {};
  const auto past = scene.move_to(1 + 0.6 * radius, 0.8 * radius);
  CHECK(past.past_end);
  CHECK(past.s == 1);
  CHECK(past.depth == Approx(thickness / 2));
  CHECK((past.normal - Vector(0.6, 0.8)).norm() < 1e-13);
}

TEST_CASE("the side is kept while the avatar is pushed through, to any depth, and back") {
  for (const int side : {1, -1}) {
    Scene<double> scene(straight_curve<double>(8, 1));
    for (int mm = 8; mm >= -300; --mm) {
      const auto contact = scene.move_to(0.4, side * mm * 1e-3);
      CHECK(contact.side == side);
      CHECK(contact.depth == Approx(reach - mm * 1e-3).margin(1e-15));
      CHECK(contact.touching == (contact.depth > 0));
      CHECK(contact.normal.y() == side);
      CHECK(contact.point.y() == side * thickness / 2);
    }
    for (int mm = -300; mm <= 8; ++mm) {
      const auto contact = scene.move_to(0.4, side * mm * 1e-3);
      CHECK(contact.depth == Approx(reach - mm * 1e-3).margin(1e-15));
      CHECK(contact.touching == (mm < 6));
    }
  }
}

TEST_CASE("a step through the beam is contact, whatever its length") {
  for (const int side : {1, -1}) {
    for (const double step : {8e-3, 2e-2, 2e-1, 100 * thickness, 100.0}) {
      Scene<double> scene(straight_curve<double>(8, 1));
      REQUIRE_FALSE(scene.move_to(0.4, side * 7e-3).touching);
      const double w = 7e-3 - step;
      const auto contact = scene.move_to(0.4, side * w);
      CHECK(contact.touching);
      CHECK(contact.side == side);
      CHECK(contact.depth == Approx(reach - w).epsilon(1e-12));
      CHECK(contact.normal.y() == side);
      CHECK(scene.move_to(0.5, side * w).touching);  // and stays so
      CHECK_FALSE(scene.move_to(0.5, side * 7e-3).touching);
    }
  }
}

TEST_CASE("a step through the beam and back, in one tick, is no contact") {
  Scene<double> scene(sampled_curve<double>(
      8, 1, [](double s) { return -0.4 * s * (1 - s); }, [](double s) { return -0.4 * (1 - 2 * s); }));
  REQUIRE_FALSE(scene.move_to(0.02, 0.05).touching);
  CHECK_FALSE(scene.move_to(0.02, -0.05).side == -1);  // through once
  scene.memory = {};
  REQUIRE(scene.move_to(0, -0.05).side == -1);   // below the valley's left slope
  const auto contact = scene.move_to(1, -0.05);  // and now its right one: in and out again
  CHECK_FALSE(contact.touching);
  CHECK(contact.side == -1);
}

TEST_CASE("one jump is the same contact as the same way in small steps") {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> along(0.05, 0.95), across(-0.4, 0.4);
  int jumped_through = 0;
  for (int i = 0; i < 1500; ++i) {
    Scene<double> jump(random_curve<double>(all_shapes[i % 4], 1 + i % 10, random));
    Scene<double> walk(jump.curve);
    const Vector from(along(random), across(random)), to(along(random), across(random));
    if (jump.move_to(from.x(), from.y()).touching) continue;
    bool ended = false;
    Contact<double> expected;
    for (int k = 0; k <= 200; ++k) {
      const Vector q = from + (to - from) * (k / 200.0);
      expected = walk.move_to(q.x(), q.y());
      ended |= expected.past_end;
    }
    if (ended) continue;
    const auto contact = jump.move_to(to.x(), to.y());
    REQUIRE(contact.touching == expected.touching);
    REQUIRE(contact.side == expected.side);
    REQUIRE(std::abs(contact.depth - expected.depth) < 1e-12);
    jumped_through += contact.depth > reach;
  }
  CHECK(jumped_through > 250);
}

TEST_CASE("round the free end the side changes without contact or with a little, never with a jump") {
  Scene<double> scene(straight_curve<double>(6, 1));
  for (const double distance : {1.5 * reach, 0.9 * reach}) {
    scene.memory = {};
    double last = reach - distance;
    scene.move_to(0.97, distance);
    for (double angle = 90; angle >= -90; angle -= 0.5) {
      const double a = angle * std::acos(-1.0) / 180;
      const auto contact = scene.move_to(1 + distance * std::cos(a), distance * std::sin(a));
      CHECK(contact.depth == Approx(last).margin(1e-9));
      CHECK(contact.normal.dot(Vector(std::cos(a), std::sin(a))) == Approx(1));
    }
    const auto below = scene.move_to(0.97, -distance);
    CHECK(below.side == -1);
    CHECK(below.depth == Approx(last).margin(1e-9));
  }
}

TEST_CASE("a jump round the free end is no contact") {
  Scene<double> scene(straight_curve<double>(6, 1));
  scene.move_to(0.9, 0.1);
  scene.move_to(1.2, 0.1);
  CHECK_FALSE(scene.move_to(1.2, -0.1).touching);
  const auto contact = scene.move_to(0.9, -0.1);
  CHECK_FALSE(contact.touching);
  CHECK(contact.side == -1);
}

TEST_CASE("an avatar that slides off the end is free, however deep it was, and may return on either side") {
  Scene<double> scene(straight_curve<double>(6, 1));
  scene.move_to(0.9, 0.01);
  CHECK(scene.move_to(0.9, -0.05).depth == Approx(reach + 0.05));
  CHECK(scene.move_to(0.999, -0.05).side == 1);
  const auto off = scene.move_to(1.001, -0.05);
  CHECK(off.past_end);
  CHECK_FALSE(off.touching);
  CHECK(off.side == -1);
  CHECK_FALSE(scene.move_to(0.999, -0.05).touching);
  CHECK(scene.move_to(0.9, 0.05).side == -1);  // through from below
}

TEST_CASE("an avatar that was deep and is barely past the end keeps its side") {
  Scene<double> scene(straight_curve<double>(6, 1));
  scene.move_to(0.99, 0.01);
  CHECK(scene.move_to(0.99, -0.004).side == 1);
  CHECK(scene.move_to(1.001, -0.004).touching);
  const auto back = scene.move_to(0.99, -0.004);
  CHECK(back.side == 1);
  CHECK(back.depth == Approx(reach + 0.004));

  scene.memory = {};
  scene.move_to(0.99, 0.01);
  CHECK(scene.move_to(1.0001, -0.004).touching);  // the same in one step
  CHECK(scene.move_to(0.99, -0.004).side == 1);
}

TEST_CASE("an avatar on the centreline itself is on the side where it came from") {
  for (const double from : {0.02, -0.02}) {
    Scene<double> scene(straight_curve<double>(4, 1));
    scene.move_to(0.3, from);
    const auto contact = scene.move_to(0.3, 0);
    CHECK(contact.side == (from > 0 ? 1 : -1));
    CHECK(contact.depth == reach);
    CHECK(contact.normal.y() == (from > 0 ? 1 : -1));
    CHECK(scene.move_to(0.3, -from).depth == Approx(reach + 0.02));
  }
  Scene<double> scene(straight_curve<double>(4, 1));
  CHECK(scene.move_to(0.5, 0).depth == reach);  // at a node, out of nowhere

  std::mt19937 random(15);
  std::uniform_real_distribution<double> across(0.01, 0.05), along(-0.001, 0.001);
  for (int i = 0; i < 1000; ++i) {
    Scene<double> bent(random_curve<double>(Shape::wavy, 8, random));
    const auto& node = bent.curve.nodes[4];
    const int side = i % 2 ? 1 : -1;
    const Vector2<double> from(node.s + node.u + along(random), node.w + side * across(random));
    // As far as round-off tells, that is.
    for (const double to : {node.w, std::nextafter(node.w, -1.0), std::nextafter(node.w, 1.0)}) {
      bent.memory = {};
      bent.move_to(from.x(), from.y());
      REQUIRE(bent.move_to(node.s + node.u, to).side == side);
    }
  }
}

TEST_CASE("an avatar that begins inside the beam is on the side where it is") {
  Scene<double> scene(straight_curve<double>(4, 1));
  const auto contact = scene.move_to(0.3, -1e-3);
  CHECK(contact.touching);
  CHECK(contact.side == -1);
}

TEST_CASE("a position that is not a number answers nothing and changes nothing") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const Vector& bad :
       {Vector(nan, 0), Vector(0.4, nan), Vector(inf, 0), Vector(0.4, -inf), Vector(1e200, 1e200)}) {
    Scene<double> scene(straight_curve<double>(4, 1));
    scene.move_to(0.4, 0.007);
    const auto contact = scene.move_to(bad.x(), bad.y());
    CHECK_FALSE(contact.touching);
    CHECK(contact.segment == -1);
    CHECK((contact.depth == 0 && contact.point.isZero() && contact.normal.isZero()));
    CHECK_FALSE(out_of_reach<double>({bad, radius}, scene.volumes, thickness, scene.memory));
    CHECK(scene.memory.place == Vector(0.4, 0.007));
    CHECK(scene.move_to(0.4, -0.1).depth ==
          Approx(0.1 + reach));  // the step is seen from the last good position
    ContactMemory<double> nothing;
    CHECK_FALSE(out_of_reach<double>({bad, radius}, scene.volumes, thickness, nothing));
    CHECK_FALSE(nothing.known);
    CHECK_FALSE(scene.move_to(bad.x(), bad.y()).touching);
    CHECK(scene.move_to(0.4, -0.1).side == 1);  // and the touch is not forgotten
  }
}

TEST_CASE("out_of_reach is true only where find_contact finds none, and mostly there") {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> along(-0.5, 1.5), across(-0.6, 0.6), small(-0.02, 0.02);
  int skipped = 0, free = 0;
  for (int i = 0; i < 300; ++i) {
    Scene<double> scene(random_curve<double>(all_shapes[i % 5], 1 + i % 10, random)), quick(scene.curve);
    Vector q(along(random), across(random));
    for (int k = 0; k < 100; ++k) {
      q = k % 10 ? Vector(q.x() + small(random), q.y() + small(random))
                 : Vector(along(random), across(random));
      const auto expected = scene.move_to(q.x(), q.y());
      free += !expected.touching;
      if (out_of_reach<double>({q, radius}, quick.volumes, thickness, quick.memory)) {
        ++skipped;
        REQUIRE_FALSE(expected.touching);
      } else {
        const auto contact = quick.move_to(q.x(), q.y());
        REQUIRE(contact.touching == expected.touching);
        REQUIRE(contact.depth == expected.depth);
        REQUIRE(contact.side == expected.side);
      }
    }
  }
  CHECK(skipped > free / 3);
}

TEST_CASE("find_contact cannot throw") {
  STATIC_REQUIRE(noexcept(find_contact<double>(
      std::declval<const Avatar<double>&>(), std::declval<const Centreline<double>&>(),
      std::declval<const BoundingVolumes<double>&>(), 0.0, std::declval<ContactMemory<double>&>())));
}
