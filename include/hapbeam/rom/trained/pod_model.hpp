// SPDX-License-Identifier: MIT
// A trained beam: force and shape by interpolation between presses of the full model, as a ForceModel.
//
// The work V of a press is interpolated, as 2V/e² in the coordinates of coordinates.hpp. The force is its derivative, F
// = ∂V/∂d, so a closed path of the contact neither gains nor loses energy, whatever the error. The rotation at the
// contact follows from the same V, ∂V/∂s = F θ. The rest of the shape is made of POD modes (thesis eq. 3.54, 3.67).
// The cost does not depend on the elements: positions × depths for the force, and points × modes more for the shape.
// Copies share the trained data and have a state of their own: a copy costs the nodes of a shape.
// Outside range() nothing is extrapolated. A deeper press has the force at the end of the range plus its tangent
// stiffness there, held constant; s is that of the nearest press in range. Closed paths conserve energy inside the
// range alone.
// Offline: construction allocates and throws std::invalid_argument.  Servo: all else is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/combine.hpp>
#include <hapbeam/rom/trained/lagrange.hpp>
#include <hapbeam/rom/trained/model_data.hpp>

namespace hapbeam {

/// @tparam ScalarType double | float      @tparam NodePolicy  ChebyshevNodes | EquispacedNodes, as it was trained
template <typename ScalarType = double, class NodePolicy = ChebyshevNodes>
class PodModel {
 public:
  using Scalar = ScalarType;
  using Nodes = NodePolicy;
  using Data = PodModelData<Scalar>;

  /// @throws std::invalid_argument where the data do not make a model
  [[gnu::cold]] explicit PodModel(Data data)
      : trained_(std::make_shared<const Trained>(std::move(data))),
        shape_(trained_->data.beam, trained_->data.shape, trained_->data.positions, trained_->data.depths) {}

  /// The force alone; shape() stays.  @return as press()
  [[nodiscard]] Response<Scalar> force(const Press<Scalar>& request) const noexcept {
    Point at;
    return respond(request, at);
  }

  /// Force and shape of a transverse displacement d [m] at arc position s [m] of the unloaded beam.
  /// @return force [N] and ok | out_of_range | invalid_request | non_finite
  Response<Scalar> press(const Press<Scalar>& request) noexcept;

  /// Computed at the first call after a press; one thread at a time.
  Centreline<Scalar> shape() const noexcept;
  /// The pieces of shape() that hold arc positions s0 to s1; beside the contact without the others.
  CentrelinePart<Scalar> part(Scalar s0, Scalar s1) const noexcept {
    return shape_.part(trained_->data.shape, s0, s1);
  }
  /// The trained presses.
  Range<Scalar> range() const noexcept { return detail::trained_range(trained_->data); }
  Scalar thickness() const noexcept { return trained_->data.beam.thickness; }
  void reset() noexcept { shape_.reset(trained_->data.shape); }

  const Data& data() const noexcept { return trained_->data; }
  /// Errors of presses that it was not trained with.
  const ErrorReport& errors() const noexcept { return trained_->data.errors; }

 private:
  static constexpr int max_size = Lagrange<Nodes, Scalar>::max_size;
  using Shape = ShapeTable<Scalar>;

  /// A press in range and what is interpolated there.
  struct Point {
    Press<Scalar> press;
    Scalar e, y;                         // depth from rest [m], its coordinate
    Scalar lx[max_size], ly[max_size];   // weights
    Scalar work, work_by_y, half_slope;  // 2V/e² times scale, its derivative, ½ e dy/de
    Scalar scale;

    Scalar force() const noexcept { return e * (work + half_slope * work_by_y) / scale; }
  };

  /// The trained data and what follows from them: the same for all copies.
  struct Trained {
    Data data;
    PositionCoordinate<Scalar> position;
    DepthCoordinate<Scalar> depth;
    Lagrange<Nodes, Scalar> x, y;
    // Position by position: derivative of the potential in y by depth, the potential, and by depth what makes the nodes near the
    // contact, the last of which is the derivative of the potential in x.
    std::vector<Scalar> table, rest_by_x;

    [[gnu::cold]] explicit Trained(Data given);
  };

  static int row_size(int depths) noexcept { return (2 + Shape::near_size) * depths; }

  Response<Scalar> respond(const Press<Scalar>& request, Point& at) const noexcept;

  void locate(Point& at) const noexcept {
    const Trained& t = *trained_;
    t.x.weights(t.data.positions > 1 ? t.position(at.press.s) : Scalar(0), at.lx);
    at.scale = t.position.scale(at.press.s);
    descend(at);
  }

  /// The rest of locate(), for another depth at the same position.
  [[gnu::noinline]] void descend(Point& at) const noexcept;

  /// θ at the contact: (∂V/∂s at constant d)/F [rad].
  /// @param by_x  ∂/∂x of the potential
  Scalar rotation(const Point& at, Scalar by_x) const noexcept;

  std::shared_ptr<const Trained> trained_;
  mutable Shape shape_;  // of the last press, as far as it was computed
};

// Long functions are defined outside of the class: only then does "extern template class PodModel<>;" compile them in one
// file alone.
template <typename Scalar, class Nodes>
Centreline<Scalar> PodModel<Scalar, Nodes>::shape() const noexcept {
  return shape_.all(trained_->data.shape);
}

template <typename Scalar, class Nodes>
PodModel<Scalar, Nodes>::Trained::Trained(Data given)
    : data((check(given), std::move(given))),
      position(data.beam),
      depth(data.beam, data.symmetric),
      x(data.positions, position(data.s_min), position(data.s_max)),
      y(data.depths, data.y_low, data.y_high),
      table(static_cast<std::size_t>(data.positions * row_size(data.depths) + detail::padded(1))),
      rest_by_x(static_cast<std::size_t>(data.positions)) {
  const int m = data.depths, n = data.positions, size = row_size(m);
  const auto nearby = [m](Scalar* row, int j) { return row + 2 * m + Shape::near_size * j; };
  Scalar* row = table.data();
  for (int i = 0; i < n; ++i, row += size) {
    std::copy_n(data.potential.data() + i * m, m, row + m);
    y.differentiate(row + m, 1, row, 1);
    for (int j = 0; j < m; ++j) Shape::tabulate(data.shape, i * m + j, nearby(row, j));
  }
  row = table.data();
  for (int j = 0; j < m; ++j) x.differentiate(row + m + j, size, nearby(row, j) + Shape::own, size);
  x.differentiate(data.rest.data(), 1, rest_by_x.data(), 1);
}

template <typename Scalar, class Nodes>
Response<Scalar> PodModel<Scalar, Nodes>::press(const Press<Scalar>& request) noexcept {
  Point at;
  const Response<Scalar> response = respond(request, at);
  if (!is_answer(response.status)) return response;
  const Data& data = trained_->data;
  const Scalar unit = data.symmetric ? at.press.d : data.depth;
  const int m = data.depths;
  Scalar by_depth[Shape::near_size * max_size], nearby[Shape::near_size] = {};
  detail::combine(trained_->table.data() + 2 * m, row_size(m), Shape::near_size * m, at.lx, data.positions,
                  by_depth);
  detail::combine(by_depth, Shape::near_size, Shape::near_size, at.ly, m, nearby);
  const Scalar theta = rotation(at, nearby[Shape::own]);
  if (data.positions > 1 && !std::isfinite(theta)) return {0, Status::non_finite};
  shape_.press(at.press.s, at.press.d, unit, data.positions > 1 ? &theta : nullptr, at.lx, at.ly, nearby);
  return response;
}

template <typename Scalar, class Nodes>
Response<Scalar> PodModel<Scalar, Nodes>::respond(const Press<Scalar>& request, Point& at) const noexcept {
  using std::isfinite;
  if (!isfinite(request.s) || !isfinite(request.d) || request.s < 0 || request.s > trained_->data.beam.length)
    return {0, Status::invalid_request};
  at.press = range().nearest(request);
  locate(at);
  Scalar force = at.force();
  if (at.press.d == request.d) {
    if (!isfinite(force)) return {0, Status::non_finite};
    return {force, at.press.s == request.s ? Status::ok : Status::out_of_range};
  }
  Point nearby = at;
  const Scalar step = at.press.d / 256;
  nearby.press.d = at.press.d + step, descend(nearby);
  Scalar stiffness = nearby.force();
  nearby.press.d = at.press.d - step, descend(nearby);
  stiffness = (std::max)((stiffness - nearby.force()) / (2 * step), Scalar(0));
  force += stiffness * (detail::bounded(request.d, trained_->data.beam.length) - at.press.d);
  if (!isfinite(force)) return {0, Status::non_finite};
  return {force, Status::out_of_range};
}

template <typename Scalar, class Nodes>
void PodModel<Scalar, Nodes>::descend(Point& at) const noexcept {
  const Trained& t = *trained_;
  const int n = t.data.positions, m = t.data.depths;
  at.e = at.press.d;
  if (!t.data.symmetric) at.e -= detail::dot(at.lx, t.data.rest.data(), n);
  at.y = t.depth(at.e);
  at.half_slope = t.depth.half_log_derivative(at.e, at.y);
  t.y.weights(at.y, at.ly);
  Scalar sum[2 * max_size];
  if (n > 1) detail::combine(t.table.data(), row_size(m), detail::padded(2 * m), at.lx, n, sum);
  const Scalar* column = n > 1 ? sum : t.table.data();
  at.work = detail::dot(at.ly, column + m, m);
  at.work_by_y = detail::dot(at.ly, column, m);
}

template <typename Scalar, class Nodes>
Scalar PodModel<Scalar, Nodes>::rotation(const Point& at, Scalar by_x) const noexcept {
  const Trained& t = *trained_;
  const Scalar rest_by_x =
      t.data.symmetric ? Scalar(0) : detail::dot(at.lx, t.rest_by_x.data(), t.data.positions);
  const Scalar s = at.press.s, x_by_s = t.position.derivative(s);
  return at.e / 2 * (by_x * x_by_s - at.work * t.position.log_scale_derivative(s)) /
             (at.work + at.half_slope * at.work_by_y) -
         rest_by_x * x_by_s;
}

}  // namespace hapbeam
