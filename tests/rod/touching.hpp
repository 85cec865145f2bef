// A hand with a sphere or a capsule on a rod, and what every tick of it has to keep.
#pragma once

#include <vector>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include <hapbeam/contact/touch.hpp>

namespace hapbeam::testing {

using Felt = TouchResult<double, 3>;

/// What a tick must say whatever the hand does.
inline void check_law(const Felt& r) {
  REQUIRE(r.force.allFinite());
  REQUIRE(r.force.dot(r.contact.normal) >= 0);  // a rod never pulls, and has no friction
  REQUIRE(detail::cross3<double>(r.force, r.contact.normal).norm() <= 1e-12 * r.force.norm());
  if (!r.pressing) REQUIRE(r.force.isZero(0));
}

/// How far the centreline lies within the avatar's reach [m].
template <class Model>
double penetration(const Model& model, const Shaft<double>& axis, double reach) {
  BoundingVolumes<double, 3> volumes(model.shape().segments());
  volumes.refit(model.shape());
  return reach - std::sqrt(volumes.nearest(model.shape(), axis).at.distance_squared);
}

/// Straight from one place to another.  @param visit  (place, Felt)
template <class Model, class Visit>
void move(Touch<Model>& touch, const Point& from, const Point& to, const Point& shaft, int ticks,
          Visit&& visit) {
  for (int k = 1; k <= ticks; ++k) {
    const Point now = from + (to - from) * (double(k) / ticks);
    visit(now, touch.tick(now, shaft));
  }
}
template <class Model>
Felt rest_at(Touch<Model>& touch, const Point& at, const Point& shaft) {
  Felt r;
  for (int k = 0; k < 10; ++k) r = touch.tick(at, shaft);
  return r;
}

/// 200 mm of 1 mm steel wire, clamped at the left.
inline Rod wire() {
  return {0.2, RodSection::circle(0.001), spring_steel, RodSupport::clamped, RodSupport::free};
}

}  // namespace hapbeam::testing
