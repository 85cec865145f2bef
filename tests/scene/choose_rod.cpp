// choose() of a rod: what it picks holds what was asked on pushes that it has not seen.
#include <cmath>
#include <stdexcept>

#include "once_training.hpp"
#include "support/catch.hpp"
#include "support/pi.hpp"
#include "support/random_rod_scene.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/scene/choose_rod.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr RodMaterial steel{200e9, 77e9};

Rod wire() { return {0.2, RodSection::circle(0.001), steel, RodSupport::clamped, RodSupport::free}; }

}  // namespace

TEST_CASE("it says the first mode of a rod to its softer side", "[scene][rod]") {
  const double E = 200e9, density = 7850, h = 0.001, L = 0.2;
  for (const bool flat : {true, false}) {
    const Rod rod(L, flat ? RodSection::rectangle(0.004, h) : RodSection::circle(h),
                  RodMaterial::isotropic(E, 0.3, density), RodSupport::clamped, RodSupport::free);
    const Choice choice = choose(RodScene::at(rod, 0.15, 1e-3));
    CAPTURE(choice.text(), flat);
    CHECK(choice.first_mode == Approx(std::pow(1.8751040687119611 / L, 2) * h *
                                      std::sqrt(E / density / (flat ? 12 : 16)) / (2 * pi))
                                   .epsilon(1e-4));
  }
}

TEST_CASE("what is chosen for a rod keeps the tolerance on pushes that it has not seen", "[scene][rod]") {
  Random random(23);
  int chosen = 0;
  for (int k = 0; k < 8; ++k) {
    RodScene scene = random_rod_scene(random);
    scene.tick = 1e-3;
    scene.s_max = scene.s_min, scene.force_error = std::max(scene.force_error, 0.03);  // those are quick
    Choice choice;
    try {
      choice = choose(scene);
    } catch (const std::invalid_argument&) {  // deeper than is answered
      continue;
    }
    INFO("scene " << k << "\n" << choice.text());
    if (!choice.candidate) continue;
    ++chosen;
    RodModel model = build(scene, choice.model());
    CHECK(worst_error(model, held_out<FemModel<TwistedRod>>(scene, random, 6, 96)) <= scene.force_error);
  }
  CHECK(chosen >= 6);
}

// A helix and a bow that bends out of its plane, pushed at one place.  To one side they are 4 to 9 times as stiff as to another, and
// the error of few elements peaks there within 20 degrees.  A choice by six even directions exceeded the tolerance by up to 1.4.
TEST_CASE("what is chosen for a curled rod keeps the tolerance to its stiffest side", "[scene][rod]") {
  for (const std::uint64_t seed : {1005u, 1029u}) {
    Random random(seed);
    RodScene scene = random_curled_rod_scene(random);
    scene.tick = 1e-3;
    REQUIRE(scene.one_place());
    const Choice choice = choose(scene);
    INFO("seed " << seed << "\n" << choice.text());
    RodModel model = build(scene, choice.model());
    CHECK(worst_error(model, held_out<FemModel<TwistedRod>>(scene, random, 40, 96)) <= scene.force_error);
  }
}

TEST_CASE("a model that was chosen for a rod is pushed and touched", "[scene][rod]") {
  const RodScene scene = RodScene::at(wire(), 0.15, 0.01);
  const Choice choice = choose(scene);
  CHECK(choice.model().kinematics == Kinematics::round_rod);  // the cheaper one of two that are right
  RodModel model = build(scene, choice.model());
  FemModel<TwistedRod> truth(wire(), 64);
  for (const double angle : {0.3, 2.0, 5.0}) {
    const VectorOf<double, 3> n(0, std::cos(angle), std::sin(angle));
    for (const double d : {0.003, 0.01}) {
      const auto got = model.push({0.15, d, n}), wanted = truth.push({0.15, d, n});
      CHECK(got.status == Status::ok);
      CHECK(std::abs(got.force / wanted.force - 1) <= scene.force_error);
    }
  }
  model.reset(), truth.reset();
  Touch<RodModel> touch(model, 0.005);
  Touch<FemModel<TwistedRod>> felt(truth, 0.005);
  for (int k = 0; k <= 100; ++k) {
    const VectorOf<double, 3> hand(0.15, 0.0057 - 1e-4 * k, 0.001);
    const auto got = touch.tick(hand), wanted = felt.tick(hand);
    REQUIRE(got.status == wanted.status);
    REQUIRE((got.force - wanted.force).norm() <= scene.force_error * wanted.force.norm());
  }
}

TEST_CASE("what is not the same in each plane gets a rod, of the kind that it takes", "[scene][rod]") {
  Rod hanging = wire();
  hanging.weight(7850, {0, -9.81, 0});
  const Choice round = choose(RodScene::at(hanging, 0.15, 0.01));
  CHECK(round.model().kinematics == Kinematics::round_rod);  // the cheaper one of two that are right
  Rod strip(0.2, RodSection::rectangle(0.004, 0.001), steel, RodSupport::clamped, RodSupport::free);
  const RodScene askew = RodScene::at(strip, 0.15, 0.01);
  const Choice flat = choose(askew);
  CHECK(flat.model().kinematics == Kinematics::twisted_rod);
  CHECK_THAT(flat.text(), ContainsSubstring("RoundRod takes rods that are straight by nature"));
  CHECK_THROWS_WITH(build(askew, Candidate{Kinematics::corotational, Reduction::none, 8}),
                    ContainsSubstring("must be that of a rod"));
}

TEST_CASE("where no rod is fast enough the advice says what is", "[scene][rod]") {
  Rod hanging = wire();
  hanging.weight(7850, {0, -9.81, 0});
  RodScene scene = RodScene::at(hanging, 0.15, 0.01);
  scene.tick = 1e-6;
  const Choice choice = choose(scene);
  CHECK_FALSE(choice.candidate);
  CHECK_THAT(choice.advice, ContainsSubstring("allow a tick of"));
}

TEST_CASE("a scene in space that makes no sense is refused by name", "[scene][rod]") {
  const auto refused = [](auto&& change, const char* message) {
    RodScene scene = RodScene::anywhere(wire(), 0.01);
    change(scene);
    CHECK_THROWS_WITH(choose(scene), ContainsSubstring(message));
  };
  refused([](RodScene& s) { s.s_min = 0; }, "s_min = 0 m");
  refused([](RodScene& s) { s.s_max = 0.3; }, "s_max = 0.3 m");
  refused([](RodScene& s) { s.depth = 0; }, "depth = 0 m");
  refused([](RodScene& s) { s.force_error = -0.1; }, "force_error = -0.1");
  refused([](RodScene& s) { s.tick = std::nan(""); }, "tick = nan s");
}
