// SPDX-License-Identifier: MIT
// The model that a scene needs, whichever it is, as one ForceModel; it is trained where it is a trained one.
//
//   SceneModel model = build(scene, choose(scene).model());
//   model.press({s, d});                             // one switch and the model's own press: nothing virtual
//   model.visit([](auto& chosen) { … });             // or a loop that is compiled for the one that was chosen
//
// Touch and ServoLoop push a planar model of finite rotation along the normal if they are given that model itself, through visit().
// Building allocates and throws what training throws; it includes an SVD, which takes seconds to compile.
// Servo: noexcept, allocation-free, bounded as the model that it holds.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include <hapbeam/beam.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>
#include <hapbeam/scene/scene.hpp>

namespace hapbeam {

namespace detail {

template <class Model>
Response<double> force_of(Model& model, const Press<double>& request) noexcept {
  if constexpr (std::is_same_v<Model, PodModel<>> || std::is_same_v<Model, GalerkinModel<>>)
    return model.force(request);
  else return model.press(request);
}

}  // namespace detail

/// One of several models.
/// @tparam D  of the space in which they bend: planar ones are pressed, those in space pushed
template <int D, class... Models>
class AnyOf {
 public:
  using Scalar = double;
  using Any = std::variant<Models...>;
  static constexpr int dimension = D, contacts = 1;

  template <class Model>
  explicit AnyOf(Model model) : model_(std::in_place_type<Model>, std::move(model)) {}

  /// Calls use(model) with the model itself.
  template <class Use>
  decltype(auto) visit(Use&& use) {
    return std::visit(std::forward<Use>(use), model_);
  }
  template <class Use>
  decltype(auto) visit(Use&& use) const {
    return std::visit(std::forward<Use>(use), model_);
  }

  Response<double> press(const Press<double>& request) noexcept {
    return visit([&](auto& model) { return model.press(request); });
  }
  /// The force alone, for less where the model can tell it without the shape; shape() may stay as it was.
  Response<double> force(const Press<double>& request) noexcept {
    return visit([&](auto& model) { return detail::force_of(model, request); });
  }
  template <int N = D, std::enable_if_t<N == 3, int> = 0>
  Response<double> push(const Push<double, N>& request) noexcept {
    return visit([&](auto& model) { return model.push(request); });
  }
  template <int N = D, std::enable_if_t<N == 3, int> = 0>
  Status push(Obstacle<double, N>* all, int count) noexcept {
    return visit([&](auto& model) { return model.push(all, count); });
  }
  template <int N = D, std::enable_if_t<N == 3, int> = 0>
  Status release() noexcept {
    return visit([](auto& model) { return model.release(); });
  }
  Centreline<double, D> shape() const noexcept {
    return visit([](const auto& model) { return model.shape(); });
  }
  Range<double> range() const noexcept {
    return visit([](const auto& model) { return model.range(); });
  }
  double thickness() const noexcept {
    return visit([](const auto& model) { return model.thickness(); });
  }
  void reset() noexcept {
    visit([](auto& model) { model.reset(); });
  }

 private:
  Any model_;
};

using SceneModel =
    AnyOf<2, FemModel<Linear>, FemModel<>, FemModel<Corotational<>>, PodModel<>, GalerkinModel<>>;

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
  if (candidate.reduction == Reduction::none) return SceneModel(FemModel<Element>(beam, n));
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
