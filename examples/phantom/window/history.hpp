// What the panels draw: the last seconds, tick by tick, and how long the ticks took.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../tape.hpp"

namespace phantom {

class History {
 public:
  struct Moment {
    float time, force_against, force, depth, place,
        moved;           ///< [s, N, N, m, m, m]; depth is from the beam at rest, in a plane down
    bool pressing, cut;  ///< cut: the force is the device's limit
  };

  /// @param depth  [m] of the press   @param force  [N] against it
  void add(const Tick& tick, double depth, double force) {
    const hapbeam::ServoRecord& r = tick.record;
    const Moment moment{static_cast<float>(r.time),
                        static_cast<float>(force),
                        static_cast<float>(r.force.norm()),
                        static_cast<float>(depth),
                        static_cast<float>(r.press.s),
                        static_cast<float>(tick.moved),
                        r.pressing,
                        r.status == hapbeam::LoopStatus::limited};
    if (moments_.size() < room) moments_.push_back(moment);
    else moments_[first_] = moment, first_ = (first_ + 1) % room;
    ++counts_[bin(tick.duration)];
  }
  void clear() { *this = {}; }

  std::size_t size() const { return moments_.size(); }
  /// 0 is the oldest.
  const Moment& operator[](std::size_t i) const { return moments_[(first_ + i) % moments_.size()]; }

  /// Tick times in bins of a tenth of a decade, from 0.1 us to 100 ms; the last has all that is longer.
  static constexpr std::size_t bins = 60;
  const std::array<std::uint64_t, bins>& counts() const { return counts_; }
  static double decades(double seconds);  ///< log10 of it over 0.1 us

 private:
  static constexpr std::size_t room = 6000;  // six seconds
  static std::size_t bin(double seconds);

  std::vector<Moment> moments_;
  std::size_t first_ = 0;
  std::array<std::uint64_t, bins> counts_{};
};

}  // namespace phantom
