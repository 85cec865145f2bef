#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "couple.hpp"
#include "hands.hpp"
#include "held_rod.hpp"
#ifdef HAPBEAM_EXAMPLES_WINDOW
#include "window/press_curve.hpp"
#endif
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/shapes.hpp>

namespace phantom {

std::unique_ptr<Body> couple_in_space(Parts parts) {
  if (parts.options.element == ElementChoice::round_rod)
    return couple_hands<hapbeam::RoundRod>(std::move(parts));
  return couple_hands<hapbeam::TwistedRod>(std::move(parts));
}

// In the unit of the rods: it shares what takes longest to compile.
std::unique_ptr<Body> couple_held(Parts parts) {
  const Options& o = parts.options;
  // A device of three axes does not turn it: the spring against that is as good as a clamp.
  constexpr double turning = 100;  // [N·m/rad]
  const hapbeam::GripCoupling coupling =
      hapbeam::GripCoupling({o.stiffness, o.damping}, {turning, 0}, parts.device.period).in_scene(o.scale);
  std::vector<hapbeam::WorldRod> rods;
  if (o.avatar == Avatar::needle) {
    const Eigen::Vector3d hand = placement({o.place, 0, 0}, o).scene_position({0, height_above, 0});
    rods = {{std::get<hapbeam::Rod>(parts.slender), o.elements, {}},
            {needle(o, hand, coupling.support()), o.elements, {}}};
  } else if (o.avatar == Avatar::knot) {
    constexpr double friction = 0.02;  // wet
    hapbeam::Rod cord = o.beam.make_rod(coupling.support());
    const auto points = hapbeam::overhand_knot(cord.length(), cord.thickness(), 0.065 * cord.length());
    cord.place_left({points.front(), {1, 0, 0}, {0, 1, 0}})
        .place_right({points.back(), {1, 0, 0}, {0, 1, 0}});
    rods = {{cord, o.elements, friction, points}};
  } else {
    rods = {{o.beam.make_rod(coupling.support()), o.elements, {}}};
  }
  return couple<OneHand>(std::make_unique<HeldRod>(rods, vessel(o), coupling), std::move(parts));
}

#ifdef HAPBEAM_EXAMPLES_WINDOW
std::vector<Curve> curves_in_space(const hapbeam::Rod& rod, const PressLine& line) {
  std::vector<Curve> curves;
  add_curve<Touchable<hapbeam::TwistedRod>>(curves, "twisted rod", rod, line);
  add_curve<Touchable<hapbeam::RoundRod>>(curves, "round rod", rod, line);
  return curves;
}
#endif

}  // namespace phantom
