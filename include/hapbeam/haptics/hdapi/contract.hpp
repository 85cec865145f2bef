// SPDX-License-Identifier: MIT
// What the adapter needs from OpenHaptics' HDAPI: a struct `Api` of static functions and constants.
//
// The real one is haptics/hdapi/openhaptics.hpp; tests have an emulated one. Functions have the vendor's names without
// "hd", constants without "HD_". All have the vendor's types, which on every platform are those of the table in
// is_hd_api below.
//
//   Api::ErrorInfo               a struct with: unsigned errorCode, int internalErrorCode, unsigned hHD
//   Api::Callback                pointer to: unsigned f(void*), in the vendor's calling convention
//   Api::callback<F>             F, an unsigned (void*) noexcept, as such a function
//
// Source: OpenHaptics Toolkit, programmer's guide and API reference, 3.0 and 3.30.
#pragma once

#include <cstdint>
#include <type_traits>

namespace hapbeam {

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

}  // namespace detail

/// True where Api has all functions that Hdapi<Api> calls, with the vendor's types.  A constant that it lacks is named by the compiler.
template <typename Api>
inline constexpr bool is_hd_api = detail::HdApiFunctions<Api>::value;

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

}  // namespace hapbeam
