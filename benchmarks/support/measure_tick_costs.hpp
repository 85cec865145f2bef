// What presses cost on the machine at hand, for choose().
//
//   const TickCosts costs = measure_tick_costs();      // some tens of milliseconds, once
//   const Choice choice = choose(scene, costs);
//
// A bar is pressed along a slow path by a small and a large model of each family; a line goes through both times.  Each is
// the least of several passes: what the rest of the machine adds is not the model's.
// Offline: allocates.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/scene/build.hpp>
#include <hapbeam/scene/scene.hpp>

namespace hapbeam::benchmarks {

/// Mean time of a press of a hand that presses and slides at about 50 mm/s, a press a millisecond [s].
inline double time_press(SceneModel& model, const Scene& scene, bool shape) {
  using Clock = std::chrono::steady_clock;
  const int passes = 9, presses = 200;
  double least = std::numeric_limits<double>::infinity();
  volatile double sink = 0;
  model.visit([&](auto& chosen) {
    for (int pass = 0; pass < passes; ++pass) {
      chosen.reset();
      const auto begin = Clock::now();
      for (int k = 0; k < presses; ++k) {
        const double part = (k + 1.0) / presses;
        const Press<double> press{scene.s_min + (scene.s_max - scene.s_min) * part,
                                  scene.depth * (0.2 + 0.8 * part)};
        sink = shape ? chosen.press(press).force : hapbeam::detail::force_of(chosen, press).force;
      }
      least = (std::min)(least, std::chrono::duration<double>(Clock::now() - begin).count() / presses);
    }
  });
  return least;
}

/// The same of a push of a wire.
template <class Element>
double time_push(int elements) {
  using Clock = std::chrono::steady_clock;
  const Rod wire(0.2, RodSection::circle(0.001), RodMaterial{200e9, 77e9}, RodSupport::clamped,
                 RodSupport::free);
  FemModel<Element> model(wire, elements);
  const int passes = 9, pushes = 200;
  double least = std::numeric_limits<double>::infinity();
  volatile double sink = 0;
  for (int pass = 0; pass < passes; ++pass) {
    model.reset();
    const auto begin = Clock::now();
    for (int k = 0; k < pushes; ++k) {
      const double part = (k + 1.0) / pushes;
      sink = model.push({0.14 + 0.002 * part, 0.02 * (0.2 + 0.8 * part), {0, 0.6, 0.8}}).force;
    }
    least = (std::min)(least, std::chrono::duration<double>(Clock::now() - begin).count() / pushes);
  }
  (void)sink;
  return least;
}

inline TickCost line_through(int few, double few_time, int many, double many_time) {
  const double per_unit = (std::max)((many_time - few_time) / (many - few), 0.0);
  return {(std::max)(few_time - per_unit * few, 0.0), per_unit};
}

inline TickCosts measure_tick_costs() {
  const Beam bar(2.54, Section::rectangle(0.0254, 0.0254), Material{206.84e9}, Support::pinned,
                 Support::pinned);
  Scene slide = Scene::anywhere(bar, 0.01), hold = Scene::at(bar, 1.0, 0.01);
  slide.s_min = 1.0, slide.s_max = 1.01;
  const auto elements = [&](Kinematics kinematics) {
    SceneModel few = build(slide, {kinematics, Reduction::none, 4}),
               many = build(slide, {kinematics, Reduction::none, 64});
    return line_through(4, time_press(few, slide, true), 64, time_press(many, slide, true));
  };
  const auto rods = [](auto element) {
    using Element = decltype(element);
    return line_through(4, time_push<Element>(4), 32, time_push<Element>(32));
  };
  const auto trained = [&](Reduction reduction, TickCost& force, TickCost& shape) {
    SceneModel few = build(hold, {Kinematics::von_karman, reduction, 64, 1, 8}),
               many = build(slide, {Kinematics::von_karman, reduction, 64, 16, 12});
    force = line_through(8, time_press(few, hold, false), 192, time_press(many, slide, false));
    shape = line_through(8, time_press(few, hold, true), 192, time_press(many, slide, true));
  };
  TickCosts costs{elements(Kinematics::linear),
                  elements(Kinematics::von_karman),
                  elements(Kinematics::corotational),
                  {},
                  {},
                  {},
                  {},
                  rods(RoundRod{}),
                  rods(TwistedRod{})};
  trained(Reduction::pod, costs.pod_force, costs.pod_shape);
  trained(Reduction::galerkin, costs.galerkin_force, costs.galerkin_shape);
  return costs;
}

}  // namespace hapbeam::benchmarks
