// A change of body while the one that is felt lets go: the next one must not be pressed from where the hand was.
//
// A hand presses a ruler straight down and stops 1 mm below where it slips off.  The body changes to one of moderate rotation, off
// which nothing slips.  Where the first is felt until it has slipped off, the beam has sprung back and nothing is felt from then on;
// where the next one is felt before that, it is the same touch.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "phantom/body.hpp"
#include "phantom/relay.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>

namespace {

using phantom::Body;

constexpr double speed = 0.25, from = 0.02;  // [m/s, m] device axes
constexpr int end = 1200;                    // ticks

std::unique_ptr<Body> ruler(const char* element, const hapbeam::DeviceInfo& device) {
  return phantom::make_body(phantom::parse({"--scene", "ruler", "--element", element}), nullptr, device);
}

struct Stroke {
  int last_pressed = 0, touches = 0, felt_when_free = 0;  // ticks
};

/// @param change  in this tick; negative: never   @param stop [m]
Stroke press(const hapbeam::DeviceInfo& device, int change, double stop) {
  const auto first = ruler("corotational", device), next = ruler("stability-functions", device);
  phantom::Tape tape;
  phantom::Relay relay(*first, device, tape, nullptr);
  Stroke stroke;
  bool pressed = false;
  for (int tick = 0; tick < end; ++tick) {
    hapbeam::DeviceState state;
    state.time = tick * device.period;
    state.position = {0, std::max(stop, from - speed * state.time), 0};
    state.velocity = {0, state.position.y() > stop ? -speed : 0, 0};
    state.reset = tick == 0;
    if (tick == change) relay.change(*next, {0, from, 0});
    const Eigen::Vector3d force = relay(state);
    const bool now = relay.newest().record.pressing;
    stroke.touches += now && !pressed;
    if (now) stroke.last_pressed = tick;
    stroke.felt_when_free += !now && force.norm() > 0 && tick > stroke.last_pressed + 10;
    pressed = now;
    tape.take([](const phantom::Tick&) {});
  }
  return stroke;
}

}  // namespace

int main() {
  const hapbeam::VirtualPhantom<> arm(hapbeam::HandPath({0, from}));
  const Stroke alone = press(arm.info(), -1, -0.35);
  std::printf("alone: %d touches, the last tick of it is %d\n", alone.touches, alone.last_pressed);
  int failures = alone.touches != 1;
  const double stop = from - speed * alone.last_pressed * arm.info().period - 0.001;
  for (int before = 20; before <= 380; before += 40) {
    const Stroke changed = press(arm.info(), alone.last_pressed - before, stop);
    std::printf("changed %3d ticks before: %d touches, until %d, %d ticks felt nothing's force\n", before,
                changed.touches, changed.last_pressed, changed.felt_when_free);
    const bool slips_off_first = before < 1000 * phantom::Relay::approach;
    failures += changed.touches != 1 || changed.felt_when_free != 0 ||
                (slips_off_first && changed.last_pressed != alone.last_pressed);
  }
  return failures == 0 ? 0 : 1;
}
