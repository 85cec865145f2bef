// SPDX-License-Identifier: MIT
// A device of OpenHaptics' HDAPI behind the device contract (device.hpp).
//
//   Hdapi<OpenHaptics> device;          // connects; docs/haptics.md has a complete program
//   device.start(servo);                // or throws: a person has to calibrate it, no communication …
//
// A tick is one frame. It reads the device, empties the shared stack of errors, calls the servo, and limits, ramps and
// sends its force. Zero is sent, too, because the device keeps a force until it is replaced. The orientation is read if
// device and servo have one. Torque is sent only to devices that render it.
//
// A rejected force or speed: zero is sent, DeviceState::reset, and the force ramps in.  Warm motors: it ramps down, and in again when they
// have cooled.  A calibration that is missing or lost: zero is sent, and the servo not called, until the device has calibrated itself.
// Any other fault, and a reading that is no number or not this device's: zero is sent, forces are switched off and the loop ends; status()
// has the reason, and start() reconnects.  Where the driver reports an error in that, it is done again in the next three ticks.
//
// Several devices share one scheduler (contract.hpp). A device is constructed, or restarted after its loop was lost,
// while no other runs. A healthy device starts and stops at any time. Units and origin are those of connection.hpp.
// Construction, calibrate() and start() allocate and throw. A tick does neither, and never waits for a thread.
// Source: OpenHaptics Toolkit, programmer's guide.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <hapbeam/haptics/device/device.hpp>
#include <hapbeam/haptics/hdapi/connection.hpp>
#include <hapbeam/haptics/hdapi/setup.hpp>

namespace hapbeam {

/// @tparam Api    the C functions and constants (contract.hpp): OpenHaptics, or an emulation
/// @tparam Clock  of time and missed ticks: steady, now() noexcept
template <typename Api, typename Clock = std::chrono::steady_clock>
class Hdapi {
  static_assert(is_hd_api<Api>,
                "an Api is what hapbeam/haptics/hdapi/contract.hpp lists, noexcept, in the vendor's types");
  static_assert(Clock::is_steady&& noexcept(Clock::now()),
                "ticks are timed by a steady clock that does not throw");

  using Scheduler = detail::HdScheduler<Api>;
  using Lock = std::lock_guard<std::mutex>;

 public:
  /// Connects.   @throws std::invalid_argument, DeviceError; std::logic_error while another device's loop runs
  explicit Hdapi(const HdapiOptions& options = {})
      : device_(options), ramp_(options.ramp_time, 1.0 / options.rate) {
    const Lock lock(Scheduler::mutex);
    device_.connect();
  }
  ~Hdapi() {
    stop();
    const Lock lock(Scheduler::mutex);
    device_.disconnect();
  }
  Hdapi(const Hdapi&) = delete;
  Hdapi& operator=(const Hdapi&) = delete;

  const DeviceInfo& info() const noexcept { return device_.info(); }
  DeviceStatus status() const noexcept { return status_.load(std::memory_order_acquire); }
  bool running() const noexcept { return is_running(status()); }
  DeviceCounts counts() const noexcept {
    return {ticks_.load(std::memory_order_relaxed), missed_ticks_.load(std::memory_order_relaxed),
            force_cut_ticks_.load(std::memory_order_relaxed)};
  }

  /// The arm stands in its reset position: calibrates with it. Without effect if the device calibrates itself while it runs.
  /// @throws std::logic_error while it runs, DeviceError where the device is not calibrated even so
  void calibrate() {
    const Lock lock(Scheduler::mutex);
    if (running()) throw std::logic_error("Hdapi: cannot be calibrated while it runs");
    prepare([this] { device_.calibrate(true); });
  }

  /// Checks a calibration made by a person, schedules the tick, enables forces, and starts the scheduler if none runs.
  /// The force ramps in. A device that calibrates itself is `calibrating` first. After a fault it reconnects. Blocks.
  /// start() and stop() belong to one thread.
  /// @throws std::logic_error where it runs already or must connect while another runs, std::invalid_argument
  ///         where another runs at another rate, DeviceError with the status that status() then has
  template <typename Servo>
  void start(Servo& servo) {
    require_servo<Servo>();
    const Lock lock(Scheduler::mutex);
    if (running()) throw std::logic_error("Hdapi: runs already");
    const unsigned rate = device_.options().rate;
    if (Scheduler::runs() && Scheduler::rate() != rate)
      detail::reject("rate", rate, "Hz", "that of the devices that run already");
    prepare([this] { device_.calibrate(false); });
    servo_ = &servo;
    ask_ = [](void* object, const OrientedState& state, bool oriented) noexcept {
      return detail::ask(*static_cast<Servo*>(object), state, oriented);
    };
    oriented_ = takes_orientation<Servo> && info().gimbal.reads;
    prepare([this] { begin(); });
  }

  void stop() noexcept {  // blocks until the last tick has returned
    const Lock lock(Scheduler::mutex);
    end();
  }

 private:
  /// Calls a function that may throw a DeviceError, with a connected device; the error becomes the status.
  template <typename Act>
  void prepare(const Act& act) {
    try {
      end();
      if (!device_.connected()) device_.connect();
      status_.store(DeviceStatus::stopped, std::memory_order_release);
      act();
    } catch (const DeviceError& error) {
      end();
      status_.store(error.why(), std::memory_order_release);
      end();
      throw;
    }
  }

  void begin() {
    ticks_ = missed_ticks_ = force_cut_ticks_ = 0;
    stopping_ = ended_ = false;
    last_ticks_ = most_last_ticks;
    sent_ = {};
    cut_ = ForceCut::none;
    ramp_.start();
    device_.calibration.start();
    anew_ = true;
    first_.reset();
    detail::HdErrors errors;
    part_ = Part::scheduled;
    const bool linked = Scheduler::call([this]() noexcept {
      Scheduler::drain();
      device_.client.errors = {};
      Scheduler::link(device_.client);
    });
    if (!linked) device_.fail("is not scheduled", errors);
    if (!Scheduler::runs()) Api::set_scheduler_rate(device_.options().rate);
    status_.store(device_.calibration.automatic() ? DeviceStatus::calibrating : DeviceStatus::running,
                  std::memory_order_release);
    schedule_ =
        Api::schedule_asynchronous(Api::template callback<&Hdapi::servo_tick>, this, Api::default_priority);
    bool selected = true;
    const bool asked = Scheduler::call([&]() noexcept {
      if (!running()) return;  // beside another loop this one runs by now, and has met a fault
      selected = device_.select();
      if (selected) Api::enable(Api::force_output);
      Scheduler::drain();
      errors = device_.client.errors;
    });
    if (!asked || !has_schedule()) device_.fail("is not scheduled", errors);
    if (!selected || errors.worst >= HdErrorClass::fault) device_.fail("does not start", errors);
    part_ = Part::counted;
    errors = Scheduler::add_loop(device_.options().rate);
    if (errors.worst != HdErrorClass::none) device_.fail("does not start", errors);
  }
  bool has_schedule() const noexcept { return static_cast<unsigned>(schedule_) != Api::invalid_handle; }

  /// Sends zero, disables forces and ends the ticks; a lost device is disconnected.
  void end() noexcept {
    stopping_.store(true, relaxed);
    // What is called synchronously returns after this tick or the next: the loop has then ended itself.
    for (int i = 0; i < 10 && part_ != Part::none && Scheduler::runs() && has_schedule() && !ended_; ++i)
      Scheduler::call([]() noexcept {});
    const Part part = std::exchange(part_, Part::none);
    if (part == Part::counted) Scheduler::remove_loop();
    if (part != Part::none && !ended_) {  // it never ran, or the scheduler does not answer
      if (has_schedule()) Api::unschedule(schedule_);
      Scheduler::insist([this]() noexcept {
        device_.switch_off();
        Scheduler::unlink(device_.client);
      });
    }
    if (running()) status_.store(DeviceStatus::stopped, std::memory_order_release);
    if (status() == DeviceStatus::device_fault || status() == DeviceStatus::communication_lost)
      device_.disconnect();
  }

  static unsigned servo_tick(void* self) noexcept {
    return static_cast<Hdapi*>(self)->tick() ? Api::callback_continue : Api::callback_done;
  }

  /// @return whether the loop continues
  bool tick() noexcept {
    if (ended_.load(relaxed)) return false;
    const unsigned handle = device_.client.handle;
    const auto now = Clock::now();
    Api::begin_frame(handle);
    // A frame that does not begin may leave another device current, and that one must not get this one's force.
    const bool current = Api::get_current_device() == handle;
    const auto reading = device_.read();
    OrientedState state;
    const bool readable = reading.finite() && (!oriented_ || device_.read(state.orientation));
    const bool calibrated = current && device_.calibration.ask();
    Scheduler::drain();
    const detail::HdErrors errors = std::exchange(device_.client.errors, {});

    const DeviceStatus end =
        !running()                                                      ? status()
        : errors.worst == HdErrorClass::communication                   ? DeviceStatus::communication_lost
        : errors.worst == HdErrorClass::fault || !(current && readable) ? DeviceStatus::device_fault
        : !calibrated && !device_.calibration.automatic()               ? DeviceStatus::calibration_needed
        : stopping_.load(relaxed)                                       ? DeviceStatus::stopped
                                                                        : DeviceStatus::running;
    Wrench wrench;
    if (is_running(end)) {
      const bool force_error = errors.worst == HdErrorClass::force;
      ramp_.advance(reading.temperature, errors.warm, force_error);
      state.position = reading.position, state.velocity = reading.velocity;
      state.time = elapsed(now), state.cut = cut_;
      state.sent = sent_.force, state.sent_torque = sent_.torque;
      state.status = !calibrated          ? DeviceStatus::calibrating
                     : ramp_.warm()       ? DeviceStatus::warm
                     : ramp_.recovering() ? DeviceStatus::force_error
                                          : DeviceStatus::running;
      state.reset = force_error || anew_;
      status_.store(state.status, std::memory_order_release);
      if (calibrated) wrench = ask(state);
      else sent_ = {}, cut_ = ForceCut::none, ramp_.restart();
      anew_ = !calibrated;
    }
    if (current) Api::set_doublev(Api::current_force, wrench.force.data());
    if (current && device_.has_torque()) device_.send_torque(wrench.torque);
    Api::end_frame(handle);
    if (is_running(end)) {
      device_.calibration.update();
      return true;
    }
    status_.store(end, std::memory_order_release);
    if (!device_.switch_off() && last_ticks_-- > 0) return true;
    Scheduler::unlink(device_.client);
    ended_.store(true, std::memory_order_release);
    return false;
  }

  /// The servo's force and torque, as they may be sent.
  Wrench ask(const OrientedState& state) noexcept {
    Wrench wrench = ask_(servo_, state, oriented_);
    cut_ = limit_wrench(wrench, info().peak_force, info().gimbal.peak_torque);
    if (cut_ == ForceCut::none && ramp_.gain() < 1 && !(wrench.force.isZero(0) && wrench.torque.isZero(0)))
      cut_ = ForceCut::ramped;
    wrench.force *= ramp_.gain(), wrench.torque *= ramp_.gain();
    sent_ = wrench;
    ticks_.fetch_add(1, relaxed);
    if (cut_ != ForceCut::none) force_cut_ticks_.fetch_add(1, relaxed);
    return wrench;
  }

  /// Time since the first tick [s]; counts the ticks that should have been since the last one.
  double elapsed(typename Clock::time_point now) noexcept {
    if (!first_) first_ = last_ = now;
    const double gap = std::chrono::duration<double>(now - std::exchange(last_, now)).count() / info().period;
    if (gap >= 2) missed_ticks_.fetch_add(static_cast<std::uint64_t>(gap) - 1, relaxed);
    return std::chrono::duration<double>(now - *first_).count();
  }

  /// What of the scheduler this loop has: its tick is scheduled, then it counts as one that runs.
  enum class Part : std::uint8_t { none, scheduled, counted };

  static constexpr auto relaxed = std::memory_order_relaxed;
  static constexpr int most_last_ticks = 3;

  detail::HdConnection<Api> device_;
  ForceRamp ramp_;
  void* servo_ = nullptr;
  Wrench (*ask_)(void*, const OrientedState&, bool oriented) noexcept = nullptr;
  bool oriented_ = false;  // the servo takes what the device reads of its orientation
  unsigned long schedule_ = 0;
  Part part_ = Part::none;
  bool anew_ = true;    // the servo has not been asked since the arm's place is known
  int last_ticks_ = 0;  // left to switch the motors off, after the loop has ended
  Wrench sent_;
  ForceCut cut_ = ForceCut::none;
  std::optional<typename Clock::time_point> first_;  // none: no tick yet
  typename Clock::time_point last_{};
  std::atomic<DeviceStatus> status_{DeviceStatus::stopped};
  std::atomic<std::uint64_t> ticks_{0}, missed_ticks_{0}, force_cut_ticks_{0};
  std::atomic<bool> stopping_{false}, ended_{false};
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "a tick must not lock");
};

}  // namespace hapbeam
