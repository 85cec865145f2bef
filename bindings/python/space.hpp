// SPDX-License-Identifier: MIT
// From the plane of a beam, whose third component is zero, to space and back.
#pragma once

#include "any_model.hpp"

namespace hapbeam::python {

inline Place spatial(const Vector2<double>& v) noexcept { return {v.x(), v.y(), 0}; }
inline Place spatial(const Place& v) noexcept { return v; }
inline Vector2<double> flat(const Place& v) noexcept { return {v.x(), v.y()}; }

inline TouchResult<double, 3> spatial(const TouchResult<double, 3>& felt) noexcept { return felt; }
inline TouchResult<double, 3> spatial(const TouchResult<double, 2>& felt) noexcept {
  TouchResult<double, 3> result;
  result.force = spatial(felt.force);
  result.status = felt.status;
  result.pressing = felt.pressing;
  result.sliding = felt.sliding;
  result.dissipated = felt.dissipated;
  result.friction = spatial(felt.friction);
  result.press = felt.press;
  const Contact<double>& contact = felt.contact;
  result.contact = {
      contact.touching, contact.past_end,      contact.side,           contact.segment,        contact.s,
      contact.depth,    spatial(contact.foot), spatial(contact.point), spatial(contact.normal)};
  return result;
}

inline TouchPlace<double, 3> spatial(const TouchPlace<double, 3>& place) noexcept { return place; }
inline TouchPlace<double, 3> spatial(const TouchPlace<double, 2>& place) noexcept {
  return {place.body,
          place.touching,
          place.status,
          place.s,
          place.depth,
          spatial(place.point),
          spatial(place.normal),
          spatial(place.force),
          spatial(place.friction),
          place.sliding,
          place.dissipated};
}

}  // namespace hapbeam::python
