// Strokes of a hand, each so many ticks long, between marks for callgrind, which counts their instructions: compare.cmake runs it.
#pragma once

#include <cmath>
#include <string>
#include <valgrind/callgrind.h>

#include "once.hpp"
#include <hapbeam/contact/touch.hpp>

namespace hapbeam::testing {

inline constexpr int ticks = 200;

/// @param name  of the stroke in tests/data/instructions.csv   @param tick  called for 0 … ticks - 1, and counted
template <class Tick>
void count(const std::string& name, Tick&& tick) {
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  for (int k = 0; k < ticks; ++k) tick(k);
  CALLGRIND_DUMP_STATS_AT(name.c_str());
  CALLGRIND_STOP_INSTRUMENTATION;
}

/// Out in the first half of the stroke, and back.   @return 0 … 1
inline double out_and_back(int k) { return 1 - std::abs(2.0 * k / ticks - 1); }

/// A hand that presses in and out, and one that slides to and fro at half of that depth.
/// @param top  [m] the avatar's centre where it touches the beam at rest   @param depth  [m]   @param way  along the beam [m]
template <class Model>
void press_and_slide(const std::string& name, Model model, double radius, const Vector2<double>& top,
                     double depth, double way) {
  using Scalar = typename Model::Scalar;
  Touch<Model> touch(model, static_cast<Scalar>(radius));
  volatile Scalar felt = 0;
  const auto tick = [&](double along, double down) {
    const Vector2<double> hand = top + Vector2<double>(along, -down);
    felt = touch.tick(hand.cast<Scalar>()).force.y();
  };
  count(name + ": in and out", [&](int k) { tick(0, -1e-3 + (depth + 1e-3) * out_and_back(k)); });
  for (int k = 0; k < ticks; ++k) tick(0, depth / 2 * k / ticks);
  count(name + ": slides", [&](int k) { tick(way * out_and_back(k), depth / 2); });
  static_cast<void>(felt);
}

void straight();
void bent();
void friction();
void trained();
void many();
void in_space();

}  // namespace hapbeam::testing
