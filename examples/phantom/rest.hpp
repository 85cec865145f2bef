// Where a beam is before it is touched.
#pragma once

#include <hapbeam/centreline.hpp>

namespace phantom {

/// How high its centreline is at a place along x; beside it, where the nearer end is.   @param x [m]   @return w [m]
inline double height_at(const hapbeam::Centreline<double>& rest, double x) noexcept {
  double left = 0, right = rest.length();
  // To the last bit of the length.
  for (int i = 0; i < 60; ++i) {
    const double middle = (left + right) / 2;
    (middle + rest.at(middle).u < x ? left : right) = middle;
  }
  return rest.at(right).w;
}

}  // namespace phantom
