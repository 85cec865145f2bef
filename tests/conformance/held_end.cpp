// The laws of every rod that is held by an end, led there as a hand would lead it.
#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/status.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double length = 0.3;

/// Leads an end from a pose, by a part of the length and an angle a tick each; the same way back with a negative count.
template <class Model>
RodPose lead(Model& model, RodSide side, RodPose pose, const Point& way, const Point& turn, int ticks) {
  const double angle = turn.norm(), sign = ticks < 0 ? -1 : 1;
  for (int k = 0; k < std::abs(ticks); ++k) {
    pose.at += sign * length * way;
    pose = turned(pose, turn / angle, sign * angle);
    (void)model.hold(side, pose);
  }
  return pose;
}

/// @param home  of the end where nothing loads the rod
template <class Model>
void check_held(Model model, RodSide side, const RodPose& home) {
  const double h = 1e-4;
  // Toward the other end: a rod that is drawn out is turned too sharply for its elements.
  const Point way(side == RodSide::left ? 0.004 : -0.004, 0.003, 0.002), turn(0.02, -0.004, 0.01);
  RodPose pose = lead(model, side, home, way, turn, 30);
  const HeldEnd<double> held = model.hold(side, pose);
  REQUIRE(held.status == Status::ok);
  const double size = held.force.norm(), moment = held.moment.norm(), energy = model.strain_energy();
  REQUIRE(size > 0);

  SECTION("force and moment are the derivatives of the energy by place and rotation") {
    const auto energy_at = [&](const RodPose& at) {
      REQUIRE(model.hold(side, at).status == Status::ok);
      return model.strain_energy();
    };
    for (int k = 0; k < 3; ++k) {
      const Point e = Point::Unit(k);
      const auto at = [&](double by) {
        return energy_at({pose.at + by * h * length * e, pose.along, pose.director});
      };
      const auto by_angle = [&](double by) { return energy_at(turned(pose, e, by * h)); };
      const auto slope = [h](auto&& f) { return (8 * (f(1) - f(-1)) - f(2) + f(-2)) / (12 * h); };
      CHECK(std::abs(slope(at) / length - held.force[k]) <= 1e-5 * size);
      CHECK(std::abs(slope(by_angle) - held.moment[k]) <= 1e-5 * moment);
    }
  }
  SECTION("they do not depend on the way there") {
    const RodPose away = lead(model, side, pose, {0.001, 0.003, -0.004}, {-0.01, 0.02, 0.005}, 20);
    (void)lead(model, side, away, {0.001, 0.003, -0.004}, {-0.01, 0.02, 0.005}, -20);
    const HeldEnd<double> again = model.hold(side, pose);
    REQUIRE(again.status == Status::ok);
    CHECK((again.force - held.force).norm() <= 1e-7 * size);
    CHECK((again.moment - held.moment).norm() <= 1e-7 * moment);
    CHECK(model.strain_energy() == Approx(energy).epsilon(1e-9));
  }
  SECTION("a closed way takes no work") {
    double work = 0;
    HeldEnd<double> before = held;
    constexpr int ticks = 400;
    for (int k = 1; k <= ticks; ++k) {
      const auto at = [&](int tick) -> Point {
        const double a = 2 * pi * tick / ticks;
        return pose.at + 0.02 * length * Point(std::sin(a), std::cos(a) - 1, std::sin(2 * a));
      };
      const HeldEnd<double> now = model.hold(side, {at(k), pose.along, pose.director});
      REQUIRE(now.status == Status::ok);
      work += (now.force + before.force).dot(at(k) - at(k - 1)) / 2;
      before = now;
    }
    CHECK(std::abs(work) <= 1e-5 * energy);
  }
  SECTION("a pose that is none is refused and changes nothing") {
    RodPose none = pose;
    none.at[1] = std::numeric_limits<double>::quiet_NaN();
    CHECK(model.hold(side, none).status == Status::invalid_request);
    none = pose;
    none.along.setZero();
    CHECK(model.hold(side, none).status == Status::invalid_request);
    const HeldEnd<double> again = model.hold(side, pose);
    CHECK(again.status == Status::ok);
    CHECK((again.force - held.force).norm() <= 1e-7 * size);
  }
  SECTION("back at home nothing is left") {
    lead(model, side, pose, way, turn, -30);
    const HeldEnd<double> at_home = model.hold(side, home);
    CHECK(at_home.status == Status::ok);
    CHECK(at_home.force.norm() <= 1e-7 * size);
    CHECK(model.strain_energy() <= 1e-9 * energy);
  }
}

const RodPose right_end{{length, 0, 0}, {1, 0, 0}, {0, 1, 0}};

Rod strip(const RodSupport& left) {
  return {length, RodSection::rectangle(0.004, 0.002), spring_steel, left, RodSupport::clamped};
}

}  // namespace

TEST_CASE("a rod that is held by an end keeps the laws of one", "[contract][rod]") {
  const RodSupport c = RodSupport::clamped;
  SECTION("a strip") { check_held(FemModel<TwistedRod>(strip(c), 8), RodSide::right, right_end); }
  SECTION("a strip by its left end") { check_held(FemModel<TwistedRod>(strip(c), 8), RodSide::left, {}); }
  SECTION("a strip on a hinge") {
    check_held(FemModel<TwistedRod>(strip(RodSupport::cardan), 8), RodSide::right, right_end);
  }
  SECTION("a strip on springs") {
    const RodSupport soft = RodSupport::elastic(2000, 1000, 1e5, 5, 3, 2);
    check_held(FemModel<TwistedRod>(strip(soft), 8), RodSide::right, right_end);
  }
  SECTION("a rod in a bed") {
    Rod bedded = strip(RodSupport::free);
    bedded.add(RodFoundation{0, 0.1, 5000, 1000});
    check_held(FemModel<TwistedRod>(bedded, 8), RodSide::right, right_end);
  }
  SECTION("a rod that tapers") {
    Rod rod = strip(c);
    rod.section([](double s) { return RodSection::rectangle(0.004 - 0.005 * s, 0.002); });
    check_held(FemModel<TwistedRod>(rod, 8), RodSide::right, right_end);
  }
  SECTION("a rod that is bent by nature") {
    Rod rod = strip(c);
    rod.naturally({{length, 2, 5, 3}});
    const NaturalRod<double> natural(rod);
    const RodNode<double> end = natural.at(length);
    check_held(FemModel<TwistedRod>(rod, 24), RodSide::right, {end.r, end.tangent, end.director});
  }
  SECTION("without twist") {
    const Rod wire(length, RodSection::circle(0.003), spring_steel, c, c);
    check_held(FemModel<RoundRod>(wire, 8), RodSide::right, right_end);
  }
}
