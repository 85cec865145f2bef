// A needle in your hand is pushed against a wire of your own: force and torque at the hand.
#include <cstdio>

#include <hapbeam/element/rod.hpp>
#include <hapbeam/hapbeam.hpp>
#include <hapbeam/haptics/held/grip.hpp>
#include <hapbeam/world/world_tool.hpp>

int main() {
  using namespace hapbeam;
  VirtualPhantomOptions six;
  six.gimbal.present = true;  // it reads how the hand turns, and renders a torque
  VirtualPhantom<> device(HandPath({0, 0}).press(0.03, 0.5).rest(0.3).turn({0, -0.3, 0}, 0.5).rest(0.2), six);
  const GripCoupling hand = GripCoupling::for_device(device.info());

  // The wire lies along x, held at both ends.  The needle crosses it 150 mm from the hand, 0.3 mm above.
  const RodMaterial steel = RodMaterial::isotropic(200e9, 0.3);
  const Rod wire(0.25, RodSection::circle(0.0015), steel, RodSupport::clamped, RodSupport::clamped);
  Rod needle(0.2, RodSection::circle(0.002), steel, hand.support(), RodSupport::free);
  needle.place_left({{0.12, 0.00205, 0.15}, {0, 0, -1}, {0, 1, 0}});
  using Tool = WorldTool<RoundRod>;
  World<RoundRod> world({{needle, 16}, {wire, 16}});
  Tool tool(world, 0);
  Grip<Tool> grip(tool, RodSide::left);
  Servo<Grip<Tool>> servo(grip, device.info());

  // In simulated time.  A loop of your own calls servo.tick(state); ServoLoop has a thread.
  for (int k = 1; k <= 1500; ++k) {
    device.step(servo);
    const ServoRecord& felt = servo.record();
    if (k % 100 == 0)
      std::printf("%4d ms  %6.3f N  %6.2f mN m about x, contacts: %d, %s\n", k, felt.force.y(),
                  1e3 * felt.torque.x(), world.contacts(), name(felt.model));
  }
  return servo.record().failed_ticks == 0 && world.contacts() == 1 ? 0 : 1;
}
