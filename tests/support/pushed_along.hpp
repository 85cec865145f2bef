// A model in space seen as a planar one: pushed along one direction from where it rests, so that the one suite of laws runs over both.
//
//   PushedAlong<FemModel<RoundRod>> model(FemModel<RoundRod>(rod, 8), {0, 0.6, 0.8});
#pragma once

#include <utility>
#include <vector>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam::testing {

template <class Model>
class PushedAlong {
 public:
  using Scalar = typename Model::Scalar;
  using Vector3 = VectorOf<Scalar, 3>;

  /// @param model  at rest   @param normal  unit
  PushedAlong(Model model, const Vector3& normal) : model_(std::move(model)), normal_(normal) {
    static_assert(is_force_model<Model> && Model::dimension == 3);
    const auto shape = model_.shape();
    home_.assign(shape.begin(), shape.end());
    nodes_.resize(home_.size());
  }

  Response<Scalar> press(const Press<Scalar>& press) noexcept {
    return model_.push(Push<Scalar, 3>{press.s, normal_.dot(home(press.s).r) + press.d, normal_});
  }
  /// Displacements from rest: w along the normal, u along the rod.
  Centreline<Scalar> shape() const noexcept {
    const auto shape = model_.shape();
    for (int i = 0; i < shape.size(); ++i) {
      const auto& node = shape[i];
      const RodPoint<Scalar> rest = home(node.s);
      const Vector3 moved = node.r - rest.r;
      nodes_[static_cast<std::size_t>(i)] = {node.s, rest.tangent.dot(moved), normal_.dot(moved),
                                             -normal_.dot(node.tangent - rest.tangent)};
    }
    return {nodes_.data(), static_cast<int>(nodes_.size())};
  }
  Range<Scalar> range() const noexcept { return model_.range(); }
  Scalar thickness() const noexcept { return model_.thickness(); }
  void reset() noexcept { model_.reset(); }

 private:
  RodPoint<Scalar> home(Scalar s) const noexcept {
    return Centreline<Scalar, 3>(home_.data(), static_cast<int>(home_.size())).at(s);
  }

  Model model_;
  Vector3 normal_;
  std::vector<RodNode<Scalar>> home_;
  mutable std::vector<CentrelineNode<Scalar>> nodes_;
};

}  // namespace hapbeam::testing
