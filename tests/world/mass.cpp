// Rods with mass in a World: alone as DynamicModel, blows against the closed form of long beams, momentum and energy, rest, joints, grips, and requests.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "once_world.hpp"
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include "support/sanitized.hpp"
#include "world/crossed.hpp"
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

using Vector6d = VectorOf<double, 6>;  // velocity [m/s], and how that changes along the rod [1/s]
const RodMaterial steel = RodMaterial::isotropic(200e9, 0.3, 7850);

Vector6d both(const Point& v, const Point& change) {
  Vector6d all;
  all << v, change;
  return all;
}
/// Held by nothing.
Rod loose(double length, double diameter, const RodPose& left) {
  Rod rod(length, RodSection::circle(diameter), steel, RodSupport::free, RodSupport::free);
  return rod.place_left(left);
}

/// Linear and about the origin.  Cubics on four places of Gauss are exact.
struct Momentum {
  Point linear = Point::Zero(), angular = Point::Zero();

  template <class Element>
  void add(const World<Element>& world, int rod, double mass_per_length) {
    constexpr std::array<double, 4> x{0.0694318442029737, 0.330009478207572, 0.669990521792428,
                                      0.930568155797026},
        g{0.173927422568727, 0.326072577431273, 0.326072577431273, 0.173927422568727};
    const auto line = world.shape(rod);
    for (int e = 0; e < line.segments(); ++e)
      for (std::size_t k = 0; k < 4; ++k) {
        const double h = line[e + 1].s - line[e].s, s = line[e].s + x[k] * h;
        const Point p = mass_per_length * g[k] * h * world.velocity(rod, s);
        linear += p, angular += detail::cross3<double>(line.at(s).r, p);
      }
  }
};

}  // namespace

namespace {

template <class Element>
void check_alone(bool led) {
  const Rod rod(0.3, RodSection::circle(0.002), steel, RodSupport::clamped, RodSupport::free);
  DynamicModel<Element> model(rod, 8);
  World<Element> world({{rod, 8}});
  const auto velocity = [](double s) {
    const double x = s / 0.3;
    return both({0, 2 * x * x, x * x * x}, {0, 4 * x / 0.3, 3 * x * x / 0.3});
  };
  if (!led) model.let_go_from(model.shape(), velocity), world.throw_rod(0, velocity);
  double off = 0, most = 0, force = 0, size = 0;
  for (int k = 1; k <= 300; ++k) {
    if (led) {
      const RodPose hand{{0, 0.02 * std::sin(0.05 * k), 0.01 * std::sin(0.03 * k)}, {1, 0, 0}, {0, 1, 0}};
      REQUIRE(model.hold(RodSide::left, hand) == Status::ok);
      REQUIRE(world.hold(0, RodSide::left, hand) == Status::ok);
    }
    REQUIRE(model.step(1e-3) == Status::ok);
    REQUIRE(world.step(1e-3) == Status::ok);
    off = std::max(off, (model.shape().at(0.3).r - world.shape(0).at(0.3).r).norm());
    most = std::max(most, std::abs(world.shape(0).at(0.3).r.y()));
    const Point held = model.reaction(RodSide::left).force;
    force = std::max(force, (held - world.held(0, RodSide::left).force).norm());
    size = std::max(size, held.norm());
  }
  CAPTURE(led, off, most, force, size);
  CHECK(most > 0.01);
  CHECK(off <= 1e-12);
  CHECK(force <= 1e-7 * size);  // DynamicModel's has round-off of places
  CHECK(world.energy().sum() == Approx(model.energy().sum()).epsilon(1e-12));
}

}  // namespace

TEST_CASE("a rod of a World that nothing touches moves as DynamicModel has it", "[world]") {
  for (const bool led : {false, true}) check_alone<RoundRod>(led), check_alone<TwistedRod>(led);
}

TEST_CASE("a moment acts on a rod of a World as on one alone, with mass and without", "[world]") {
  Rod rod(0.3, RodSection::circle(0.002), steel, RodSupport::clamped, RodSupport::free);
  rod.add({0.2, {0, 0, 0}, {0.1, 0.1, 0.2}}).add({0.3, {0, 0, 0}, {0, 0.1, -0.1}});
  FemModel<TwistedRod> model(rod, 10);
  World<TwistedRod> world({{rod, 10}});
  const RodPose root{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  REQUIRE(world.hold(0, RodSide::left, root) == Status::ok);
  REQUIRE(world.tick() == Status::ok);
  const auto off = [&] { return (world.shape(0).at(0.3).r - model.shape().at(0.3).r).norm(); };
  const Point held = model.hold(RodSide::left, root).moment;
  CHECK(model.shape().at(0.3).r.y() > 0.01);
  CHECK(off() <= 1e-12);
  CHECK(held.norm() > 0.2);
  CHECK((world.held(0, RodSide::left).moment - held).norm() <= 1e-9);
  for (int k = 0; k < 20; ++k) REQUIRE(world.step(1e-3) == Status::ok);
  CHECK(off() <= 1e-9);
  const DynamicModel<TwistedRod> alone(rod, 10);
  CHECK(world.energy().sum() == Approx(alone.energy().sum()).epsilon(1e-9));
}

// Each yields at the place with a velocity of ∫ F(τ) Y/√(π (t - τ)) dτ,  Y = (4EI/m)^(3/4)/8EI.  So rods that meet at V have  F = V/Σ Y √(πt).
TEST_CASE("the blow of two long rods is that of infinite Euler-Bernoulli beams", "[world]") {
  const Rod a = loose(1, 0.002, {{-0.507, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
            b = loose(1, 0.003, {{0, -0.493, 0.0025 + 1e-7}, {0, 1, 0}, {0, 0, 1}});
  const auto yields = [](const Rod& rod) {
    const double EI = rod.stiffness().bending1;
    return std::pow(4 * EI / rod.mass_per_length(0), 0.75) / (8 * EI);
  };
  const double V = 0.5;
  for (const double dt : {1e-3, 2.5e-4, 1e-4}) {
    World<RoundRod> world({{a, 32}, {b, 32}});
    world.throw_rod(1, [&](double) { return both({0, 0, -V}, {0, 0, 0}); });
    for (int k = 1; k * dt < 4.5e-3; ++k) {
      REQUIRE(world.step(dt, 1) == Status::ok);
      const double t = k * dt, exact = V / (yields(a) + yields(b)) * 2 * std::sqrt(t / pi);
      if (std::abs(t - 2e-3) > dt / 2 && std::abs(t - 4e-3) > dt / 2) continue;
      Momentum struck;
      struck.add(world, 0, a.mass_per_length(0));
      CAPTURE(dt, t, -struck.linear.z() / exact);
      CHECK(-struck.linear.z() == Approx(exact).epsilon(k < 3 ? 0.035 : 0.006));
    }
    CHECK(world.contacts() == 1);
  }
}

TEST_CASE("two rods that strike keep their momentum, and have less energy with every step", "[world]") {
  const Rod a = loose(0.3, 0.002, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
            b = loose(0.25, 0.002, {{0.13, -0.1, 0.003}, {0, 1, 0}, {0, 0, 1}});
  for (const double dt : {2e-3, 1e-3, 2.5e-4, 1e-4}) {
    World<RoundRod> world({{a, 8}, {b, 8}});
    world.throw_rod(1, [](double) { return both({0, 0, -1}, {0, 0, 0}); });
    const auto momentum = [&] {
      Momentum sum;
      sum.add(world, 0, a.mass_per_length(0)), sum.add(world, 1, b.mass_per_length(0));
      return sum;
    };
    const Momentum start = momentum();
    const double first = world.energy().sum();
    double last = first, rise = 0, lost = 0, turned = 0;
    int touching = 0;
    for (int k = 0; k < trials(10000); ++k) {
      REQUIRE(world.step(dt, 1) == Status::ok);
      touching += world.contacts() > 0;
      const double energy = world.energy().sum();
      rise = std::max(rise, energy - last), last = energy;
      if (k * dt >= 0.05 && k % 100 != 0) continue;
      const Momentum now = momentum();
      lost = std::max(lost, (now.linear - start.linear).norm());
      if (k * dt < 0.05) turned = std::max(turned, (now.angular - start.angular).norm());
    }
    CAPTURE(dt, touching, rise / first, last / first, lost / start.linear.norm(),
            turned / start.angular.norm());
    CHECK(touching >= 3);
    CHECK(rise <= 1e-9 * first);
    CHECK(last < 0.9 * first);
    CHECK(last > 0.5 * first);
    CHECK(lost <= 1e-8 * start.linear.norm());  // 10⁴ times the solver's 1e-9, of both signs
    // Places are not those of velocities: of the step.
    CHECK(turned <= 2e-5 * std::pow(dt / 1e-3, 1.5) * start.angular.norm());
  }
}

namespace {

/// The tool and the wire of crossed.hpp, of a material of their own, with a hand on springs where that is asked for.
template <class Element>
World<Element> crossed(const Crossing& at, double density, double drag, const RodSupport& hand,
                       double friction = 0) {
  RodMaterial material = spring_steel;
  material.density = density, material.damping.drag = drag;
  Rod top(0.2, RodSection::circle(0.002), material, hand, RodSupport::free);
  const Rod wire(0.25, RodSection::circle(0.0015), material, RodSupport::clamped, RodSupport::free);
  return World<Element>({{top.place_left(at.pose()), 8, Friction(friction, friction)}, {wire, 8}});
}

template <class Element>
void check_rest(double springs) {
  Crossing at;
  at.off = {0, 0, 1e-4};
  // A damper of half a spring leaves the other half.
  const auto hand = [&](double share) {
    const double place = share * springs;
    return springs > 0 ? RodSupport::elastic(place, place, place, 5 * share, 5 * share, 5 * share)
                       : RodSupport::clamped;
  };
  const double damper = springs > 0 ? 0.5 : 0;
  World<Element> still = crossed<Element>(at, 0, 0, hand(1 - damper)),
                 moving = crossed<Element>(at, 7850, 300, hand(1));
  Crossing to = at;
  for (int k = 1; k <= 2000; ++k) {
    const double t = std::min(k / 100., 1.);
    to.off = {0.004 * t, -0.003 * t, 1e-4 - 0.01 * t};
    if (k <= 100) REQUIRE(lead(still, to) == Status::ok);
    REQUIRE(moving.hold(0, RodSide::left, to.pose(), {damper, damper, 1e-3}) == Status::ok);
    REQUIRE(moving.step(1e-3) == Status::ok);
  }
  REQUIRE(still.contacts() == 1);
  REQUIRE(moving.contacts() == 1);
  const RodContact one = still.contact(0), other = moving.contact(0);
  CHECK(one.force.norm() > 0.1);
  CHECK((one.force - other.force).norm() <= 1e-6 * one.force.norm());
  CHECK(std::abs(one.s[0] - other.s[0]) + std::abs(one.s[1] - other.s[1]) <= 1e-7);
  const HeldEnd<double> held = still.held(0, RodSide::left), felt = moving.held(0, RodSide::left);
  CHECK((held.force - felt.force).norm() <= 1e-6 * held.force.norm());
  CHECK((held.moment - felt.moment).norm() <= 1e-6 * held.moment.norm());
  CHECK(moving.energy().kinetic <= 1e-12 * moving.energy().strain);
}

}  // namespace

TEST_CASE("rods with mass come to rest where those without lie", "[world]") {
  check_rest<RoundRod>(0), check_rest<TwistedRod>(0);
  check_rest<RoundRod>(2000);
}

namespace {

/// One rod presses another by 10 mm.
Crossing pressed() {
  Crossing down;
  down.off = {0, 0, -0.01};
  return down;
}
World<RoundRod> held_pressed() {
  Crossing at;
  at.off = {0, 0, 1e-4};
  World<RoundRod> world = crossed<RoundRod>(at, 7850, 0, RodSupport::clamped);
  REQUIRE(lead(world, at, pressed(), 20) == Status::ok);
  return world;
}

}  // namespace

TEST_CASE("an equilibrium that is let go starts from there", "[world]") {
  const Crossing down = pressed();
  World<RoundRod> world = held_pressed();
  const double strain = world.energy().strain;
  const Point force = world.contact(0).force;
  CHECK(world.energy().kinetic == 0);
  REQUIRE(world.step(1e-3) == Status::ok);
  REQUIRE(world.contacts() == 1);
  CHECK((world.contact(0).force - force).norm() <= 1e-6 * force.norm());
  CHECK(world.energy().sum() == Approx(strain).epsilon(1e-9));
  // The hand goes up at once: the wire swings.
  for (int k = 1; k <= 5; ++k) {
    Crossing up = down;
    up.off.z() += 0.006 * k;
    REQUIRE(world.hold(0, RodSide::left, up.pose()) == Status::ok);
    REQUIRE(world.step(1e-3) == Status::ok);
  }
  CHECK(world.contacts() == 0);
  CHECK(world.energy().kinetic > strain / 10);
  for (int k = 0; k < 5; ++k) (void)world.tick();
  CHECK(world.tick() == Status::ok);
  CHECK(world.energy().kinetic == 0);
}

TEST_CASE("a rod that is thrown against what it touches takes no energy from that", "[world]") {
  World<RoundRod> world = held_pressed();
  for (int k = 0; k < 5; ++k) REQUIRE(world.step(1e-3) == Status::ok);
  REQUIRE(world.contacts() == 1);
  world.throw_rod(1, [](double s) { return both({0, 0, 20 * s * s}, {0, 0, 40 * s}); });
  double last = world.energy().sum(), rise = 0;
  const double thrown = last;
  for (int k = 0; k < 100; ++k) {
    REQUIRE(world.step(2.5e-4, 1) == Status::ok);
    rise = std::max(rise, world.energy().sum() - last), last = world.energy().sum();
  }
  CAPTURE(thrown, last, rise);
  CHECK(rise <= 1e-9 * thrown);
  CHECK(last < 0.95 * thrown);
}

TEST_CASE("a hand on a grip's springs that strikes gives energy only as long as it moves", "[world]") {
  for (const double friction : {0., 0.3}) {
    Crossing at;
    at.off = {0, 0, 0.003};
    World<RoundRod> world =
        crossed<RoundRod>(at, 7850, 0, RodSupport::elastic(1500, 1500, 1500, 5, 5, 5), friction);
    double last = 0, most = 0, rise = 0;
    int touching = 0;
    for (int k = 1; k <= 2000; ++k) {
      const double t = std::min(k / 20., 1.);
      Crossing to = at;
      to.off += Point(0.01 * t, 0, -0.012 * t);
      REQUIRE(world.hold(0, RodSide::left, to.pose(), {0.5, 0.5, 1e-3}) == Status::ok);
      REQUIRE(world.step(1e-3) == Status::ok);
      touching += world.contacts() > 0;
      const double energy = world.energy().sum();
      most = std::max(most, energy);
      if (k > 22) rise = std::max(rise, energy - last);
      last = energy;
    }
    CAPTURE(friction, touching, most, last, rise);
    CHECK(touching > 500);
    CHECK(rise <= 1e-9 * most);
    if (friction > 0) CHECK(world.dissipated() > 0);
  }
}

TEST_CASE("a rod on a pin swings as a rigid one, and what it strikes takes its energy", "[world]") {
  const double L = 0.1;
  Rod rod = loose(L, 0.004, {{0, 0, 0}, {0, 0, -1}, {1, 0, 0}});
  rod.weight(7850, {0, 0, -9.81});
  const std::vector<RigidBody> bodies{RigidBody::sphere({0, 0, 0}, 0.001),
                                      RigidBody::sphere({-0.02, 0, -0.09}, 0.005)};
  World<RoundRod> world({{rod, 4}}, bodies, {{{0, 1}, {0, 0}}});
  const double spin = 0.05;  // [rad/s]
  world.throw_rod(0, [&](double s) { return both({spin * s, 0, 0}, {spin, 0, 0}); });
  const double omega = std::sqrt(1.5 * 9.81 / L), start = world.energy().sum();
  double off = 0;
  for (int k = 1; k <= 1000; ++k) {
    REQUIRE(world.step(1e-3) == Status::ok);
    off = std::max(off, std::abs(world.shape(0).at(L).r.x() - L * spin / omega * std::sin(omega * k * 1e-3)));
    REQUIRE(world.energy().sum() <= start + 1e-9 * world.energy().kinetic + 1e-12);
    REQUIRE(world.shape(0)[0].r.norm() <= 1e-12);
  }
  CAPTURE(off);
  CHECK(off <= 1e-3 * L * spin / omega);
  // Faster, against the other ball.
  world.reset();
  world.throw_rod(0, [](double s) { return both({-5 * s, 0, 0}, {-5, 0, 0}); });
  const double thrown = world.energy().sum(), kinetic = world.energy().kinetic;
  double least = 0;
  for (int k = 0; k < 500; ++k) {
    REQUIRE(world.step(1e-3) == Status::ok);
    least = std::min(least, world.shape(0).at(0.09).r.x());
    REQUIRE(world.energy().sum() <= thrown + 1e-9 * kinetic);
    REQUIRE(world.shape(0)[0].r.norm() <= 1e-12);
  }
  CHECK(least > -0.02 + 0.007 - 1e-4);
  CHECK(world.energy().sum() < thrown - 0.1 * kinetic);
}

TEST_CASE("hands that rush about through rods with mass leave everything finite and no energy behind",
          "[world]") {
  const RodSupport springs = RodSupport::elastic(1500, 1500, 1500, 5, 5, 5);
  Rod top(0.2, RodSection::circle(0.002), steel, springs, RodSupport::free);
  const Rod wire(0.25, RodSection::circle(0.0015), steel, RodSupport::clamped, RodSupport::free),
      flies = loose(0.15, 0.002, {{0.05, -0.05, 0.01}, {0, 1, 0}, {0, 0, 1}});
  for (const double speed : {0.05, 1.}) {
    Crossing at;
    at.off = {0, 0, 1e-3};
    World<RoundRod> world({{top.place_left(at.pose()), 8, Friction(0.3, 0.3)}, {wire, 8}, {flies, 8}},
                          {RigidBody::sphere({0.1, 0.05, -0.03}, 0.01)});
    Random random(3);
    int failed = 0, touching = 0, most = 0;
    double rests = 0, rise = 0;
    Point by(0, 0, 0);
    for (int k = 0; k < trials(10000); ++k) {
      // Half of the time it rests.
      const bool moves = k / 500 % 2 == 0;
      if (moves) {
        by = 0.95 * (by + speed * Point(random(2e-4), random(2e-4), random(2e-4))) - 1e-3 * at.off;
        at.off += by, at.tilt += random(0.01);
        if (k % 250 == 0) at.off = {random(0.05), random(0.05), random(0.05)};
      }
      REQUIRE(world.hold(0, RodSide::left, at.pose(), {0.5, 0.5, 1e-3}) == Status::ok);
      failed += world.step(1e-3) != Status::ok;
      touching += world.contacts() > 0, most = std::max(most, world.solves());
      const double energy = world.energy().sum();
      REQUIRE(std::isfinite(energy));
      REQUIRE(world.held(0, RodSide::left).force.allFinite());
      if (!moves && k % 500 == 5) rests = energy;
      if (!moves && k % 500 > 5) rise = std::max(rise, energy / rests - 1);
    }
    CAPTURE(speed, failed, touching, most, rise);
    CHECK(touching > trials(100));
    CHECK(failed <= trials(50));
    CHECK(most <= 6 * 48);
    CHECK(rise <= 1e-9);
  }
}

TEST_CASE("a hand that leaps through a rod in one step stops, and comes back", "[world]") {
  Crossing at;
  at.off = {0, 0, 0.002};
  World<RoundRod> world = crossed<RoundRod>(at, 7850, 100, RodSupport::clamped);
  Crossing through = at;
  through.off = {0, 0, -0.15};
  REQUIRE(world.hold(0, RodSide::left, through.pose()) == Status::ok);
  CHECK(world.step(1e-3) == Status::iteration_limit);
  CHECK(world.energy().kinetic == 0);
  // No rod has passed the other.
  CHECK(world.shape(0).at(0.15).r.z() > world.shape(1).at(0.18).r.z());
  through.off = world.shape(0)[0].r - at.pose().at + at.off;
  int stopped = 0;
  for (int k = 1; k <= 200; ++k) {
    Crossing back = at;
    back.off = through.off + k / 200. * (at.off - through.off);
    REQUIRE(world.hold(0, RodSide::left, back.pose()) == Status::ok);
    stopped += world.step(1e-3) != Status::ok;
  }
  CHECK(stopped <= 5);  // 4 J are let go
  CHECK((world.shape(0)[0].r - at.pose().at).norm() <= 1e-12);
  CHECK(world.shape(0).at(0.15).r.z() > world.shape(1).at(0.18).r.z());
}

TEST_CASE("steps that make no sense are rejected, and nothing has changed", "[world]") {
  Crossing at;
  at.off = {0, 0, 1e-3};
  World<RoundRod> massless = crossed_rods<RoundRod>(at, 8);
  CHECK(massless.step(1e-3) == Status::invalid_request);
  World<RoundRod> world = crossed<RoundRod>(at, 7850, 0, RodSupport::clamped);
  const Point tip = world.shape(0).at(0.2).r;
  CHECK(world.step(-1e-3) == Status::invalid_request);
  CHECK(world.step(NAN) == Status::invalid_request);
  CHECK(world.step(1e-3, 0) == Status::invalid_request);
  CHECK(world.step(0) == Status::ok);
  CHECK(world.hold(0, RodSide::left, at.pose(), {1, 0, 1e-3}) == Status::invalid_request);
  CHECK(world.step(1e-3) == Status::ok);
  CHECK((world.shape(0).at(0.2).r - tip).norm() <= 1e-15);
  const Rod heavy(0.2, RodSection::circle(0.002), steel, RodSupport::clamped, RodSupport::free),
      light(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  CHECK_THROWS_WITH(World<RoundRod>({{heavy, 8}, {light, 8}}), ContainsSubstring("rod 1 density"));
}
