// Presses that a servo loop may ever ask of a model: long, mean, and the same in each run.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/force_model.hpp>

namespace hapbeam::testing {

/// A beam under dead loads that are neither even nor small.
inline Beam loaded_beam(Support left, Support right) {
  Beam beam = thesis_beam(left, right);
  beam.transverse([](double s) { return -60 * s; }).axial(20);
  return beam.add({0.3, 100, -40, 2}).add({1.7, 0, 25, 0});
}

/// What a hand does: presses through zero, slides, jumps, holds still, comes off; and what no hand can do.
/// @param range, length [m]  of the model
template <typename S>
std::vector<Press<S>> requests(const Range<S>& range, S length, unsigned seed) {
  Random random(seed);
  const auto uniform = [&random](S low, S high) { return static_cast<S>(random(low, high)); };
  std::vector<Press<S>> path;
  // Presses through zero at mid-span, twice.
  for (int k = 0; k <= 200; ++k) path.push_back({length / 2, range.depth * std::sin(S(0.0628) * S(k))});
  // Slides from end to end while pressed.
  for (int k = 0; k <= 200; ++k) {
    const S s = length * S(k) / 200;
    path.push_back({s, range.depth_at(s) / 3});
  }
  // A random walk in both.
  for (int k = 0; k < 200; ++k) {
    const Press<S>& last = path.back();
    path.push_back(
        {std::abs(last.s + length * uniform(-.01f, .01f)), last.d + range.depth * uniform(-.02f, .02f)});
  }
  // Jumps to anywhere, many of them out of range.
  for (int k = 0; k < 200; ++k)
    path.push_back({length * uniform(-.2f, 1.2f), range.depth * uniform(-1.5f, 1.5f)});
  // Ends, their neighbourhood, and exact zero.
  using limits = std::numeric_limits<S>;
  const S deep = range.depth, tiny = limits::denorm_min(), epsilon = limits::epsilon();
  for (const S s : {S(0), tiny, limits::min(), length * epsilon, length * S(1e-4), length * (1 - epsilon),
                    length, length * (1 + epsilon)})
    for (const S d : {S(0), -S(0), tiny, deep, -deep, deep * epsilon}) path.push_back({s, d});
  // Impossible ones, between possible ones.
  for (const S bad : {limits::quiet_NaN(), limits::infinity(), -limits::infinity(), limits::max(),
                      -limits::max(), S(1e9), S(-1e9)})
    for (const S s : {length / 2, length / 10})
      for (const S d : {deep / 10, S(0)})
        for (const Press<S>& press : {Press<S>{bad, d}, {s, d}, {s, bad}, {bad, bad}, {s, d}})
          path.push_back(press);
  return path;
}

}  // namespace hapbeam::testing
