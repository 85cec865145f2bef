// The wrenches that stylus.c and stylus.py must feel, from the headers.
#include <cmath>
#include <cstdio>

#include <hapbeam/hapbeam.hpp>
#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/hosts/placed_touch.hpp>

using namespace hapbeam;

template <class Element>
void feel() {
  // As hapbeam_wire() has it: the sizes of a circle, without RodSection's own round-off.
  const double d = 0.002, area = 3.141592653589793 * d * d / 4, inertia = area * d * d / 16;
  const Rod wire(0.2, {200e9 * area, 200e9 * inertia, 200e9 * inertia, 2 * 77e9 * inertia}, d,
                 RodSupport::clamped, RodSupport::free);
  FemModel<Element> model(wire, 8);
  PlacedTouch<FemModel<Element>> rod(model, 0.003, x_toward_user({0.15, 0}), {0.2, 0.12});
  HandPose hand;
  hand.turn << 0, -std::sin(0.1), std::cos(0.1), 0, std::cos(0.1), std::sin(0.1), -1, 0, 0;
  Wrench w;
  for (int i = 0; i < 400; ++i) {
    hand.place = {0.03, 1e-5 * i, 0.005 - 1e-5 * i};
    w = rod.tick(hand);
  }
  std::printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", w.force[0], w.force[1], w.force[2], w.torque[0],
              w.torque[1], w.torque[2]);
}

int main() {
  feel<RoundRod>();
  feel<TwistedRod>();
}
