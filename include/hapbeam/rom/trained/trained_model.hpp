// SPDX-License-Identifier: MIT
// What PodModel and GalerkinModel have alike: numbers that copies share, and the shape of the last press.
//
// Both interpolate on a grid of positions and another axis.  Copies share the trained data and have a state of their own: a copy
// costs the nodes of a shape.
// Offline: construction allocates and throws std::invalid_argument.  Servo: all else is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/lagrange.hpp>
#include <hapbeam/rom/trained/model_data.hpp>

namespace hapbeam::detail {

/// A displacement of more than a thousand lengths is replaced by one of a thousand, whose square does not overflow.
template <typename Scalar>
Scalar bounded(Scalar d, Scalar length) noexcept {
  const Scalar most = 1000 * length;
  return d < -most ? -most : d > most ? most : d;
}

/// @tparam Table  the trained data and what follows from them, the same for all copies:
///   data; position, the coordinate; x, the interpolation in it; others(), the size of the other axis;
///   table, position by position: first × others() numbers of the model's own, and by other axis what makes the nodes near the contact
template <class Table>
class TrainedModel {
 public:
  using Data = decltype(Table::data);
  using Scalar = decltype(Data::depth);

  /// Computed at the first call after a press; one thread at a time.
  Centreline<Scalar> shape() const noexcept { return shape_.all(trained_->data.shape); }
  /// The pieces of shape() that hold arc positions s0 to s1; beside the contact without the others.
  CentrelinePart<Scalar> part(Scalar s0, Scalar s1) const noexcept {
    return shape_.part(trained_->data.shape, s0, s1);
  }
  /// The trained presses: as deep at all places; a support that holds w is where touching ends.
  Range<Scalar> range() const noexcept {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const Data& d = data();
    const Scalar left = fixes_w(d.beam.left) ? Scalar(0) : -infinity,
                 right = fixes_w(d.beam.right) ? d.beam.length : infinity;
    return {d.s_min, d.s_max, d.depth, (std::numeric_limits<Scalar>::max)(), left, right};
  }
  Scalar thickness() const noexcept { return trained_->data.beam.thickness; }
  void reset() noexcept { shape_.reset(trained_->data.shape); }

  const Data& data() const noexcept { return trained_->data; }
  /// Errors of presses that it was not trained with.
  const ErrorReport& errors() const noexcept { return trained_->data.errors; }

 protected:
  using Shape = ShapeTable<Scalar>;
  static constexpr int max_size = decltype(Table::x)::max_size;

  [[gnu::cold]] explicit TrainedModel(Data data)
      : trained_(std::make_shared<const Table>(std::move(data))),
        shape_(trained_->data.beam, trained_->data.shape, trained_->data.positions, trained_->others()) {}

  /// Whether anything can be answered to it.
  bool valid(const Press<Scalar>& request) const noexcept {
    return std::isfinite(request.s) && std::isfinite(request.d) && request.s >= 0 &&
           request.s <= trained_->data.beam.length;
  }
  /// @param lx  out, weights of the positions
  void weigh(Scalar s, Scalar* lx) const noexcept {
    trained_->x.weights(trained_->data.positions > 1 ? trained_->position(s) : Scalar(0), lx);
  }
  /// The shape of a press, as far as contact looks.   @param unit [m]  what w is stored in units of
  /// @param lx, lo  weights along both axes   @param rotation  at the contact, of the model's own number of the nodes near it [rad]
  /// @return whether it is finite
  template <class Rotation>
  bool draw(const Press<Scalar>& press, Scalar unit, const Scalar* lx, const Scalar* lo,
            const Rotation& rotation) noexcept {
    const int m = trained_->others(), positions = trained_->data.positions;
    Scalar by_other[Shape::near_size * max_size], nearby[Shape::near_size] = {};
    combine(trained_->table.data() + Table::first * m, trained_->row_size(), Shape::near_size * m, lx,
            positions, by_other);
    combine(by_other, Shape::near_size, Shape::near_size, lo, m, nearby);
    const Scalar theta = rotation(nearby[Shape::own]);
    if (positions > 1 && !std::isfinite(theta)) return false;
    shape_.press(press.s, press.d, unit, positions > 1 ? std::optional(theta) : std::nullopt, lx, lo, nearby);
    return true;
  }

  std::shared_ptr<const Table> trained_;
  mutable Shape shape_;  // of the last press, as far as it was computed
};

/// The part of a Table that does not depend on the model.   @tparam First  numbers of the model's own by position and other axis
template <class ModelData, class Nodes, int First>
struct TrainedTable {
  using Scalar = decltype(ModelData::depth);
  using Shape = ShapeTable<Scalar>;
  static constexpr int first = First;

  ModelData data;
  PositionCoordinate<Scalar> position{data.beam};
  Lagrange<Nodes, Scalar> x{data.positions, position(data.s_min), position(data.s_max)};
  std::vector<Scalar> table =
      std::vector<Scalar>(static_cast<std::size_t>(data.positions * row_size() + padded(1)));

  [[gnu::cold]] explicit TrainedTable(ModelData given) : data((check(given), std::move(given))) {
    Scalar* row = table.data();
    for (int i = 0; i < data.positions; ++i, row += row_size())
      for (int j = 0; j < others(); ++j) Shape::tabulate(data.shape, i * others() + j, nearby(row, j));
  }

  int others() const noexcept { return data.others(); }
  int row_size() const noexcept { return (first + Shape::near_size) * others(); }
  Scalar* nearby(Scalar* row, int j) const noexcept { return row + first * others() + Shape::near_size * j; }
};

/// Members may be valid one by one and yet make no model: a potential that vanishes between two positions, a shape that overflows its
/// scalar.  So a model is pressed all over its range and far beyond: twice for each node of the grid and each sign, for interpolation
/// oscillates most between nodes.   @throws std::invalid_argument for the first press that fails
template <class Model>
[[gnu::cold]] void check_answers(Model& model) {
  using S = typename Model::Scalar;
  const auto& data = model.data();
  const int positions = data.positions, depths = data.others();
  const auto finite = [](const CentrelineNode<S>& node) { return is_finite(node); };
  const PositionCoordinate<S> coordinate(data.beam);
  const S low = coordinate(data.s_min), high = coordinate(data.s_max);
  for (int i = 0, last = positions > 1 ? 2 * positions : 0; i <= last; ++i)
    for (int j = -2 * depths - 1; j <= 2 * depths + 1; ++j) {
      const S part = S(j) / S(2 * depths), size = part < 0 ? -part : part;
      const S s = i == 0      ? data.s_min
                  : i == last ? data.s_max
                              : coordinate.inverse(low + (high - low) * S(i) / S(last));
      // Quadratically, as the depths of a grid are; the last goes to a thousand lengths.
      const S d = size > 1 ? 1000 * part * data.beam.length : data.depth * part * size;
      const Response<S> response = model.press({s, d});
      const auto shape = model.shape();
      if (is_answer(response.status) && std::isfinite(response.force) &&
          std::all_of(shape.begin(), shape.end(), finite))
        continue;
      refuse("is no model: its press at s = %g m, d = %g m is %s", double(s), double(d),
             is_answer(response.status) ? "not finite" : name(response.status));
    }
  model.reset();
}

}  // namespace hapbeam::detail
