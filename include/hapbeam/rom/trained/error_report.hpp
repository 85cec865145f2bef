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
/// Dead loads bend a beam, and where they have it rest the force is zero: there a press by less than a thousandth of the
/// depth from rest counts with the force that a thousandth takes.
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
  /// No press in range() has a larger relative error of its force: a tenth more than the largest difference to the full
  /// model that a search from the worst presses found, and reference_error; 1e-8 at least, which round-off may be.  Within a
  /// thousandth of the length from an end that yields finite elements are no reference, and the bound is that of the places beside.
  /// A search is no proof; of 250 000 random presses of 50 beams none was beyond the bound.
  double force_bound = 0;
  double reference_error =
      0;  ///< largest relative error of the full model's force, by one with twice its elements
};

}  // namespace hapbeam
