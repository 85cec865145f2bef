// What a rod in the hand meets: a vessel, and a ring where it touches.
#pragma once

#include <imgui.h>
#include <vector>

#include "camera.hpp"
#include <hapbeam/world/rigid_body.hpp>

namespace phantom {

/// As glass: what is in it is seen.
void draw_vessel(ImDrawList& list, const Camera& camera, const std::vector<hapbeam::RigidBody>& tubes);
/// @param contacts  [m]   @param unit  [pixel] height of a line of text
void draw_contacts(ImDrawList& list, const Camera& camera, const std::vector<Eigen::Vector3d>& contacts,
                   float unit);

}  // namespace phantom
