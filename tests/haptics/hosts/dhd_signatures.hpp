// Force Dimension's DHD, SDK 3, as far as the page uses it: names, types and what a call does, stated anew from its reference.
#pragma once

#include "haptics/hosts/pressing_hand.hpp"

constexpr unsigned char DHD_ON = 1;

inline int dhdOpen() { return 0; }
inline int dhdClose(char = -1) { return 0; }
inline const char* dhdErrorGetLastStr() { return "no error"; }
inline int dhdEnableForce(unsigned char, char = -1) { return 0; }
/// A loop that runs free takes a quarter of a millisecond, more or less.
inline double dhdGetTime() {
  auto& hand = hapbeam::testing::pressing_hand;
  return hand.time += 2.5e-4 * (1 + 0.3 * std::sin(1e5 * hand.time));
}
inline int dhdGetPosition(double* x, double* y, double* z, char = -1) {
  *x = *y = 0, *z = hapbeam::testing::pressing_hand.height();
  return 0;
}
inline int dhdGetLinearVelocity(double* x, double* y, double* z, char = -1) {
  *x = *y = 0, *z = hapbeam::testing::pressing_hand.climb();
  return 0;
}
inline int dhdSetForce(double, double, double z, char = -1) {
  hapbeam::testing::pressing_hand.feel(z);
  return 0;
}
