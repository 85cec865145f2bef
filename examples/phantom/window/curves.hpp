// What each kinematics makes of the same beam: force against depth at one place, computed offline.
#pragma once

#include <vector>

#include <hapbeam/beam.hpp>

namespace phantom {

struct Curve {
  const char* name;
  std::vector<float> depth, force;  ///< [m] down from rest, [N] up on the hand
};

/// Linear, von Karman and corotational, pressed straight down; one that cannot answer ends where it could.
/// @param place  [m] along the beam   @param depth  [m] how far
std::vector<Curve> force_curves(const hapbeam::Beam& beam, int elements, double place, double depth);

}  // namespace phantom
