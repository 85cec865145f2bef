// Two crossed cantilevers, as in tests/data/rods_in_contact.csv: a hand leads the clamp of the one that lies on top.
#pragma once

#include <cmath>

#include "rod/rods.hpp"
#include "support/pi.hpp"
#include <hapbeam/world/world.hpp>

namespace hapbeam::testing {

inline constexpr double crossed_reach = 0.00175;

/// A hand: where it has the clamp of the rod on top, against where the rods just touch, and by how much it tilts that [m], [rad].
struct Crossing {
  double angle = pi / 2;
  Point off{0, 0, 0};
  double tilt = 0;

  Point way() const { return {std::cos(angle), std::sin(angle), 0}; }
  RodPose pose() const {
    const Point up(0, 0, 1), u = way();
    return {Point(0.18, 0, crossed_reach) - 0.15 * u + off, std::cos(tilt) * u + std::sin(tilt) * up,
            std::cos(tilt) * up - std::sin(tilt) * u};
  }
};

/// @param end  of the lower rod, which is clamped at its other one
template <class Element>
World<Element> crossed_rods(const Crossing& at, int elements, const RodSupport& end = RodSupport::free) {
  Rod top(0.2, RodSection::circle(0.002), spring_steel, RodSupport::clamped, RodSupport::free);
  const Rod wire(0.25, RodSection::circle(0.0015), spring_steel, RodSupport::clamped, end);
  top.place_left(at.pose());
  return World<Element>({{top, elements}, {wire, elements}});
}

template <class Element>
Status lead(World<Element>& world, const Crossing& at) {
  const Status held = world.hold(0, RodSide::left, at.pose());
  return held == Status::ok ? world.tick() : held;
}
/// In straight steps.
template <class Element>
Status lead(World<Element>& world, const Crossing& from, const Crossing& to, int steps) {
  Status worst = Status::ok;
  for (int k = 1; k <= steps; ++k) {
    const double t = double(k) / steps;
    const Status status =
        lead(world, {from.angle, from.off + t * (to.off - from.off), from.tilt + t * (to.tilt - from.tilt)});
    if (worse(status, worst)) worst = status;
  }
  return worst;
}

}  // namespace hapbeam::testing
