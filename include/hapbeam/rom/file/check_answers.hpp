// SPDX-License-Identifier: MIT
// Checks a model that was read from a file by presses all over its range, and far beyond.
//
// The members of a file may be valid one by one and yet make no model: a potential that vanishes between two positions,
// a shape that overflows its scalar. There are two presses for each node of the grid and each sign. Those between nodes
// are where interpolation oscillates most.
// Offline: allocation-free; throws std::invalid_argument for the first press that fails.
#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/coordinates.hpp>

namespace hapbeam::detail {

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
      char text[120];
      std::snprintf(text, sizeof text, "is no model: its press at s = %g m, d = %g m is %s", double(s),
                    double(d), is_answer(response.status) ? "not finite" : name(response.status));
      throw std::invalid_argument(text);
    }
  model.reset();
}

}  // namespace hapbeam::detail
