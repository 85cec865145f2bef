// Calls of the driver fail: one of them, or all of a device, with any code, on one device or beside another one. A call that fails
// reports an error and does nothing.
//
// Law: no device has a force three ticks after its loop has ended, whatever the other one does; none after stop().
#include <memory>
#include <vector>

#include "haptics/hdapi/hdapi_support.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

enum class Call {
  none,
  begin_frame,
  end_frame,
  make_current_device,
  get_current_device,
  enable,
  disable,
  get_doublev,
  set_doublev,
  check_calibration,
  update_calibration,
  schedule_synchronous,
  schedule_asynchronous,
  unschedule,
  start_scheduler,
  stop_scheduler,
  disable_device,
  any,  // of the device
};

constexpr unsigned codes[] = {HdCode::invalid_enum,
                              HdCode::invalid_value,
                              HdCode::invalid_operation,
                              0x103,
                              HdCode::bad_handle,
                              HdCode::warm_motors,
                              HdCode::exceeded_max_force,
                              HdCode::exceeded_max_force_impulse,
                              HdCode::exceeded_max_velocity,
                              HdCode::force_error,
                              HdCode::device_fault,
                              HdCode::already_initiated,
                              HdCode::comm_error,
                              HdCode::comm_config_error,
                              HdCode::timer_error,
                              HdCode::illegal_begin,
                              HdCode::illegal_end,
                              HdCode::frame_error,
                              HdCode::invalid_priority,
                              HdCode::scheduler_full,
                              0x999};

/// What fails.
struct Failure {
  Call call = Call::none;
  unsigned code = 0;
  HdWorld::Device* device = nullptr;
  int times = 0;                              // more
  std::chrono::nanoseconds until = for_ever;  // of the world's time
  static constexpr auto for_ever = std::chrono::nanoseconds::max();
};

/// The emulated driver, one call of which fails.
struct FailingHd : EmulatedHd {
  static inline Failure failure;

  static bool fails(Call call, unsigned handle) noexcept {
    if (failure.call != call && failure.call != Call::any) return false;
    if (failure.times == 0 || handle != failure.device->handle) return false;
    if (HdWorld::here().now() > failure.until) return false;
    --failure.times;
    HdWorld::here().raise(failure.code, failure.device);
    return true;
  }
  static bool fails_now(Call call) noexcept { return fails(call, EmulatedHd::get_current_device()); }
  static bool fails_for_all(Call call) noexcept {
    return failure.call == call && fails(call, failure.device->handle);
  }

  static void begin_frame(unsigned device) noexcept {
    if (!fails(Call::begin_frame, device)) EmulatedHd::begin_frame(device);
  }
  static void end_frame(unsigned device) noexcept {
    if (!fails(Call::end_frame, device)) EmulatedHd::end_frame(device);
  }
  static void make_current_device(unsigned device) noexcept {
    if (!fails(Call::make_current_device, device)) EmulatedHd::make_current_device(device);
  }
  static unsigned get_current_device() noexcept {
    return fails_now(Call::get_current_device) ? invalid_handle : EmulatedHd::get_current_device();
  }
  static void enable(unsigned capability) noexcept {
    if (!fails_now(Call::enable)) EmulatedHd::enable(capability);
  }
  static void disable(unsigned capability) noexcept {
    if (!fails_now(Call::disable)) EmulatedHd::disable(capability);
  }
  static void get_doublev(unsigned name, double* values) noexcept {
    if (!fails_now(Call::get_doublev)) EmulatedHd::get_doublev(name, values);
  }
  static void set_doublev(unsigned name, const double* values) noexcept {
    if (!fails_now(Call::set_doublev)) EmulatedHd::set_doublev(name, values);
  }
  static unsigned check_calibration() noexcept {
    return fails_now(Call::check_calibration) ? 0 : EmulatedHd::check_calibration();
  }
  static void update_calibration(unsigned style) noexcept {
    if (!fails_now(Call::update_calibration)) EmulatedHd::update_calibration(style);
  }
  static void schedule_synchronous(Callback f, void* data, unsigned short priority) noexcept {
    if (!fails_for_all(Call::schedule_synchronous)) EmulatedHd::schedule_synchronous(f, data, priority);
  }
  static unsigned long schedule_asynchronous(Callback f, void* data, unsigned short priority) noexcept {
    return fails_for_all(Call::schedule_asynchronous) ? invalid_handle
                                                      : EmulatedHd::schedule_asynchronous(f, data, priority);
  }
  static void unschedule(unsigned long handle) noexcept {
    if (!fails_for_all(Call::unschedule)) EmulatedHd::unschedule(handle);
  }
  static void start_scheduler() noexcept {
    if (!fails_for_all(Call::start_scheduler)) EmulatedHd::start_scheduler();
  }
  static void stop_scheduler() noexcept {
    if (!fails_for_all(Call::stop_scheduler)) EmulatedHd::stop_scheduler();
  }
  static void disable_device(unsigned device) noexcept {
    if (!fails(Call::disable_device, device)) EmulatedHd::disable_device(device);
  }
};
static_assert(is_hd_api<FailingHd>);

/// One or two devices whose hands stand still and whose servos push by 1 N.
struct Pushed {
  HdWorld world;
  std::vector<HdWorld::Device*> devices;
  std::vector<std::unique_ptr<Hdapi<FailingHd, HdWorldClock>>> on;
  SteadyPush push[2];

  explicit Pushed(int count, unsigned style = HdCode::calibration_encoder_reset) {
    FailingHd::failure = {};
    for (const char* name : {"one", "two"}) {
      if (static_cast<int>(devices.size()) == count) break;
      devices.push_back(&world.plug(name, HandPath({0, 0}).rest(1000)));
      devices.back()->styles = style;
      HdapiOptions options = at_once();
      options.device = name;
      on.push_back(std::make_unique<Hdapi<FailingHd, HdWorldClock>>(options));
    }
  }
  ~Pushed() { FailingHd::failure = {}; }
  void start(std::size_t i) { on[i]->start(push[i]); }
  void start_all() {
    for (std::size_t i = 0; i < on.size(); ++i) start(i);
    world.run(4);
    for (const HdWorld::Device* device : devices) REQUIRE(world.motors(*device).norm() == 1);
  }
  /// One call fails so many times, all calls of the device in two ticks.
  void fail(std::size_t hit, Failure failure) {
    failure.device = devices[hit];
    if (failure.call == Call::any) failure.until = world.now() + std::chrono::milliseconds(2);
    FailingHd::failure = failure;
  }
  double force(std::size_t i) { return world.motors(*devices[i]).norm(); }
  bool runs(std::size_t i) const { return on[i] && on[i]->running(); }

  /// Ticks in which a device had a force though its loop had ended three ticks before.
  int held(int ticks) {
    int count = 0;
    for (std::size_t since[2] = {}; ticks > 0; --ticks) {
      world.tick();
      for (std::size_t i = 0; i < on.size(); ++i) {
        since[i] = runs(i) ? 0 : since[i] + 1;
        count += since[i] > 3 && force(i) > 0;
      }
    }
    return count;
  }
};

/// Calls act(devices, hit, failure without its device) for all of them.
template <typename Act>
void sweep(Act act) {
  for (int call = 1; call <= static_cast<int>(Call::any); ++call)
    for (const unsigned code : codes)
      for (const int devices : {1, 2})
        for (int hit = 0; hit < devices; ++hit)
          for (const int times : {1, 2, 1 << 20}) {
            CAPTURE(call, code, devices, hit, times);
            act(devices, static_cast<std::size_t>(hit),
                Failure{static_cast<Call>(call), code, nullptr, times});
          }
}

}  // namespace

TEST_CASE("whatever call fails in a loop, its motors have no force three ticks after it ended", "[hdapi]") {
  int ended = 0;
  sweep([&](int count, std::size_t hit, Failure failure) {
    Pushed p(count);
    p.start_all();
    p.fail(hit, failure);
    REQUIRE(p.held(12) == 0);
    ended += !p.runs(hit);
    for (std::size_t i = 0; i < p.on.size(); ++i) {
      p.on[i]->stop();
      REQUIRE(p.force(i) == 0);
    }
  });
  CHECK(ended > 800);
}

TEST_CASE("whatever call fails when a loop ends, its motors have no force three ticks later", "[hdapi]") {
  sweep([&](int count, std::size_t hit, Failure failure) {
    Pushed p(count);
    p.start_all();
    p.world.raise(HdCode::device_fault, p.devices[hit]);
    p.fail(hit, failure);
    REQUIRE(p.held(12) == 0);
    REQUIRE_FALSE(p.runs(hit));
    REQUIRE(p.force(hit) == 0);
  });
}

TEST_CASE("whatever call fails in stop(), the force is zero after it", "[hdapi]") {
  sweep([&](int count, std::size_t hit, Failure failure) {
    Pushed p(count);
    p.start_all();
    p.fail(hit, failure);
    p.on[hit]->stop();
    REQUIRE_FALSE(p.runs(hit));
    REQUIRE(p.force(hit) == 0);
    REQUIRE(p.held(12) == 0);
    for (auto& device : p.on) device->stop();
    for (std::size_t i = 0; i < p.on.size(); ++i) REQUIRE(p.force(i) == 0);
  });
}

TEST_CASE(
    "whatever call fails when a device goes away, it has no force, and the other one none after its loop",
    "[hdapi]") {
  sweep([&](int count, std::size_t hit, Failure failure) {
    const bool lost = failure.code % 2 == 0;
    Pushed p(count);
    p.start_all();
    p.fail(hit, failure);
    if (lost) p.world.raise(HdCode::comm_error, p.devices[hit]), p.world.run(1);
    p.on[hit].reset();
    REQUIRE(p.force(hit) == 0);
    REQUIRE(p.held(12) == 0);
    REQUIRE(p.force(hit) == 0);
  });
}

TEST_CASE("whatever call fails in start(), it throws or runs, and nobody else's motors are switched",
          "[hdapi]") {
  sweep([&](int count, std::size_t hit, Failure failure) {
    const bool beside = failure.code % 2 == 0;
    Pushed p(count, failure.call == Call::update_calibration ? HdCode::calibration_auto
                                                             : HdCode::calibration_encoder_reset);
    const std::size_t other = 1 - hit;
    if (beside && count == 2) p.start(other), p.world.run(4);
    p.fail(hit, failure);
    bool thrown = false;
    try {
      p.start(hit);
    } catch (const DeviceError&) {
      thrown = true;
    }
    REQUIRE((!thrown || !p.runs(hit)));
    if (thrown) REQUIRE(p.force(hit) == 0);
    if (count == 2 && !beside) REQUIRE_FALSE(p.devices[other]->enabled);
    REQUIRE(p.held(12) == 0);
    // A warm motor and a force are a tick's affair: no start of a scheduler reports them.
    const HdErrorClass kind = classify<FailingHd>(failure.code);
    if (p.runs(hit) && kind != HdErrorClass::warm && kind != HdErrorClass::force)
      REQUIRE(p.push[hit].calls > 0);
    p.on[hit]->stop();
    REQUIRE(p.force(hit) == 0);
    REQUIRE(p.held(5) == 0);
  });
}

TEST_CASE("what calibrates one device never calibrates another", "[hdapi]") {
  for (const unsigned code : codes) {
    Pushed p(2);
    p.start(1);
    p.world.run(4);
    p.devices[0]->calibration = HdCode::calibration_needs_update;
    FailingHd::failure = {Call::make_current_device, code, p.devices[0], 1};
    CHECK_THROWS_AS(p.on[0]->calibrate(), DeviceError);
    CHECK(p.devices[1]->resets == 0);
  }
}

TEST_CASE("a device that no call reached while its loop ended is switched off when it goes away", "[hdapi]") {
  Pushed p(2);
  p.start_all();
  p.fail(0, {Call::any, HdCode::comm_error, nullptr, 1 << 20});
  FailingHd::failure.until = p.world.now() + std::chrono::milliseconds(8);
  p.world.run(10);
  CHECK(p.force(0) == 1);  // nothing could be done
  CHECK(p.on[0]->status() == DeviceStatus::communication_lost);
  p.on[0].reset();
  CHECK(p.force(0) == 0);
  CHECK_FALSE(p.devices[0]->enabled);
  CHECK(p.runs(1));
}
