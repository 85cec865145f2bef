#include "draw_vessel.hpp"

#include <array>
#include <optional>

#include "colours.hpp"

namespace phantom {

void draw_vessel(ImDrawList& list, const Camera& camera, const std::vector<hapbeam::RigidBody>& tubes) {
  constexpr int pieces = 32;
  for (const hapbeam::RigidBody& tube : tubes) {
    std::optional<std::array<ImVec2, 2>> last;
    for (int k = 0; k <= pieces; ++k) {
      const auto on = tube.axis().at(tube.axis().length() * k / pieces);
      const Eigen::Vector3d side =
          tube.radius() * hapbeam::detail::cross3<double>(on.tangent, camera.sight(on.r)).normalized();
      const std::array<ImVec2, 2> ends{camera(on.r - side), camera(on.r + side)};
      if (last) {
        const ImVec2 corners[] = {(*last)[0], ends[0], ends[1], (*last)[1]};
        list.AddConvexPolyFilled(corners, 4, colour::with_alpha(colour::sky, 50));
        list.AddLine(corners[0], corners[1], colour::faint, 1);
        list.AddLine(corners[2], corners[3], colour::faint, 1);
      }
      last = ends;
    }
  }
}

void draw_contacts(ImDrawList& list, const Camera& camera, const std::vector<Eigen::Vector3d>& contacts,
                   float unit) {
  for (const Eigen::Vector3d& contact : contacts)
    list.AddCircle(camera(contact), 0.5f * unit, colour::vermilion, 0, unit / 7);
}

}  // namespace phantom
