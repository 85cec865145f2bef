#include "instructions/strokes.hpp"
#include "rod/rods.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam::testing {
namespace {

/// Round an ellipse with and without friction.  @param start  -> avatar above the beam at rest   @param way  [0, 1] -> avatar
template <class Model, class Start, class Way>
void rub(const std::string& name, const Model& model, double radius, double mu, double skin, Start&& start,
         Way&& way) {
  const auto round = [&](const std::string& how, double coefficient) {
    Model pressed = model;
    Touch<Model> touch(pressed, radius, coefficient);
    touch.soften(skin, 0);
    volatile double felt = 0;
    for (int k = 0; k <= ticks; ++k) felt = start(touch, double(k) / ticks).force.y();
    count(name + how, [&](int k) { felt = way(touch, double(k) / ticks).force.y(); });
    static_cast<void>(felt);
  };
  round(" without friction", 0);
  round(" with friction", mu);
}

}  // namespace

void friction() {
  using Ruler = FemModel<Corotational<>>;
  using Wire = FemModel<RoundRod>;
  const Ruler ruler(
      Beam(0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, Support::free), 8);
  const Wire wire(Rod(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free),
                  8);
  const auto planar = [&](const std::string& name, double mu, double skin, double wide) {
    rub(
        name, ruler, 0.005, mu, skin,
        [](auto& touch, double t) {
          return touch.tick({0.11, 0.0055 - 0.02 * t});
        },
        [=](auto& touch, double t) {
          return touch.tick({0.11 + wide * std::sin(2 * pi * t), -0.0145 + 5e-4 * std::sin(4 * pi * t)});
        });
  };
  planar("finger that slides on a ruler", 0.3, 1e9, 0.02);
  planar("finger that sticks to a ruler", 1, 1e3, 2e-4);
  const auto spatial = [&](const std::string& name, double mu, double skin, double wide) {
    const Eigen::Vector3d shaft(0, 0, 0.04);
    rub(
        name, wire, 0.005, mu, skin,
        [=](auto& touch, double t) {
          return touch.tick({0.12, 0.0062 - 0.01 * t, -0.02}, shaft);
        },
        [=](auto& touch, double t) {
          const double a = 2 * pi * t;
          return touch.tick({0.12 + wide * std::sin(a), -0.0038, -0.02 + wide * (1 - std::cos(a))}, shaft);
        });
  };
  spatial("stylus that slides on a wire", 0.3, 1e9, 0.01);
  spatial("stylus that sticks to a wire", 1, 1e3, 2e-4);
}

}  // namespace hapbeam::testing
