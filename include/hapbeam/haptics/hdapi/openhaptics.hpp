// SPDX-License-Identifier: MIT
// OpenHaptics' HDAPI as an Api of Hdapi (contract.hpp): the only header that includes the vendor's.
//
// It requires the OpenHaptics developer kit, 3.0 or later; with CMake link hapbeam::openhaptics. Each function calls
// the vendor's of the same name and does nothing else.
#pragma once

// The vendor's header detects Linux by a macro that g++ and clang define in their GNU dialects alone.
#if defined(__linux__) && !defined(linux)
#define linux 1
#define HAPBEAM_DEFINED_LINUX
#endif
#include <HD/hd.h>
#ifdef HAPBEAM_DEFINED_LINUX
#undef linux
#undef HAPBEAM_DEFINED_LINUX
#endif

#include <hapbeam/haptics/hdapi/hdapi.hpp>

// HDCALLBACK names a calling convention that x86-64 does not have; g++ and clang warn of it.
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wattributes"
#if defined(__clang__)
#pragma GCC diagnostic ignored "-Wignored-attributes"
#endif
#endif

namespace hapbeam {

struct OpenHaptics {
  using Callback = HDSchedulerCallback;
  using ErrorInfo = HDErrorInfo;

  static HHD init_device(HDstring name) noexcept { return hdInitDevice(name); }
  static void disable_device(HHD device) noexcept { hdDisableDevice(device); }
  static void make_current_device(HHD device) noexcept { hdMakeCurrentDevice(device); }
  static HHD get_current_device() noexcept { return hdGetCurrentDevice(); }
  static void begin_frame(HHD device) noexcept { hdBeginFrame(device); }
  static void end_frame(HHD device) noexcept { hdEndFrame(device); }
  static void enable(HDenum capability) noexcept { hdEnable(capability); }
  static void disable(HDenum capability) noexcept { hdDisable(capability); }
  static void get_integerv(HDenum name, HDint* values) noexcept { hdGetIntegerv(name, values); }
  static void get_doublev(HDenum name, HDdouble* values) noexcept { hdGetDoublev(name, values); }
  static void set_doublev(HDenum name, const HDdouble* values) noexcept { hdSetDoublev(name, values); }
  static HDstring get_string(HDenum name) noexcept { return hdGetString(name); }
  static HDErrorInfo get_error() noexcept { return hdGetError(); }
  static HDstring get_error_string(HDerror code) noexcept { return hdGetErrorString(code); }
  static HDenum check_calibration() noexcept { return hdCheckCalibration(); }
  static void update_calibration(HDenum style) noexcept { hdUpdateCalibration(style); }
  static void start_scheduler() noexcept { hdStartScheduler(); }
  static void stop_scheduler() noexcept { hdStopScheduler(); }
  static void set_scheduler_rate(HDulong rate) noexcept { hdSetSchedulerRate(rate); }
  static void schedule_synchronous(Callback f, void* data, HDushort priority) noexcept {
    hdScheduleSynchronous(f, data, priority);
  }
  static HDSchedulerHandle schedule_asynchronous(Callback f, void* data, HDushort priority) noexcept {
    return hdScheduleAsynchronous(f, data, priority);
  }
  static void unschedule(HDSchedulerHandle handle) noexcept { hdUnschedule(handle); }

  template <unsigned (*F)(void*) noexcept>
  static HDCallbackCode HDCALLBACK callback(void* data) {
    return F(data);
  }

  static constexpr HDenum current_position = HD_CURRENT_POSITION;
  static constexpr HDenum current_velocity = HD_CURRENT_VELOCITY;
  static constexpr HDenum current_force = HD_CURRENT_FORCE;
  static constexpr HDenum motor_temperature = HD_MOTOR_TEMPERATURE;
  static constexpr HDenum device_model_type = HD_DEVICE_MODEL_TYPE;
  static constexpr HDenum usable_workspace = HD_USABLE_WORKSPACE_DIMENSIONS;
  static constexpr HDenum nominal_max_force = HD_NOMINAL_MAX_FORCE;
  static constexpr HDenum nominal_max_continuous_force = HD_NOMINAL_MAX_CONTINUOUS_FORCE;
  static constexpr HDenum nominal_max_stiffness = HD_NOMINAL_MAX_STIFFNESS;
  static constexpr HDenum current_transform = HD_CURRENT_TRANSFORM;
  static constexpr HDenum current_torque = HD_CURRENT_TORQUE;
  static constexpr HDenum input_dof = HD_INPUT_DOF;
  static constexpr HDenum output_dof = HD_OUTPUT_DOF;
  static constexpr HDenum nominal_max_torque = HD_NOMINAL_MAX_TORQUE_FORCE;
  static constexpr HDenum nominal_max_continuous_torque = HD_NOMINAL_MAX_TORQUE_CONTINUOUS_FORCE;
  static constexpr HDenum nominal_max_torque_stiffness = HD_NOMINAL_MAX_TORQUE_STIFFNESS;
  static constexpr HDenum force_output = HD_FORCE_OUTPUT;
  static constexpr HDenum calibration_ok = HD_CALIBRATION_OK;
  static constexpr HDenum calibration_needs_update = HD_CALIBRATION_NEEDS_UPDATE;
  static constexpr HDenum calibration_style = HD_CALIBRATION_STYLE;
  static constexpr HDenum calibration_auto = HD_CALIBRATION_AUTO;
  static constexpr HDenum calibration_inkwell = HD_CALIBRATION_INKWELL;
  static constexpr HDenum calibration_encoder_reset = HD_CALIBRATION_ENCODER_RESET;
  static constexpr HDCallbackCode callback_done = HD_CALLBACK_DONE;
  static constexpr HDCallbackCode callback_continue = HD_CALLBACK_CONTINUE;
  static constexpr HDushort default_priority = HD_DEFAULT_SCHEDULER_PRIORITY;
  static constexpr HHD invalid_handle = HD_INVALID_HANDLE;
  static constexpr HDerror success = HD_SUCCESS;
  static constexpr HDerror warm_motors = HD_WARM_MOTORS;
  static constexpr HDerror exceeded_max_force = HD_EXCEEDED_MAX_FORCE;
  static constexpr HDerror exceeded_max_force_impulse = HD_EXCEEDED_MAX_FORCE_IMPULSE;
  static constexpr HDerror exceeded_max_velocity = HD_EXCEEDED_MAX_VELOCITY;
  static constexpr HDerror force_error = HD_FORCE_ERROR;
  static constexpr HDerror comm_error = HD_COMM_ERROR;
  static constexpr HDerror comm_config_error = HD_COMM_CONFIG_ERROR;
  static constexpr HDerror invalid_priority = HD_INVALID_PRIORITY;
  static constexpr HDerror scheduler_full = HD_SCHEDULER_FULL;
};
static_assert(is_hd_api<OpenHaptics>,
              "this version of HD/hd.h differs from those that hapbeam knows, 3.0 to 3.30");

}  // namespace hapbeam

#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
