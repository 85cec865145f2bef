// A tick of the loop as a whole: no heap, no lock, no exception, whatever is asked of it.
#include <limits>
#include <mutex>
#include <realtime/heap_watch.hpp>
#include <realtime/lock_watch.hpp>
#include <shared_mutex>
#include <thread>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/haptics/device/virtual_phantom.hpp>
#include <hapbeam/haptics/servo/servo_loop.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

ServoOptions above_mid_span() {
  ServoOptions options;
  options.placement = Placement::in_plane({thesis_length / 2, thesis_length / 200 + 5e-3});
  options.dissipate = true;
  return options;
}

template <typename Model, typename Coupling>
constexpr bool ticks_noexcept = noexcept(std::declval<Servo<Model, Coupling>&>().tick(
    std::declval<const DeviceState&>())) && noexcept(std::declval<Servo<Model, Coupling>&>().picture());
static_assert(ticks_noexcept<FemModel<>, VirtualCoupling> && ticks_noexcept<FemModel<>, Direct> &&
              ticks_noexcept<FemModel<VonKarman<>, float>, VirtualCoupling>);

}  // namespace

TEST_CASE("lock watch: each kind of lock is counted, on this thread alone") {
  std::mutex mutex;
  std::shared_mutex shared;
  CHECK(locks_taken([&] { std::lock_guard<std::mutex> lock(mutex); }) == 1);
  CHECK(locks_taken([&] { std::unique_lock<std::mutex> lock(mutex, std::try_to_lock); }) == 1);
  CHECK(locks_taken([&] { std::shared_lock<std::shared_mutex> lock(shared); }) == 1);
  CHECK(locks_taken([&] { std::unique_lock<std::shared_mutex> lock(shared); }) == 1);
  CHECK(locks_taken([] {}) == 0);
  long others = 0;
  std::thread other([&] { others = locks_taken([] {}); });
  other.join();
  CHECK(others == 0);
}

TEMPLATE_TEST_CASE("Servo: a script from air to beam and off, with a graphics that looks: no heap, no lock",
                   "", VirtualCoupling, Direct) {
  using Model = FemModel<>;
  Model model(thesis_beam(Support::pinned, Support::pinned), 16);
  VirtualPhantom<> phantom(HandPath({0, 0.02}).press(0.03, 0.4).slide(0.1, 0.5).release(0.03, 0.3));
  ServoLoop<VirtualPhantom<>, Model, TestType> loop(phantom, model, above_mid_span());
  const auto run = [&] {
    for (int k = 0; k < 130; ++k) {
      phantom.run(loop.servo(), 0.01);
      (void)loop.picture();
    }
  };
  long locks = -1;
  CHECK(heap_use([&] { locks = locks_taken(run); }) == HeapUse{});
  CHECK(locks == 0);
  CHECK(loop.picture().record.contact_ticks > 300);  // directly, it bounces
}

TEST_CASE("Servo: failures, resets and states that no device should give: no heap, no lock") {
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                        1e300};
  NewtonRaphson short_of_time;
  short_of_time.max_solves = 3;
  FemModel<> model(thesis_beam(Support::pinned, Support::pinned), 16, short_of_time);
  VirtualPhantom<> phantom(HandPath({0, 0}));
  Servo<FemModel<>> servo(model, phantom.info(), above_mid_span());
  Random random(1);
  int not_finite = 0;
  const auto run = [&] {
    for (int tick = 0; tick < 5000; ++tick) {
      DeviceState state{Eigen::Vector3d(random(0.5), random(0.02), 0), Eigen::Vector3d::Constant(random(1)),
                        1e-3 * tick};
      if (random(0, 1) < 0.1) state.position[random.integer(0, 2)] = bad[random.integer(0, 2)];
      if (random(0, 1) < 0.1) state.time = bad[random.integer(0, 2)];
      state.reset = random(0, 1) < 0.05;
      not_finite += !servo.tick(state).allFinite();
    }
    servo.reset();
  };
  long locks = -1;
  CHECK(heap_use([&] { locks = locks_taken(run); }) == HeapUse{});
  CHECK(locks == 0);
  CHECK(not_finite == 0);
}
