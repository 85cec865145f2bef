// SPDX-License-Identifier: MIT
// The model that a scene needs, whichever it is, as one ForceModel.
//
//   SceneModel model = build(scene, choose(scene).model());
//   model.press({s, d});                             // one switch and the model's own press: nothing virtual
//   model.visit([](auto& chosen) { … });             // or a loop that is compiled for the one that was chosen
//
// Touch and ServoLoop push a model of finite rotation along the normal if they are given that model itself, through visit().
// Servo: noexcept, allocation-free, bounded as the model that it holds.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/scene/mirrored.hpp>

namespace hapbeam {

namespace detail {

template <class Model>
Response<double> force_of(Model& model, const Press<double>& request) noexcept {
  if constexpr (std::is_same_v<Model, PodModel<>> || std::is_same_v<Model, GalerkinModel<>>)
    return model.force(request);
  else return model.press(request);
}

}  // namespace detail

class SceneModel {
 public:
  using Scalar = double;
  using Any = std::variant<FemModel<Linear>, FemModel<>, FemModel<Corotational<>>, Mirrored<FemModel<>>,
                           Mirrored<FemModel<Corotational<>>>, PodModel<>, GalerkinModel<>>;

  explicit SceneModel(Any model) : model_(std::move(model)) {}

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
  Centreline<double> shape() const noexcept {
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

}  // namespace hapbeam
