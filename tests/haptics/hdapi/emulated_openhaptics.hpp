// Stands in for haptics/hdapi/openhaptics.hpp when the programs of the documentation are built and run: the
// emulated HDAPI in real time, with one device that a hand holds still.
#pragma once

#include "emulated_hd.hpp"

namespace hapbeam {

using OpenHaptics = testing::EmulatedHd;

namespace testing {
struct PluggedWorld : HdWorld {
  PluggedWorld() : HdWorld(Time::real) { plug("Default Device", HandPath({0, 0.01}).rest(1)); }
};
inline PluggedWorld plugged_world;
}  // namespace testing

}  // namespace hapbeam
