// A device of your own: a thread that reads where the hand is and sends the force (the contract: haptics/device/device.hpp).
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include <hapbeam/hapbeam.hpp>
#include <hapbeam/haptics/device/known_devices.hpp>

using namespace hapbeam;

struct MyDevice {
  DeviceInfo info() const { return known_device("omega.3"); }  // or figures of your own
  bool running() const noexcept { return run; }
  DeviceStatus status() const noexcept { return run ? DeviceStatus::running : DeviceStatus::stopped; }
  DeviceCounts counts() const noexcept { return {ticks, 0, 0}; }
  template <typename Servo>
  void start(Servo& servo) {
    run = true;
    thread = std::thread([this, &servo] {
      for (DeviceState state; run; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
        state.time = 1e-3 * static_cast<double>(ticks);  // [s]: a real one reads its clock
        state.reset = ticks++ == 0;
        state.position.y() = 0.01 * std::cos(3 * state.time);  // [m]: here the encoders are read
        state.sent = servo(state);
        state.cut = limit_force(state.sent, 12);  // finite, 12 N at most: here state.sent goes to the motors
      }
    });
  }
  void stop() noexcept {
    if (run.exchange(false)) thread.join();
  }
  std::atomic<bool> run{false};
  std::atomic<std::uint64_t> ticks{0};
  std::thread thread;
};

int main() {
  const Beam ruler(0.3, Section::rectangle(0.025, 0.001), Material{210e9}, Support::clamped, Support::free);
  FemModel<Corotational<>> model(ruler, 8);
  MyDevice device;
  const ServoOptions options{Placement::in_plane({0.25, 0.0055})};
  ServoLoop<MyDevice, FemModel<Corotational<>>> loop(device, model, options);
  loop.start();
  while (device.ticks < 1000) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  loop.stop();
  const ServoRecord& record = loop.picture().record;
  std::printf("%.2f N now, %s; %.2f N at most\n", record.force.y(), name(record.status), record.max_force);
}
