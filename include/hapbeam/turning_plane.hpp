// SPDX-License-Identifier: MIT
// The plane that turns: a planar model of a straight round rod, lifted into space.
//
//   const Rod wire(0.2, RodSection::circle(0.001), RodMaterial{200e9, 77e9}, RodSupport::clamped, RodSupport::free);
//   TurningPlane<FemModel<Corotational<>>> model(wire, {beam_in_any_plane(wire), 8});
//   model.push({0.15, 0.01, {0, 0.6, 0.8}});
//
// A rod that is the same however it is turned about its axis answers any push in the plane of that push and the axis.  So each
// planar model of it answers in space: FemModel, PodModel, GalerkinModel.  The plane follows the direction of the push.
// Offline: beam_in_any_plane() and construction throw std::invalid_argument where this is not exact.  Servo: noexcept, no
// allocation, as bounded as the planar model; a push takes a few dozen instructions more, and shape() O(nodes) where it is asked for.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <hapbeam/angle.hpp>
#include <hapbeam/beam.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/internal_forces.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

namespace detail {

/// @throws std::invalid_argument where no support of a beam does the same in each plane
[[gnu::cold]] inline Support planar_support(const char* field, const RodSupport& support) {
  if (support == RodSupport::free) return Support::free;
  if (support == RodSupport::clamped) return Support::clamped;
  RodSupport loose = support;
  loose.twist = 0;  // what bends in a plane does not twist
  if (loose == RodSupport::hinged) return Support::pinned;
  loose.along = RodSupport::hinged.along;
  if (support.along == 0 && loose == RodSupport::hinged) return Support::roller;
  refuse("%s = %s: must be free, clamped, hinged, cardan, or a hinge that slides along the axis", field,
         name(support));
}

}  // namespace detail

/// The beam that a straight round rod is in each plane through its axis.
/// @throws std::invalid_argument naming what is not the same in all of them
[[gnu::cold]] inline Beam beam_in_any_plane(const Rod& rod) {
  const RodStiffness& k = rod.stiffness();
  const VectorOf<double, 3> axis = rod.left_pose().along;
  const auto along_axis = [&axis](const char* field, const VectorOf<double, 3>& force, const char* unit) {
    const double across = std::sqrt((force - axis.dot(force) * axis).squaredNorm());
    if (!(across <= 1e-12 * std::sqrt(force.squaredNorm())))
      detail::reject(field, across, unit, "along the axis, 0 across it");
    return axis.dot(force);
  };
  if (!(std::abs(k.bending2 - k.bending1) <= 1e-12 * k.bending1))
    detail::reject("bending2 stiffness", k.bending2, "N·m²", "bending1 stiffness: a round section");
  if (!rod.parts().empty())
    detail::reject("parts", static_cast<double>(rod.parts().size()), "",
                   "none: one section for all of the rod");
  for (const RodArc& arc : rod.arcs()) {
    if (arc.curvature1 != 0) detail::reject("arc curvature1", arc.curvature1, "1/m", "0: straight by nature");
    if (arc.curvature2 != 0) detail::reject("arc curvature2", arc.curvature2, "1/m", "0: straight by nature");
  }
  if (!rod.foundations().empty())
    detail::reject("foundations", static_cast<double>(rod.foundations().size()), "", "none");
  Beam beam(rod.length(), k.axial, k.bending1, rod.thickness(),
            detail::planar_support("left support", rod.left()),
            detail::planar_support("right support", rod.right()));
  if (const RodPose* const right = rod.right_pose()) {
    const double stretch = along_axis("right pose at", right->at - rod.left_pose().at, "m") - rod.length();
    (void)along_axis("right pose along", right->along, "");
    if (!(right->along.dot(axis) > 0))
      detail::reject("right pose along", right->along.dot(axis), "", "along the axis");
    if (holds_twist(rod.left()) && holds_twist(rod.right()) &&
        !((right->director - rod.left_pose().director).squaredNorm() <= 1e-24))
      detail::reject("right pose director", right->director.dot(rod.left_pose().director), "",
                     "that of the left pose");
    beam.place({}, {stretch, 0, 0});
  }
  if (const RodLoad load = rod.load()) {
    for (int i = 0; i <= 1000; ++i) (void)along_axis("load", load(rod.length() * i / 1000), "N/m");
    beam.axial([load, axis](double s) { return axis.dot(load(s)); });
  }
  for (const RodForce& force : rod.forces()) beam.add({force.s, along_axis("force", force.force, "N"), 0, 0});
  return beam;
}

/// @tparam Model  planar, of beam_in_any_plane(rod)
template <class Model>
class TurningPlane {
  static_assert(is_force_model<Model> && dimension_of<Model> == 2,
                "TurningPlane<Model>: a planar ForceModel as listed in hapbeam/force_model.hpp");

 public:
  using Scalar = typename Model::Scalar;
  static constexpr int dimension = 3;

  /// @throws std::invalid_argument as beam_in_any_plane(), and where the model is not of it or not straight at rest
  TurningPlane(const Rod& rod, Model model) : model_(std::move(model)) {
    const Beam beam = beam_in_any_plane(rod);
    const auto same = [](const char* field, double got, double expected) {
      if (!(std::abs(got / expected - 1) <= 1e-6)) detail::reject(field, got, "m", "the rod's");
    };
    same("model length", static_cast<double>(model_.shape().length()), beam.length());
    same("model thickness", static_cast<double>(model_.thickness()), beam.thickness());
    for (const auto& node : model_.shape())
      if (!(std::abs(static_cast<double>(node.w)) <= 1e-6 * beam.length()))
        detail::reject("w of the model at rest", static_cast<double>(node.w), "m", "0: it buckles");
    const RodPose& pose = rod.left_pose();
    at_ = pose.at.template cast<Scalar>();
    axis_ = pose.along.template cast<Scalar>();
    up_ = home_ = pose.director.template cast<Scalar>();
    nodes_.resize(static_cast<std::size_t>(model_.shape().size()));
  }

  /// Prescribes n · r = d at s.  A model that takes presses alone is pressed across the axis, and takes n up to 60° from there.
  /// @return force along n [N], and as the planar model's press() or push()
  Response<Scalar> push(const Push<Scalar, 3>& request) noexcept {
    using std::sqrt;
    const VectorOf<Scalar, 3>& n = request.normal;
    const Scalar n_x = axis_.dot(n);
    const VectorOf<Scalar, 3> across = n - n_x * axis_;
    const Scalar size = sqrt(across.squaredNorm());
    // On the side of before: pulled or pushed.
    const Scalar n_w = up_.dot(across) < 0 ? -size : size;
    drawn_ = false;
    if (!(size > (any_direction ? Scalar(1e-6) : Scalar(0.5)))) return {0, Status::invalid_request};
    const VectorOf<Scalar, 3> up = across / n_w;
    const Scalar d = request.d - n.dot(at_) - n_x * request.s;
    Response<Scalar> response;
    if constexpr (any_direction) {
      response = model_.push(Push<Scalar>{request.s, d, {n_x, n_w}});
    } else {
      const Scalar u = n_x == 0 ? Scalar(0) : model_.shape().at(request.s).u;
      response = model_.press({request.s, (d - n_x * u) / n_w});
      response.force /= n_w;
    }
    if (response.status != Status::invalid_request) up_ = up;
    return response;
  }

  /// Nodes are those of the planar model, their tangents unit ones or, at moderate rotation, (1, dw/dx).
  Centreline<Scalar, 3> shape() const noexcept {
    if (!drawn_) draw();
    return {nodes_.data(), static_cast<int>(nodes_.size())};
  }
  /// As the planar model: d1 is the plane's normal, so that shear is along d2 and bending about d1.
  template <class M = Model, std::enable_if_t<has_internal_forces<M>, int> = 0>
  InternalForces<Scalar, 3> internal_forces(Scalar s) const noexcept {
    return in_space(model_.internal_forces(s));
  }
  template <class M = Model, std::enable_if_t<has_internal_forces<M>, int> = 0>
  InternalForces<Scalar, 3> internal_forces(int piece, Scalar s) const noexcept {
    return in_space(model_.internal_forces(piece, s));
  }
  /// Where push() answers with ok: in depth without a limit where that of the planar model has none.
  Range<Scalar> range() const noexcept {
    Range<Scalar> range = model_.range();
    if constexpr (any_direction) range.depth = range.slope = std::numeric_limits<Scalar>::infinity();
    return range;
  }
  Scalar thickness() const noexcept { return model_.thickness(); }
  Status release() noexcept {
    drawn_ = false;
    if constexpr (takes_push<Model>) return model_.release();
    else return model_.reset(), Status::ok;
  }
  void reset() noexcept {
    model_.reset();
    up_ = home_, drawn_ = false;
  }

  const Model& planar() const noexcept { return model_; }

 private:
  static constexpr bool any_direction = takes_push<Model>;

  static InternalForces<Scalar, 3> in_space(const InternalForces<Scalar>& cut) noexcept {
    return {cut.normal, 0, -cut.shear, -cut.moment, 0, 0, cut.axial_strain, cut.surface_strain};
  }
  void draw() const noexcept {
    const auto shape = model_.shape();
    const VectorOf<Scalar, 3> side = detail::cross3(axis_, up_);
    for (int i = 0; i < shape.size(); ++i) {
      const CentrelineNode<Scalar>& node = shape[i];
      const Vector2<Scalar> t =
          shape.any_rotation() ? detail::direction(-node.theta) : Vector2<Scalar>(1, -node.theta);
      nodes_[static_cast<std::size_t>(i)] = {node.s, at_ + (node.s + node.u) * axis_ + node.w * up_,
                                             t.x() * axis_ + t.y() * up_, side};
    }
    drawn_ = true;
  }

  Model model_;
  VectorOf<Scalar, 3> at_, axis_, up_;  // the left end, and the plane: x and w
  VectorOf<Scalar, 3> home_;            // w before the first push
  mutable std::vector<RodNode<Scalar>> nodes_;
  mutable bool drawn_ = false;
};

}  // namespace hapbeam
