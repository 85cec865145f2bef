#include <memory>
#include <utility>
#include <variant>

#include "couple.hpp"
#include "hands.hpp"
#include "probe.hpp"

namespace phantom {

std::unique_ptr<Body> couple_needle(Parts parts) {
  const Options& o = parts.options;
  const auto& rod = std::get<hapbeam::Rod>(parts.slender);
  // A device of three axes does not turn it: the spring against that is as good as a clamp.
  constexpr double turning = 100;  // [N·m/rad]
  const hapbeam::GripCoupling coupling =
      hapbeam::GripCoupling({o.stiffness, o.damping}, {turning, 0}, parts.device.period).in_scene(o.scale);
  const Eigen::Vector3d hand = placement({o.place, 0, 0}, o).scene_position({0, height_above, 0});
  Probe probe(rod, needle(o, hand, coupling.support()), o.elements, coupling);
  return couple<OneHand>(std::move(probe), std::move(parts));
}

}  // namespace phantom
