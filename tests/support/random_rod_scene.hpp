// Scenes in space at random, and pushes on which a chosen model is held to its word.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "random_scene.hpp"
#include <hapbeam/scene/rod_scene.hpp>

namespace hapbeam::testing {

/// Round, oval or flat, even or tapered, straight or bent by nature, with or without a weight or a foundation, held at one end or
/// both, pushed at one place or along a part; a force error of 1 to 10 % is tolerated.
inline RodScene random_rod_scene(Random& random) {
  const double L = log_even(random, 0.05, 1), size = L * log_even(random, 3e-3, 0.02);
  const RodMaterial material = RodMaterial::isotropic(log_even(random, 1e9, 2e11), 0.3);
  const int kind = random.integer(0, 2);
  const RodSection section = kind == 0   ? RodSection::circle(size)
                             : kind == 1 ? RodSection::ellipse(random(1, 2) * size, size)
                                         : RodSection::rectangle(random(1, 3) * size, size);
  const RodSupport ends[] = {RodSupport::free, RodSupport::clamped, RodSupport::hinged, RodSupport::sliding};
  Rod rod(L, section, material, RodSupport::clamped, ends[random.integer(0, 3)]);
  if (random.integer(0, 3) == 0) {
    const double end = random(0.5, 0.9);
    rod.section([section, end, L](double s) {
      RodSection part = section;
      const double k = 1 - (1 - end) * s / L;
      part.area *= k * k, part.inertia1 *= k * k * k * k, part.inertia2 *= k * k * k * k;
      return part.torsion *= k * k * k * k, part;
    });
  }
  switch (random.integer(0, 3)) {
    case 0: rod.naturally({{L, random(2.0) / L, random(2.0) / L, random(2.0) / L}}); break;
    case 1: {
      const double q = rod.stiffness().bending1 / (L * L * L) * log_even(random, 0.01, 0.5);
      rod.load(VectorOf<double, 3>(0, -q, 0.3 * q));
      break;
    }
    case 2:
      rod.add(
          RodFoundation{0.1 * L, random(0.3, 0.9) * L, rod.stiffness().bending1 / std::pow(L, 4) * 100, 0});
      break;
    default: break;
  }
  const double high = RodRange<double>(rod).range().s_max < L ? 0.85 : 1;
  const double from = random(0.2, high) * L, to = random(0, 1) < 0.4 ? from : random(0.2, high) * L;
  RodScene scene{rod, std::min(from, to), std::max(from, to), L * log_even(random, 3e-3, 0.1)};
  scene.force_error = log_even(random, 0.01, 0.1);
  scene.tick = log_even(random, 1e-5, 1e-3);
  return scene;
}

/// Largest relative error of a model's force, on pushes all over a scene to all sides, against many elements of the given kind;
/// each begins at rest and goes on in steps.  Negative: no push was answered by the reference.
template <class Reference, class Model>
double worst_error(Model& model, const RodScene& scene, Random& random, int pushes, int elements) {
  Reference truth(scene.rod, elements);
  double worst = -1;
  for (int k = 0; k < pushes; ++k) {
    truth.reset(), model.reset();
    const double s = scene.one_place() ? scene.s_min : random(scene.s_min, scene.s_max),
                 angle = random(0, 6.283185307);
    const auto rest = truth.shape();
    const VectorOf<double, 3> d3 = detail::unit(rest.at(s).tangent),
                              d1 = detail::across(rest[rest.segment_at(s)].director, d3),
                              n = std::cos(angle) * d1 + std::sin(angle) * detail::cross3<double>(d3, d1);
    const double home = n.dot(rest.at(s).r),
                 depth = scene.depth_at(s, std::cos(angle), std::sin(angle)) * log_even(random, 0.01, 1);
    Response<double> wanted{}, got{};
    for (int step = 1; step <= 4; ++step) {
      wanted = truth.push({s, home + depth * step / 4, n});
      got = model.push({s, home + depth * step / 4, n});
    }
    if (wanted.status != Status::ok) continue;
    if (got.status != Status::ok) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::abs(got.force / wanted.force - 1));
  }
  return worst;
}

}  // namespace hapbeam::testing
