// A step of a beam with mass: no heap, and a bounded number of linear solves, whatever the hand does.
#include <array>
#include <cmath>
#include <limits>
#include <realtime/heap_watch.hpp>
#include <realtime/lock_watch.hpp>

#include "once_training.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>
#include <hapbeam/haptics/servo/sound.hpp>
#include <hapbeam/rom/training/modes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEST_CASE("a step of a beam with mass allocates nothing and is bounded", "[dynamics]") {
  const Beam beam(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850}, Support::clamped,
                  Support::free);
  DynamicModel<> model(beam, 8, 2);
  // Each of two parts may be halved three times, and each piece has two stages of up to four solutions.
  constexpr int most = 2 * 15 * 2 * 4 * 48;
  Random random(5);
  int failed = 0;
  const auto step = [&](double x, double y, double dt) {
    Pushed<double> felt{0, Status::ok};
    CHECK(heap_use([&] { felt = model.step(dt, {{0.2, {x, y}, 0.005, 1}, 3500, 2}); }) == HeapUse{});
    CHECK(std::isfinite(felt.force));
    CHECK(model.solves() <= most);
    for (int i = 0; i < model.shape().size(); ++i) REQUIRE(is_finite(model.shape()[i]));
    failed += felt.status == Status::iteration_limit;
  };
  for (int k = 0; k < 300; ++k) step(0.2, 0.006 - 1e-4 * k, 1e-3);
  CHECK(failed == 0);
  // One that jumps to places where no step of it has a solution, and past the ends.
  for (int k = 0; k < 300; ++k) step(random(-0.1, 0.5), random(0.3), random(0, 3e-3));
  step(0.2, std::numeric_limits<double>::quiet_NaN(), 1e-3);
  model.reset();
  CHECK(heap_use([&] { (void)model.step(1e-3), model.reset(), (void)model.energy(); }) == HeapUse{});
  step(0.2, 0.0049, 1e-3);
}

TEST_CASE("hands that rub, rods and beams that creep allocate nothing", "[dynamics]") {
  DynamicModel<Several<Corotational<>, 2>> two(
      Beam(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850}, Support::clamped, Support::free), 8,
      2);
  DynamicModel<RoundRod> rod(Rod(0.3, RodSection::circle(0.002), RodMaterial::isotropic(200e9, 0.3, 7850),
                                 RodSupport::clamped, RodSupport::free),
                             8, 2);
  Material creeping{200e9};
  creeping.damping.branches[0] = {0.5, 0.2};
  DynamicModel<> creeps(
      Beam(0.3, Section::rectangle(0.025, 0.001), creeping, Support::clamped, Support::free), 8, 1);
  FrictionState<double, 2> friction[2];
  for (auto& state : friction) state.sticking = 0.5, state.sliding = 0.4;
  Random random(6);
  int touched = 0, failed = 0;
  for (int k = 0; k < 200; ++k) {
    // At last they are anywhere.
    const double wild = k < 150 ? 0 : 0.2, y = 0.006 - 5e-5 * k;
    const auto at = [&](double x) { return Vector2<double>(x + random(wild), y + random(wild)); };
    const Coupled<double> hands[2] = {{{0.1, at(0.1 + 1e-4 * k), 0.005, 1}, 2000, 1, &friction[0]},
                                      {{0.2, at(0.2), 0.005, 1}, 2000, 1, &friction[1]}};
    const Coupled<double, 3> in_space{
        {0.2,
         {VectorOf<double, 3>(0.2, random(wild), y + random(wild)), VectorOf<double, 3>::Zero()},
         0.005,
         VectorOf<double, 3>(0, 0, 1)},
        2000,
        1};
    Pushed<double> felt[2];
    Pushed<double, 3> of_rod;
    CHECK(heap_use([&] {
            failed += two.step(1e-3, hands, 2, felt) != Status::ok;
            of_rod = rod.step(1e-3, in_space);
            failed += creeps.step(1e-3, hands[1]).status != Status::ok;
          }) == HeapUse{});
    failed += of_rod.status != Status::ok;
    for (const auto& one : felt) {
      CHECK(std::isfinite(one.force));
      touched += one.force < 0;
    }
    CHECK(std::isfinite(of_rod.force));
    touched += of_rod.force < 0;
    if (k == 149) CHECK(failed == 0);
  }
  CHECK(touched > 200);
}

TEST_CASE("an end that a hand leads, anywhere in the end, allocates nothing and leaves numbers",
          "[dynamics]") {
  const RodSupport springs = RodSupport::elastic(800, 800, 800, 0.5, 0.5, 0.5);
  RodMaterial viscous = RodMaterial::isotropic(3e9, 0.3, 1200);
  viscous.damping.branches[0] = {0.5, 0.1};
  DynamicModel<TwistedRod> model(
      Rod(0.3, RodSection::rectangle(0.004, 0.002), viscous, springs, RodSupport::free), 8, 2);
  Random random(7);
  int failed = 0;
  for (int k = 0; k < 400; ++k) {
    const double wild = k < 200 ? 0 : 1, turn = 0.5 * std::sin(0.02 * k) + random(wild);
    const RodPose pose{{random(wild), 0.03 * std::sin(0.05 * k) + random(wild), 0},
                       {std::cos(turn), std::sin(turn), 0},
                       {0, random(wild), 1}};
    HeldEnd<double> held;
    CHECK(heap_use([&] {
            (void)model.hold(RodSide::left, pose, {0.5, 0.3, 1e-3});
            held.status = model.step(1e-3);
            failed += held.status != Status::ok;
            held = model.reaction(RodSide::left);
          }) == HeapUse{});
    CHECK(held.force.allFinite());
    CHECK(held.moment.allFinite());
    for (int i = 0; i < model.shape().size(); ++i) REQUIRE(is_finite(model.shape()[i]));
    if (k == 199) CHECK(failed == 0);
  }
}

TEST_CASE("modes under a hand that goes anywhere allocate nothing and leave numbers", "[dynamics]") {
  ModalModel<> model(modes_of(Beam(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850},
                                   Support::clamped, Support::free),
                              8),
                     4);
  Random random(9);
  for (int k = 0; k < 400; ++k) {
    const double wild = k < 200 ? 0.002 : 1;
    const Coupled<double> hand{
        {random(0, 0.3), {random(0, 0.3) + random(wild), 0.005 + random(wild)}, 0.005, 1}, 1000, 1};
    Pushed<double> felt{};
    Vector2<double> held, moves;
    CHECK(heap_use([&] {
            felt = model.step(k % 50 == 49 ? 1 : 1e-3, hand);
            held = model.reaction(0), moves = model.velocity(0.3);
            if (k % 100 == 99) model.reset(), model.let_go_of(0.3, {0, 0.1});
          }) == HeapUse{});
    CHECK(std::isfinite(felt.force));
    CHECK((held.allFinite() && moves.allFinite() && std::isfinite(model.energy().sum())));
    for (const auto& node : model.shape()) REQUIRE(is_finite(node));
  }
}

TEST_CASE("a loop of a beam with mass, through faults and resets: no heap, no lock", "[dynamics]") {
  using Mass = Servo<DynamicModel<>>;
  static_assert(noexcept(std::declval<Mass&>().tick(std::declval<const DeviceState&>())));
  Material material{200e9, 7850, Damping::ratio(0.01, 9)};
  material.damping.branches[0] = {0.2, 0.1};
  const Beam beam(0.3, Section::rectangle(0.025, 0.001), material, Support::clamped, Support::free);
  DynamicModel<> model(beam, 8, 2);
  VirtualPhantom<> phantom(HandPath({0, 0.01}).rest(0.3).press(0.02, 0.3).release(0.04, 0.02).rest(0.2));
  ServoOptions options;
  options.placement = Placement::in_plane({0.25, 0});
  options.dissipate = true;
  ServoLoop loop(phantom, model, options);
  Sound sound(model, {SoundSource::left_support, 0, 44100, 0.1});
  std::array<float, 441> samples;
  int heard = 0;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Random random(2);
  int not_finite = 0;
  const auto run = [&] {
    for (int k = 0; k < 80; ++k) {
      phantom.run(loop.servo(), 0.01);
      (void)loop.picture();
      heard += sound.read(samples.data(), 441);
    }
    for (int k = 0; k < 300; ++k) {
      DeviceState state{Eigen::Vector3d(random(0.4), random(0.1), 0), Eigen::Vector3d::Zero(), 1e-3 * k};
      if (k % 11 == 0) state.position.y() = nan;
      if (k % 13 == 0) state.time = nan;
      state.reset = k % 50 == 0;
      not_finite += !loop.servo().tick(state).allFinite();
    }
  };
  long locks = -1;
  CHECK(heap_use([&] { locks = locks_taken(run); }) == HeapUse{});
  CHECK(locks == 0);
  CHECK(not_finite == 0);
  CHECK(heard > 30000);
  CHECK(loop.picture().record.contact_ticks > 100);
}
