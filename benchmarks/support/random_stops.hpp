// Stops and paths of scenes to touch: places and depths at random, and a hand that goes in and out.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "touch_scenes.hpp"

namespace hapbeam::benchmarks {

inline constexpr double beyond = 1.6;      // of the depth
inline constexpr double shallowest = 0.1;  // of the depth

struct Interval {
  double low, high;
};

/// So many stops at random.   @param stop  (where, depth) -> Stop
template <int D, class MakeStop>
std::vector<StopIn<D>> random_stops(int count, const Interval& where, const Interval& depth,
                                    std::uint64_t seed, const MakeStop& stop) {
  // The standard fixes the generator but not its distributions.
  std::mt19937_64 generator(seed);
  const auto random = [&generator](const Interval& range) {
    return range.low + (range.high - range.low) * static_cast<double>(generator() >> 11) * 0x1p-53;
  };
  std::vector<StopIn<D>> stops;
  for (int k = 0; k < count; ++k) {
    const double x = random(where), d = random(depth);
    stops.push_back(stop(x, d));
  }
  return stops;
}

/// In and out twice a second, to and fro once.   @param t  [s]
inline double in(double t) { return shallowest + (1 - shallowest) * (1 - std::cos(4 * M_PI * t)) / 2; }
inline double aside(double t) { return std::sin(2 * M_PI * t); }

}  // namespace hapbeam::benchmarks
