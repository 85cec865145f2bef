// A hand past a free end of what has mass: its spring pushes the last point straight away from the hand.
#include <cmath>

#include "support/catch.hpp"
#include "support/pi.hpp"
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double length = 0.3, thick = 0.01, avatar = 0.02, reach = avatar + thick / 2, K = 1000;

/// So heavy that its end does not move by 10⁻⁶ of the spring in a tick.
template <class Model, class Body>
void check(const Body& body) {
  using Vector = VectorOf<double, Model::dimension>;
  for (const double deep : {1e-6, 0.01, 0.3, 0.8})
    for (int degrees = 5; degrees <= 85; degrees += 10) {
      Model model(body, 8);
      Touch<Model> touch(model, avatar);
      const double angle = degrees * pi / 180, far = (1 - deep) * reach;
      Vector way = Vector::Zero();
      way[0] = std::cos(angle), way[Model::dimension - 1] = std::sin(angle);
      Vector hand = far * way;
      hand[0] += length;
      for (int tick = 0; tick < 3; ++tick) {
        const auto felt = touch.tick(hand, 1e-3, K, 0);
        CAPTURE(deep, degrees, tick, felt.force.transpose());
        REQUIRE(felt.status == Status::ok);
        CHECK((felt.force - K * deep * reach * way).norm() < 1e-4 * K * deep * reach);
      }
    }
}

}  // namespace

TEST_CASE("past a free end the spring of a hand pushes the last point straight away", "[dynamics]") {
  check<DynamicModel<>>(
      Beam(length, Section::rectangle(thick, thick), Material{200e9, 1e10}, Support::clamped, Support::free));
  RodMaterial material = RodMaterial::isotropic(200e9, 0.3);
  material.density = 1e10;
  check<DynamicModel<RoundRod>>(
      Rod(length, RodSection::circle(thick), material, RodSupport::clamped, RodSupport::free));
}
