#include "draw_vessel.hpp"

#include "colours.hpp"

namespace phantom {

void draw_vessel(ImDrawList& list, const Camera& camera, const std::vector<hapbeam::RigidBody>& tubes) {
  for (const hapbeam::RigidBody& tube : tubes) {
    const Eigen::Vector3d along = tube.way().normalized(), ends[] = {tube.tip(), tube.tip() + tube.way()};
    const Eigen::Vector3d side =
        tube.radius() * hapbeam::detail::cross3<double>(along, camera.sight(ends[0])).normalized();
    const ImVec2 corners[] = {camera(ends[0] - side), camera(ends[1] - side), camera(ends[1] + side),
                              camera(ends[0] + side)};
    list.AddConvexPolyFilled(corners, 4, colour::with_alpha(colour::sky, 50));
    list.AddLine(corners[0], corners[1], colour::faint, 1);
    list.AddLine(corners[2], corners[3], colour::faint, 1);
  }
}

void draw_contacts(ImDrawList& list, const Camera& camera, const std::vector<Eigen::Vector3d>& contacts,
                   float unit) {
  for (const Eigen::Vector3d& contact : contacts)
    list.AddCircle(camera(contact), 0.5f * unit, colour::vermilion, 0, unit / 7);
}

}  // namespace phantom
