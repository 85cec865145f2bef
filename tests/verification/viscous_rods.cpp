// Viscous rods in space: relaxation in bending, twist and stretch, creep, decrement, and energy, against closed forms.
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "once_world.hpp"
#include "support/catch.hpp"
#include "support/pi.hpp"
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/world/world.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Model = DynamicModel<TwistedRod>;
using Place = VectorOf<double, 3>;

RodMaterial nylon(double density = 0) { return RodMaterial::isotropic(3e9, 0.35, density); }
/// A catheter, or a strip, between hands.
Rod held(const RodMaterial& material, bool flat) {
  return Rod(0.2, flat ? RodSection::rectangle(0.004, 0.001) : RodSection::circle(0.002), material,
             RodSupport::clamped, RodSupport::clamped);
}
Rod cantilever(const RodMaterial& material, bool flat) {
  return Rod(0.2, flat ? RodSection::rectangle(0.004, 0.001) : RodSection::circle(0.002), material,
             RodSupport::clamped, RodSupport::free);
}
enum class Way { stretch, across1, across2, twist };
constexpr double sizes[] = {1e-6, 1e-6, 1e-6, 1e-4};  // [m], [m], [m], [rad]

/// How far a hand leads the right end by a way, and by what the rod holds it.
RodPose led(Way way, double x) {
  Place at(0.2, 0, 0), director(0, 1, 0);
  if (way == Way::stretch) at.x() += x;
  if (way == Way::across1) at.y() += x;
  if (way == Way::across2) at.z() += x;
  if (way == Way::twist) director = {0, std::cos(x), std::sin(x)};
  return {at, {1, 0, 0}, director};
}
double answer(Way way, const HeldEnd<double>& of) {
  return way == Way::stretch   ? of.force.x()
         : way == Way::across1 ? of.force.y()
         : way == Way::across2 ? of.force.z()
                               : of.moment.x();
}
double stiffness(Way way, const Rod& rod) {
  const RodStiffness& k = rod.stiffness();
  const double L = rod.length();
  // Across d1 it bends about d2.
  return way == Way::stretch   ? k.axial / L
         : way == Way::across1 ? 12 * k.bending2 / (L * L * L)
         : way == Way::across2 ? 12 * k.bending1 / (L * L * L)
                               : k.torsion / L;
}

/// A clamp that is turned about the rod's axis.
RodPose rolled(double angle) { return {{0, 0, 0}, {1, 0, 0}, {0, std::cos(angle), std::sin(angle)}}; }
double off_axis(const Model& model) {
  const Place at = model.shape().at(0.2).r;
  return std::hypot(at.y(), at.z());
}

}  // namespace

// An end that is led by x(t) is held by  K (x + τ x' + g h),  h' = x' - h/τ1.
TEST_CASE("a viscous rod relaxes in bending, twist and stretch alike", "[dynamics]") {
  const double g = 0.5, tau1 = 0.2, tau = 0.01;
  for (const bool flat : {false, true})
    for (const Way way : {Way::stretch, Way::across1, Way::across2, Way::twist}) {
      RodMaterial material = nylon();
      material.damping.branches[1] = {g, tau1};
      material.damping.viscosity = tau;
      const Rod rod = held(material, flat);
      Model model(rod, 8, 1);
      const double size = sizes[static_cast<std::size_t>(way)], K = stiffness(way, rod), dt = 1e-3;
      double off = 0, h = 0;
      for (int i = 1; i <= 1000; ++i) {
        REQUIRE(model.hold(RodSide::right, led(way, size * (1 - std::cos(pi * i * dt)))) == Status::ok);
        REQUIRE(model.step(dt) == Status::ok);
        constexpr int parts = 10;  // of second order: 1e-9
        for (int j = 0; j < parts; ++j) {
          const double d = dt / parts, t = (i - 1) * dt + (j + 0.5) * d;
          h = (h * (1 - d / (2 * tau1)) + d * size * pi * std::sin(pi * t)) / (1 + d / (2 * tau1));
        }
        const double t = i * dt, x = size * (1 - std::cos(pi * t)), rate = size * pi * std::sin(pi * t);
        // In its first step the hand comes from rest, by half of the speed that it has then.
        if (i > 2)
          off = std::max(
              off, std::abs(answer(way, model.reaction(RodSide::right)) / K - (x + tau * rate + g * h)));
      }
      CAPTURE(flat, static_cast<int>(way), off / size);
      CHECK(off <= 1e-5 * size);
    }
}

// Loaded at once:  w = w∞ (1 - g/(1 + g) e^(-t/(τ (1 + g)))).
TEST_CASE("a viscous rod without mass creeps under its load", "[dynamics]") {
  const double g = 0.5, tau = 0.2;
  RodMaterial material = nylon();
  material.damping.branches[0] = {g, tau};
  struct Case {
    double dt, error;
  };
  for (const Case& c : {Case{1e-3, 1e-5}, {1e-2, 6e-5}})
    for (const bool flat : {false, true}) {
      Rod loaded = cantilever(material, flat);
      const Place force(0, 1e-5, -2e-5);
      loaded.add(RodForce{0.2, force});
      Model model(loaded, 8, 1);
      model.let_go_from(FemModel<TwistedRod>(cantilever(material, flat), 8).shape());
      const double L = 0.2, by = L * L * L / 3;
      const Place last(0, by * force.y() / loaded.stiffness().bending2,
                       by * force.z() / loaded.stiffness().bending1);
      for (int i = 1; i * c.dt <= 1; ++i) {
        REQUIRE(model.step(c.dt) == Status::ok);
        const Place creeps = last * (1 - g / (1 + g) * std::exp(-i * c.dt / (tau * (1 + g))));
        const Place off = model.shape().at(L).r - Place(L, 0, 0) - creeps;
        CAPTURE(flat, c.dt, i * c.dt, off.norm() / last.norm());
        REQUIRE(std::abs(off.y()) + std::abs(off.z()) <= c.error * last.norm());
      }
    }
}

TEST_CASE("a viscous rod takes its share of each period, about either axis", "[dynamics]") {
  const double beta = 1.8751040687119611, ratio = 0.05, size = 1e-6;
  for (const bool flat : {false, true})
    for (const bool second : {false, true}) {
      const Rod elastic = cantilever(nylon(1100), flat);
      const double EI = second ? elastic.stiffness().bending1 : elastic.stiffness().bending2,
                   L = elastic.length(),
                   omega = beta * beta / (L * L) * std::sqrt(EI / elastic.mass_per_length(0));
      RodMaterial material = nylon(1100);
      material.damping = Damping::ratio(ratio, omega / (2 * pi));
      const Rod rod = cantilever(material, flat);
      Rod pulled = rod;
      const double force = size * 3 * EI / (L * L * L);
      pulled.add(RodForce{L, second ? Place(0, 0, force) : Place(0, force, 0)});
      Model model(rod, 8, 1);
      model.let_go_from(FemModel<TwistedRod>(pulled, 8).shape());
      // From where it goes through the middle upward; higher modes are gone after the second time.
      const double dt = 2 * pi / omega / 800;
      double before = size, reach = 0, last = 0;
      std::vector<double> peaks, crossings;
      double energy = model.energy().sum();
      for (int k = 1; crossings.size() < 6; ++k) {
        REQUIRE(k < 8000);
        REQUIRE(model.step(dt) == Status::ok);
        const double now = model.energy().sum();
        REQUIRE(now <= energy * (1 + 1e-9));
        energy = now;
        const Place& tip = model.shape().at(L).r;
        const double w = second ? tip.z() : tip.y();
        reach = std::max(reach, w);
        if (before < 0 && w >= 0) crossings.push_back((k - w / (w - before)) * dt);
        if (before >= 0 && w < 0) peaks.push_back(reach), reach = 0;
        before = w, last = w;
      }
      const double periods = 3, found = 2 * pi * periods / (crossings[5] - crossings[2]),
                   decrement = std::log(peaks[2] / peaks[5]) / (2 * pi * periods),
                   damped = omega * std::sqrt(1 - ratio * ratio);
      CAPTURE(flat, second, found / damped - 1, decrement / (ratio / std::sqrt(1 - ratio * ratio)) - 1, last);
      CHECK(found == Approx(damped).epsilon(2e-4));
      CHECK(decrement == Approx(ratio / std::sqrt(1 - ratio * ratio)).epsilon(1e-3));
    }
}

// A hook of three quarters of a circle, opened and let go.
TEST_CASE("a viscous rod that is bent by nature and let go from afar never has more energy", "[dynamics]") {
  for (const double dt : {1e-3, 1e-4}) {
    RodMaterial material = nylon(1100);
    material.damping = Damping::ratio(0.01, 20);
    material.damping.branches = {{{0.5, 0.02}, {0.3, 0.3}}};
    Rod hook = cantilever(material, true);
    hook.naturally({{0.2, 0, 15, 0}});
    Rod open = hook;
    open.add(RodForce{0.2, {0.02, 0.05, 0.1}});
    Model model(hook, 16, 1);
    const double home = model.energy().sum();
    const Place rest = model.shape().at(0.2).r;
    model.let_go_from(FemModel<TwistedRod>(open, 16).shape());
    const double begin = model.energy().sum() - home;
    REQUIRE((model.shape().at(0.2).r - rest).norm() > 0.03);
    double energy = begin;
    for (int k = 0; k * dt < 1; ++k) {
      REQUIRE(model.step(dt) == Status::ok);
      const double now = model.energy().sum() - home;
      REQUIRE(now <= energy + 1e-9 * begin);
      energy = now;
    }
    CAPTURE(dt, energy / begin);
    CHECK(energy < 0.05 * begin);
    CHECK(energy > 0);
  }
}

// In the material the bend turns.  By the complex modulus at Ω = 2π rate,
//   E*/E = 1 + iΩτ + g iΩτ1/(1 + iΩτ1),
// the tip is w E/E* from the axis, ahead of its load F, and the clamp twists the rod by F times its way aside.
TEST_CASE("a hand that rolls a bent viscous rod twists it, though nothing holds its other end",
          "[dynamics]") {
  const double rate = 2, g = 0.5, tau1 = 0.05, tau = 0.01, omega = 2 * pi * rate, L = 0.2, w = 2e-4;
  RodMaterial material = nylon();
  material.damping.branches[0] = {g, tau1};
  material.damping.viscosity = tau;
  Rod rod = cantilever(material, false);
  const double force = 3 * rod.stiffness().bending1 * w / (L * L * L);
  rod.add(RodForce{L, {0, 0, -force}});
  using Complex = std::complex<double>;
  const Complex i(0, 1), tip = w / (1.0 + i * omega * tau + g * i * omega * tau1 / (1.0 + i * omega * tau1));
  constexpr int parts = 400;
  Model model(rod, 8, 1);
  // After two turns what it had from its start is gone, as exp(-t/τ1).
  for (int k = 1; k <= 2 * parts; ++k) {
    REQUIRE(model.hold(RodSide::left, rolled(2 * pi * k / parts)) == Status::ok);
    REQUIRE(model.step(1 / (rate * parts)) == Status::ok);
  }
  const Place at = model.shape().at(L).r;
  const double twists = model.reaction(RodSide::left).moment.x();
  CAPTURE(at.y() / w, at.z() / w, tip / w, twists / (force * w));
  // (w/L)² of the bend, and 0.04 (Ω dt)² of the steps.
  CHECK(std::abs(Complex(-at.z(), -at.y()) - tip) <= 2e-5 * w);
  CHECK(std::abs(twists + force * tip.imag()) <= 2e-5 * force * w);
}

// One mode q = y + iz of a shaft that turns:  q" + 2ζω (q' - iΩq) + ω² q = 0.  It whirls as e^(λt), with the torque of what its angular momentum gains.
TEST_CASE("a viscous rod whirls where it is rolled faster than it vibrates, by the work of its hand",
          "[dynamics]") {
  const double beta = 1.8751040687119611, ratio = 0.05, L = 0.2;
  const Rod elastic = cantilever(nylon(1100), false);
  const double omega =
      beta * beta / (L * L) * std::sqrt(elastic.stiffness().bending1 / elastic.mass_per_length(0));
  RodMaterial material = nylon(1100);
  material.damping = Damping::ratio(ratio, omega / (2 * pi));
  using Complex = std::complex<double>;
  struct Case {
    double faster, size;  // of which the spin hides no motion, and none is large
  };
  for (const auto& [faster, size] : {Case{0.5, 1e-3}, {3, 1e-6}}) {
    const double turns = faster * omega, dt = 2 * pi / omega / 400;
    const Complex half(ratio * omega, 0),
        lambda = -half + std::sqrt(half * half - omega * omega + 2.0 * half * Complex(0, turns));
    const Rod rod = cantilever(material, false);
    Rod pulled = rod;
    pulled.add(RodForce{L, {0, size * 3 * rod.stiffness().bending1 / (L * L * L), 0}});
    Model model(rod, 8, 1);
    // Thrown round the axis, as it whirls; what else it does dies first.
    const FemModel<TwistedRod> bent(pulled, 8);
    const auto shape = bent.shape();
    model.let_go_from(shape, [&](double s) {
      const auto at = shape.at(s);
      VectorOf<double, 6> v = VectorOf<double, 6>::Zero();
      v[2] = omega * at.r.y(), v[5] = omega * at.tangent.y();
      return v;
    });
    double work = 0, moment = 0, energy = 0, aside = 0;
    const int begin = 2400, end = 3600;
    for (int k = 1; k <= end; ++k) {
      REQUIRE(model.hold(RodSide::left, rolled(turns * dt * k)) == Status::ok);
      REQUIRE(model.step(dt) == Status::ok);
      const double now = model.reaction(RodSide::left).moment.x();
      work += turns * dt * (now + moment) / 2, moment = now;
      if (k == begin) work = 0, energy = model.energy().sum(), aside = off_axis(model);
    }
    const double t = (end - begin) * dt, grows = std::log(off_axis(model) / aside) / t,
                 gained = model.energy().sum() - energy,
                 share = 2 * turns * lambda.imag() / (std::norm(lambda) + omega * omega);
    CAPTURE(faster, grows, lambda, off_axis(model), gained, work, work / gained / share - 1,
            grows / lambda.real() - 1);
    // 4 (ω dt)²
    CHECK(grows == Approx(lambda.real()).epsilon(1e-3));
    CHECK(work == Approx(share * gained).epsilon(1e-3));
  }
}

TEST_CASE("a round rod without twist is elastic, and says so", "[dynamics]") {
  RodMaterial material = nylon(1100);
  material.damping = Damping::ratio(0.01, 20);
  CHECK_THROWS_WITH(DynamicModel<RoundRod>(cantilever(material, false), 8),
                    Catch::Matchers::ContainsSubstring("TwistedRod"));
  material.damping.branches[0] = {-0.1, 1};
  CHECK_THROWS_WITH(cantilever(material, false), Catch::Matchers::ContainsSubstring("relaxation share"));
}

// Statics between are those of the elastic rod.
TEST_CASE("a viscous rod of a World moves as it does alone", "[dynamics][world]") {
  RodMaterial material = nylon(1100);
  material.damping = Damping::ratio(0.02, 20);
  material.damping.branches[0] = {0.4, 0.01};
  const Rod rod = cantilever(material, true);
  Model model(rod, 8);
  World<TwistedRod> world({{rod, 8}});
  const auto velocity = [](double s) {
    VectorOf<double, 6> all = VectorOf<double, 6>::Zero();
    all[1] = 30 * s * s, all[2] = 20 * s * s, all[4] = 60 * s, all[5] = 40 * s;
    return all;
  };
  model.let_go_from(model.shape(), velocity), world.throw_rod(0, velocity);
  const double begin = world.energy().sum();
  double off = 0, most = 0;
  for (int k = 0; k < 200; ++k) {
    REQUIRE(model.step(1e-3) == Status::ok);
    REQUIRE(world.step(1e-3) == Status::ok);
    const Place tip = model.shape().at(0.2).r;
    off = std::max(off, (world.shape(0).at(0.2).r - tip).norm());
    most = std::max(most, (tip - Place(0.2, 0, 0)).norm());
    REQUIRE(std::abs(world.energy().sum() - model.energy().sum()) <= 1e-9 * begin);
  }
  CAPTURE(off, most);
  CHECK(most > 1e-3);
  CHECK(off <= 1e-9 * most);
  CHECK(world.energy().sum() < 0.5 * begin);
  REQUIRE(world.tick() == Status::ok);
  CHECK(world.strain_energy() <= 1e-12 * begin);
  CHECK((world.shape(0).at(0.2).r - Place(0.2, 0, 0)).norm() <= 1e-9);
}
