// OpenHaptics' HDAPI as far as a callback of one's own uses it: names, types and what a call does, stated anew from its reference.  A
// scheduler that starts calls the callback for two seconds.
#pragma once

#include "haptics/hosts/pressing_hand.hpp"

using HDdouble = double;
using HDenum = unsigned;
using HHD = unsigned;
using HDCallbackCode = unsigned;
using HDSchedulerHandle = unsigned long;
using HDSchedulerCallback = HDCallbackCode (*)(void*);
#define HDCALLBACK

enum : unsigned { HD_CURRENT_POSITION, HD_CURRENT_VELOCITY, HD_CURRENT_FORCE, HD_FORCE_OUTPUT };
enum : unsigned { HD_CALLBACK_DONE, HD_CALLBACK_CONTINUE };
constexpr unsigned short HD_DEFAULT_SCHEDULER_PRIORITY = 0x7fff;
constexpr const char* HD_DEFAULT_DEVICE = nullptr;
constexpr HHD HD_INVALID_HANDLE = ~0u;

namespace hapbeam::testing {
struct HdCallback {
  HDSchedulerCallback call = nullptr;
  void* data = nullptr;
};
inline HdCallback hd_callback;
}  // namespace hapbeam::testing

inline HHD hdInitDevice(const char*) { return 0; }
inline HHD hdGetCurrentDevice() { return 0; }
inline void hdDisableDevice(HHD) {}
inline void hdEnable(HDenum) {}
inline void hdDisable(HDenum) {}
inline void hdBeginFrame(HHD) { hapbeam::testing::pressing_hand.time += 1e-3; }
inline void hdEndFrame(HHD) {}
inline void hdGetDoublev(HDenum what, HDdouble* value) {
  const auto& hand = hapbeam::testing::pressing_hand;
  value[0] = value[2] = 0, value[1] = 1e3 * (what == HD_CURRENT_POSITION ? hand.height() : hand.climb());
}
inline void hdSetDoublev(HDenum, const HDdouble* force) { hapbeam::testing::pressing_hand.feel(force[1]); }
inline HDSchedulerHandle hdScheduleAsynchronous(HDSchedulerCallback call, void* data, unsigned short) {
  hapbeam::testing::hd_callback = {call, data};
  return 1;
}
inline void hdStartScheduler() {
  const auto& scheduled = hapbeam::testing::hd_callback;
  for (int tick = 0; tick < 2000 && scheduled.call(scheduled.data) == HD_CALLBACK_CONTINUE;) ++tick;
}
inline void hdStopScheduler() {}
inline void hdUnschedule(HDSchedulerHandle) {}
