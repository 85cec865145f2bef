// A rod that is held by an end: force and moment are the derivatives of its energy by place and rotation.
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

RodPose turned(RodPose pose, const Point& axis, double angle) {
  const auto turn = [&](const Point& x) -> Point {
    const Point along = axis.dot(x) * axis;
    return along + std::cos(angle) * (x - along) + std::sin(angle) * detail::cross3(axis, x);
  };
  return {pose.at, turn(pose.along), turn(pose.director)};
}

}  // namespace

TEST_CASE("what holds an end is the derivative of the energy by its place and rotation", "[rod]") {
  const double length = 0.3, h = 1e-4;
  const Rod strip(length, RodSection::rectangle(0.004, 0.002), spring_steel, RodSupport::clamped,
                  RodSupport::clamped);
  FemModel<TwistedRod> model(strip, 8);
  const auto energy = [&](const RodPose& pose) {
    REQUIRE(model.hold(RodSide::right, pose).status == Status::ok);
    return model.strain_energy();
  };
  // Led there as a hand would: bowed aside, turned and twisted by half a turn.  Where it buckles it may take a few ticks.
  RodPose pose{{length, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (int k = 1; k <= 40; ++k) {
    pose.at += Point(-0.0015, 0.001, 0.0005);
    pose = turned(pose, {1, 0, 0}, pi / 40);
    pose = turned(pose, {0, 0, 1}, 0.01);
    (void)model.hold(RodSide::right, pose);
  }
  const HeldEnd<double> held = model.hold(RodSide::right, pose);
  REQUIRE(held.status == Status::ok);
  const double size = held.force.norm(), moment = held.moment.norm();
  for (int k = 0; k < 3; ++k) {
    const Point e = Point::Unit(k);
    const auto at = [&](double by) {
      return energy({pose.at + by * h * length * e, pose.along, pose.director});
    };
    const auto by_angle = [&](double by) { return energy(turned(pose, e, by * h)); };
    const auto slope = [h](auto&& f) { return (8 * (f(1) - f(-1)) - f(2) + f(-2)) / (12 * h); };
    CHECK(std::abs(slope(at) / length - held.force[k]) <= 1e-5 * size);
    CHECK(std::abs(slope(by_angle) - held.moment[k]) <= 1e-5 * moment);
  }
}

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

TEST_CASE("an end that is not clamped, and a pose that is none, are rejected", "[rod]") {
  const Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
  FemModel<TwistedRod> model(wire, 8);
  CHECK(model.hold(RodSide::right, {}).status == Status::invalid_request);
  CHECK(model.hold(RodSide::left, {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}).status == Status::invalid_request);
  CHECK(model.hold(RodSide::left, {{0, 0, NAN}, {1, 0, 0}, {0, 1, 0}}).status == Status::invalid_request);
  // A free rod that is led by its end goes along, and nothing is felt when it is there.
  const auto held = model.hold(RodSide::left, {{0.01, 0.02, 0}, {0.8, 0.6, 0}, {0, 0, 1}});
  REQUIRE(held.status == Status::ok);
  CHECK(held.force.norm() <= 1e-9);
  CHECK((model.shape().at(0.2).r - Point(0.01 + 0.16, 0.02 + 0.12, 0)).norm() <= 1e-12);
}
