// A half plane that answers like Touch, with a force α y^q to a penetration y: beams soft and hard, in one line.
#pragma once

#include <cmath>

#include <hapbeam/contact/touch.hpp>

namespace hapbeam::testing {

struct PowerWall {
  using Scalar = double;

  double strength;                  // α [N/m^q]
  double exponent = 1;              // q
  Vector2<double> normal = {0, 1};  // unit, out of the wall through the origin
  Status fail_with = Status::ok;    // what a touch answers from now on
  int ticks = 0;                    // how often it was asked
  Vector2<double> last = {0, 0};    // from where

  double force(double y) const { return y > 0 ? strength * std::pow(y, exponent) : 0; }

  TouchResult<double> tick(const Vector2<double>& position) noexcept {
    ++ticks;
    last = position;
    TouchResult<double> result;
    result.status = position.allFinite() ? fail_with : Status::invalid_request;
    const double y = -normal.dot(position);
    if (result.status != Status::ok || !(y > 0)) return result;
    result.pressing = true;
    result.contact.depth = y;
    result.contact.normal = normal;
    result.force = force(y) * normal;
    result.press = {0, -y};
    return result;
  }
  Contact<double> contact_at(const Vector2<double>& position) const noexcept {
    Contact<double> contact;
    contact.depth = -normal.dot(position);
    contact.touching = contact.depth > 0;
    contact.normal = normal;
    return contact;
  }
};

}  // namespace hapbeam::testing
