// SPDX-License-Identifier: MIT
// The model that a scene needs, whichever it is, as one ForceModel; and half a beam where that is enough.
//
//   SceneModel model = build(scene, choose(scene).model());
//   model.press({s, d});                             // one switch and the model's own press: nothing virtual
//   model.visit([](auto& chosen) { … });             // or a loop that is compiled for the one that was chosen
//
// Touch and ServoLoop push a model of finite rotation along the normal if they are given that model itself, through visit().
// Servo: noexcept, allocation-free, bounded as the model that it holds; construction of Mirrored allocates and throws.
#pragma once

#include <limits>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

namespace hapbeam {

/// The left half of a beam whose right half is its mirror image: no loads, ends alike, perhaps pulled apart.
inline Beam half_of(const Beam& beam) {
  Beam half(beam.length() / 2, beam.axial_stiffness(), beam.bending_stiffness(), beam.thickness(),
            beam.left(), Support::guided);
  return half.place({}, {beam.right_place().u / 2, 0, 0});
}

/// A beam that is alike on both sides of the place where it is pressed, by a model of its left half.  That one ends in a plane of
/// symmetry (Support::guided), where it is pressed with half of the force.  The other side of the shape takes O(nodes).
/// @tparam Half  a ForceModel of half_of(beam)
template <class Half>
class Mirrored {
 public:
  using Scalar = typename Half::Scalar;

  /// @param apart  [m] how far the whole beam's ends are pulled apart
  explicit Mirrored(Half half, Scalar apart = 0) : half_(std::move(half)), apart_(apart) {
    nodes_.resize(static_cast<std::size_t>(2 * half_.shape().segments() + 1));
    mirror();
  }

  /// As the half's, in the middle alone: elsewhere out_of_range.
  Response<Scalar> press(const Press<Scalar>& request) noexcept {
    const Scalar middle = half_.shape().length();
    const bool on_beam = request.s >= 0 && request.s <= 2 * middle;
    const Response<Scalar> half = half_.press({on_beam ? middle : request.s, request.d});
    if (is_answer(half.status)) mirror();
    using std::abs;
    const bool off = abs(request.s - middle) > Scalar(1e-6) * middle;
    return {2 * half.force, half.status == Status::ok && off ? Status::out_of_range : half.status};
  }

  Centreline<Scalar> shape() const noexcept {
    return {nodes_.data(), static_cast<int>(nodes_.size()), half_.shape().any_rotation()};
  }
  Range<Scalar> range() const noexcept {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const Scalar middle = half_.shape().length();
    return {middle, middle, half_.range().depth_at(middle), Scalar(1), -infinity, infinity};
  }
  Scalar thickness() const noexcept { return half_.thickness(); }
  void reset() noexcept {
    half_.reset();
    mirror();
  }

  const Half& half() const noexcept { return half_; }

 private:
  void mirror() noexcept {
    const Centreline<Scalar> left = half_.shape();
    const Scalar length = 2 * left.length();
    for (std::size_t i = 0, last = nodes_.size() - 1; i <= last / 2; ++i) {
      const CentrelineNode<Scalar>& node = left[static_cast<int>(i)];
      nodes_[last - i] = {length - node.s, apart_ - node.u, node.w, -node.theta};
      nodes_[i] = node;
    }
  }

  Half half_;
  Scalar apart_;
  std::vector<CentrelineNode<Scalar>> nodes_;
};

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
  static constexpr int dimension = D;

  explicit AnyOf(Any model) : model_(std::move(model)) {}

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

using SceneModel = AnyOf<2, FemModel<Linear>, FemModel<>, FemModel<Corotational<>>, Mirrored<FemModel<>>,
                         Mirrored<FemModel<Corotational<>>>, PodModel<>, GalerkinModel<>>;

}  // namespace hapbeam
