// A hand on a beam with mass: a loop of a thousand ticks a second gains no energy, whatever the hand, the beam and the parts of a tick.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

enum class Motion { presses, swings, taps, leaves };

/// An arm of a device with the hand that holds it: a mass on a spring and a damper to where the hand wants it to be.
struct Hand {
  double mass, spring, damper, arm = 5;  // [kg], [N/m], [N·s/m] of the hand, and of the arm
  double x, v = 0;                       // [m], [m/s]

  /// Moves for a tick under a force that stays.   @return what it was given, less what the arm has taken [J]
  template <class Want>
  double tick(double from, double force, Want&& want) {
    const double begin = x;
    double taken = 0;
    constexpr int parts = 50;
    for (int k = 0; k < parts; ++k) {
      constexpr double dt = 1e-3 / parts;
      const double a = (force + spring * (want(from + k * dt) - x) - (damper + arm) * v) / mass,
                   mean = v + dt * a / 2;
      x += dt * mean, v += dt * a;
      taken += arm * mean * mean * dt;
    }
    return force * (x - begin) - taken;
  }
};

}  // namespace

TEST_CASE("a hand that presses, swings, taps and leaves gains nothing from a beam with mass", "[dynamics]") {
  for (const int parts : {1, 4}) {
    Random random(11);
    for (int loop = 0; loop < 36; ++loop) {
      const int which = loop % 3;
      const Material material = which == 0   ? Material{200e9, 7850}
                                : which == 1 ? Material{3e9, 1200}
                                             : Material{5e6, 1100};
      const double height = which == 0   ? random(0.0005, 0.003)
                            : which == 1 ? random(0.001, 0.006)
                                         : random(0.005, 0.02);
      const double length = random(0.1, 0.5);
      const Support right = loop / 3 % 3 == 0   ? Support::free
                            : loop / 3 % 3 == 1 ? Support::pinned
                                                : Support::clamped;
      const Beam beam(length, Section::rectangle(random(0.005, 0.03), height), material,
                      right == Support::pinned ? Support::pinned : Support::clamped, right);
      DynamicModel<> model(beam, 8, parts);
      const bool usual = loop % 2 == 1;
      const double radius = 0.005, s = length * random(0.2, 0.95), depth = random(0.001, 0.02),
                   rate = 2 * pi * random(1, 12);
      Hand hand{usual ? 0.41 : random(0.05, 0.41), usual ? 500 : random(0, 1000), usual ? 1.3 : random(0, 2),
                5, radius + 0.001};
      const auto how = static_cast<Motion>(loop % 4);
      const auto want = [&](double t) {
        switch (how) {
          case Motion::presses: return radius + 0.001 - depth * std::min(t / 0.3, 1.0);
          case Motion::swings: return radius + depth * std::cos(rate * t);
          case Motion::taps: return radius + 0.001 - depth * std::exp(-t) * std::abs(std::sin(rate * t));
          case Motion::leaves: break;
        }
        return t < 0.3 ? radius - depth : radius + 0.02;
      };
      double force = 0, given = 0, most = 0;
      for (int k = 0; k < 600; ++k) {
        given += hand.tick(k * 1e-3, force, want);
        most = std::max(most, given);
        const auto felt = model.step(1e-3, {{s, {s, hand.x}, radius, 1}, 3500, 2});
        REQUIRE(felt.status == Status::ok);
        REQUIRE(felt.force <= 0);
        force = -felt.force * felt.normal.y();
      }
      CAPTURE(parts, loop);
      CHECK(most <= 1e-9);
    }
  }
}

namespace {

enum class Kind { stays, slides, rubs, two };

/// The same in the plane.
struct PlanarHand {
  Hand of[2];

  Vector2<double> at() const { return {of[0].x, of[1].x}; }
  template <class Want>
  double tick(double from, const Vector2<double>& force, Want&& want) {
    double given = 0;
    for (int k = 0; k < 2; ++k)
      given += of[k].tick(from, force[k], [&](double t) { return Vector2<double>(want(t))[k]; });
    return given;
  }
};
struct Course {
  double
      most = 0,
      jump =
          0;  // [J] that hands have been given, and [N] by which the force on one that rests changes in a tick
  int failed = 0;  // steps
  int touched = 0, rubbed = 0,
      both = 0;  // ticks: of contact, of them those that slide with friction, with both hands
};

/// A beam of a gram to a kilogram, and hands of a gram to a kilogram with the coupling of a delay.
Course course(Kind kind, int parts, int delay, int loop) {
  using Model = DynamicModel<Several<Corotational<VonKarman<AssumedStrain>>, 2>>;
  const DeviceInfo device{"arm", Eigen::Vector3d::Ones(), 100, 100, 1e4, 0, 0, 1e-3, 5, 0.2};
  Random random(static_cast<std::uint64_t>(1000 * loop + 17));
  const double length = random(0.1, 0.5), width = random(0.005, 0.03), height = random(0.0005, 0.006),
               mass = std::pow(10, random(-3, 0));
  const bool free = loop % 3 == 0;
  const Support left = loop % 3 == 1 ? Support::pinned : Support::clamped;
  // 100 N/m to 1e5 N/m of a cantilever
  const double young = std::pow(10, random(2, 5)) * 4 * std::pow(length / height, 3) / width;
  const Beam beam(length, Section::rectangle(width, height),
                  Material{young, mass / (length * width * height)}, left, free ? Support::free : left);
  Model model(beam, 8, parts);
  const double radius = 0.005, top = radius + height / 2, sticking = random(0.1, 1),
               sliding = sticking * random(0.5, 1);
  Touch<Model> touch(model, radius, kind == Kind::rubs ? Friction(sticking, sliding) : Friction());
  auto coupling = VirtualCoupling::for_device(device, delay);
  const int hands = kind == Kind::two ? 2 : 1;
  struct Wish {
    double s, depth, rate, aside, swing;
    Motion how;
    Vector2<double> operator()(double t, double top) const {
      const double x = s + aside * std::sin(swing * t);
      switch (how) {
        case Motion::presses: return {x, top + 0.001 - depth * std::min(t / 0.1, 1.0)};
        case Motion::swings: return {x, top + depth * std::cos(rate * t)};
        case Motion::taps: return {x, top + 0.001 - depth * std::exp(-t) * std::abs(std::sin(rate * t))};
        case Motion::leaves: break;
      }
      return {x, t < 0.3 ? top - depth : top + 0.02};
    }
  };
  std::vector<Wish> wishes;
  std::vector<PlanarHand> at;
  for (int i = 0; i < hands; ++i) {
    const double s = kind != Kind::two ? random(0.2, 0.95) : i == 0 ? random(0.15, 0.45) : random(0.55, 0.95);
    Wish wish{length * s,
              random(0.001, 0.02),
              2 * pi * random(1, 12),
              length * random(0.02, 0.2),
              2 * pi * random(0.5, 5),
              static_cast<Motion>((loop + i) % 4)};
    // A force on a hand that rests has to rest, too.
    if (kind == Kind::stays || kind == Kind::two || (loop % 8 == 0)) wish.aside = 0;
    wishes.push_back(wish);
    // Half of them are a hand on an arm of 410 g.
    const Hand hand = loop % 2 == 1 ? Hand{0.41, 500, 1.3, 5, 0}
                                    : Hand{std::pow(10, random(-3, 0)), random(0, 1000), random(0, 2), 5, 0};
    at.push_back({{hand, hand}});
    at.back().of[0].x = wish.s, at.back().of[1].x = top + 0.001;
  }
  std::vector<std::array<Vector2<double>, 4>> sent(2);
  for (auto& forces : sent) forces.fill(Vector2<double>::Zero());
  Course found;
  double given = 0;
  int still = 0;  // ticks in which the hands have rested
  for (int k = 0; k < 600; ++k) {
    bool rests = true;
    Coupled<double> coupled[2];
    for (int i = 0; i < hands; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const Vector2<double> from = at[n].at();
      given += at[n].tick(k * 1e-3, sent[n][static_cast<std::size_t>(delay)],
                          [&](double t) { return wishes[n](t, top); });
      rests = rests && (at[n].at() - from).norm() < 1e-7;
      coupled[i] = {{from.x(), at[n].at(), top, 1}, coupling.figures().stiffness, coupling.figures().damping};
    }
    found.most = std::max(found.most, given);
    still = rests ? still + 1 : 0;
    Vector2<double> forces[2];
    int touching = 0;
    if (kind == Kind::two) {
      Pushed<double> felt[2];
      found.failed += model.step(1e-3, coupled, 2, felt) != Status::ok;
      for (int i = 0; i < 2; ++i) forces[i] = -felt[i].force * felt[i].normal, touching += felt[i].force < 0;
    } else {
      const auto felt = coupling.tick(touch, at[0].at(), 1e-3);
      found.failed += felt.touch.status != Status::ok;
      forces[0] = felt.force, touching += felt.touch.pressing, found.rubbed += felt.touch.sliding;
    }
    found.touched += touching > 0, found.both += touching > 1;
    for (int i = 0; i < hands; ++i) {
      auto& past = sent[static_cast<std::size_t>(i)];
      if (still > 20) found.jump = std::max(found.jump, (forces[i] - past[0]).norm());
      for (std::size_t j = 3; j > 0; --j) past[j] = past[j - 1];
      past[0] = forces[i];
    }
  }
  return found;
}
void sweep(const std::vector<int>& loops) {
  for (const Kind kind : {Kind::stays, Kind::slides, Kind::rubs, Kind::two}) {
    int touched = 0, rubbed = 0, both = 0;
    for (const int parts : {1, 4})
      for (int delay = 0; delay <= 3; ++delay)
        for (const int loop : loops) {
          const Course found = course(kind, parts, delay, loop);
          CAPTURE(static_cast<int>(kind), parts, delay, loop);
          CHECK(found.most <= 1e-9);
          CHECK(found.jump < 1e-2);
          CHECK(found.failed == 0);
          touched += found.touched, rubbed += found.rubbed, both += found.both;
        }
    CHECK(touched > 1000);
    CHECK((rubbed > 1000) == (kind == Kind::rubs));
    CHECK((both > 300) == (kind == Kind::two));
  }
}

}  // namespace

TEST_CASE("a hand that slides over a beam in motion feels Coulomb's law, and one that turns back sticks",
          "[dynamics]") {
  Material damped{200e9, 7850, Damping::air(0.5, 30)};
  const Beam beam(0.3, Section::rectangle(0.025, 0.001), damped, Support::pinned, Support::pinned);
  DynamicModel<> model(beam, 8, 2);
  FrictionState<double, 2> friction;
  friction.sticking = 0.5, friction.sliding = 0.4;
  const double stiffness = 2000;
  double x = 0.1;
  Pushed<double> felt;
  const auto go = [&](double by, int ticks) {
    for (int k = 0; k < ticks; ++k) {
      x += by;
      felt = model.step(1e-3, {{x, {x, 0.004}, 0.005, 1}, stiffness, 0, &friction});
      REQUIRE(felt.status == Status::ok);
      REQUIRE(felt.force <= 0);
    }
  };
  go(2e-5, 2000);
  CHECK(friction.slides);
  CHECK(friction.force.norm() == Approx(-0.4 * felt.force).epsilon(1e-4));
  CHECK(friction.force.x() > 0.39 * -felt.force);  // the beam is dragged along
  const double before = friction.force.x();
  go(-1e-6, 20);
  CHECK(!friction.slides);
  // A beam between hinges hardly moves along itself.
  CHECK(friction.force.x() == Approx(before - stiffness * 20e-6).epsilon(0.02));
}

// Where the beam cannot move its coupling is all that yields.
TEST_CASE("a hand that slides over a clamped end, and past it, has an answer in each step", "[dynamics]") {
  const Beam beam(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850}, Support::clamped,
                  Support::clamped);
  for (const int parts : {1, 4}) {
    DynamicModel<> model(beam, 8, parts);
    Pushed<double> felt;
    for (int k = 0; k < 400; ++k) {
      const double x = 0.03 - 1e-4 * std::min(k, 300), depth = 0.002;
      felt = model.step(1e-3, {{x, {x, 0.005 - depth}, 0.005, 1}, 3000, 0});
      CAPTURE(parts, k);
      REQUIRE(felt.status == Status::ok);
      REQUIRE(felt.force < 0);
    }
    CHECK(felt.s == 0);
    CHECK(felt.force == Approx(-3000 * 0.002).epsilon(1e-9));
    for (int k = 0; k < 100; ++k) {
      const double x = -1e-4 * k;
      felt = model.step(1e-3, {{x, {x, 0.003}, 0.005, 1}, 3000, 0});
      REQUIRE(felt.status == Status::ok);
    }
    CHECK(felt.force == 0);  // off the end
  }
}

// Its coupling yields by more than the avatar's radius.
TEST_CASE("a hand that is deep in a stiff bar beside a hinge has an answer in each step", "[dynamics]") {
  for (const double at : {0.09, 0.095}) {
    const Beam bar(0.1, Section::rectangle(0.02, 0.002), Material{210e9, 7850}, Support::pinned,
                   Support::pinned);
    DynamicModel<> model(bar, 8, 1);
    for (int k = 0; k < 200; ++k) {
      const double y = 0.006 - 0.018 * std::min(1.0, k / 30.0);
      const auto felt = model.step(1e-3, {{at, {at, y}, 0.0054, 1}, 3500, 0.5});
      CAPTURE(at, k, y);
      REQUIRE(felt.status == Status::ok);
      if (k > 100) REQUIRE(-felt.force == Approx(3500 * (0.0054 - y - 1e-3)).epsilon(0.1));
    }
  }
}
// The last four were left without an answer: a stage that was taken for a linear one, and halves that began where no beam is.
TEST_CASE(
    "late loops gain nothing from a beam with mass by the coupling of their delay: hands that stay, slide "
    "and rub, and two of them",
    "[dynamics]") {
  sweep({0, 7, 14, 21, 28, 35, 15, 149, 150, 157});
}
TEST_CASE("220 loops of each kind gain nothing from a beam with mass", "[.][sweep]") {
  std::vector<int> all(220);
  std::iota(all.begin(), all.end(), 0);
  sweep(all);
}
