// SPDX-License-Identifier: MIT
// The bound of a contact that slides, B = μN.
//
// Within a push N answers to B: each linear solve computes with a bound and finds another normal force.  The bound follows it from solve to solve,
// by what N was seen to gain with B; or where that says nothing, by the ratio of two steps.  One that does not come to rest is held.
// Real-time: no allocation, noexcept, O(1).   Source: extrapolation, Aitken 1926.
#pragma once

#include <algorithm>
#include <cmath>

namespace hapbeam::detail {

/// @tparam MostSolves  in which it follows
template <typename Scalar, int MostSolves>
class FrictionBound {
 public:
  /// @param sliding  μ   @param normal_force  of the last tick [N]   @param gain  dN/dB, by the touch
  /// @param learns  whether equilibria of this push say more of that
  void begin(Scalar sliding, Scalar normal_force, Scalar gain, bool learns) noexcept {
    sliding_ = sliding, gain_ = gain, learns_ = learns;
    next_ = before_ = sliding * (std::max)(normal_force, Scalar(0));
    pairs_ = held_ = false;
    start(false);
  }
  /// It goes on as it went, unless that was a leap.  @param rise  in a tick [N]
  void go_on(Scalar rise) noexcept {
    if (std::abs(rise) < next_ / 4) next_ += rise;
  }

  /// With which the next solve computes, and with which the last one did [N].
  Scalar next() const noexcept { return next_; }
  Scalar used() const noexcept { return used_; }
  /// Of the last tick [N].
  Scalar before() const noexcept { return before_; }
  Scalar gain() const noexcept { return gain_; }
  /// Whether it does not follow any more.
  bool held() const noexcept { return held_; }

  void set(Scalar bound) noexcept { used_ = next_ = bound; }
  /// To be called where the way to an equilibrium begins.   @param from_afar  the normal forces on a long way say nothing of its end
  void start(bool from_afar) noexcept { off_ = ratio_ = 0, follows_ = from_afar || held_ ? MostSolves : 0; }
  /// The same after a leap: what was seen of the gain does not hold there.
  void leap(Scalar bound, bool from_afar) noexcept {
    set(bound);
    pairs_ = false;
    start(from_afar);
  }
  void hold() noexcept {
    held_ = true;
    set(before_);
  }

  /// To be called after each linear solve.
  void use() noexcept { used_ = next_; }
  /// The same where it slides.  @param normal_force  of that solve [N]
  void follow(Scalar normal_force) noexcept {
    if (++follows_ > MostSolves) return;
    const Scalar off = sliding_ * normal_force - used_;
    Scalar step = off / rate();
    if (!learns_) {
      // What is left shrinks by the same ratio from solve to solve where nothing but the bound is on its way.
      const Scalar ratio = off_ != 0 ? off / off_ : Scalar(0);
      const bool steady =
          ratio > Scalar(0.2) && ratio < Scalar(0.9) && std::abs(ratio - ratio_) < Scalar(0.15);
      if (steady) step /= 1 - ratio;
      off_ = steady ? Scalar(0) : off;
      ratio_ = steady ? Scalar(0) : ratio;
    }
    next_ = (std::max)(Scalar(0), used_ + step);
  }
  /// To be called in an equilibrium, which may be one of another bound than μN.
  void see(Scalar normal_force) noexcept {
    // In space directions change the gain more, and so do other contacts.
    if (learns_ && pairs_ && std::abs(used_ - pair_bound_) > Scalar(1e-3) * used_)
      gain_ = std::clamp((normal_force - pair_force_) / (used_ - pair_bound_), Scalar(-4), Scalar(4));
    pairs_ = true;
    pair_bound_ = used_, pair_force_ = normal_force;
    follows_ = held_ ? MostSolves : 0;
  }
  /// Goes nearer to what that equilibrium can hold [N].
  void approach(Scalar most) noexcept { next_ = (std::max)(Scalar(0), used_ + (most - used_) / rate()); }

 private:
  Scalar rate() const noexcept { return std::clamp(1 - sliding_ * gain_, Scalar(0.25), Scalar(4)); }

  Scalar sliding_ = 0, gain_ = 0, next_ = 0, used_ = 0, before_ = 0;
  Scalar pair_bound_ = 0, pair_force_ = 0;
  Scalar off_ = 0, ratio_ = 0;
  bool pairs_ = false, learns_ = false, held_ = false;
  int follows_ = 0;
};

}  // namespace hapbeam::detail
