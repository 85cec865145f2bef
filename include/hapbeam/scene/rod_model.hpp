// SPDX-License-Identifier: MIT
// The model that a scene in space needs, whichever it is, as one ForceModel.
//
//   RodModel model = build(scene, choose(scene).model());
//   model.push({s, d, n});                           // one switch and the model's own push: nothing virtual
//   model.visit([](auto& chosen) { … });             // or a loop that is compiled for the one that was chosen
//
// Servo: noexcept, allocation-free, bounded as the model that it holds.
#pragma once

#include <utility>
#include <variant>

#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/scene/scene_model.hpp>
#include <hapbeam/turning_plane.hpp>

namespace hapbeam {

namespace detail {

/// Those of a scene in the plane, turned; and the rods.
template <class Planar>
struct RodModels;
template <class... Planar>
struct RodModels<std::variant<Planar...>> {
  using Any = std::variant<TurningPlane<Planar>..., FemModel<RoundRod>, FemModel<TwistedRod>>;
};

}  // namespace detail

class RodModel {
 public:
  using Scalar = double;
  static constexpr int dimension = 3;
  using Any = detail::RodModels<SceneModel::Any>::Any;

  explicit RodModel(Any model) : model_(std::move(model)) {}

  /// Calls use(model) with the model itself.
  template <class Use>
  decltype(auto) visit(Use&& use) {
    return std::visit(std::forward<Use>(use), model_);
  }
  template <class Use>
  decltype(auto) visit(Use&& use) const {
    return std::visit(std::forward<Use>(use), model_);
  }

  Response<double> push(const Push<double, 3>& request) noexcept {
    return visit([&](auto& model) { return model.push(request); });
  }
  Centreline<double, 3> shape() const noexcept {
    return visit([](const auto& model) { return model.shape(); });
  }
  Range<double> range() const noexcept {
    return visit([](const auto& model) { return model.range(); });
  }
  double thickness() const noexcept {
    return visit([](const auto& model) { return model.thickness(); });
  }
  Status release() noexcept {
    return visit([](auto& model) { return model.release(); });
  }
  void reset() noexcept {
    visit([](auto& model) { model.reset(); });
  }

 private:
  Any model_;
};

}  // namespace hapbeam
