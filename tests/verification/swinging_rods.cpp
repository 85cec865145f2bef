// A round rod with mass, in space: a swing about two axes and a throw against p-versions of the elastica, energy, momentum, and a hand.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"
#include "support/csv.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Place = VectorOf<double, 3>;  // [m], or along
using Vector6d = VectorOf<double, 6>;
using Model = DynamicModel<RoundRod>;

/// Of length and EI 1, of mass 10⁻⁶: a thousand times as fast as the references, for no step is longer than 2 ms.   EA l²/EI = 1.7e4 of an element
Rod unit_rod(const RodSupport& left, const RodSupport& right) {
  const double d = 4 / std::sqrt(12 * 300. * 300.), area = pi * d * d / 4;
  return Rod(1, RodSection::circle(d),
             RodMaterial::isotropic(4 * 16 / (pi * d * d * d * d), 0.3, 1e-6 / area), left, right);
}
constexpr double fast = 1000;
double mode(double s) {
  const double beta = 1.8751040687119611, ratio = 0.7340955137589128;
  const auto at = [&](double x) { return std::sinh(x) + std::sin(x) - ratio * (std::cosh(x) - std::cos(x)); };
  return at(beta * s) / at(beta);
}

/// Its nodes as a shape.
struct Nodes {
  std::vector<RodNode<double>> nodes;
  Centreline<double, 3> shape() const { return {nodes.data(), static_cast<int>(nodes.size())}; }
};

}  // namespace

TEST_CASE("a round rod that swings about two axes goes where its elastica does", "[dynamics]") {
  const Csv path("space.csv");
  const int n = 8;
  Nodes start;
  std::vector<Vector6d> velocities;
  Place r(0, 0, 0), v(0, 0, 0);
  const auto along = [](double s, Place& t, Place& change) {
    const double p = mode(s), size = std::sqrt(1 + p * p);
    t = Place(1, p, 0) / size, change = Place(0, 0, 3 * p / size);
  };
  for (int i = 0; i <= n; ++i) {
    constexpr int parts = 1000;
    Place t, change;
    for (int k = 0; i > 0 && k < parts; ++k) {
      along((i - 1 + (k + 0.5) / parts) / n, t, change);
      r += t / (n * parts), v += change / (n * parts);
    }
    along(double(i) / n, t, change);
    start.nodes.push_back({double(i) / n, r, t, Place(t.y(), -t.x(), 0)});
    Vector6d both;
    both << fast * v, fast * change;
    velocities.push_back(both);
  }
  struct Expected {
    std::size_t steps;
    double error;
  };
  for (const Expected& expected : {Expected{400, 6e-4}, {1600, 2.2e-4}}) {
    Model model(unit_rod(RodSupport::clamped, RodSupport::free), n, 1);
    model.let_go_from(start.shape(),
                      [&](double s) { return velocities[static_cast<std::size_t>(std::lround(s * n))]; });
    const std::size_t rows = path.rows() - 1;  // of two periods
    const double energy = model.energy().sum(),
                 dt = path.number(rows, "t") / fast / (2 * static_cast<double>(expected.steps));
    CHECK(energy == Approx(0.973003403238893).epsilon(2e-3));
    double off = 0;
    for (std::size_t row = 1; row <= rows / 2; ++row) {
      for (std::size_t k = 0; k < 2 * expected.steps / rows; ++k) {
        REQUIRE(model.step(dt) == Status::ok);
        REQUIRE(model.energy().sum() <= energy * (1 + 1e-9));
      }
      const Place tip(path.number(row, "tip_x"), path.number(row, "tip_y"), path.number(row, "tip_z"));
      off = std::max(off, (model.shape().at(1).r - tip).norm());
    }
    CAPTURE(expected.steps, off);
    CHECK(off <= expected.error);
  }
}

// On springs that hold it by nothing.
TEST_CASE("a rod that is thrown spins and bends as its elastica does", "[dynamics]") {
  const Csv path("spin.csv");
  const RodSupport loose{1e-9, 1e-9, 1e-9, 0, 0, 0};
  const int n = 8;
  Model model(unit_rod(loose, loose), n, 1);
  Nodes start;
  for (int i = 0; i <= n; ++i)
    start.nodes.push_back({double(i) / n, Place(double(i) / n, 0, 0), Place(1, 0, 0), Place(0, 1, 0)});
  model.let_go_from(start.shape(), [&](double s) {
    Vector6d v = Vector6d::Zero();
    v[1] = fast * (6 * s + 4 * s * s - (3 + 4. / 3)), v[4] = fast * (6 + 8 * s);
    return v;
  });
  const double energy = model.energy().sum();
  const Place middle(0.5, 0, 0);
  double off = 0;
  const std::size_t rows = path.rows() - 1;
  for (std::size_t row = 1; row <= rows / 2; ++row) {
    for (int k = 0; k < 4; ++k) {
      REQUIRE(model.step((path.number(row, "t") - path.number(row - 1, "t")) / (4 * fast)) == Status::ok);
      REQUIRE(model.energy().sum() <= energy * (1 + 1e-9));
    }
    const Place left(path.number(row, "x0"), path.number(row, "y0"), 0),
        right(path.number(row, "tip_x"), path.number(row, "tip_y"), 0);
    off = std::max({off, (model.shape().at(0).r - middle - left).norm(),
                    (model.shape().at(1).r - middle - right).norm()});
  }
  CAPTURE(off);
  CHECK(off <= 1.3e-3);
}

TEST_CASE("a rod in space that is thrown keeps its momentum, and never has more energy", "[dynamics]") {
  const RodSupport loose{1e-12, 1e-12, 1e-12, 0, 0, 0};
  const Rod rod(0.3, RodSection::circle(0.002), RodMaterial::isotropic(200e9, 0.3, 7850), loose, loose);
  for (const double dt : {1e-3, 2.5e-4}) {
    Model model(rod, 8, 1);
    Nodes start;
    for (int i = 0; i <= 8; ++i)
      start.nodes.push_back({0.3 * i / 8, Place(0.3 * i / 8, 0, 0), Place(1, 0, 0), Place(0, 1, 0)});
    // Thrown, turned about two axes, and bent a little as it goes.
    const auto velocity = [](double s) {
      Vector6d v;
      v << 0.3, 5 * (s - 0.15) + 8 * s * s, 3 * (s - 0.15), 0, 5 + 16 * s, 3;
      return v;
    };
    model.let_go_from(start.shape(), velocity);
    // Of the centre of mass: the mean of the centreline's velocity, which is a cubic of an element.
    const auto mean = [&] {
      Place sum(0, 0, 0);
      for (int e = 0; e < 8; ++e)
        for (const double at : {0.21132486540518708, 0.78867513459481287})
          sum += model.velocity(0.3 * (e + at) / 8) / 16;
      return sum;
    };
    const Place begins = mean();
    const double energy = model.energy().sum();
    for (int k = 0; k * dt < 0.5; ++k) {
      REQUIRE(model.step(dt) == Status::ok);
      REQUIRE(model.energy().sum() <= energy * (1 + 1e-9));
    }
    CAPTURE(dt, (mean() - begins).norm(), model.energy().sum() / energy - 1);
    // What stretches an element by the last place of where it is pushes 7 g by 1e-9 N, to either side, 2000 times.
    CHECK((mean() - begins).norm() <= 1e-8 * begins.norm());
    CHECK(model.energy().sum() >= energy * (dt > 5e-4 ? 0.9 : 0.99));
  }
}

// 648 mm of steel, when it is tuned: an element that is exact under tension would leave it 134 cents flat at partial 5.
TEST_CASE("the partials of a string in space are those of its tension, and a hand on it is told of its error",
          "[dynamics]") {
  const Csv exact("string_E4.csv");
  const int n = 16;
  const double tension = 72.59131923866309, d = 0.000254, young = 200e9, length = 0.648,
               longer = 1 + tension / (young * pi * d * d / 4);
  Rod string(length / longer, RodSection::circle(d), RodMaterial::isotropic(young, 0.3, 7850 * longer),
             RodSupport::hinged, RodSupport::hinged);
  string.place_right({{length, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Model model(string, n, 1);
  for (int k = 1; k <= 10; ++k) {
    const double wave = k * pi / length, size = 1e-5,
                 hz = exact.number(static_cast<std::size_t>(k - 1), "pinned_Hz");
    Nodes start;
    for (int i = 0; i <= n; ++i) {
      const double x = length * i / n, slope = size * wave * std::cos(wave * x);
      start.nodes.push_back(
          {x / longer, Place(x, size * std::sin(wave * x), 0), longer * Place(1, slope, 0), Place(0, 0, 1)});
    }
    model.let_go_from(start.shape());
    // From its first zero on, ten periods.
    double before = 1, first = 0, last = 0, dt = 1.0 / 192000;
    for (int step = 1, zeros = 0; zeros <= 20; ++step) {
      REQUIRE(model.step(dt) == Status::ok);
      double now = 0;
      for (int i = 0; i <= n; ++i)
        now += std::sin(pi * k * i / n) * model.shape().at(length / longer * i / n).r.y();
      if (now * before < 0) {
        last = (step - now / (now - before)) * dt;
        if (zeros++ == 0) first = last;
      }
      before = now;
    }
    const double cents = 1200 * std::log2(10 / (last - first) / hz);
    CAPTURE(k, cents);
    CHECK(std::abs(cents) <= 1);
  }
  // Where it rests it is as stiff as its cubics.
  const double reach = 0.005, place = length / longer / 5;
  RodMaterial damped = RodMaterial::isotropic(young, 0.3, 7850 * longer);
  damped.damping.drag = 2000;
  Rod still(length / longer, RodSection::circle(d), damped, RodSupport::hinged, RodSupport::hinged);
  still.place_right({{length, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  Rod heavy = string;
  Model hangs(heavy.weight(7850, {0, 0, -9.81}), n);
  for (int k = 0; k < 20; ++k) REQUIRE(hangs.step(1e-3) == Status::ok);
  CHECK(hangs.energy().kinetic <= 1e-24);
  Model pressed(still, n);
  Pushed<double, 3> felt{0, Status::ok};
  for (int k = 0; k < 400; ++k)
    felt = pressed.step(1e-3, {{place,
                                {Place(length / 5, reach - 1e-5 * std::min(k, 300), 0), Place::Zero()},
                                reach,
                                Place(0, 1, 0)},
                               20000,
                               0});
  CHECK(felt.status == Status::out_of_range);
  const auto held = FemModel<RoundRod>(still, n).push(Push<double, 3>{felt.s, felt.point.y(), {0, 1, 0}});
  CAPTURE(felt.force, held.force);
  CHECK(felt.force < held.force);
  CHECK(felt.force == Approx(held.force).epsilon(0.02));
}

// What swings in a plane swings as the beam of that plane does, touched by a hand, too.
TEST_CASE("a hand feels of a rod what it feels of a beam in the plane", "[dynamics]") {
  const double d = 0.002, radius = 0.005;
  const Rod rod(0.3, RodSection::circle(d), RodMaterial::isotropic(200e9, 0.3, 7850), RodSupport::clamped,
                RodSupport::free);
  const Beam beam(0.3, Section::circle(d), Material{200e9, 7850}, Support::clamped, Support::free);
  Model model(rod, 16, 2);
  DynamicModel<> planar(beam, 16, 2);
  double most = 0, off = 0;
  int touched = 0;
  for (int k = 0; k < 400; ++k) {
    const double y = radius + 0.0005 - 0.004 * std::abs(std::sin(2 * pi * 4 * k * 1e-3)),
                 x = 0.21 + 0.02 * std::sin(0.01 * k);
    const auto in_space =
        model.step(1e-3, {{x, {Place(x, 0, y), Place::Zero()}, radius, Place(0, 0, 1)}, 2000, 1});
    const auto in_plane = planar.step(1e-3, {{x, {x, y}, radius, 1}, 2000, 1});
    REQUIRE(in_space.status == Status::ok);
    REQUIRE(in_plane.status == Status::ok);
    most = std::max(most, -in_plane.force);
    off = std::max(off, std::abs(in_space.force - in_plane.force));
    touched += in_space.force < 0;
  }
  CAPTURE(most, off);
  CHECK(touched > 100);
  CHECK(off <= 2e-3 * most);
}

TEST_CASE("a late loop gains nothing from a rod with mass, with friction or without", "[dynamics]") {
  const DeviceInfo device{"arm", Eigen::Vector3d::Ones(), 100, 100, 1e4, 0, 0, 1e-3, 5, 0.2};
  int touched = 0;
  for (const bool rough : {false, true})
    for (int loop = 36; loop < 48; ++loop) {  // each delay with each end, and each number of parts
      Random random(static_cast<std::uint64_t>(100 + loop));
      const int delay = loop % 4;
      const double length = random(0.1, 0.5), d = random(0.0005, 0.006), mass = std::pow(10, random(-3, 0)),
                   area = pi * d * d / 4;
      const double young =
          std::pow(10, random(2, 5)) * 64 * length * length * length / (3 * pi * d * d * d * d);
      const RodSupport right = loop % 3 == 0   ? RodSupport::free
                               : loop % 3 == 1 ? RodSupport::hinged
                                               : RodSupport::clamped;
      const Rod rod(length, RodSection::circle(d), RodMaterial::isotropic(young, 0.3, mass / (area * length)),
                    loop % 3 == 1 ? RodSupport::hinged : RodSupport::clamped, right);
      Model model(rod, 8, loop % 2 == 0 ? 1 : 4);
      const double radius = 0.005, top = radius + d / 2, depth = random(0.001, 0.02),
                   s = length * random(0.2, 0.8), aside = length * random(0.02, 0.1),
                   swing = 2 * pi * random(0.5, 5), rate = 2 * pi * random(1, 12);
      Touch<Model> touch(model, radius, rough ? Friction(random(0.1, 1)) : Friction());
      auto coupling = VirtualCoupling::for_device(device, delay);
      // A hand of 410 g on a spring and a damper, and an arm that takes what it is given.
      const double m = 0.41, k = 500, b = 1.3, arm = 5;
      Place x(s, 0, top + 0.001), v(0, 0, 0),
          sent[4] = {Place::Zero(), Place::Zero(), Place::Zero(), Place::Zero()};
      double given = 0, most = 0;
      for (int tick = 0; tick < 500; ++tick) {
        const Place begin = x, force = sent[delay];
        double taken = 0;
        for (int part = 0; part < 50; ++part) {
          const double dt = 1e-3 / 50, t = (tick + part / 50.0) * 1e-3;
          const Place want(
              s + aside * std::sin(swing * t), aside * std::sin(1.3 * swing * t) / 4,
              loop % 2 == 0 ? top + depth * std::cos(rate * t) : top - depth * std::min(t / 0.1, 1.0));
          const Place a = (force + k * (want - x) - (b + arm) * v) / m, mean = v + dt * a / 2;
          x += dt * mean, v += dt * a, taken += arm * mean.squaredNorm() * dt;
        }
        given += force.dot(x - begin) - taken;
        most = std::max(most, given);
        const auto felt = coupling.tick(touch, x, 1e-3);
        CAPTURE(rough, loop, tick);
        REQUIRE(felt.touch.status == Status::ok);
        touched += felt.touch.pressing;
        for (int i = 3; i > 0; --i) sent[i] = sent[i - 1];
        sent[0] = felt.force;
      }
      CAPTURE(rough, loop);
      CHECK(most <= 1e-9);
    }
  CHECK(touched > 2500);
}
