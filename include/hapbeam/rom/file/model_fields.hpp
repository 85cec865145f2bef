// SPDX-License-Identifier: MIT
// The members of a model file: where each number of a trained model stands in it, and in what unit; and whether they make a model.
//
// One list for each kind, for JsonReader and JsonWriter alike.  The members of a file may be valid one by one and yet make no model: a
// potential that vanishes between two positions, a shape that overflows its scalar.  So what was read is pressed all over its range, and
// far beyond.  There are two presses for each node of the grid and each sign.  Those between nodes are where interpolation oscillates most.
// Offline: allocation-free; throws std::invalid_argument for the first press that fails.
#pragma once

#include <cmath>
#include <type_traits>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/coordinates.hpp>
#include <hapbeam/rom/trained/model_data.hpp>

namespace hapbeam::detail {

template <typename Scalar>
constexpr const char* scalar_name() noexcept {
  static_assert(std::is_same_v<Scalar, double> || std::is_same_v<Scalar, float>,
                "a model file holds double or float");
  return std::is_same_v<Scalar, double> ? "double" : "float";
}

template <class Fields, class Data>
[[gnu::cold]] void visit_beam_and_range(Fields& f, Data& data) {
  f.real("beam.length", "m", data.beam.length);
  f.real("beam.axial_stiffness", "N", data.beam.axial_stiffness);
  f.real("beam.bending_stiffness", "N·m²", data.beam.bending_stiffness);
  f.real("beam.thickness", "m", data.beam.thickness);
  f.choice("beam.left", data.beam.left, Support::guided);
  f.choice("beam.right", data.beam.right, Support::guided);
  f.real("range.s_min", "m", data.s_min);
  f.real("range.s_max", "m", data.s_max);
  f.real("range.depth", "m", data.depth);
}

template <class Fields, typename Scalar>
[[gnu::cold]] void visit_grid(Fields& f, PodModelData<Scalar>& data) {
  f.flag("grid.symmetric", data.symmetric);
  f.count("grid.positions", data.positions);
  f.count("grid.depths", data.depths);
  f.real("grid.y_low", "1", data.y_low);
  f.real("grid.y_high", "1", data.y_high);
  f.table("potential", "N/m", data.potential);
  f.table("rest", "m", data.rest);
}

template <class Fields, typename Scalar>
[[gnu::cold]] void visit_grid(Fields& f, GalerkinModelData<Scalar>& data) {
  f.count("grid.positions", data.positions);
  f.count("grid.tensions", data.tensions);
  f.real("grid.tension", "N", data.tension);
  f.table("log_stiffness", "ln(N/m)", data.log_stiffness);
}

template <class Fields, typename Scalar>
[[gnu::cold]] void visit_shape(Fields& f, ShapeData<Scalar>& shape) {
  f.count("shape.segments", shape.segments);
  f.count("shape.contact_node", shape.contact_node);
  f.count("shape.modes", shape.modes);
  f.table("shape.basis", "1", shape.basis);
  f.table("shape.coefficients", "1", shape.coefficients);
  f.table("shape.rest", "m, m, rad", shape.rest);
}

template <class Fields>
[[gnu::cold]] void visit_errors(Fields& f, ErrorSummary& errors) {
  f.count("presses", errors.presses);
  f.real("force_median", "1", errors.force_median);
  f.real("force_p95", "1", errors.force_p95);
  f.real("force_max", "1", errors.force_max);
  f.real("shape_median", "1", errors.shape_median);
  f.real("shape_max", "1", errors.shape_max);
}

template <class Fields>
[[gnu::cold]] void visit_region(Fields& f, RegionError& region) {
  f.real("s_min", "m", region.s_min);
  f.real("s_max", "m", region.s_max);
  f.real("depth_min", "m", region.depth_min);
  f.real("depth_max", "m", region.depth_max);
  visit_errors(f, region.errors);
}

template <class Fields, class Data>
[[gnu::cold]] void visit_model(Fields& f, Data& data, const char* nodes) {
  f.units();
  visit_beam_and_range(f, data);
  f.constant("nodes", nodes);
  visit_grid(f, data);
  visit_shape(f, data.shape);
  f.word("errors.reference", data.errors.reference);
  f.real("errors.force_bound", "1", data.errors.force_bound);
  f.real("errors.reference_error", "1", data.errors.reference_error);
  f.object("errors.all", data.errors.all, visit_errors<Fields>);
  f.list("errors.regions", data.errors.regions, visit_region<Fields>);
  f.finish();
}

template <typename Scalar>
[[gnu::cold]] bool is_finite(const Centreline<Scalar>& shape) noexcept {
  for (const CentrelineNode<Scalar>& node : shape)
    if (!std::isfinite(node.u) || !std::isfinite(node.w) || !std::isfinite(node.theta)) return false;
  return true;
}

/// @param positions, depths  of the grid   @throws std::invalid_argument
template <class Model>
[[gnu::cold]] void check_answers(Model& model, int positions, int depths) {
  using S = typename Model::Scalar;
  const auto& data = model.data();
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
      if (is_answer(response.status) && std::isfinite(response.force) && is_finite(model.shape())) continue;
      refuse("is no model: its press at s = %g m, d = %g m is %s", double(s), double(d),
             is_answer(response.status) ? "not finite" : name(response.status));
    }
  model.reset();
}

}  // namespace hapbeam::detail
