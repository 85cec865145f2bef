// Rods with mass that twist: torsion and both planes of a flat rod against closed forms, energy, a bent rod that is let go, and a hand that holds an end in the loop.
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random.hpp"
#include "support/turning_response.hpp"
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/haptics/held/grip.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

using Model = DynamicModel<TwistedRod>;
using Place = VectorOf<double, 3>;
using Vector6d = VectorOf<double, 6>;

const RodMaterial steel = RodMaterial::isotropic(200e9, 0.3, 7850);

struct Nodes {
  std::vector<RodNode<double>> nodes;
  Centreline<double, 3> shape() const { return {nodes.data(), static_cast<int>(nodes.size())}; }
};
/// [1/s] by so many periods of what passes zero, of `per` steps each.   @param of  (model) -> number   @param about [1/s]
template <class Of>
double frequency(Model& model, double about, int per, int periods, Of&& of) {
  const double dt = 2 * pi / (about * per);
  double last = of(model), first = -1;
  for (int k = 1, passed = 0; k < 2 * per * (periods + 2); ++k) {
    if (model.step(dt) != Status::ok) return 0;
    const double now = of(model);
    if (last < 0 && now >= 0) {
      const double at = (k - 1 + last / (last - now)) * dt;
      if (first < 0) first = at;
      else if (++passed == periods) return 2 * pi * periods / (at - first);
    }
    last = now;
  }
  return 0;
}

}  // namespace

// Clamped and free: √(GJ/ρI_p) (2n - 1) π/2L.  Half of the mass of an angle that is linear in each element and half of it at the nodes: (kl)⁴/480 too slow.
TEST_CASE("a rod that twists has the torsional frequencies of its shaft, to fourth order", "[dynamics]") {
  const double L = 0.3;
  for (const bool flat : {false, true}) {
    const Rod rod(L, flat ? RodSection::rectangle(0.012, 0.003) : RodSection::circle(0.004), steel,
                  RodSupport::clamped, RodSupport::free);
    // I_p of the section.
    const double I =
        flat ? 0.012 * 0.003 * (0.012 * 0.012 + 0.003 * 0.003) / 12 : pi * std::pow(0.004, 4) / 32;
    CHECK(rod.spin_per_length(0.1) == Approx(7850 * I).epsilon(1e-12));
    for (const int mode : {1, 2}) {
      const double k = (2 * mode - 1) * pi / (2 * L),
                   omega = k * std::sqrt(rod.stiffness().torsion / (7850 * I));
      double coarse = 0;
      for (const int n : {4, 8}) {
        Nodes twisted;
        for (int i = 0; i <= n; ++i) {
          const double s = L * i / n, angle = 1e-3 * std::sin(k * s);
          twisted.nodes.push_back(
              {s, Place(s, 0, 0), Place(1, 0, 0), Place(0, std::cos(angle), std::sin(angle))});
        }
        Model model(rod, n, 1);
        model.let_go_from(twisted.shape());
        const double got = frequency(model, omega, mode == 1 ? 1500 : 500, 6,
                                     [n](const Model&m) { return m.shape()[n].director.z(); }),
                     off = std::abs(got / omega - 1), size = std::pow(k * L / n, 4) / 480;
        CAPTURE(flat, mode, n, off, size);
        CHECK(off >= 0.7 * size);
        CHECK(off <= 1.3 * size + 2e-6);
        if (n == 8 && mode == 2) CHECK(coarse >= 13 * off);
        coarse = off;
      }
    }
  }
}

TEST_CASE("a flat rod swings across both axes of its section as its Euler-Bernoulli beams do", "[dynamics]") {
  const double L = 0.3, beta = 1.8751040687119611;
  const Rod rod(L, RodSection::rectangle(0.006, 0.002), steel, RodSupport::clamped, RodSupport::free);
  for (const bool wide : {false, true}) {
    const double EI = wide ? std::max(rod.stiffness().bending1, rod.stiffness().bending2)
                           : std::min(rod.stiffness().bending1, rod.stiffness().bending2),
                 omega = beta * beta * std::sqrt(EI / rod.mass_per_length(0)) / (L * L);
    // d1 is along the width: a push along it bends what is stiff.
    Rod pulled = rod;
    const double force = 3 * EI / (L * L * L) * 1e-4;
    pulled.add(RodForce{L, wide ? Place(0, force, 0) : Place(0, 0, force)});
    Model model(rod, 8, 1);
    model.let_go_from(FemModel<TwistedRod>(pulled, 8).shape());
    const double got =
        frequency(model, omega, 400, 8, [&](const Model& m) { return m.shape()[8].r[wide ? 1 : 2]; });
    CAPTURE(wide, got / omega - 1);
    // Its modes above the first one pass zero, too: 1 % of that, once in six periods of the second.
    CHECK(got == Approx(omega).epsilon(5e-4));
    CHECK(std::abs(model.shape()[8].r[wide ? 2 : 1]) <= 1e-9);
  }
}

TEST_CASE("rods that twist, straight and bent by nature, never have more energy than when they were let go",
          "[dynamics]") {
  for (const bool bent : {false, true})
    for (const double dt : {1e-3, 1e-4}) {
      const double L = 0.3;
      const RodSupport loose{1e-12, 1e-12, 1e-12, 0, 0, 1e-12};
      Rod rod(L, RodSection::rectangle(0.006, 0.002), steel, bent ? RodSupport::clamped : loose,
              bent ? RodSupport::free : loose);
      if (bent) rod.naturally({{0.15, 0, 0, 0}, {L, 8, 3, 1}});
      Model model(rod, 8, 1);
      if (bent) {
        Rod pulled = rod;
        const double F = 1.5 * rod.stiffness().bending2 / (L * L);
        pulled.add(RodForce{L, {0.2 * F, F, 0.7 * F}});
        model.let_go_from(FemModel<TwistedRod>(pulled, 8).shape());
        // What is stored in the shape of a static model is in that which takes it.
        const FemModel<TwistedRod> same(pulled, 8);
        CHECK(model.energy().strain == Approx(same.strain_energy()).epsilon(1e-6));
      } else {
        model.let_go_from(model.shape(), [](double s) {
          return Vector6d(
              (Vector6d() << 0.3, 5 * (s - 0.15) + 8 * s * s, 3 * (s - 0.15), 0, 5 + 16 * s, 3).finished());
        });
      }
      const double energy = model.energy().sum();
      double most = 0;
      // Less than half a turn, by which springs hold its twist.
      for (int k = 0; k < 300; ++k) {
        REQUIRE(model.step(dt) == Status::ok);
        most = std::max(most, model.energy().sum());
      }
      CAPTURE(bent, dt, energy, model.energy().sum());
      CHECK(most <= energy * (1 + 1e-9));
      CHECK(model.energy().sum() >= energy * (dt > 5e-4 ? 0.5 : 0.97));
      CHECK(model.energy().kinetic > 0);
    }
}

TEST_CASE(
    "a fishing rod in the hand of a loop: shaken, let go and taken, it gives nothing that it has not got",
    "[dynamics]") {
  VirtualPhantomOptions six;
  six.gimbal.present = true;
  VirtualPhantom<> device(HandPath({0, 0})
                              .rest(0.3)
                              .press(0.03, 0.1)
                              .release(0.03, 0.1)
                              .turn({0, 0.4, 0}, 0.15)
                              .turn({0, -0.4, 0}, 0.15)
                              .rest(1.2),
                          six);
  const GripCoupling hand = GripCoupling::for_device(device.info());
  RodMaterial material = RodMaterial::isotropic(10e9, 0.3, 1800);
  material.damping.drag = 3;
  Rod rod(0.5, RodSection::circle(0.004), material, hand.support(), RodSupport::free);
  rod.place_left({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}});
  Model model(rod, 8);
  Grip<Model> grip(model, RodSide::left);
  ServoLoop loop(device, grip);
  double most = 0, rings = 0;
  for (int k = 0; k < 30; ++k) {
    device.run(loop.servo(), 0.1);
    if (k == 12) grip.let_go();
    if (k == 20) grip.take();
    const ServoRecord& record = loop.servo().record();
    const double kinetic = model.energy().kinetic;
    most = std::max(most, kinetic);
    if (k <= 13 || k >= 20) continue;
    rings = std::max(rings, kinetic);
    CHECK(record.force.isZero(0));
  }
  const ServoRecord& record = loop.servo().record();
  CAPTURE(most, rings, record.force.norm());
  CHECK(record.failed_ticks == 0);
  CHECK(record.energy_generated <= 1e-6);
  CHECK(most > 1e-4);
  CHECK(rings > 1e-7);
  CHECK(record.max_force > 0.1);
  CHECK(record.force.norm() < 0.01);
}

TEST_CASE("a hand that leans and twists on an end of a rod with mass gains nothing", "[dynamics]") {
  Random random(31);
  for (int i = 0; i < 8; ++i) {
    VirtualPhantomOptions who;
    who.gimbal.present = true;
    who.hand = {random(300, 1000), random(0, 2), random(0.05, 0.4)};
    const double square = grip_lever * grip_lever;
    who.gimbal.hand_stiffness = random(300, 1000) * square, who.gimbal.hand_damping = random(0, 2) * square;
    who.gimbal.grip_inertia = random(0.05, 0.4) * square;
    who.gimbal.damping = random(1e-3, 5e-3), who.gimbal.friction = random(1e-3, 5e-3);
    who.arm.period = random(0.5e-3, 2e-3), who.arm.delay_ticks = random.integer(0, 3);
    ServoOptions options;
    options.delay_ticks = who.arm.delay_ticks;
    const DeviceInfo device = VirtualPhantom<Turning>(Turning{}, who).info();
    const double d = random(0.001, 0.008);
    Rod rod(random(0.1, 0.4), RodSection::circle(d),
            RodMaterial::isotropic(3e9, 0.36, std::pow(10, random(2.5, 4))),
            GripCoupling::for_device(device, options.delay_ticks).support(),
            i % 2 == 0 ? RodSupport::free : RodSupport::clamped);
    rod.place_left({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}});
    Model model(rod, 8, i % 3 == 0 ? 1 : 4);
    Grip<Model> grip(model, RodSide::left);
    Turning hand;
    for (int k = 0; k < 3; ++k) hand.push[k] = random(2.), hand.twist[k] = random(0.05);
    const TurningResponse r = turning_response(grip, hand, who, options, 0.4, 0.6);
    CAPTURE(i, d, who.arm.period, who.arm.delay_ticks, r.least_energy, r.generated);
    CHECK(r.least_energy >= -1e-9);
    CHECK(r.generated <= 1e-9 + r.max_torque * who.gimbal.resolution + r.max_force * who.arm.resolution);
    CHECK(r.record.failed_ticks == 0);
    CHECK(r.max_force > 0.01);
  }
}

TEST_CASE("a strip with mass that a hand draws too taut edgewise for its elements says so", "[dynamics]") {
  const double length = 0.2;
  const Rod strip(length, RodSection::rectangle(0.001, 0.0005), steel, RodSupport::clamped,
                  RodSupport::clamped);
  Model model(strip, 8);
  const Place edge = strip.left_pose().director;
  Coupled<double, 3> hand{{0.09, {0.09 * Place(1, 0, 0), Place::Zero()}, 0.005, edge}, 2000, 1};
  const auto pressed = [&](double depth) {
    Pushed<double, 3> felt{0, Status::ok};
    for (int k = 0; k < 200; ++k) {
      hand.hand.axis.tip = Place(0.09, 0, 0) + (0.005 - depth * k / 200) * edge;
      felt = model.step(1e-3, hand);
    }
    CHECK(felt.force < -0.01);
    return felt.status;
  };
  CHECK(pressed(0.0006) == Status::ok);
  CHECK(pressed(0.01) == Status::out_of_range);
  CHECK(model.step(-1, hand).status == Status::invalid_request);
}
