// The emulated HDAPI as an Api of Hdapi: the functions and constants of the vendor, played by HdWorld.
#pragma once

#include "hd_world.hpp"
#include <hapbeam/haptics/hdapi/hdapi.hpp>

namespace hapbeam::testing {

struct EmulatedHd : HdCode {
  using ErrorInfo = HdWorld::Error;
  using Callback = HdWorld::Callback;

  static unsigned init_device(const char* name) noexcept { return world().init_device(name); }
  static void disable_device(unsigned device) noexcept { world().disable_device(device); }
  static void make_current_device(unsigned device) noexcept { world().make_current_device(device); }
  static unsigned get_current_device() noexcept { return world().get_current_device(); }
  static void begin_frame(unsigned device) noexcept { world().begin_frame(device); }
  static void end_frame(unsigned device) noexcept { world().end_frame(device); }
  static void enable(unsigned capability) noexcept { world().set_capability(capability, true); }
  static void disable(unsigned capability) noexcept { world().set_capability(capability, false); }
  static void get_integerv(unsigned name, int* values) noexcept { world().get_integerv(name, values); }
  static void get_doublev(unsigned name, double* values) noexcept { world().get_doublev(name, values); }
  static void set_doublev(unsigned name, const double* values) noexcept { world().set_doublev(name, values); }
  static const char* get_string(unsigned name) noexcept { return world().get_string(name); }
  static ErrorInfo get_error() noexcept { return world().get_error(); }
  static const char* get_error_string(unsigned code) noexcept {
    return code == comm_error ? "communication error" : "an emulated error";
  }
  static unsigned check_calibration() noexcept { return world().check_calibration(); }
  static void update_calibration(unsigned style) noexcept { world().update_calibration(style); }
  static void start_scheduler() noexcept { world().start_scheduler(); }
  static void stop_scheduler() noexcept { world().stop_scheduler(); }
  static void set_scheduler_rate(unsigned long rate) noexcept { world().set_scheduler_rate(rate); }
  static void schedule_synchronous(Callback f, void* data, unsigned short priority) noexcept {
    world().schedule_synchronous(f, data, priority);
  }
  static unsigned long schedule_asynchronous(Callback f, void* data, unsigned short priority) noexcept {
    return world().schedule_asynchronous(f, data, priority);
  }
  static void unschedule(unsigned long handle) noexcept { world().unschedule(handle); }

  template <unsigned (*F)(void*) noexcept>
  static unsigned callback(void* data) {
    return F(data);
  }

 private:
  static HdWorld& world() noexcept { return HdWorld::here(); }
};
static_assert(is_hd_api<EmulatedHd>, "the emulation has the vendor's signatures");

/// The world's time.
struct HdWorldClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<HdWorldClock>;
  static constexpr bool is_steady = true;
  static time_point now() noexcept { return time_point(HdWorld::here().now()); }
};

using LockStepHdapi = Hdapi<EmulatedHd, HdWorldClock>;
using RealTimeHdapi = Hdapi<EmulatedHd>;
static_assert(is_device<LockStepHdapi> && is_device<RealTimeHdapi>);

}  // namespace hapbeam::testing
