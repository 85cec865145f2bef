// Order statistics of times and errors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace hapbeam::benchmarks {

/// The value below which a part of all lies; 0 where there are none.   @param values  reordered
inline double quantile(std::vector<double>& values, double part) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

inline double median(std::vector<double> values) { return quantile(values, 0.5); }

/// Mean of the middle half; 0 where there are none.
inline double middle(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto part = static_cast<std::ptrdiff_t>(values.size() / 4);
  return std::accumulate(values.begin() + part, values.end() - part, 0.0) /
         static_cast<double>(values.end() - values.begin() - 2 * part);
}

}  // namespace hapbeam::benchmarks
