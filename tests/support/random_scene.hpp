// Scenes at random, and presses on which a chosen model is held to its word.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "random.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/rom/training/training_plan.hpp>
#include <hapbeam/scene/scene.hpp>
#include <hapbeam/shapes.hpp>

namespace hapbeam::testing {

/// Even in the logarithm.
inline double log_even(Random& random, double low, double high) {
  return low * std::pow(high / low, random(0, 1));
}

/// Rubber to steel, centimetres to metres, stubby to thread-like, held in any way, at ease, pulled or pressed along its axis,
/// touched at one place or along a part; a force error of 0.1 to 10 % is tolerated, and a press may take 1 to 1000 µs.
inline Scene random_scene(Random& random) {
  const double length = log_even(random, 0.05, 3), height = length * log_even(random, 1e-3, 0.05);
  const Material material{log_even(random, 1e6, 4e11)};
  const Section section = random.integer(0, 1) ? Section::circle(height)
                                               : Section::rectangle(log_even(random, 1, 20) * height, height);
  constexpr std::pair<Support, Support> ends[] = {
      {Support::pinned, Support::pinned},  {Support::clamped, Support::clamped},
      {Support::pinned, Support::roller},  {Support::clamped, Support::free},
      {Support::clamped, Support::pinned}, {Support::clamped, Support::roller},
      {Support::clamped, Support::guided}, {Support::pinned, Support::guided}};
  const auto [left, right] = ends[random.integer(0, 7)];
  Beam beam(length, section, material, left, right);
  if (fixes_u(left) && fixes_u(right) && random.integer(0, 1)) {
    const double unit = beam.bending_stiffness() / (length * length);
    // Pulled as far as a string, or pressed to half of the least that buckles any of these, π² EI/4L².
    const double tension = random.integer(0, 2) ? unit * log_even(random, 1, 1e3) : unit * random(-1.2, 0);
    beam = tensioned(beam, std::min(tension, 0.01 * beam.axial_stiffness()));
  }
  const double low = fixes_w(left) ? 0.03 : 0, high = fixes_w(right) ? 0.97 : 1;
  double from = random(low, high) * length, to = random(low, high) * length;
  switch (random.integer(0, 4)) {
    case 0: to = from; break;
    case 1: from = to = length / 2; break;
    default: break;
  }
  Scene scene{beam, std::min(from, to), std::max(from, to), length * log_even(random, 1e-4, 0.1)};
  scene.force_error = log_even(random, 1e-3, 0.1);
  scene.tick = log_even(random, 1e-6, 1e-3);
  scene.shape = random.integer(0, 1);
  return scene;
}

/// The same under dead loads, or naturally bent: it rests up to a tenth of its length from straight, or a thousandth of that.
inline Scene random_bent_scene(Random& random) {
  Scene scene = random_scene(random);
  Beam& beam = scene.beam;
  const double L = beam.length(), unit = beam.bending_stiffness() / (L * L * L);  // [N] for a bend by L
  const double sign = random.integer(0, 1) ? 1 : -1, s = random(0.1, 0.9) * L,
               size = log_even(random, 1e-4, 0.05);
  switch (random.integer(0, 4)) {
    case 0: beam.transverse(sign * 100 * unit * size); break;
    case 1: beam.add({s, 0, sign * 30 * unit * L * size, 0}); break;
    case 2: beam.add({s, 0, 0, sign * 10 * unit * L * L * size}); break;
    case 3: beam.axial(sign * unit * log_even(random, 0.01, 1)).transverse(-100 * unit * size); break;
    default: beam.naturally({{L, sign * 3 / L * size}}); break;
  }
  return scene;
}

struct KnownPress {
  Press<double> press;
  double force;  // [N]
};

/// Presses all over a scene, with the forces of many elements of any rotation.  They count from where the beam rests; a bent one
/// is pressed to either side of it, from a thousandth of the depth on.
inline std::vector<KnownPress> held_out(const Scene& scene, Random& random, int number, int elements) {
  FullModel<Corotational<>> truth(scene.beam, elements);
  std::vector<KnownPress> presses;
  for (int k = 0; k < number; ++k) {
    const double s = scene.one_place() ? scene.s_min : random(scene.s_min, scene.s_max);
    truth.reset();
    const double rest = truth.shape().at(s).w, sign = rest != 0 && k % 2 ? -1 : 1;
    const double depth = std::min(scene.depth, 0.999 * truth.range().depth_at(s) - sign * rest) *
                         (k % 3       ? random(0.001, 1)
                          : rest != 0 ? log_even(random, 0.001, 1)
                                      : log_even(random, 0.01, 1));
    Response<double> response{};
    for (int step = 1; step <= 4; ++step) response = truth.press({s, rest + sign * depth * step / 4});
    if (response.status == Status::ok) presses.push_back({{s, rest + sign * depth}, response.force});
  }
  return presses;
}

/// Largest relative error of the force, each press from rest; infinite where one is not answered.
template <class Model>
double worst_error(Model& model, const std::vector<KnownPress>& presses) {
  double most = 0;
  for (const KnownPress& known : presses) {
    model.reset();
    const Response<double> response = model.press(known.press);
    if (response.status != Status::ok) return std::numeric_limits<double>::infinity();
    most = std::max(most, std::abs(response.force - known.force) / std::abs(known.force));
  }
  return most;
}

}  // namespace hapbeam::testing
