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
  Clock::time_point before = Clock::now(), first{}, last{};
  std::uint64_t calls = 0;
  bool in_time_with_counts = true, never_early = true, none_lost = true;
  Eigen::Vector3d operator()(const DeviceState& state) noexcept {
    const auto now = Clock::now();
    if (calls++ == 0) first = last = now;
    // Simulated time is that of the deadlines, met and missed.
    const DeviceCounts counts = phantom->counts();
    const std::uint64_t periods = counts.ticks + counts.missed_ticks;
    in_time_with_counts &= static_cast<std::uint64_t>(std::llround(state.time / 1e-3)) == periods;
    // They count from an instant between `before` and `first`. A tick comes after its deadline, and the last tick was
    // over less than a period after it, or the deadline would have been missed.
    const auto deadline = std::chrono::milliseconds(periods);
    never_early &= now - before >= deadline;
    none_lost &= last - first <= deadline + std::chrono::milliseconds(1);
    last = Clock::now();
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
  while (phantom.counts().ticks < 100) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  phantom.stop();
  CHECK_FALSE(phantom.running());

  const DeviceCounts counts = phantom.counts();
  CHECK(counts.ticks == servo.calls);
  CHECK(counts.force_cut_ticks == 0);
  CHECK(servo.in_time_with_counts);
  CHECK(servo.never_early);
  CHECK(servo.none_lost);

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
