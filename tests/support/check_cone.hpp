// A rough finger, and what it must say whatever the hands do.
#pragma once

#include <cmath>

#include "catch.hpp"
#include <hapbeam/contact/touch_several.hpp>

namespace hapbeam::testing {

/// Of 10 mm, above the beam.
inline RoundAvatar finger(const Friction& friction) { return {0.005, 1, friction}; }

/// A place's force pushes, and its friction is within the cone and across the normal.
template <class Place>
void check_cone(const Place& place, const Friction& friction) {
  const double normal = (place.force - place.friction).norm();
  REQUIRE(place.force.allFinite());
  REQUIRE((place.force - place.friction).dot(place.normal) >= 0);
  REQUIRE(place.friction.norm() <= friction.sticking * normal * (1 + 1e-14));
  // In a bend as sharp as the circle a plane stands for it, whose place is found to a hundredth of the reach.
  if (is_answer(place.status)) REQUIRE(std::abs(place.friction.dot(place.normal)) <= 1e-2 * normal);
  if (place.sliding) REQUIRE(place.friction.norm() <= friction.sliding * normal * (1 + 1e-14));
  if (!place.touching) REQUIRE((place.force.isZero(0) && place.dissipated == 0));
}

}  // namespace hapbeam::testing
