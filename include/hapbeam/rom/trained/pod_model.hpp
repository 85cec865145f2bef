// SPDX-License-Identifier: MIT
// A trained beam: force and shape by interpolation between presses of the full model, as a ForceModel.
//
// The work V of a press is interpolated, as 2V/e² in the coordinates of coordinates.hpp.  F = ∂V/∂d and ∂V/∂s = F θ give the force and
// the rotation at the contact, so a closed path neither gains nor loses energy.  The rest of the shape is made of POD modes (thesis eq.
// 3.54, 3.67).  The cost does not depend on the elements: positions × depths for the force, and points × modes more for the shape.
// A press deeper than range() has the force at its end plus the tangent stiffness there, held constant; s is that of the nearest press
// in range.  Closed paths conserve energy inside the range alone.
// Offline: construction allocates and throws std::invalid_argument.  Servo: all else is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/trained_model.hpp>

namespace hapbeam {

namespace detail {

/// By position: derivative of the potential in y by depth, the potential, and by depth what makes the nodes near the contact, the
/// last of which is the derivative of the potential in x.
template <typename Scalar, class Nodes>
struct PodTable : TrainedTable<PodModelData<Scalar>, Nodes, 2> {
  using Base = TrainedTable<PodModelData<Scalar>, Nodes, 2>;
  using Base::data;
  DepthCoordinate<Scalar> depth{data.beam, data.symmetric};
  Lagrange<Nodes, Scalar> y{data.depths, data.y_low, data.y_high};
  std::vector<Scalar> rest_by_x = std::vector<Scalar>(static_cast<std::size_t>(data.positions));

  [[gnu::cold]] explicit PodTable(PodModelData<Scalar> given) : Base(std::move(given)) {
    const int m = data.depths, size = this->row_size();
    Scalar* row = this->table.data();
    for (int i = 0; i < data.positions; ++i, row += size) {
      std::copy_n(data.potential.data() + i * m, m, row + m);
      y.differentiate(row + m, 1, row, 1);
    }
    row = this->table.data();
    for (int j = 0; j < m; ++j)
      this->x.differentiate(row + m + j, size, this->nearby(row, j) + Base::Shape::own, size);
    this->x.differentiate(data.rest.data(), 1, rest_by_x.data(), 1);
  }
};

}  // namespace detail

/// @tparam ScalarType double | float      @tparam NodePolicy  ChebyshevNodes | EquispacedNodes, as it was trained
template <typename ScalarType = double, class NodePolicy = ChebyshevNodes>
class PodModel : public detail::TrainedModel<detail::PodTable<ScalarType, NodePolicy>> {
  using Base = detail::TrainedModel<detail::PodTable<ScalarType, NodePolicy>>;

 public:
  using Scalar = ScalarType;
  using Nodes = NodePolicy;
  using Data = PodModelData<Scalar>;

  /// @throws std::invalid_argument where the data do not make a model
  [[gnu::cold]] explicit PodModel(Data data) : Base(std::move(data)) {}

  /// The force alone; shape() stays.  @return as press()
  [[nodiscard]] Response<Scalar> force(const Press<Scalar>& request) const noexcept {
    Point at;
    return respond(request, at);
  }

  /// Force and shape of a transverse displacement d [m] at arc position s [m] of the unloaded beam.
  /// @return force [N] and ok | out_of_range | invalid_request | non_finite
  Response<Scalar> press(const Press<Scalar>& request) noexcept;

 private:
  using Base::max_size;
  using Base::trained_;

  /// A press in range and what is interpolated there.
  struct Point {
    Press<Scalar> press;
    Scalar e, y;                         // depth from rest [m], its coordinate
    Scalar lx[max_size], ly[max_size];   // weights
    Scalar work, work_by_y, half_slope;  // 2V/e² times scale, its derivative, ½ e dy/de
    Scalar scale;

    Scalar force() const noexcept { return e * (work + half_slope * work_by_y) / scale; }
  };

  Response<Scalar> respond(const Press<Scalar>& request, Point& at) const noexcept;

  /// Interpolates at the depth of a point, whose weights by position are known.
  [[gnu::noinline]] void descend(Point& at) const noexcept;

  /// θ at the contact: (∂V/∂s at constant d)/F [rad].
  /// @param by_x  ∂/∂x of the potential
  Scalar rotation(const Point& at, Scalar by_x) const noexcept;
};

// Long functions are defined outside of the class: only then does "extern template class PodModel<>;" compile them in one file alone.
template <typename Scalar, class Nodes>
Response<Scalar> PodModel<Scalar, Nodes>::press(const Press<Scalar>& request) noexcept {
  Point at;
  const Response<Scalar> response = respond(request, at);
  if (!is_answer(response.status)) return response;
  const Data& data = this->data();
  const auto theta = [&](Scalar by_x) { return rotation(at, by_x); };
  if (!this->draw(at.press, data.symmetric ? at.press.d : data.depth, at.lx, at.ly, theta))
    return {0, Status::non_finite};
  return response;
}

template <typename Scalar, class Nodes>
Response<Scalar> PodModel<Scalar, Nodes>::respond(const Press<Scalar>& request, Point& at) const noexcept {
  if (!this->valid(request)) return {0, Status::invalid_request};
  at.press = this->range().nearest(request);
  this->weigh(at.press.s, at.lx);
  at.scale = trained_->position.scale(at.press.s);
  descend(at);
  Scalar force = at.force();
  if (at.press.d == request.d) {
    if (!std::isfinite(force)) return {0, Status::non_finite};
    return {force, at.press.s == request.s ? Status::ok : Status::out_of_range};
  }
  Point nearby = at;
  const Scalar step = at.press.d / 256;
  nearby.press.d = at.press.d + step, descend(nearby);
  Scalar stiffness = nearby.force();
  nearby.press.d = at.press.d - step, descend(nearby);
  stiffness = (std::max)((stiffness - nearby.force()) / (2 * step), Scalar(0));
  force += stiffness * (detail::bounded(request.d, trained_->data.beam.length) - at.press.d);
  if (!std::isfinite(force)) return {0, Status::non_finite};
  return {force, Status::out_of_range};
}

template <typename Scalar, class Nodes>
void PodModel<Scalar, Nodes>::descend(Point& at) const noexcept {
  const auto& t = *trained_;
  const int n = t.data.positions, m = t.data.depths;
  at.e = at.press.d;
  if (!t.data.symmetric) at.e -= detail::dot(at.lx, t.data.rest.data(), n);
  at.y = t.depth(at.e);
  at.half_slope = t.depth.half_log_derivative(at.e, at.y);
  t.y.weights(at.y, at.ly);
  Scalar sum[2 * max_size];
  if (n > 1) detail::combine(t.table.data(), t.row_size(), detail::padded(2 * m), at.lx, n, sum);
  const Scalar* column = n > 1 ? sum : t.table.data();
  at.work = detail::dot(at.ly, column + m, m);
  at.work_by_y = detail::dot(at.ly, column, m);
}

template <typename Scalar, class Nodes>
Scalar PodModel<Scalar, Nodes>::rotation(const Point& at, Scalar by_x) const noexcept {
  const auto& t = *trained_;
  const Scalar rest_by_x =
      t.data.symmetric ? Scalar(0) : detail::dot(at.lx, t.rest_by_x.data(), t.data.positions);
  const Scalar s = at.press.s, x_by_s = t.position.derivative(s);
  return at.e / 2 * (by_x * x_by_s - at.work * t.position.log_scale_derivative(s)) /
             (at.work + at.half_slope * at.work_by_y) -
         rest_by_x * x_by_s;
}

}  // namespace hapbeam
