// What each kinematics makes of the same beam: force against depth at one place, computed offline.
#pragma once

#include <vector>

#include "../body.hpp"

namespace phantom {

struct Curve {
  const char* name;
  std::vector<float> depth, force;  ///< [m] down from rest, [N] up on the hand
};

/// Of a beam linear, von Karman and corotational, pressed straight down; of a rod in space what it would be if it stayed as stiff
/// as at first, and each element, pressed along a direction.  One that cannot answer ends where it could.
/// @param place  [m] along the beam   @param along  unit   @param depth  [m] how far
std::vector<Curve> force_curves(const Slender& slender, int elements, double place,
                                const Eigen::Vector3d& along, double depth);

}  // namespace phantom
