// SPDX-License-Identifier: MIT
// What the adapter needs from OpenHaptics' HDAPI: a struct `Api` of static functions and constants; and what all devices of one Api
// share: the scheduler, its one servo thread, and the one stack of errors.
//
// The real one is haptics/hdapi/openhaptics.hpp; tests have an emulated one. Functions have the vendor's names without
// "hd", constants without "HD_". All have the vendor's types, which on every platform are those of the table in is_hd_api below.
//
//   Api::ErrorInfo               a struct with: unsigned errorCode, int internalErrorCode, unsigned hHD
//   Api::Callback                pointer to: unsigned f(void*), in the vendor's calling convention
//   Api::callback<F>             F, an unsigned (void*) noexcept, as such a function
//
// Loops are counted: the first one starts the scheduler, the last one stops it. While it runs, calls of a device are
// made on the servo thread. The list of loops changes there alone, so no tick waits for a lock. An error names its
// device. The loop that finds it notes it with the loop of that device, which handles it in its next tick.
// Source: OpenHaptics Toolkit, programmer's guide and API reference, 3.0 and 3.30.
#pragma once

#include <cstdint>
#include <mutex>
#include <type_traits>

namespace hapbeam {

/// Consequence of a device's error for the loop, in ascending order of severity.
enum class HdErrorClass : std::uint8_t {
  none,           ///< no error
  scheduler,      ///< a callback was not scheduled: reported to its caller, a running loop is not affected
  warm,           ///< motors near their limit: scale the force down
  force,          ///< a force or a speed was rejected: reset, and ramp the force in
  fault,          ///< end the loop: the device's fault, the program's, or unknown
  communication,  ///< end the loop: the line is lost
};

/// Every code has a class; an unknown code ends the loop.
/// Real-time: no allocation, noexcept, wait-free, O(1).
template <typename Api>
constexpr HdErrorClass classify(unsigned code) noexcept {
  switch (code) {
    case Api::success: return HdErrorClass::none;
    case Api::warm_motors: return HdErrorClass::warm;
    case Api::exceeded_max_force:
    case Api::exceeded_max_force_impulse:  // which the vendor's own classifier leaves out
    case Api::exceeded_max_velocity:
    case Api::force_error: return HdErrorClass::force;
    case Api::comm_error:
    case Api::comm_config_error: return HdErrorClass::communication;
    case Api::invalid_priority:
    case Api::scheduler_full: return HdErrorClass::scheduler;
    default: return HdErrorClass::fault;
  }
}

namespace detail {

/// True where an expression is a pointer to a static noexcept function of that very type.
template <typename Pointer, typename Result, typename... Arguments>
constexpr bool is_c_function = std::is_same_v<Pointer, Result (*)(Arguments...) noexcept>;

inline unsigned no_callback(void*) noexcept { return 0; }

template <typename Api, typename = void>
struct HdApiFunctions : std::false_type {};
template <typename Api>
struct HdApiFunctions<Api, std::void_t<typename Api::Callback, typename Api::ErrorInfo>>
    : std::bool_constant<
          is_c_function<decltype(&Api::init_device), unsigned, const char*> &&
          is_c_function<decltype(&Api::disable_device), void, unsigned> &&
          is_c_function<decltype(&Api::make_current_device), void, unsigned> &&
          is_c_function<decltype(&Api::get_current_device), unsigned> &&
          is_c_function<decltype(&Api::begin_frame), void, unsigned> &&
          is_c_function<decltype(&Api::end_frame), void, unsigned> &&
          is_c_function<decltype(&Api::enable), void, unsigned> &&
          is_c_function<decltype(&Api::disable), void, unsigned> &&
          is_c_function<decltype(&Api::get_integerv), void, unsigned, int*> &&
          is_c_function<decltype(&Api::get_doublev), void, unsigned, double*> &&
          is_c_function<decltype(&Api::set_doublev), void, unsigned, const double*> &&
          is_c_function<decltype(&Api::get_string), const char*, unsigned> &&
          is_c_function<decltype(&Api::get_error), typename Api::ErrorInfo> &&
          is_c_function<decltype(&Api::get_error_string), const char*, unsigned> &&
          is_c_function<decltype(&Api::check_calibration), unsigned> &&
          is_c_function<decltype(&Api::update_calibration), void, unsigned> &&
          is_c_function<decltype(&Api::start_scheduler), void> &&
          is_c_function<decltype(&Api::stop_scheduler), void> &&
          is_c_function<decltype(&Api::set_scheduler_rate), void, unsigned long> &&
          is_c_function<decltype(&Api::schedule_synchronous), void, typename Api::Callback, void*,
                        unsigned short> &&
          is_c_function<decltype(&Api::schedule_asynchronous), unsigned long, typename Api::Callback, void*,
                        unsigned short> &&
          is_c_function<decltype(&Api::unschedule), void, unsigned long> &&
          std::is_convertible_v<decltype(&Api::template callback<&no_callback>), typename Api::Callback> &&
          std::is_same_v<decltype(Api::ErrorInfo::errorCode), unsigned> &&
          std::is_same_v<decltype(Api::ErrorInfo::internalErrorCode), int> &&
          std::is_same_v<decltype(Api::ErrorInfo::hHD), unsigned>> {};

/// What the stack of errors held for one device.
struct HdErrors {
  HdErrorClass worst = HdErrorClass::none;
  bool warm = false;  ///< also with a more severe error
  unsigned code = 0;  ///< of the worst, the oldest where there are several

  void note(HdErrorClass kind, unsigned error) noexcept {
    warm |= kind == HdErrorClass::warm;
    // The stack gives the newest first.
    if (kind >= worst) worst = kind, code = error;
  }
};

/// A device in the list, and the errors that others found for it.
struct HdClient {
  unsigned handle = 0;
  HdErrors errors;
  HdClient* next = nullptr;
};

template <typename Api>
class HdScheduler {
 public:
  /// More errors than this wait for the next tick.
  static constexpr int most_errors = 32;

  /// Held while loops change, never in a tick.
  static inline std::mutex mutex;

  /// The scheduler runs.  With the mutex.
  static bool runs() noexcept { return loops_ > 0; }
  static unsigned rate() noexcept { return rate_; }

  /// Calls f() noexcept where a call of a device belongs: on the servo thread where there is one, else here.
  /// Blocks until f has returned.  With the mutex.   @return false where the scheduler did not take it
  template <typename F>
  static bool call(F&& f) noexcept {
    Call<std::remove_reference_t<F>> call{f, false};
    constexpr auto run = &Call<std::remove_reference_t<F>>::run;
    if (runs()) Api::schedule_synchronous(Api::template callback<run>, &call, Api::default_priority);
    else run(&call);
    return call.done;
  }

  /// As call(). A scheduler that does not take the function is stopped for it: no motor may keep a force because of that.
  template <typename F>
  static void insist(F&& f) noexcept {
    if (call(f)) return;
    Api::stop_scheduler();
    f();
    Api::start_scheduler();
  }

  /// On the servo thread, or with the mutex where there is none.
  static void link(HdClient& client) noexcept { client.next = first_, first_ = &client; }
  static void unlink(HdClient& client) noexcept {
    for (HdClient** place = &first_; *place; place = &(*place)->next)
      if (*place == &client) return void(*place = client.next);
  }

  /// Empties the stack and notes each error with its device, one that names none with all.
  /// @return the errors of no device in the list: of the calls just made for one that is not, else of loops that ended
  /// On the servo thread, or with the mutex where there is none.
  /// Real-time: no allocation, noexcept, bounded by most_errors.
  static HdErrors drain() noexcept {
    HdErrors rest;
    for (int i = 0; i < most_errors; ++i) {
      const typename Api::ErrorInfo error = Api::get_error();
      if (error.errorCode == Api::success) break;
      const HdErrorClass kind = classify<Api>(error.errorCode);
      bool noted = false;
      for (HdClient* client = first_; client; client = client->next)
        if (error.hHD == client->handle || error.hHD == Api::invalid_handle)
          client->errors.note(kind, error.errorCode), noted = true;
      if (!noted) rest.note(kind, error.errorCode);
    }
    return rest;
  }

  /// One loop more.  Starts the scheduler for the first one.  With the mutex.
  /// @return the error of the start: one that a tick may have met by now as well is not
  static HdErrors add_loop(unsigned rate) noexcept {
    HdErrors errors;
    rate_ = rate;
    if (loops_++ > 0) return errors;
    Api::start_scheduler();
    const unsigned code = Api::get_error().errorCode;
    const HdErrorClass kind = classify<Api>(code);
    if (kind != HdErrorClass::warm && kind != HdErrorClass::force) errors.note(kind, code);
    return errors;
  }
  /// One loop less.  Stops the scheduler after the last one, and disables what was to be disabled.  With the mutex.
  static void remove_loop() noexcept {
    if (--loops_ > 0) return;
    Api::stop_scheduler();
    for (; retired_ > 0; --retired_) Api::disable_device(retirees_[retired_ - 1]);
    drain();
  }
  /// Disables a device: now, or when the scheduler stops, because it may take long.  With the mutex.
  static void disable(unsigned handle) noexcept {
    if (runs() && retired_ < most_retirees) {
      retirees_[retired_++] = handle;
      return;
    }
    Api::disable_device(handle);
    if (!runs()) drain();
  }

 private:
  template <typename F>
  struct Call {
    F& f;
    bool done;
    static unsigned run(void* self) noexcept {
      static_cast<Call*>(self)->f();
      static_cast<Call*>(self)->done = true;
      return Api::callback_done;
    }
  };

  static constexpr int most_retirees = 16;
  static inline int loops_ = 0, retired_ = 0;
  static inline unsigned rate_ = 0;
  static inline unsigned retirees_[most_retirees] = {};
  static inline HdClient* first_ = nullptr;
};

}  // namespace detail

/// True where Api has all functions that Hdapi<Api> calls, with the vendor's types.  A constant that it lacks is named by the compiler.
template <typename Api>
inline constexpr bool is_hd_api = detail::HdApiFunctions<Api>::value;

}  // namespace hapbeam
