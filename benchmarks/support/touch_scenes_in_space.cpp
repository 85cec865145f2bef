#include <cmath>

#include "mass_spring.hpp"
#include "random_stops.hpp"
#include "touch_scenes.hpp"
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

namespace hapbeam::benchmarks {

namespace {

using Vector = VectorOf<double, 3>;

constexpr double steel = 7850;  // [kg/m³]
constexpr RodMaterial spring_steel{200e9, 77e9};

/// Pressed along -z, from the front of where the rod rests.
/// @param from, to  [m] along it, where it is met   @param wave_number  [1/m] of its lowest mode
TouchSceneIn<3> pressed_across(const char* name, const Rod& rod, double depth, double wave_number,
                               double from, double to, int stops) {
  using Reference = FemModel<TwistedRod>;
  NewtonRaphson tight;
  tight.relative_tolerance = 1e-10;
  Reference model(rod, 96, tight);
  Touch<Reference> touch(model, radius_in<3>);
  const double reach = radius_in<3> + rod.thickness() / 2;
  const double area = rod.stiffness().axial / spring_steel.young, mass = steel * area;
  touch.reset();
  const auto at = [&](double s, double d) { return Vector(model.shape().at(s).r + Vector(0, 0, reach - d)); };
  TouchSceneIn<3> scene{name,
                        rod,
                        depth,
                        mass,
                        wave_number * wave_number * std::sqrt(rod.stiffness().bending1 / mass),
                        {},
                        {0, 0, 2 * depth},
                        {},
                        {}};
  for (int k = 0; k < 1000; ++k) {
    const double s = (from + to + (to - from) * aside(k * 1e-3)) / 2;
    scene.path.push_back(at(s, in(k * 1e-3) * depth));
  }
  const auto stop = [&](double s, double d) {
    touch.reset();
    StopIn<3> there{at(s, d), {0, 0, d + reach / 10}, {}};
    there.force = come_down([&](const Vector& position) { return touch.tick(position); }, there).force;
    return there;
  };
  scene.stops = random_stops<3>(stops, {from, to}, {shallowest * depth, depth}, 2008, stop);
  scene.outside = random_stops<3>(stops / 2, {from, to}, {1.05 * depth, beyond * depth}, 2009, stop);
  return scene;
}

}  // namespace

std::vector<Vector> nodes_at_rest(const Rod& rod, int elements) {
  const FemModel<TwistedRod> resting(rod, elements);
  std::vector<Vector> nodes;
  for (const auto& node : resting.shape()) nodes.push_back(node.r);
  return nodes;
}

std::vector<TouchSceneIn<3>> touch_scenes_in_space(int stops) {
  Rod wire(0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free);
  wire.load(Vector(0, -1.2, 0));
  const double half = M_PI * 0.05;
  Rod hook(half, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  hook.naturally({{half, 0, 1 / 0.05, 0}});
  return {pressed_across("wire", wire, 0.01, 1.875 / 0.2, 0.08, 0.18, stops),
          pressed_across("hook", hook, 0.01, 1.875 / half, 0.08, 0.14, stops)};
}

}  // namespace hapbeam::benchmarks
