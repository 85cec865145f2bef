// Two simulated Phantoms on one ruler: the left hand holds it up from below, and the right one presses its end down and lets go.
#include <cstdio>

#include <hapbeam/hapbeam.hpp>

int main() {
  using namespace hapbeam;
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{200e9}, Support::clamped, Support::free);
  using Model = FemModel<Several<Corotational<>, 2>>;  // two contacts
  Model model(ruler, 16);
  TwoHands hands(model);

  VirtualPhantom<> left_device(HandPath({0, 0.001}).rest(0.3).press(0.004, 0.3).rest(2)),
      right_device(HandPath({0, 0.001}).rest(0.3).press(0.031, 0.6).rest(0.3).release(0.037, 0.4));
  ServoOptions below, above;
  Eigen::Matrix3d upside_down = Eigen::Vector3d(1, -1, -1).asDiagonal();
  below.placement = Placement(upside_down, {0.12, -0.0055, 0});  // the devices' origins touch the ruler,
  above.placement = Placement::in_plane({0.27, 0.0055});         // with avatars of 5 mm radius
  Servo left(hands[0], left_device.info(), below), right(hands[1], right_device.info(), above);

  // In simulated time, in turns.  A loop of your own calls left.tick(state) and right.tick(state), in one thread.
  for (int k = 1; k <= 1800; ++k) {
    left_device.step(left), right_device.step(right);
    if (k % 100 != 0) continue;
    std::printf("%4d ms  left %6.2f N, %-9s right %6.2f N, %-9s end at %6.2f mm\n", k,
                left.record().force.y(), name(left.record().status), right.record().force.y(),
                name(right.record().status), 1e3 * model.shape().at(0.3).w);
  }
  const bool both = left.record().touches > 0 && right.record().touches > 0;
  return both && left.record().failed_ticks + right.record().failed_ticks == 0 ? 0 : 1;
}
