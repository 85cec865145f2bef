// A rod that is held by an end, where it is asked for what is hard.  The laws that every rod keeps are in conformance/held_end.cpp.
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/status.hpp"
#include <hapbeam/element/corotational.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

TEST_CASE("a shaft takes the moment GJ/L for each radian, whole turns included", "[rod]") {
  // Round, short and thick: it twists and stays straight.
  const Rod shaft(0.1, RodSection::circle(0.01), spring_steel, RodSupport::clamped, RodSupport::clamped);
  FemModel<TwistedRod> model(shaft, 8);
  for (int k = 1; k <= 60; ++k) {
    const double angle = 0.25 * k;  // beyond two turns
    const auto held =
        model.hold(RodSide::right, {{0.1, 0, 0}, {1, 0, 0}, {0, std::cos(angle), std::sin(angle)}});
    REQUIRE(held.status == Status::ok);
    CHECK(held.moment.x() == Approx(shaft.stiffness().torsion / 0.1 * angle).epsilon(1e-9));
    if (angle > 6.28 * shaft.stiffness().bending1 / shaft.stiffness().torsion) break;  // Greenhill's, soon
  }
}

TEST_CASE("an end that is turned half round answers with that orientation, or not at all", "[rod]") {
  const Rod wire(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::clamped);
  int answers = 0;
  for (const double nearer : {0.0, 0.05})
    for (const double angle : {1.5, 2.0, 3.0, 3.14, pi}) {
      FemModel<TwistedRod> model(wire, 16);
      const RodPose pose = turned({{0.2 - nearer, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 0, 1}, angle);
      for (int tick = 0; tick < 10; ++tick) {
        const auto held = model.hold(RodSide::right, pose);
        if (!is_answer(held.status)) continue;
        ++answers;
        const auto& end = model.shape()[model.shape().segments()];
        CHECK(detail::unit(end.tangent).dot(pose.along) >= 1 - 1e-12);
        CHECK(end.director.dot(pose.director) >= 1 - 1e-12);
        CHECK((end.r - pose.at).norm() <= 1e-12);
      }
    }
  CHECK(answers >= 30);
}

// Beyond what a rod bears, too: its elements turn inside out, and it snaps.
TEST_CASE("an end that is turned over and over and comes back is finite all the way, and answers at home",
          "[rod]") {
  const RodSupport fixed = RodSupport::clamped, soft = RodSupport::elastic(2000, 2000, 2000, 0.5, 0.5, 0.5);
  const RodMaterial nylon{3e9, 1.1e9};
  const auto section = RodSection::circle(0.002);
  Rod in_tissue(0.2, section, nylon, fixed, RodSupport::free),
      curved(0.2, RodSection::ellipse(0.003, 0.001), nylon, fixed,
             RodSupport::elastic(500, 500, 500, 0.1, 0.1, 0.1));
  in_tissue.add(RodFoundation{0.05, 0.15, 5000, 1000});
  curved.naturally({{0.2, 0, 10, 5}});
  struct Case {
    Rod rod;
    RodSide side;
    double nearer;
  };
  const Case cases[] = {
      {Rod(0.2, section, spring_steel, fixed, fixed), RodSide::right, -0.06},
      {Rod(0.2, RodSection::rectangle(0.006, 0.001), spring_steel, fixed, fixed), RodSide::right, -0.06},
      {Rod(0.4, section, nylon, soft, fixed), RodSide::left, 0},
      {Rod(0.4, section, nylon, soft, fixed), RodSide::left, 0.1},
      {in_tissue, RodSide::left, 0},
      {curved, RodSide::left, 0}};
  int answers = 0, ticks = 0;
  for (const Case& of : cases)
    for (const double step : {0.02, 0.3}) {
      FemModel<TwistedRod> model(of.rod, 16);
      const RodPose home{{of.side == RodSide::right ? of.rod.length() : 0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
      const int all = static_cast<int>(4 * pi / step);
      const auto lead = [&](int k) {
        RodPose pose = turned(home, {0, 1, 0}, 4 * pi * k / all);
        pose.at.x() += of.nearer * k / all;
        const auto held = model.hold(of.side, pose);
        CHECK(held.force.allFinite());
        CHECK(held.moment.allFinite());
        answers += is_answer(held.status), ++ticks;
        return held.status;
      };
      for (int k = 1; k <= all; ++k) (void)lead(k);
      for (int k = all; k >= 0; --k) (void)lead(k);
      for (int tick = 0; tick < 64; ++tick) (void)lead(0);
      INFO("step " << step << ", nearer " << of.nearer);
      CHECK(lead(0) == Status::ok);
      CHECK(std::isfinite(model.strain_energy()));
    }
  CHECK(answers >= 0.8 * ticks);
}

// The bow of a round rod may roll about the line between its ends; that takes no force.
TEST_CASE("a rod whose end is pushed along its axis bows as the planar beam does, and comes back", "[rod]") {
  const double length = 0.2, most = 0.06;
  const auto beam = [&](double nearer) -> double {
    Beam bowed(length, Section::circle(0.002), Material{spring_steel.young}, Support::clamped,
               Support::clamped);
    bowed.place({}, {-nearer, 0, 0});
    return FemModel<Corotational<>>(bowed, 64).strain_energy();
  };
  const auto push = [&](auto&& model, double lean) {
    int answers = 0;
    const auto lead = [&](int k) {
      const double nearer = most * k / 300;
      const auto held =
          model.hold(RodSide::right, {{length - nearer, lean * nearer, 0}, {1, 0, 0}, {0, 1, 0}});
      answers += is_answer(held.status);
      return held.status;
    };
    for (int k = 1; k <= 300; ++k) (void)lead(k);
    CHECK(lead(300) == Status::ok);
    if (lean < 1e-3) CHECK(model.strain_energy() == Approx(beam(most)).epsilon(1e-3));
    for (int k = 299; k > 0; --k) (void)lead(k);
    CHECK(lead(0) == Status::ok);
    CHECK(model.strain_energy() <= 1e-20);
    CHECK(answers >= 595);
  };
  const Rod wire(length, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::clamped);
  for (const double lean : {0.0, 1e-6, 1e-4, 0.02}) {
    INFO("lean " << lean);
    push(FemModel<TwistedRod>(wire, 16), lean);
  }
  push(FemModel<TwistedRod>(wire, 32), 0);
}

TEST_CASE("an end that is not clamped, and a pose that is none, are rejected", "[rod]") {
  const Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
  FemModel<TwistedRod> model(wire, 8);
  CHECK(model.hold(RodSide::right, {}).status == Status::invalid_request);
  CHECK(model.hold(RodSide::left, {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}).status == Status::invalid_request);
  for (const double far_away : {double(NAN), 1e80, 1e8})
    CHECK(model.hold(RodSide::left, {{0, 0, far_away}, {1, 0, 0}, {0, 1, 0}}).status ==
          Status::invalid_request);
  // A free rod that is led by its end goes along, and nothing is felt when it is there.
  const auto held = model.hold(RodSide::left, {{0.01, 0.02, 0}, {0.8, 0.6, 0}, {0, 0, 1}});
  REQUIRE(held.status == Status::ok);
  CHECK(held.force.norm() <= 1e-9);
  CHECK((model.shape().at(0.2).r - Point(0.01 + 0.16, 0.02 + 0.12, 0)).norm() <= 1e-12);
}
