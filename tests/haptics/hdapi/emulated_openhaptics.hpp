// Stands in for haptics/hdapi/openhaptics.hpp when the programs of the documentation are built and run: the
// emulated HDAPI in real time, with one device that a hand holds still. A program that leaves its motors on is told so.
#pragma once

#include <cstdio>

#include "emulated_hd.hpp"

namespace hapbeam {

using OpenHaptics = testing::EmulatedHd;

namespace testing {
struct PluggedWorld : HdWorld {
  PluggedWorld() : HdWorld(Time::real) {}
  ~PluggedWorld() {
    if (phantom.enabled) std::fputs("the motors are on\n", stderr);
    if (started()) stop_scheduler();
  }
  Device& phantom = plug("Default Device", HandPath({0, 0.01}).rest(1));
};
inline PluggedWorld plugged_world;
}  // namespace testing

}  // namespace hapbeam
