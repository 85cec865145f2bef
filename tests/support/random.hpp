// Random numbers that are the same on every machine: the standard fixes the generator but not its
// distributions.
#pragma once

#include <cstdint>
#include <random>

namespace hapbeam::testing {

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}

  /// Even on [low, high).
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  /// Even on [-size, size).
  double operator()(double size) { return (*this)(-size, size); }
  /// Even on low … high, both included.
  int integer(int low, int high) { return low + static_cast<int>((*this)(0, high - low + 1)); }

 private:
  std::mt19937_64 generator_;
};

}  // namespace hapbeam::testing
