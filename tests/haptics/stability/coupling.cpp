// The coupling: a series in statics, nothing in free air, no life of its own, and a bounded tick.
#include <cmath>
#include <limits>
#include <vector>

#include "haptics/stability/power_wall.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

using Vector = Vector2<double>;

constexpr double T = 1e-3, radius = 5e-3;

static_assert(is_coupling<Direct> && is_coupling<VirtualCoupling>);
static_assert(!is_coupling<LastResponse>);

/// y where K (x - y) = f(y).
double series(const PowerWall& wall, double K, double x) {
  double low = 0, high = x;
  for (int i = 0; i < 200; ++i) {
    const double y = (low + high) / 2;
    (K * (x - y) > wall.force(y) ? low : high) = y;
  }
  return low;
}

/// A round post, as rigid as the fixed end of a beam.
struct Post {
  using Scalar = double;
  double stiffness, reach;  // [N/m], [m]

  Contact<double> contact_at(const Vector& position) const noexcept {
    Contact<double> contact;
    contact.depth = reach - position.norm();
    contact.touching = contact.depth > 0;
    contact.normal = position / position.norm();
    return contact;
  }
  TouchResult<double> tick(const Vector& position) noexcept {
    TouchResult<double> result;
    result.contact = contact_at(position);
    result.pressing = result.contact.touching;
    if (result.pressing) result.force = stiffness * result.contact.depth * result.contact.normal;
    return result;
  }
};

/// A fresh touch led straight to a place: what the beam says to an avatar there, without any coupling.
Vector force_at(const Beam& beam, const Vector& avatar, double side) {
  FemModel<> model(beam, 16);
  Touch<FemModel<>> touch(model, radius);
  TouchResult<double> result;
  for (int i = 0; i <= 60; ++i)
    result = touch.tick(avatar + Vector(0, side * 0.03 * std::max(0.0, 1 - i / 40.0)));
  return result.force;
}

struct Scene {
  const char* name;
  Beam beam;
  double low, high;  // [m] where it is pressed
};
std::vector<Scene> scenes() {
  const Material steel{thesis_young};
  Beam loaded = thesis_beam(Support::pinned, Support::roller);
  loaded.transverse(-300);
  return {{"steel bar", thesis_beam(Support::pinned, Support::pinned), 0.05, 2.49},
          {"thin strip", Beam(0.5, Section::rectangle(0.02, 5e-4), steel, Support::pinned, Support::pinned),
           0.03, 0.47},
          {"ruler", Beam(0.3, Section::rectangle(0.03, 1e-3), steel, Support::clamped, Support::free), 0.02,
           0.295},
          {"loaded bar", loaded, 0.05, 2.49}};
}

DeviceInfo phantom(double period = T) {
  DeviceInfo info{};
  info.peak_force = 37.5, info.continuous_force = 6.2;
  info.max_stiffness = 3500, info.position_resolution = 7e-6, info.friction = 0.2;
  info.period = period, info.damping = 5;
  return info;
}

}  // namespace

// K g = f(p) and p = h + n g, with f asked of a touch that knows no coupling.
TEST_CASE(
    "at rest the force is the series of coupling and beam, within 0.1 %, wherever and however it came there",
    "[coupling]") {
  Random random(11);
  for (const Scene& scene : scenes()) {
    for (const double K : {200.0, 714.0, 3500.0}) {
      FemModel<> model(scene.beam, 16);
      Touch<FemModel<>> touch(model, radius);
      VirtualCoupling coupling({K, 1.25});
      Vector hand(scene.beam.length() / 2, 0.03);
      int pressed = 0;
      double worst = 0;
      for (int rest = 0; rest < 40; ++rest) {
        const double x = random(scene.low, scene.high);
        const double surface = FemModel<>(scene.beam, 16).shape().at(x).w + model.thickness() / 2 + radius;
        const Vector to(x, surface + random(std::max(-25 / K, -0.02), 2e-3));  // up to 25 N
        // At up to 2 m/s, in the hand's own steps.
        const Vector from = hand;
        const int steps = 1 + static_cast<int>((to - from).norm() / (random(0.05, 2) * T));
        for (int i = 1; i <= steps; ++i)
          (void)coupling.tick(touch, hand = from + (to - from) * (double(i) / steps), T);
        CoupledForce<double> result;
        for (int i = 0; i < 150; ++i) result = coupling.tick(touch, hand, T);
        if (result.force.isZero(0)) continue;
        ++pressed;
        const Vector spring = K * (result.avatar - hand), beam = force_at(scene.beam, result.avatar, 1);
        worst = std::max({worst, (result.force - beam).norm() / beam.norm(),
                          (result.force - spring).norm() / beam.norm()});
      }
      INFO(scene.name << ", " << K << " N/m: " << worst);
      CHECK(pressed >= 20);
      CHECK(worst <= 1e-3);
    }
  }
}

// Newton's step with the tangent off by a fifth leaves a fifth; a wall of exponent q is touched with one unknown to it.
TEST_CASE(
    "held still, the force goes to the series and stays, for walls of 0.05 to 10⁶ N/mm, linear to cubic",
    "[coupling]") {
  for (const double q : {1.0, 2.0, 3.0})
    for (double reference = 50; reference < 2e9; reference *= 10)
      for (const double K : {100.0, 1000.0, 3500.0})
        for (const double B : {0.0, 1.25, 4.0}) {
          const double depth = 3e-3;
          PowerWall wall{reference * std::pow(depth, 1 - q), q};
          VirtualCoupling coupling({K, B});
          const double exact = wall.force(series(wall, K, depth));
          double late = 0;
          int settled = 0;
          // 30 ticks of approach, ten for the tangent; then the damper's time B/K, of 7 for 1e-3, of 10 for 1e-4.
          const double slow = B / T / K;
          for (int tick = 1; tick <= 2 * (40 + 10 * slow); ++tick) {
            const double force = coupling.tick(wall, {0, -std::min(depth, tick * 1e-4)}, T).force.y();
            REQUIRE(force >= 0);
            // Never beyond spring and damper at the fastest approach.
            REQUIRE(force <= K * depth + B * 0.1 * (1 + 1e-9) + 1e-9);
            if (std::abs(force - exact) > 1e-3 * exact) settled = tick;
            if (tick > 40 + 10 * slow) late = std::max(late, std::abs(force - exact) / exact);
          }
          CAPTURE(q, reference, K, B);
          CHECK(late <= 1e-4);
          CHECK(settled <= 40 + 7 * slow);
        }
}

// On its way a hand v bends the surface away by (v T)²/2 reach, which is more than a rigid post is pressed in.
TEST_CASE("led past a rigid post, the hand feels the spring to the nearest point of it, in one touch",
          "[coupling]") {
  const double K = 3500, reach = 5e-3;
  for (const double stiffness : {1e5, 1e7, 1e9, 1e11})
    for (const double step : {2e-5, 1e-4, 3e-4})
      for (const double beside : {0.1, 0.5, 0.9}) {
        Post post{stiffness, reach};
        VirtualCoupling coupling({K, 0});
        const double series = K * stiffness / (K + stiffness);
        int touches = 0, ticks = 0;
        double worst = 0;
        bool before = false;
        for (double y = 2 * reach; y > -2 * reach; y -= step) {
          const Vector hand(beside * reach, y);
          const auto felt = coupling.tick(post, hand, T);
          const bool pressing = felt.touch.pressing || felt.continued;
          touches += pressing && !before;
          before = pressing;
          const Contact<double> contact = post.contact_at(hand);
          if (contact.touching && ++ticks > 10)
            worst = std::max(worst, (felt.force - series * contact.depth * contact.normal).norm());
        }
        CAPTURE(stiffness, step, beside);
        CHECK(touches == 1);
        // In a tick the normal at the hand turns by a step over its distance from the axis; the point follows within reach over
        // that distance.  The tangent may be 1.25 times as stiff as the post.
        CHECK(worst <= 1.25 * K * reach * (1 - beside) * step / (beside * reach) / beside);
      }
}

TEST_CASE("one touch a tick, from in front of the hand and never behind it", "[coupling]") {
  Random random(2);
  PowerWall wall{1e5, 1, Vector(0.6, 0.8)};
  VirtualCoupling coupling({1000, 2});
  Vector hand(0, 0.01);
  for (int tick = 1; tick <= 5000; ++tick) {
    hand += Vector(random(5e-4), random(5e-4));
    if (hand.norm() > 0.01) hand *= 0.01 / hand.norm();
    const auto result = coupling.tick(wall, hand, T);
    REQUIRE(wall.ticks == tick);
    REQUIRE(result.avatar == wall.last);
    const double ahead = wall.normal.dot(result.avatar - hand);
    REQUIRE(ahead >= 0);
    REQUIRE((result.avatar - hand - ahead * wall.normal).norm() <= 1e-15);
    // Along the normal, and never toward the wall: no friction, no pull.
    REQUIRE(wall.normal.dot(result.force) >= 0);
    REQUIRE(std::abs(cross<double>(wall.normal, result.force)) <= 1e-12);
  }
}

// The damper's force is B v whatever the ticks; with a period that is not the one that has passed it would be B v dt/T.
TEST_CASE("a damper feels the speed of the hand and not the rate of the loop", "[coupling]") {
  const double B = 40, speed = 0.05;
  Random random(3);
  const auto force_after = [&](double least, double most) {
    PowerWall wall{1e8};  // rigid: the gap is the hand's depth
    VirtualCoupling coupling({1, B});
    double force = 0;
    for (double t = 0; t < 0.05;) {
      const double dt = random(least, most);
      force = coupling.tick(wall, {0, -speed * (t += dt)}, dt).force.y();
    }
    return force;
  };
  for (const double period : {1e-4, 1e-3, 4e-3}) {
    CHECK(force_after(period, period) == Approx(B * speed).epsilon(0.01));
    CHECK(force_after(0.7 * period, 1.3 * period) == Approx(B * speed).epsilon(0.01));
  }
}

TEST_CASE("free motion is free: no force off the beam, from the first tick after release on", "[coupling]") {
  PowerWall wall{2e4};
  for (const double B : {0.0, 1.25, 10.0}) {
    VirtualCoupling coupling({1000, B});
    double y = -4e-3;
    for (int tick = 0; tick < 100; ++tick) (void)coupling.tick(wall, {0, y}, T);
    for (; y < 5e-3; y += 3e-4) {  // withdrawn at 0.3 m/s
      const auto result = coupling.tick(wall, {0, y}, T);
      if (y >= 0) CHECK(result.force.isZero(0));
    }
    // And the point is back with the hand: a new touch begins from nothing.
    for (int tick = 0; tick < 500; ++tick) REQUIRE(coupling.tick(wall, {0, y}, T).force.isZero(0));
    CHECK(coupling.tick(wall, {0, y}, T).avatar == Vector(0, y));
  }
}

// The energy of a contact that was pressed and let go slowly is what went through the damper, nothing else.
TEST_CASE("slowly in and out, the coupling gives back what it took", "[coupling]") {
  for (const double reference : {1e2, 1e4, 1e6}) {
    PowerWall wall{reference};
    VirtualCoupling coupling({2000, 0});
    const int N = 4000;
    double work = 0, largest = 0, force = 0, y = 0;
    for (int tick = 0; tick <= 2 * N; ++tick) {
      const double next = -4e-3 * (tick < N ? tick : 2 * N - tick) / N;
      work += force * (next - y);
      y = next;
      force = coupling.tick(wall, {0, y}, T).force.y();
      largest = std::max(largest, force);
    }
    // K δ² N of the sample-and-hold, K the series; nothing else.
    const double K = 1 / (1 / 2000.0 + 1 / reference), held = K * 4e-3 * 4e-3 / N;
    CHECK(work == Approx(held).epsilon(0.02));
    CHECK(largest == Approx(K * 4e-3).epsilon(1e-3));
  }
}

TEST_CASE("without an answer in time the last good force goes on along its tangent, for a while",
          "[coupling]") {
  const auto check = [](auto coupling, double stiffness) {
    PowerWall wall{1e4};
    double y = -1e-3, force = 0;
    for (int tick = 0; tick < 200; ++tick) force = coupling.tick(wall, {0, y}, T).force.y();
    wall.fail_with = Status::iteration_limit;
    for (int tick = 1; tick <= LastResponse::max_continued; ++tick) {
      y -= 1e-6;
      const auto result = coupling.tick(wall, {0, y}, T);
      CHECK(result.continued);
      CHECK(result.touch.status == Status::iteration_limit);
      CHECK(result.force.y() == Approx(force + stiffness * 1e-6 * tick).epsilon(1e-9));
    }
    const auto given_up = coupling.tick(wall, {0, y}, T);
    CHECK_FALSE(given_up.continued);
    CHECK(given_up.force.isZero(0));
    CHECK(given_up.touch.status == Status::iteration_limit);
    // Drawn back meanwhile, it does not pull.
    wall.fail_with = Status::ok;
    for (int tick = 0; tick < 200; ++tick) (void)coupling.tick(wall, {0, -1e-3}, T);
    wall.fail_with = Status::iteration_limit;
    CHECK(coupling.tick(wall, {0, 1e-3}, T).force.isZero(0));
  };
  check(Direct(), 1.25e4);  // the tangent is 1.25 times a linear wall's
  check(VirtualCoupling({1000, 0}), 1 / (1 / 1000.0 + 1 / 1.25e4));
}

TEST_CASE("any other failure ends in no force, and contact begins anew", "[coupling]") {
  const auto check = [](auto coupling) {
    for (const Status failure : {Status::invalid_request, Status::singular, Status::non_finite}) {
      PowerWall wall{1e4};
      double force = 0;
      for (int tick = 0; tick < 100; ++tick) force = coupling.tick(wall, {0, -1e-3}, T).force.y();
      wall.fail_with = failure;
      const auto result = coupling.tick(wall, {0, -1e-3}, T);
      CHECK(result.force.isZero(0));
      CHECK_FALSE(result.continued);
      CHECK(result.touch.status == failure);
      wall.fail_with = Status::ok;
      for (int tick = 0; tick < 100; ++tick) (void)coupling.tick(wall, {0, -1e-3}, T);
      CHECK(coupling.tick(wall, {0, -1e-3}, T).force.y() == Approx(force).epsilon(1e-6));
      // A hand that is nowhere.
      for (const double bad :
           {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        CHECK(coupling.tick(wall, {0, bad}, T).force.isZero(0));
        CHECK(coupling.tick(wall, {bad, -1e-3}, T).force.isZero(0));
      }
      for (int tick = 0; tick < 100; ++tick) (void)coupling.tick(wall, {0, -1e-3}, T);
      CHECK(coupling.tick(wall, {0, -1e-3}, T).force.y() == Approx(force).epsilon(1e-6));
      coupling.reset();
    }
  };
  check(Direct());
  check(VirtualCoupling({1000, 1}));
}

TEST_CASE("direct is the beam's own force, to the bit", "[coupling]") {
  const Beam beam = thesis_beam(Support::pinned, Support::pinned);
  FemModel<> one(beam, 8), other(beam, 8);
  Touch<FemModel<>> touch(one, radius), alone(other, radius);
  Direct direct;
  for (int tick = 0; tick < 500; ++tick) {
    const Vector hand(1 + 1e-3 * tick, 0.02 - 5e-3 * std::sin(0.05 * tick));
    REQUIRE(direct.tick(touch, hand, T).force == alone.tick(hand).force);
  }
}

TEST_CASE("in a larger scene the same device feels the same force", "[coupling]") {
  const double scale = 4;
  PowerWall wall{1e4}, large{1e4 / scale};
  VirtualCoupling coupling({1000, 2}), scaled = VirtualCoupling({1000, 2}).in_scene(scale);
  for (int tick = 0; tick < 300; ++tick) {
    const double y = -2e-3 * std::sin(0.03 * tick);
    const double force = coupling.tick(wall, {0, y}, T).force.y();
    REQUIRE(scaled.tick(large, {0, scale * y}, T).force.y() == Approx(force).epsilon(1e-12).margin(1e-15));
  }
}

TEST_CASE("the default keeps a quarter of Colgate and Schenkel's bound, half of Abbott and Okamura's",
          "[coupling]") {
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    DeviceInfo device = phantom(std::pow(10, random(-4, -2)));
    device.damping = std::pow(10, random(-2, 2));
    device.friction = random(0, 1) < 0.1 ? 0 : std::pow(10, random(-3, 1));
    device.position_resolution = random(0, 1) < 0.1 ? 0 : std::pow(10, random(-7, -4));
    device.max_stiffness = std::pow(10, random(2, 5));
    const int delay = random.integer(0, 16);
    const CouplingFigures c = safe_coupling(device, delay);
    const double late = device.period * (0.5 + delay);
    REQUIRE((c.stiffness > 0 && c.damping >= 0));
    REQUIRE(c.stiffness * late + c.damping <= 0.75 * device.damping * (1 + 1e-12));
    REQUIRE(c.stiffness <= device.max_stiffness);
    if (device.friction > 0 && device.position_resolution > 0) {
      REQUIRE(c.stiffness <= device.friction / device.position_resolution * (1 + 1e-12));
      REQUIRE(c.damping <= 0.5 * device.friction * device.period / device.position_resolution * (1 + 1e-12));
    }
    REQUIRE(c.stiffness <= 0.4 * passive_stiffness(device.damping, device.period, delay) * (1 + 1e-12));
  }
  // The thesis' device: as stiff as its maker says, or two fifths of what the delay leaves.
  CHECK(safe_coupling(phantom()).stiffness == 3500);
  CHECK(safe_coupling(phantom()).damping == Approx(0.75 * 5 - 3500 * T / 2));
  CHECK(safe_coupling(phantom(), 1).stiffness == Approx(0.4 * 5 / 1.5e-3));
  CHECK(safe_coupling(phantom(), 1).damping == Approx(0.35 * 5));
  const CouplingFigures figures = VirtualCoupling::for_device(phantom(), 2).figures();
  CHECK(figures.stiffness == Approx(0.4 * 5 / 2.5e-3));
  CHECK(figures.damping == Approx(1.75));
}

TEST_CASE("an arm of which nothing is known is taken for one with little damping", "[coupling]") {
  DeviceInfo unknown = phantom(), little = phantom();
  unknown.damping = 0, little.damping = least_damping;
  for (const int delay : {0, 1, 16}) {
    CHECK(safe_coupling(unknown, delay).stiffness == safe_coupling(little, delay).stiffness);
    CHECK(safe_coupling(unknown, delay).damping == safe_coupling(little, delay).damping);
  }
}

// Past a support the beam is let go where its tangent still has a force.
TEST_CASE("pressed directly, a hand that touches nothing feels nothing", "[coupling]") {
  const Beam strip(0.3, Section::rectangle(0.03, 3e-3), Material{3e9}, Support::pinned, Support::pinned);
  FemModel<> model(strip, 8), alone(strip, 8);
  Touch<FemModel<>> touch(model, 5e-3), same(alone, 5e-3);
  Direct direct;
  bool pressed = false;
  int released = 0;
  for (int tick = 0; tick < 20000; ++tick) {
    const double t = tick * T;
    const Vector hand(0.19 + 0.12 * std::sin(0.7 * t),
                      0.004 + 0.016 * std::cos(1.9 * t) + 0.01 * std::cos(0.3 * t));
    const auto felt = direct.tick(touch, hand, T);
    released += pressed && !felt.touch.pressing;
    pressed = felt.touch.pressing;
    REQUIRE(felt.force == same.tick(hand).force);
  }
  CHECK(released > 0);
}

TEST_CASE("what cannot be a coupling is refused by name, value and unit", "[coupling]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(VirtualCoupling({0, 1}), ContainsSubstring("coupling stiffness = 0 N/m"));
  CHECK_THROWS_WITH(VirtualCoupling({100, -1}), ContainsSubstring("coupling damping = -1 N·s/m"));
  CHECK_THROWS_WITH(VirtualCoupling({100, nan}), ContainsSubstring("coupling damping = nan N·s/m"));
  CHECK_THROWS_WITH(safe_coupling(phantom(), 17), ContainsSubstring("delay_ticks = 17: must be 0 to 16"));
}
