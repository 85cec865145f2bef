// SPDX-License-Identifier: MIT
// Builds the model that a scene has chosen; trains it where it is a trained one.
//
// Offline: allocates; throws what training throws.  Includes an SVD, which takes seconds to compile.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <hapbeam/rom/training/train.hpp>
#include <hapbeam/scene/choice.hpp>
#include <hapbeam/scene/scene.hpp>
#include <hapbeam/scene/scene_model.hpp>

namespace hapbeam {

namespace detail {

/// How far from the x axis dead loads and nature take the beam [m].
template <class Model>
double hang_of(const Model& model) noexcept {
  double hang = 0;
  for (const auto& node : model.shape()) hang = (std::max)(hang, std::abs(node.w));
  return hang;
}

template <class Element>
SceneModel build(const Scene& scene, const Candidate& candidate, int segments) {
  const Beam& beam = scene.beam;
  const int n = candidate.elements;
  if (candidate.reduction == Reduction::none) {
    if constexpr (!std::is_same_v<Element, Linear>)
      if (candidate.mirrored)
        return SceneModel(
            Mirrored<FemModel<Element>>(FemModel<Element>(half_of(beam), n / 2), beam.right_place().u));
    return SceneModel(FemModel<Element>(beam, n));
  }
  const bool loaded = !beam.point_loads().empty() || beam.transverse() || beam.axial();
  const auto full = full_model<Element>(beam, n);
  // A scene's depth counts from rest, a plan's from the straight beam; other meshes have rest about a percent lower at most.
  const TrainingPlan plan{
      scene.s_min, scene.s_max, candidate.positions, scene.depth + 1.01 * hang_of(full), candidate.depths,
      !loaded,     segments};
  if (candidate.reduction == Reduction::pod)
    return SceneModel(PodModel<>(train_pod(take_snapshots(beam, full, plan))));
  return SceneModel(GalerkinModel<>(train_galerkin(take_snapshots_at_tensions(beam, full, plan))));
}

}  // namespace detail

/// @param segments  of the shape that a trained model draws; 2 where only the force is looked at
/// @throws std::invalid_argument, TrainingError
inline SceneModel build(const Scene& scene, const Candidate& candidate, int segments = 32) {
  scene.check();
  switch (candidate.kinematics) {
    case Kinematics::linear: return detail::build<Linear>(scene, candidate, segments);
    case Kinematics::von_karman: return detail::build<VonKarman<>>(scene, candidate, segments);
    case Kinematics::corotational: return detail::build<Corotational<>>(scene, candidate, segments);
    case Kinematics::round_rod:
    case Kinematics::twisted_rod: break;
  }
  detail::refuse("kinematics = %s: must be that of a beam for a Scene", name(candidate.kinematics));
}

}  // namespace hapbeam
