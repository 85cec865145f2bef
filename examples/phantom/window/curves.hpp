// What each kinematics makes of the same beam: force against depth at one place, computed offline.
#pragma once

#include <vector>

#include "../body.hpp"

namespace phantom {

struct Curve {
  const char* name;
  std::vector<float> depth, force;  ///< [m] down from rest, [N] up on the hand
};

/// Where and how far a beam is pressed.
struct PressLine {
  int elements;
  double place;           ///< [m] along it
  Eigen::Vector3d along;  ///< unit, of a rod in space; a beam is pressed straight down
  double depth;           ///< [m]
};

/// Of a beam linear, von Karman and corotational; of a rod in space what it would be if it stayed as stiff as at first, and each element.
/// One that cannot answer ends where it could.
std::vector<Curve> force_curves(const Slender& slender, const PressLine& line);

// Of the models alone, in the units that compile them.
std::vector<Curve> curves_in_plane(const hapbeam::Beam& beam, const PressLine& line);
std::vector<Curve> curves_in_space(const hapbeam::Rod& rod, const PressLine& line);

}  // namespace phantom
