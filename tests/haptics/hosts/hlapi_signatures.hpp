// OpenHaptics' HLAPI as far as the page uses it: names, types and what a call does, stated anew from its reference.  A frame that
// starts an effect presses for two seconds.
#pragma once

#include "haptics/hosts/pressing_hand.hpp"

using HDdouble = double;
using HLuint = unsigned;
using HHD = unsigned;
using HHLRC = void*;
struct HLcache {};
using HLcallbackProc = void (*)();
#define HLCALLBACK

enum : unsigned { HL_EFFECT_COMPUTE_FORCE, HL_EFFECT_CALLBACK, HL_USE_GL_MODELVIEW };
constexpr const char* HL_PROXY_POSITION = "HL_PROXY_POSITION";
constexpr const char* HD_DEFAULT_DEVICE = nullptr;
constexpr HHD HD_INVALID_HANDLE = ~0u;

namespace hapbeam::testing {
struct HlEffect {
  void (*compute)(HDdouble*, HLcache*, void*) = nullptr;
  void* data = nullptr;
  bool started = false;
};
inline HlEffect hl_effect;
}  // namespace hapbeam::testing

inline HHD hdInitDevice(const char*) { return 0; }
inline void hdMakeCurrentDevice(HHD) {}
inline void hdDisableDevice(HHD) {}
inline HHLRC hlCreateContext(HHD) { return nullptr; }
inline void hlMakeCurrent(HHLRC) {}
inline void hlDeleteContext(HHLRC) {}
inline void hlDisable(unsigned) {}
inline HLuint hlGenEffects(int) { return 1; }
inline void hlDeleteEffects(HLuint, int) {}
inline void hlCallback(unsigned, HLcallbackProc compute, void* data) {
  hapbeam::testing::hl_effect.compute = reinterpret_cast<void (*)(HDdouble*, HLcache*, void*)>(compute);
  hapbeam::testing::hl_effect.data = data;
}
inline void hlStartEffect(unsigned, HLuint) { hapbeam::testing::hl_effect.started = true; }
inline void hlStopEffect(HLuint) { hapbeam::testing::hl_effect.started = false; }
inline void hlBeginFrame() {}
inline void hlEndFrame() {
  auto& hand = hapbeam::testing::pressing_hand;
  HLcache cache;
  for (int tick = 0; tick < 2000 && hapbeam::testing::hl_effect.started; ++tick) {
    hand.time += 1e-3;
    HDdouble force[3] = {0, 0, 0};
    hapbeam::testing::hl_effect.compute(force, &cache, hapbeam::testing::hl_effect.data);
    hand.feel(force[1]);
  }
}
inline void hlCacheGetDoublev(HLcache*, const char*, HDdouble* value) {
  value[0] = value[2] = 0, value[1] = 1e3 * hapbeam::testing::pressing_hand.height();
}
