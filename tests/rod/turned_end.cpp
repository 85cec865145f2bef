// An end that is turned against a pull bends the rod over √(EI/N), which may be less than an element.
//
// There it is an elastica whose other end runs straight:  ½ M²/EI = N (1 - cos α),  M = 2 √(EI N) sin α/2,  α from the force to the tangent.
#include <algorithm>
#include <cmath>

#include "support/catch.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;

namespace {

template <class Element>
void check_turned(RodSide side, const RodSupport& held) {
  constexpr double length = 0.4, diameter = 0.001, young = 3e9;
  const double bending = young * std::acos(-1.0) * std::pow(diameter, 4) / 64,
               to = side == RodSide::left ? -1 : 1;
  const RodSupport other = RodSupport::hinged;
  double worst = 0, beyond_worst = 0;
  int in_range = 0, beyond = 0;
  for (const int elements : {8, 16, 64})
    for (const double strain : {1e-4, 1e-3, 3e-3}) {
      const Rod rod(length, RodSection::circle(diameter), RodMaterial::isotropic(young, 0.3),
                    side == RodSide::left ? held : other, side == RodSide::left ? other : held);
      FemModel<Element> model(rod, elements);
      for (int k = 0; k <= 60; ++k) {
        const double turn = 0.02 * k, drawn = strain * length * std::min(1.0, k / 10.0);
        const RodPose pose{{(side == RodSide::right ? length : 0) + to * drawn, 0, 0},
                           {std::cos(turn), 0, std::sin(turn)},
                           {0, 1, 0}};
        const auto end = model.hold(side, pose);
        REQUIRE(is_answer(end.status));
        const double force = end.force.norm();
        if (k < 10 || force * length * length < 100 * bending) continue;
        const auto line = model.shape();
        const auto& node = line[side == RodSide::left ? 0 : line.segments()];
        const double cosine = to * end.force.dot(node.tangent.normalized()) / force,
                     moment = std::sqrt(2 * bending * force * (1 - cosine));
        const double error = std::abs(end.moment.norm() / moment - 1);
        const bool ok = end.status == Status::ok;
        ++(ok ? in_range : beyond);
        double& most = ok ? worst : beyond_worst;
        most = std::max(most, error);
      }
    }
  INFO(in_range << " in range, worst " << worst << ", " << beyond << " beyond, worst " << beyond_worst);
  CHECK(in_range > 100);
  CHECK(worst < 0.03);
  CHECK(beyond > 100);
  CHECK(beyond_worst > 0.5);
}

}  // namespace

TEST_CASE("an end that is turned against a pull is in range where its moment is right", "[rod][held]") {
  check_turned<RoundRod>(RodSide::left, RodSupport::clamped);
  check_turned<RoundRod>(RodSide::right, RodSupport::clamped);
  check_turned<TwistedRod>(RodSide::left, RodSupport::clamped);
  // In a hand that holds it by springs.
  check_turned<TwistedRod>(RodSide::left, RodSupport::elastic(1e5, 1e5, 1e5, 1, 1, 1));
}

// Elements that swing do not know their tension.
TEST_CASE("a turned end of a rod with mass is in range where its moment is right", "[rod][held][mass]") {
  constexpr double length = 0.4, diameter = 0.0005;
  RodMaterial nylon = RodMaterial::isotropic(3e9, 0.3);
  nylon.density = 1000;
  double worst = 0, beyond_worst = 0;
  for (const int elements : {8, 16})
    for (const double strain : {1e-6, 1e-5, 1e-4})
      for (const double turn : {0.0, 0.02, 0.05, 0.1, 0.3}) {
        Rod rod(length, RodSection::circle(diameter), nylon, RodSupport::clamped, RodSupport::clamped);
        const RodPose pose{{0, 0, 0}, {std::cos(turn), 0, std::sin(turn)}, {0, 1, 0}};
        rod.place_left(pose);
        rod.place_right({{length * (1 + strain), 0, 0}, {1, 0, 0}, {0, 1, 0}});
        FemModel<RoundRod> fine(rod, 128);
        const auto at_rest = fine.hold(RodSide::left, pose);
        const auto felt = DynamicModel<RoundRod>(rod, elements).reaction(RodSide::left);
        REQUIRE(at_rest.status == Status::ok);
        const double scale = turn > 0 ? at_rest.moment.norm() : at_rest.force.norm() * diameter,
                     error = (felt.moment - at_rest.moment).norm() / scale;
        if (turn == 0) CHECK(felt.status == Status::ok);
        double& most = felt.status == Status::ok ? worst : beyond_worst;
        most = std::max(most, error);
      }
  CHECK(worst < 0.02);
  CHECK(beyond_worst > 0.5);
}
