// The simulated device in real time, on a thread of its own.
#include <chrono>
#include <thread>

#include "support/catch.hpp"
#include <hapbeam/haptics/device/virtual_phantom.hpp>

using namespace hapbeam;

namespace {

using Clock = std::chrono::steady_clock;

struct Timed {
  explicit Timed(const VirtualPhantom<>& p) noexcept : phantom(&p) {}
  const VirtualPhantom<>* phantom;
  Clock::time_point first{}, last{};
  std::uint64_t calls = 0;
  bool in_time_with_counts = true;
  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    last = Clock::now();
    if (calls++ == 0) first = last;
    // Simulated time is that of the deadlines, met and missed.
    const DeviceCounts counts = phantom->counts();
    in_time_with_counts &=
        static_cast<std::uint64_t>(std::llround(state.time / 1e-3)) == counts.ticks + counts.missed_ticks;
    return {0, std::max(0.0, -2000 * state.position.y()), 0};
  }
};

const HandPath press = HandPath({0, 0.01}).press(0.02, 0.1).release(0.02, 0.1);

}  // namespace

TEST_CASE("ticks and missed ticks together are the periods that passed", "[phantom][thread]") {
  VirtualPhantom<> phantom(press);
  Timed servo(phantom);
  CHECK_FALSE(phantom.running());
  phantom.start(servo);
  CHECK(phantom.running());
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(phantom.counts().ticks > 0);
  phantom.stop();
  CHECK_FALSE(phantom.running());

  const DeviceCounts counts = phantom.counts();
  CHECK(counts.ticks == servo.calls);
  CHECK(counts.force_cut_ticks == 0);
  CHECK(servo.in_time_with_counts);
  const double periods = std::chrono::duration<double>(servo.last - servo.first).count() / 1e-3;
  // The first and the last tick may each be late; how much is the machine's affair.
  CHECK(std::abs(static_cast<double>(counts.ticks + counts.missed_ticks) - periods) <= 50);

  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  CHECK(servo.calls == counts.ticks);
}

TEST_CASE("a servo that takes several periods has missed them", "[phantom][thread]") {
  VirtualPhantom<> phantom(press);
  struct {
    int calls = 0;
    Eigen::Vector3d operator()(const DeviceState&) noexcept {
      if (++calls == 3) std::this_thread::sleep_for(std::chrono::microseconds(5500));
      return Eigen::Vector3d::Zero();
    }
  } servo;
  phantom.start(servo);
  while (phantom.counts().ticks < 4) std::this_thread::sleep_for(std::chrono::microseconds(200));
  phantom.stop();
  // 5.5 ms after its own deadline the next tick finds its deadline 4.5 ms ago: four whole periods.
  CHECK(phantom.counts().missed_ticks >= 4);
}

TEST_CASE("it can be started and stopped again and again, each time from the beginning",
          "[phantom][thread]") {
  VirtualPhantom<> phantom(press);
  for (int round = 0; round < 20; ++round) {
    Timed servo(phantom);
    phantom.start(servo);
    CHECK_THROWS_AS(phantom.start(servo), std::logic_error);
    while (phantom.counts().ticks < 2) std::this_thread::sleep_for(std::chrono::microseconds(200));
    phantom.stop();
    phantom.stop();
    CHECK(servo.calls == phantom.counts().ticks);
    CHECK(servo.in_time_with_counts);
  }
  Timed servo(phantom);
  phantom.start(servo);  // and the destructor stops it
}
