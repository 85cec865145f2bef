// What a host without a device reports when the programs of docs/hosts.md are run: a hand that presses downwards and comes back,
// every two seconds, in a time of its own.  A program in which it never felt the beam push it up fails.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace hapbeam::testing {

class PressingHand {
 public:
  double time = 0;  // [s]

  /// [m] from 20 mm above the origin to 10 mm below it.
  double height() const noexcept { return 0.005 + 0.015 * std::cos(pi * time); }
  double climb() const noexcept { return -0.015 * pi * std::sin(pi * time); }  // [m/s]
  void feel(double up) noexcept {
    if (up > most_) most_ = up;
  }
  ~PressingHand() {
    if (time == 0 || (most_ > 0.05 && most_ < 10)) return;
    std::printf("the hand felt %g N\n", most_);
    std::fflush(stdout);
    std::_Exit(1);
  }

 private:
  static constexpr double pi = 3.14159265358979324;
  double most_ = 0;  // [N]
};

inline PressingHand pressing_hand;

}  // namespace hapbeam::testing
