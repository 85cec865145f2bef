// The avatar: the disc that stands for the hand in the plane of the beam.
//
// A plain value.  No allocation, noexcept.
#pragma once

#include <hapbeam/centreline.hpp>

namespace hapbeam {

/// A disc in the plane (x along the beam, w across).
template <typename Scalar>
struct Avatar {
  Vector2<Scalar> position;  ///< [m] centre
  Scalar radius;             ///< [m] >= 0
};

}  // namespace hapbeam
