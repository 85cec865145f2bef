// SPDX-License-Identifier: MIT
// What all devices of one Api share: the scheduler, its one servo thread, and the one stack of errors.
//
// Loops are counted: the first one starts the scheduler, the last one stops it. While it runs, calls of a device are
// made on the servo thread. The list of loops changes there alone, so no tick waits for a lock. An error names its
// device. The loop that finds it notes it with the loop of that device, which handles it in its next tick.
#pragma once

#include <algorithm>
#include <mutex>

#include <hapbeam/haptics/hdapi/contract.hpp>

namespace hapbeam::detail {

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
      if (*place == &client) {
        *place = client.next;
        return;
      }
  }

  /// Empties the stack and notes each error with its device, one that names none with all.
  /// @return the errors of no device in the list: of the calls just made for one that is not, else of loops
  ///         that ended
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
  /// One loop less.  Stops the scheduler after the last one, and disables what was to be disabled.  With the
  /// mutex.
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

}  // namespace hapbeam::detail
