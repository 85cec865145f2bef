#include "touch_scenes.hpp"

#include <cmath>

#include "closed_form.hpp"
#include "random_stops.hpp"
#include "thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/shapes.hpp>

namespace hapbeam::benchmarks {

namespace {

constexpr double steel = 7850;  // [kg/m³]
constexpr Material spring_steel{200e9};

TouchScene begin(const char* name, const Beam& beam, double young, double depth, double wave_number) {
  const double mass = steel * beam.axial_stiffness() / young;
  return {name,
          beam,
          depth,
          mass,
          wave_number * wave_number * std::sqrt(beam.bending_stiffness() / mass),
          {},
          {0, 2 * depth},
          {},
          {}};
}

TouchScene between_hinges(const char* name, const Beam& beam, double young, double depth, int stops) {
  const double L = beam.length(), reach = avatar_radius + beam.thickness() / 2;
  const PinnedClosedForm exact(beam);
  const auto stop = [&](double s, double d) {
    const PinnedClosedForm::Contact at = exact.contact({s, -d});
    const Point normal = Point(-at.tangent.y(), at.tangent.x()).normalized();
    return Stop{at.point + reach * normal, {0, d + reach}, -at.force / normal.y() * normal};
  };
  TouchScene scene = begin(name, beam, young, depth, M_PI / L);
  scene.stops = random_stops<2>(stops, {0.06 * L, 0.94 * L}, {shallowest * depth, depth}, 2008, stop);
  scene.outside = random_stops<2>(stops / 2, {0.2 * L, 0.8 * L}, {1.05 * depth, beyond * depth}, 2009, stop);
  for (int k = 0; k < 1000; ++k)
    scene.path.push_back(stop(0.3 * L + 0.02 * aside(k * 1e-3), in(k * 1e-3) * depth).position);
  return scene;
}

/// @param from, to  [m] where the avatar comes down   @param top  [m] where it meets the beam there
TouchScene turning(const char* name, const Beam& beam, double depth, double wave_number, double from,
                   double to, double (*top)(double x), int stops) {
  using Reference = FemModel<Corotational<>>;
  NewtonRaphson tight;
  tight.relative_tolerance = 1e-10;
  Reference model(beam, 256, tight);
  Touch<Reference> touch(model, avatar_radius);
  const double reach = avatar_radius + beam.thickness() / 2;
  const auto stop = [&](double x, double d) {
    Stop there{{x, top(x) + reach - d}, {0, d + reach}, {}};
    touch.reset();
    there.force = come_down([&](const Point& position) { return touch.tick(position); }, there).force;
    return there;
  };
  TouchScene scene = begin(name, beam, spring_steel.young, depth, wave_number);
  scene.stops = random_stops<2>(stops, {from, to}, {shallowest * depth, depth}, 2008, stop);
  scene.outside = random_stops<2>(stops / 2, {from, to}, {1.05 * depth, beyond * depth}, 2009, stop);
  for (int k = 0; k < 1000; ++k) {
    const double x = (from + to + (to - from) * aside(k * 1e-3)) / 2;
    scene.path.emplace_back(x, top(x) + reach - in(k * 1e-3) * depth);
  }
  return scene;
}

}  // namespace

std::vector<TouchScene> touch_scenes(int stops) {
  const Beam strip(0.4, Section::rectangle(0.02, 0.0005), spring_steel, Support::pinned, Support::pinned);
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), spring_steel, Support::clamped, Support::free);
  const Beam bow = arch(0.2, 0.012, Section::rectangle(0.01, 0.0005), spring_steel, Support::pinned);
  const auto flat = [](double) { return 0.0; };
  // Of the arch's circle.
  const auto round = [](double x) {
    const double radius = (0.1 * 0.1 + 0.012 * 0.012) / (2 * 0.012);
    return std::sqrt(radius * radius - (x - 0.1) * (x - 0.1)) - radius + 0.012;
  };
  return {between_hinges("bar_5mm", thesis_beam(), young, 0.005, stops),
          between_hinges("bar_50mm", thesis_beam(), young, 0.05, stops),
          between_hinges("strip", strip, spring_steel.young, 0.005, stops),
          turning("ruler", ruler, 0.115, 1.875 / 0.3, 0.105, 0.115, flat, stops),
          turning("arch", bow, 0.009, 2 * M_PI / 0.2, 0.08, 0.09, round, stops)};
}

}  // namespace hapbeam::benchmarks
