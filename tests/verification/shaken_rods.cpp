// A hand that leads the held end of a rod with mass: the steady shake of a clamped-free rod in closed form, work against energy, balance, and requests.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Model = DynamicModel<RoundRod>;
using Place = VectorOf<double, 3>;
using Complex = std::complex<double>;

/// Turned about z.
RodPose pose(const Place& at, double turn) {
  return {at, {std::cos(turn), std::sin(turn), 0}, {-std::sin(turn), std::cos(turn), 0}};
}
Rod steel(const RodSupport& left, const RodSupport& right, double drag = 0) {
  RodMaterial material = RodMaterial::isotropic(200e9, 0.3, 7850);
  material.damping.drag = drag;
  return Rod(0.3, RodSection::circle(0.002), material, left, right);
}

/// What a hand leads by, and what follows: force and moment on the rod, and place of the tip, of a unit of a steady shake.
struct Shaken {
  Complex force, moment, tip;
};
/// Of a rod of bending stiffness EI, mass m a length and drag α:  EI w'''' = m (ω² - iωα) w = EI b⁴ w,  clamped where the hand is.
Shaken steady(const Rod& rod, double omega, double drag) {
  const double EI = rod.stiffness().bending1, L = rod.length();
  const Complex b = std::pow(rod.mass_per_length(0) * Complex(omega * omega, -omega * drag) / EI, 0.25),
                x = b * L, ch = std::cosh(x), sh = std::sinh(x), c = std::cos(x), s = std::sin(x),
                over = 1. + ch * c;
  return {-EI * b * b * b * (s * ch + c * sh) / over, -EI * b * b * s * sh / over, (ch + c) / over};
}
/// @param per  steps a period, of one part
Shaken measured(const Rod& rod, double omega, int per, int cycles) {
  Model model(rod, 8, 1);
  const double size = 3e-5, dt = 2 * pi / (omega * per);
  Shaken sum{0, 0, 0};
  constexpr int last = 4;
  for (int k = 1; k <= cycles * per; ++k) {
    const double angle = 2 * pi * k / per, grown = std::min(1.0, angle / (20 * pi));
    bool found = model.hold(RodSide::left, pose({0, size * grown * std::sin(angle), 0}, 0)) == Status::ok;
    found = found && model.step(dt) == Status::ok;
    if (!found) return {0, 0, 0};
    if (k <= (cycles - last) * per) continue;
    const HeldEnd<double> held = model.reaction(RodSide::left);
    const Complex by = Complex(std::sin(angle), std::cos(angle)) * (2 / (size * last * per));
    sum.force += held.force.y() * by, sum.moment += held.moment.z() * by;
    sum.tip += model.shape().at(0.3).r.y() * by;
  }
  return sum;
}

}  // namespace

// The end's node stands for a part of the end element's mass, whose acceleration is that of the middle one of three poses: a step late.
TEST_CASE("a hand that shakes a clamped end feels what the Euler-Bernoulli rod gives", "[dynamics]") {
  const double first = 1.8751040687119611 * 1.8751040687119611 *
                       std::sqrt(steel(RodSupport::clamped, RodSupport::free).stiffness().bending1 /
                                 steel(RodSupport::clamped, RodSupport::free).mass_per_length(0)) /
                       (0.3 * 0.3);
  const double drag = 0.2 * first;  // a damping ratio of 10 % at the first mode
  const Rod rod = steel(RodSupport::clamped, RodSupport::free, drag);
  struct Expected {
    double frequency, force, moment, tip;  // of the first mode, and errors of the answers
  };
  for (const Expected& expected : {Expected{0.9, 3e-3, 5e-4, 4e-4},
                                   {1.1, 3e-3, 5e-4, 5e-4},
                                   {3, 0.013, 7e-3, 1e-4},
                                   {6, 2e-3, 1.5e-3, 1.5e-3},
                                   {6.6, 4e-3, 2e-3, 2e-3}}) {
    const double omega = expected.frequency * first;
    const Shaken exact = steady(rod, omega, drag);
    // Transients fall by exp(-0.2 π) a period of the first mode.
    const int cycles = static_cast<int>(20 * expected.frequency) + 14;
    const auto off = [&](const Shaken& got) {
      return Shaken{std::abs(got.force / exact.force - 1.), std::abs(got.moment / exact.moment - 1.),
                    std::abs(got.tip / exact.tip - 1.)};
    };
    const Shaken fine = off(measured(rod, omega, 200, cycles)),
                 coarse = off(measured(rod, omega, 50, cycles));
    CAPTURE(expected.frequency, fine.force, fine.moment, fine.tip, coarse.force, coarse.moment, coarse.tip);
    CHECK(std::abs(exact.force) > 1);
    CHECK(fine.force.real() <= expected.force);
    CHECK(fine.moment.real() <= expected.moment);
    CHECK(fine.tip.real() <= expected.tip);
    CHECK(coarse.force.real() >= 3 * fine.force.real());                           // of first order
    if (expected.frequency < 6) CHECK(coarse.tip.real() >= 12 * fine.tip.real());  // of second
  }
}

TEST_CASE("what a hand does to the springs that hold an end is in the rod, to second order of the tick",
          "[dynamics]") {
  const RodSupport springs = RodSupport::elastic(800, 800, 800, 5, 5, 5);
  const auto rod = [&] {
    Rod plastic(1, RodSection::circle(0.006), RodMaterial::isotropic(3e9, 0.3, 1200), springs,
                RodSupport::free);
    return plastic.weight(1200, {0, -9.81, 0});
  };
  double before = 0;
  for (const bool damped : {false, true})
    for (const double dt : {1e-3, 5e-4}) {
      Model model(rod(), 8, 4);
      const double rest = model.energy().sum();
      const double share = damped ? 0.6 : 0;
      RodPose last = pose({0, 0, 0}, 0);
      HeldEnd<double> held = model.reaction(RodSide::left);
      double work = 0, most = 0, angle = 0, stopped = 0;
      for (int k = 1; k * dt <= 1; ++k) {
        // Shaken and turned for 0.6 s, then held.
        const double t = std::min(k * dt, 0.6), s = std::sin(pi * t / 0.6),
                     shake = s * s * std::sin(10 * pi * t), turn = 0.5 * shake;
        const RodPose to = pose({0, 0.05 * shake, 0.03 * s * s * std::cos(8 * pi * t)}, turn);
        REQUIRE(model.hold(RodSide::left, to, {share, share, 1e-3}) == Status::ok);
        REQUIRE(model.step(dt) == Status::ok);
        const HeldEnd<double> now = model.reaction(RodSide::left);
        work += (now.force + held.force).dot(to.at - last.at) / 2 +
                (now.moment + held.moment).z() * (turn - angle) / 2;
        held = now, last = to, angle = turn;
        const double energy = model.energy().sum() - rest;
        most = std::max(most, energy);
        if (k * dt <= 0.6 + 2.5 * dt) stopped = energy;
        CAPTURE(k, dt, damped);
        REQUIRE(energy <= stopped + (damped ? 0 : 1e-4 * most));
      }
      CAPTURE(dt, damped, work, stopped, most);
      CHECK(most > 1);
      if (damped) {
        CHECK(work > stopped + most / 2);
      } else {
        const double off = std::abs(work - stopped);
        CHECK(off <= 2e-4 * most);
        if (dt < 1e-3) CHECK(off <= before / 3);
        before = off;
      }
    }
}

TEST_CASE("hands that touch a rod in an end's element and elsewhere, and its ends, hold each other",
          "[dynamics]") {
  for (const bool taut : {false, true})
    for (const double s : {0.02, 0.2}) {
      Model model(steel(RodSupport::clamped, taut ? RodSupport::clamped : RodSupport::free, 200), 8, 2);
      const Coupled<double, 3> hand{{s, {Place(s, 0, 0.003), Place::Zero()}, 0.005, Place(0, 0, 1)}, 2000, 1};
      Pushed<double, 3> felt{};
      for (int k = 0; k < 1500; ++k) felt = model.step(1e-3, hand);
      const HeldEnd<double> left = model.reaction(RodSide::left), right = model.reaction(RodSide::right);
      const Place force = felt.force * felt.normal, end = model.shape().at(0.3).r;
      CAPTURE(taut, s, force.norm());
      CHECK(force.norm() > 0.1);
      CHECK((left.force + right.force + force).norm() <= 1e-6 * force.norm());
      CHECK((left.moment + right.moment + detail::cross3<double>(felt.point, force) +
             detail::cross3<double>(end, right.force))
                .norm() <= 1e-6 * force.norm() * s);
    }
}

TEST_CASE("loads are in the energy of a rod at rest, from the first step on", "[dynamics]") {
  Rod rod = steel(RodSupport::clamped, RodSupport::free);
  Model model(rod.weight(7850, {0, 0, -9.81}), 8);
  const double rest = model.energy().sum();
  REQUIRE(model.step(1e-3) == Status::ok);
  CHECK(rest < -1e-5);
  CHECK(model.reaction(RodSide::left).force.z() == Approx(rod.mass_per_length(0) * 0.3 * 9.81).epsilon(1e-6));
  CHECK(model.energy().sum() == Approx(rest).epsilon(1e-9));
}

TEST_CASE(
    "ends that are held otherwise, poses and dampers that are none are rejected; a late tick goes all the "
    "way",
    "[dynamics]") {
  Model model(steel(RodSupport::clamped, RodSupport::hinged), 8);
  const auto bits = [&] { return model.shape().at(0.3).r; };
  const Place rest = bits();
  CHECK(model.hold(RodSide::right, pose({0.3, 0, 0}, 0)) == Status::invalid_request);
  CHECK(model.hold(RodSide::left, pose({0, NAN, 0}, 0)) == Status::invalid_request);
  CHECK(model.hold(RodSide::left, pose({0, 1e80, 0}, 0)) == Status::invalid_request);
  CHECK(model.hold(RodSide::left, pose({0, 0.1, 0}, 0), {1, 0, 1e-3}) == Status::invalid_request);
  CHECK(model.hold(RodSide::left, pose({0, 0.1, 0}, 0), {0, -0.1, 1e-3}) == Status::invalid_request);
  CHECK(model.hold(RodSide::left, pose({0, 0.1, 0}, 0), {0, 0, 0}) == Status::invalid_request);
  REQUIRE(model.step(1e-3) == Status::ok);
  CHECK((bits() - rest).norm() <= 1e-15);
  Model late(steel(RodSupport::clamped, RodSupport::free), 8), timely = late;
  for (Model* each : {&late, &timely}) {
    REQUIRE(each->hold(RodSide::left, pose({0, 0.002, 0}, 0.1)) == Status::ok);
    REQUIRE(each->step(each == &late ? 0.05 : Model::longest) == Status::ok);
    CHECK(each->shape()[0].r == Place(0, 0.002, 0));
  }
  const Place one = late.shape().at(0.3).r, other = timely.shape().at(0.3).r;
  CHECK(std::memcmp(one.data(), other.data(), sizeof one) == 0);
  late.reset();
  REQUIRE(late.step(1e-3) == Status::ok);
  CHECK(late.shape()[0].r == Place(0, 0, 0));
  CHECK(late.energy().sum() <= 1e-12);
}
