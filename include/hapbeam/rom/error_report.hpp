// How far a trained model is from the full one, as measured on presses that it was not trained with.
//
// Kept with the model and in its file.  Plain data.
#pragma once

#include <string>
#include <vector>

namespace hapbeam {

/// Errors over a set of presses.  The force's is relative; the shape's is the largest |Δw| over the largest |w| of the beam.
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
  std::string reference;  ///< what the model was compared with
  ErrorSummary all;
  std::vector<RegionError> regions;
};

}  // namespace hapbeam
