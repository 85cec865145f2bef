// Builds the model that a scene has chosen; trains it where it is a trained one.
//
// Offline: allocates; throws what training throws.  Includes an SVD, which takes seconds to compile.
#pragma once

#include <hapbeam/rom/train.hpp>
#include <hapbeam/scene/candidate.hpp>
#include <hapbeam/scene/scene.hpp>
#include <hapbeam/scene/scene_model.hpp>

namespace hapbeam {

namespace detail {

/// @param segments  of the shape that is drawn; 2 where only the force is looked at
template <class Element>
SceneModel build(const Scene& scene, const Candidate& candidate, int segments) {
  const Beam& beam = scene.beam;
  if (candidate.reduction == Reduction::none) {
    if constexpr (!std::is_same_v<Element, Linear>)
      if (candidate.mirrored)
        return SceneModel(Mirrored<FemModel<Element>>(
            FemModel<Element>(half_of(beam), candidate.elements / 2), beam.right_place().u));
    return SceneModel(FemModel<Element>(beam, candidate.elements));
  }
  const bool loaded = !beam.point_loads().empty() || beam.transverse() || beam.axial();
  TrainingPlan plan{scene.s_min, scene.s_max, candidate.positions, scene.depth, candidate.depths, !loaded};
  plan.segments = segments;
  const auto full = full_model<Element>(beam, candidate.elements);
  if (candidate.reduction == Reduction::pod)
    return SceneModel(PodModel<>(train_pod(take_snapshots(beam, full, plan))));
  return SceneModel(GalerkinModel<>(train_galerkin(take_snapshots_at_tensions(beam, full, plan))));
}

inline SceneModel build(const Scene& scene, const Candidate& candidate, int segments) {
  switch (candidate.kinematics) {
    case Kinematics::linear: return build<Linear>(scene, candidate, segments);
    case Kinematics::von_karman: return build<VonKarman<>>(scene, candidate, segments);
    case Kinematics::corotational: break;
  }
  return build<Corotational<>>(scene, candidate, segments);
}

}  // namespace detail

/// @throws std::invalid_argument, TrainingError
inline SceneModel build(const Scene& scene, const Candidate& candidate) {
  return detail::build(scene.check(), candidate, 32);
}

}  // namespace hapbeam
