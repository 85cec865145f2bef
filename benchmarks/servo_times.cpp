// How long a tick takes and how regularly ticks come, in real time: the simulated Phantom on its own thread at 1 kHz, a
// hand that presses and slides, 16 finite elements, the default coupling, and somebody who looks 60 times a second.
//
//   servo_times [SECONDS]     600 by default
//
// Compute time is the library's; the period's tail is the machine's.  Real-time priority and locked memory are asked
// for, and what the system said is printed.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/real_time.hpp>
#include <hapbeam/haptics/servo/servo.hpp>

using namespace hapbeam;

namespace {

/// Presses, slides to and fro and lets go, every eight seconds.
struct Script {
  HandPath path =
      HandPath({0, 0.02}).press(0.03, 1).slide(0.1, 1).slide(-0.2, 2).slide(0.1, 1).release(0.03, 1).rest(2);

  HandTarget operator()(double time) const noexcept { return path(std::fmod(time, path.duration())); }
};

using Device = VirtualPhantom<Script>;

/// The servo, on a thread that asked for priority in its first tick.
struct Prior {
  Servo<FemModel<>>& servo;
  RealTime answer = RealTime::not_supported;
  bool asked = false;

  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    if (!asked) answer = set_real_time_priority(80), asked = true;
    return servo.tick(state);
  }
};

void print(const char* what, const TimeSummary& t) {
  std::printf("%-8s p50 %8.2f us   p99 %8.2f us   p99.9 %8.2f us   max %9.2f us   of %llu\n", what,
              t.p50 * 1e6, t.p99 * 1e6, t.p999 * 1e6, t.max * 1e6, static_cast<unsigned long long>(t.count));
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 600;
  if (argc > 2 || !(seconds >= 1 && seconds <= 86400))
    return std::fputs("servo_times: SECONDS must be 1 to 86400\n", stderr), 2;
  FemModel<> model(benchmarks::thesis_beam(), 16);
  Device device(Script{});
  ServoOptions options;
  options.placement =
      Placement::in_plane({benchmarks::length / 2, benchmarks::side / 2 + options.avatar_radius});
  Servo<FemModel<>> loop(model, device.info(), options);
  Prior servo{loop};
  const RealTime memory = lock_memory();
  device.start(servo);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  double looked_at = 0;
  while (std::chrono::steady_clock::now() < end) {
    for (const auto& node : loop.picture().shape()) looked_at += node.w;
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  device.stop();
  std::printf("priority %s\nmemory   %s\n", message(servo.answer), message(memory));
  const ServoRecord& record = loop.picture().record;
  print("compute", loop.times().compute().summary());
  print("period", loop.times().period().summary());
  std::printf("missed   %llu deadlines, by the servo's clock; %llu by the device's\n",
              static_cast<unsigned long long>(loop.times().missed()),
              static_cast<unsigned long long>(device.counts().missed_ticks));
  std::printf("contact  in %llu of %llu ticks; energy generated %.2g J; worst status %s; mean w %.2g m\n",
              static_cast<unsigned long long>(record.contact_ticks),
              static_cast<unsigned long long>(record.ticks), record.energy_generated, name(record.worst),
              looked_at / static_cast<double>(record.ticks + 1));
  return 0;
}
