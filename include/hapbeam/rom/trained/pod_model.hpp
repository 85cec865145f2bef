// A trained beam: force and shape by interpolation between presses of the full model, as a ForceModel.
//
// What is interpolated is the work V of a press, 2V/e² in the coordinates of coordinates.hpp, and the force is its
// derivative, F = ∂V/∂d: no path of the contact that closes gains or loses energy, whatever the error.  The rotation at the
// contact follows from the same V, ∂V/∂s = F θ, and the rest of the shape from POD modes (thesis eq. 3.54, 3.67).
// The cost knows nothing of elements: positions × depths for the force, and points × modes more for the shape.
// Outside range() nothing is extrapolated.  Deeper presses take the force at the end of the range and its tangent
// stiffness there, held constant; s is that of the nearest press in range.  Only inside do closed paths close.
// Offline: construction allocates and throws std::invalid_argument.  Servo: all else is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
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
      : data_((check(data), std::move(data))),
        position_(data_.beam),
        depth_(data_.beam, data_.symmetric),
        x_(data_.positions, position_(data_.s_min), position_(data_.s_max)),
        y_(data_.depths, data_.y_low, data_.y_high),
        table_(static_cast<std::size_t>(data_.positions * row_size() + detail::padded(1))),
        rest_by_x_(static_cast<std::size_t>(data_.positions)),
        shape_(data_.beam, data_.shape) {
    const int m = data_.depths, n = data_.positions;
    Scalar* row = table_.data();
    for (int i = 0; i < n; ++i, row += row_size()) {
      std::copy_n(data_.potential.data() + i * m, m, row + m);
      y_.differentiate(row + m, 1, row, 1);
      for (int j = 0; j < m; ++j) Shape::tabulate(data_.shape, i * m + j, near(row, j));
    }
    row = table_.data();
    for (int j = 0; j < m; ++j)
      x_.differentiate(row + m + j, row_size(), near(row, j) + Shape::own, row_size());
    x_.differentiate(data_.rest.data(), 1, rest_by_x_.data(), 1);
  }

  /// The force alone; shape() stays.  @return as press()
  [[nodiscard]] Response<Scalar> force(const Press<Scalar>& request) const noexcept {
    Point at;
    return respond(request, at);
  }

  /// Force and shape of a transverse displacement d [m] at arc position s [m] of the unloaded beam.
  /// @return force [N] and ok | out_of_range | invalid_request | non_finite
  Response<Scalar> press(const Press<Scalar>& request) noexcept {
    Point at;
    const Response<Scalar> response = respond(request, at);
    if (!is_answer(response.status)) return response;
    const Scalar unit = data_.symmetric ? at.press.d : data_.depth;
    const int m = data_.depths;
    Scalar by_depth[Shape::near_size * max_size], near[Shape::near_size];
    detail::combine(table_.data() + 2 * m, row_size(), Shape::near_size * m, at.lx, data_.positions,
                    by_depth);
    detail::combine(by_depth, Shape::near_size, Shape::near_size, at.ly, m, near);
    const Scalar theta = rotation(at, near[Shape::own]);
    if (data_.positions > 1 && !std::isfinite(theta)) return {0, Status::non_finite};
    shape_.press(at.press.s, at.press.d, unit, data_.positions > 1 ? &theta : nullptr, at.lx, data_.positions,
                 at.ly, m, near);
    return response;
  }

  /// Computed when it is first asked for: by one thread at a time.
  Centreline<Scalar> shape() const noexcept { return shape_.all(data_.shape); }
  /// The pieces of shape() that hold arc positions s0 to s1; beside the contact without the others.
  CentrelinePart<Scalar> part(Scalar s0, Scalar s1) const noexcept {
    return shape_.part(data_.shape, s0, s1);
  }
  /// Where it was trained.
  Range<Scalar> range() const noexcept { return detail::trained_range(data_); }
  Scalar thickness() const noexcept { return data_.beam.thickness; }
  void reset() noexcept { shape_.reset(data_.shape); }

  const Data& data() const noexcept { return data_; }
  /// Of presses that it was not trained with.
  const ErrorReport& errors() const noexcept { return data_.errors; }

 private:
  static constexpr int max_size = Lagrange<Nodes, Scalar>::max_size;
  using Shape = ShapeTable<Scalar, max_size>;

  /// A press in range and what is interpolated there.
  struct Point {
    Press<Scalar> press;
    Scalar e, y;                         // depth from rest [m], its coordinate
    Scalar lx[max_size], ly[max_size];   // weights
    Scalar work, work_by_y, half_slope;  // 2V/e² times scale, its derivative, ½ e dy/de
    Scalar scale;

    Scalar force() const noexcept { return e * (work + half_slope * work_by_y) / scale; }
  };

  int row_size() const noexcept { return (2 + Shape::near_size) * data_.depths; }
  Scalar* near(Scalar* row, int depth) const noexcept {
    return row + 2 * data_.depths + Shape::near_size * depth;
  }

  Response<Scalar> respond(const Press<Scalar>& request, Point& at) const noexcept {
    using std::isfinite;
    if (!isfinite(request.s) || !isfinite(request.d) || request.s < 0 || request.s > data_.beam.length)
      return {0, Status::invalid_request};
    at.press = range().nearest(request);
    locate(at);
    Scalar force = at.force();
    if (at.press.d == request.d) {
      if (!isfinite(force)) return {0, Status::non_finite};
      return {force, at.press.s == request.s ? Status::ok : Status::out_of_range};
    }
    Point near = at;
    const Scalar step = at.press.d / 256;
    near.press.d = at.press.d + step, descend(near);
    Scalar stiffness = near.force();
    near.press.d = at.press.d - step, descend(near);
    stiffness = std::max((stiffness - near.force()) / (2 * step), Scalar(0));
    force += stiffness * (detail::bounded(request.d, data_.beam.length) - at.press.d);
    if (!isfinite(force)) return {0, Status::non_finite};
    return {force, Status::out_of_range};
  }

  void locate(Point& at) const noexcept {
    x_.weights(data_.positions > 1 ? position_(at.press.s) : Scalar(0), at.lx);
    at.scale = position_.scale(at.press.s);
    descend(at);
  }

  /// The rest of locate(), for another depth at the same position.
  [[gnu::noinline]] void descend(Point& at) const noexcept {
    const int n = data_.positions, m = data_.depths;
    at.e = at.press.d;
    if (!data_.symmetric) at.e -= detail::dot(at.lx, data_.rest.data(), n);
    at.y = depth_(at.e);
    at.half_slope = depth_.half_log_derivative(at.e, at.y);
    y_.weights(at.y, at.ly);
    Scalar sum[2 * max_size];
    if (n > 1) detail::combine(table_.data(), row_size(), detail::padded(2 * m), at.lx, n, sum);
    const Scalar* column = n > 1 ? sum : table_.data();
    at.work = detail::dot(at.ly, column + m, m);
    at.work_by_y = detail::dot(at.ly, column, m);
  }

  /// θ at the contact: (∂V/∂s at constant d)/F [rad].
  /// @param by_x  ∂/∂x of the potential
  Scalar rotation(const Point& at, Scalar by_x) const noexcept {
    const Scalar rest_by_x =
        data_.symmetric ? Scalar(0) : detail::dot(at.lx, rest_by_x_.data(), data_.positions);
    const Scalar s = at.press.s, x_by_s = position_.derivative(s);
    return at.e / 2 * (by_x * x_by_s - at.work * position_.log_scale_derivative(s)) /
               (at.work + at.half_slope * at.work_by_y) -
           rest_by_x * x_by_s;
  }

  Data data_;
  PositionCoordinate<Scalar> position_;
  DepthCoordinate<Scalar> depth_;
  Lagrange<Nodes, Scalar> x_, y_;
  // Position by position: derivative of the potential in y by depth, the potential, and by depth what makes the nodes near the
  // contact, the last of which is the derivative of the potential in x.
  std::vector<Scalar> table_, rest_by_x_;
  mutable Shape shape_;  // of the last press, as far as it was asked for
};

}  // namespace hapbeam
