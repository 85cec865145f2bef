// SPDX-License-Identifier: MIT
// Which presses a model is trained with.
//
// Offline; throws std::invalid_argument naming field, value, unit and what is allowed.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <hapbeam/beam.hpp>
#include <hapbeam/rom/trained/model_data.hpp>

namespace hapbeam {

/// A grid of presses: positions along the beam, and at each so many depths.
struct TrainingPlan {
  double s_min, s_max;  ///< [m] equal for a single position
  int positions;        ///< 2 to 64, or 1
  double depth;         ///< [m] largest |d|
  int depths;           ///< 2 to 64; for a GalerkinModel, of tensions
  bool symmetric =
      true;  ///< train d > 0 alone, for a beam without dead loads; else both signs, with the same number of depths
  int segments =
      32;  ///< pieces of the shape that the model draws; even where there is more than one position

  /// Anywhere from 5 to 95 % of the span, or up to an end that yields.
  static TrainingPlan anywhere(const Beam& beam, double depth, int positions = 16, int depths = 12) {
    const double L = beam.length();
    return {fixes_w(beam.left()) ? 0.05 * L : 0, fixes_w(beam.right()) ? 0.95 * L : L, positions, depth,
            depths};
  }
  /// At one place.
  static TrainingPlan at(double s, double depth, int depths = 14) { return {s, s, 1, depth, depths}; }

  /// The node of the shape that follows the contact.
  int contact_node(const Beam& beam) const {
    if (positions > 1) return segments / 2;
    if (s_min == 0 || s_min == beam.length()) return s_min == 0 ? 0 : segments;
    return std::clamp(static_cast<int>(std::lround(s_min / beam.length() * segments)), 1, segments - 1);
  }

  /// @return the plan   @throws std::invalid_argument
  const TrainingPlan& check(const Beam& beam) const {
    detail::check_count("positions", positions, 1, 64);
    detail::check_count("depths", depths, 2, 64);
    detail::check_count("segments", segments, 2, 1 << 14);
    if (positions > 1 && segments % 2 != 0) detail::reject_data("segments", segments, "even");
    if (!beam.straight())
      throw std::invalid_argument(
          "beam: must be straight, with its ends where they are in the straight beam, to train a model of "
          "it");
    detail::check_range(BeamData<double>::of(beam), s_min, s_max, depth, positions);
    if (!(depth < beam.length())) detail::reject("depth", depth, "m", "less than the beam's length");
    return *this;
  }
};

}  // namespace hapbeam
