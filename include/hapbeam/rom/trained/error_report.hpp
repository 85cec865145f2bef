// SPDX-License-Identifier: MIT
// The errors of a trained model, measured on presses that it was not trained with.
//
// Kept with the model and in its file.  Plain data.
#pragma once

#include <string>
#include <vector>

namespace hapbeam {

/// Errors over a sample of presses, against the full model.  The force's is relative; the shape's is the largest |Δw| over
/// the largest |w| of the beam.
///
/// The force is zero in the shape to which dead loads bend the beam. A press by less than a thousandth of the depth
/// from there is therefore compared with the force of a thousandth.
struct ErrorSummary {
  int presses = 0;
  double force_median = 0;
  double force_p95 = 0;
  double force_max = 0;
  double shape_median = 0;
  double shape_max = 0;
};

/// The same for a part of the range.
struct RegionError {
  double s_min, s_max;          ///< [m]
  double depth_min, depth_max;  ///< [m] of |d|
  ErrorSummary errors;
};

struct ErrorReport {
  std::string reference;  ///< the full model that the model was compared with
  ErrorSummary all;       ///< of all presses of the sample
  std::vector<RegionError> regions;
  /// Bound on the relative error of the force of every press in range(). It is 1.1 times the largest difference to the
  /// full model that a search from the worst presses found, plus reference_error, and at least 1e-8 for round-off.
  /// Within a thousandth of the length from an end that is free to move, finite elements are no reference; the bound is
  /// that of the places beside.
  /// The search is no proof; none of 250 000 random presses of 50 beams exceeded the bound.
  double force_bound = 0;
  double reference_error =
      0;  ///< largest relative error of the full model's force, by one with twice its elements
};

}  // namespace hapbeam
