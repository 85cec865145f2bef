// Scenes in space at random, and pushes on which a chosen model is held to its word.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "random_scene.hpp"
#include <hapbeam/scene/choose_rod.hpp>

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
  const double high = PressRange<double>(rod).range().s_max < L ? 0.85 : 1;
  const double from = random(0.2, high) * L, to = random(0, 1) < 0.4 ? from : random(0.2, high) * L;
  RodScene scene{rod, std::min(from, to), std::max(from, to), L * log_even(random, 3e-3, 0.1)};
  scene.force_error = log_even(random, 0.01, 0.1);
  scene.tick = log_even(random, 1e-5, 1e-3);
  return scene;
}

/// A hook, an open ring, a helix or a bow that bends out of its plane: strongly bent by nature, so that it gives way to a push to one
/// side many times as much as to a push to another.
inline RodScene random_curled_rod_scene(Random& random) {
  RodScene scene = random_rod_scene(random);
  const double L = scene.rod.length(), turns = 6.283185307 / L;
  const double bend = random(0, 6.283185307), k1 = std::cos(bend), k2 = std::sin(bend);
  switch (random.integer(0, 3)) {
    case 0: {  // straight, and then half a circle
      const double shank = random(0.2, 0.6) * L, k = 3.141592654 / (L - shank);
      scene.rod.naturally({{shank, 0, 0, 0}, {L, k * k1, k * k2, 0}});
      break;
    }
    case 1: scene.rod.naturally({{L, 0.9 * turns * k1, 0.9 * turns * k2, 0}}); break;
    case 2: {
      const double k = random(1, 3) * turns;
      scene.rod.naturally({{L, k * k1, k * k2, k * random(0.1, 0.5)}});
      break;
    }
    default: scene.rod.naturally({{L / 2, 2 / L, 0, 0}, {L, 0, random(2, 4) / L, 0}}); break;
  }
  return scene;
}

/// A push that begins at rest and goes on in four steps, or as a hand goes where the rod does not follow those.
struct KnownPush {
  double s, home, depth;  // [m]; n · r at rest, and how much farther
  VectorOf<double, 3> normal;
  double force;  // [N]

  template <class Model>
  Response<double> go(Model& model) const {
    Response<double> response{};
    for (const int steps : {4, 40}) {
      model.reset();
      bool followed = true;
      for (int step = 1; step <= steps; ++step) {
        response = model.push({s, home + depth * step / steps, normal});
        followed = followed && response.status == Status::ok;
      }
      if (followed) break;
    }
    return response;
  }
};

/// Pushes all over a scene to all sides, with the forces of many elements of the given kind.
template <class Reference>
std::vector<KnownPush> held_out(const RodScene& scene, Random& random, int number, int elements) {
  Reference truth(scene.rod, elements);
  std::vector<KnownPush> pushes;
  for (int k = 0; k < number; ++k) {
    truth.reset();
    const double s = scene.one_place() ? scene.s_min : random(scene.s_min, scene.s_max),
                 angle = random(0, 6.283185307);
    const auto rest = truth.shape();
    const VectorOf<double, 3> d3 = detail::unit(rest.at(s).tangent),
                              d1 = detail::across(rest[rest.segment_at(s)].director, d3),
                              n = std::cos(angle) * d1 + std::sin(angle) * detail::cross3<double>(d3, d1);
    KnownPush push{s, n.dot(rest.at(s).r),
                   scene.depth_at(s, std::cos(angle), std::sin(angle)) * log_even(random, 0.01, 1), n, 0};
    const Response<double> response = push.go(truth);
    if (response.status != Status::ok) continue;
    push.force = response.force;
    pushes.push_back(push);
  }
  return pushes;
}

/// Largest relative error of the force; infinite where a push is not answered.  Negative: there are no pushes.
template <class Model>
double worst_error(Model& model, const std::vector<KnownPush>& pushes) {
  double worst = -1;
  for (const KnownPush& push : pushes) {
    const Response<double> got = push.go(model);
    if (got.status != Status::ok) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::abs(got.force / push.force - 1));
  }
  return worst;
}

}  // namespace hapbeam::testing
