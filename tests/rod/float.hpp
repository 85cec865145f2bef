// How far the force of a rod in float is from that in double.
#pragma once

#include <algorithm>

#include "rod/rods.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/status.hpp"

namespace hapbeam::testing {

/// How far from double at most, of the force.   @param deepest [m]
template <class Element>
double error_in_float(const PressedRod& pressed, int elements, double deepest) {
  FemModel<Element> model(pressed.rod, elements);
  FemModel<Element, float> rounded(pressed.rod, elements);
  Random random(3);
  double worst = 0;
  for (int k = 1; k <= 60; ++k) {
    model.reset(), rounded.reset();
    // In float a tip of 3 % of the length is straight.
    const double s = pressed.s * random(0.6, 0.95),
                 d = pressed.normal.dot(model.shape().at(s).r) + deepest * k / 60 * (k % 2 ? 1 : -1);
    const auto expected = model.push({s, d, pressed.normal});
    const auto got = rounded.push({float(s), float(d), pressed.normal.cast<float>()});
    if (expected.status != Status::ok) continue;
    INFO("s " << s << " m, d " << d << " m");
    CHECK(got.status == Status::ok);
    worst = std::max(worst, std::abs(double(got.force) / expected.force - 1));
  }
  return worst;
}

}  // namespace hapbeam::testing
