// The whole loop with a simulated Phantom: a hand comes down onto a strip of acrylic glass, leans on it, slides along and lets go.
#include <cstdio>

#include <hapbeam/hapbeam.hpp>

int main() {
  using namespace hapbeam;
  const Beam strip(0.3, Section::rectangle(0.03, 0.003), Material{3e9}, Support::pinned, Support::roller);
  FemModel<> model(strip, 8);
  VirtualPhantom<> device(HandPath({0, 0.01}).press(0.02, 0.3).rest(0.4).slide(0.05, 0.5).release(0.02, 0.3));
  ServoOptions options;
  options.placement = Placement::in_plane({0.15, 0.0065});  // the device's origin touches mid-span
  ServoLoop loop(device, model, options);                   // coupled as the device can render it

  // In simulated time.  With a real device, or in real time, it is loop.start(), draw what you like, loop.stop().
  for (int k = 1; k <= 15; ++k) {
    device.run(loop.servo(), 0.1);
    const ServoRecord& now = loop.picture().record;
    std::printf("%4d ms  %6.3f N  press %6.2f mm at %5.1f mm  %s\n", 100 * k, now.force.y(),
                1e3 * now.press.d, 1e3 * now.press.s, name(now.status));
  }
  const ServoRecord& all = loop.picture().record;
  std::printf("%.2f N at most, %llu of %llu ticks without an answer\n", all.max_force,
              static_cast<unsigned long long>(all.failed_ticks), static_cast<unsigned long long>(all.ticks));
  return all.failed_ticks == 0 && all.touches > 0 ? 0 : 1;
}
